"""Reach in closed form, and sections whose cells and curves were found apart and must agree."""

from dataclasses import replace

import numpy as np
import pytest
from kinegrade.grader.figures.maps import describe
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.reach import From, bounded_reach, reach
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.singularity import RegionalArm, Values, arm
from kinegrade.solutions.workspace import LIMITS, SINGULAR, Curve, meridian, section

SPANNED_BY_MORE = (
    "planar_3r",
    "articulated_6r",
    "ur5",
    "panda",
)  # by three, three, four and five joints
SECTIONS = {name: section(robot) for name, robot in ROBOTS.items()}


def _named(name: str, start: str) -> list[Curve]:
    return [curve for curve in SECTIONS[name].curves if curve.name.startswith(start)]


@pytest.mark.parametrize(
    ("name", "parameters", "expected"),
    [
        ("planar_2r", {}, (0.3, 1.7)),
        ("planar_2r", {"l1": 0.5, "l2": 0.5}, (0.0, 1.0)),
        ("three_axis", {}, (0.0, 4.0)),
        ("rrt_spherical", {}, (0.0, 1.0)),
        ("rrt_offset", {}, (0.15, np.hypot(1.2, 0.15))),
        ("puma560", {}, (0.15005, np.hypot(0.4318 + np.hypot(0.4318, 0.0203), 0.15005))),
    ],
)
def test_reach_is_the_closed_form(
    name: str, parameters: dict[str, float], expected: tuple[float, float]
) -> None:
    assert reach(ROBOTS[name], parameters) == pytest.approx(expected, abs=1e-9)


def test_reach_from_the_base_counts_the_height() -> None:
    near, far = reach(ROBOTS["rrt_spherical"], of="base")
    assert far == pytest.approx(1.6)
    assert near == pytest.approx(0.6 * np.sin(np.pi / 3))


def test_the_meridian_keeps_the_batch_and_does_not_see_q1() -> None:
    chain = ROBOTS["rrt_offset"].chain()
    q = np.random.default_rng(3).uniform(-1, 1, (4, 5, 3))
    turned = q + np.array([0.7, 0.0, 0.0])
    assert meridian(chain, q).shape == (4, 5, 2)
    np.testing.assert_allclose(meridian(chain, q), meridian(chain, turned))


@pytest.mark.parametrize("name", ROBOTS)
def test_curves_are_images_of_their_configurations_within_the_limits(name: str) -> None:
    part = arm(ROBOTS[name])
    low, high = np.transpose(part.limits)
    for curve in SECTIONS[name].curves:
        assert curve.points.shape == (len(curve.q), 2)
        assert ((curve.q >= low) & (curve.q <= high)).all()
        if SECTIONS[name].axes == ("r", "z"):
            np.testing.assert_allclose(curve.points, meridian(part.chain, curve.q), atol=1e-12)


@pytest.mark.parametrize("name", SECTIONS)
def test_every_rim_of_the_cells_lies_on_a_boundary_curve(name: str) -> None:
    """The cells know nothing of the curves: where they end, a curve marked as boundary must pass."""
    cut = SECTIONS[name]
    reached = np.pad(~np.isnan(cut.cells), 1)
    around = np.all([np.roll(reached, s, a) for s in (-1, 1) for a in (0, 1)], axis=0)
    rows, columns = np.nonzero((reached & ~around)[1:-1, 1:-1])
    size = (cut.extent[1] - cut.extent[0]) / cut.cells.shape[1]
    rim = np.column_stack(
        [cut.extent[0] + (columns + 0.5) * size, cut.extent[2] + (rows + 0.5) * size]
    )
    if cut.axes == ("r", "z"):
        rim = rim[rim[:, 0] > 2 * size]  # axis 1 ends the half plane, not the workspace
    walls = np.concatenate([curve.points[curve.boundary] for curve in cut.curves])
    gap = np.linalg.norm(rim[:, None] - walls, axis=-1).min(axis=1)
    assert gap.max() < (1 if name in SPANNED_BY_MORE else 4) * size


@pytest.mark.parametrize("name", ROBOTS)
def test_boundary_curves_have_empty_cells_beside_them(name: str) -> None:
    cut = SECTIONS[name]
    size = (cut.extent[1] - cut.extent[0]) / cut.cells.shape[1]
    empty = np.pad(np.isnan(cut.cells), 3, constant_values=True)
    near = np.any([np.roll(empty, (a, b), (0, 1)) for a in (-2, 0, 2) for b in (-2, 0, 2)], axis=0)
    for curve in cut.curves:
        column, row = (((curve.points - [cut.extent[0], cut.extent[2]]) / size).astype(int) + 3).T
        assert (
            np.count_nonzero(~near[row, column] & curve.boundary) <= 1
        )  # where it ceases to be one


