"""Labels of every robot of the catalogue, in fifty postures each: boxes measured as they are set."""

import json
import re
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from kinegrade.exercises.drawing import Dimension, Drawing, Triad, point
from kinegrade.grader.figures.arm import compose
from kinegrade.grader.figures.bodies import draw_body
from kinegrade.grader.figures.labels import SIZE, SUB, Placed
from kinegrade.grader.figures.markup import label_svg
from kinegrade.grader.figures.pose import pose
from kinegrade.grader.figures.scene import Scene
from kinegrade.solutions.kinematics import frames
from kinegrade.solutions.robots import ROBOTS
from typst import Compiler

POSTURES = 50
WIDTH = 380  # [px] of a figure on a sheet
EDGES = (("bounds", "baseline"), ("baseline", "bounds"))
PAGE = b"""#let words = json(bytes(sys.inputs.words))
#let size(word, top, bottom) = measure(text(font: "Libertinus Serif", size: 100pt,
  style: sys.inputs.style, top-edge: top, bottom-edge: bottom, word))
#context [#metadata(words.map(word => (
  size(word, "bounds", "baseline").width.pt(),
  size(word, "bounds", "baseline").height.pt(),
  size(word, "baseline", "bounds").height.pt(),
)))<boxes>]"""
BASELINE = re.compile(r'<text x="[^"]+" y="([^"]+)"')
STEP = 1.0  # [px] between points of a box that are held against bodies


@cache
def measured(word: str, style: str) -> tuple[float, float, float]:
    """Width, height above and depth below the baseline of a word, in sizes of its font."""
    inputs = {"words": json.dumps([word]), "style": style}
    compiler = Compiler(PAGE, ignore_system_fonts=True, sys_inputs=inputs)
    ((width, above, below),) = json.loads(compiler.query("<boxes>", field="value", one=True))
    return width / 100, above / 100, below / 100


def text_box(placed: Placed) -> tuple[float, float, float, float]:
    """Left, top, right, bottom of the letters of a label as it is written [px]."""
    label = placed.label
    (written,) = set(BASELINE.findall(label_svg(placed)))  # of the text and of its halo
    baseline = float(written)
    width, above, below = (SIZE * share for share in measured(label.symbol, "italic"))
    top, bottom = baseline - above, baseline + below
    if label.subscript:
        wide, high, low = (SUB * share for share in measured(label.subscript, "normal"))
        width += wide
        top = min(top, baseline + 3.6 - high)
        bottom = max(bottom, baseline + 3.6 + low)
    x = float(placed.centre[0])
    return x - width / 2, top, x + width / 2, bottom


def is_over(box: tuple[float, float, float, float], planes: np.ndarray) -> bool:
    """Whether a line of sight through a box passes through the half-spaces of a body."""
    left, top, right, bottom = box
    x, y = np.meshgrid(np.arange(left, right, STEP), np.arange(top, bottom, STEP))
    normals, c = planes[:, :3], planes[:, 3:]
    room = c - normals[:, :2] @ np.stack([x.ravel(), y.ravel()])
    slope = normals[:, 2:]
    near, far = slope[:, 0] > 1e-9, slope[:, 0] < -1e-9
    front = np.min(room[near] / slope[near], axis=0, initial=np.inf)
    back = np.max(room[far] / slope[far], axis=0, initial=-np.inf)
    return bool(((front >= back) & np.all(room[~near & ~far] >= 0, axis=0)).any())


@cache
def postures(name: str) -> tuple[Drawing, ...]:
    """A robot in fifty postures within its limits, with frames and a dimension line."""
    robot = ROBOTS[name]
    rng = np.random.default_rng(7)
    low, high = np.transpose(robot.limits)
    chain = robot.chain()
    drawings = []
    for _ in range(POSTURES):
        q = rng.uniform(low, high)
        poses = frames(chain, q)
        triads = (Triad(np.eye(4), "0"), Triad(poses[-1], "tool"))
        line = Dimension(point(poses[0][:3, 3]), point(poses[1][:3, 3]), "a1")
        drawings.append(Drawing(chain, tuple(q.tolist()), "An arm", "An arm", triads, (line,)))
    return tuple(drawings)


@cache
def scenes(name: str) -> tuple[tuple[Scene, tuple[Placed, ...]], ...]:
    found = []
    for drawing in postures(name):
        scene = compose(drawing, WIDTH)
        found.append((scene, tuple(scene.placed())))
    return tuple(found)


each_robot = pytest.mark.parametrize("name", ROBOTS)


@each_robot
def test_no_two_labels_overlap(name):
    for _, placed in scenes(name):
        for a, b in combinations(map(text_box, placed), 2):
            assert a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] or b[1] >= a[3]


@each_robot
def test_no_label_lies_on_a_joint(name):
    for drawing, (_, placed) in zip(postures(name), scenes(name), strict=True):
        aside = Scene(WIDTH)
        bodies = [draw_body(aside, joint) for joint in pose(drawing, WIDTH).joints]
        for box in map(text_box, placed):
            for planes in bodies:
                assert not is_over(box, planes)


@each_robot
def test_no_label_leaves_the_canvas(name):
    for scene, placed in scenes(name):
        (frame,) = re.findall(r'viewBox="([^"]+)"', scene.svg("", ""))
        x, y, wide, high = map(float, frame.split())
        for left, top, right, bottom in map(text_box, placed):
            assert x <= left < right <= x + wide
            assert y <= top < bottom <= y + high
