"""Derivatives of the Jacobian against golden numbers and finite differences."""

from typing import Any, Literal

import numpy as np
import pytest
from kinegrade.solutions.chain import Array, Chain, ChainError
from kinegrade.solutions.derivatives import hessian, jacobian_dot, manipulability_gradient
from kinegrade.solutions.jacobian import in_axes, jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.rotation import vector_rotation
from kinegrade.solutions.singularity import manipulability
from test_golden import GOLDEN, chain_of, column

Frame = Literal["base", "tool"]
STEP = 1e-3
PUMA = ROBOTS["puma560"].chain()
frames = pytest.mark.parametrize("frame", ["base", "tool"])
robots = pytest.mark.parametrize("name", ROBOTS)


def some(name: str, count: int = 4) -> tuple[Chain, Array, Array]:
    robot, rng = ROBOTS[name], np.random.default_rng(5)
    low, high = np.array(robot.limits).T
    return (
        robot.chain(),
        rng.uniform(low, high, (count, robot.n)),
        rng.normal(size=(count, robot.n)),
    )


def slope(chain: Chain, q: Array, direction: Array, frame: Frame) -> Array:
    at = [jacobian(chain, q + k * STEP * direction, frame) for k in (-2, -1, 1, 2)]
    return (at[0] - 8 * at[1] + 8 * at[2] - at[3]) / (12 * STEP)


@pytest.mark.parametrize("name", GOLDEN)
def test_the_time_derivative_agrees_with_the_golden_one(name: str):
    expected = column(name, "jacob0_dot")
    values = jacobian_dot(chain_of(name), column(name, "q"), column(name, "qd"))
    np.testing.assert_allclose(
        values, expected, rtol=0, atol=1e-13 * max(1, np.abs(expected).max())
    )


@robots
@frames
def test_the_hessian_agrees_with_finite_differences(name: str, frame: Frame):
    chain, q, _ = some(name)
    H = hessian(chain, q, frame)
    for k in range(chain.n):
        np.testing.assert_allclose(
            H[..., k], slope(chain, q, np.eye(chain.n)[k], frame), rtol=0, atol=2e-10
        )


@robots
@frames
def test_the_time_derivative_agrees_with_finite_differences(name: str, frame: Frame):
    chain, q, qdot = some(name)
    np.testing.assert_allclose(
        jacobian_dot(chain, q, qdot, frame), slope(chain, q, qdot, frame), rtol=0, atol=5e-9
    )


@robots
@frames
def test_the_hessian_times_the_rates_is_the_time_derivative(name: str, frame: Frame):
    chain, q, qdot = some(name)
    product = (hessian(chain, q, frame) @ qdot[:, None, :, None])[..., 0]
    np.testing.assert_allclose(jacobian_dot(chain, q, qdot, frame), product, rtol=0, atol=1e-12)


@robots
def test_the_linear_rows_are_symmetric_and_the_angular_ones_strictly_lower(name: str):
    chain, q, _ = some(name)
    H = hessian(chain, q)
    np.testing.assert_array_equal(H[:, :3], H[:, :3].mT)
    assert not np.triu(H[:, 3:]).any()


def test_the_acceleration_is_the_second_derivative_of_the_position():
    chain, q, qdot = some("panda")
    qddot = np.random.default_rng(6).normal(size=q.shape)
    acceleration = (
        jacobian(chain, q) @ qddot[..., None] + jacobian_dot(chain, q, qdot) @ qdot[..., None]
    )[..., 0]
    at = [
        forward(chain, q + t * qdot + t**2 / 2 * qddot)[:, :3, 3]
        for t in (-2e-3, -1e-3, 0.0, 1e-3, 2e-3)
    ]
    expected = (-at[0] + 16 * at[1] - 30 * at[2] + 16 * at[3] - at[4]) / (12 * 1e-6)
    np.testing.assert_allclose(acceleration[:, :3], expected, rtol=0, atol=1e-7)


@frames
@pytest.mark.parametrize("shape", [(), (4,), (0,), (2, 3)])
def test_results_have_the_documented_shapes(frame: Frame, shape: tuple[int, ...]):
    q = np.full((*shape, 6), 0.3)
    assert hessian(PUMA, q, frame).shape == (*shape, 6, 6, 6)
    assert jacobian_dot(PUMA, q, q, frame).shape == (*shape, 6, 6)


