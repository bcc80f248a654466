"""Whether an array of a MATLAB file can be an answer: its class, its size, whether its parts agree.

scipy takes sizes and indices of a file as they stand, so that all of them are checked before.
"""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .mat_elements import (
    CELL,
    CHAR,
    DAMAGED,
    FUNCTION,
    INT32,
    MATRIX,
    MAX_CELLS,
    NUMERIC,
    OBJECT,
    OPAQUE,
    SPARSE,
    STRUCT,
    Array,
    Element,
    MatError,
    Order,
    array_of,
)
from .wire import MAX_ELEMENTS, MAX_TEXT

DEPTH = 3  # of cell arrays in cell arrays
CELLS = "cells and lines of text"
NUMBERS = "numbers"
LETTERS = "characters"
LETTERS_OF_A_CELL = 400  # on average
MOST = {
    CELLS: MAX_CELLS,
    NUMBERS: MAX_ELEMENTS,
    LETTERS: MAX_CELLS * LETTERS_OF_A_CELL,
}  # of one variable

# Bytes of one number, and the least of one character, by the type of an element.
BYTES = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4, 9: 8, 12: 8, 13: 8}  # fmt: skip
CHARACTERS = {1: 1, 2: 1, 4: 2, 16: 1, 17: 2, 18: 4}

REFUSED = {
    STRUCT: "a struct cannot be marked; hand in a matrix, text or a cell array",
    OBJECT: "an object cannot be marked; hand in a matrix, text or a cell array",
    FUNCTION: "a function handle cannot be called here; hand in its results",
}
OPAQUES = {
    "string": (
        "a string in double quotes cannot be read outside MATLAB; use single quotes or char(...)"
    ),
    "sym": "a symbolic object cannot be read outside MATLAB; use char(...)",
}


def check(array: Array, order: Order) -> None:
    """Nothing, when the array is what it says it is and no larger than an answer.

    All that its cells hold is counted together, as it will be in memory and not as it is stored:
    4096 numbers, 512 cells, 204 800 characters.

    Raises:
        MatError: it is of a class that cannot be marked, too large, or damaged.
    """
    left = dict(MOST)
    for inner in _arrays(array, order, DEPTH):
        for what, amount in _amounts(inner).items():
            left[what] -= amount
            if left[what] < 0:
                raise MatError(
                    f"too large: it has more than {MOST[what]} {what}, cells within cells included"
                )


def _arrays(array: Array, order: Order, depth: int) -> Iterator[Array]:
    """The array and all in its cells, each of them checked.

    A cell array comes before anything in it is looked at, so that it is counted before.
    """
    _check_class(array)
    _check_shape(array)
    if not _is_whole(array, order):
        raise MatError(DAMAGED)
    yield array
    if array.kind == CELL:
        yield from _in_cells(array, order, depth)


def _check_class(array: Array) -> None:
    if array.kind == OPAQUE:
        raise MatError(OPAQUES.get(array.object_class, REFUSED[OBJECT]))
    if array.kind in REFUSED:
        raise MatError(REFUSED[array.kind])


def _check_shape(array: Array) -> None:
    if min(array.shape) < 0 or len(array.shape) > 4:
        raise MatError(DAMAGED)
    most = {CELL: MAX_CELLS, CHAR: MAX_TEXT}.get(array.kind, MAX_ELEMENTS)
    if _size(array.shape) > most:
        lengths = " x ".join(map(str, array.shape))
        raise MatError(f"too large: an array of {lengths}; {most} can be read here")


def _is_whole(array: Array, order: Order) -> bool:
    """Whether the parts of an array are those that its class and its shape take."""
    if array.kind == CELL:
        return True  # its cells are looked at one by one
    if array.kind == SPARSE:
        return _is_sparse(array, order)
    if array.kind == CHAR:
        return _is_text(array)
    return _is_numeric(array)


def _in_cells(array: Array, order: Order, depth: int) -> Iterator[Array]:
    if depth == 0:
        raise MatError("not a matrix: cell arrays are nested too deeply")
    if len(array.parts) != math.prod(array.shape):
        raise MatError(DAMAGED)
    if any(kind != MATRIX for kind, _ in array.parts):
        raise MatError(DAMAGED)

    for _, content in array.parts:
        if len(content):  # an empty element is an empty matrix
            yield from _arrays(array_of(content, order), order, depth - 1)


def _amounts(array: Array) -> dict[str, int]:
    """How much of an answer it takes up itself; every row of text after the first is one more."""
    size = _size(array.shape)
    if array.kind == CHAR:
        return {LETTERS: size, CELLS: _size(array.shape[:-1]) - 1}
    if array.kind == CELL:
        return {CELLS: size}
    return {NUMBERS: size}


def _size(shape: tuple[int, ...]) -> int:
    """Entries of an array; a million rows of nothing are a million."""
    return math.prod(max(length, 1) for length in shape)


def _is_text(array: Array) -> bool:
    """Whether there are as many characters as it says; they may take more bytes than one each."""
    if len(array.parts) != 1:
        return False
    kind, content = array.parts[0]
    return kind in CHARACTERS and len(content) >= math.prod(array.shape) * CHARACTERS[kind]


def _is_numeric(array: Array) -> bool:
    """Whether a matrix has as many numbers as it says, real and imaginary parts."""
    expected = 1 + array.imaginary
    if array.kind not in NUMERIC or len(array.parts) != expected:
        return False
    count = math.prod(array.shape)
    return all(_holds_exactly(part, count) for part in array.parts)


def _holds_exactly(part: Element, count: int) -> bool:
    kind, content = part
    return kind in BYTES and len(content) == count * BYTES[kind]


def _holds_at_least(part: Element, count: int) -> bool:
    kind, content = part
    return kind in BYTES and len(content) >= count * BYTES[kind]


def _is_sparse(array: Array, order: Order) -> bool:
    """Whether row indices and starts of columns of a sparse matrix point into it."""
    expected = 3 + array.imaginary
    if len(array.shape) != 2 or len(array.parts) != expected:
        return False
    rows, columns = array.shape
    row = _integers(array.parts[0], order)
    start = _integers(array.parts[1], order)
    if row is None or start is None or len(start) != columns + 1:
        return False

    filled = int(start[-1])
    if not _is_rising(start) or filled > len(row):
        return False
    inside = (row[:filled] >= 0) & (row[:filled] < rows)
    return bool(inside.all()) and all(_holds_at_least(part, filled) for part in array.parts[2:])


def _is_rising(start: NDArray[np.int32]) -> bool:
    """Whether each column starts where the one before ends or later, and the first one at 0."""
    return start[0] == 0 and bool((start[1:] >= start[:-1]).all())  # differences could wrap around


def _integers(part: Element, order: Order) -> NDArray[np.int32] | None:
    """The content of an element as whole numbers of four bytes; None where it is not of them."""
    kind, content = part
    if kind != INT32 or len(content) % 4:
        return None
    signs = {"little": "<i4", "big": ">i4"}
    return np.frombuffer(content, np.dtype(signs[order]))
