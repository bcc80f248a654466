"""The arms of the course: rows, frames, limits, factors, and sentences for wrong names."""

import json
import math
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import Array, ChainError, steps_transform
from kinegrade.solutions.errors import KinegradeError
from kinegrade.solutions.expression import parse
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.robots import ROBOTS, Robot, RobotError, robot

GOLDEN = Path(__file__).parent / "data" / "golden"
TWINS = {
    "planar_2r": "planar2r",
    "planar_3r": "planar3r",
    "three_axis": "threeaxis",
    "rrt_spherical": "rrt_spherical",
    "rrt_offset": "rrt_offset",
    "rrt_scara": "rrt_planar",
    "rpp_cylindrical": "rpp_cyl",
    "scara": "scara",
    "stanford": "stanford",
    "stanford_spong": "stanford_spong",
    "articulated_6r": "niku6",
    "puma560": "puma560",
    "ur5": "ur5",
    "panda": "panda",
}
every = pytest.mark.parametrize("arm", ROBOTS.values(), ids=list(ROBOTS))
FACTORED = [arm for arm in ROBOTS.values() if arm.factors]
factored = pytest.mark.parametrize("arm", FACTORED, ids=[arm.name for arm in FACTORED])


def within_limits(arm: Robot, count: int) -> Array:
    low, high = np.array(arm.limits).T
    return np.random.default_rng(6).uniform(low, high, (count, arm.n))


def other_parameters(arm: Robot) -> dict[str, float]:
    rng = np.random.default_rng(7)
    return {name: float(rng.uniform(0.3, 1.2)) for name in arm.parameters}


def valued(arm: Robot, parameters: dict[str, float], q: Array) -> dict[str, Any]:
    return arm.values(parameters) | {name: q[..., i] for i, name in enumerate(arm.joints)}


@pytest.mark.parametrize(
    ("name", "kinds", "names"),
    [
        ("planar_2r", "RR", ("l1", "l2")),
        ("three_axis", "RRR", ("L", "a2", "a3")),
        ("rrt_spherical", "RRP", ("d1",)),
        ("rrt_offset", "RRP", ("a1", "d1", "d2")),
        ("puma560", "RRRRRR", ("d1", "a2", "a3", "d3", "d4")),
        ("planar_3r", "RRR", ("l1", "l2", "l3")),
        ("rrt_scara", "RRP", ("d1", "a1", "a2")),
        ("rpp_cylindrical", "RPP", ("d1",)),
        ("scara", "RRPR", ("a1", "a2", "d4")),
        ("stanford", "RRPRRR", ("d1", "d2", "a3", "d6")),
        ("stanford_spong", "RRPRRR", ("d2", "d6")),
        ("articulated_6r", "RRRRRR", ("a2", "a3", "a4")),
        ("ur5", "RRRRRR", ("d1", "a2", "a3", "d4", "d5", "d6")),
        ("panda", "RRRRRRR", ("d1", "d3", "a4", "d5", "a7", "d7", "h")),
    ],
)
def test_the_course_knows_these_arms(name: str, kinds: str, names: tuple[str, ...]):
    arm = robot(name)
    assert (arm.name, arm.kinds, arm.n) == (name, kinds, len(kinds))
    assert arm.names == (*names, *(f"q{i}" for i in range(1, len(kinds) + 1)))


def test_every_arm_has_a_golden_twin():
    assert set(TWINS) == set(ROBOTS)


@every
def test_an_arm_is_its_golden_twin(arm: Robot):
    golden = json.loads((GOLDEN / f"{TWINS[arm.name]}.json").read_text(encoding="utf-8"))
    lengths = {"a2": 15, "a3": 15, "a4": 6} if arm.name == "articulated_6r" else {}
    chain, q = arm.chain(lengths), [case["q"] for case in golden["cases"]]
    for key, values in {
        "T": forward(chain, q),
        "jacob0": jacobian(chain, q),
        "jacobe": jacobian(chain, q, "tool"),
    }.items():
        expected = [case[key] for case in golden["cases"]]
        np.testing.assert_allclose(values, expected, rtol=0, atol=1e-12, err_msg=key)


@factored
def test_constant_and_factors_multiply_to_the_determinant_of_the_task_block(arm: Robot):
    q = within_limits(arm, 40)
    for parameters in ({}, other_parameters(arm)):
        values = valued(arm, parameters, q)
        product = np.broadcast_to(parse(arm.constant, arm.names).at(values), len(q)).copy()
        for factor in arm.factors:
            product *= parse(factor.expression, arm.names).at(values) ** factor.power
        determinant = np.linalg.det(jacobian(arm.chain(parameters), q)[:, arm.task_rows, :])
        np.testing.assert_allclose(determinant, product, rtol=1e-9, atol=1e-14)
        np.testing.assert_allclose(
            parse(arm.determinant, arm.names).at(values), product, rtol=1e-12, atol=1e-15
        )


def test_the_determinant_of_s0s_arm_is_6_roots_of_3_at_its_example():
    arm = robot("three_axis")
    values = valued(arm, {}, arm.pose("example"))
    assert parse(arm.determinant, arm.names).at(values) == pytest.approx(
        6 * math.sqrt(3), rel=1e-14
    )