def test_every_section_has_curves_and_a_scaras_last_joint_spans_nothing() -> None:
    assert all(cut.curves for cut in SECTIONS.values())
    assert {name for name in SECTIONS if _named(name, SINGULAR)} == set(SPANNED_BY_MORE)
    assert {curve.name for curve in SECTIONS["scara"].curves} == {
        ROBOTS["scara"].factors[0].name,
        LIMITS,
    }


@pytest.mark.parametrize("name", SPANNED_BY_MORE)
def test_a_section_that_more_joints_span_has_no_holes_and_ends_at_the_reach(name: str) -> None:
    cut = SECTIONS[name]
    reached = ~np.isnan(cut.cells)
    size = (cut.extent[1] - cut.extent[0]) / cut.cells.shape[1]
    x, y = (
        low + (np.arange(n) + 0.5) * size
        for low, n in zip(cut.extent[::2], cut.cells.shape[::-1], strict=True)
    )
    r = (
        np.hypot(*np.meshgrid(x, y))
        if cut.axes == ("x", "y")
        else np.broadcast_to(x, cut.cells.shape)
    )
    near, far = reach(ROBOTS[name])
    assert r[reached].max() == pytest.approx(far, abs=1.5 * size)
    assert r[reached].min() == pytest.approx(near, abs=1.5 * size)
    neighbours = np.sum([np.roll(reached, s, a) for s in (-1, 1) for a in (0, 1)], axis=0)
    assert not (~reached & (neighbours == 4)).any()


def test_the_disc_of_three_planar_joints_has_its_area() -> None:
    cut = SECTIONS["planar_3r"]
    size = (cut.extent[1] - cut.extent[0]) / cut.cells.shape[1]
    assert np.count_nonzero(~np.isnan(cut.cells)) * size**2 == pytest.approx(
        np.pi * 2.3**2, rel=0.04
    )


def test_the_planar_ring_lies_between_its_two_singular_circles() -> None:
    cut = SECTIONS["planar_2r"]
    assert cut.axes == ("x", "y")
    radii = {
        round(float(r), 9) for curve in cut.curves for r in np.linalg.norm(curve.points, axis=1)
    }
    assert radii == {0.3, 1.7}
    assert all(curve.boundary.all() for curve in cut.curves)


def test_the_pumas_shoulder_bounds_a_void_around_axis_1() -> None:
    for curve in _named("puma560", "shoulder"):
        np.testing.assert_allclose(curve.points[:, 0], 0.15005)
        assert curve.boundary.all()


def test_a_tool_that_crosses_axis_1_is_singular_inside_its_workspace() -> None:
    for name in ("three_axis", "rrt_spherical"):
        for curve in _named(name, "shoulder"):
            np.testing.assert_allclose(curve.points[:, 0], 0, atol=1e-9)
            assert not curve.boundary.any()


def test_a_joint_limit_bounds_a_part_of_the_workspace_and_crosses_another() -> None:
    limits = _named("puma560", LIMITS)
    assert any(curve.boundary.all() for curve in limits)
    assert any(curve.boundary.any() and not curve.boundary.all() for curve in limits)


def test_the_cells_hold_the_largest_sigma_min_and_vanish_at_the_rim() -> None:
    cut = SECTIONS["planar_2r"]
    y, x = np.indices(cut.cells.shape) - (np.array(cut.cells.shape)[:, None, None] - 1) / 2
    r = np.hypot(x, y) * (cut.extent[1] - cut.extent[0]) / cut.cells.shape[1]
    assert np.nanmax(cut.cells) == pytest.approx(0.7, abs=1e-3)
    assert np.nanmax(cut.cells[(r > 1.69) | (r < 0.31)]) < 0.12
    assert np.isnan(cut.cells[(r > 1.72) | (r < 0.28)]).all()
    assert not np.isnan(cut.cells[(r < 1.68) & (r > 0.32)]).any()


def test_a_robot_without_factors_has_its_joint_limit_curves_only() -> None:
    bare = replace(ROBOTS["rrt_offset"], factors=())
    assert {curve.name for curve in section(bare).curves} == {LIMITS}


