"""Singular values and ranks, and the zero set of every factor of every robot."""

import numpy as np
import pytest
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS, Robot
from kinegrade.solutions.singularity import (
    SingularityError,
    arm,
    factor_values,
    manipulability,
    rank,
    sigma_min,
    singular_values,
    task_block,
    trace,
    zero_set,
)
from numpy.typing import ArrayLike, NDArray

ELBOW = "elbow: arm straight or folded"
FACTORED = [robot for robot in ROBOTS.values() if robot.factors]
factored = pytest.mark.parametrize("robot", FACTORED, ids=lambda robot: robot.name)
PAIRS = [(robot, factor.name) for robot in ROBOTS.values() for factor in robot.factors]


def _random(robot: Robot, count: int) -> NDArray[np.float64]:
    low, high = np.transpose(robot.limits)
    return np.random.default_rng(5).uniform(low, high, (count, robot.n))


def _shoulder() -> str:
    return next(f.name for f in ROBOTS["puma560"].factors if f.name.startswith("shoulder"))


@pytest.mark.parametrize(
    ("shape", "expected"),
    [((2, 2), (2,)), ((7, 3, 6), (7, 3)), ((5, 4, 6, 3), (5, 4, 3)), ((0, 3, 3), (0, 3))],
)
def test_singular_values_keep_the_batch_and_come_largest_first(
    shape: tuple[int, ...], expected: tuple[int, ...]
) -> None:
    values = singular_values(np.random.default_rng(1).normal(size=shape))
    assert values.shape == expected
    assert (np.diff(values, axis=-1) <= 0).all()


def test_sigma_min_of_the_planar_arm_is_det_over_sigma_max() -> None:
    robot = ROBOTS["planar_2r"]
    block = task_block(arm(robot), _random(robot, 50))
    np.testing.assert_allclose(
        sigma_min(block), np.abs(np.linalg.det(block)) / singular_values(block)[:, 0]
    )


def test_rank_counts_what_is_above_its_tolerance() -> None:
    scales = np.array([1.0, 1e-8, 1e-10, 0.0])
    blocks = np.array([np.diag([2.0, 1.0, s]) for s in scales])
    assert rank(blocks).tolist() == [3, 3, 2, 2]
    assert rank(blocks, tolerance=1e-7).tolist() == [3, 2, 2, 2]
    assert rank(np.zeros((3, 3))) == 0


def test_manipulability_is_yoshikawas_root() -> None:
    J = np.random.default_rng(2).normal(size=(9, 3, 6))
    np.testing.assert_allclose(manipulability(J), np.sqrt(np.linalg.det(J @ J.swapaxes(1, 2))))


def test_manipulability_of_a_tall_block_is_refused_with_a_sentence() -> None:
    with pytest.raises(SingularityError, match="at most as many rows as columns, got 6 x 3"):
        manipulability(jacobian(ROBOTS["rrt_spherical"].chain(), np.zeros(3)))


@pytest.mark.parametrize(
    ("block", "sentence"), [([1.0, 2.0], r"shape \(2,\)"), ([[np.nan, 1.0]], "finite")]
)
def test_a_block_that_is_no_finite_matrix_is_refused_with_a_sentence(
    block: ArrayLike, sentence: str
) -> None:
    with pytest.raises(SingularityError, match=sentence):
        sigma_min(block)


@factored
def test_the_factors_multiply_to_the_determinant_up_to_a_constant(robot: Robot) -> None:
    q = _random(robot, 40)
    values = factor_values(robot, None, q)
    product = np.prod([values[f.name] ** f.power for f in robot.factors], axis=0)
    ratio = np.linalg.det(jacobian(robot.chain(), q)[:, robot.task_rows]) / product
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-8)


@factored
def test_the_arms_factors_multiply_to_the_determinant_of_its_block(robot: Robot) -> None:
    part = arm(robot)
    q = _random(robot, 40)
    values = factor_values(robot, None, q)
    product = np.prod([values[f.name] ** f.power for f in part.factors], axis=0)
    ratio = np.linalg.det(task_block(part, q[:, : part.chain.n])) / product
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-8)


@pytest.mark.parametrize(
    ("robot", "name"), PAIRS, ids=[f"{robot.name}-{name}" for robot, name in PAIRS]
)
def test_on_a_zero_set_the_task_block_has_lost_a_rank(robot: Robot, name: str) -> None:
    free = next(
        pair
        for pair in ((0, 1), (1, 2), (3, 4))
        if pair[1] < robot.n and zero_set(robot, name, free=pair, ranges=[(-3.2, 3.2)] * 2)
    )
    at = np.array([0.3, -0.4, 0.6, 0.5, 0.9, 0.2])[: robot.n]
    for line in zero_set(robot, name, free=free, at=at, ranges=[(-3.2, 3.2)] * 2):
        q = np.tile(at, (len(line), 1))
        q[:, free] = line
        assert np.abs(factor_values(robot, None, q)[name]).max() < 1e-11
        block = jacobian(robot.chain(), q)[:, robot.task_rows]
        assert (rank(block) < len(robot.task_rows)).all()


