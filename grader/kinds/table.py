"""Denavit-Hartenberg tables: formulas in the sheet's names, or numbers at the student's own q."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, cast, get_args

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import TableOf, Variant
from ...exercises.kinds.formulas import names_on_sheet
from ...exercises.kinds.table import posture, table_numbers, table_text
from ...exercises.properties import turned
from ...solutions.errors import KinegradeError
from ...solutions.expression import ExpressionError
from ...solutions.plain_number import plain_number
from ...solutions.table import COLUMNS, Convention, Table, read_table
from ..collecting.wire import Raw
from ..reading.arrays import real_numbers, without_single_axes
from ..reading.typed import typed
from ..reading.typed_matrix import typed_matrix
from ..reading.unreadable import Unreadable, clip, misread
from .marker import Asked, Comparison, Marker, Mask, Named, Wanted, is_trivial, not_at_all
from .repairs import repairs
from .same_arm import describes_same_arm
from .signs import said_of_one_entry

SAME_ARM = "Your frames stand otherwise than in the solution; your table is one of the same arm."
THETA = 0
ANGLES = (0, 3)  # columns theta and alpha of a table
DUST = 1e-12
FULL_TURN = 6.3  # rad
KINDS = "RP"  # by the column of their joint variable, theta or d
MOVES = ("turns", "slides")
SAME_ANGLE = 8e-3  # of a quarter turn, 0.7 degrees: two decimals of a radian are still the own q


def read_dh_table(answer: TableOf, raw: Raw, v: Variant) -> Table:
    """The table, every cell of which has a value, in the convention that is asked or declared.

    Raises:
        Unreadable: it has other rows, a cell cannot be read, a joint variable is missing, or the
            declared convention is none.
    """
    convention = _convention(answer, raw)
    joints = tuple(f"q{i}" for i in range(1, len(answer.kinds) + 1))
    others = [name for name in names_on_sheet(answer.names, v) if name not in joints]
    names = (*others, *joints)

    rows: list[list[str]] = []
    for joint, cells in enumerate(_cells(raw, (len(answer.kinds), 4), names)):
        row = _plain_row(cells, names, joint)
        _complete(row, answer.kinds[joint], joint, v)
        rows.append(row)
    try:
        table = read_table(rows, names, convention)
        table_numbers(table, v, posture(joints, v))
    except KinegradeError as error:
        raise Unreadable(str(error)) from error
    return table


def _convention(answer: TableOf, raw: Raw) -> Convention:
    """The convention of a table: the asked one, or the declared one, standard where none is."""
    if answer.convention != "either":
        return answer.convention
    declared = raw.beside.get("convention", Raw("missing"))
    if declared.kind == "missing":
        return "standard"
    words = str(cast("object", declared.value)).strip("[]'\" \n").lower()
    if not words:
        return "standard"
    for convention in get_args(Convention):
        if words.startswith(convention):
            return convention
    raise Unreadable(f"the convention takes 'standard' or 'modified', got {clip(declared.value)}")


def _plain_row(row: Sequence[str], names: tuple[str, ...], joint: int) -> list[str]:
    """Cells in the names of the table: np.pi is pi, rrt_d1 is d1, theta1 is q1."""
    cells: list[str] = []
    for column, cell in zip(COLUMNS, row, strict=True):
        try:
            cells.append(str(typed(cell, names)))
        except ExpressionError as error:
            raise misread(error, f"row {joint + 1}, {column}") from error
    return cells


def _cells(raw: Raw, shape: tuple[int, int], names: tuple[str, ...]) -> list[list[str]]:
    """The cells as text, in rows of the asked shape."""
    if raw.kind == "num":
        return _cells_of_numbers(raw.value, shape)
    given: Any = raw.value
    if isinstance(given, str):
        given = _typed_rows(given, names)
    rows = cast("list[Any]", given) if isinstance(given, list) else []
    if not rows or not all(isinstance(row, list) for row in rows):
        raise Unreadable(f"takes a list of {shape[0]} rows, got {clip(raw.value)}")
    counts = [len(row) for row in rows]
    if counts != [shape[1]] * shape[0]:
        raise Unreadable(
            f"takes {shape[0]} rows of theta, d, a, alpha, got rows of {clip(counts)} cells"
        )
    return [list(map(_cell, row)) for row in rows]


def _cells_of_numbers(array: NDArray[np.float64], shape: tuple[int, int]) -> list[list[str]]:
    numbers = real_numbers(array)
    if without_single_axes(array.shape, shape) != shape or not np.isfinite(numbers).all():
        raise Unreadable(
            f"takes a table of shape {shape}: theta, d, a, alpha for each joint, got {array.shape}"
        )
    return [list(map(_typed, row)) for row in numbers.reshape(shape).tolist()]


def _typed_rows(text: str, names: tuple[str, ...]) -> list[list[str]]:
    """A table in one string, such as "[[q1, d1, 0, pi/2], ...]" or "[q1 d1 0 pi/2; ...]"."""
    try:
        rows = typed_matrix(text, names, len(COLUMNS))
    except ExpressionError as error:
        raise misread(error) from error
    return [list(map(str, row)) for row in rows]


def _cell(cell: Any) -> str:
    """A cell of nested text as text; Python hands over numbers as numbers."""
    text = cell if isinstance(cell, str) else repr(cell)
    number = plain_number(text)
    return text if number is None else _typed(number)


def _typed(number: float) -> str:
    """A number as text; cos(pi/2) is 6e-17 and means zero."""
    return repr(0.0 if abs(number) < DUST else number)


def _complete(row: list[str], kind: str, joint: int, v: Variant) -> None:
    """A number where the joint variable belongs is read as the value at the student's q.

    In theta it may differ from q by quarter turns, the offsets that tables have; anything else is
    another q. Where the sheet gives no q, a number says nothing of the joint variable.
    """
    at = KINDS.index(kind)
    try:
        number = float(row[at])
    except ValueError:
        return
    variable = f"q{joint + 1}"
    _refuse_elsewhere(variable, row, at, joint)
    if "q" not in v:
        raise Unreadable(f"row {joint + 1}, {COLUMNS[at]}: takes {variable}, got {clip(row[at])}")
    offset = number - v["q"][joint]
    turns = offset / (np.pi / 2)
    if at == THETA and abs(turns - round(turns)) > SAME_ANGLE:
        raise Unreadable(
            f"row {joint + 1}, theta: takes {variable}, or your value of it, got {clip(row[at])}"
        )
    if np.isfinite(offset):
        row[at] = f"{variable} + ({_typed(round(offset, 9))})"


def _refuse_elsewhere(variable: str, row: Sequence[str], at: int, joint: int) -> None:
    """Raises Unreadable where the joint variable stands in another column than its own."""
    for column, cell in zip(COLUMNS, row, strict=True):
        if re.search(rf"\b{variable}\b", cell):
            moves = MOVES[at]
            raise Unreadable(
                f"row {joint + 1}, {column}: joint {joint + 1} {moves}, "
                f"so {variable} belongs in {COLUMNS[at]}"
            )


def _compared(answer: TableOf, v: Variant, wanted: Wanted, value: Table) -> Mask | Comparison:
    """Cell by cell; another table of the same arm is right as a whole.

    Cells of another convention are no cells of the reference: such a table is right as a whole or
    not.
    """
    right = np.zeros((len(answer.kinds), 4), dtype=bool)
    if value.convention == wanted.value.convention:
        right = _right_cells(answer, v, wanted, value)
    if right.all() or not describes_same_arm(answer, v, wanted.value, value):
        return right
    return Comparison(np.ones_like(right), 1.0, reading=SAME_ARM)


def _right_cells(answer: TableOf, v: Variant, wanted: Wanted, value: Table) -> Mask:
    """Cells with the reference's value at three configurations; angles up to full turns."""
    half = 0.5 * 10.0**-answer.decimals
    allowed = np.array([4 * half, 6 * half, 6 * half, 4 * half])
    q = np.random.default_rng(0).uniform(-1, 1, (3, len(answer.kinds)))
    difference = table_numbers(value, v, q) - table_numbers(wanted.value, v, q)
    difference[..., ANGLES] = turned(difference[..., ANGLES])
    return np.less_equal(np.abs(difference).max(axis=0), allowed, dtype=bool)


