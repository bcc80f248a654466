"""Planar arms are seen flat, with the zero of every angle; folded arms are as large as others."""

import re
import xml.etree.ElementTree as ET
from functools import cache
from math import pi

import numpy as np
import pytest
from kinegrade.exercises.drawing import Drawing
from kinegrade.grader.figures.arm import draw
from kinegrade.grader.figures.plane import USUAL, normal, view_of
from kinegrade.grader.figures.pose import pose
from kinegrade.grader.figures.view import looked_at
from kinegrade.solutions.chain import elementary, from_standard
from kinegrade.solutions.robots import ROBOTS

SVG = "{http://www.w3.org/2000/svg}"
PLANAR = {"planar_2r", "planar_3r"}
LINKS = [[0, 0, 1.0, 0], [0, 0, 0.7, 0]]
WIDTH = 420


def planar(base=None):
    return from_standard(LINKS, "RR", base=np.eye(4) if base is None else base)


def drawn(q, base=None, **more):
    return draw(Drawing(planar(base), q, "An arm", "An arm", **more), WIDTH)


def elements(svg, css):
    root = ET.fromstring(svg)  # noqa: S314 (our own)
    return [e for e in root.iter() if css in e.get("class", "").split()]


def line_of(path):
    return np.array([[float(c) for c in p.split()] for p in re.split("[ML]", path.get("d"))[1:]])


def bearing(vector):
    """Counter-clockwise from the right, as it is seen; y runs down the page."""
    return float(np.arctan2(-vector[1], vector[0]))


def zero_bearings(svg):
    lines = [line_of(zero.findall(f"{SVG}path")[-1]) for zero in elements(svg, "zero")]
    return [bearing(line[1] - line[0]) for line in lines]


def sweeps(svg, q, joint, base=None):
    """From where to where the arc of a joint runs about it, without turns beyond its ends."""
    centre = pose(Drawing(planar(base), q, "", ""), WIDTH).joints[joint].centre[:2]
    arc = line_of(elements(svg, "sense")[joint]) - centre
    angles = np.unwrap([bearing(point) for point in arc])
    return float(angles[0]), float(angles[-1])


@pytest.mark.parametrize("name", ROBOTS)
def test_planar_arms_alone_are_seen_along_their_axes(name):
    chain = ROBOTS[name].chain()
    q = np.full(chain.n, 0.4)
    assert (normal(chain, q) is not None) == (name in PLANAR)
    assert (view_of(chain, q) == USUAL) == (name not in PLANAR)


def test_an_arm_that_lies_flat_is_seen_from_above_and_one_on_a_wall_from_before_it():
    lying = looked_at(Drawing(planar(), (0.3, 0.4), "", ""))
    np.testing.assert_allclose(lying, np.diag([1, -1, 1]), atol=1e-9)
    upright = looked_at(Drawing(planar(elementary("Rx", pi / 2)), (0.3, 0.4), "", ""))
    np.testing.assert_allclose(upright, [[1, 0, 0], [0, 0, -1], [0, -1, 0]], atol=1e-9)


def test_an_arm_with_one_link_above_the_other_is_not_flat():
    chain = from_standard([[0, 0.3, 1.0, 0], [0, 0, 0.7, 0]], "RR")
    assert normal(chain, np.zeros(2)) is None


def test_a_view_that_is_asked_for_is_kept():
    assert not elements(drawn((0.6, 0.9), view=(-55.0, 22.0)), "zero")


def test_the_line_of_zero_lies_where_the_link_would_be():
    first, second = zero_bearings(drawn((0.6, -0.9)))
    assert first == pytest.approx(0.0, abs=0.02)
    assert second == pytest.approx(0.6, abs=0.02)


@pytest.mark.parametrize(("base", "sense"), [(None, 1), (elementary("Rx", pi), -1)])
@pytest.mark.parametrize("q", [0.9, 2.5, -0.9, -2.5, 5.0])
def test_the_arc_runs_between_zero_and_the_link_and_its_arrow_the_positive_way(base, sense, q):
    svg = drawn((0.4, q), base)
    start, end = sweeps(svg, (0.4, q), 1, base)
    assert np.sign(end - start) == sense
    at_zero = zero_bearings(svg)[1]
    link = at_zero + sense * q
    expected = at_zero if q > 0 else link
    assert np.cos(start - expected) == pytest.approx(1.0, abs=2e-3)
    if q > 0:
        # The last piece of the arc lies under the arrowhead.
        assert sense * (end - start) == pytest.approx(q, abs=0.06 * q)
    else:
        assert sense * (end - start) > -q


def test_a_drawing_without_arrows_has_no_zeros():
    svg = drawn((0.6, 0.9), arrows=False)
    assert not elements(svg, "zero")
    assert not elements(svg, "sense")


@cache
def sizes(name):
    """The larger side of an arm on the page, over the picture's width, in fifty postures."""
    robot, rng = ROBOTS[name], np.random.default_rng(5)
    low, high = np.transpose(robot.limits)
    found = []
    for _ in range(50):
        arm = pose(Drawing(robot.chain(), tuple(rng.uniform(low, high)), "", ""), WIDTH)
        points = np.concatenate(arm.paths)[:, :2]
        found.append(float(np.ptp(points, axis=0).max()) / WIDTH)
    return found


@pytest.mark.parametrize("name", ROBOTS)
def test_folded_arms_are_drawn_at_a_readable_size(name):
    assert min(sizes(name)) > 0.45
