"""The pipeline of known mistakes without a mistake, and what single switches do to it."""

import numpy as np
import pytest
from kinegrade.exercises.arm import Arm
from kinegrade.exercises.calculations import columns
from kinegrade.grader.diagnosis.bank import mistakes_of
from kinegrade.grader.diagnosis.pipeline import Solved
from kinegrade.grader.diagnosis.steps import steps_of
from kinegrade.grader.diagnosis.switches import ORIGIN, TOOL_AXES, Edit, as_it_is, edit
from kinegrade.solutions.analytic import analytic_jacobian
from kinegrade.solutions.chain import modified_transform
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robot import Robot
from kinegrade.solutions.robots import ROBOTS

EXACT = {"rtol": 0, "atol": 1e-12}
PLACED = Robot(  # with a base, a tool, offsets and a slide
    name="placed",
    title="Placed",
    parameters={"h": 0.4, "a1": 0.5, "l": 0.3},
    rows=(("q1 + pi/2", "0.1", "a1", "-pi/2"), ("q2", "0", "0", "pi/2"), ("pi/2", "q3", "0", "0")),
    limits=((-3.0, 3.0),) * 3,
    source="a test",
    base=(("Tz", "h"), ("Rx", "0.3")),
    tool=(("Tx", "l"), ("Rz", "0.2")),
)
ARMS = [*ROBOTS.values(), PLACED]


def arm_of(robot: Robot, seed: int = 0) -> Arm:
    rng = np.random.default_rng(seed)
    lengths = {name: rng.uniform(0.3, 1.2) for name in robot.parameters}
    return Arm(robot, lengths, rng.uniform(0.2, 1.3, robot.n))


def solved(arm: Arm, *edits: Edit) -> Solved:
    switches = as_it_is(steps_of(arm), 2)
    for one in edits:
        edit(switches, np.array([1]), one)
    return Solved(steps_of(arm), switches)


@pytest.mark.parametrize("robot", ARMS, ids=lambda robot: robot.name)
@pytest.mark.parametrize("seed", range(3))
def test_without_a_mistake_it_agrees_with_the_engine(robot, seed):
    arm = arm_of(robot, seed)
    right = solved(arm)
    np.testing.assert_allclose(right.printed[0], arm.frames, **EXACT)
    np.testing.assert_allclose(right.J[0], arm.J, **EXACT)
    np.testing.assert_allclose(right.axes[0].T, arm.axes, **EXACT)
    np.testing.assert_allclose(right.origins[0].T, arm.origins, **EXACT)


@pytest.mark.parametrize("robot", ARMS, ids=lambda robot: robot.name)
def test_other_axes_and_another_point_agree_with_the_engine(robot):
    arm = arm_of(robot)
    in_tool = solved(arm, Edit("axes", "set", TOOL_AXES)).J[1]
    np.testing.assert_allclose(in_tool, jacobian(arm.chain, arm.q, "tool"), **EXACT)
    at_origin = solved(arm, Edit("point", "set", ORIGIN)).J[1]
    np.testing.assert_allclose(at_origin, jacobian(arm.chain, arm.q, point="origin"), **EXACT)


@pytest.mark.parametrize(("code", "letters"), [(1, "ZYZ"), (2, "xyz")])
def test_rates_of_angles_agree_with_the_engine(code, letters):
    arm = arm_of(ROBOTS["puma560"])
    rates = solved(arm, Edit("rates", "set", code)).J
    np.testing.assert_allclose(rates[1], analytic_jacobian(arm.chain, arm.q, letters), **EXACT)
    np.testing.assert_allclose(rates[0], arm.J, **EXACT)


WAYS = {
    columns.late: [Edit("axis_shift", "set", 1), Edit("origin_shift", "set", 1)],
    columns.late_axes: [Edit("axis_shift", "set", 1)],
    columns.own_link: [Edit("lever_end", "set", 1)],
    columns.from_base: [Edit("lever_from_base", "set", value=True)],
    columns.reversed_product: [Edit("cross", "set", -1.0)],
    columns.all_turning: [Edit("turns", "set", value=True), Edit("angular", "set", 1.0)],
    columns.turning_slide: [Edit("angular", "set", 1.0)],
    columns.tool_axes: [Edit("axes", "set", TOOL_AXES)],
}


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.__name__)
@pytest.mark.parametrize("name", ["rrt_offset", "scara", "stanford", "puma560"])
def test_a_switch_leads_to_the_wrong_columns_that_exercises_know(way, name):
    arm = arm_of(ROBOTS[name])
    wrong = solved(arm, *WAYS[way]).J[1]
    np.testing.assert_allclose(wrong, way(arm.frames, arm.kinds), **EXACT)


def test_rows_in_the_order_of_the_other_convention_are_modified_transforms():
    arm = arm_of(ROBOTS["puma560"])
    values = {**arm.robot.values(arm.lengths), **{f"q{i}": q for i, q in enumerate(arm.q, 1)}}
    links = modified_transform(arm.robot.table.numbers(values))
    product = np.linalg.multi_dot([*links])
    np.testing.assert_allclose(
        solved(arm, Edit("other_order", "set", value=True)).frames[1, -1], product, **EXACT
    )


def test_a_sum_of_angles_taken_as_a_product():
    arm = arm_of(ROBOTS["planar_2r"])
    (q1, q2), (l1, l2) = arm.q, arm.lengths.values()
    wrong = solved(arm, Edit("sums", "set", 1, (1,))).frames[1, -1, :2, 3]
    x = l1 * np.cos(q1) + l2 * np.cos(q1) * np.cos(q2)
    y = l1 * np.sin(q1) + l2 * np.sin(q1) * np.sin(q2)
    np.testing.assert_allclose(wrong, (x, y), **EXACT)


@pytest.mark.parametrize("robot", ARMS, ids=lambda robot: robot.name)
def test_no_two_mistakes_of_an_arm_have_one_title(robot):
    titles = [mistake.title for mistake in mistakes_of(steps_of(arm_of(robot)), (0, 0))]
    assert len(titles) == len(set(titles))


@pytest.mark.parametrize("robot", ARMS, ids=lambda robot: robot.name)
def test_every_length_has_the_direction_in_which_it_moves_the_arm(robot):
    arm = arm_of(robot)
    steps = steps_of(arm)
    for name, direction in steps.lengths.items():
        places = tuple(range(len(steps.motions)))
        longer = solved(arm, Edit("constants", "add", 0.1 * direction, places)).printed[1]
        lengths = {**arm.lengths, name: arm.lengths[name] + 0.1}
        np.testing.assert_allclose(longer, arm.robot.frames(lengths, arm.q), **EXACT)
