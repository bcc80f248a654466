# pyright: basic
"""Figures of every robot: what they name, where they draw it, that it fits the paper and comes out the same."""

import os
import re
import struct
import subprocess
import sys
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from kinegrade.grader.figures import maps
from kinegrade.grader.figures.maps import FigureError, describe, figure, joint_map, picture
from kinegrade.grader.figures.own_map import _path, _smallest_gain
from kinegrade.grader.figures.section_cells import evened, section_of, shown_cells
from kinegrade.solutions import workspace
from kinegrade.solutions.robots import ROBOTS, Factor, Robot
from kinegrade.solutions.singularity import sigma_min
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

TURN = (-np.pi, np.pi)
SCARA = Robot(
    name="scara",
    title="SCARA",
    parameters={"a1": 0.325, "a2": 0.275},
    rows=(
        ("q1", "0", "a1", "0"),
        ("q2", "0", "a2", "pi"),
        ("0", "q3", "0", "0"),
        ("q4", "0.05", "0", "0"),
    ),
    limits=(TURN, (-2.5, 2.5), (0.0, 0.2), TURN),
    source="chosen here",
    task_rows=(0, 1, 2, 5),
)
KINDS = ("", "workspace", "singularities")
drawn = cache(lambda name, kind="": figure(ROBOTS[name], None, kind))
drawn_again = cache(lambda name: figure(ROBOTS[name]))
described = cache(lambda name: describe(ROBOTS[name]))
mapped = cache(lambda name: joint_map(ROBOTS[name]))


def _texts(picture: Figure) -> str:
    return "\n".join(text.get_text() for text in picture.findobj(Text) if isinstance(text, Text))


@pytest.fixture
def coarse(monkeypatch):
    """Rasters of a few samples, in a cache of their own."""
    monkeypatch.setattr(workspace, "SAMPLES", 41)
    monkeypatch.setattr(maps, "SAMPLES", 41)
    monkeypatch.setattr(maps, "_found", cache(maps._found.__wrapped__))


@pytest.fixture
def ready(monkeypatch):
    """Saves the figure that is drawn already."""
    monkeypatch.setattr(maps, "figure", lambda robot, _parameters, _kind: drawn(robot.name))


@pytest.mark.parametrize("name", ROBOTS)
def test_every_robot_has_its_panels_and_names_its_factors(name):
    picture = drawn(name)
    assert len(picture.axes) == (
        2 if mapped(name).det is None else 3
    )  # seven joints have no determinant
    legends = _texts(picture).replace("\n", " ")
    for curve, _ in mapped(name).curves:
        assert re.sub(r"\|([a-z])(\d)\|", r"$|\1_\2|$", curve) in legends


@pytest.mark.parametrize("name", ROBOTS)
def test_a_kind_of_figure_has_its_own_panels_and_says_all_lengths(name):
    assert len(drawn(name, "workspace").axes) == 1
    whole = mapped(name).det is not None
    assert len(drawn(name, "singularities").axes) == 1 + whole
    for kind in KINDS:
        title = drawn(name, kind).get_suptitle()
        assert ROBOTS[name].title in title
        assert title.count("=") == len(ROBOTS[name].parameters)


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_drawn_beyond_the_paper(name, kind):
    picture = drawn(name, kind)
    renderer = FigureCanvasAgg(picture).get_renderer()
    for text in picture.findobj(Text):
        if isinstance(text, Text) and text.get_visible() and text.get_text().strip():
            box = text.get_window_extent(renderer)
            assert box.x0 > -1
            assert box.y0 > -1
            assert box.x1 < picture.bbox.width + 1
            assert box.y1 < picture.bbox.height + 1