@pytest.mark.parametrize(
    ("name", "determinant"),
    [
        ("planar_3r", "l1*l2*(sin(q2))"),
        ("rrt_spherical", "-1*(q3)^2*(sin(q2))"),
        ("rpp_cylindrical", "(q3)"),
        ("stanford", "(q3)^2*(sin(q2))*(sin(q5))"),
    ],
)
def test_the_determinant_is_written_out_with_its_sign_and_powers(name: str, determinant: str):
    assert robot(name).determinant == determinant


@every
def test_all_arms_but_the_redundant_one_have_a_square_task_block_and_its_factors(arm: Robot):
    assert (len(arm.task_rows) == arm.n) == bool(arm.factors) == (arm.name != "panda")


@every
def test_each_factor_has_a_name_of_its_own_and_vanishes_at_a_singular_posture(arm: Robot):
    assert len({factor.name.partition(":")[0] for factor in arm.factors}) == len(arm.factors)
    assert all(factor.name.partition(":")[2] for factor in arm.factors)


@pytest.mark.parametrize("degrees", [-87.308, 92.692])
def test_the_elbow_of_the_puma_is_straight_or_folded_where_tan_q3_is_minus_d4_over_a3(
    degrees: float,
):
    arm = robot("puma560")
    elbow = next(factor for factor in arm.factors if factor.name.startswith("elbow"))
    value = parse(elbow.expression, arm.names).at(arm.values() | {"q3": math.radians(degrees)})
    assert value == pytest.approx(0, abs=1e-5)


def test_at_a_shoulder_singularity_the_wrist_centre_is_at_the_shoulder_offset_from_axis_1():
    arm = robot("puma560")
    values, q3 = arm.values(), 0.3
    across = values["a2"] + values["a3"] * math.cos(q3) - values["d4"] * math.sin(q3)
    along = values["a3"] * math.sin(q3) + values["d4"] * math.cos(q3)
    T = forward(arm.chain(), [0.4, math.atan2(across, along), q3, 0, 0.5, 0])
    assert math.hypot(T[0, 3], T[1, 3]) == pytest.approx(values["d3"], abs=1e-12)


@every
def test_frames_have_the_joint_axes_and_end_in_the_tool(arm: Robot):
    q, parameters = within_limits(arm, 6), other_parameters(arm)
    chain, printed = arm.chain(parameters), arm.frames(parameters, q)
    reached = frames(chain, q)
    assert printed.shape == (6, arm.n + 1, 4, 4)
    np.testing.assert_allclose(
        printed[..., :-1, :3, 2], reached[..., :-1, :3, 2], rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(printed[..., -1, :, :], reached[..., -1, :, :], rtol=0, atol=1e-14)
    offset = printed[..., :-1, :3, 3] - reached[..., :-1, :3, 3]
    np.testing.assert_allclose(np.cross(offset, reached[..., :-1, :3, 2]), 0, atol=1e-14)
    np.testing.assert_allclose(arm.frames(parameters, q[0]), printed[0], rtol=0, atol=1e-15)


def test_a_standard_table_prints_its_frames_from_the_base_on():
    arm = robot("planar_2r")
    printed = arm.frames(None, [math.pi / 2, 0])
    np.testing.assert_array_equal(printed[0], np.eye(4))
    np.testing.assert_allclose(printed[1, :3, 3], [0, 1, 0], atol=1e-15)
    np.testing.assert_allclose(printed[2, :3, 3], [0, 1.7, 0], atol=1e-15)


def test_hand_placed_frames_are_printed_from_the_first_joint_on():
    printed = robot("three_axis").frames({}, [0, -math.pi / 6, math.pi / 6])
    p = [[0, 0, 3], [0, 0, 3], [1, 0, 3 + math.sqrt(3)], [3, 0, 3 + math.sqrt(3)]]
    np.testing.assert_allclose(printed[:, :3, 3], p, rtol=0, atol=1e-14)


def test_a_hand_placed_joint_may_have_an_offset():
    arm = Robot(
        name="offset",
        title="Hand-placed frames with offsets",
        parameters={"l1": 0.5},
        rows=(
            (("Tz", "1"), ("Rz", "q1 + pi/3")),
            (("Rx", "pi/2"), ("Tz", "l1 + q2")),
            (("Ty", "l1"), ("Rz", "q3 - 1")),
        ),
        convention="frames",
        tool=(("Tx", "0.2"),),
        limits=((-1, 1), (0.1, 1), (-1, 1)),
        source="chosen here",
    )
    q = [0.3, 0.4, 0.5]
    assert arm.kinds == "RPR"
    np.testing.assert_allclose(forward(arm.chain(), q), arm.frames({}, q)[-1], rtol=0, atol=1e-15)


@every
def test_limits_and_provenance_are_stated(arm: Robot):
    assert len(arm.limits) == arm.n
    assert all(low < high for low, high in arm.limits)
    assert all(abs(x) <= 2 * math.pi for limits in arm.limits for x in limits)
    assert all(low > 0 for (low, _), kind in zip(arm.limits, arm.kinds, strict=True) if kind == "P")
    assert arm.title
    assert "limits" in arm.source


def test_the_limits_of_the_puma_are_those_of_the_toolbox():
    degrees = [(-160, 160), (-45, 225), (-225, 45), (-110, 170), (-100, 100), (-266, 266)]
    np.testing.assert_allclose(np.degrees(robot("puma560").limits), degrees, rtol=0, atol=1e-12)


@every
def test_parameters_left_out_have_their_defaults(arm: Robot):
    name = next(iter(arm.parameters))
    assert arm.values({name: 2}) == {**arm.parameters, name: 2.0}
    assert arm.chain() is arm.chain({})
    assert not np.array_equal(arm.chain({name: 2}).fixed, arm.chain().fixed)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (
            lambda: robot("puma"),
            "robot takes one of planar_2r, .*, got 'puma'; the nearest is 'puma560'",
        ),
        (
            lambda: robot("puma560").chain({"A2": 1.0}),
            "puma560 takes one of d1, .*, got 'A2'; the nearest is 'a2'",
        ),
        (lambda: robot("puma560").frames({"q1": 1.0}, [0] * 6), "takes one of d1, .*, got 'q1'"),
        (
            lambda: robot("puma560").chain({"a2": math.inf}),
            "parameter a2 of puma560 takes a finite number, got inf",
        ),
        (lambda: robot("puma560").chain({"a2": "1"}), "takes a finite number, got '1'"),  # type: ignore[dict-item]
        (lambda: robot("puma560").chain({"a2": True}), "takes a finite number, got True"),
        (
            lambda: robot("puma560").pose("qq"),
            "pose of puma560 takes one of qz, qr, qs, qn, example, got 'qq'",
        ),
        (lambda: robot("scara").pose("qz"), "pose of scara takes no name, got 'qz'"),
        (
            lambda: robot("panda").determinant,
            "determinant takes a robot with a factored task block, got panda",
        ),
        (lambda: robot("three_axis").table, "table takes a robot with a Denavit-Hartenberg table"),
    ],
)
def test_wrong_names_and_numbers_are_refused_with_a_sentence(
    call: Callable[[], object], sentence: str
):
    with pytest.raises(RobotError, match=sentence):
        call()
    assert issubclass(RobotError, KinegradeError)


