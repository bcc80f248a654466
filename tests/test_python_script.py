"""A sheet as a script: the notebook's cells in blocks, to be answered, checked and marked as they are."""

import ast
import json
from pathlib import Path

import pytest
from answers import EXERCISES, SLUGS, answer_code, variant_of
from courses import handed_out, make_course, right_answers
from kinegrade.course.settings.config import Sheet, Student
from kinegrade.course.sheet.assignment import Assignment
from kinegrade.course.sheet.handout import handout_in
from kinegrade.course.sheet.notebook import handout_notebook
from kinegrade.course.sheet.python_script import script
from kinegrade.course.sheet.submissions import Submission
from kinegrade.exercises.exercise import Manual, references
from kinegrade.grader.collecting.ask import Limits
from kinegrade.grader.inside.notebook_file import read_notebook
from kinegrade.grader.inside.script_file import read_script
from kinegrade.grader.marking.mark import mark

ADA = Student("ada", "Ada Lovelace")
PATH = Path("one.py")


def sheet_of(slug):
    return Sheet(name="one", exercises=(slug,), python=True, mode="practice")


def text_of(slug):
    return script("Course", sheet_of(slug), ADA, [Assignment(EXERCISES[slug], variant_of(slug))])


@pytest.mark.parametrize("slug", SLUGS)
def test_a_script_is_python_with_all_blanks_and_says_what_the_notebook_says(slug):
    text = text_of(slug)
    ast.parse(text)
    assert "<img" not in text
    for part in EXERCISES[slug].asked:
        assert part.answer.blank(part.variable) in text
    about = [Assignment(EXERCISES[slug], variant_of(slug))]
    notebook = handout_notebook("Course", sheet_of(slug), ADA, about)
    assert handout_in(text.encode(), PATH) == handout_in(notebook, Path("one.ipynb"))
    assert text == text_of(slug)
    for part in EXERCISES[slug].asked:  # a blank sheet is not one with answers in the wrong place
        assert read_script(text.encode()).hint(part.variable) == ""
        assert read_notebook(notebook).hint(part.variable) == ""


@pytest.mark.parametrize("slug", ["rrt", "implement_it", "frames"])
def test_right_answers_in_a_script_earn_all_points(slug, jail):
    exercise, v = EXERCISES[slug], variant_of(slug)
    text = text_of(slug)
    given = references(exercise, v)
    for part in exercise.asked:
        blank = f"# %%\n{part.answer.blank(part.variable)}\n"
        assert text.count(blank) == 1
        text = text.replace(blank, f"# %%\n{answer_code(part, given[part.variable])}\n")
    submission = Submission(PATH, text.encode())
    raws = submission.raws(submission.asks(exercise, v), Limits(), jail)
    for part, verdict in zip(exercise.asked, mark(exercise, v, raws), strict=True):
        assert isinstance(part.answer, Manual) or verdict.points == part.points, verdict


def test_python_at_a_sheet_writes_the_script_which_is_marked_and_checked(tmp_path, kinegrade):
    folder = make_course(tmp_path)
    toml = folder / "course.toml"
    toml.write_text(
        toml.read_text(encoding="utf-8").replace("mode =", "python = true\nmode ="),
        encoding="utf-8",
    )
    course = handed_out(folder)
    text = (folder / "released" / "ada" / "one.py").read_text(encoding="utf-8")
    heading = json.loads((folder / "released" / "ada" / "one.ipynb").read_bytes())["cells"][0]
    assert "Or answer in `one.py` in its place" in "".join(heading["source"])
    assert "Or answer in `one.ipynb` in its place" in text
    assert "run the whole file" in text

    for name, value in right_answers(course, "ada").items():
        text = text.replace(f"{name} = ...", f"{name} = {value.tolist()}")
    path = folder / "submitted" / "ada" / "one.py"
    path.parent.mkdir(parents=True)
    path.write_text(text, encoding="utf-8")
    checked = kinegrade("check", path, "--exercises", folder / "exercises")
    assert (checked.code, checked.out.count("✓")) == (0, 2), checked.err
    marked = kinegrade("grade", "--course", folder, "--json")
    assert json.loads(marked.out)[0]["points"] == 5


def test_a_sheet_without_the_key_has_no_script(class_of_three):
    assert not list(class_of_three.folder.glob("released/*/*.py"))
