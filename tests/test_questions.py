"""Ready-made questions on every robot of the catalogue: proved as any exercise, and told apart by their rows."""

import numpy as np
import pytest
from answers import raws
from kinegrade.course.proof.validate import validate_file
from kinegrade.exercises import questions as ask
from kinegrade.exercises.answers import TableOf
from kinegrade.exercises.arm import Arm
from kinegrade.exercises.contract.introduction import introduction
from kinegrade.exercises.draws import parallel_groups, posture
from kinegrade.exercises.exercise import ExerciseError, references
from kinegrade.exercises.files.finding import load
from kinegrade.exercises.part import exercise
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS

FILE = '''"""Ready-made questions for one robot."""

import numpy as np
from kinegrade.exercises import questions as ask
from kinegrade.exercises.draws import posture, rates
from kinegrade.exercises.contract.introduction import introduction
from kinegrade.exercises.part import exercise
from kinegrade.exercises.calculations.twists import rate_units, twist_units, wrench_units
from kinegrade.solutions.robots import ROBOTS

ROBOT = ROBOTS["@ROBOT@"]
TASK = ROBOT.task_rows


def load_(rng):
    return [round(float(x), 1) for x in rng.uniform(2, 9, 6) * rng.choice([-1, 1], 6)]


def draw(rng):
    more = {"qdot": rates(rng, ROBOT.n), "wrench": load_(rng), "tool_wrench": load_(rng), "v_t": rates(rng, len(TASK))}
    return posture(ROBOT, rng) | more


EXERCISE = exercise(
    "ready",
    title="Ready-made",
    source="tests",
    robot=ROBOT,
    draw=draw,
    rows="@ROWS@",
    units={
        "qdot": rate_units(ROBOT.kinds),
        "wrench": wrench_units(@ORDER@),
        "tool_wrench": wrench_units(@ORDER@),
        "v_t": twist_units([row for row in @ORDER@ if row in TASK]),
    },
    parts=[@PARTS@],
)
'''
FIRST = {"linear, angular": "(0, 1, 2, 3, 4, 5)", "angular, linear": "(3, 4, 5, 0, 1, 2)"}


def parts_for(robot):
    last = (
        f"ask.jacobian(point={robot.n}, rows='linear', name='J_last')"
        if robot.convention != "frames"
        else ""
    )
    table = "ask.dh_table()" if robot.convention != "frames" else ""
    block = "ask.determinant(), ask.singular()" if robot.factors else ""
    linear = all(row < 3 for row in robot.task_rows)
    listed = (
        table,
        "ask.transforms()",
        "ask.jacobian()",
        "ask.jacobian(frame='tool', name='J_tool')",
        "ask.jacobian(point='origin', name='J_origin')",
        last,
        "ask.pose(name='T_tool')",
        "ask.to_tool_axes(name='J_turned', T='T_tool')",
        "ask.to_base_origin(name='J_moved', T='T_tool')",
        "ask.twist()",
        "ask.torques()",
        "ask.torques(axes='tool', wrench='tool_wrench', name='tau_tool')",
        "ask.jacobian(rows='task', name='J_task')",
        "ask.manipulability(J='J_task')",
        "ask.ellipsoid(rows='task', J='J_task')" if linear else "",
        "ask.rates(rows='task', J='J_task', xi='v_t')",
        block,
    )
    return ", ".join(filter(None, listed))


