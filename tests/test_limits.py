"""Which joints are outside their limits, and the sentence that says so."""

import math

import numpy as np
import pytest
from kinegrade.solutions.chain import ChainError
from kinegrade.solutions.limits import are_outside, outside
from kinegrade.solutions.robots import ROBOTS

LIMITS = ((-math.pi, math.pi), (0.2, 1.0), (-math.inf, math.inf))
RRT = ROBOTS["rrt_spherical"]


def test_the_joints_outside_are_named_with_their_limits_and_values():
    found = RRT.outside([0.0, math.radians(130), 1.25])
    assert [str(joint) for joint in found] == [
        "q2 takes -120° to 120°, got 130°",
        "q3 takes 0.2 m to 1 m, got 1.25 m",
    ]
    assert [joint.joint for joint in found] == [2, 3]


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)
def test_limits_themselves_are_within_and_a_little_more_is_not(robot):
    low, high = np.transpose(robot.limits)
    assert not robot.outside(low)
    assert not robot.outside((low + high) / 2)
    assert not robot.outside(np.radians(np.degrees(high)))  # rounding
    assert [joint.joint for joint in robot.outside(high + 1e-6)] == list(range(1, robot.n + 1))
    assert all(
        str(joint).startswith(f"q{joint.joint} takes ") for joint in robot.outside(low - 1e-6)
    )


def test_a_whole_turn_more_is_outside():
    assert RRT.outside([2 * math.pi, 0.0, 0.5])


def test_a_batch_is_told_joint_by_joint():
    q = [[0.0, 0.5, 1e300], [4.0, 0.5, 0.0], [0.0, 0.1, 0.0]]
    assert are_outside(LIMITS, q).tolist() == [
        [False, False, False],
        [True, False, False],
        [False, True, False],
    ]
    assert are_outside(LIMITS, np.zeros((0, 4, 3))).shape == (0, 4, 3)


def test_a_slide_of_a_tiny_arm_is_outside_though_less_than_a_micrometre():
    assert outside(((0.0, 1e-6),), "P", [1.5e-6])
    assert not outside(((0.0, 1e-6),), "P", [1e-6])


@pytest.mark.parametrize(
    ("q", "sentence"),
    [
        ([0.0, 0.0], r"q takes shape \(\.\.\., 3\), got \(2,\)"),
        ([[0.0, 0.0, 0.5]], r"q takes shape \(3,\), got \(1, 3\)"),
        ([0.0, math.nan, 0.5], "q takes finite numbers"),
    ],
)
def test_a_wrong_configuration_is_refused_with_a_sentence(q, sentence):
    with pytest.raises(ChainError, match=sentence):
        RRT.outside(q)
