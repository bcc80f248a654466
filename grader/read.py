"""From raw values to answers of the declared kind: shape before anything else, then finite, then values."""

import re
from collections.abc import Callable
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ..exercises.exercise import Answer, Numbers, TableOf, Variant
from ..solutions.errors import KinegradeError
from ..solutions.table import Table, read_table
from .wire import Raw

THETA = 0
DUST = 1e-12
SAME_ANGLE = 8e-3  # of a quarter turn, 0.7 degrees: two decimals of a radian are still the own q


class Unreadable(KinegradeError):
    """An answer that cannot be judged; the sentence is for the student."""


def read(answer: Answer, raw: Raw, v: Variant) -> Any:
    """The student's answer as the declared kind.

    Raises:
        Unreadable: nothing was handed in, or it is of another kind or shape; the sentence says what was expected.
    """
    if raw.kind == "missing":
        raise Unreadable("not answered")
    if raw.kind == "error":
        raise Unreadable(str(raw.value))
    return _READERS[type(answer)](answer, raw, v)


def _numbers(answer: Numbers, raw: Raw, _: Variant) -> NDArray[np.float64]:
    if raw.kind != "num":
        raise Unreadable(f"takes numbers of shape {answer.shape}, got text: {_clip(raw.value)}")
    array = raw.value
    if np.iscomplexobj(array):
        raise Unreadable("takes real numbers, got complex ones")
    shape = array.shape
    if len(answer.shape) == 3 and shape == (answer.shape[0] * answer.shape[1], answer.shape[2]):
        array = array.reshape(answer.shape)  # the matrices of a stack one below the other
        shape = array.shape
    if shape != answer.shape and not (len(answer.shape) == 1 and sorted(shape) == sorted((1, *answer.shape))):
        raise Unreadable(f"takes shape {answer.shape}, got {shape}{_shape_hint(shape, answer.shape)}")
    if not np.isfinite(array).all():
        where = tuple(int(i) + 1 for i in np.argwhere(~np.isfinite(array))[0])
        raise Unreadable(f"takes finite numbers, got NaN or infinity, first at {_place(where)}")
    return array.reshape(answer.shape)


def _shape_hint(shape: tuple[int, ...], asked: tuple[int, ...]) -> str:
    if len(shape) == 2 and shape[::-1] == asked:  # a transposed 6 x 3 matrix is 3 x 6
        return ": rows and columns look exchanged"
    if len(asked) == 2 and asked[0] == 6 and shape == (3, asked[1]):
        return ": linear and angular rows are asked, three each"
    return ""


def _place(where: tuple[int, ...]) -> str:
    if len(where) == 2:
        return f"row {where[0]}, column {where[1]}"
    return f"entry {', '.join(map(str, where))}"


def _table(answer: TableOf, raw: Raw, v: Variant) -> Table:
    joints = tuple(f"q{i}" for i in range(1, len(answer.kinds) + 1))
    names = tuple(name for name in answer.names if name in v and name not in joints) + joints
    cells = [[_plain(cell, names) for cell in row] for row in _cells(raw, (len(answer.kinds), 4))]
    for i, (row, kind) in enumerate(zip(cells, answer.kinds, strict=True)):
        _complete(row, "RP".index(kind), i, v)
    try:
        table = read_table(cells, names, answer.convention)
        values = {name: v[name] for name in names if name not in joints}
        table.numbers({**values, **dict(zip(joints, v["q"], strict=True))})  # every cell has a value
    except KinegradeError as error:
        said, *cell = str(error).splitlines()
        place = f", in {cell[0].strip()!r}" if cell else ""
        known = f"; the names of this table are {', '.join(names)}" if "nknown name" in said else ""
        raise Unreadable(f"{said}{place}{known}") from error
    return table


def _plain(cell: str, names: tuple[str, ...]) -> str:
    """A cell as our formulas have it: np.pi is pi, rrt_d1 is d1, d_1 is d1, theta1 is q1."""
    text = re.sub(r"\b(?:np|numpy|math|sp|sympy)\.(?=[a-z])", "", cell)
    text = re.sub(rf"\b[A-Za-z]\w*_(?={'|'.join(names)}\b)", "", text)
    return re.sub(r"(?:\b(?:theta|th)|θ)_?([1-9])\b", r"q\1", re.sub(r"\b([A-Za-z])_([1-9])\b", r"\1\2", text))


def _cells(raw: Raw, shape: tuple[int, int]) -> list[list[str]]:
    if raw.kind == "num":
        array = raw.value
        if array.shape == shape and np.isfinite(array).all() and not np.iscomplexobj(array):
            return [[_typed(float(x)) for x in row] for row in array]
        raise Unreadable(f"takes a table of shape {shape}: theta, d, a, alpha for each joint, got {array.shape}")
    given: Any = raw.value
    cells = cast("list[Any]", given) if isinstance(given, list) else []
    if not cells or not all(isinstance(row, list) for row in cells):
        raise Unreadable(f"takes a list of {shape[0]} rows, got {_clip(raw.value)}")
    counts = [len(row) for row in cells]
    if counts != [shape[1]] * shape[0]:
        raise Unreadable(f"takes {shape[0]} rows of theta, d, a, alpha, got rows of {_clip(counts)} cells")
    return [[_cell(cell) for cell in row] for row in cells]


def _cell(cell: Any) -> str:
    try:
        return _typed(float(cell))
    except (TypeError, ValueError, OverflowError):
        return cell if isinstance(cell, str) else str(cell)


def _typed(number: float) -> str:
    """A number as text; cos(pi/2) is 6e-17 and means zero."""
    return repr(0.0 if abs(number) < DUST else number)


def _complete(row: list[str], at: int, joint: int, v: Variant) -> None:
    """A number where the joint variable belongs is read as the value at the student's q.

    In theta it may differ from q by quarter turns, the offsets that tables have; anything else is another q.
    """
    try:
        offset = float(row[at]) - v["q"][joint]
    except ValueError:
        return
    turns = offset / (np.pi / 2)
    if at == THETA and abs(turns - round(turns)) > SAME_ANGLE:
        raise Unreadable(f"row {joint + 1}, theta: takes q{joint + 1}, or your value of it, got {_clip(row[at])}")
    if np.isfinite(offset):
        row[at] = f"q{joint + 1} + ({_typed(round(offset, 9))})"


def _clip(value: Any) -> str:
    text = str(value)
    return text if len(text) <= 60 else text[:57] + "..."


_READERS: dict[type, Callable[[Any, Raw, Variant], Any]] = {Numbers: _numbers, TableOf: _table}