def _handed_in(answer: TableOf, value: Table, __: Variant) -> Raw:
    raw = Raw("text", table_text(value))
    if answer.convention == "either":
        return replace(raw, beside={"convention": Raw("text", value.convention)})
    return raw


def _read_as(answer: TableOf, _: Raw, value: Table) -> str:
    """The declared convention, and an angle that seems to be in degrees."""
    sentences: list[str] = []
    if answer.convention == "either":
        sentences.append(f"It was read as a {value.convention} table.")
    sentences.append(_in_degrees(value))
    return " ".join(filter(None, sentences))


def _in_degrees(value: Table) -> str:
    """The first angle that was typed in degrees and not said to be."""
    for i, row in enumerate(value.rows, 1):
        for column in ANGLES:
            numbers = [float(node[1]) for node in row[column].nodes if node[0] == "n"]
            if max(numbers, default=0.0) > FULL_TURN:
                number = f"{max(numbers):g}"
                place = f"row {i}, {COLUMNS[column]}"
                return f"In {place}, {number} is read in radians; degrees are written {number}°."
    return ""


def _trivial(answer: TableOf, wanted: Wanted, v: Variant) -> Mask:
    return is_trivial(answer.pictured(wanted.value, v))


def _found(asked: Asked, value: Table, right: Mask) -> Iterator[Named]:
    """The single edits that mend the table; several that cannot be told apart are said together."""
    found = repairs(asked.answer, asked.v, asked.wanted.value, value)
    if not found:
        yield from said_of_one_entry(right)
        return
    faults = {repair.fault for repair in found}
    sentence = " Or: ".join(repair.sentence for repair in found)
    fault = found[0].fault if len(faults) == 1 else "concept"
    yield Named(sentence, fault, local=True)


def _priced(*_: Any) -> bool:
    return True


MARKER = Marker(
    read_dh_table,
    _compared,
    _handed_in,
    shown=table_text,
    read_as=_read_as,
    trivial=_trivial,
    varies=True,
    by_rows=True,
    found=_found,
    alone=not_at_all,
    priced=_priced,
)
