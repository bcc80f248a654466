"""Ellipsoids, lost directions and the inverse condition number of Jacobian blocks."""

import numpy as np
import pytest
from kinegrade.solutions.ellipsoids import (
    Ellipsoid,
    force_ellipsoid,
    inverse_condition,
    lost_directions,
    velocity_ellipsoid,
)
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS, Robot
from kinegrade.solutions.singularity import (
    SingularityError,
    factor_values,
    manipulability,
    zero_set,
)
from numpy.typing import NDArray

every = pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))


def _blocks(robot: Robot, count: int = 20) -> NDArray[np.float64]:
    low, high = np.transpose(robot.limits)
    q = np.random.default_rng(8).uniform(low, high, (count, robot.n))
    return jacobian(robot.chain(), q)[:, list(robot.task_rows)]


@pytest.mark.parametrize("shape", [(3, 3), (3, 6), (6, 3), (4, 5, 3, 6), (0, 3, 3), (1, 1)])
@pytest.mark.parametrize("made", [velocity_ellipsoid, force_ellipsoid])
def test_axes_and_lengths_keep_the_batch_and_come_largest_first(
    made, shape: tuple[int, ...]
) -> None:
    found: Ellipsoid = made(np.random.default_rng(1).normal(size=shape))
    m = shape[-2]
    assert found.axes.shape == (*shape[:-2], m, m)
    assert found.lengths.shape == (*shape[:-2], m)
    assert (found.lengths[..., 1:] <= found.lengths[..., :-1]).all()
    square = found.axes.swapaxes(-1, -2) @ found.axes
    np.testing.assert_allclose(square, np.broadcast_to(np.eye(m), square.shape), atol=1e-14)


@every
def test_the_velocity_ellipsoid_is_that_of_j_jt(robot: Robot) -> None:
    J = _blocks(robot)
    found = velocity_ellipsoid(J)
    rebuilt = found.axes * found.lengths[:, None] ** 2 @ found.axes.swapaxes(1, 2)
    np.testing.assert_allclose(rebuilt, J @ J.swapaxes(1, 2), atol=1e-12)
    np.testing.assert_allclose(found.volume, manipulability(J), rtol=1e-9)


@every
def test_unit_joint_rates_end_inside_or_on_the_velocity_ellipsoid(robot: Robot) -> None:
    J = _blocks(robot)
    rates = np.random.default_rng(9).normal(size=(20, robot.n, 1))
    v = (J @ (rates / np.linalg.norm(rates, axis=1, keepdims=True)))[..., 0]
    found = velocity_ellipsoid(J)
    inside = ((found.axes.swapaxes(1, 2) @ v[..., None])[..., 0] / found.lengths) ** 2
    assert (inside.sum(axis=1) <= 1 + 1e-9).all()
    if robot.n == len(robot.task_rows):
        np.testing.assert_allclose(inside.sum(axis=1), 1, rtol=1e-6)


@every
def test_forces_on_the_force_ellipsoid_ask_for_unit_torques(robot: Robot) -> None:
    J, m = _blocks(robot), len(robot.task_rows)
    directions = np.random.default_rng(10).normal(size=(7, m))
    forces = force_ellipsoid(J).surface(
        directions / np.linalg.norm(directions, axis=1, keepdims=True)
    )
    assert forces.shape == (20, 7, m)
    np.testing.assert_allclose(np.linalg.norm(forces @ J, axis=-1), 1, rtol=1e-9)


def test_where_the_arm_is_fast_it_is_weak() -> None:
    J = _blocks(ROBOTS["three_axis"])
    fast, strong = velocity_ellipsoid(J), force_ellipsoid(J)
    np.testing.assert_allclose(strong.lengths, 1 / fast.lengths[:, ::-1])
    np.testing.assert_array_equal(strong.axes, fast.axes[..., ::-1])


def test_the_stretched_planar_arm_loses_the_direction_it_points_in() -> None:
    q1 = 0.3
    J = jacobian(ROBOTS["planar_2r"].chain(), [q1, 0.0])[:2]
    (lost,) = lost_directions(J)
    np.testing.assert_allclose(np.abs(lost @ [np.cos(q1), np.sin(q1)]), 1, rtol=1e-14)
    held = force_ellipsoid(J)
    assert np.isinf(held.lengths).tolist() == [True, False]
    np.testing.assert_allclose(np.abs(held.axes[:, 0] @ lost), 1, rtol=1e-14)
    assert velocity_ellipsoid(J).lengths[1] < 1e-15


