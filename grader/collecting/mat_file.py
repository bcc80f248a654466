# pyright: basic
"""Answers handed in as a MATLAB file, as the same raw values as from a notebook."""

from collections.abc import Sequence
from importlib.util import find_spec
from io import BytesIO
from typing import Any

import numpy as np

from .ask import Ask
from .mat_elements import VERSION_5, MatError, Order, array_of, byte_order, variables
from .mat_limits import check
from .named_matrices import every
from .nested_values import raw_value
from .wire import Raw

MAX_BYTES = 4 << 20
MINIMAL_HEADER = b"MATLAB 5.0 MAT-file".ljust(116) + bytes(8)


def from_mat(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a .mat file of version 5, 6 or 7; a broken one costs what stands behind the break.

    Numbers of any type, logical and sparse ones too, are real or complex arrays of the shape that
    MATLAB gave them: one number is 1 x 1, a vector n x 1 or 1 x n. Char arrays are text, one string
    for one row and a list of strings for more, without blanks at their ends. A cell array of texts
    and single numbers is nested text (or a matrix), a list of rows also where it has one row or one
    column; a cell array of matrices is their stack. Empty is unanswered: [], '', {} and cells of
    nothing else.

    Where results of calls were asked, the cells are the results in their order; in an array of
    three dimensions the last one counts them, as in cat(3, first, second).
    """
    reason = cannot_read()
    if len(data) > MAX_BYTES:
        reason = f"the file has more than {MAX_BYTES >> 20} MB; save only your answers"
    if reason:
        return every(asks, reason)
    try:
        order = byte_order(data)
    except MatError as error:
        return every(asks, str(error))

    elements: dict[str, bytes] = {}
    nothing = Raw("missing")
    try:
        for name, element in variables(data, order, {ask.name for ask in asks}):
            elements[name] = element  # noqa: PERF403 - what came before a break stays
    except MatError as error:
        nothing = Raw("error", str(error))

    found = {ask.name: nothing for ask in asks}
    for ask in asks:
        if ask.name in elements:
            found[ask.name] = _variable(elements[ask.name], ask, order)
    return found


def cannot_read() -> str:
    """Why no .mat file can be read on this machine; empty where it can."""
    if find_spec("scipy") is not None:
        return ""
    return ".mat files are read with scipy, which is not installed here: pip install scipy"


def _variable(element: bytes, ask: Ask, order: Order) -> Raw:
    """One variable, read from a file of its own: a broken neighbour costs it nothing."""
    from scipy.io import loadmat

    try:
        check(array_of(memoryview(element)[8:], order), order)
        loaded = loadmat(_file_of(element, order), variable_names=[ask.name])
        return raw_value(_value(loaded[ask.name], ask), ask)
    except MatError as error:
        return Raw("error", str(error))
    except Exception as error:  # noqa: BLE001 - scipy may do anything with a damaged file
        kind = type(error).__name__
        return Raw("error", f"the variable cannot be read: the file is damaged ({kind})")


def _file_of(element: bytes, order: Order) -> BytesIO:
    """A file that holds this element alone."""
    endian = {"little": b"IM", "big": b"MI"}[order]
    return BytesIO(MINIMAL_HEADER + VERSION_5.to_bytes(2, order) + endian + element)


def _value(array: Any, ask: Ask) -> Any:
    """Nested lists of numbers and text; None for what is empty."""
    if hasattr(array, "toarray"):  # a sparse one
        array = array.toarray()
    if array.dtype.kind == "U":
        return _text(array)
    if array.dtype.kind == "O":
        cells = [_value(cell, Ask("")) for cell in array.ravel(order="F")]
        return cells if ask.calls else _rows(cells, array.shape)
    if array.shape == (0, 0):
        return None

    if ask.calls and array.ndim == 3:
        array = np.moveaxis(array, -1, 0)
    if array.dtype.kind == "c":
        return array.astype(complex).tolist()
    return array.astype(float).tolist()


def _text(array: Any) -> Any:
    """One string, or a list of them, without the blanks that fill a char array up."""
    rows = [str(row).rstrip() for row in array.ravel()]
    if not any(rows):
        return None
    return rows if len(rows) > 1 else rows[0]


def _rows(cells: list[Any], shape: tuple[int, ...]) -> Any:
    """The rows of a cell array of single entries; matrices or rows in it, one after another."""
    if all(cell is None for cell in cells):
        return None
    entries = [_entry(cell) for cell in cells]
    if all(isinstance(entry, str | float | complex) for entry in entries):
        # With None at the end, numpy takes each text as one object and not as its letters.
        return np.array([*entries, None], dtype=object)[:-1].reshape(shape, order="F").tolist()
    return [_text_row_or_cell(cell) for cell in cells]


def _entry(cell: Any) -> Any:
    """The number of a 1 x 1 matrix, "" for an empty cell, everything else as it is."""
    if cell is None:
        return ""
    row = _only_row(cell)
    if row is not None and len(row) == 1:
        return row[0]
    return cell


def _text_row_or_cell(cell: Any) -> Any:
    """One row of text without outer brackets, as in {{'q1', 'd1'}, {'q2', 'd2'}}, or the cell."""
    row = _only_row(cell)
    if row is not None and any(isinstance(entry, str) for entry in row):
        return row
    return cell


def _only_row(cell: Any) -> list[Any] | None:
    """The row of a matrix that has one; None for everything else."""
    if not isinstance(cell, list) or len(cell) != 1 or not isinstance(cell[0], list):
        return None
    return cell[0]
