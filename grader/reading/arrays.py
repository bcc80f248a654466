"""Arrays out of what was typed: nested text brought to a shape, entries with or without a unit."""

import math
from collections.abc import Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...exercises.units import converted, dimension
from ...solutions.expression import Expression, ExpressionError
from .quantities import typed_quantity
from .typed_matrix import typed_matrix
from .unreadable import Unreadable, clip, entry_name, misread

Array = NDArray[np.float64]
DUST = 1e-12  # what rounding leaves of an imaginary part that is zero


def real_numbers(array: NDArray[Any]) -> Array:
    """The array without imaginary parts, where those are zero but for rounding.

    Raises:
        Unreadable: one is not.
    """
    if not np.iscomplexobj(array):
        return array
    numbers = np.asarray(array, dtype=np.complex128)
    real = np.asarray(numbers.real, dtype=np.float64)
    if not (np.abs(numbers.imag) < DUST * np.fmax(1.0, np.abs(real))).all():
        raise Unreadable("takes real numbers, got complex ones")
    return real


def reshaped(array: NDArray[Any], asked: tuple[int, ...]) -> Array:
    """The array in the asked shape, where only the way of writing it differs.

    Raises:
        Unreadable: it is of another shape.
    """
    shape = array.shape
    if shape != asked and not _is_written_as(shape, asked):
        expected = f"shape {asked}" if asked else "one number"
        raise Unreadable(f"takes {expected}, got {shape}{_shape_hint(shape, asked)}")
    return array.reshape(asked)


def _is_written_as(shape: tuple[int, ...], asked: tuple[int, ...]) -> bool:
    """Whether a shape is another way to write the asked one.

    Matrices of a stack may stand one below the other, a matrix in blocks, a vector may be a row or
    a column, and one number may stand in any brackets. Brackets around single entries or around all
    of it change nothing: (6, 3, 1) is (6, 3).
    """
    if without_single_axes(shape, asked) == asked:
        return True
    if len(asked) == 3:
        count, rows, columns = asked
        return shape == (count * rows, columns)
    if len(asked) == 2 and len(shape) == 3:
        count, rows, columns = shape
        return asked == (count * rows, columns)
    if len(asked) == 1:
        return sorted(shape) == sorted((1, *asked))
    return not asked and math.prod(shape) == 1


def without_single_axes(shape: tuple[int, ...], asked: tuple[int, ...]) -> tuple[int, ...]:
    """The shape without axes of length 1 that the asked one does not have."""
    left: list[int] = []
    for i, length in enumerate(shape):
        superfluous = len(left) + len(shape) - i > len(asked)
        if length != 1 or not superfluous or asked[len(left) : len(left) + 1] == (1,):
            left.append(length)
    return tuple(left)


def _shape_hint(shape: tuple[int, ...], asked: tuple[int, ...]) -> str:
    if len(shape) == 2 and shape[::-1] == asked:  # a transposed 6 x 3 matrix is 3 x 6
        return ": rows and columns look exchanged"
    if len(asked) == 2 and asked[0] == 6 and shape == (3, asked[1]):
        return ": the linear and the angular rows are asked, three each"
    if len(asked) == 1 and len(shape) == 2 and shape[0] == asked[0] and shape[1] > 1:
        return ": a product of a matrix and a vector takes @, not *"
    return ""


def refuse_infinite(array: Array) -> None:
    """Nothing, when all entries are finite.

    Raises:
        Unreadable: one is not; the first is named.
    """
    finite = np.isfinite(array)
    if finite.all():
        return
    first = tuple(map(int, np.argwhere(~finite)[0]))
    place = f", first at {entry_name(first)}" if first else ""
    raise Unreadable(f"takes finite numbers, got NaN or infinity{place}")


def typed_block(text: str, columns: int, what: str) -> Array:
    """A whole matrix in one string, of shape (rows, columns); `what` is expected instead.

    The matrices of a stack are put one below the other.

    Raises:
        Unreadable: it is no matrix of numbers, with a caret under the place.
    """
    try:
        rows = typed_matrix(text, (), columns, degrees=False)
    except ExpressionError as error:
        raise Unreadable(f"takes {what}, got text: {clip(text)}\n{error.caret}") from error
    return np.array([_values(row) for row in rows], dtype=float)


def _values(row: Sequence[Expression]) -> list[Any]:
    return [entry.at({}) for entry in row]


def quantity(text: str, unit: str, where: str) -> float:
    """The value of a typed entry in the asked unit, which one without a unit is taken to have.

    Raises:
        Unreadable: it is no quantity, or one of another dimension; `where` it stands.
    """
    try:
        value, typed = typed_quantity(text)
    except ExpressionError as error:
        raise misread(error, where) from error
    if not typed:
        return value
    if dimension(typed) != dimension(unit):
        place = f"{where}: " if where else ""
        raise Unreadable(f"{place}takes {_unit_name(unit)}, got {clip(text)}")
    return converted(value, unit)


def _unit_name(unit: str) -> str:
    return "a plain number" if unit == "1" else f"a value in {unit}"


def flat_texts(nested: Any) -> tuple[list[str], tuple[int, ...]]:
    """All texts of a nested list, and its shape.

    Raises:
        Unreadable: its rows have different lengths.
    """
    if not isinstance(nested, list):
        return [str(nested)], ()
    parts = cast("list[Any]", nested)

    texts: list[str] = []
    shapes = set[tuple[int, ...]]()
    for part in parts:
        entries, shape = flat_texts(part)
        texts += entries
        shapes.add(shape)
    if len(shapes) > 1:
        raise Unreadable("takes rows of one length, got rows of different lengths")
    inner = shapes.pop() if shapes else ()
    return texts, (len(parts), *inner)
