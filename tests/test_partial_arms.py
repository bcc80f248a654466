"""Jacobians of frames in between and of one seen from another; an arm with a joint held."""

import numpy as np
import pytest
from kinegrade.solutions.chain import ChainError
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.partial_arms import frame_jacobian, relative_jacobian, with_held_joint
from kinegrade.solutions.robots import ROBOTS

robots = pytest.mark.parametrize("name", ROBOTS)
STEP = 1e-6


def differences(pose, q):
    """Jacobian (6, n) of a pose (4, 4) by central differences."""
    columns = []
    for axis in np.eye(len(q)):
        moved = [pose(q + sign * STEP * axis) for sign in (1, -1)]
        rate = (moved[0] - moved[1]) / (2 * STEP)
        turning = rate[:3, :3] @ pose(q)[:3, :3].T
        columns.append([*rate[:3, 3], turning[2, 1], turning[0, 2], turning[1, 0]])
    return np.array(columns).T


@robots
def test_the_jacobian_of_every_frame_is_its_derivative(name):
    chain = ROBOTS[name].chain()
    q = np.random.default_rng(1).uniform(-1, 1, chain.n)
    for place in range(chain.n + 1):
        expected = differences(lambda x, i=place: frames(chain, x)[i], q)
        np.testing.assert_allclose(frame_jacobian(chain, q, place), expected, atol=1e-8)


@robots
def test_the_jacobian_of_the_last_frame_is_that_of_the_arm(name):
    chain = ROBOTS[name].chain()
    q = np.random.default_rng(1).uniform(-1, 1, (3, chain.n))
    np.testing.assert_allclose(frame_jacobian(chain, q, chain.n), jacobian(chain, q), atol=1e-12)


@robots
def test_a_frame_seen_from_another_moves_with_the_joints_between_them(name):
    chain = ROBOTS[name].chain()
    q = np.random.default_rng(5).uniform(-1, 1, chain.n)
    for first in range(chain.n + 1):
        for last in range(first, chain.n + 1):

            def pose(x, first=first, last=last):
                placed = frames(chain, x)
                return np.linalg.inv(placed[first]) @ placed[last]

            J = relative_jacobian(chain, q, last, first)
            np.testing.assert_allclose(J, differences(pose, q), atol=1e-8)


@robots
def test_an_arm_with_a_held_joint_moves_as_the_whole_one_does(name):
    chain = ROBOTS[name].chain()
    q = np.random.default_rng(2).uniform(-1, 1, (4, chain.n))
    for joint in range(1, chain.n + 1):
        q[:, joint - 1] = 0.3
        held = with_held_joint(chain, joint, 0.3)
        left = np.delete(q, joint - 1, axis=1)
        np.testing.assert_allclose(forward(held, left), forward(chain, q), atol=1e-12)
        whole = np.delete(jacobian(chain, q), joint - 1, axis=-1)
        np.testing.assert_allclose(jacobian(held, left), whole, atol=1e-12)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda c: frame_jacobian(c, [0, 0], 3), "frame takes a number from 0 to 2, got 3"),
        (lambda c: relative_jacobian(c, [0, 0], 1, 2), "seen_from takes a frame up to 1, got 2"),
        (lambda c: with_held_joint(c, 0, 0.1), "joint takes a number from 1 to 2, got 0"),
        (lambda c: with_held_joint(with_held_joint(c, 1, 0), 1, 0), "got its only one held"),
        (lambda c: with_held_joint(c, 1, np.inf), "value takes finite numbers"),
    ],
)
def test_what_an_arm_does_not_have_is_refused_with_a_sentence(call, sentence):
    with pytest.raises(ChainError, match=sentence):
        call(ROBOTS["planar_2r"].chain())
