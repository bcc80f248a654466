"""Robots from a table, a chain and a URDF are those they came from."""

import math

import numpy as np
import pytest
from kinegrade.solutions.any_robot import robot_from_chain, robot_from_table, robot_from_urdf
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.urdf import UrdfError, read_urdf

URDF = """<robot name="arm"><link name="base"/><link name="a"/><link name="b"/>
<joint name="turn" type="revolute"><parent link="base"/><child link="a"/><origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/>
<axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="a"/><child link="b"/>
<origin xyz="0.3 0 0" rpy="0 1.5707963267948966 0"/>
<axis xyz="1 0 0"/><limit lower="0.1" upper="0.4" effort="1" velocity="1"/></joint></robot>"""


@pytest.mark.parametrize("name", ROBOTS)
def test_a_robot_of_a_chain_has_its_kinematics(name):
    chain = ROBOTS[name].chain()
    robot = robot_from_chain(chain)
    for q in np.random.default_rng(1).uniform(-1, 1, (3, chain.n)):
        np.testing.assert_allclose(robot.frames(None, q)[-1], forward(chain, q), atol=1e-12)
        np.testing.assert_allclose(jacobian(robot.chain(), q), jacobian(chain, q), atol=1e-12)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_chain_with_named_lengths_is_the_same_arm(name):
    chain = ROBOTS[name].chain()
    robot = robot_from_chain(chain, named=True)
    for q in np.random.default_rng(1).uniform(-1, 1, (3, chain.n)):
        np.testing.assert_allclose(forward(robot.chain(), q), forward(chain, q), atol=1e-12)


@pytest.mark.parametrize("seed", range(50))
def test_so_is_a_random_one(seed):
    rng = np.random.default_rng(seed)
    chain = random_chain("".join(rng.choice(["R", "R", "P"], rng.integers(1, 8))), rng)
    robot = robot_from_chain(chain, named=True)
    assert robot.kinds == chain.kinds
    for q in rng.uniform(-2, 2, (3, chain.n)):
        np.testing.assert_allclose(forward(robot.chain(), q), forward(chain, q), atol=1e-11)


def test_the_names_of_a_puma_are_those_of_its_table():
    robot = robot_from_chain(ROBOTS["puma560"].chain(), named=True)
    assert [*robot.rows] == [tuple(row) for row in ROBOTS["puma560"].rows]
    assert robot.parameters == pytest.approx(ROBOTS["puma560"].parameters)


def test_right_angles_with_five_digits_are_right_ones_where_lengths_are_named():
    rounded = URDF.replace("1.5707963267948966", "1.5708")
    robot = robot_from_urdf(rounded, named=True)
    assert set(robot.parameters) == {"a1"}
    exact = robot_from_chain(read_urdf(rounded).chain, named=True, tolerance=1e-12)
    assert set(exact.parameters) > set(robot.parameters)
    for q in ([0.3, 0.2], [-0.7, 0.4]):
        np.testing.assert_allclose(forward(robot.chain(), q), forward(exact.chain(), q), atol=1e-5)


@pytest.mark.parametrize("seed", range(5))
def test_oblique_chains_too(seed):
    chain = random_chain("RPRRPR", np.random.default_rng(seed))
    q = np.random.default_rng(seed).uniform(-1, 1, 6)
    np.testing.assert_allclose(
        forward(robot_from_chain(chain).chain(), q), forward(chain, q), atol=1e-12
    )


def test_a_robot_of_a_urdf_has_its_limits_and_its_kinematics():
    robot, arm = robot_from_urdf(URDF), read_urdf(URDF)
    assert robot.limits == ((-1.0, 2.0), (0.1, 0.4))
    assert robot.kinds == "RP"
    q = [0.7, 0.3]
    np.testing.assert_allclose(robot.frames(None, q)[-1], forward(arm.chain, q), atol=1e-12)


def test_a_robot_of_a_table_is_that_of_the_catalogue():
    known = ROBOTS["rrt_offset"]
    robot = robot_from_table(known.rows, known.parameters)
    q = [0.3, 0.5, 0.7]
    np.testing.assert_allclose(robot.frames({"d1": 0.9}, q), known.frames({"d1": 0.9}, q))
    assert robot.task_rows == (0, 1, 2)
    assert robot.limits == ((-math.pi, math.pi), (-math.pi, math.pi), (0.1, 1.0))


def test_right_angles_stay_exact():
    robot = robot_from_chain(ROBOTS["puma560"].chain())
    words = {
        amount
        for steps in robot.rows
        for motion, amount in steps
        if motion[0] == "R" and "q" not in amount
    }
    assert words <= {"2*pi/4", "-2*pi/4", "4*pi/4"}


def test_a_robot_with_a_mimic_joint_is_refused_with_the_way_out():
    text = (
        "<robot><link name='a'/><link name='b'/><link name='c'/>"
        "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><limit/></joint>"
        "<joint name='k' type='revolute'><parent link='b'/><child link='c'/>"
        "<mimic joint='j'/><limit/></joint></robot>"
    )
    with pytest.raises(UrdfError, match="one that mimics another; read_urdf has the Jacobian"):
        robot_from_urdf(text)
