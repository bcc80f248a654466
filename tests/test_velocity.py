"""Twists and joint rates, with the numbers of S3's problem 5.4.2 in all its readings."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import ChainError
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.rotation import vector_rotation
from kinegrade.solutions.velocity import (
    damped_inverse,
    joint_rates,
    null_projector,
    pseudoinverse,
    twist,
)

PUMA = ROBOTS["puma560"].chain()
Q = (0.1, 0.5, 0.1, 0.8, 0.1, 0.2)
QDOT = (1, 1.4, 1.7, 0.2, 0.3, 0.1)
ALONG_X = (2, 0, 0, 0, 0, 0)
WHOLE, LINEAR, VX = slice(None), slice(0, 3), [0]


def test_s3_problem_2b_the_twist_in_base_axes():
    expected = [-1.2888508, 0.0233280, -0.1733645, 0.3338177, -3.2993304, 1.3647759]
    np.testing.assert_allclose(twist(PUMA, Q, QDOT), expected, rtol=0, atol=5.1e-8)


def test_s3_problem_2b_the_twist_in_tool_axes_as_jacobn_gives_it():
    expected = [-0.4358, 1.0413, 0.6462, -2.2538, -2.4662, 1.3029]
    np.testing.assert_allclose(twist(PUMA, Q, QDOT, "tool"), expected, rtol=0, atol=5.1e-5)


@pytest.mark.parametrize(
    ("rows", "frame", "expected", "digit"),
    [
        (
            WHOLE,
            "base",
            [-1.3146195, -2.6644359, -1.7822710, -25.5529862, 3.6305368, 26.7717356],
            1e-7,
        ),
        (LINEAR, "base", [-1.3146195, -2.6644359, -1.7822710, 0, 0, 0], 1e-7),
        (VX, "base", [0.56, -2.39, -1.53, 0, 0, 0], 1e-2),
        (WHOLE, "tool", [11.0, 2.59, -1.65, -45.7, -5.1, 36.8], 1e-1),
        (LINEAR, "tool", [11.034, 2.587, -1.651, 0, 0, 0], 1e-3),
        (VX, "tool", [3.244, -2.880, -4.020, 0, 0, 0], 1e-3),
    ],
)
def test_s3_problem_2c_in_each_of_its_readings(
    rows: Any, frame: Any, expected: list[float], digit: float
):
    rates = joint_rates(PUMA, Q, ALONG_X, rows, frame)
    np.testing.assert_allclose(rates, expected, rtol=0, atol=0.51 * digit)
    np.testing.assert_allclose(
        twist(PUMA, Q, rates, frame)[rows], np.array(ALONG_X)[rows], rtol=0, atol=1e-9
    )


def test_s3s_pose_is_near_singular():
    values = np.linalg.svd(jacobian(PUMA, Q), compute_uv=False)
    assert values[-1] == pytest.approx(0.0291, abs=5e-5)
    assert values[0] / values[-1] == pytest.approx(59, abs=0.5)


@pytest.mark.parametrize("frame", ["base", "tool"])
@pytest.mark.parametrize("rows", [WHOLE, LINEAR, VX, [0, 2], (5,)])
def test_the_stated_rows_alone_say_the_same_as_the_whole_twist(rows: Any, frame: Any):
    xi = np.array([0.3, -0.2, 0.5, 0.1, 0.7, -0.4])
    chosen = xi[rows if isinstance(rows, slice) else list(rows)]
    np.testing.assert_array_equal(
        joint_rates(PUMA, Q, chosen, rows, frame),
        joint_rates(PUMA, Q, xi, rows, frame),
        strict=True,
    )


@pytest.mark.parametrize("name", ROBOTS)
def test_rates_come_back_from_the_twist_they_make(name: str):
    robot = ROBOTS[name]
    rng = np.random.default_rng(2)
    low, high = np.array(robot.limits).T
    q, qdot = rng.uniform(low, high, (20, robot.n)), rng.normal(size=(20, robot.n))
    chain = robot.chain()
    made = twist(chain, q, qdot)
    assert made.shape == (20, 6)
    rates = joint_rates(chain, q, made, robot.task_rows)
    np.testing.assert_allclose(
        twist(chain, q, rates)[:, robot.task_rows], made[:, robot.task_rows], rtol=0, atol=1e-9
    )
    if robot.n == len(robot.task_rows):
        np.testing.assert_allclose(rates, qdot, rtol=0, atol=1e-7)
    else:
        assert (np.linalg.norm(rates, axis=-1) <= np.linalg.norm(qdot, axis=-1) + 1e-9).all()


def test_one_singular_configuration_spoils_no_batch():
    q = np.array([Q, np.zeros(6), Q])
    rates = joint_rates(PUMA, q, ALONG_X)
    np.testing.assert_allclose(
        rates[[0, 2]], [joint_rates(PUMA, Q, ALONG_X)] * 2, rtol=0, atol=1e-9
    )
    assert np.abs(rates[1]).max() < 100


def test_a_singular_configuration_gets_the_least_squares_rates_of_minimum_norm():
    J = jacobian(PUMA, np.zeros(6))
    expected = np.linalg.lstsq(J, np.array(ALONG_X), rcond=1e-10)[0]
    np.testing.assert_allclose(
        joint_rates(PUMA, np.zeros(6), ALONG_X), expected, rtol=0, atol=1e-10
    )


@pytest.mark.parametrize(
    ("q_shape", "other_shape", "batch"),
    [
        ((), (), ()),
        ((4,), (4,), (4,)),
        ((4,), (), (4,)),
        ((), (4,), (4,)),
        ((0,), (), (0,)),
        ((2, 1), (3,), (2, 3)),
    ],
)
def test_configurations_and_velocities_broadcast(q_shape: Any, other_shape: Any, batch: Any):
    q, other = np.full((*q_shape, 6), 0.3), np.full((*other_shape, 6), 0.1)
    assert twist(PUMA, q, other).shape == (*batch, 6)
    assert joint_rates(PUMA, q, other).shape == (*batch, 6)
    assert joint_rates(PUMA, q, other, LINEAR).shape == (*batch, 6)


def test_the_pseudoinverse_meets_the_four_penrose_conditions():
    rng = np.random.default_rng(3)
    for J in (rng.normal(size=(6, 7)), rng.normal(size=(6, 3)), jacobian(PUMA, np.zeros(6))):
        X = pseudoinverse(J)
        assert X.shape == J.T.shape
        for left, right in ((J @ X @ J, J), (X @ J @ X, X), ((J @ X).T, J @ X), ((X @ J).T, X @ J)):
            np.testing.assert_allclose(left, right, rtol=0, atol=1e-12)


def test_the_pseudoinverse_is_a_right_inverse_only_and_only_at_full_row_rank():
    J = np.random.default_rng(4).normal(size=(2, 6, 7))
    np.testing.assert_allclose(
        J @ pseudoinverse(J), np.broadcast_to(np.eye(6), (2, 6, 6)), rtol=0, atol=1e-12
    )
    np.testing.assert_allclose(pseudoinverse(J), J.mT @ np.linalg.inv(J @ J.mT), rtol=0, atol=1e-12)
    assert np.abs(pseudoinverse(J) @ J - np.eye(7)).max() > 0.01


def test_rates_and_twists_agree_in_any_axes_and_at_any_point():
    R, point = vector_rotation([0.3, -0.8, 0.5]), np.array([0.4, -0.2, 0.9])
    xi = twist(PUMA, Q, QDOT, R, point=point)
    np.testing.assert_allclose(
        xi, jacobian(PUMA, Q, R, point=point) @ np.array(QDOT), rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(
        joint_rates(PUMA, Q, xi, WHOLE, R, point=point), QDOT, rtol=0, atol=1e-11
    )
    at_origin = joint_rates(PUMA, Q, twist(PUMA, Q, QDOT, point="origin"), point="origin")
    np.testing.assert_allclose(at_origin, QDOT, rtol=0, atol=1e-11)


def test_damped_rates_are_those_of_the_formula_and_bounded_where_the_others_explode():
    J, near = jacobian(PUMA, Q), (0.1, 0.5, 0.1, 0.8, 1e-6, 0.2)
    expected = J.T @ np.linalg.solve(J @ J.T + 0.01 * np.eye(6), np.array(ALONG_X))
    np.testing.assert_allclose(
        joint_rates(PUMA, Q, ALONG_X, damping=0.1), expected, rtol=0, atol=1e-13
    )
    assert np.abs(joint_rates(PUMA, near, ALONG_X)).max() > 1e4
    assert np.linalg.norm(joint_rates(PUMA, near, ALONG_X, damping=0.1)) <= 2 / (2 * 0.1)


def test_damping_that_vanishes_leaves_the_rates_of_the_inverse():
    np.testing.assert_allclose(
        joint_rates(PUMA, Q, ALONG_X, damping=1e-9),
        joint_rates(PUMA, Q, ALONG_X),
        rtol=0,
        atol=1e-9,
    )


def test_damping_may_differ_from_configuration_to_configuration():
    q, damping = np.array([Q, np.zeros(6), Q]), np.array([0.1, 0.2, 0.3])
    rates = joint_rates(PUMA, q, ALONG_X, damping=damping)
    for k in range(3):
        np.testing.assert_allclose(
            rates[k], joint_rates(PUMA, q[k], ALONG_X, damping=damping[k]), rtol=0, atol=1e-14
        )
    assert damped_inverse(jacobian(PUMA, q), 0.1).shape == (3, 6, 6)
    assert joint_rates(PUMA, Q, ALONG_X, damping=damping).shape == (3, 6)


@pytest.mark.parametrize("damping", [0.0, 0.05])
def test_preferred_rates_move_none_of_the_stated_rows(damping: float):
    panda = ROBOTS["panda"].chain()
    q, preferred = np.linspace(-1, 1, 7) - 0.5, np.array([1.0, -1, 1, -1, 1, -1, 1])
    plain = joint_rates(panda, q, ALONG_X, damping=damping)
    rates = joint_rates(panda, q, ALONG_X, damping=damping, preferred=preferred)
    np.testing.assert_allclose(twist(panda, q, rates), twist(panda, q, plain), rtol=0, atol=1e-12)
    assert np.abs(rates - plain).max() > 0.1
    assert np.linalg.norm(rates - preferred) < np.linalg.norm(plain - preferred)
    three = joint_rates(panda, q, ALONG_X, LINEAR, preferred=preferred)
    np.testing.assert_allclose(twist(panda, q, three)[:3], ALONG_X[:3], rtol=0, atol=1e-12)


def test_the_null_projector_is_the_orthogonal_one():
    J = np.random.default_rng(5).normal(size=(4, 3, 7))
    N = null_projector(J)
    assert N.shape == (4, 7, 7)
    np.testing.assert_allclose(J @ N, 0, rtol=0, atol=1e-13)
    np.testing.assert_allclose(N @ N, N, rtol=0, atol=1e-13)
    np.testing.assert_allclose(N, N.mT, rtol=0, atol=1e-13)
    np.testing.assert_allclose(np.trace(N, axis1=-2, axis2=-1), 4, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: twist(PUMA, Q, QDOT[:5]), r"qdot takes shape \(\.\.\., 6\), got \(5,\)"),
        (
            lambda: twist(PUMA, [Q, Q], [QDOT] * 3),
            r"qdot takes as many rows as q, \(2,\), got \(3,\)",
        ),
        (lambda: joint_rates(PUMA, Q, (2, 0)), r"twist takes shape \(\.\.\., 6\), got \(2,\)"),
        (lambda: joint_rates(PUMA, Q, 2.0), r"twist takes shape \(\.\.\., 6\), got \(\)"),
        (lambda: joint_rates(PUMA, [Q, Q], [ALONG_X] * 3), r"twist takes as many rows as q"),
        (
            lambda: joint_rates(PUMA, Q, ALONG_X, [6]),
            r"rows takes some of the rows 0 to 5 of a twist, got \[6\]",
        ),
        (
            lambda: joint_rates(PUMA, Q, ALONG_X, damping=-0.1),
            "damping takes numbers above 0, got -0.1",
        ),
        (
            lambda: joint_rates(PUMA, [Q, Q], ALONG_X, damping=[0.1] * 3),
            "damping takes as many rows as q",
        ),
        (
            lambda: joint_rates(PUMA, Q, ALONG_X, preferred=[1.0]),
            r"preferred takes shape \(\.\.\., 6\), got \(1,\)",
        ),
        (
            lambda: joint_rates(PUMA, [Q, Q], ALONG_X, preferred=[Q] * 3),
            "preferred takes as many rows as q",
        ),
        (lambda: damped_inverse(np.eye(3), 0.0), "damping takes numbers above 0, got 0.0"),
        (lambda: pseudoinverse(np.full((2, 2), np.nan)), "J takes finite numbers"),
        (lambda: null_projector(np.zeros(3)), r"J takes shape \(\.\.\., m, n\), got \(3,\)"),
        (
            lambda: joint_rates(PUMA, Q, ALONG_X, []),
            r"rows takes some of the rows 0 to 5 of a twist, got \[\]",
        ),
    ],
)
def test_wrong_input_is_refused_with_a_sentence(call: Callable[[], object], sentence: str):
    with pytest.raises(ChainError, match=sentence):
        call()
