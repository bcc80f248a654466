"""A course of twelve students who hand in what a class would, marked."""

import json
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..exercises.exercise import Exercise, Numbers, Part, TableOf, references, solve
from ..solutions.errors import KinegradeError
from ..solutions.table import Table, read_table
from .config import Course, CourseError, Sheet, read_course
from .console import progress
from .files import write_atomically
from .gradebook import Gradebook
from .marking import mark_sheets, show
from .marks import by_hand, enter
from .secret import FILE
from .sheets import exercises_of, generate

SECRET = "a demonstration keeps no secrets: its numbers are the same everywhere"  # noqa: S105
SHEETS = (
    (
        "first_steps",
        "Positions, transforms, turning bodies",
        "planar_2r dh_transforms cross_products small_rotations",
    ),
    ("jacobian", "The manipulator Jacobian", "three_axis rrt puma_velocities"),
    (
        "columns",
        "Columns in every frame",
        "articulated_derivatives last_frame_columns prismatic_columns frames",
    ),
    (
        "velocities",
        "Inverse velocities",
        "inverse_velocities pseudoinverse find_the_mistake implement_it",
    ),
    ("wishes", "Forces and wished poses", "statics desired_pose"),
)
COMMENT = "The key says it shorter; both parts of the argument are there."


@dataclass(frozen=True)
class Code:
    """Text that stands in a cell in place of an answer."""

    text: str


Answers = dict[str, Any]
Spoil = Callable[[Exercise, dict[str, Any], Answers], Answers]
"""From an exercise, its numbers and its right answers to what is handed in."""


@dataclass(frozen=True)
class Habit:
    """What a demo student does to the right answers."""

    title: str
    spoil: Spoil


def _each(change: Callable[[Any], Any]) -> Spoil:
    """A habit that does the same to every array."""
    return lambda _, __, answers: {
        name: change(answer) if isinstance(answer, np.ndarray) and answer.ndim else answer
        for name, answer in answers.items()
    }


def _swapped(J: Any) -> Any:
    return np.concatenate([J[3:], J[:3]]) if J.ndim == 2 and len(J) == 6 else J