@every
def test_a_configuration_of_the_wrong_size_is_refused(arm: Robot):
    with pytest.raises(ChainError, match=rf"q takes shape \(\.\.\., {arm.n}\)"):
        arm.frames({}, np.zeros(arm.n + 1))


@every
def test_named_configurations_lie_within_the_limits(arm: Robot):
    for name in arm.poses:
        q = arm.pose(name)
        assert q.shape == (arm.n,)
        for value, (low, high), kind in zip(q, arm.limits, arm.kinds, strict=True):
            turns = (
                (-2 * math.pi, 0, 2 * math.pi) if kind == "R" else (0,)
            )  # qn of the Puma has 180 for -180
            assert any(low <= value + turn <= high for turn in turns), name


@pytest.mark.parametrize(
    ("name", "singular"), [("qz", True), ("qr", True), ("qs", True), ("qn", False)]
)
def test_the_named_configurations_of_the_puma_are_wrist_singular_but_for_qn(
    name: str, singular: bool
):
    arm = robot("puma560")
    assert (abs(np.linalg.det(jacobian(arm.chain(), arm.pose(name)))) < 1e-15) == singular


def test_a_configuration_of_another_size_cannot_be_named():
    with pytest.raises(ChainError, match=r"pose flat of planar_2r takes shape \(\.\.\., 2\)"):
        replace(robot("planar_2r"), poses={"flat": (0.0,)}).pose("flat")


def test_a_pose_is_a_copy():
    robot("puma560").pose("qr")[0] = 7
    assert robot("puma560").pose("qr")[0] == 0


@pytest.mark.parametrize("name", ["puma560", "panda", "three_axis"])
def test_a_base_transform_leads_in_chain_and_frames(name: str):
    arm, q = robot(name), within_limits(robot(name), 5)
    length = next(iter(arm.parameters))
    based = replace(arm, base=(("Tz", "0.5"), ("Rx", "pi/3"), ("Ty", length)))
    base = steps_transform([("Tz", 0.5), ("Rx", math.pi / 3), ("Ty", arm.parameters[length])])
    np.testing.assert_allclose(
        forward(based.chain(), q), base @ forward(arm.chain(), q), rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(based.frames({}, q), base @ arm.frames({}, q), rtol=0, atol=1e-14)
    longer = steps_transform([("Tz", 0.5), ("Rx", math.pi / 3), ("Ty", 2.0)])
    moved = longer @ forward(arm.chain({length: 2}), q)
    np.testing.assert_allclose(forward(based.chain({length: 2}), q), moved, rtol=0, atol=1e-14)


def test_the_engine_starts_without_sympy():
    code = (
        "import sys; from kinegrade.solutions import robots, velocity, table; robots.robot('puma560').chain(); "
        "sys.exit('sympy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
