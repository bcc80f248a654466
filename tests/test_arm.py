"""The arm drawing: what is in the picture, where it stands, that any arm can be drawn."""

import json
import re
import struct
import xml.etree.ElementTree as ET
from base64 import b64decode
from collections.abc import Sequence
from functools import cache
from itertools import combinations
from math import pi
from typing import Any

import numpy as np
import pytest
from kinegrade.exercises.drawing import Dimension, Drawing, Point, Triad
from kinegrade.grader.figures.arm import compose, draw
from kinegrade.grader.figures.depth import Array, by_depth, outside, tube_planes
from kinegrade.grader.figures.labels import SIZE, SUB, symbol_of, text_width
from kinegrade.grader.figures.pose import pose
from kinegrade.grader.figures.raster import data_uri, png
from kinegrade.grader.figures.scene import Scene, text_xml
from kinegrade.grader.figures.view import camera, looked_at
from kinegrade.solutions.chain import Chain, elementary, from_frames, from_standard
from kinegrade.solutions.errors import KinegradeError
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.robots import ROBOTS

SVG = "{http://www.w3.org/2000/svg}"
SEVEN = from_standard(
    [
        [0, 0.333, 0, -pi / 2],
        [0, 0, 0, pi / 2],
        [0, 0.316, 0.0825, pi / 2],
        [0, 0, -0.0825, -pi / 2],
        [0, 0.384, 0, pi / 2],
        [0, 0, 0.088, pi / 2],
        [0, 0.107, 0, 0],
    ],
    "RRRRRRR",
)
POINT = from_standard([[0, 0, 0, pi / 2], [0, 0, 0, -pi / 2], [0, 0, 0, 0]], "RRR")


def s0(scale: float = 1.0) -> Chain:
    placements = [
        elementary("Tz", 3 * scale),
        elementary("Rx", pi / 2),
        elementary("Ty", 2 * scale),
    ]
    return from_frames(np.stack(placements), "RRR", tool=elementary("Tx", 2 * scale))


def spherical(d1: float = 0.6) -> Chain:
    return from_standard([[0, d1, 0, -pi / 2], [0, 0, 0, pi / 2], [0, 0, 0, 0]], "RRP")


def drawing(
    chain: Chain,
    q: Sequence[float],
    dimensions: Sequence[tuple[Point, Point, str]] = (),
    **more: Any,
) -> Drawing:
    triads = (Triad(np.eye(4), "0"), Triad(forward(chain, np.array(q, dtype=float)), "tool"))
    marks = tuple(Dimension(*dimension) for dimension in dimensions)
    return Drawing(chain, tuple(q), "An arm", "An arm in space", triads, marks, **more)


UP: tuple[tuple[Point, Point, str]] = (((0.0, 0.0, 0.0), (0.0, 0.0, 0.6), "d1"),)
DRAWINGS: dict[str, Drawing] = {
    **{
        f"{name} at {q}": drawing(robot.chain(), [q] * robot.n)
        for name, robot in ROBOTS.items()
        for q in (0.0, 0.35, -0.9)
    },
    "S0": drawing(s0(), (0, -pi / 6, pi / 6), [((0, 0, 0), (0, 0, 3), "L")]),
    "S3's Puma": drawing(ROBOTS["puma560"].chain(), (0.1, 0.5, 0.1, 0.8, 0.1, 0.2)),
    "home": drawing(spherical(), (0, 0, 0.7), UP),
    "aside": drawing(spherical(), (0.6, 0.9, 0.7), UP, arrows=False),
    "pulled in": drawing(spherical(), (0.6, 0.9, 0.0), UP),
    "backwards": drawing(spherical(), (0.6, 0.9, -0.5), UP),
    "seven": drawing(SEVEN, (0.3, 0.5, 0.2, -1.4, 0.3, 1.6, 0.4)),
    "stretched": drawing(SEVEN, (0,) * 7),
    "tall": drawing(spherical(50.0), (0.6, 0.9, 0.1), [((0, 0, 0), (0, 0, 50), "d1")]),
    "flat": drawing(from_standard([[0, 0, a, 0] for a in (5, 4, 3)], "RRR"), (0.1, -0.05, 0.1)),
    "one point": drawing(POINT, (0.3, 0.2, 0.1), [((0, 0, 0), (0, 0, 0), "d1")]),
    "one sliding point": drawing(from_standard([[0, 0, 0, 0]], "P"), (0.0,)),
    "seen end on": drawing(ROBOTS["planar_2r"].chain(), (0.0, 0.0), view=(0.0, 0.0)),
    "seen from above": drawing(ROBOTS["planar_2r"].chain(), (0.5, 0.9), view=(-90.0, 90.0)),
    "bare": Drawing(s0(), (0.0, 0.0, 0.0), "", ""),
}
each_drawing = pytest.mark.parametrize("name", DRAWINGS)