@pytest.mark.parametrize(
    ("robot", "name"),
    [pytest.param(r, f.name, id=f"{r.name}-{f.name}") for r in ROBOTS.values() for f in r.factors],
)
def test_on_every_singular_set_a_lost_direction_is_normal_to_all_columns(
    robot: Robot, name: str
) -> None:
    at = np.array([0.3, -0.4, 0.6, 0.5, 0.9, 0.2])[: robot.n]
    line = next(
        lines[0]
        for pair in ((0, 1), (1, 2), (3, 4))
        if pair[1] < robot.n
        and (lines := zero_set(robot, name, free=pair, at=at, ranges=[(-3.2, 3.2)] * 2, count=61))
    )
    pair = next(
        p
        for p in ((0, 1), (1, 2), (3, 4))
        if p[1] < robot.n and _vanishes(robot, name, at, p, line[3])
    )
    at[list(pair)] = line[3]
    J = jacobian(robot.chain(), at)[list(robot.task_rows)]
    lost = lost_directions(J)
    assert len(lost) >= 1
    assert np.abs(lost @ J).max() < 1e-9
    np.testing.assert_allclose(lost @ lost.T, np.eye(len(lost)), atol=1e-14)


def _vanishes(
    robot: Robot, name: str, at: NDArray[np.float64], pair: tuple[int, int], values
) -> bool:
    q = at.copy()
    q[list(pair)] = values
    return abs(float(factor_values(robot, None, q)[name])) < 1e-11


def test_a_regular_block_loses_nothing_and_a_zero_block_everything() -> None:
    assert lost_directions(np.eye(3)).shape == (0, 3)
    assert lost_directions(np.zeros((3, 4))).shape == (3, 3)
    assert np.isinf(force_ellipsoid(np.zeros((3, 4))).lengths).all()


def test_a_tall_block_loses_the_directions_it_has_no_joints_for() -> None:
    J = jacobian(ROBOTS["rrt_spherical"].chain(), [0.2, 0.7, 0.5])
    lost = lost_directions(J)
    assert lost.shape == (3, 6)
    assert np.abs(lost @ J).max() < 1e-14
    assert np.count_nonzero(velocity_ellipsoid(J).lengths) == 3


def test_the_tolerance_of_lost_directions_is_a_share_of_the_largest_singular_value() -> None:
    J = np.diag([100.0, 1.0, 1e-5])
    assert len(lost_directions(J)) == 0
    assert len(lost_directions(J, tolerance=1e-6)) == 1
    assert len(lost_directions(J, tolerance=0.1)) == 2


def test_a_stack_of_blocks_is_refused_by_lost_directions_with_a_sentence() -> None:
    with pytest.raises(
        SingularityError, match=r"one block of shape \(m, n\), got shape \(2, 3, 3\)"
    ):
        lost_directions(np.ones((2, 3, 3)))


def test_the_inverse_condition_is_one_where_isotropic_and_zero_where_singular() -> None:
    blocks = np.array([5 * np.eye(2), np.diag([4.0, 1.0]), np.diag([1.0, 0.0]), np.zeros((2, 2))])
    np.testing.assert_allclose(inverse_condition(blocks), [1, 0.25, 0, 0])


def test_the_inverse_condition_does_not_grow_with_the_arm_but_manipulability_does() -> None:
    q, robot = [0.2, 1.0], ROBOTS["planar_2r"]
    small, large = (jacobian(robot.chain({"l1": s, "l2": 0.7 * s}), q)[:2] for s in (1.0, 3.0))
    np.testing.assert_allclose(inverse_condition(small), inverse_condition(large))
    np.testing.assert_allclose(9 * manipulability(small), manipulability(large))


def test_the_planar_arm_is_isotropic_where_the_literature_has_it() -> None:
    """With l1 = sqrt(2) l2 at q2 = 135 degrees (Salisbury and Craig, 1982)."""
    J = jacobian(ROBOTS["planar_2r"].chain({"l1": np.sqrt(2), "l2": 1.0}), [0.4, 0.75 * np.pi])[:2]
    assert float(inverse_condition(J)) == pytest.approx(1, rel=1e-12)


def test_the_inverse_condition_of_a_tall_block_is_refused_with_a_sentence() -> None:
    with pytest.raises(SingularityError, match="at most as many rows as columns, got 6 x 3"):
        inverse_condition(np.ones((6, 3)))


@pytest.mark.parametrize(
    "made", [velocity_ellipsoid, force_ellipsoid, inverse_condition, lost_directions]
)
def test_a_block_that_is_no_finite_matrix_is_refused_with_a_sentence(made) -> None:
    with pytest.raises(SingularityError, match="finite"):
        made([[np.nan, 1.0]])
    with pytest.raises(SingularityError, match=r"shape"):
        made([1.0, 2.0])
