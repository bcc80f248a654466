"""MATLAB files of version 5 to 7, unpacked element by element before scipy reads what is asked.

Sizes, types and indices of a hostile file would otherwise decide how much memory is taken and
where it is written. Format: MathWorks, MAT-File Format, level 5.
"""

import zlib
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Literal

from ...solutions.errors import KinegradeError

Order = Literal["little", "big"]
Element = tuple[int, memoryview]

HEADER = 128  # bytes, of which the last two say the byte order and the two before the version
HDF_SIGNATURE = b"\x89HDF\r\n\x1a\n"
VERSION_5 = 0x0100
MAX_UNPACKED = 4 << 20
MAX_VARIABLES = 1000
MAX_CELLS = 512

# Types of elements.
INT8 = 1
INT32 = 5
UINT32 = 6
MATRIX = 14
COMPRESSED = 15

# Classes of arrays.
CELL = 1
STRUCT = 2
OBJECT = 3
CHAR = 4
SPARSE = 5
NUMERIC = range(6, 16)
FUNCTION = 16
OPAQUE = 17

COMPLEX = 0x0800  # among the flags of an array
CUT_OFF = "the file is cut off"
DAMAGED = "the file is damaged"
UNPACKED = f"the file unpacks to more than {MAX_UNPACKED >> 20} MB; save only your answers"
RESAVE = "save it with save('name.mat', ..., '-v7')"


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
    if HDF_SIGNATURE in data[:1024] or data[:10] == b"MATLAB 7.3":
        raise MatError(f"the file is of version 7.3, which is not read; {RESAVE}")

    orders: dict[bytes, Order] = {b"IM": "little", b"MI": "big"}
    order = orders.get(data[126:HEADER])
    if order is None or int.from_bytes(data[124:126], order) != VERSION_5:
        raise MatError(f"the file is no MATLAB file of version 5 to 7; {RESAVE}")
    return order


def variables(data: bytes, order: Order, names: Collection[str]) -> Iterator[tuple[str, bytes]]:
    """Name and unpacked bytes, tag included, of the variables that are asked.

    Raises:
        MatError: the file is cut off or damaged, unpacks to more than 4 MB or has more than 1000
            variables; what came before holds.
    """
    left = MAX_UNPACKED
    position = HEADER
    count = 0
    while position < len(data):
        count += 1
        if count > MAX_VARIABLES:
            raise MatError(
                f"the file has more than {MAX_VARIABLES} variables; save only your answers"
            )

        kind, size = _tag(data, position, order)
        end = position + 8 + size
        if end > len(data):
            raise MatError(CUT_OFF)
        element = data[position:end]
        if kind == COMPRESSED:
            element = _unpacked(element[8:], left)
        left -= len(element)
        if left < 0:
            raise MatError(UNPACKED)
        position = end

        name = _matrix_name(element, order)
        if name in names:
            yield name, element


def _matrix_name(element: bytes, order: Order) -> str:
    """Name of the array that an element holds, which is all there may be at the top of a file."""
    if len(element) < 8 or _tag(element, 0, order) != (MATRIX, len(element) - 8):
        raise MatError(DAMAGED)
    return array_of(memoryview(element)[8:], order, 0).name


def _tag(data: bytes | memoryview, at: int, order: Order) -> tuple[int, int]:
    """Type and size of the element that starts here."""
    if len(data) < at + 8:
        raise MatError(CUT_OFF)
    return int.from_bytes(data[at : at + 4], order), int.from_bytes(data[at + 4 : at + 8], order)


def _unpacked(packed: bytes, most: int) -> bytes:
    stream = zlib.decompressobj()
    try:
        data = stream.decompress(packed, most + 1)
    except zlib.error as error:
        raise MatError(DAMAGED) from error
    if len(data) > most:
        raise MatError(UNPACKED)
    if not stream.eof:
        raise MatError(CUT_OFF)
    return data


def _elements(data: memoryview, order: Order) -> Iterator[Element]:
    """Type and content of the elements of an array, which start at multiples of eight bytes."""
    position = 0
    while position < len(data):
        kind, size = _tag(data, position, order)
        if kind >> 16:  # a small one: size and type share four bytes, the content is the other four
            size = kind >> 16
            kind &= 0xFFFF
            start = position + 4
            step = 8
            fits = size <= 4
        else:
            start = position + 8
            step = 8 + -(-size // 8) * 8
            fits = start + size <= len(data)
        if not fits:
            raise MatError(DAMAGED)
        yield kind, data[start : start + size]
        position += step


def array_of(data: memoryview, order: Order, most: int = MAX_CELLS + 1) -> Array:
    """An array from the content of its element, with no more than `most` elements of values.

    Raises:
        MatError: it is damaged.
    """
    parts = tuple(islice(_elements(data, order), 4 + most))
    if len(parts) < 3:
        raise MatError(DAMAGED)
    flags_type, flags_content = parts[0]
    if flags_type != UINT32 or len(flags_content) != 8:
        raise MatError(DAMAGED)
    flags = int.from_bytes(flags_content[:4], order)
    kind = flags & 0xFF
    imaginary = bool(flags & COMPLEX)

    if kind == OPAQUE:  # flags, name, type system, class
        texts = [bytes(content[:63]).decode("latin-1") for _, content in parts[1:4]]
        return Array(texts[0], kind, imaginary, (), (), texts[-1])

    letters_type, letters = parts[2]
    if letters_type != INT8:
        raise MatError(DAMAGED)
    name = bytes(letters).decode("latin-1")
    return Array(name, kind, imaginary, _shape(parts[1], order), parts[3:])


def _shape(element: Element, order: Order) -> tuple[int, ...]:
    """Lengths of an array, two at least; a hostile one may say that they are negative."""
    kind, content = element
    if kind != INT32 or len(content) % 4 or len(content) < 8:
        raise MatError(DAMAGED)
    starts = range(0, len(content), 4)
    return tuple(int.from_bytes(content[i : i + 4], order, signed=True) for i in starts)