@cache
def picture(name: str) -> str:
    return draw(DRAWINGS[name])


def root_of(svg: str) -> ET.Element:
    return ET.fromstring(svg)  # noqa: S314 (our own)


def parts(svg: str, css: str) -> list[ET.Element]:
    return [e for e in root_of(svg).iter() if css in e.get("class", "").split()]


def arrow_of(svg: str) -> ET.Element:
    (arrow,) = [e for e in parts(svg, "sense") if e.tag == SVG + "g"]
    return arrow


def number(element: ET.Element, name: str) -> float:
    return float(element.get(name, "nan"))


def line_of(path: ET.Element) -> Array:
    return np.array(
        [[float(c) for c in p.split()] for p in re.split("[ML]", path.get("d", ""))[1:]]
    )


def turning(svg: str) -> float:
    """The area swept by the curved arrow: positive is clockwise, since y runs down."""
    arc = np.vstack([line_of(e) for e in parts(svg, "sense")])
    x, y = (arc - arc.mean(0)).T
    return float(np.sum(x[:-1] * np.diff(y) - y[:-1] * np.diff(x)))


@each_drawing
def test_every_joint_has_its_body_and_its_label(name: str) -> None:
    svg, case = picture(name), DRAWINGS[name]
    kinds = case.chain.kinds
    assert len(parts(svg, "revolute")) == 2 * kinds.count("R")
    assert len(
        [e for e in parts(svg, "joint") if "prismatic" in e.get("class", "")]
    ) == kinds.count("P")
    words = ["".join(e.findall(SVG + "text")[-1].itertext()) for e in parts(svg, "joint-label")]
    assert words == [f"q{i + 1}" for i in range(case.chain.n)]
    assert len(parts(svg, "triad")) == len(parts(svg, "triad-label")) == 3 * len(case.triads)
    assert (
        len(parts(svg, "dimension")) == len(parts(svg, "dimension-label")) == len(case.dimensions)
    )


@each_drawing
def test_arrows_are_there_when_asked_for(name: str) -> None:
    svg, case = picture(name), DRAWINGS[name]
    revolute, prismatic = (case.chain.kinds.count(kind) if case.arrows else 0 for kind in "RP")
    assert len(parts(svg, "head")) == revolute
    assert len([e for e in parts(svg, "sense") if e.tag == SVG + "g"]) == prismatic


@pytest.mark.parametrize("width", [300, 420])
@each_drawing
def test_labels_keep_clear_of_one_another_and_inside_the_picture(name: str, width: float) -> None:
    scene = compose(DRAWINGS[name], width)
    boxes = [label.box for label in scene.placed()]
    for a, b in combinations(boxes, 2):
        assert a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] or b[1] >= a[3]
    x, y, wide, high = map(float, root_of(scene.svg("", "")).get("viewBox", "").split())
    assert wide == width
    for left, top, right, bottom in boxes:
        assert x <= left < right <= x + wide
        assert y <= top < bottom <= y + high


@each_drawing
def test_the_arm_fills_the_picture_and_stays_inside(name: str) -> None:
    scene = compose(DRAWINGS[name], 420)
    scene.svg("", "")
    assert np.all(np.abs([scene.low[0], scene.high[0]]) <= 210)
    assert scene.high[1] - scene.low[1] <= 1.15 * 420


@each_drawing
def test_numbers_are_finite_and_letters_large_enough(name: str) -> None:
    svg = picture(name)
    assert not re.search(r"\b(nan|inf)\b", svg, re.IGNORECASE)
    assert all(float(size) >= 11 for size in re.findall(r'font-size="([\d.]+)"', svg))
    assert len(svg) < 60_000


@each_drawing
def test_the_same_drawing_gives_the_same_bytes(name: str) -> None:
    svg = picture(name)
    assert svg == draw(DRAWINGS[name])
    names = re.findall(r' id="([^"]+)"', svg)
    assert len(names) == len(set(names))
    assert set(re.findall(r"url\(#([^)]+)\)", svg)) == set(names)


def test_two_drawings_on_one_page_share_no_names() -> None:
    first, second = (set(re.findall(r' id="([^"]+)"', picture(name))) for name in ("S0", "home"))
    assert not first & second


