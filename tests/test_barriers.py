"""Barriers of sections that three joints or more span: held against differences of the tool's path and known radii."""

from dataclasses import replace

import numpy as np
import pytest
from kinegrade.solutions.robots import ROBOTS, Robot
from kinegrade.solutions.sections.approach import in_axis_frame, projected
from kinegrade.solutions.sections.barriers import CELL, STEP, barriers, clearance
from kinegrade.solutions.singularity import RegionalArm, Values, arm
from kinegrade.solutions.workspace import _plane, section

NAMES = ("planar_3r", "articulated_6r", "ur5", "panda")
TURN = (-np.pi, np.pi)
PARTS = {name: arm(ROBOTS[name]) for name in NAMES}
AXES = {name: _plane(part) for name, part in PARTS.items()}
FOUND = {name: barriers(PARTS[name], *AXES[name]) for name in NAMES}
names = pytest.mark.parametrize("name", NAMES)


def seen(part: RegionalArm, axes: tuple[str, str], q: Values) -> Values:
    return projected(in_axis_frame(part.chain, q), axes)


def slopes(part: RegionalArm, axes: tuple[str, str], q: Values) -> Values:
    """Derivatives (m, 2, n) of the tool in the section, by central differences."""
    steps = 1e-6 * np.eye(part.chain.n)
    columns = [(seen(part, axes, q + step) - seen(part, axes, q - step)) / 2e-6 for step in steps]
    return np.stack(columns, axis=-1)


def radii(robot: Robot) -> dict[bool, set[float]]:
    part = arm(robot)
    found: dict[bool, set[float]] = {True: set(), False: set()}
    for held, q in barriers(part, *_plane(part)):
        found[held] |= set(np.linalg.norm(seen(part, ("x", "y"), q), axis=1).round(6).tolist())
    return found


@names
def test_free_joints_have_lost_a_direction_and_those_at_limits_only_take_the_tool_back(name):
    part, (axes, _) = PARTS[name], AXES[name]
    low, high = np.transpose(part.limits)
    length = np.linalg.norm(part.chain.fixed[1:, :3, 3], axis=-1).sum()
    for _, q in FOUND[name]:
        gains = slopes(part, axes, q[1:-1]) / length
        side = np.where(q[1:-1] < low + 1e-9, -1.0, np.where(q[1:-1] > high - 1e-9, 1.0, 0.0))
        side *= high - low < 2 * np.pi - 1e-9  # a full turn has no end
        side[:, np.abs(gains).max(axis=(0, 1)) < 1e-9] = (
            0.0  # what does not move the tool cannot hold it
        )
        U, sigma, _ = np.linalg.svd(np.where(side[:, None] == 0, gains, 0.0))
        corner = sigma[:, 0] < 1e-9  # all joints at limits, between one edge and the next
        chord = 2 * STEP**2  # so far off may be a point where a line passes from face to face
        assert sigma[~corner, 1].max() < chord
        assert np.quantile(sigma[~corner, 1], 0.8) < 1e-6
        pressed = (U[:, None, :, 1] @ gains)[:, 0] * side
        assert (corner | (pressed > -chord).all(axis=1) | (pressed < chord).all(axis=1)).all()


@names
def test_lines_run_on_without_leaps(name):
    part, (axes, _) = PARTS[name], AXES[name]
    length = np.linalg.norm(part.chain.fixed[1:, :3, 3], axis=-1).sum()
    for _, q in FOUND[name]:
        assert (
            np.linalg.norm(np.diff(seen(part, axes, q), axis=0), axis=1).max() < 2 * STEP * length
        )
        assert len(q) > 1


@names
def test_postures_keep_within_the_limits(name):
    low, high = np.transpose(PARTS[name].limits)
    for _, q in FOUND[name]:
        assert ((q >= low) & (q <= high)).all()


@names
def test_a_line_is_found_once(name):
    """No two lines run beside each other for long; where they meet, or cross at a small angle, they may."""
    part, (axes, _) = PARTS[name], AXES[name]
    length = np.linalg.norm(part.chain.fixed[1:, :3, 3], axis=-1).sum()
    lines = [seen(part, axes, q) / length for _, q in FOUND[name]]
    for i, line in enumerate(lines):
        for other in lines[:i]:
            near = np.linalg.norm(line[:, None] - other, axis=-1).min(axis=1) < 0.1 * CELL
            assert np.count_nonzero(near) < 25


def test_the_planar_arm_within_its_limits_has_its_known_radii():
    """Stretched; and with joints 2 and 3 at their limits, bent the same way or against each other."""
    c, s = np.cos(np.radians(150)), np.sin(np.radians(150))
    same = np.hypot(
        1.0 + 0.8 * c + 0.5 * np.cos(np.radians(300)), 0.8 * s + 0.5 * np.sin(np.radians(300))
    )
    against = np.hypot(1.0 + 0.8 * c + 0.5, 0.8 * s)
    found = radii(ROBOTS["planar_3r"])
    assert found[False] == {2.3}
    assert sorted(found[True]) == pytest.approx(sorted([same, against]), abs=1e-6)


