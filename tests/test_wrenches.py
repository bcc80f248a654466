"""Torques and wrenches: what they do is the same whatever they are written in."""

import numpy as np
import pytest
from kinegrade.solutions.chain import ChainError
from kinegrade.solutions.jacobian import at_point, in_axes, jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.velocity import twist
from kinegrade.solutions.wrenches import joint_torques, wrench_at, wrench_in

robots = pytest.mark.parametrize("name", ROBOTS)


def case(name, batch=(3,)):
    chain = ROBOTS[name].chain()
    rng = np.random.default_rng(4)
    draw = [rng.uniform(-1, 1, (*batch, size)) for size in (chain.n, chain.n, 6)]
    return chain, *draw


@robots
@pytest.mark.parametrize("frame", ["base", "tool"])
def test_torques_do_the_work_that_the_wrench_does(name, frame):
    chain, q, qdot, F = case(name)
    tau = joint_torques(chain, q, F, frame)
    assert tau.shape == q.shape
    work = (F * twist(chain, q, qdot, frame)).sum(axis=-1)
    np.testing.assert_allclose((tau * qdot).sum(axis=-1), work, atol=1e-12)


@robots
def test_a_wrench_about_another_point_needs_the_same_torques(name):
    chain, q, _, F = case(name)
    r = np.array([0.1, -0.4, 0.3])
    point = forward(chain, q)[..., :3, 3] + r
    moved = wrench_at(F, r)
    np.testing.assert_allclose(
        joint_torques(chain, q, moved, point=point), joint_torques(chain, q, F), atol=1e-12
    )
    J = at_point(jacobian(chain, q), r)
    np.testing.assert_allclose(
        (J.mT @ moved[..., None])[..., 0], joint_torques(chain, q, F), atol=1e-12
    )


@robots
def test_a_wrench_in_other_axes_needs_the_same_torques(name):
    chain, q, _, F = case(name)
    R = forward(chain, q)[..., :3, :3]
    turned = wrench_in(F, R)
    np.testing.assert_allclose(
        joint_torques(chain, q, turned, "tool"), joint_torques(chain, q, F), atol=1e-12
    )
    J = in_axes(jacobian(chain, q), R)
    np.testing.assert_allclose(
        (J.mT @ turned[..., None])[..., 0], joint_torques(chain, q, F), atol=1e-12
    )


def test_a_weight_at_the_hand_is_held_by_its_lever():
    """A planar arm stretched along x, lengths 1 and 0.7, 10 N down the y axis."""
    chain = ROBOTS["planar_2r"].chain({"l1": 1.0, "l2": 0.7})
    tau = joint_torques(chain, [0.0, 0.0], [0, -10.0, 0, 0, 0, 0])
    np.testing.assert_allclose(tau, [-17.0, -7.0])


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda c: joint_torques(c, [0, 0], [1, 2, 3]), r"wrench takes shape \(..., 6\)"),
        (lambda _: wrench_at([0] * 6, [1, 2]), r"offset takes shape \(..., 3\)"),
        (lambda _: wrench_in([0] * 6, np.ones((3, 3))), "rotation takes right-handed rotations"),
        (lambda c: joint_torques(c, [0, 0], [[0] * 6] * 2, np.ones((2, 2))), "frame takes shape"),
    ],
)
def test_wrong_wrenches_are_refused_with_a_sentence(call, sentence):
    with pytest.raises(ChainError, match=sentence):
        call(ROBOTS["planar_2r"].chain())
