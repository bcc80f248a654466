"""Numbers out of raw values: arrays as they are, typed text with units, formulas without names."""

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ..exercises.answers import Configurations, Numbers, Variant
from ..solutions.expression import ExpressionError
from ..solutions.typed_matrix import typed_matrix
from ..solutions.units import converted, dimension, typed_quantity
from .unreadable import Unreadable, clip, entry_name, misread
from .wire import Raw

Array = NDArray[np.float64]


def read_numbers(answer: Numbers, raw: Raw, _: Variant) -> Array:
    """An array of the asked shape. Raises Unreadable."""
    array = np.asarray(raw.value) if raw.kind == "num" else _typed_array(raw, answer.shape, answer.unit_of_entries())
    if np.iscomplexobj(array):
        raise Unreadable("takes real numbers, got complex ones")
    array = reshaped(array, answer.shape)
    _refuse_infinite(array)
    return array


def read_configurations(answer: Configurations, raw: Raw, _: Variant) -> Array:
    """Rows (m, joints); a single configuration is one row. Raises Unreadable."""
    n = answer.joints
    array: NDArray[Any] = raw.value if raw.kind == "num" else _typed_rows(raw, answer)
    if np.iscomplexobj(array):
        raise Unreadable("takes real numbers, got complex ones")
    flat = n == 1 and (array.ndim < 2 or 1 in array.shape)
    if array.ndim > 2 or not (flat or array.shape[-1:] == (n,)) or array.size == 0:
        one = "a list of numbers" if n == 1 else f"rows of {n} numbers each"
        raise Unreadable(f"takes {one}, got shape {array.shape}")
    array = array.reshape(-1, n)
    if len(array) > answer.most:
        raise Unreadable(f"takes up to {answer.most} of them, got {len(array)}")
    _refuse_infinite(array)
    return array


def reshaped(array: NDArray[Any], asked: tuple[int, ...]) -> Array:
    """The array in the asked shape, where only the way of writing it differs. Raises Unreadable."""
    shape = array.shape
    stacked = len(asked) == 3 and shape == (asked[0] * asked[1], asked[2])  # matrices one below the other
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


def _refuse_infinite(array: Array) -> None:
    if not np.isfinite(array).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        place = f", first at {entry_name(where)}" if where else ""
        raise Unreadable(f"takes finite numbers, got NaN or infinity{place}")


def _typed_array(raw: Raw, shape: tuple[int, ...], units: NDArray[np.str_]) -> Array:
    """Numbers that were typed as text, each with or without its unit."""
    text = raw.value
    if raw.kind != "text":
        raise Unreadable(f"takes numbers of shape {shape}, got {clip(raw.kind)}")
    if isinstance(text, str) and shape:
        return _typed_block(text, f"numbers of shape {shape}")
    entries, found = flat_texts(text)
    reshaped(np.zeros(found), shape)  # refuses another shape
    values = [
        _quantity(entry, str(unit), entry_name(where) if shape else "")
        for entry, unit, where in zip(entries, units.ravel(), np.ndindex(shape), strict=True)
    ]
    return np.array(values, dtype=float).reshape(shape)


def _typed_rows(raw: Raw, answer: Configurations) -> Array:
    if raw.kind != "text":
        raise Unreadable(f"takes numbers, got {clip(raw.kind)}")
    if isinstance(raw.value, str):
        return _typed_block(raw.value, "numbers")
    entries, shape = flat_texts(raw.value)
    units = np.resize(np.array(answer.units), len(entries))
    values = [_quantity(entry, str(unit), f"entry {i}") for i, (entry, unit) in enumerate(zip(entries, units), 1)]  # noqa: B905 - resized to fit
    return np.array(values, dtype=float).reshape(shape)


def _typed_block(text: str, what: str) -> Array:
    """A whole matrix in one string."""
    try:
        rows = typed_matrix(text, ())
    except ExpressionError as error:
        raise Unreadable(f"takes {what}, got text: {clip(text)}\n{error.caret}") from error
    return np.array([[entry.at({}) for entry in row] for row in rows], dtype=float)


def _quantity(text: str, unit: str, where: str) -> float:
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
