"""SE(3): logarithm and exponential undo each other, the adjoint carries twists along."""

import numpy as np
import pytest
from kinegrade.solutions.chain import ChainError
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.poses import adjoint, pose_exp, pose_log, rotation_vector_map
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.rotation import vector_rotation
from scipy.linalg import expm

RNG = np.random.default_rng(2)


def cross(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def generator(xi):
    matrix = np.zeros((4, 4))
    matrix[:3, :3], matrix[:3, 3] = cross(xi[3:]), xi[:3]
    return matrix


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-5, 0.0099, 0.0101, 1.0, 3.0, 3.14159])
def test_the_exponential_is_that_of_the_matrix_and_the_logarithm_undoes_it(angle):
    axis = np.array([0.6, -0.0, 0.8])
    xi = np.concatenate([[0.3, -1.2, 0.7], angle * axis])
    T = pose_exp(xi)
    np.testing.assert_allclose(T, expm(generator(xi)), atol=1e-14)
    np.testing.assert_allclose(pose_log(T), xi, atol=1e-9)


def test_batches_keep_their_shape():
    xi = RNG.uniform(-1, 1, (2, 5, 6))
    np.testing.assert_allclose(pose_log(pose_exp(xi)), xi, atol=1e-12)
    assert adjoint(pose_exp(xi)).shape == (2, 5, 6, 6)


def test_the_adjoint_takes_a_twist_of_the_tool_to_the_one_at_the_base_origin():
    chain = ROBOTS["puma560"].chain()
    q = RNG.uniform(-1, 1, (4, 6))
    body, spatial = jacobian(chain, q, "tool"), jacobian(chain, q, point="origin")
    np.testing.assert_allclose(adjoint(forward(chain, q)) @ body, spatial, atol=1e-12)


def test_the_adjoint_of_a_product_is_the_product():
    A, B = pose_exp(RNG.uniform(-1, 1, 6)), pose_exp(RNG.uniform(-1, 1, 6))
    np.testing.assert_allclose(adjoint(A @ B), adjoint(A) @ adjoint(B), atol=1e-12)


@pytest.mark.parametrize("angle", [0.0, 1e-4, 0.5, 2.0, 3.0])
def test_the_map_of_rotation_vector_rates_is_the_derivative(angle):
    w, step = angle * np.array([2, -1, 2]) / 3, 1e-6
    rates = np.array([0.3, -0.2, 0.5])
    moved = [vector_rotation(w + sign * step * rates) for sign in (1, -1)]
    turning = (moved[0] - moved[1]) / (2 * step) @ vector_rotation(w).T
    omega = np.array([turning[2, 1], turning[0, 2], turning[1, 0]])
    np.testing.assert_allclose(rotation_vector_map(w) @ rates, omega, atol=1e-8)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: pose_log(np.eye(3)), r"transform takes shape \(..., 4, 4\)"),
        (lambda: pose_log(2 * np.eye(4)), "takes the last row"),
        (lambda: pose_exp([1, 2, 3]), r"twist takes shape \(..., 6\)"),
        (lambda: rotation_vector_map([1, 2]), r"vector takes shape \(..., 3\)"),
    ],
)
def test_what_is_no_pose_is_refused_with_a_sentence(call, sentence):
    with pytest.raises(ChainError, match=sentence):
        call()