@pytest.mark.parametrize(
    ("name", "formula"),
    [
        ("planar_2r", r"l_1\,l_2\,s_{2}"),
        ("three_axis", r"a_2\,a_3\,c_{3}\,(a_3\,c_{23}-a_2\,s_{2})"),
        ("rrt_spherical", r"-q_3^2\,s_{2}"),
        ("rrt_offset", r"-q_3\,(a_1+q_3\,s_{2})"),
        ("rrt_scara", r"-a_1\,a_2\,s_{2}"),
        ("rpp_cylindrical", "q_3"),
        ("scara", r"a_1\,a_2\,s_{2}"),
        ("stanford", r"-q_3^2\,s_{2}"),
        ("articulated_6r", r"a_2\,a_3\,s_{5}\,s_{3}\,(a_2\,c_{2}+a_3\,c_{23}+a_4\,c_{234})"),
        ("ur5", r"a_2\,a_3\,s_{5}\,s_{3}\,(a_2\,c_{2}+a_3\,c_{23}+d_5\,s_{234})"),
        ("puma560", r"-a_2\,(a_3\,s_{3}+d_4\,c_{3})\,(a_2\,c_{2}+a_3\,c_{23}-d_4\,s_{23})"),
    ],
)
def test_the_title_prints_the_determinant(name, formula):
    assert rf"$\det\mathbf{{A}}={formula}$" in _texts(drawn(name))


@pytest.mark.usefixtures("coarse")
@pytest.mark.parametrize(
    "change", [{"constant": "2*l1*l2"}, {"factors": (Factor("elbow", "sin(q2)^2"),)}]
)
def test_a_determinant_that_is_not_the_stated_product_has_no_formula(change):
    assert r"\det\mathbf{A}=l" not in _texts(figure(replace(ROBOTS["planar_2r"], **change)))


@pytest.mark.usefixtures("coarse")
def test_an_arm_with_a_link_of_no_length_is_drawn_without_a_formula():
    assert r"\det\mathbf{A}=l" not in _texts(figure(ROBOTS["planar_3r"], {"l2": 0.0}))


@pytest.mark.parametrize("name", ["rrt_offset", "puma560", "ur5"])
def test_a_length_in_a_legend_is_typeset(name):
    assert re.search(r"\$\|d_\d\|\$", _texts(drawn(name)))
    assert not re.search(r"\|d\d\|", _texts(drawn(name)))


def test_the_pumas_map_draws_both_elbow_lines_over_its_whole_width():
    elbow = dict(mapped("puma560").curves)["elbow: arm straight or folded"]
    lines = [line.get_xydata() for line in drawn("puma560").axes[0].lines]
    for line in elbow:
        assert np.ptp(line[:, 0]) == pytest.approx(2 * np.pi)
        assert any(np.array_equal(line, other) for other in lines)
    assert sorted(round(float(np.degrees(line[0, 1])), 3) for line in elbow) == [-87.308, 92.692]


@pytest.mark.parametrize("name", [name for name, robot in ROBOTS.items() if robot.factors])
def test_the_map_is_dark_on_the_named_curves_and_nowhere_else(name):
    found = mapped(name)
    lines = np.concatenate([line for _, curves in found.curves for line in curves])
    place = (lines - np.array(found.spans)[:, 0]) / np.diff(found.spans, axis=1)[:, 0]
    column, row = np.minimum((place * 181).astype(int), 180).T
    near = np.zeros(found.sigma.shape, dtype=bool)
    for a in (-1, 0, 1):
        for b in (-1, 0, 1):
            near[np.clip(row + a, 0, 180), np.clip(column + b, 0, 180)] = True
    top = found.sigma.max()
    assert found.sigma[row, column].max() < 0.08 * top
    steep = any(
        factor.power > 1 for factor in found.part.factors
    )  # where q3^2 meets s2, sigma is of third order
    assert found.sigma[~near].min() > (5e-5 if steep else 3e-4) * top


@pytest.mark.usefixtures("coarse")
def test_a_changed_length_changes_the_numbers():
    assert "0.5 m to 1.5 m" in describe(ROBOTS["planar_2r"], {"l2": 0.5})


