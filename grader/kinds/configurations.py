"""Configurations: a list of rows, of which a part's own check says how many are right."""

import math
from typing import Any

import numpy as np

from ...exercises.answers import Configurations, Variant
from ..collecting.wire import Raw
from ..reading.arrays import flat_texts, quantity, real_numbers, refuse_infinite, typed_block
from ..reading.unreadable import Unreadable, clip
from .marker import Array, Comparison, Marker, Mask, Wanted


def read_configurations(answer: Configurations, raw: Raw, _: Variant) -> Array:
    """Rows (m, joints); a single configuration is one row.

    Raises:
        Unreadable: it is of another kind or shape, or has too many rows.
    """
    array: Array = real_numbers(raw.value) if raw.kind == "num" else _typed_rows(raw, answer)
    if array.ndim > 2 and math.prod(array.shape[2:]) == 1:  # (8, 6, 1) is (8, 6)
        array = array.reshape(array.shape[:2])
    if not _has_rows(array, answer.joints):
        one = f"rows of {answer.joints} numbers each"
        if answer.joints == 1:
            one = "a list of numbers"
        raise Unreadable(f"takes {one}, got shape {array.shape}")

    array = array.reshape(-1, answer.joints)
    if len(array) > answer.most:
        raise Unreadable(f"takes up to {answer.most} of them, got {len(array)}")
    refuse_infinite(array)
    return array


def _has_rows(array: Array, joints: int) -> bool:
    """Whether an array is one row or several; of one joint also a list in any direction."""
    if array.size == 0 or array.ndim > 2:
        return False
    if joints == 1 and (array.ndim < 2 or 1 in array.shape):
        return True
    return array.shape[-1:] == (joints,)


def _typed_rows(raw: Raw, answer: Configurations) -> Array:
    """Rows of numbers that were typed as text, each with or without its unit."""
    if raw.kind != "text":
        raise Unreadable(f"takes numbers, got {clip(raw.kind)}")
    if isinstance(raw.value, str):
        return typed_block(raw.value, answer.joints, "numbers")
    entries, shape = flat_texts(raw.value)
    units = np.resize(np.array(answer.units), len(entries))
    values: list[float] = []
    for i, (entry, unit) in enumerate(zip(entries, units, strict=True), 1):
        values.append(quantity(entry, str(unit), f"entry {i}"))
    return np.array(values, dtype=float).reshape(shape)


def _compared(answer: Configurations, _: Variant, wanted: Wanted, value: Array) -> Comparison:
    """Row by row, to tell a known mistake; what is handed in is judged by the part's own check."""
    if value.shape != wanted.value.shape:
        return Comparison(np.zeros(value.shape, dtype=bool), 0.0)
    allowed = 1.001 * 10.0**-answer.decimals
    right: Mask = np.less_equal(np.abs(value - wanted.value), allowed, dtype=bool)
    return Comparison(right, float(right.all()))


def _handed_in(_: Configurations, value: Any, __: Variant) -> Raw:
    return Raw("num", np.asarray(value, dtype=float))


def _shown(value: Any) -> Any:
    return np.asarray(value).tolist()


MARKER = Marker(read_configurations, _compared, _handed_in, shown=_shown)