@pytest.mark.parametrize(("lengths", "hole"), [((1.0, 0.8, 0.5), 0.0), ((2.0, 0.6, 0.3), 1.1)])
def test_a_planar_arm_that_turns_all_round_is_singular_where_its_links_are_in_line(lengths, hole):
    a, b, c = lengths
    parameters = dict(zip(("l1", "l2", "l3"), lengths, strict=True))
    robot = replace(ROBOTS["planar_3r"], parameters=parameters, limits=(TURN,) * 3)
    found = radii(robot)
    assert not found[True]
    assert sorted(found[False]) == pytest.approx(
        sorted(abs(a + i * b + j * c) for i in (1, -1) for j in (1, -1))
    )
    assert (min(found[False]) == pytest.approx(hole)) == (hole > 0)


def test_a_slide_of_three_joints_is_held_at_its_ends():
    """Two turning joints and a slide: the ring between both ends of the stroke, seen from the elbow's reach."""
    rows = (("q1", "0", "l1", "0"), ("q2", "0", "0", "pi/2"), ("0", "q3", "0", "0"))
    robot = Robot(
        "rrp", "RRP", {"l1": 1.0}, rows, (TURN, TURN, (0.2, 0.5)), "chosen here", task_rows=(0, 1)
    )
    assert sorted(radii(robot)[True]) == pytest.approx([0.5, 1.5])


def test_a_pedestal_lifts_the_curves_and_changes_nothing_else():
    part = arm(replace(ROBOTS["articulated_6r"], base=(("Tz", "50"), ("Tx", "3"))))
    lines = barriers(part, *AXES["articulated_6r"])
    for (_, q), (_, twin) in zip(lines, FOUND["articulated_6r"], strict=True):
        np.testing.assert_allclose(q, twin, atol=1e-6)
        lifted = np.add(seen(PARTS["articulated_6r"], ("r", "z"), twin), [0.0, 50.0])
        np.testing.assert_allclose(seen(part, ("r", "z"), q), lifted, atol=1e-6)


def test_a_wrist_that_only_turns_its_tool_has_no_curves():
    rows = (("q1", "0", "0", "pi/2"), ("q2", "0", "0", "-pi/2"), ("q3", "0", "0", "0"))
    wrist = Robot("wrist", "wrist", {}, rows, (TURN,) * 3, "chosen here", task_rows=(3, 4, 5))
    assert barriers(arm(wrist), ("r", "z"), (1, 2)) == []


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_the_unit_of_length_decides_nothing(scale):
    robot = ROBOTS["articulated_6r"]
    part = arm(robot, {name: scale * value for name, value in robot.parameters.items()})
    lines = barriers(part, *AXES["articulated_6r"])
    assert len(lines) == len(FOUND["articulated_6r"])
    for (held, q), (twin, other) in zip(lines, FOUND["articulated_6r"], strict=True):
        assert held == twin
        np.testing.assert_allclose(q, other, atol=1e-6)


@names
def test_no_boundary_is_flagged_that_the_tool_gets_past(name):
    """Random postures beyond both sides of a flagged point show that it is none; across axis 1 the mirror side is there too."""
    part, (axes, free) = PARTS[name], AXES[name]
    off = clearance(part, free)
    rng = np.random.default_rng(1)
    reached = seen(part, axes, rng.uniform(*np.transpose(part.limits), (200_000, part.chain.n)))
    if axes == ("r", "z"):
        reached = np.concatenate([reached, reached * [-1.0, 1.0]])
    flagged, passed = 0, 0
    for curve in section(ROBOTS[name]).curves:
        along = np.gradient(curve.points, axis=0)
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
        for i in np.flatnonzero(curve.boundary)[::8]:
            away = (
                reached[np.abs(reached - curve.points[i]).max(axis=1) < 2 * off] - curve.points[i]
            )
            side = away[np.abs(away @ along[i]) < off / 3] @ [-along[i, 1], along[i, 0]]
            flagged += 1
            passed += bool((side > 1.3 * off).any() and (side < -1.3 * off).any())
    assert flagged > 5
    assert passed <= 0.02 * flagged


@pytest.mark.parametrize("name", ["articulated_6r", "ur5", "panda"])
def test_nothing_beside_axis_1_is_a_boundary_only_because_the_half_plane_ends_there(name):
    part, (_, free) = PARTS[name], AXES[name]
    for curve in section(ROBOTS[name]).curves:
        beside = curve.points[:, 0] < clearance(part, free) / 2
        upright = np.abs(np.gradient(curve.points[:, 0])) < 0.3 * np.abs(
            np.gradient(curve.points[:, 1])
        )
        assert not (curve.boundary & beside & upright)[1:-1].any()
