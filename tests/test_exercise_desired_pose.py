"""Two steps to a desired frame: written out with numpy from what is printed, followed, and told apart from mistakes."""

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from kinegrade.course.sheet.given import given_cell
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.answer_key import AnswerKey
from kinegrade.grader.marking.mark import mark

EXERCISE = EXERCISES["desired_pose"]
SEEDS = range(8)
QUARTER = np.pi / 2
ROWS = (  # d, a, alpha of the UR5
    (0.089459, 0, QUARTER), (0, -0.425, 0), (0, -0.39225, 0), (0.10915, 0, QUARTER), (0.09465, 0, -QUARTER),
    (0.0823, 0, 0),
)  # fmt: skip
ORDER = ("du", "dq", "rest", "second", "left")


def link(t, d, a, al):
    c, s, ca, sa = np.cos(t), np.sin(t), np.cos(al), np.sin(al)
    return np.array(
        [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    )


def pose(q):
    return np.linalg.multi_dot([link(t, *row) for t, row in zip(q, ROWS, strict=True)])


def vector(R):
    """The axis times the angle of a rotation well below half a turn."""
    w = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = np.linalg.norm(w)
    return w * np.arctan2(sine, (np.trace(R) - 1) / 2) / sine


def way(T, goal):
    """dp and dw in base axes."""
    return np.array([*goal[:3, 3] - T[:3, 3], *vector(goal[:3, :3] @ T[:3, :3].T)])


def jacobian(q, h=1e-6):
    """J in base axes by differences of poses."""
    J = np.zeros((6, 6))
    for i, e in enumerate(h * np.eye(6)):
        change = (pose(q + e) - pose(q - e)) / (2 * h)
        spin = change[:3, :3] @ pose(q)[:3, :3].T
        J[:, i] = *change[:3, 3], spin[2, 1], spin[0, 2], spin[1, 0]
    return J


def sizes(du):
    return np.array([np.linalg.norm(du[:3]), np.linalg.norm(du[3:])])


def sheet(v):
    """q and the desired frame as the student's notebook has them."""
    numbers = {}
    exec(f"import numpy as np\n{given_cell(EXERCISE, v)}", numbers)  # noqa: S102 - our own cell
    return numbers["desired_pose_q"], numbers["desired_pose_goal"]


def worked(v, **own):
    """All answers, from the student's `own` where there are some."""
    q, goal = sheet(v)
    found = {"du": own.get("du", way(pose(q), goal))}
    found["dq"] = own.get("dq", np.linalg.solve(jacobian(q), found["du"]))
    after = q + found["dq"]
    found["rest"] = own.get("rest", way(pose(after), goal))
    found["second"] = own.get("second", np.linalg.solve(jacobian(after), found["rest"]))
    found["left"] = own.get("left", sizes(way(pose(after + found["second"]), goal)))
    return found


def marked(v, answers, key=None):
    verdicts = mark(
        EXERCISE,
        v,
        raws({f"desired_pose_{name}": value for name, value in answers.items()}),
        key=key,
    )
    return dict(zip(ORDER, verdicts, strict=True))


def said(verdict):
    return " ".join(finding.text for finding in verdict.findings)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_sheet_solved_from_what_is_printed_alone_is_right(seed):
    v = variant_of("desired_pose", seed)
    own, answers = worked(v), references(EXERCISE, v)
    for name, value in own.items():
        np.testing.assert_allclose(answers[f"desired_pose_{name}"], value, atol=5e-8)
    rounded = {name: np.round(value, 6) for name, value in own.items()}
    assert {verdict.status for verdict in marked(v, rounded).values()} == {"correct"}


@pytest.mark.parametrize("seed", SEEDS)
def test_the_first_step_misses_clearly_and_the_second_by_a_tenth_of_that_at_most(seed):
    found = worked(variant_of("desired_pose", seed))
    first, second = sizes(found["rest"]), found["left"]
    assert (first >= 1e-3).all()
    assert (first < sizes(found["du"])).all()
    assert (second <= first / 10).all()
    assert (second >= 1e-4).all()  # a number of three digits at the asked decimals


def test_full_steps_on_go_to_the_desired_frame():
    v = variant_of("desired_pose", 1)
    q, goal = sheet(v)
    missing = []
    for _ in range(5):
        missing.append(np.abs(way(pose(q), goal)).max())
        q = q + np.linalg.solve(jacobian(q), way(pose(q), goal))
    assert missing == sorted(missing, reverse=True)
    assert missing[-1] < 1e-6


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_right_from_an_own_wrong_du_keeps_its_points(seed):
    v = variant_of("desired_pose", seed)
    right = worked(v)
    own = worked(v, du=right["du"] * [1, 1, 1, -1, -1, -1])
    verdicts = marked(v, own)
    assert verdicts["du"].points == pytest.approx(1.5)  # dp is right
    for name in ORDER[1:]:
        assert np.abs(own[name] - right[name]).max() > 1e-3, name
        assert verdicts[name].points == verdicts[name].out_of, name
    assert "your own desired_pose_du" in said(verdicts["dq"])


def test_one_wrong_entry_of_the_first_step_is_followed_by_the_rest_of_the_sheet():
    v = variant_of("desired_pose", 2)
    wrong = worked(v)["dq"] + [0, 0, 0.02, 0, 0, 0]
    verdicts = marked(v, worked(v, dq=wrong))
    assert 0 < verdicts["dq"].points < 2
    assert all(
        verdicts[name].points == verdicts[name].out_of for name in ("rest", "second", "left")
    )


def tool_axes(T, du):
    R = T[:3, :3]
    return np.array([*R.T @ du[:3], *R.T @ du[3:]])


def slips(T, goal):
    """Wrong displacements from T to the goal, by a word of the sentence that names each."""
    right, R, G = way(T, goal), T[:3, :3], goal[:3, :3]
    tool = tool_axes(T, right)
    return {
        "other way round": [*right[:3], *vector(R @ G.T)],
        "dw is in tool axes": [*right[:3], *vector(R.T @ G)],
        "dp is in tool axes": [*tool[:3], *right[3:]],
        "dp and dw are in tool axes": tool,
    }


def first_order(T, goal):
    M, right = goal[:3, :3] @ T[:3, :3].T, way(T, goal)
    half = np.array([M[2, 1] - M[1, 2], M[0, 2] - M[2, 0], M[1, 0] - M[0, 1]]) / 2
    roll_pitch_yaw = np.arctan2(M[2, 1], M[2, 2]), np.arcsin(-M[2, 0]), np.arctan2(M[1, 0], M[0, 0])
    return {
        "times the sine": [*right[:3], *half],
        "roll, pitch and yaw": [*right[:3], *roll_pitch_yaw],
    }


def mistakes(v):
    """Part, word of the sentence, and what somebody hands in who makes the mistake."""
    q, goal = sheet(v)
    right = worked(v)
    du, dq, rest, second = (right[name] for name in ORDER[:4])
    J, R, after = jacobian(q), pose(q)[:3, :3], q + dq
    in_tool = np.concatenate([R.T @ J[:3], R.T @ J[3:]])
    degrees = np.array([1, 1, 1, *[180 / np.pi] * 3])
    yield from (
        ("du", word, value)
        for word, value in {**slips(pose(q), goal), **first_order(pose(q), goal)}.items()
    )
    yield "du", "degrees", du * degrees
    yield "du", "Every sign", -du
    yield "dq", "transposed", J.T @ du
    yield "dq", "J is in tool axes", np.linalg.solve(in_tool, du)
    yield "dq", "degrees", np.degrees(dq)
    yield from (("rest", word, value) for word, value in slips(pose(after), goal).items())
    yield "rest", "really is", np.zeros(6)
    yield "rest", "backwards", way(pose(q - dq), goal)
    yield "rest", "degrees", rest * degrees
    yield "second", "Jacobian at q;", np.linalg.solve(J, rest)
    yield "second", "transposed", jacobian(after).T @ rest
    yield "second", "both steps", dq + second
    yield "left", "first step alone", sizes(rest)
    yield "left", "goes on from", sizes(way(pose(q + second), goal))
    yield "left", "millimetres", right["left"] * [1000, 1]


@pytest.mark.parametrize("seed", SEEDS)
def test_every_known_mistake_is_named_and_costs_its_share(seed):
    v = variant_of("desired_pose", seed)
    right, key = worked(v), AnswerKey(EXERCISE, v)
    for name, word, value in mistakes(v):
        verdict = marked(v, {**right, name: np.array(value)}, key)[name]
        assert word in said(verdict), (name, word)
        share = {"degrees": 0.75, "millimetres": 0.75, "really is": 0}.get(word, 0.5)
        assert verdict.points == share * verdict.out_of, (name, word)


def test_every_mistake_of_the_file_is_made_above():
    v = variant_of("desired_pose")
    made = {name: {word for part, word, _ in mistakes(v) if part == name} for name in ORDER}
    for part in EXERCISE.parts:
        words = made[part.variable.removeprefix("desired_pose_")]
        for mistake in part.mistakes:
            assert any(word in mistake.sentence for word in words), mistake.sentence


def test_a_du_in_tool_axes_with_a_jacobian_in_tool_axes_gives_the_right_step():
    v = variant_of("desired_pose", 3)
    q, goal = sheet(v)
    R, J = pose(q)[:3, :3], jacobian(q)
    du = tool_axes(pose(q), way(pose(q), goal))
    dq = np.linalg.solve(np.concatenate([R.T @ J[:3], R.T @ J[3:]]), du)
    verdicts = marked(v, {**worked(v), "du": du, "dq": dq})
    assert verdicts["du"].points == verdicts["du"].out_of / 2
    assert verdicts["dq"].status == "correct"


def test_a_step_into_a_singular_posture_is_marked_and_not_the_end_of_the_marking():
    v = variant_of("desired_pose", 4)
    q, _ = sheet(v)
    straight = -q * [0, 0, 1, 0, 1, 0]  # q3 = q5 = 0 after it: elbow and wrist
    answers = {**worked(v), "dq": straight}
    assert {verdict.status for verdict in marked(v, answers).values()} <= {
        "correct",
        "partly",
        "incorrect",
    }


@pytest.mark.parametrize("seed", SEEDS)
def test_the_figure_shows_the_arm_at_q_with_the_desired_frame(seed):
    v = variant_of("desired_pose", seed)
    q, goal = sheet(v)
    (drawing,) = EXERCISE.drawings(v)
    frames = {triad.label: triad.pose for triad in drawing.triads}
    np.testing.assert_allclose(drawing.q, q)
    np.testing.assert_allclose(frames["tool"], pose(q), atol=1e-12)
    np.testing.assert_array_equal(frames["desired"], goal)