def test_the_description_states_the_finding_with_numbers():
    text = described("puma560")
    for number in ("-87.31°", "92.69°", "0.15 m", "0.877 m", "0.15005 m"):
        assert number in text
    assert "changes sign across shoulder, but not across stroke" in described("rrt_spherical")
    assert "0.3 m to 1.7 m" in described("planar_2r")


@pytest.mark.parametrize("name", ROBOTS)
def test_no_description_has_an_empty_pair_of_brackets_or_a_nan(name):
    assert not re.search(r"\(\)|nan|inf\b|  ", described(name))


@pytest.mark.usefixtures("coarse")
@pytest.mark.parametrize(
    "robot", [SCARA, replace(ROBOTS["planar_2r"], factors=())], ids=["scara", "planar_2r"]
)
def test_a_robot_without_factors_still_has_a_map(robot):
    assert len(figure(robot).axes) == 3
    assert "at most" in describe(robot)


def test_a_robot_of_one_joint_is_refused_with_a_sentence():
    single = Robot(
        "pendulum",
        "pendulum",
        {"l": 1.0},
        (("q1", "0", "l", "0"),),
        (TURN,),
        "chosen here",
        task_rows=(0,),
    )
    with pytest.raises(FigureError, match="two joints or more, got pendulum with 1"):
        figure(single)


@pytest.mark.parametrize(
    ("suffix", "start"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")]
)
def test_a_picture_is_the_same_bytes_every_time(monkeypatch, suffix, start):
    pictures = []
    for draw, day in ((drawn, 1), (drawn_again, 2)):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", str(86_400 * day))
        monkeypatch.setattr(
            maps, "figure", lambda robot, _parameters, _kind, draw=draw: draw(robot.name)
        )
        pictures.append(picture(ROBOTS["planar_2r"], suffix))
    one, two = pictures
    assert one == two
    assert one.startswith(start)
    assert len(one) < 400_000


@pytest.mark.usefixtures("ready")
def test_the_png_is_1200_pixels_wide():
    assert struct.unpack(">I", picture(ROBOTS["planar_2r"], ".PNG")[16:20]) == (1200,)


def test_another_suffix_is_refused_with_a_sentence():
    with pytest.raises(FigureError, match=r"\.png, \.svg or \.pdf, got one in '\.jpg'"):
        picture(ROBOTS["planar_2r"], ".jpg")


def test_figures_leave_the_style_of_others_alone_and_pyplot_unloaded():
    code = (
        "import sys, matplotlib; before = matplotlib.rcParams.copy();"
        "from kinegrade.grader.figures import maps; from kinegrade.solutions import workspace;"
        "from kinegrade.solutions.robots import ROBOTS; maps.SAMPLES = workspace.SAMPLES = 41;"
        "maps.figure(ROBOTS['planar_2r']); assert not {'matplotlib.pyplot', 'sympy'} & set(sys.modules);"
        "assert all(matplotlib.rcParams[k] == before[k] for k in before if k != 'backend')"
    )
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)


HOSTILE = """text.usetex: True
text.latex.preamble: \\usepackage{nothing}
font.family: cursive
font.size: 31
axes.facecolor: black
figure.facecolor: black
text.color: white
axes.labelcolor: white
savefig.facecolor: black
savefig.dpi: 17
figure.dpi: 300
savefig.bbox: tight
axes.grid: True
axes.prop_cycle: cycler("color", ["lime"])
lines.linewidth: 9
image.origin: upper
image.interpolation: bicubic
svg.fonttype: none
svg.hashsalt: theirs
pdf.compression: 0
axes.unicode_minus: False
path.sketch: 9, 100, 2
figure.constrained_layout.w_pad: 2
"""
DIGESTS = """
import sys
from hashlib import sha256
from kinegrade.grader.figures import maps
from kinegrade.solutions import workspace
from kinegrade.solutions.robots import ROBOTS
maps.SAMPLES = workspace.SAMPLES = 41
for kind in ("", "workspace", "singularities"):
    for suffix in (".png", ".svg", ".pdf"):
        print(kind, suffix, sha256(maps.picture(ROBOTS[sys.argv[1]], suffix, None, kind)).hexdigest())
"""


