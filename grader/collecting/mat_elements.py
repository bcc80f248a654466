"""MATLAB files of version 5 to 7, element by element: what is asked is unpacked and checked before scipy reads it.

Sizes, types and indices of a hostile file would otherwise decide how much memory is taken and where it is written.
Format: MathWorks, MAT-File Format, level 5.
"""

import math
import zlib
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Literal

import numpy as np

from ...solutions.errors import KinegradeError
from .wire import MAX_ANSWER, MAX_ELEMENTS, MAX_TEXT

Order = Literal["little", "big"]
Element = tuple[int, memoryview]
HEADER, DEPTH = 128, 3
MAX_UNPACKED, MAX_VARIABLES, MAX_CELLS = 4 << 20, 1000, 512
CELLS, NUMBERS, LETTERS = "cells and lines of text", "numbers", "characters"
MOST = {CELLS: MAX_CELLS, NUMBERS: MAX_ELEMENTS, LETTERS: MAX_CELLS * MAX_TEXT}  # of one variable
MATRIX, COMPRESSED = 14, 15
CELL, STRUCT, OBJECT, CHAR, SPARSE, FUNCTION, OPAQUE = 1, 2, 3, 4, 5, 16, 17
NUMERIC = range(6, 16)
BYTES = {
    1: 1,
    2: 1,
    3: 2,
    4: 2,
    5: 4,
    6: 4,
    7: 4,
    9: 8,
    12: 8,
    13: 8,
}  # of one number, by the type of an element
CHARACTERS = {1: 1, 2: 1, 4: 2, 16: 1, 17: 2, 18: 4}  # at least, of one character
INT32 = 5
UNPACKED = f"the file unpacks to more than {MAX_UNPACKED >> 20} MB; save only your answers"
RESAVE = "save it with save('name.mat', ..., '-v7')"
REFUSED = {
    STRUCT: "a struct cannot be marked; hand in a matrix, text or a cell array",
    OBJECT: "an object cannot be marked; hand in a matrix, text or a cell array",
    FUNCTION: "a function handle cannot be called here; hand in its results",
}
OPAQUES = {
    "string": "a string in double quotes cannot be read outside MATLAB; use single quotes or char(...)",
    "sym": "a symbolic object cannot be read outside MATLAB; use char(...)",
}


class MatError(KinegradeError):
    """A file or a variable that is not read; the sentence is for the student."""


@dataclass(frozen=True)
class Array:
    """One array of a file: its class, its dimensions, and the elements that hold its values."""

    name: str
    kind: int
    imaginary: bool
    shape: tuple[int, ...]
    parts: tuple[Element, ...]
    object_class: str = ""


def byte_order(data: bytes) -> Order:
    """Byte order of a file of version 5 to 7.

    Raises:
        MatError: it is of another version, or no MATLAB file.
    """
    if b"\x89HDF\r\n\x1a\n" in data[:1024] or data[:10] == b"MATLAB 7.3":
        raise MatError(f"the file is of version 7.3, which is not read; {RESAVE}")
    order: Order | None = {b"IM": "little", b"MI": "big"}.get(data[126:HEADER])  # pyright: ignore[reportAssignmentType]
    if order is None or int.from_bytes(data[124:126], order) != 0x0100:
        raise MatError(f"the file is no MATLAB file of version 5 to 7; {RESAVE}")
    return order


def variables(data: bytes, order: Order, names: Collection[str]) -> Iterator[tuple[str, bytes]]:
    """Name and unpacked bytes, tag included, of the variables that are asked.

    Raises:
        MatError: the file is cut off or damaged, unpacks to more than 4 MB or has more than 1000 variables; what came
            before holds.
    """
    left, position, count = MAX_UNPACKED, HEADER, 0
    while position < len(data):
        count += 1
        if count > MAX_VARIABLES:
            raise MatError(
                f"the file has more than {MAX_VARIABLES} variables; save only your answers"
            )
        kind, size = _tag(data, position, order)
        end = position + 8 + size
        if end > len(data):
            raise MatError("the file is cut off")
        element = (
            _unpacked(data[position + 8 : end], left) if kind == COMPRESSED else data[position:end]
        )
        left -= len(element)
        if left < 0:
            raise MatError(UNPACKED)
        position = end
        if len(element) < 8 or _tag(element, 0, order) != (MATRIX, len(element) - 8):
            raise MatError("the file is damaged")
        name = array_of(memoryview(element)[8:], order, 0).name
        if name in names:
            yield name, element


def _tag(data: bytes | memoryview, at: int, order: Order) -> tuple[int, int]:
    if len(data) < at + 8:
        raise MatError("the file is cut off")
    return int.from_bytes(data[at : at + 4], order), int.from_bytes(data[at + 4 : at + 8], order)


def _unpacked(packed: bytes, most: int) -> bytes:
    stream = zlib.decompressobj()
    try:
        data = stream.decompress(packed, most + 1)
    except zlib.error as error:
        raise MatError("the file is damaged") from error
    if len(data) > most:
        raise MatError(UNPACKED)
    if not stream.eof:
        raise MatError("the file is cut off")
    return data


