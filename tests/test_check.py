"""A student's own check tells what the sheet's mode allows, and never a reference value."""

import json
import re

import numpy as np
import pytest
from answers import EXERCISES, variant_of
from courses import BUNDLED, notebook
from kinegrade.course.blanks import answer_code
from kinegrade.course.check import _told, check_file, read_handout
from kinegrade.course.config import CourseError
from kinegrade.exercises.exercise import references
from kinegrade.grader.verdict import Finding, Verdict
from kinegrade.solutions.table import Table

MODES = ("practice", "graded", "exam")


def about(mode, *slugs):
    numbers = {slug: variant_of(slug) for slug in slugs or ("rrt",)}
    return {"sheet": "one", "student": "ada", "mode": mode, "exercises": list(numbers), "numbers": numbers}


def solved(mode, spoil=lambda _, answer: answer, slugs=("rrt",)):
    cells = []
    for slug in slugs:
        exercise = EXERCISES[slug]
        answers = references(exercise, variant_of(slug))
        cells += [answer_code(part, spoil(part.variable, answers[part.variable])) for part in exercise.asked]
    return notebook("import numpy as np", *cells, about=about(mode, *slugs))


def checked(tmp_path, data, **options):
    path = tmp_path / options.pop("name", "one.ipynb")
    path.write_bytes(data)
    return check_file(path, **options)


def negated(name):
    """A spoiler of one answer."""
    return lambda variable, answer: -answer if variable == name else answer


@pytest.mark.parametrize("mode", MODES)
def test_right_answers_are_fine_in_every_mode(tmp_path, mode):
    handout, found = checked(tmp_path, solved(mode, slugs=BUNDLED))
    assert (handout.sheet, handout.mode) == ("one", mode)
    assert [remark.part for remark in found] == [part.variable for slug in BUNDLED for part in EXERCISES[slug].asked]
    assert all(remark.ok for remark in found)


@pytest.mark.parametrize(
    ("mode", "ok", "words"),
    [
        ("practice", [True, True, False], "incorrect"),
        ("graded", [True, True, False], "can be read, but does not follow from your own"),
        ("exam", [True, True, True], "can be read"),
    ],
)
def test_a_wrong_answer_is_told_as_the_mode_allows(tmp_path, mode, ok, words):
    _, found = checked(tmp_path, solved(mode, negated("rrt_J")))
    assert [remark.ok for remark in found] == ok
    assert words in found[2].text


def test_a_graded_sheet_does_not_tell_whether_answers_are_right(tmp_path):
    """All of it is wrong, and each follows from the one before."""
    exercise, v = EXERCISES["three_axis"], variant_of("three_axis")
    given = {"three_axis_p": references(exercise, v)["three_axis_p"] + 0.25, "three_axis_z": -np.eye(3)}
    for part in exercise.asked[2:]:
        given[part.variable] = part.solve(v, given)
    cells = [answer_code(part, given[part.variable]) for part in exercise.asked]
    _, found = checked(tmp_path, notebook("import numpy as np", *cells, about=about("graded", "three_axis")))
    assert all(remark.ok for remark in found)
    assert all(re.fullmatch(r"can be read( and follows from your own .*)?", remark.text) for remark in found)


@pytest.mark.parametrize("mode", MODES)
def test_no_reference_value_is_ever_told(tmp_path, mode, exercise):
    def spoil(_, answer):
        return answer if isinstance(answer, Table) else -1.3 * answer

    _, found = checked(tmp_path, solved(mode, spoil, (exercise.slug,)))
    text = " ".join(remark.text for remark in found)
    for name, answer in references(exercise, variant_of(exercise.slug)).items():
        if not isinstance(answer, Table):
            telling = [f"{abs(x):.3f}" for x in answer.ravel() if abs(x - round(x, 2)) > 1e-6]
            assert [value for value in telling if value in text] == [], name


def test_what_is_private_is_not_told_either():
    verdict = Verdict("rrt_J", "partly", 1.0, 4, (Finding("open"), Finding("like ben's", private=True)), "as read")
    told = _told(verdict)
    assert (told.ok, told.text) == (False, "partly correct as read open")


