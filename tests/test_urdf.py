"""URDF texts to chains: the golden arms, merged and branching links, and sentences for what is no chain."""

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import elementary, steps_transform
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.urdf import UrdfError, read_urdf

FILES = sorted((Path(__file__).parent / "data" / "golden").glob("*.urdf"))
golden_files = pytest.mark.parametrize("path", FILES, ids=[path.stem for path in FILES])


def joint(
    name: str,
    parent: str,
    child: str,
    kind: str = "revolute",
    inside: str = "<limit lower='-1' upper='2'/>",
):
    ends = f"<parent link='{parent}'/><child link='{child}'/>"
    return f"<joint name='{name}' type='{kind}'>{ends}{inside}</joint>"


def robot(*joints: str, links: str = "abc") -> str:
    return f"<robot name='r'>{''.join(f'<link name={link!r}/>' for link in links)}{''.join(joints)}</robot>"


SERIAL = robot(joint("j1", "a", "b"), joint("j2", "b", "c", "prismatic"))
BRANCHED = robot(
    joint("j1", "a", "b"),
    joint("left", "b", "c", inside="<axis xyz='0 1 0'/><limit lower='0' upper='1'/>"),
    joint("right", "b", "d", "floating"),
    joint("thumb", "d", "e", inside="<mimic joint='left'/><limit/>"),
    links="abcde",
)


def test_every_golden_arm_has_its_urdf():
    assert len(FILES) == 15
    assert all(path.with_suffix(".json").exists() for path in FILES)


@golden_files
def test_a_golden_urdf_gives_the_golden_poses_and_jacobians(path: Path):
    golden = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    chain = read_urdf(path).chain
    q = np.array([case["q"] for case in golden["cases"]])
    assert chain.kinds == "".join(golden["kinds"])
    for key, values in {
        "T": forward(chain, q),
        "jacob0": jacobian(chain, q),
        "jacobe": jacobian(chain, q, "tool"),
        "joint_axes_z": frames(chain, q)[:, :-1, :3, 2],
    }.items():
        expected = np.array([case[key] for case in golden["cases"]])
        np.testing.assert_allclose(values, expected, rtol=0, atol=1e-12, err_msg=key)


@golden_files
def test_names_limits_and_ends_are_those_of_the_file(path: Path):
    found = read_urdf(str(path))
    n = found.chain.n
    assert found.names == tuple(f"j{i}" for i in range(1, n + 1))
    assert found.limits == ((-10.0, 10.0),) * n
    assert (found.base, found.tip) == ("l0", "tool")


def test_a_text_is_read_as_a_path_is():
    text = FILES[0].read_text(encoding="utf-8")
    expected = read_urdf(FILES[0]).chain.fixed
    for written in (
        text,
        "\n  " + text,
        "\ufeff" + text,
        "<?xml version='1.0' encoding='utf-8'?>" + text,
    ):
        np.testing.assert_array_equal(read_urdf(written).chain.fixed, expected)


def test_base_and_tip_cut_a_part_out_of_the_chain():
    path = next(path for path in FILES if path.stem == "puma560")
    q = np.array([0.3, 0.4])
    part = read_urdf(path, base="l1", tip="l3")
    assert (part.names, part.base, part.tip) == (("j2", "j3"), "l1", "l3")
    whole = frames(ROBOTS["puma560"].chain(), [0, 0, 0, 0, 0, 0])
    np.testing.assert_allclose(frames(part.chain, 0 * q)[:-1], whole[1:3], rtol=0, atol=1e-15)


def test_fixed_joints_are_merged_and_a_missing_origin_is_none():
    inside = "<origin xyz='1 2 3' rpy='0.1 0.2 0.3'/>"
    found = read_urdf(robot(joint("weld", "a", "b", "fixed", inside), joint("j", "b", "c")))
    weld = steps_transform([("Tx", 1), ("Ty", 2), ("Tz", 3), ("Rz", 0.3), ("Ry", 0.2), ("Rx", 0.1)])
    assert (found.chain.kinds, found.names) == ("R", ("j",))
    np.testing.assert_allclose(
        forward(found.chain, [0.5]), weld @ elementary("Rx", 0.5), rtol=0, atol=1e-15
    )