def _elements(data: memoryview, order: Order) -> Iterator[Element]:
    """Type and content of the elements of an array, which start at multiples of eight bytes."""
    position = 0
    while position < len(data):
        kind, size = _tag(data, position, order)
        if kind >> 16:  # a small one: size and type share four bytes, the content is the other four
            kind, size, start, step = kind & 0xFFFF, kind >> 16, position + 4, 8
            fits = size <= 4
        else:
            start, step = position + 8, 8 + -(-size // 8) * 8
            fits = start + size <= len(data)
        if not fits:
            raise MatError("the file is damaged")
        yield kind, data[start : start + size]
        position += step


def array_of(data: memoryview, order: Order, most: int = MAX_CELLS + 1) -> Array:
    """An array from the content of its element, with no more than `most` elements of values.

    Raises:
        MatError: it is damaged.
    """
    parts = tuple(islice(_elements(data, order), 4 + most))
    if len(parts) < 3 or parts[0][0] != 6 or len(parts[0][1]) != 8:
        raise MatError("the file is damaged")
    flags = int.from_bytes(parts[0][1][:4], order)
    kind, imaginary = flags & 0xFF, bool(flags & 0x0800)
    if kind == OPAQUE:  # flags, name, type system, class
        texts = [bytes(content[:63]).decode("latin-1") for _, content in parts[1:4]]
        return Array(texts[0], kind, imaginary, (), (), texts[-1])
    (dimensions, shape), (letters, name) = parts[1:3]
    if dimensions != INT32 or len(shape) % 4 or len(shape) < 8 or letters != 1:
        raise MatError("the file is damaged")
    sizes = tuple(
        int.from_bytes(shape[i : i + 4], order, signed=True) for i in range(0, len(shape), 4)
    )
    return Array(bytes(name).decode("latin-1"), kind, imaginary, sizes, parts[3:])


def check(array: Array, order: Order) -> None:
    """Nothing, when the array can be read by scipy as what it says it is and is no larger than an answer.

    All that its cells hold is counted together, as it will be in memory and not as it is stored: 4096 numbers, 512
    cells, 204 800 characters.

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
    """The array and all in its cells, each of them checked; a cell array comes before anything in it is looked at."""
    if array.kind == OPAQUE:
        raise MatError(OPAQUES.get(array.object_class, REFUSED[OBJECT]))
    if array.kind in REFUSED:
        raise MatError(REFUSED[array.kind])
    if min(array.shape) < 0 or len(array.shape) > 4:
        raise MatError("the file is damaged")
    most = {CELL: MAX_CELLS, CHAR: MAX_ANSWER}.get(array.kind, MAX_ELEMENTS)
    if _size(array.shape) > most:
        raise MatError(
            f"too large: an array of {' x '.join(map(str, array.shape))}; {most} can be read here"
        )
    if array.kind == CELL:
        yield array
        yield from _cells(array, order, depth)
    elif (
        _is_sparse(array, order)
        if array.kind == SPARSE
        else _is_plain(array, math.prod(array.shape))
    ):
        yield array
    else:
        raise MatError("the file is damaged")


def _cells(array: Array, order: Order, depth: int) -> Iterator[Array]:
    if not depth:
        raise MatError("not a matrix: cell arrays are nested too deeply")
    if len(array.parts) != math.prod(array.shape) or any(kind != MATRIX for kind, _ in array.parts):
        raise MatError("the file is damaged")
    for _, content in array.parts:
        if len(content):  # an empty element is an empty matrix
            yield from _arrays(array_of(content, order), order, depth - 1)


def _amounts(array: Array) -> dict[str, int]:
    """How much of an answer it takes up itself; every row of text after the first is one more cell."""
    size = _size(array.shape)
    if array.kind == CHAR:
        return {LETTERS: size, CELLS: _size(array.shape[:-1]) - 1}
    return {CELLS if array.kind == CELL else NUMBERS: size}


def _size(shape: tuple[int, ...]) -> int:
    """Entries of an array; a million rows of nothing are a million."""
    return math.prod(max(length, 1) for length in shape)


def _is_plain(array: Array, count: int) -> bool:
    """Whether a matrix or text has as many values as it says; text may take more bytes than characters."""
    if array.kind == CHAR:
        kind, content = array.parts[0] if len(array.parts) == 1 else (0, b"")
        return kind in CHARACTERS and len(content) >= count * CHARACTERS[kind]
    if array.kind not in NUMERIC or len(array.parts) != (2 if array.imaginary else 1):
        return False
    return all(
        kind in BYTES and len(content) == count * BYTES[kind] for kind, content in array.parts
    )


def _is_sparse(array: Array, order: Order) -> bool:
    """Whether row indices and starts of columns of a sparse matrix point into it."""
    if len(array.shape) != 2 or len(array.parts) != (4 if array.imaginary else 3):
        return False
    (rows_kind, rows), (starts_kind, starts), *values = array.parts
    if (
        rows_kind != INT32
        or starts_kind != INT32
        or len(rows) % 4
        or len(starts) != 4 * (array.shape[1] + 1)
    ):
        return False
    integer = np.dtype("<i4" if order == "little" else ">i4")
    row, start = np.frombuffer(rows, integer), np.frombuffer(starts, integer)
    filled = int(start[-1])
    enough = all(kind in BYTES and len(content) >= filled * BYTES[kind] for kind, content in values)
    ordered = start[0] == 0 and bool((np.diff(start) >= 0).all()) and filled <= len(row)
    return (
        enough and ordered and bool(((row[:filled] >= 0) & (row[:filled] < array.shape[0])).all())
    )