def test_an_arm_a_thousand_times_larger_gives_the_same_picture() -> None:
    assert (
        len({draw(drawing(s0(scale), (0.1, -0.5, 0.5))) for scale in (2.0**-6, 1.0, 2.0**5)}) == 1
    )


def test_a_link_runs_along_its_joint_axis_first() -> None:
    chain = from_standard([[0, 0.5, 0.3, 0]], "R")
    arm = pose(drawing(chain, (0.0,)), 420)
    expected = arm.view.points(np.array([[0.0, 0, 0], [0, 0, 0.5], [0.3, 0, 0.5]]))
    np.testing.assert_allclose(arm.paths[1], expected, atol=1e-9)


@pytest.mark.parametrize("name", ["S3's Puma", "one point", "seven", "S0"])
def test_bodies_of_joints_that_meet_stand_clear_of_one_another(name: str) -> None:
    arm = pose(DRAWINGS[name], 420)
    for a, b in combinations(arm.joints, 2):
        assert np.linalg.norm(a.centre - b.centre) > 0.8 * (a.radius + b.radius)
    for joint in arm.joints:
        away = joint.centre - joint.origin
        np.testing.assert_allclose(away, (away @ joint.axis) * joint.axis, atol=1e-9)


def test_the_curved_arrow_turns_counterclockwise_about_an_axis_that_points_at_the_viewer() -> None:
    from_above: dict[str, Any] = {"view": (-90.0, 90.0)}
    upright, upside_down = (
        from_standard([[0, 0, 1, 0]], "R", base=elementary("Rx", angle)) for angle in (0.0, pi)
    )
    assert turning(draw(drawing(upright, (0.4,), **from_above))) < 0
    assert turning(draw(drawing(upside_down, (0.4,), **from_above))) > 0


@pytest.mark.parametrize(
    "stands", [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)]
)
def test_the_base_plate_lies_behind_the_arm_on_a_floor_a_ceiling_and_a_wall(stands: Point) -> None:
    chain = from_standard([[0, 0.5, 1, 0]], "R")
    case = drawing(chain, (0.4,), view=(-80.0, 10.0), stands=stands)
    plate, foot = middle_of(parts(draw(case), "base")[0]), pose(case, 420).paths[0][0][:2]
    away = np.array(looked_at(case) @ stands)[:2]
    assert (plate - foot) @ away < -5


def middle_of(solid: ET.Element) -> Array:
    """The middle of a cap in camera coordinates."""
    (cap,) = solid.findall(SVG + "ellipse")
    x, y = re.findall(r"-?[0-9.]+", cap.get("transform", ""))[:2]
    return np.array([float(x), float(y)])


@pytest.mark.parametrize(("base", "up"), [(np.eye(4), True), (elementary("Rx", pi), False)])
def test_the_straight_arrow_points_along_the_axis(base: Array, up: bool) -> None:
    svg = draw(drawing(from_standard([[0, 0, 0, 0]], "P", base=base), (0.4,)))
    start, end = line_of(arrow_of(svg)[0])
    assert (end[1] < start[1]) == up


def test_an_axis_that_points_at_the_viewer_is_a_ring_with_a_dot() -> None:
    svg = picture("seen from above")
    assert all(
        len(e.findall(SVG + "circle")) == 2
        for e in parts(svg, "triad")
        if "z" in e.get("class", "").split()
    )


def test_captions_are_written_as_text_whatever_is_in_them() -> None:
    nasty = '</title><script>alert("1")</script>&\0\x08\ud800 é'
    case = Drawing(
        s0(),
        (0, 0, 0),
        nasty,
        nasty,
        (Triad(np.eye(4), "<b>&"),),
        (Dimension((0, 0, 0), (0, 0, 3), '"><x '),),
    )
    root = root_of(draw(case))
    clean = nasty.replace("\0", "\ufffd").replace("\x08", "\ufffd").replace("\ud800", "\ufffd")
    assert root.findtext(SVG + "title") == root.findtext(SVG + "desc") == clean
    assert not [e for e in root.iter() if e.tag.removeprefix(SVG) in {"script", "b", "x"}]
    assert text_xml("a < b") == "a &lt; b"


def test_a_label_wider_than_the_picture_still_finds_a_place() -> None:
    case = drawing(s0(), (0, 0, 0), [((0, 0, 0), (0, 0, 3), "w" * 200)])
    assert draw(case) == draw(case)


def test_a_configuration_of_the_wrong_length_is_refused_with_a_sentence() -> None:
    with pytest.raises(KinegradeError, match="takes shape"):
        draw(Drawing(s0(), (0.0,), "", ""))