def written(folder, name, rows="linear, angular"):
    path = folder / "ready.py"
    text = FILE.replace("@ROBOT@", name).replace("@ROWS@", rows).replace("@ORDER@", FIRST[rows])
    path.write_text(text.replace("@PARTS@", parts_for(ROBOTS[name])), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", ROBOTS)
def test_ready_made_questions_are_valid(tmp_path, name):
    assert validate_file(written(tmp_path, name), 3).failures == ()


@pytest.mark.parametrize("name", ["rrt_offset", "puma560", "planar_3r"])
def test_with_the_angular_rows_on_top_they_are_valid_too(tmp_path, name):
    path = written(tmp_path, name, "angular, linear")
    assert validate_file(path, 3).failures == ()
    made = load(path)
    v = made.draw(np.random.default_rng(0))
    J = jacobian(ROBOTS[name].chain({k: v[k] for k in ROBOTS[name].parameters}), v["q"])
    got = references(made, v)
    np.testing.assert_allclose(got["ready_J"], J[[3, 4, 5, 0, 1, 2]], atol=1e-12)
    np.testing.assert_allclose(got["ready_J_turned"], got["ready_J_tool"], atol=1e-12)
    np.testing.assert_allclose(got["ready_J_moved"], got["ready_J_origin"], atol=1e-12)
    wrench = np.array(v["wrench"])
    np.testing.assert_allclose(
        got["ready_tau"], J[:3].T @ wrench[3:] + J[3:].T @ wrench[:3], atol=1e-12
    )
    whole = next(part for part in made.parts if part.variable == "ready_J")
    assert "angular rows above linear rows" in whole.prompt


def made_of(name, *parts, **more):
    robot = ROBOTS[name]
    return exercise(
        "made",
        title="T",
        source="S",
        robot=robot,
        draw=lambda rng: posture(robot, rng),
        parts=parts,
        **more,
    )


def test_a_jacobian_follows_from_own_transforms_and_torques_from_an_own_jacobian():
    wrench = {"units": {"wrench": ["N"] * 3 + ["N m"] * 3}}
    robot = ROBOTS["rrt_offset"]
    made = exercise(
        "made",
        title="T",
        source="S",
        robot=robot,
        draw=lambda rng: posture(robot, rng) | {"wrench": [3.0, -4.0, 5.0, 1.0, 2.0, -1.0]},
        parts=[ask.dh_table(), ask.transforms(), ask.jacobian(), ask.torques()],
        **wrench,
    )
    assert [part.needs for part in made.parts] == [(), ("made_dh",), ("made_T",), ("made_J",)]
    v = made.draw(np.random.default_rng(1))
    right = references(made, v)
    own = dict(right)
    own["made_T"] = right["made_T"].copy()
    own["made_T"][0, 0, 3] += 0.2
    for part in made.parts[2:]:
        own[part.variable] = part.solve(v, {name: own[name] for name in part.needs})
    assert np.abs(own["made_J"] - right["made_J"]).max() > 0.05
    verdicts = mark(made, v, raws(own))
    assert [verdict.status for verdict in verdicts] == ["correct", "partly", "follows", "follows"]
    assert [verdict.points for verdict in verdicts[2:]] == [part.points for part in made.parts[2:]]


def test_jacobians_in_other_frames_follow_from_an_own_pose_and_jacobian():
    made = made_of(
        "rrt_offset", ask.pose(), ask.jacobian(), ask.to_tool_axes(), ask.to_base_origin()
    )
    assert [part.needs for part in made.parts] == [
        (),
        (),
        ("made_T", "made_J"),
        ("made_T", "made_J"),
    ]
    v = made.draw(np.random.default_rng(1))
    right = references(made, v)
    own = dict(right)
    own["made_J"] = right["made_J"].copy()
    own["made_J"][0, 0] += 0.2
    for part in made.parts[2:]:
        own[part.variable] = part.solve(v, {name: own[name] for name in part.needs})
        assert np.abs(own[part.variable] - right[part.variable]).max() > 0.05
    verdicts = mark(made, v, raws(own))
    assert [verdict.status for verdict in verdicts] == ["correct", "partly", "follows", "follows"]
    assert [verdict.points for verdict in verdicts[2:]] == [part.points for part in made.parts[2:]]


def test_a_slide_taken_for_a_turning_joint_is_named_by_its_number_where_it_is_the_only_one():
    for name, words in (
        ("rrt_offset", "Column 3 looks as if joint 3"),
        ("rpp_cylindrical", "A prismatic column"),
    ):
        made = made_of(name, ask.jacobian())
        assert any(mistake.sentence.startswith(words) for mistake in made.parts[0].mistakes)


def test_the_point_of_a_link_is_not_moved_by_joints_behind_it():
    made = made_of("puma560", ask.jacobian(point=3, rows="linear"))
    v = made.draw(np.random.default_rng(2))
    J = references(made, v)["made_J"]
    assert not J[:, 3:].any()
    arm = ROBOTS["puma560"]
    lengths = {name: v[name] for name in arm.parameters}
    q, h = np.array(v["q"]), 1e-6
    for i in range(3):
        step = h * np.eye(6)[i]
        after, before = (arm.frames(lengths, q + side * step)[3, :3, 3] for side in (1, -1))
        np.testing.assert_allclose(J[:, i], (after - before) / (2 * h), atol=1e-8)


def test_a_sheet_that_asks_for_the_table_does_not_print_it():
    made = made_of("rrt_offset", ask.dh_table(), ask.transforms())
    assert isinstance(made.parts[0].answer, TableOf)
    v = made.draw(np.random.default_rng(0))
    assert r"\alpha_i" not in made.statement(v)
    home, now = made.drawings(v)
    assert home.q[:2] == (0.0, 0.0)
    assert {line.name for line in home.dimensions} == {"d1", "a1", "d2", "q3"}
    assert now.q == tuple(v["q"])


@pytest.mark.parametrize(
    ("question", "match"),
    [
        (ask.jacobian(rows="all of them"), "rows takes 'all', 'linear', 'angular', 'task'"),
        (ask.jacobian(rows=(0, 7)), "or some of 0 to 5"),
        (ask.dh_table(), "dh_table takes a robot with a Denavit-Hartenberg table"),
        (ask.twist(J="J0"), "takes 'qdot', which is no name on the sheet"),
    ],
)
def test_what_does_not_fit_the_robot_is_refused_when_the_file_loads(question, match):
    with pytest.raises(ExerciseError, match=match):
        made_of("three_axis", ask.jacobian(name="J0"), question)


def test_a_ready_made_question_of_an_arm_without_a_drawn_q_is_refused_with_a_sentence():
    robot = ROBOTS["rrt_offset"]
    with pytest.raises(
        ExerciseError, match=r"arm takes a q among the drawn numbers, one value for each of the 3"
    ):
        exercise(
            "made",
            title="T",
            source="S",
            robot=robot,
            draw=lambda _: {"d1": 0.4},
            parts=[ask.dh_table()],
        )


def test_formulas_are_asked_of_drawn_lengths_only():
    robot = ROBOTS["puma560"]
    with pytest.raises(
        ExerciseError, match=r"determinant takes an arm whose lengths are drawn.*a2, a3, d4"
    ):
        exercise(
            "made",
            title="T",
            source="S",
            robot=robot,
            draw=lambda rng: posture(robot, rng, lengths=()),
            parts=[ask.determinant()],
        )


@pytest.mark.parametrize("name", ROBOTS)
def test_postures_are_regular_within_limits_and_clear_of_right_angles(name):
    robot = ROBOTS[name]
    for seed in range(5):
        v = posture(robot, np.random.default_rng(seed))
        assert not robot.outside(v["q"])
        for group in [
            *parallel_groups(robot),
            *((i,) for i, kind in enumerate(robot.kinds) if kind == "R"),
        ]:
            total = np.degrees(sum(v["q"][i] for i in group)) % 90
            assert 9.5 < total < 80.5


def test_parallel_axes_are_found():
    assert parallel_groups(ROBOTS["ur5"]) == [(1, 2), (1, 2, 3), (2, 3)]
    assert parallel_groups(ROBOTS["planar_2r"]) == [(0, 1)]
    assert parallel_groups(ROBOTS["rrt_spherical"]) == []
    assert (0, 1) in parallel_groups(ROBOTS["scara"])


def test_an_arm_is_introduced_by_its_table_with_numbers_for_what_is_not_drawn():
    robot = ROBOTS["panda"]
    said = introduction(Arm(robot, {"d1": 0.3}, np.zeros(7)))
    assert r"| $1$ | $q_1$ | $d_1$ | $0$ | $0$ |" in said
    assert r"| $5$ | $q_5$ | $0.384$ | $-0.0825$ | $-\pi/2$ |" in said
    assert r"by $T_z(0.103)\,R_z(-\pi/4)$" in said
    frames = introduction(Arm(ROBOTS["three_axis"], {"L": 1.0}, np.zeros(3)))
    assert "\n- $\\mathbf T_{0}^{1} = T_z(L)\\,R_z(q_1)$\n" in frames
    assert r"T_y(2)\,R_z(q_3)" in frames


URDF = """<robot name="arm"><link name="base"/><link name="a"/><link name="b"/>
<joint name="turn" type="revolute"><parent link="base"/><child link="a"/><origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/>
<axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="a"/><child link="b"/>
<origin xyz="0.3 0 0" rpy="0 1.5707963267948966 0"/>
<axis xyz="1 0 0"/><limit lower="0.1" upper="0.4" effort="1" velocity="1"/></joint></robot>"""
TABLE_FILE = '''"""An arm from a table, and one from a URDF."""
from kinegrade.exercises import questions as ask
from kinegrade.exercises.draws import posture, rates
from kinegrade.exercises.part import exercise
from kinegrade.solutions.any_robot import robot_from_table, robot_from_urdf

ARM = @ARM@
EXERCISE = exercise(
    "own",
    title="T",
    source="S",
    robot=ARM,
    draw=lambda rng: posture(ARM, rng) | {"qdot": rates(rng, ARM.n)},
    units={"qdot": @UNITS@},
    parts=[ask.transforms(), ask.jacobian(), ask.twist()],
)
'''
ROWS = 'robot_from_table([("q1", "d1", "0", "pi/2"), ("q2", "0", "a2", "0"), ("0", "q3 + a2", "0", "pi/2")], '

MODIFIED = 'robot_from_table([("q1", "d1", "0", "0"), ("q2", "a2", "0", "pi/2"), ("0", "q3", "0", "-pi/2")], '


@pytest.mark.parametrize(
    ("arm", "units"),
    [
        (f'{ROWS}{{"d1": 0.4, "a2": 0.3}})', '["rad/s", "rad/s", "m/s"]'),
        (
            f'{MODIFIED}{{"d1": 0.4, "a2": 0.3}}, convention="modified")',
            '["rad/s", "rad/s", "m/s"]',
        ),
        (f"robot_from_urdf({URDF!r})", '["rad/s", "m/s"]'),
    ],
    ids=["standard table", "modified table", "URDF"],
)
def test_an_arm_of_a_table_or_a_urdf_needs_no_more(tmp_path, arm, units):
    path = tmp_path / "own.py"
    path.write_text(TABLE_FILE.replace("@ARM@", arm).replace("@UNITS@", units), encoding="utf-8")
    assert validate_file(path, 5).failures == ()
