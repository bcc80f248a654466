"""A table is marked in the convention that its student declares, and so is all that follows from it."""

import io
import json
from pathlib import Path

import numpy as np
import pytest
from answers import raw
from courses import notebook
from kinegrade.course.sheet.submissions import Submission
from kinegrade.exercises import questions as ask
from kinegrade.exercises.answers import TableOf
from kinegrade.exercises.draws import angles, length
from kinegrade.exercises.exercise import ExerciseError, references
from kinegrade.exercises.part import exercise
from kinegrade.grader.collecting.ask import Limits
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import handed_in
from kinegrade.grader.marking.mark import mark
from kinegrade.solutions.equivalence import Given
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.table import read_table
from scipy.io import savemat

ROBOT = ROBOTS["rrt_offset"]
STANDARD = [[str(cell) for cell in row] for row in ROBOT.table.rows]
MODIFIED = [  # a and alpha belong to the link before the joint
    [*STANDARD[0][:2], "0", "0"],
    [*STANDARD[1][:2], *STANDARD[0][2:]],
    [*STANDARD[2][:2], *STANDARD[1][2:]],
]
ROWS = {"standard": STANDARD, "modified": MODIFIED}
OTHERWISE = {  # x of frame 2, and z of frame 1 or 2, the other way
    "standard": [
        STANDARD[0],
        ["q2 + pi", STANDARD[1][1], "0", f"-({STANDARD[1][3]})"],
        ["pi", *STANDARD[2][1:]],
    ],
    "modified": [
        MODIFIED[0],
        ["q2 + pi", *MODIFIED[1][1:]],
        ["pi", MODIFIED[2][1], "0", f"-({MODIFIED[2][3]})"],
    ],
}


def exercise_of(*parts, robot=ROBOT, **table):
    def draw(rng):
        lengths = {name: length(rng) for name in robot.parameters}
        return {**lengths, "q": [*angles(rng, robot.n - 1), length(rng)]}

    return exercise(
        "own", title="t", source="s", robot=robot, draw=draw, parts=[ask.dh_table(**table), *parts]
    )


EITHER = exercise_of(ask.transforms(), ask.jacobian(), either=True)
POSES = exercise_of(ask.pose(), ask.jacobian(), either=True)
V = json.loads(json.dumps(EITHER.draw(np.random.default_rng(3))))


def table(rows, convention):
    return read_table(rows, ROBOT.names, convention)


def carried_on(exercise, own):
    """Answers of somebody who goes on rightly from a table of their own."""
    answers = {"own_dh": own}
    for part in exercise.parts[1:]:
        answers[part.variable] = part.solve(V, answers)
    return answers


def marked(exercise, answers, declared=""):
    handed = {
        part.variable: handed_in(part.answer, answers[part.variable], V) for part in exercise.asked
    }
    handed["own_dh"] = raw(answers["own_dh"])
    if declared:
        handed["own_dh_convention"] = Raw("text", declared)
    return {verdict.part: verdict for verdict in mark(exercise, V, handed)}


def said(verdict):
    return " ".join(finding.text for finding in verdict.findings)


@pytest.mark.parametrize("rows", [ROWS, OTHERWISE], ids=["as printed", "otherwise"])
@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("exercise", [EITHER, POSES], ids=["transforms", "pose"])
def test_a_table_of_the_declared_convention_is_right_and_so_is_all_in_its_frames(
    exercise, convention, rows
):
    answers = carried_on(exercise, table(rows[convention], convention))
    verdicts = marked(exercise, answers, convention)
    assert {verdict.status for verdict in verdicts.values()} == {"correct"}
    assert f"It was read as a {convention} table." in verdicts["own_dh"].reading
    reference = references(exercise, V)
    same_frames = rows is ROWS and convention == "standard"
    if exercise is EITHER:
        moved = np.abs(answers["own_T"] - reference["own_T"]).max()
        assert (moved > 1e-9) != same_frames
    np.testing.assert_allclose(answers["own_J"], reference["own_J"], atol=1e-9)