@pytest.mark.parametrize(
    ("name", "symbol"),
    [
        ("a1", ("a", "1")),
        ("L", ("L", "")),
        ("alpha2", ("α", "2")),
        ("d12", ("d", "12")),
        ("theta", ("θ", "")),
        ("<", ("<", "")),
    ],
)
def test_parameters_are_written_as_in_the_formulas(name: str, symbol: tuple[str, str]) -> None:
    assert symbol_of(name) == symbol


def test_the_camera_looks_from_where_it_is_told() -> None:
    np.testing.assert_allclose(camera(0, 0) @ [1, 2, 3], [2, -3, 1], atol=1e-12)
    np.testing.assert_allclose(camera(-90, 90) @ [1, 2, 3], [1, -2, 3], atol=1e-12)


def test_what_is_nearer_is_painted_later() -> None:
    paint: dict[str, Any] = {"colour": "#808080", "css": "link"}
    scene = Scene(200)
    scene.tube(np.array([-50.0, 0, 9]), np.array([50.0, 0, 9]), 5, group="near", **paint)
    scene.tube(np.array([0.0, -50, -9]), np.array([0.0, 50, -9]), 5, group="far", **paint)
    scene.stroke(
        np.array([[20.0, -30, 0], [20.0, 30, 0]]), 1, colour="#000000", css="axis", group="between"
    )
    scene.tube(
        np.array([9.0, 20, 20]), np.array([9.0, 20, 40]), 0.3, group="thin and end on", **paint
    )
    names = [item.group for item in by_depth(scene.items)]
    assert names.index("far") < names.index("near")
    assert names.index("between") < names.index("near")
    assert len(names) == 4


def test_things_that_hide_one_another_in_a_ring_are_still_painted_once() -> None:
    scene = Scene(200)
    corners = np.array([[0.0, -40, 0], [35, 20, 0], [-35, 20, 0]])
    for k in range(3):
        a, b = corners[k] - [0, 0, 12], corners[(k + 1) % 3] + [0, 0, 12]
        scene.tube(
            a - 0.2 * (b - a), b + 0.2 * (b - a), 6, colour="#808080", css="link", group=str(k)
        )
    assert sorted(item.group for item in by_depth(scene.items)) == ["0", "1", "2"]


def test_a_tube_is_cut_where_it_runs_inside_a_body() -> None:
    body = tube_planes(np.array([4.0, 0, 0]), np.array([6.0, 0, 0]), 2, 12)
    a, b = np.zeros(3), np.array([10.0, 0, 0])
    np.testing.assert_allclose(outside(a, b, [body]), [(0, 0.4), (0.6, 1)], atol=1e-12)
    assert outside(a, b, [tube_planes(np.array([-1.0, 0, 0]), np.array([11.0, 0, 0]), 2, 12)]) == []


@pytest.mark.parametrize("width", [420, 421, 840])
def test_the_png_has_the_width_asked_for_and_the_same_bytes_twice(width: int) -> None:
    svg = picture("home")
    image = png(svg, width)
    assert image[:8] == b"\x89PNG\r\n\x1a\n"
    wide, high = struct.unpack(">II", image[16:24])
    assert wide == width
    assert high == pytest.approx(width * number(root_of(svg), "height") / 420, abs=1)
    assert image == png(svg, width)


def test_a_drawing_in_a_page_is_an_svg_on_white() -> None:
    kind, _, data = data_uri(picture("home")).partition(",")
    assert kind == "data:image/svg+xml;base64"
    assert root_of(b64decode(data).decode()).get("style") == "background:#fff"


def test_a_png_without_width_is_refused_with_a_sentence() -> None:
    with pytest.raises(KinegradeError, match="width takes 1 pixel or more, got 0"):
        png("<svg/>", 0)


def test_widths_of_labels_are_estimated_on_the_safe_side() -> None:
    from typst import Compiler

    words = [*"qxyzaLdlαθ", "a1", "tool", "12", "wrist", "MW"]
    page = b"""#context [#metadata(json(bytes(sys.inputs.words)).map(word => measure(
      text(font: "Libertinus Serif", size: 100pt, style: "italic", word)).width.pt()))<widths>]"""
    compiler = Compiler(page, ignore_system_fonts=True, sys_inputs={"words": json.dumps(words)})
    measured = json.loads(compiler.query("<widths>", field="value", one=True))
    for word, width in zip(words, measured, strict=True):
        assert width <= text_width(word, 100), word
    assert SIZE > SUB >= 11
