# pyright: basic
"""Answers handed in as a MATLAB file, as the same raw values as from a notebook."""

from collections.abc import Sequence
from importlib.util import find_spec
from io import BytesIO
from typing import Any

import numpy as np

from .ask import Ask
from .mat_elements import MatError, Order, array_of, byte_order, check, variables
from .named_matrices import every, raw_value
from .wire import Raw

MAX_BYTES = 4 << 20
MINIMAL_HEADER = b"MATLAB 5.0 MAT-file".ljust(116) + bytes(8)


def from_mat(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a .mat file of version 5, 6 or 7; a broken file is an error of what was not read before the break.

    Numbers of any type, logical and sparse ones too, are real or complex arrays of the shape that MATLAB gave them: one
    number is 1 x 1, a vector n x 1 or 1 x n. Char arrays are text, one string for one row and a list of strings for
    more, without blanks at their ends. A cell array of texts and single numbers is nested text (or a matrix), a list
    of rows also where it has one row or one column; a cell array of matrices is their stack. Empty is unanswered:
    [], '', {} and cells of nothing else.

    Where results of calls were asked, the cells are the results in their order; in an array of three dimensions the
    last one counts them, as in cat(3, first, second).
    """
    reason = cannot_read()
    if len(data) > MAX_BYTES:
        reason = f"the file has more than {MAX_BYTES >> 20} MB; save only your answers"
    if reason:
        return every(asks, reason)
    found: dict[str, bytes] = {}
    nothing = Raw("missing")
    try:
        order = byte_order(data)
        for name, element in variables(data, order, {ask.name for ask in asks}):
            found[name] = element  # noqa: PERF403 - what came before a break stays
    except MatError as error:
        nothing = Raw("error", str(error))
    return {
        ask.name: _variable(found[ask.name], ask, byte_order(data))
        if ask.name in found
        else nothing
        for ask in asks
    }


def cannot_read() -> str:
    """Why no .mat file can be read on this machine; empty where they can."""
    if find_spec("scipy") is not None:
        return ""
    return ".mat files are read with scipy, which is not installed here: pip install scipy"


def _variable(element: bytes, ask: Ask, order: Order) -> Raw:
    """One variable, read from a file of its own: a broken neighbour costs it nothing."""
    from scipy.io import loadmat

    try:
        check(array_of(memoryview(element)[8:], order), order)
        mark = (0x0100).to_bytes(2, order) + (b"IM" if order == "little" else b"MI")
        file = BytesIO(MINIMAL_HEADER + mark + element)
        return raw_value(_value(loadmat(file, variable_names=[ask.name])[ask.name], ask), ask)
    except MatError as error:
        return Raw("error", str(error))
    except Exception as error:  # noqa: BLE001 - whatever scipy makes of a damaged file is not our failure
        return Raw(
            "error", f"the variable cannot be read: the file is damaged ({type(error).__name__})"
        )


def _value(array: Any, ask: Ask) -> Any:
    """Nested lists of numbers and text; None for what is empty."""
    if hasattr(array, "toarray"):
        array = array.toarray()
    if array.dtype.kind == "U":
        return _text(array)
    if array.dtype.kind == "O":
        cells = [_value(cell, Ask("")) for cell in array.ravel(order="F")]
        return cells if ask.calls else _cells(cells, array.shape)
    if array.shape == (0, 0):
        return None
    if ask.calls and array.ndim == 3:
        array = np.moveaxis(array, -1, 0)
    return array.astype(complex if array.dtype.kind == "c" else float).tolist()


def _text(array: Any) -> Any:
    rows = [str(row).rstrip() for row in array.ravel()]
    return (rows if len(rows) > 1 else rows[0]) if any(rows) else None


def _cells(cells: list[Any], shape: tuple[int, ...]) -> Any:
    """The rows of a cell array of single entries; of one that holds matrices or rows, these one after another."""
    if all(cell is None for cell in cells):
        return None
    single = [_single(cell) for cell in cells]
    if all(isinstance(cell, str | float | complex) for cell in single):
        return np.array([*single, None], dtype=object)[:-1].reshape(shape, order="F").tolist()
    return [cell[0] if _is_row(cell) else cell for cell in cells]


def _single(cell: Any) -> Any:
    """The number of a 1 x 1 matrix, "" for an empty cell, everything else as it is."""
    if cell is None:
        return ""
    if (
        isinstance(cell, list)
        and len(cell) == 1
        and isinstance(cell[0], list)
        and len(cell[0]) == 1
    ):
        return cell[0][0]
    return cell


def _is_row(cell: Any) -> bool:
    """Whether it is one row of text, as in {{'q1', 'd1'}, {'q2', 'd2'}}."""
    return (
        isinstance(cell, list)
        and len(cell) == 1
        and isinstance(cell[0], list)
        and any(isinstance(entry, str) for entry in cell[0])
    )
