"""Sheets and worked solutions as notebooks: the same bytes for the same student, every time."""

from collections.abc import Iterator, Sequence
from typing import Any

from ...exercises.exercise import Exercise, Manual, references
from ..config import LimitsTable, PackagesTable, Sheet, Student
from ..words import points_text
from .given import Pair, given_cell, printed
from .heading import heading, row_orders
from .notebook_file import code_cell, folded_cell, markdown_cell, notebook_file
from .question import prompt_text, question_text
from .self_check import self_check
from .worked import worked_steps

KEY = "kinegrade"
"""What a notebook says of itself stands under this key of its metadata."""
IMPORTS = "import numpy as np"
FOR_THE_INSTRUCTOR = "**Worked solution, for the instructor.**"
SELF_CHECK = (
    "## Self-check\n\nRun the folded cell below at any time. It sees what is there, not whether it "
    "is right. Where Kinegrade is installed, `%load_ext kinegrade` and then `%check` say more."
)


def notebooks(
    course: str,
    sheet: Sheet,
    student: Student,
    pairs: Sequence[Pair],
    limits: LimitsTable | None = None,
    packages: PackagesTable | None = None,
) -> tuple[bytes, bytes]:
    """What the student gets, and what the instructor keeps, as the bytes of two notebooks.

    Limits and packages travel with the sheet, so that a check uses what marking uses.

    Raises:
        ExerciseError: an exercise fails on the student's numbers, or explains a part by no steps.
    """
    limits = limits or LimitsTable()
    title = heading(course, sheet, student, pairs, limits)
    questions = _questions(pairs)
    handout = _handout(title, questions, sheet, pairs)
    solution = _solution(title, questions, pairs)

    about: dict[str, Any] = {"sheet": sheet.name, "student": student.id, "mode": sheet.mode}
    numbers: dict[str, Any] = {}
    for exercise, v in pairs:
        numbers[exercise.slug] = printed(exercise, v)
    # a notebook's keys are sorted when it is written
    order = [exercise.slug for exercise, _ in pairs]
    handed_out = about | {"exercises": order, "numbers": numbers, "limits": limits.model_dump()}
    if packages and packages.allow:
        handed_out["packages"] = packages.model_dump(mode="json")

    identity = f"{sheet.name}/{student.id}"
    return (
        notebook_file(handout, {KEY: handed_out}, identity),
        notebook_file(solution, {KEY: about}, f"solution/{identity}"),
    )


def _questions(pairs: Sequence[Pair]) -> list[str]:
    """The text of every exercise; with the order of rows where they differ in it."""
    differ = len(row_orders(pairs)) > 1
    questions: list[str] = []
    for number, (exercise, v) in enumerate(pairs, 1):
        question = question_text(number, exercise, v, order=differ)
        questions.append(question)
    return questions


def _handout(
    title: str, questions: Sequence[str], sheet: Sheet, pairs: Sequence[Pair]
) -> list[Any]:
    """The student's cells: every question with its numbers and blanks, then the self-check."""
    cells = [markdown_cell(title), code_cell(IMPORTS)]
    for (exercise, v), question in zip(pairs, questions, strict=True):
        cells += [markdown_cell(question), code_cell(given_cell(exercise, v))]
        cells += _blanks(exercise, hints=sheet.mode != "exam")

    asked = [part for exercise, _ in pairs for part in exercise.asked]
    return [*cells, markdown_cell(SELF_CHECK), folded_cell(self_check(asked))]


def _blanks(exercise: Exercise, *, hints: bool) -> Iterator[Any]:
    for part in exercise.asked:
        yield markdown_cell(prompt_text(part, hints=hints))
        yield code_cell(part.answer.blank(part.variable), part.variable)


def _solution(title: str, questions: Sequence[str], pairs: Sequence[Pair]) -> list[Any]:
    """The instructor's cells: every question with its worked solution."""
    cells = [markdown_cell(f"{title}\n\n{FOR_THE_INSTRUCTOR}"), code_cell(IMPORTS)]
    for (exercise, v), question in zip(pairs, questions, strict=True):
        cells += [markdown_cell(question), *_worked(exercise, v)]
    return cells


def _worked(exercise: Exercise, v: dict[str, Any]) -> Iterator[Any]:
    """Every part's question, steps and answer."""
    answers = references(exercise, v)
    for part in exercise.asked:
        yield markdown_cell(prompt_text(part, hints=False))
        for step in worked_steps(part, v, answers):
            yield markdown_cell(step)
        if isinstance(part.answer, Manual):
            yield markdown_cell(_rubric(part.answer))
        yield code_cell(part.answer.code(part.variable, answers[part.variable]), part.variable)


def _rubric(answer: Manual) -> str:
    return "\n".join(f"- {points_text(points)}: {text}" for points, text in answer.rubric)