@pytest.mark.parametrize("scale", [1e-6, 1e6])
@pytest.mark.parametrize("name", ["rrt_offset", "puma560", "articulated_6r"])
def test_the_unit_of_length_decides_nothing(name: str, scale: float) -> None:
    robot, cut = ROBOTS[name], SECTIONS[name]
    limits = tuple(
        (scale * low, scale * high) if kind == "P" else (low, high)
        for (low, high), kind in zip(robot.limits, robot.kinds, strict=True)
    )
    other = replace(
        robot,
        parameters={key: scale * value for key, value in robot.parameters.items()},
        limits=limits,
    )
    again = section(other)
    assert arm(other).point == arm(robot).point
    np.testing.assert_allclose(np.divide(reach(other), scale), reach(robot), rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.divide(again.extent, scale), cut.extent, rtol=0, atol=1e-6)
    assert np.count_nonzero(np.isnan(again.cells) != np.isnan(cut.cells)) <= 0.001 * cut.cells.size
    for curve, twin in zip(again.curves, cut.curves, strict=True):
        assert curve.name == twin.name
        np.testing.assert_allclose(curve.points / scale, twin.points, rtol=0, atol=1e-6)
        assert np.count_nonzero(curve.boundary != twin.boundary) <= 3


@pytest.mark.parametrize("of", ["axis 1", "base"])
@pytest.mark.parametrize("name", ROBOTS)
def test_no_configuration_gets_past_the_reach(name: str, of: From) -> None:
    """Random configurations, each climbed from by small steps within the limits."""
    robot = ROBOTS[name]
    part = arm(robot)
    low, high = np.transpose(part.limits)
    rng = np.random.default_rng(5)
    near, far = reach(robot, of=of)
    for sign in (1.0, -1.0):
        q, step = rng.uniform(low, high, (400, part.chain.n)), 0.3
        value = sign * _distances(part, q, of)
        for _ in range(60):
            tried = np.clip(q + step * rng.normal(size=q.shape) * (high - low), low, high)
            there = sign * _distances(part, tried, of)
            better = there > value
            q, value = np.where(better[:, None], tried, q), np.maximum(there, value)
            step *= 0.93
        assert value.max() <= (far if sign > 0 else -near) + 1e-9


def _distances(part: RegionalArm, q: Values, of: From) -> Values:
    if of == "axis 1":
        return meridian(part.chain, q)[..., 0]
    return np.linalg.norm(forward(part.chain, q)[..., :3, 3], axis=-1)


@pytest.mark.parametrize(
    ("of", "q", "at_least"),
    [
        (
            "base",
            (0.057207, -0.255376, 0, -0.467002, 0, 2.956401, 0.635763),
            1.280046,
        ),
        ("axis 1", None, 0.947046),
    ],
)
def test_the_panda_gets_as_far_as_a_posture_that_was_found_elsewhere(
    of: From, q: tuple[float, ...] | None, at_least: float
) -> None:
    _, far = reach(ROBOTS["panda"], of=of)
    assert far >= at_least
    if q is not None:
        assert far >= _distances(arm(ROBOTS["panda"]), np.array(q), of) - 1e-9


@pytest.mark.parametrize("seed", range(8))
def test_the_reach_of_an_arm_with_other_lengths_is_not_too_small(seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = ROBOTS["panda"]
    lengths = {name: value * rng.uniform(0.6, 1.4) for name, value in robot.parameters.items()}
    _, far = reach(robot, lengths, of="base")
    part = arm(robot, lengths)
    low, high = np.transpose(part.limits)
    q = rng.uniform(low, high, (20_000, part.chain.n))
    q = q[np.argsort(_distances(part, q, "base"))[-50:]]
    for _ in range(400):
        tried = np.clip(q + 0.03 * rng.normal(size=q.shape), low, high)
        better = _distances(part, tried, "base") > _distances(part, q, "base")
        q = np.where(better[:, None], tried, q)
    farthest = _distances(part, q, "base").max()
    assert 0.99 * far <= farthest <= far + 1e-12


@pytest.mark.parametrize("name", ["planar_2r", "rrt_offset", "puma560", "stanford", "three_axis"])
def test_the_bound_holds_and_is_tight_where_few_joints_change_the_distance(name: str) -> None:
    found = bounded_reach(ROBOTS[name])
    assert (found.near, found.far) == reach(ROBOTS[name])
    assert 0 <= found.error < 1e-3 * found.far


def test_a_reach_that_is_not_proven_says_so() -> None:
    found = bounded_reach(ROBOTS["panda"])
    assert found.error > 0.005 * found.far
    assert "as far as a search" in describe(ROBOTS["panda"])
    assert "as far as a search" not in describe(ROBOTS["puma560"])