def test_a_joint_moves_about_its_axis_and_x_where_none_is_written():
    oblique = "<axis xyz='0 3 4'/><limit lower='-1' upper='2'/>"
    found = read_urdf(
        robot(joint("slide", "a", "b", "prismatic", oblique), joint("turn", "b", "c"))
    )
    T = forward(found.chain, [0.5, 0.7])
    expected = steps_transform([("Ty", 0.3), ("Tz", 0.4), ("Rx", 0.7)])
    np.testing.assert_allclose(T, expected, rtol=0, atol=1e-15)
    assert found.chain.kinds == "PR"


def test_a_continuous_joint_is_revolute_with_one_turn_as_limits():
    found = read_urdf(robot(joint("wheel", "a", "b", "continuous", ""), links="ab"))
    assert found.chain.kinds == "R"
    assert found.limits == ((-math.pi, math.pi),)


def test_a_limit_left_out_is_zero_as_the_format_has_it():
    found = read_urdf(
        robot(joint("j", "a", "b", inside="<limit upper='0.5' effort='1'/>"), links="ab")
    )
    assert found.limits == ((0.0, 0.5),)


def test_joints_off_the_way_are_not_looked_at():
    assert read_urdf(BRANCHED, tip="c").names == ("j1", "left")
    assert read_urdf(BRANCHED, tip="b").names == ("j1",)


@pytest.mark.parametrize(
    ("text", "ends", "sentence"),
    [
        (BRANCHED, {}, "tip takes one of c, e, as the robot branches after a, got none"),
        (BRANCHED, {"tip": "hand"}, "tip takes one of a, b, c, d, e, got 'hand'"),
        (BRANCHED, {"base": "hand"}, "base takes one of a, b, c, d, e, got 'hand'"),
        (
            BRANCHED,
            {"base": "d", "tip": "c"},
            "joint right takes a type of .*, got floating; choose a base behind it: base='d'",
        ),
        (
            BRANCHED,
            {"tip": "d"},
            "joint right takes a type of revolute, continuous, prismatic, fixed .*, got floating",
        ),
        (
            robot(joint("j", "a", "b", inside="<mimic joint='k'/><limit/>"), links="ab"),
            {},
            "joint j takes a moving joint to mimic, got 'k'",
        ),
        (
            robot(
                joint("j", "a", "b", inside="<mimic joint='k'/><limit/>"),
                joint("k", "b", "c", inside="<mimic joint='j'/><limit/>"),
            ),
            {},
            "joint j takes another joint to mimic, got a loop",
        ),
        (
            robot("<xacro:include filename='arm.xacro'/>", joint("j", "a", "b"), links="ab"),
            {},
            "takes a URDF, got a xacro file with <xacro:include>; expand it first",
        ),
        (
            SERIAL,
            {"tip": "a"},
            "the way from a to a takes a joint that moves, got fixed joints only",
        ),
        (
            robot(joint("j", "a", "b", "planar"), links="ab"),
            {},
            "joint j takes a type of .*, got planar",
        ),
        (robot(joint("j", "a", "b", ""), links="ab"), {}, "joint j takes a type of .*, got none"),
        (
            robot(joint("j", "a", "b", "fixed", ""), links="ab"),
            {},
            "takes a joint that moves, got fixed joints only",
        ),
        (
            robot(joint("j", "a", "b"), links="abc"),
            {},
            "takes one link that no joint carries, got a, c; choose base",
        ),
        (robot(), {}, "takes one link that no joint carries, got a, b, c"),
        (
            robot(joint("j", "a", "b"), joint("k", "b", "a")),
            {"tip": "b", "base": "c"},
            "base takes a link that is joined to b, such as a, b, got c",
        ),
        (
            robot(joint("j", "a", "b"), joint("k", "b", "a"), links="ab"),
            {},
            "that no joint carries, got none",
        ),
        (
            robot(joint("j", "a", "c"), joint("k", "b", "c")),
            {},
            "link c takes one joint above it, got j and k: a loop",
        ),
        (
            robot(joint("j", "a", "b"), joint("j", "b", "c")),
            {},
            "joints take names of their own, got j twice",
        ),
        (robot(joint("j", "a", "z")), {}, "joint j takes links of this robot, got 'z'"),
        (
            robot(joint("j", "a", "b", inside=""), links="ab"),
            {},
            "joint j takes limits, as it is revolute, got none",
        ),
        (
            robot(joint("j", "a", "b", inside="<axis xyz='0 0 0'/>"), links="ab"),
            {},
            "takes an axis with a direction, got zeros",
        ),
        (
            robot(joint("j", "a", "b", inside="<origin xyz='1 2'/>"), links="ab"),
            {},
            "joint j takes three numbers in xyz, got '1 2'",
        ),
        (
            robot(joint("j", "a", "b", inside="<origin rpy='0 0 ${pi}'/>"), links="ab"),
            {},
            r"joint j takes finite numbers in rpy, got '\$\{pi\}'",
        ),
        (
            robot(joint("j", "a", "b", inside="<limit lower='nan' upper='1'/>"), links="ab"),
            {},
            "takes finite numbers in the limit lower, got 'nan'",
        ),
        (
            robot(joint("j", "a", "b", inside="<origin xyz='1_0 0 0'/>"), links="ab"),
            {},
            "joint j takes finite numbers in xyz, got '1_0'",
        ),
        (
            robot(joint("j", "a", "b"), links="abb"),
            {},
            "links take names of their own, got b twice",
        ),
        ("<robot><joint type='fixed'/></robot>", {}, "a joint takes a name, got none"),
        ("<robot><link/></robot>", {}, "a link takes a name, got none"),
        (
            "<robot><joint name='j' type='fixed'/></robot>",
            {},
            "joint j takes a parent link, got none",
        ),
        (
            "<robot><joint name='j'><parent/></joint></robot>",
            {},
            "the parent of joint j takes a link, got none",
        ),
        ("<model/>", {}, "a URDF takes <robot> as its outermost element, got <model>"),
        ("<robot>", {}, "a URDF takes well-formed XML, got no element found"),
    ],
)
def test_what_is_no_serial_chain_is_refused_with_a_sentence(
    text: str, ends: dict[str, Any], sentence: str
):
    with pytest.raises(UrdfError, match=sentence):
        read_urdf(text, **ends)


