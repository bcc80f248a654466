"""A course of twelve students who hand in what a class would, marked."""

import json
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..exercises.exercise import Exercise, Numbers, references
from ..solutions.table import Table, read_table
from .blanks import answer_code
from .config import Course, CourseError, course_text, read_course
from .console import progress
from .files import write_atomically
from .gradebook import Gradebook
from .marking import mark_sheets, show
from .sheets import exercises_of, generate

SECRET = "a demonstration keeps no secrets: its numbers are the same everywhere"  # noqa: S105
Spoil = Callable[[Exercise, dict[str, Any], dict[str, Any]], dict[str, Any]]
"""From an exercise, its numbers and its right answers to what is handed in; text stands for code."""


@dataclass(frozen=True)
class Habit:
    """What a demo student does to the right answers."""

    title: str
    spoil: Spoil


def _each(change: Callable[[Any], Any]) -> Spoil:
    """A habit that does the same to every array."""
    return lambda _, __, answers: {
        name: change(answer) if isinstance(answer, np.ndarray) else answer for name, answer in answers.items()
    }


def _swapped(J: Any) -> Any:
    return np.concatenate([J[3:], J[:3]]) if J.ndim == 2 and len(J) == 6 else J


def _degrees(exercise: Exercise, v: dict[str, Any], _: dict[str, Any]) -> dict[str, Any]:
    """Every angle of q is taken for degrees."""
    units = exercise.units["q"]
    q = [float(np.radians(x)) if unit == "rad" else x for x, unit in zip(v["q"], units, strict=True)]
    return references(exercise, v | {"q": q})


def _one_sign(exercise: Exercise, v: dict[str, Any], answers: dict[str, Any]) -> dict[str, Any]:
    """One sign: of alpha_1 in the table, with all that follows from it, or of one entry of a matrix."""
    spoiled = dict(answers)
    if exercise.slug == "rrt":
        table: Table = answers["rrt_dh"]
        cells = [[str(cell) for cell in row] for row in table.rows]
        cells[0][3] = cells[0][3][1:] if cells[0][3].startswith("-") else f"-{cells[0][3]}"
        given: dict[str, Any] = {
            "rrt_dh": read_table(cells, sorted({n for row in table.rows for c in row for n in c.names}))
        }
        for part in exercise.parts[1:]:
            given[part.variable] = part.solve(v, given)
        return given
    first = next(name for name in spoiled if name.endswith(("_A", "_J")))
    matrix = spoiled[first].copy()
    matrix[0, 1] = -matrix[0, 1]
    return spoiled | {first: matrix}


def _shapes(exercise: Exercise, _: dict[str, Any], answers: dict[str, Any]) -> dict[str, Any]:
    """Only the linear rows of every Jacobian, and a table without its last row."""
    spoiled = {name: answer[:3] if name.endswith("_J") else answer for name, answer in answers.items()}
    if exercise.slug == "rrt":
        spoiled["rrt_dh"] = Table(answers["rrt_dh"].rows[:2])
    return spoiled


def _not_a_number(_: Exercise, __: dict[str, Any], answers: dict[str, Any]) -> dict[str, Any]:
    spoiled = dict(answers)
    for name, answer in answers.items():
        if name.endswith(("_J", "_A")):
            spoiled[name] = answer.copy()
            spoiled[name].flat[4] = np.nan
    return spoiled


def _code_in(suffix: str, code: str) -> Spoil:
    """Code in place of one answer."""
    return lambda _, __, answers: {
        name: code.format(name=name) if name.endswith(suffix) else answer for name, answer in answers.items()
    }


HABITS = (
    Habit("right", _each(lambda answer: answer)),
    Habit("rounded to 3 decimals", _each(lambda answer: answer.round(3))),
    Habit("one sign wrong", _one_sign),
    Habit("rows swapped", _each(_swapped)),
    Habit("degrees for radians", _degrees),
    Habit("transposed", _each(lambda answer: np.swapaxes(answer, -1, -2) if answer.ndim > 1 else answer)),
    Habit("wrong shape", _shapes),
    Habit("not a number", _not_a_number),
    Habit("empty", lambda _, __, ___: {}),
    Habit("syntax error", _code_in("_A", "{name} = np.array([[1, 2, 3)")),
    Habit("endless loop in one question", _code_in("rrt_J", "while True:\n    {name} = None")),
    Habit("somebody else's variant", _each(lambda answer: answer)),
)


def run_demo(folder: Path) -> None:
    """Builds the course in `folder`, hands in, marks, and says where to look. Run again, it gives the same marks.

    Raises:
        CourseError: the folder holds another course.
    """
    _prepare(folder)
    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        with progress("Writing sheets", len(course.students)) as step:
            generate(course, gradebook, course.settings.sheet, step)
        hand_in(course, gradebook)
        show(course, mark_sheets(course, gradebook, course.settings.sheet))
    first = course.students[0].id
    sys.stderr.write(
        f"A sheet:  {folder}/released/{first}/jacobian.ipynb\n"
        f"Feedback: {folder}/feedback/student03/jacobian.html\n"
        f"Solution: {folder}/solutions/{first}/jacobian.ipynb\n"
    )


def _prepare(folder: Path) -> None:
    settings = folder / "course.toml"
    if settings.exists():
        if SECRET not in settings.read_text(encoding="utf-8"):
            raise CourseError(f"{folder} holds a course that is not the demonstration; name another folder")
        return
    roster = [f"student{i:02},{habit.title}" for i, habit in enumerate(HABITS, 1)]
    write_atomically(folder / "roster.csv", "\n".join(["student,name", *roster]) + "\n")
    lines = course_text("Kinegrade demonstration", SECRET).splitlines()
    lines = ["cell_seconds = 2" if line.startswith("cell_seconds") else line for line in lines]
    write_atomically(settings, "\n".join(lines) + "\n")  # last: with it, the folder is the demonstration


def hand_in(course: Course, gradebook: Gradebook) -> None:
    """Every student's notebook with the answer cells filled in as the student's habit has it."""
    sheet = course.settings.sheet[0]
    numbers = {(record.student, record.exercise): record.numbers for record in gradebook.records(sheet.name)}
    for student, habit in zip(course.students, HABITS, strict=True):
        source = course.students[0] if habit.title.startswith("somebody") else student
        answers: dict[str, str] = {}
        for exercise in exercises_of(course, sheet):
            v = numbers[source.id, exercise.slug]
            spoiled = habit.spoil(exercise, v, references(exercise, v))
            answers |= {name: _as_code(exercise, name, answer) for name, answer in spoiled.items()}
        released = course.folder / "released" / student.id / f"{sheet.name}.ipynb"
        write_atomically(
            course.folder / "submitted" / student.id / released.name, fill_in(released.read_bytes(), answers)
        )


def _as_code(exercise: Exercise, name: str, answer: Any) -> str:
    if isinstance(answer, str):
        return answer
    part = next(part for part in exercise.parts if part.variable == name)
    code = answer_code(part, answer)
    return code.replace("nan", "np.nan") if isinstance(part.answer, Numbers) else code


def fill_in(notebook: bytes, answers: Mapping[str, str]) -> bytes:
    """A handed-out notebook with the blank cell of every named answer replaced by code."""
    content: Any = json.loads(notebook)
    for cell in content["cells"]:
        for name, code in answers.items():
            if cell["cell_type"] == "code" and "".join(cell["source"]).startswith(f"{name} = ..."):
                cell["source"] = code
    return (json.dumps(content, indent=1, ensure_ascii=False) + "\n").encode("utf-8")
