"""A table of iterates of unknown length, and a table for a sheet without joint values: asked, validated and marked."""

import json

import numpy as np
import pytest
from courses import exercise_of, sheet
from kinegrade.course.proof.validate import validate_file
from kinegrade.course.settings.config import Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.notebook import notebooks
from kinegrade.course.variants.variant import fingerprint
from kinegrade.exercises.exercise import Part, TableOf, references
from kinegrade.exercises.files.finding import load
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.table import read_table

NEWTON = '''
"""Newton steps of a planar arm towards a point: a row (q1, q2) for every step, until the tip is within 0.1 mm."""
import numpy as np
from kinegrade.exercises.draws import angles, length, until
from kinegrade.exercises.exercise import Configurations, Exercise, Mistake, Outcome, Part

NEAR = 1e-4  # [m]


def tip(v, q):
    a = np.cumsum(q)
    return np.array([v["l1"], v["l2"]]) @ np.stack([np.cos(a), np.sin(a)], axis=-1)


def J(v, q):
    a, l = np.cumsum(q), np.array([v["l1"], v["l2"]])
    columns = np.stack([-l * np.sin(a), l * np.cos(a)])
    return np.cumsum(columns[:, ::-1], axis=1)[:, ::-1]


def steps(v, solve=np.linalg.solve):
    q, rows = np.array(v["q"]), []
    for _ in range(12):
        q = q + solve(J(v, q), np.array(v["x"]) - tip(v, q))
        rows.append(q)
        if np.linalg.norm(tip(v, q) - v["x"]) < NEAR:
            break
    return np.array(rows)


def followed(v, given, value):
    """Rows are right while each follows from the one before; the table ends where the tip has arrived, not earlier."""
    before = np.array([v["q"], *value[:-1]])
    wanted = [q + np.linalg.pinv(J(v, q)) @ (np.array(v["x"]) - tip(v, q)) for q in before]
    follows = np.abs(value - wanted).max(axis=1) < 1e-3
    arrived = np.linalg.norm(tip(v, value[-1]) - v["x"]) < 1.5 * NEAR
    right = np.logical_and.accumulate(follows)
    many = len(steps(v))
    share = float(right.all()) if arrived else 0.5 * min(1, right.sum() / many)
    finding = "" if arrived else "The last row is not within 0.1 mm of the point."
    return Outcome(right=np.repeat(right[:, None], 2, axis=1), share=share, finding=finding)


def draw(rng):
    def one():
        v = {"l1": length(rng), "l2": length(rng), "q": angles(rng, 2, [(1,)])}
        off = np.array([round(float(x), 2) for x in rng.choice([-1, 1], 2) * rng.uniform(0.03, 0.5, 2)])
        return v | {"x": [round(float(x), 4) for x in tip(v, np.array(v["q"]) + off)]}
    def converges(v):
        many = len(steps(v))
        return abs(np.sin(v["q"][1])) > 0.4 and 2 <= many <= 5
    return until(one, converges)


EXERCISE = Exercise(
    slug="newton", title="Newton steps", source="made for tests", draw=draw, scale=lambda v: v["l1"] + v["l2"],
    units={"l1": "m", "l2": "m", "q": ["rad"] * 2, "x": ["m"] * 2}, statement=lambda v: "A planar arm.",
    parts=(Part("newton_q", "The joint angles after every Newton step", 4, Configurations(2, decimals=5, in_order=True),
                lambda v, given: steps(v), check=followed,
                mistakes=(Mistake("The transposed Jacobian is no inverse.",
                                  lambda v, given: steps(v, lambda A, b: A.T @ b)),)),),
)
'''


@pytest.fixture
def newton(tmp_path):
    """The file of an exercise that asks for Newton steps."""
    path = tmp_path / "newton.py"
    path.write_text(NEWTON, encoding="utf-8")
    return path


def drawn(exercise, seed=0):
    return json.loads(json.dumps(exercise.draw(np.random.default_rng(seed))))


def test_iterates_of_any_length_are_valid(newton):
    assert validate_file(newton, 20).failures == ()


def test_the_number_of_rows_follows_from_the_students_numbers(newton):
    exercise = load(newton)
    lengths = {len(references(exercise, drawn(exercise, seed))["newton_q"]) for seed in range(20)}
    assert len(lengths) > 1


