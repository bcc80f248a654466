"""Right and wrong columns, in numbers and in closed form, for every robot with a standard table."""

import numpy as np
import pytest
from kinegrade.exercises.calculations.columns import (
    SLIPS,
    angular_first,
    closed,
    different,
    right,
    tool_axes,
)
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS

STANDARD = [robot for robot in ROBOTS.values() if robot.convention == "standard"]
IN_FORMULAS = [slip for slip in SLIPS if slip.columns is not tool_axes]


def posture(robot):
    return np.random.default_rng(3).uniform(0.3, 1.2, robot.n)


@pytest.mark.parametrize("robot", STANDARD, ids=lambda robot: robot.name)
def test_right_columns_are_the_jacobian(robot):
    q = posture(robot)
    np.testing.assert_allclose(
        right(robot.frames(None, q), robot.kinds), jacobian(robot.chain(), q), atol=1e-12
    )


SHORT = [
    robot for robot in STANDARD if robot.n <= 4
]  # entries of six wrong columns are longer than is read


@pytest.mark.parametrize("robot", SHORT, ids=lambda robot: robot.name)
def test_closed_columns_come_to_the_same_numbers_right_and_wrong(robot):
    q = posture(robot)
    values = {**robot.parameters, **dict(zip(robot.joints, q, strict=True))}
    T = robot.frames(None, q)
    for way in (right, *(slip.columns for slip in IN_FORMULAS)):
        np.testing.assert_allclose(closed(robot, way).at(values), way(T, robot.kinds), atol=1e-9)


def test_on_an_arm_with_a_slide_all_ways_differ_from_each_other():
    robot = ROBOTS["rrt_offset"]
    T = robot.frames(None, posture(robot))
    ways = [right(T, robot.kinds), angular_first(T, robot.kinds)]
    ways += [slip.columns(T, robot.kinds) for slip in SLIPS]
    for i, one in enumerate(ways):
        assert all(np.abs(one - other).max() > 0.01 for other in ways[:i])
    assert different(T, robot.kinds) == [*SLIPS]


def test_a_way_that_changes_nothing_is_no_mistake():
    robot = ROBOTS["planar_2r"]
    named = different(robot.frames(None, posture(robot)), robot.kinds)
    assert {slip.columns.__name__ for slip in named} == {
        "late",
        "own_link",
        "from_base",
        "reversed_product",
        "tool_axes",
    }


def test_sentences_are_plain_text_and_differ():
    sentences = [slip.sentence for slip in SLIPS]
    assert len({*sentences}) == len(sentences)
    assert not any("$" in sentence for sentence in sentences)