@pytest.mark.parametrize("row", [0, 1])
@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("exercise", [EITHER, POSES], ids=["transforms", "pose"])
def test_with_one_wrong_alpha_all_the_rest_follows_on_the_own_chain(exercise, convention, row):
    row += convention == "modified"
    rows = [[*cells] for cells in ROWS[convention]]
    rows[row][3] = f"-({rows[row][3]})"
    answers = carried_on(exercise, table(rows, convention))
    verdicts = marked(exercise, answers, convention)
    assert f"Row {row + 1}: alpha has the wrong sign." in said(verdicts["own_dh"])
    assert verdicts.pop("own_dh").points == 0.75 * 3
    assert {verdict.status for verdict in verdicts.values()} == {"follows"}
    assert np.abs(answers["own_J"] - references(exercise, V)["own_J"]).max() > 0.1


def test_a_table_that_is_declared_wrongly_is_told_and_priced_as_a_presentation():
    verdicts = marked(EITHER, carried_on(EITHER, table(MODIFIED, "standard")), "standard")
    assert said(verdicts["own_dh"]) == (
        "This is the modified table of the arm; beside it, you say that it is a standard one."
    )
    assert verdicts["own_dh"].points == 0.75 * 3


@pytest.mark.parametrize(
    ("declared", "read"),
    [
        ("", "standard"),
        (" ", "standard"),
        ("Modified", "modified"),
        ("modified (Craig)", "modified"),
    ],
)
def test_what_is_declared_may_be_written_freely(declared, read):
    verdicts = marked(EITHER, carried_on(EITHER, table(ROWS[read], read)), declared)
    assert verdicts["own_dh"].status == "correct"


def test_another_word_is_refused():
    verdicts = marked(EITHER, carried_on(EITHER, table(STANDARD, "standard")), "Denavit")
    assert verdicts["own_dh"].status == "failed"
    assert "takes 'standard' or 'modified', got Denavit" in said(verdicts["own_dh"])


def test_where_the_sheet_fixes_the_convention_nothing_is_declared():
    fixed = exercise_of(ask.transforms())
    assert fixed.parts[0].beside == {}
    verdicts = marked(fixed, carried_on(fixed, table(MODIFIED, "standard")), "modified")
    assert said(verdicts["own_dh"]).startswith(
        "This is the modified table of the arm; the standard"
    )


def test_a_tool_frame_beside_the_last_axis_has_no_modified_table():
    with pytest.raises(ExerciseError, match="where the tool frame lies on the axis of its joint"):
        exercise_of(robot=ROBOTS["planar_2r"], either=True)
    exercise_of(robot=ROBOTS["planar_2r"], either=True, given=Given(tool=False))


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        (TableOf((), "RR"), ""),
        (
            TableOf((), "RR", given=Given(base=False, zero=False)),
            "You may choose the base frame and the zeros of the joint variables yourself.",
        ),
        (
            TableOf((), "RR", "either"),
            "Say beside it whether your table is a standard or a modified one.",
        ),
    ],
)
def test_the_sheet_says_what_is_free(answer, words):
    assert answer.asked_beside == words


def in_notebook(values):
    return notebook(*(f"{name} = {value!r}" for name, value in values.items()))


def in_json(values):
    return json.dumps(values).encode()


def in_csv(values):
    rows = "\n".join(",".join(row) for row in values["own_dh"])
    return f"own_dh_convention\n{values['own_dh_convention']}\n\nown_dh\n{rows}\n".encode()


def in_mat(values):
    file = io.BytesIO()
    cells = np.array(values["own_dh"], dtype=object)
    savemat(file, {**values, "own_dh": cells})
    return file.getvalue()


FILES = {".ipynb": in_notebook, ".json": in_json, ".csv": in_csv, ".mat": in_mat}


@pytest.mark.parametrize("suffix", FILES)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_declared_convention_comes_out_of_every_kind_of_file(suffix, convention):
    values = {"own_dh": ROWS[convention], "own_dh_convention": convention}
    submission = Submission(Path(f"own{suffix}"), FILES[suffix](values))
    raws = submission.raws(submission.asks(EITHER, V), Limits())
    verdict = mark(EITHER, V, raws)[0]
    assert (verdict.status, verdict.findings) == ("correct", ())
    assert f"It was read as a {convention} table." in verdict.reading


def test_the_cell_that_is_handed_out_holds_the_declaration():
    (part, *_) = EITHER.parts
    assert part.answer.blank("own_dh").splitlines() == [
        'own_dh_convention = "standard"  # or "modified"',
        "own_dh = ...  # 3 rows [theta, d, a, alpha]",
    ]
    code = part.answer.code("own_dh", table(MODIFIED, "modified"))
    assert code.startswith("own_dh_convention = 'modified'\nown_dh = [")
