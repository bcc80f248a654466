"""Arrays out of what was typed: nested text brought to a shape, entries with or without a unit."""

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...exercises.units import converted, dimension
from ...solutions.expression import ExpressionError
from .quantities import typed_quantity
from .typed_matrix import typed_matrix
from .unreadable import Unreadable, clip, entry_name, misread

Array = NDArray[np.float64]


def reshaped(array: NDArray[Any], asked: tuple[int, ...]) -> Array:
    """The array in the asked shape, where only the way of writing it differs. Raises Unreadable."""
    shape = array.shape
    stacked = len(asked) == 3 and shape == (
        asked[0] * asked[1],
        asked[2],
    )  # matrices one below the other
    vector = len(asked) == 1 and sorted(shape) == sorted((1, *asked))
    single = not asked and array.size == 1
    if shape != asked and not (stacked or vector or single):
        number = "one number" if not asked else f"shape {asked}"
        raise Unreadable(f"takes {number}, got {shape}{_shape_hint(shape, asked)}")
    return array.reshape(asked)


def _shape_hint(shape: tuple[int, ...], asked: tuple[int, ...]) -> str:
    if len(shape) == 2 and shape[::-1] == asked:  # a transposed 6 x 3 matrix is 3 x 6
        return ": rows and columns look exchanged"
    if len(asked) == 2 and asked[0] == 6 and shape == (3, asked[1]):
        return ": the linear and the angular rows are asked, three each"
    if len(asked) == 1 and len(shape) == 2 and shape[0] == asked[0] and shape[1] > 1:
        return ": a product of a matrix and a vector takes @, not *"
    return ""


def refuse_infinite(array: Array) -> None:
    if not np.isfinite(array).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        place = f", first at {entry_name(where)}" if where else ""
        raise Unreadable(f"takes finite numbers, got NaN or infinity{place}")


def typed_block(text: str, what: str) -> Array:
    """A whole matrix in one string."""
    try:
        rows = typed_matrix(text, ())
    except ExpressionError as error:
        raise Unreadable(f"takes {what}, got text: {clip(text)}\n{error.caret}") from error
    return np.array([[entry.at({}) for entry in row] for row in rows], dtype=float)


def quantity(text: str, unit: str, where: str) -> float:
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
    """All texts of a nested list, and its shape. Raises Unreadable for rows of different lengths."""
    if not isinstance(nested, list):
        return [str(nested)], ()
    parts = [flat_texts(part) for part in cast("list[Any]", nested)]
    shapes = {shape for _, shape in parts}
    if len(shapes) > 1:
        raise Unreadable("takes rows of one length, got rows of different lengths")
    inner = shapes.pop() if shapes else ()
    return [entry for entries, _ in parts for entry in entries], (len(parts), *inner)
