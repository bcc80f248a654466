"""What the students of the demonstration do to right answers before they hand them in."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Exercise, Numbers, Part, TableOf, references, solve
from ...solutions.errors import KinegradeError
from ...solutions.table import Table, read_table


@dataclass(frozen=True)
class Code:
    """Text that stands in a cell in place of an answer."""

    text: str


Answers = dict[str, Any]
Spoil = Callable[[Exercise, dict[str, Any], Answers], Answers]
"""From an exercise, its numbers and its right answers to what is handed in."""
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Habit:
    """What a demo student does to the right answers."""

    title: str
    spoil: Spoil


def _unchanged(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    return answers


def _nothing(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    return {}


def _each(change: Callable[[Array], Array]) -> Spoil:
    """A habit that does the same to every array."""

    def spoil(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
        spoiled = dict(answers)
        for name, answer in answers.items():
            if _shape(answer):
                spoiled[name] = change(answer)
        return spoiled

    return spoil


def _rounded(answer: Array) -> Array:
    return answer.round(3)


def _rows_swapped(J: Array) -> Array:
    """The angular rows of a Jacobian above the linear ones."""
    if not _is_six_rows(_shape(J)):
        return J
    return np.concatenate([J[3:], J[:3]])


def _transposed(answer: Array) -> Array:
    if answer.ndim < 2:
        return answer
    return np.swapaxes(answer, -1, -2)


def _shape(answer: Any) -> tuple[int, ...]:
    """The shape of an array, () for everything else."""
    if not isinstance(answer, np.ndarray):
        return ()
    return cast("Array", answer).shape


def _is_six_rows(shape: tuple[int, ...]) -> bool:
    return len(shape) == 2 and shape[0] == 6


def _degrees(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    """Every angle is taken for degrees."""
    converted = dict(v)
    for name, units in exercise.units.items():
        angles = np.array(units) == "rad"
        if name in v and angles.any():
            numbers = np.asarray(v[name], dtype=float)
            converted[name] = np.where(angles, np.radians(numbers), numbers).tolist()
    try:
        return references(exercise, converted)
    except (KinegradeError, ArithmeticError, ValueError, LookupError, np.linalg.LinAlgError):
        return answers  # nothing follows from such angles


def _one_sign(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    """One sign: of alpha_1 in a table, and what follows, or of the largest entry of a matrix."""
    table = _table(exercise)
    if table is not None:
        return _other_alpha(exercise, table, v, answers)
    spoiled = dict(answers)
    for name, answer in answers.items():
        several_columns = _shape(answer)[1:] not in ((), (1,))
        if several_columns:
            changed = answer.copy()
            changed.flat[int(np.abs(changed).argmax())] *= -1
            spoiled[name] = changed
            break
    return spoiled


def _other_alpha(exercise: Exercise, asked: Part, v: dict[str, Any], answers: Answers) -> Answers:
    """The other sign of alpha_1 and what is computed from it; formulas are not gone on from."""
    assert isinstance(asked.answer, TableOf)  # noqa: S101 - chosen by this type
    table: Table = answers[asked.variable]
    given: Answers = {**answers, asked.variable: _with_other_sign(table, asked.answer)}
    spoiled = {asked.variable}
    for part in exercise.parts:
        if spoiled.isdisjoint(part.needs):
            continue
        given[part.variable] = solve(exercise.slug, part, v, given)
        if isinstance(part.answer, Numbers):
            spoiled.add(part.variable)
    return given


def _with_other_sign(table: Table, asked: TableOf) -> Table:
    """The table as it is read after the sign of alpha_1 was changed in its text."""
    names: set[str] = set()
    cells: list[list[str]] = []
    for row in table.rows:
        for cell in row:
            names.update(cell.names)
        cells.append([str(cell) for cell in row])
    alpha = cells[0][3]
    if alpha.startswith("-"):
        cells[0][3] = alpha[1:]
    else:
        cells[0][3] = f"-{alpha}"
    return read_table(cells, sorted(names), table.convention)


def _wrong_shapes(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    """Only the linear rows of every Jacobian, and a table without its last row."""
    spoiled = dict(answers)
    for name, answer in answers.items():
        if _is_six_rows(_shape(answer)):
            spoiled[name] = answer[:3]
        elif isinstance(answer, Table):
            spoiled[name] = Table(answer.rows[:2])
    return spoiled


def _not_a_number(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
    spoiled = dict(answers)
    for name, answer in answers.items():
        if name.endswith(("_J", "_A")) and _shape(answer):
            changed = answer.copy()
            changed.flat[4] = np.nan
            spoiled[name] = changed
    return spoiled


def _code_in(chosen: Callable[[Exercise], Part | None], code: str) -> Spoil:
    """Code in place of one part's answer, where an exercise has it; NAME in it is the variable."""

    def spoil(exercise: Exercise, v: dict[str, Any], answers: Answers) -> Answers:
        part = chosen(exercise)
        if part is None:
            return answers
        return answers | {part.variable: Code(code.replace("NAME", part.variable))}

    return spoil


def _table(exercise: Exercise) -> Part | None:
    """The part that asks for a table of rows."""
    for part in exercise.asked:
        if isinstance(part.answer, TableOf):
            return part
    return None


def _jacobian_of_table(exercise: Exercise) -> Part | None:
    """The first matrix of six rows on a sheet that asks for the table."""
    if _table(exercise) is None:
        return None
    for part in exercise.asked:
        if isinstance(part.answer, Numbers) and _is_six_rows(part.answer.shape):
            return part
    return None


def _block_of_earlier(exercise: Exercise) -> Part | None:
    """The first 3 x 3 block that is made of earlier answers."""
    for part in exercise.asked:
        if part.needs and isinstance(part.answer, Numbers) and part.answer.shape == (3, 3):
            return part
    return None


HABITS = (
    Habit("right", _unchanged),
    Habit("rounded to 3 decimals", _each(_rounded)),
    Habit("one sign wrong", _one_sign),
    Habit("rows swapped", _each(_rows_swapped)),
    Habit("degrees for radians", _degrees),
    Habit("transposed", _each(_transposed)),
    Habit("wrong shape", _wrong_shapes),
    Habit("not a number", _not_a_number),
    Habit("empty", _nothing),
    Habit("syntax error", _code_in(_block_of_earlier, "NAME = np.array([[1, 2, 3)")),
    Habit(
        "endless loop in one question", _code_in(_jacobian_of_table, "while True:\n    NAME = None")
    ),
    Habit("somebody else's variant", _unchanged),  # the answers are another's already
)
