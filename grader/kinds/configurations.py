"""Configurations: a list of rows, of which a part's own check says how many are right."""

from typing import Any

import numpy as np

from ...exercises.answers import Configurations, Variant
from ..collecting.wire import Raw
from ..reading.arrays import flat_texts, quantity, refuse_infinite, typed_block
from ..reading.unreadable import Unreadable, clip
from .marker import Array, Comparison, Marker, Mask, Wanted


def read_configurations(answer: Configurations, raw: Raw, _: Variant) -> Array:
    """Rows (m, joints); a single configuration is one row. Raises Unreadable."""
    n = answer.joints
    array: Array = raw.value if raw.kind == "num" else _typed_rows(raw, answer)
    if np.iscomplexobj(array):
        raise Unreadable("takes real numbers, got complex ones")
    flat = n == 1 and (array.ndim < 2 or 1 in array.shape)
    if array.ndim > 2 or not (flat or array.shape[-1:] == (n,)) or array.size == 0:
        one = "a list of numbers" if n == 1 else f"rows of {n} numbers each"
        raise Unreadable(f"takes {one}, got shape {array.shape}")
    array = array.reshape(-1, n)
    if len(array) > answer.most:
        raise Unreadable(f"takes up to {answer.most} of them, got {len(array)}")
    refuse_infinite(array)
    return array


def _typed_rows(raw: Raw, answer: Configurations) -> Array:
    if raw.kind != "text":
        raise Unreadable(f"takes numbers, got {clip(raw.kind)}")
    if isinstance(raw.value, str):
        return typed_block(raw.value, "numbers")
    entries, shape = flat_texts(raw.value)
    units = np.resize(np.array(answer.units), len(entries))
    values: list[float] = []
    for i, (entry, unit) in enumerate(zip(entries, units, strict=True), 1):
        values.append(quantity(entry, str(unit), f"entry {i}"))
    return np.array(values, dtype=float).reshape(shape)


def _compared(answer: Configurations, _: Variant, wanted: Wanted, value: Array) -> Comparison:
    """Row by row, which is what a known mistake is told by; the part's own check judges what is handed in."""
    if value.shape != wanted.value.shape:
        return Comparison(np.zeros(value.shape, dtype=bool), 0.0)
    right: Mask = np.less_equal(
        np.abs(value - wanted.value), 1.001 * 10.0**-answer.decimals, dtype=bool
    )
    return Comparison(right, float(right.all()))


def _handed_in(_: Configurations, value: Any, __: Variant) -> Raw:
    return Raw("num", np.asarray(value, dtype=float))


def _shown(value: Any) -> Any:
    return np.asarray(value).tolist()


MARKER = Marker(read_configurations, _compared, _handed_in, shown=_shown)