@pytest.mark.parametrize(
    "prolog",
    [
        "<!DOCTYPE robot [<!ENTITY l1 'ha'><!ENTITY l2 '&l1;&l1;&l1;&l1;'>]>",
        "<!DOCTYPE robot [<!ENTITY file SYSTEM 'file:///etc/hostname'>]>",
        "<!DOCTYPE robot SYSTEM 'robot.dtd'>",
    ],
)
def test_document_types_and_entities_are_refused_before_they_are_read(prolog: str, tmp_path: Path):
    for text in (prolog + SERIAL, "<?xml version='1.0'?>" + prolog + SERIAL):
        (tmp_path / "arm.urdf").write_text(text, encoding="utf-8")
        for given in (text, tmp_path / "arm.urdf"):
            with pytest.raises(UrdfError, match="a URDF takes no document type and no entities"):
                read_urdf(given)


def test_a_file_that_cannot_be_read_is_refused_with_a_sentence(tmp_path: Path):
    missing = tmp_path / "no.urdf"
    with pytest.raises(
        UrdfError, match=r"takes the path of a readable file.*" + re.escape(missing.name)
    ):
        read_urdf(missing)
    for unreadable in ("", "puma\0", str(tmp_path)):
        with pytest.raises(UrdfError, match="takes the path of a readable file"):
            read_urdf(unreadable)
    (tmp_path / "wide.urdf").write_text(SERIAL, encoding="utf-16")
    with pytest.raises(UrdfError, match=r"wide\.urdf takes UTF-8 text, got other bytes"):
        read_urdf(tmp_path / "wide.urdf")


def test_an_empty_text_is_told_from_a_path():
    for empty in ("", " \n", "\ufeff"):
        with pytest.raises(UrdfError, match=r"a text that starts with <, got an empty text$"):
            read_urdf(empty)


def test_reversed_limits_are_put_in_order_and_noted():
    arm = read_urdf(robot(joint("j", "a", "b", inside="<limit lower='1' upper='-1'/>"), links="ab"))
    assert arm.limits == ((-1.0, 1.0),)
    (note,) = arm.notes
    assert "lower limit 1 above the upper one -1" in note
    assert read_urdf(SERIAL).notes == ()


@pytest.mark.parametrize("head", ["<robot name='r'>", "<robot xmlns='http://a.b/c' name='r'>"])
def test_prefixes_that_nobody_declared_and_default_namespaces_change_nothing(head: str):
    """Plugins of simulators stand in many files, with a prefix of theirs."""
    strange = SERIAL.replace("<robot name='r'>", f"{head}<gazebo:plugin sensor:rate='3'/>")
    arm = read_urdf(strange)
    assert arm.names == ("j1", "j2")
    np.testing.assert_array_equal(arm.chain.fixed, read_urdf(SERIAL).chain.fixed)