@pytest.mark.parametrize("mode", MODES)
def test_what_cannot_be_read_is_told_in_every_mode(tmp_path, mode):
    cells = ("rrt_dh = [['q1']]", "rrt_T = 'x'", "rrt_J = {1: 2}")
    _, found = checked(tmp_path, notebook(*cells, about=about(mode)))
    assert not any(remark.ok for remark in found)
    for remark, words in zip(found, ("rows of theta, d, a, alpha", "got text: x", "a dict"), strict=True):
        assert words in remark.text


@pytest.mark.parametrize("mode", MODES)
def test_an_empty_sheet_is_told_so(tmp_path, mode):
    _, found = checked(tmp_path, notebook("rrt_J = ...", about=about(mode)))
    assert [(remark.ok, remark.text) for remark in found] == [(False, "not answered")] * 3


def test_a_file_of_matrices_is_checked_with_the_sheet_as_it_was_handed_out(tmp_path):
    sheet = tmp_path / "sheet.ipynb"
    sheet.write_bytes(notebook(about=about("practice")))
    answers = references(EXERCISES["rrt"], variant_of("rrt"))
    data = {"rrt_J": answers["rrt_J"].tolist(), "rrt_T": answers["rrt_T"].tolist()}
    _, found = checked(tmp_path, json.dumps(data).encode(), name="mine.json", sheet=sheet)
    assert [remark.ok for remark in found] == [False, True, True]


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"[]",
        b"\xff\xfe",
        b"{",
        notebook("x = 1"),
        notebook(about={"mode": "graded"}),
        b'{"metadata": 5}',
        b"[" * 100_000,
    ],
)
def test_a_file_that_does_not_say_its_sheet_gets_told_what_to_do(tmp_path, data):
    with pytest.raises(CourseError, match=r"does not say which sheet it belongs to .* --sheet HANDED_OUT.ipynb"):
        checked(tmp_path, data)


@pytest.mark.parametrize(
    "change", [{"mode": "open"}, {"numbers": [1]}, {"numbers": {"rrt": 1}}, {"exercises": 3}, {"mode": []}]
)
def test_damaged_metadata_are_refused(tmp_path, change):
    with pytest.raises(CourseError, match="does not say which sheet"):
        checked(tmp_path, notebook("x = 1", about=about("graded") | change))


@pytest.mark.parametrize("v", [{}, {"q": []}, {"q": "x"}, {"q": [0.1, 0.2, 0.3]}, {"q": None}])
def test_damaged_numbers_are_named(tmp_path, v):
    data = json.loads(solved("practice"))
    data["metadata"]["kinegrade"]["numbers"]["rrt"] = v
    with pytest.raises(CourseError, match=r"one.ipynb: the numbers of rrt in this sheet are damaged"):
        checked(tmp_path, json.dumps(data).encode())


def test_an_exercise_that_is_not_installed_is_named(tmp_path):
    data = json.loads(solved("practice"))
    about = data["metadata"]["kinegrade"]
    about |= {"exercises": ["rtt", *about["exercises"]], "numbers": {"rtt": {}, **about["numbers"]}}
    _, (first, *others) = checked(tmp_path, json.dumps(data).encode())
    assert (first.part, first.ok) == ("rtt", True)
    assert "not installed here" in first.text
    assert others
    about |= {"exercises": ["rtt"]}
    with pytest.raises(CourseError, match="none of its exercises is installed here: rtt"):
        checked(tmp_path, json.dumps(data).encode())


def test_files_that_cannot_be_read_are_named(tmp_path):
    with pytest.raises(CourseError, match=r"nowhere.ipynb cannot be read: No such file"):
        check_file(tmp_path / "nowhere.ipynb")
    with pytest.raises(CourseError, match=r"gone.ipynb cannot be read: No such file"):
        checked(tmp_path, solved("graded"), sheet=tmp_path / "gone.ipynb")
    with pytest.raises(CourseError, match=r"one.docx: a submission takes one of the endings .ipynb, .json, .csv"):
        checked(tmp_path, b"PK", name="one.docx")


def test_the_sheet_as_released_says_what_it_is(bundled_course):
    handout = read_handout(bundled_course.folder / "released" / "ada" / "one.ipynb")
    assert (handout.sheet, handout.mode, tuple(handout.numbers)) == ("one", "graded", BUNDLED)