@pytest.mark.parametrize(
    ("change", "points", "words"),
    [
        (lambda rows: rows, 4, ""),
        (lambda rows: rows.round(5), 4, ""),
        (lambda rows: rows.tolist(), 4, ""),
        (lambda rows: [[f"{x:.6f} rad" for x in row] for row in rows], 4, ""),
        (lambda rows: rows[:-1], None, "The last row is not within 0.1 mm of the point."),
        (lambda rows: rows[::-1], 0, "The last row is not within"),
        (lambda rows: rows[-1:], 0, ""),  # it arrives, but in one step
        (lambda rows: rows * 0, 0, "The last row is not within"),
        (lambda rows: np.tile(rows, (20, 1)), 0, "Takes up to 32 of them, got"),
        (lambda rows: rows[:, :1], 0, "Takes rows of 2 numbers each"),
    ],
)
def test_iterates_are_judged_by_what_follows_from_the_row_before(newton, change, points, words):
    exercise = load(newton)
    v = drawn(exercise, 2)
    value = change(references(exercise, v)["newton_q"])
    texts = isinstance(value, list) and isinstance(value[0][0], str)
    raw = Raw("text", value) if texts else Raw("num", np.asarray(value, dtype=float))
    (found,) = mark(exercise, v, {"newton_q": raw})
    assert words in " ".join(finding.text for finding in found.findings)
    if points is None:
        assert 0 < found.points < 4
    else:
        assert found.points == points


def test_a_known_mistake_in_a_table_of_rows_is_named(newton):
    exercise = load(newton)
    v, (part,) = drawn(exercise), exercise.asked
    wrong = part.mistakes[0].solve(v, {})
    (found,) = mark(exercise, v, {"newton_q": Raw("num", wrong)})
    assert "The transposed Jacobian is no inverse." in [finding.text for finding in found.findings]


def test_rows_in_order_are_not_said_to_cost_one_another(newton):
    exercise = load(newton)
    written, _ = notebooks(
        "Tests",
        sheet("graded", ("newton",)),
        Student("ada", "Ada"),
        [Assignment(exercise, drawn(exercise))],
    )
    assert "Give 5 decimals, row after row in their order." in written.decode()
    assert "A wrong one costs a right one" not in written.decode()


# --- a table without joint values

ROWS = [["q1", "d1", 0, "pi/2"], ["q2 + pi/2", 0, "a2", 0], [0, "q3", 0.25, 0]]
TABLE = TableOf(("d1", "a2"), "RRP")


def without_q(**more):
    """An exercise that asks for a table of an arm that stands nowhere."""
    part = Part(
        "t_dh", "DH?", 6, TABLE, lambda *_: read_table(ROWS, ("d1", "a2", "q1", "q2", "q3"))
    )
    lengths = lambda rng: {name: round(float(rng.uniform(0.2, 0.8)), 3) for name in ("d1", "a2")}  # noqa: E731
    return exercise_of(part, draw=lengths, units={"d1": "m", "a2": "m"}, **more)


def test_a_table_is_pictured_without_joint_values():
    exercise = without_q()
    first, second = (fingerprint(exercise, drawn(exercise, seed))["t_dh"] for seed in (1, 2))
    assert np.shape(first) == (3, 4)
    assert first[0][0] == second[0][0]  # the same joint values for everybody
    assert first[0][1] != second[0][1]  # lengths are drawn
    angles = [first[0][0], first[1][0], first[2][1]]
    assert len({abs(x) for x in angles} - {0, 1}) == 3


@pytest.mark.parametrize(
    ("change", "points"),
    [({}, 6), ({(0, 1): "a2"}, None), ({(1, 0): "q2"}, None), ({(0, 3): "-pi/2"}, None)],
)
def test_a_table_is_marked_without_joint_values(change, points):
    exercise = without_q()
    rows = [[*map(str, row)] for row in ROWS]
    for (i, j), cell in change.items():
        rows[i][j] = cell
    (found,) = mark(exercise, drawn(exercise), {"t_dh": Raw("text", rows)})
    assert found.points == points if points else found.points < 6
    assert found.status == ("correct" if points else "partly")


def test_a_number_in_the_place_of_a_joint_is_refused_where_no_q_is_given():
    exercise = without_q()
    v = drawn(exercise)
    numbers = np.array([[0.3, v["d1"], 0, np.pi / 2], [0.4, 0, v["a2"], 0], [0, 0.5, 0.25, 0]])
    (found,) = mark(exercise, v, {"t_dh": Raw("num", numbers)})
    assert found.status == "failed"
    assert "Row 1, theta: takes q1, got 0.3." in found.findings[0].text
