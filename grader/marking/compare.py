"""Right or wrong, entry by entry, and what that earns."""

from typing import Any

import numpy as np

from ...exercises.exercise import Credit, Part
from ..kinds.marker import Comparison, Mask, Wanted
from ..kinds.markers import marker_of
from .answer_key import AnswerKey

BLOCK = 3  # rows of J: linear, angular


def compare(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Comparison:
    """A readable answer beside what is wanted."""
    found = marker_of(part.answer).compared(part.answer, key.v, wanted, value)
    if isinstance(found, Comparison):
        return found
    return Comparison(found, shared(key, part, found))


def shared(key: AnswerKey, part: Part, right: Mask) -> float:
    """Share of the points that these right entries earn."""
    if right.all():
        return 1.0
    earning = np.broadcast_to(key.earning(part), right.shape)
    if marker_of(part.answer).by_rows:
        return fraction(right.T, earning.T, part.credit)
    return fraction(right, earning, part.credit)


def fraction(right: Mask, earning: Mask, credit: Credit) -> float:
    """Share of the points in [0, 1]; a wrong entry that earns nothing voids its column.

    A column without any earning entry costs its share of the columns when it is wrong.
    """
    if right.all():
        return 1.0
    if credit == "all" or right.ndim == 0:
        return 0.0
    columns = right.reshape(-1, 1) if right.ndim == 1 else right
    weights = earning.reshape(columns.shape)
    sound = (columns | weights).all(axis=-2, keepdims=True)
    earned = int((columns & weights & sound & _whole(columns, credit)).sum())
    barren = ~weights.any(axis=-2, keepdims=True) & ~sound
    return max(0.0, earned / int(weights.sum()) - float(np.mean(barren)))


def _whole(columns: Mask, credit: Credit) -> Mask:
    """Where credit is for columns or blocks, entries of those that are right; else all."""
    if credit == "column":
        return np.broadcast_to(columns.all(axis=-2, keepdims=True), columns.shape)
    whole = np.ones_like(columns)
    if credit == "block":
        for start in range(0, columns.shape[-2], BLOCK):
            rows = (..., slice(start, start + BLOCK), slice(None))
            whole[rows] = columns[rows].all()
    return whole