@frames
def test_configurations_and_rates_broadcast(frame: Frame):
    q, qdot = np.full(6, 0.3), np.random.default_rng(7).normal(size=(4, 6))
    together = jacobian_dot(PUMA, q, qdot, frame)
    np.testing.assert_allclose(
        together[2], jacobian_dot(PUMA, q, qdot[2], frame), rtol=0, atol=1e-14
    )
    assert jacobian_dot(PUMA, qdot, q, frame).shape == (4, 6, 6)


@pytest.mark.parametrize("frame", ["world", "Base"])
def test_other_frames_are_refused_with_a_sentence(frame: Any):
    for call in (
        lambda: hessian(PUMA, np.zeros(6), frame),
        lambda: jacobian_dot(PUMA, [0] * 6, [0] * 6, frame),
    ):
        with pytest.raises(ChainError, match="frame takes 'base' or 'tool', got"):
            call()


def test_rates_that_do_not_fit_are_refused_with_a_sentence():
    with pytest.raises(ChainError, match=r"qdot takes shape \(\.\.\., 6\), got \(5,\)"):
        jacobian_dot(PUMA, np.zeros(6), np.zeros(5))
    with pytest.raises(ChainError, match=r"qdot takes as many rows as q, \(2,\), got \(3,\)"):
        jacobian_dot(PUMA, np.zeros((2, 6)), np.zeros((3, 6)))


@robots
def test_derivatives_for_another_point_of_the_tool_agree_with_finite_differences(name: str):
    chain, q, qdot = some(name)
    tool = np.array([0.2, -0.1, 0.3])

    def there(x: Array) -> Array:
        T = forward(chain, x)
        return T[..., :3, 3] + T[..., :3, :3] @ tool

    for k in range(chain.n):
        step = 1e-6 * np.eye(chain.n)[k]
        sides = [jacobian(chain, q + s * step, point=there(q + s * step)) for s in (1, -1)]
        expected = (sides[0] - sides[1]) / 2e-6
        found = hessian(chain, q, point=there(q))[..., k]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8)
    H = hessian(chain, q, point=there(q))
    product = (H @ qdot[:, None, :, None])[..., 0]
    np.testing.assert_allclose(
        jacobian_dot(chain, q, qdot, point=there(q)), product, rtol=0, atol=1e-12
    )


@robots
def test_derivatives_in_axes_that_stand_still_are_turned_columns(name: str):
    chain, q, qdot = some(name)
    R = vector_rotation([0.3, -0.5, 0.7])
    H, turned = hessian(chain, q), hessian(chain, q, R)
    for k in range(chain.n):
        np.testing.assert_allclose(turned[..., k], in_axes(H[..., k], R), rtol=0, atol=1e-12)
    rates = in_axes(jacobian_dot(chain, q, qdot), R)
    np.testing.assert_allclose(jacobian_dot(chain, q, qdot, R), rates, rtol=0, atol=1e-12)


def test_the_origin_is_no_point_that_moves_with_the_tool():
    with pytest.raises(ChainError, match=r"point takes coordinates .* of a point of the tool"):
        hessian(PUMA, np.zeros(6), point="origin")


@robots
def test_the_gradient_of_manipulability_agrees_with_finite_differences(name: str):
    chain, q, _ = some(name)
    rows = ROBOTS[name].task_rows
    gradient = manipulability_gradient(chain, q, rows)
    for k in range(chain.n):
        step = 1e-6 * np.eye(chain.n)[k]
        sides = [manipulability(jacobian(chain, q + s * step)[..., rows, :]) for s in (1, -1)]
        np.testing.assert_allclose(gradient[..., k], (sides[0] - sides[1]) / 2e-6, atol=1e-6)


def test_the_gradient_of_more_rows_than_joints_is_refused():
    with pytest.raises(ChainError, match="rows takes up to 2 rows, one for each joint, got 6"):
        manipulability_gradient(ROBOTS["planar_2r"].chain(), [0.1, 0.2])