def _degrees(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    """Every angle is taken for degrees."""
    converted = dict(v)
    for name, units in exercise.units.items():
        if name in v and (np.array(units) == "rad").any():
            numbers = np.asarray(v[name], dtype=float)
            converted[name] = np.where(
                np.array(units) == "rad", np.radians(numbers), numbers
            ).tolist()
    try:
        return references(exercise, converted)
    except (KinegradeError, ArithmeticError, ValueError, LookupError, np.linalg.LinAlgError):
        return answers  # nothing follows from such angles


def _one_sign(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    """One sign: of alpha_1 in a table, and what follows, or of the largest entry of a matrix."""
    table = _table(exercise)
    if table:
        return _other_alpha(exercise, table, v, answers)
    spoiled = dict(answers)
    for name, answer in answers.items():
        if _shape(answer)[1:] not in ((), (1,)):
            spoiled[name] = answer.copy()
            spoiled[name].flat[int(np.abs(spoiled[name]).argmax())] *= -1
            break
    return spoiled


def _shape(answer: Any) -> tuple[int, ...]:
    """The shape of an array, () for everything else."""
    return tuple(answer.shape) if isinstance(answer, np.ndarray) else ()  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]


def _other_alpha(exercise: Exercise, asked: Part, v: dict[str, Any], answers: Answers) -> Answers:
    """The other sign of alpha_1 and what is computed from it; formulas are not gone on from."""
    assert isinstance(asked.answer, TableOf)  # noqa: S101 - chosen by this type
    table: Table = answers[asked.variable]
    cells = [[str(cell) for cell in row] for row in table.rows]
    cells[0][3] = cells[0][3][1:] if cells[0][3].startswith("-") else f"-{cells[0][3]}"
    names = sorted({n for row in table.rows for c in row for n in c.names})
    given: Answers = {**answers, asked.variable: read_table(cells, names, asked.answer.convention)}
    spoiled = {asked.variable}
    for part in exercise.parts:
        if spoiled & set(part.needs):
            given[part.variable] = solve(exercise.slug, part, v, given)
            if isinstance(part.answer, Numbers):
                spoiled.add(part.variable)
    return given


def _shapes(exercise: Exercise, _: dict[str, Any], answers: Answers) -> Answers:
    """Only the linear rows of every Jacobian, and a table without its last row."""
    spoiled = dict(answers)
    for name, answer in answers.items():
        if len(_shape(answer)) == 2 and _shape(answer)[0] == 6:
            spoiled[name] = answer[:3]
        elif isinstance(answer, Table):
            spoiled[name] = Table(answer.rows[:2])
    return spoiled


def _not_a_number(_: Exercise, __: dict[str, Any], answers: Answers) -> Answers:
    spoiled = dict(answers)
    for name, answer in answers.items():
        if name.endswith(("_J", "_A")) and isinstance(answer, np.ndarray):
            spoiled[name] = answer.copy()
            spoiled[name].flat[4] = np.nan
    return spoiled


def _code_in(chosen: Callable[[Exercise], Part | None], code: str) -> Spoil:
    """Code in place of one part's answer, where an exercise has it; NAME in it is the variable."""

    def spoil(exercise: Exercise, _: dict[str, Any], answers: Answers) -> Answers:
        part = chosen(exercise)
        if part is None:
            return answers
        return answers | {part.variable: Code(code.replace("NAME", part.variable))}

    return spoil


def _table(exercise: Exercise) -> Part | None:
    return next((part for part in exercise.asked if isinstance(part.answer, TableOf)), None)


def _jacobian_of_table(exercise: Exercise) -> Part | None:
    """The first matrix of six rows on a sheet that asks for the table."""
    jacobians = (part for part in exercise.asked if _is_jacobian(part))
    return next(jacobians, None) if _table(exercise) else None


def _is_jacobian(part: Part) -> bool:
    shape = part.answer.shape if isinstance(part.answer, Numbers) else ()
    return len(shape) == 2 and shape[0] == 6


def _block_of_earlier(exercise: Exercise) -> Part | None:
    """The first 3 x 3 block that is made of earlier answers."""
    later = (part for part in exercise.asked if part.needs and isinstance(part.answer, Numbers))
    return next((part for part in later if getattr(part.answer, "shape", ()) == (3, 3)), None)


HABITS = (
    Habit("right", _each(lambda answer: answer)),
    Habit("rounded to 3 decimals", _each(lambda answer: answer.round(3))),
    Habit("one sign wrong", _one_sign),
    Habit("rows swapped", _each(_swapped)),
    Habit("degrees for radians", _degrees),
    Habit(
        "transposed",
        _each(lambda answer: np.swapaxes(answer, -1, -2) if answer.ndim > 1 else answer),
    ),
    Habit("wrong shape", _shapes),
    Habit("not a number", _not_a_number),
    Habit("empty", lambda _, __, ___: {}),
    Habit("syntax error", _code_in(_block_of_earlier, "NAME = np.array([[1, 2, 3)")),
    Habit(
        "endless loop in one question", _code_in(_jacobian_of_table, "while True:\n    NAME = None")
    ),
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
        with progress("Writing sheets", len(course.students) * len(SHEETS)) as step:
            generate(course, gradebook, course.settings.sheet, step)
        for sheet in course.settings.sheet:
            hand_in(course, gradebook, sheet)
        mark_sheets(course, gradebook, course.settings.sheet)
        mark_by_hand(course, gradebook)
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
        if SECRET not in _text(settings) + _text(folder / FILE):
            raise CourseError(
                f"{folder} holds a course that is not the demonstration; name another folder"
            )
        return
    if _text(folder / FILE).strip() not in ("", SECRET):
        raise CourseError(
            f"{folder / FILE} holds a secret that is not the demonstration's; name another folder"
        )
    roster = [f"student{i:02},{habit.title}" for i, habit in enumerate(HABITS, 1)]
    write_atomically(folder / "roster.csv", "\n".join(["student,name", *roster]) + "\n")
    blocks = [
        f'[[sheet]]\nname = "{name}"\ntitle = "{title}"\nexercises = {json.dumps(slugs.split())}\n'
        for name, title, slugs in SHEETS
    ]
    write_atomically(folder / FILE, SECRET + "\n", mode=0o600)
    text = "\n".join(
        ['title = "Kinegrade demonstration"\n', *blocks, "[limits]\ncell_seconds = 2\n"]
    )
    write_atomically(settings, text)  # last: with it, the folder is the demonstration


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""


def hand_in(course: Course, gradebook: Gradebook, sheet: Sheet) -> None:
    """Every student's notebook with the answer cells filled in as the student's habit has it."""
    numbers = {
        (record.student, record.exercise): record.numbers
        for record in gradebook.records(sheet.name)
    }
    for student, habit in zip(course.students, HABITS, strict=True):
        source = course.students[0] if habit.title.startswith("somebody") else student
        answers: dict[str, str] = {}
        for exercise in exercises_of(course, sheet):
            v = numbers[source.id, exercise.slug]
            spoiled = habit.spoil(exercise, v, references(exercise, v))
            answers |= {
                part.variable: _as_code(part, spoiled)
                for part in exercise.asked
                if part.variable in spoiled
            }
        released = course.folder / "released" / student.id / f"{sheet.name}.ipynb"
        write_atomically(
            course.folder / "submitted" / student.id / released.name,
            fill_in(released.read_bytes(), answers),
        )


def _as_code(part: Part, spoiled: Answers) -> str:
    answer = spoiled[part.variable]
    if isinstance(answer, Code):
        return answer.text
    code = part.answer.code(part.variable, answer)
    return code.replace("nan", "np.nan") if isinstance(part.answer, Numbers) else code


def mark_by_hand(course: Course, gradebook: Gradebook) -> None:
    """Full points for every argument but the last student's, which stays to be marked."""
    waiting = [one for one in by_hand(course, gradebook, course.settings.sheet) if one.waits]
    for one in waiting:
        if one.student != course.students[-1].id:
            enter(
                waiting,
                gradebook,
                one.student,
                one.part.variable,
                one.part.points,
                COMMENT,
                one.sheet,
            )


def fill_in(notebook: bytes, answers: Mapping[str, str]) -> bytes:
    """A handed-out notebook with the blank cell of every named answer replaced by code."""
    content: Any = json.loads(notebook)
    for cell in content["cells"]:
        for name, code in answers.items():
            if cell["cell_type"] == "code" and "".join(cell["source"]).startswith(
                (f"{name} = ...", f"def {name}(")
            ):
                cell["source"] = code
    return (json.dumps(content, indent=1, ensure_ascii=False) + "\n").encode("utf-8")