@pytest.mark.parametrize("name", ["planar_2r", "rrt_offset"])
def test_a_users_matplotlibrc_changes_no_byte(tmp_path, name):
    (tmp_path / "matplotlibrc").write_text(HOSTILE, encoding="utf-8")
    printed = []
    for settings in ({}, {"MATPLOTLIBRC": str(tmp_path / "matplotlibrc")}):
        run = subprocess.run(
            [sys.executable, "-c", DIGESTS, name],
            env={**os.environ, **settings},
            cwd=tmp_path.parent,
            capture_output=True,
            text=True,
            check=True,
        )
        printed.append(run.stdout)
    assert printed[0] == printed[1]
    assert len(printed[0].splitlines()) == 9


@pytest.mark.parametrize("name", ["ur5", "panda", "articulated_6r", "planar_3r"])
def test_a_section_that_samples_filled_is_drawn_without_speckles(name):
    cut = section_of(ROBOTS[name], {})
    assert speckles(cut.cells) > 100
    assert speckles(shown_cells(cut)) == 0


def speckles(cells):
    """How many cells are a good deal darker than all eight around them, or alone in being filled."""
    known = np.where(np.isnan(cells), 0.0, cells)
    padded = np.pad(known, 1)
    around = np.stack(
        [
            padded[1 + a : 1 + a + cells.shape[0], 1 + b : 1 + b + cells.shape[1]]
            for a in (-1, 0, 1)
            for b in (-1, 0, 1)
            if (a, b) != (0, 0)
        ]
    )
    darker = around.min(axis=0) > known + 0.03 * known.max()
    alone = (known > 0) & ((around > 0).sum(axis=0) < 3)
    return int((darker | alone).sum())


def test_a_section_of_two_joints_is_drawn_as_it_was_found():
    cut = section_of(ROBOTS["rrt_offset"], {})
    assert shown_cells(cut) is cut.cells


def test_evening_lifts_what_is_dark_alone_and_keeps_a_dark_region():
    cells = np.ones((30, 30))
    cells[10, 10] = 0.0
    cells[20:28, 4:26] = 0.2
    cells[0:3] = np.nan
    cells[5, 20] = np.nan
    even = evened(cells)
    assert even[10, 10] == pytest.approx(1.0)
    assert even[24, 15] == pytest.approx(0.2)
    assert np.isnan(even[1]).all()
    assert even[5, 20] == pytest.approx(1.0)


@pytest.mark.parametrize("shape", [(3, 3), (2, 3), (3, 2)])
def test_gains_on_a_map_of_ones_own_arm_are_the_smallest_singular_values(shape):
    blocks = np.random.default_rng(0).normal(size=(40, *shape))
    blocks[0, :, -1] = blocks[0, :, 0]  # singular, but for the tall one
    np.testing.assert_allclose(_smallest_gain(blocks), sigma_min(blocks), atol=1e-7)


def test_a_path_keeps_corners_and_leaves_out_what_is_straight():
    corner = [[0, 0], [10, 0], [20, 0], [20, 0], [20, 10], [20, 20], [0, 0]]  # one of them twice
    points, offsets = np.array(corner, dtype=float), np.array([0, 7])
    assert _path(([points], [offsets]), closed=True) == "M0 0 20 0 20 0 20 20 0 0Z"
    two = np.array([[0, 0], [5, 0], [9, 0], [0, 7], [4, 7], [9, 7]], dtype=float)
    assert _path(([two], [np.array([0, 3, 6])]), closed=False) == "M0 0 9 0M0 7 9 7"
    assert _path(([None], [None]), closed=False) == ""
