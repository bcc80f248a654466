"""Sheets and worked solutions as notebooks: the same bytes for the same student, every time."""

from collections.abc import Iterator, Sequence
from typing import Any

from ...exercises.exercise import Exercise, Manual
from ..language.speech import ENGLISH, later, phrase
from ..settings.config import LimitsTable, PackagesTable, Sheet, Student
from .about import KEY
from .assignment import Assignment
from .blank import blank_text
from .given import given_cell, printed
from .heading import heading, row_orders, solution_heading
from .notebook_file import code_cell, folded_cell, markdown_cell, notebook_file
from .question import figures_text, prompt_text, question_text
from .self_check import self_check
from .worked import rubric

IMPORTS = "import numpy as np"
SELF_CHECK = later(
    "## Self-check\n\nRun the folded cell below at any time. It sees what is there, not whether it "
    "is right. Where Kinegrade is installed, `%load_ext kinegrade` and then `%check` say more."
)


def notebooks(
    course: str,
    sheet: Sheet,
    student: Student,
    assignments: Sequence[Assignment],
    limits: LimitsTable | None = None,
    packages: PackagesTable | None = None,
) -> tuple[bytes, bytes]:
    """What the student gets, and the worked solution, as the bytes of two notebooks.

    Limits, packages and what is adjusted travel with the sheet, so that a check uses what marking
    uses.

    Raises:
        ExerciseError: an exercise fails on the student's numbers, or explains a part by no steps.
    """
    return (
        handout_notebook(course, sheet, student, assignments, limits, packages),
        solution_notebook(course, sheet, student, assignments),
    )


def handout_notebook(
    course: str,
    sheet: Sheet,
    student: Student,
    assignments: Sequence[Assignment],
    limits: LimitsTable | None = None,
    packages: PackagesTable | None = None,
) -> bytes:
    """What the student gets: every question with its numbers and blanks, then the self-check.

    Raises:
        ExerciseError: an exercise fails on the student's numbers.
    """
    cells = handout_cells(course, sheet, student, assignments, limits, own=f"{sheet.name}.ipynb")
    about = self_description(sheet, student, assignments, limits, packages)
    return notebook_file(cells, {KEY: about}, f"{sheet.name}/{student.id}")


def handout_cells(
    course: str,
    sheet: Sheet,
    student: Student,
    assignments: Sequence[Assignment],
    limits: LimitsTable | None = None,
    *,
    own: str,
) -> list[Any]:
    """The cells of a handed-out sheet, in a file of its `own` name.

    Raises:
        ExerciseError: an exercise fails on the student's numbers.
    """
    title = heading(course, sheet, student, assignments, limits or LimitsTable(), own)
    cells = [markdown_cell(title), code_cell(IMPORTS)]
    for one, question in zip(assignments, _questions(assignments), strict=True):
        cells += [markdown_cell(question), code_cell(given_cell(one.exercise, one.v))]
        cells += _blanks(one.exercise, hints=sheet.mode != "exam")
    asked = [part for one in assignments for part in one.exercise.asked]
    return [*cells, markdown_cell(phrase(SELF_CHECK)), folded_cell(self_check(asked))]


def self_description(
    sheet: Sheet,
    student: Student,
    assignments: Sequence[Assignment],
    limits: LimitsTable | None = None,
    packages: PackagesTable | None = None,
) -> dict[str, Any]:
    """What a handed-out file says of itself, so that a check uses what marking uses."""
    numbers: dict[str, Any] = {}
    for one in assignments:
        numbers[one.exercise.slug] = printed(one.exercise, one.v)
    # a notebook's keys are sorted when it is written
    order = [one.exercise.slug for one in assignments]
    about = _about(sheet, student) | {"exercises": order, "numbers": numbers}
    about["limits"] = (limits or LimitsTable()).model_dump()
    adjusted = sheet.adjustments()
    if adjusted:
        about["adjusted"] = adjusted
    if packages and packages.allow:
        about["packages"] = packages.model_dump(mode="json")
    return about


def solution_notebook(
    course: str, sheet: Sheet, student: Student, assignments: Sequence[Assignment]
) -> bytes:
    """Every question with its numbers, its frames and its worked solution.

    Raises:
        ExerciseError: an exercise fails on the student's numbers, or explains a part by no steps.
    """
    title = solution_heading(course, sheet, student, assignments)
    cells = [markdown_cell(title), code_cell(IMPORTS)]
    for one, question in zip(assignments, _questions(assignments), strict=True):
        cells += [markdown_cell(question), code_cell(given_cell(one.exercise, one.v))]
        if one.solved_figures:
            cells.append(markdown_cell(figures_text(one.solved_figures)))
        cells += _worked(one)
    about = _about(sheet, student)
    return notebook_file(cells, {KEY: about}, f"solution/{sheet.name}/{student.id}")


def _about(sheet: Sheet, student: Student) -> dict[str, Any]:
    about: dict[str, Any] = {"sheet": sheet.name, "student": student.id, "mode": sheet.mode}
    if sheet.language != ENGLISH:
        about["language"] = sheet.language
    return about


def _questions(assignments: Sequence[Assignment]) -> list[str]:
    """The text of every exercise; with the order of rows where they differ in it."""
    differ = len(row_orders(assignments)) > 1
    questions: list[str] = []
    for number, one in enumerate(assignments, 1):
        questions.append(question_text(number, one, order=differ))
    return questions


def _blanks(exercise: Exercise, *, hints: bool) -> Iterator[Any]:
    for part in exercise.asked:
        yield markdown_cell(prompt_text(part, hints=hints))
        yield code_cell(blank_text(part), part.variable)


def _worked(one: Assignment) -> Iterator[Any]:
    """Every part's question, steps and answer."""
    for part in one.exercise.asked:
        yield markdown_cell(prompt_text(part, hints=False))
        for step in one.solution[part.variable]:
            yield markdown_cell(step)
        if isinstance(part.answer, Manual):
            yield markdown_cell(rubric(part.answer))
        answer = one.answers[part.variable]
        yield code_cell(part.answer.code(part.variable, answer), part.variable)