def test_both_lines_of_the_pumas_elbow_run_over_all_of_q2() -> None:
    lines = zero_set(ROBOTS["puma560"], ELBOW)
    assert len(lines) == 2
    for line, degrees in zip(sorted(lines, key=lambda v: v[0, 1]), (-87.308, 92.692), strict=True):
        np.testing.assert_allclose(np.degrees(line[:, 1]), degrees, atol=5e-4)
        assert np.ptp(line[:, 1]) < 1e-11
        assert line[:, 0].min() == -np.pi
        assert line[:, 0].max() == np.pi
        assert np.diff(np.sort(line[:, 0])).max() < 2 * np.pi / 300


def test_the_pumas_shoulder_curve_is_traced_apart_from_the_folded_elbow() -> None:
    """It runs beside the elbow's line for half a turn, half a millimetre of arm apart, and never along it."""
    p = ROBOTS["puma560"].parameters
    points = np.concatenate(zero_set(ROBOTS["puma560"], _shoulder(), count=721))
    x, y = points.T
    exact = np.arctan2(
        p["a2"] + p["a3"] * np.cos(y) - p["d4"] * np.sin(y),
        p["a3"] * np.sin(y) + p["d4"] * np.cos(y),
    )
    apart = (x - exact) % np.pi
    assert np.minimum(apart, np.pi - apart).max() < 1e-8
    near = np.abs(np.degrees(y) - 92.692) < 1
    assert np.ptp(x[near]) > np.pi
    elbow = p["a3"] * np.sin(y) + p["d4"] * np.cos(y)
    assert (np.abs(elbow[np.abs(np.cos(x)) > 0.1]) > 1e-6).all()


def test_a_zero_on_the_rim_of_the_plane_is_found() -> None:
    lines = zero_set(ROBOTS["planar_2r"], ELBOW, free=(0, 1))
    assert sorted(round(float(line[0, 1]), 9) for line in lines) == [-3.141592654, 0.0, 3.141592654]


def test_lines_that_cross_are_traced_up_to_the_crossing_and_beyond() -> None:
    """In the cell of the crossing the traced lines may turn from one to the other, on roots all the same."""
    lines = trace(lambda x, y: (x - 0.1) * (y + 0.2), (-1.0, 1.0), (-1.0, 1.0), 41)
    points = np.concatenate(lines)
    for k, root in ((0, 0.1), (1, -0.2)):
        on_line = np.abs(points[:, k] - root) < 1e-11
        along = np.sort(points[on_line, 1 - k])
        assert (along[0], along[-1]) == (-1.0, 1.0)
        assert np.diff(along).max() <= 0.05 + 1e-9
        points = points[~on_line]
    assert len(points) == 0


def test_a_circle_comes_back_closed_and_a_pole_is_no_zero() -> None:
    (circle,) = trace(lambda x, y: x**2 + y**2 - 0.5, (-1.0, 1.0), (-1.0, 1.0), 61)
    np.testing.assert_allclose(np.linalg.norm(circle, axis=1), np.sqrt(0.5))
    np.testing.assert_array_equal(circle[0], circle[-1])
    assert trace(lambda x, y: 1 / (x - 0.137) + 0 * y, (-1.0, 1.0), (-1.0, 1.0), 61) == ()


def test_other_parameters_move_the_curve() -> None:
    (line,) = zero_set(
        ROBOTS["rrt_offset"],
        ROBOTS["rrt_offset"].factors[1].name,
        {"a1": 0.3},
        ranges=[(-3.0, 0.0), (0.2, 1.0)],
    )
    np.testing.assert_allclose(np.sin(line[:, 0]), -0.3 / line[:, 1], rtol=1e-9)


def test_the_arm_of_the_puma_ends_at_the_wrist_centre() -> None:
    part = arm(ROBOTS["puma560"])
    q = _random(ROBOTS["puma560"], 20)
    assert (part.point, part.chain.kinds, len(part.factors)) == ("wrist centre", "RRR", 2)
    np.testing.assert_allclose(
        task_block(part, q[:, :3]), jacobian(ROBOTS["puma560"].chain(), q)[:, :3, :3], atol=1e-14
    )


def test_an_unknown_factor_is_refused_with_the_valid_ones() -> None:
    with pytest.raises(SingularityError, match=r"elbow: arm straight or folded.*got 'knee'"):
        zero_set(ROBOTS["planar_2r"], "knee")


def test_a_plane_of_one_joint_is_refused_with_a_sentence() -> None:
    with pytest.raises(SingularityError, match="two different joints of 0 to 1"):
        zero_set(ROBOTS["planar_2r"], ELBOW, free=(1, 1))


def test_a_configuration_of_the_wrong_length_is_refused_with_a_sentence() -> None:
    with pytest.raises(SingularityError, match=r"\(\.\.\., 2\) for planar_2r, got \(3,\)"):
        factor_values(ROBOTS["planar_2r"], None, [0.0, 1.0, 2.0])