FINGERS = robot(
    joint("j1", "a", "b", inside="<origin xyz='0 0 .3'/><limit lower='-1' upper='1'/>"),
    joint(
        "j2",
        "b",
        "c",
        inside="<origin xyz='.2 0 .1' rpy='.3 0 .4'/><axis xyz='0 1 1'/>"
        "<mimic joint='j1' multiplier='-2' offset='.5'/><limit/>",
    ),
    joint("j3", "c", "d", "prismatic", "<origin rpy='0 .2 0'/><limit lower='0' upper='1'/>"),
    links="abcd",
)


def test_a_mimic_joint_is_a_multiplied_column():
    arm = read_urdf(FINGERS)
    assert arm.names == ("j1", "j3")
    assert arm.is_coupled
    q, step = np.array([[0.3, 0.2], [-0.7, 0.9]]), 1e-6
    np.testing.assert_allclose(arm.configuration(q)[:, 1], 0.5 - 2 * q[:, 0])
    J = arm.jacobian(q)
    assert J.shape == (2, 6, 2)
    for j in range(2):
        moved = [
            forward(arm.chain, arm.configuration(q + s * step * np.eye(2)[j])) for s in (1, -1)
        ]
        slope = (moved[0] - moved[1]) / (2 * step)
        np.testing.assert_allclose(J[:, :3, j], slope[:, :3, 3], atol=1e-8)
        turning = slope[:, :3, :3] @ forward(arm.chain, arm.configuration(q))[:, :3, :3].mT
        np.testing.assert_allclose(J[:, 5, j], turning[:, 1, 0], atol=1e-8)


def test_a_mimic_of_a_mimic_follows_the_last_and_a_leader_off_the_way_counts():
    text = robot(
        joint("lead", "a", "b"),
        joint("one", "a", "c", inside="<mimic joint='lead' multiplier='3' offset='1'/><limit/>"),
        joint("two", "c", "d", inside="<mimic joint='one' multiplier='2' offset='.5'/><limit/>"),
        links="abcd",
    )
    arm = read_urdf(text, tip="d")
    assert arm.names == ("lead",)
    assert arm.limits == ((-1.0, 2.0),)
    np.testing.assert_allclose(arm.configuration([0.2]), [1 + 0.6, 0.5 + 2 * 1.6])


def test_an_arm_without_mimic_joints_is_not_coupled():
    arm = read_urdf(SERIAL)
    assert not arm.is_coupled
    np.testing.assert_array_equal(arm.jacobian([0.3, 0.4]), jacobian(arm.chain, [0.3, 0.4]))


def test_a_base_behind_a_floating_joint_skips_it():
    text = robot(joint("world", "a", "b", "floating", ""), joint("j1", "b", "c"), links="abc")
    assert read_urdf(text, base="b").names == ("j1",)


def test_a_base_that_does_not_carry_the_tip_is_reached_upwards():
    """From one hand to the other: the pose between them, whatever the way."""
    text = robot(
        joint("l1", "a", "b", inside="<origin xyz='.1 .2 .3' rpy='.3 .1 0'/><limit lower='-1'/>"),
        joint(
            "l2", "b", "c", inside="<origin xyz='.4 0 0'/><axis xyz='0 1 1'/><limit lower='-1'/>"
        ),
        joint("r1", "a", "d", "prismatic", "<origin xyz='0 -.2 0' rpy='0 .5 0'/><limit/>"),
        joint("r2", "d", "e", inside="<origin xyz='0 .3 0'/><axis xyz='0 0 1'/><limit/>"),
        links="abcde",
    )
    left, right = read_urdf(text, tip="c"), read_urdf(text, tip="e")
    across = read_urdf(text, base="c", tip="e")
    assert across.names == ("l2", "l1", "r1", "r2")
    assert across.limits[:2] == left.limits[::-1]
    q_left, q_right = np.array([0.4, -0.6]), np.array([0.2, 0.9])
    between = np.linalg.inv(forward(left.chain, q_left)) @ forward(right.chain, q_right)
    q = [*q_left[::-1], *q_right]
    np.testing.assert_allclose(forward(across.chain, q), between, atol=1e-12)
