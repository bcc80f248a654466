"""Right or wrong, entry by entry, and what that earns."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..exercises.exercise import Credit, Exercise, Given, Numbers, Part, TableOf, Variant
from ..solutions.table import Table
from .tolerance import tolerance

Mask = NDArray[np.bool_]
TRIVIAL = (-1.0, 0.0, 1.0)
ANGLES = (0, 3)  # columns theta and alpha of a table


def right_entries(exercise: Exercise, part: Part, v: Variant, given: Given, reference: Any, value: Any) -> Mask:
    """Which entries of a readable answer agree with the reference, of the answer's shape."""
    if isinstance(part.answer, TableOf):
        return _right_cells(part.answer, v, reference, value)
    allowed = tolerance(exercise.slug, part, v, given, exercise.scale(v))
    return np.less_equal(np.abs(value - reference), allowed, dtype=bool)


def _right_cells(answer: TableOf, v: Variant, reference: Table, value: Table) -> Mask:
    """Cells that have the reference's value at three configurations; angles count modulo a full turn."""
    half = 0.5 * 10.0**-answer.decimals
    allowed = np.array([4 * half, 6 * half, 6 * half, 4 * half])
    q = np.random.default_rng(0).uniform(-1, 1, (3, len(answer.kinds)))
    difference = _table_numbers(value, v, q) - _table_numbers(reference, v, q)
    angle = difference[..., ANGLES]
    difference[..., ANGLES] = angle - 2 * np.pi * np.round(angle / (2 * np.pi))
    return np.less_equal(np.abs(difference).max(axis=0), allowed, dtype=bool)


def _table_numbers(table: Table, v: Variant, q: ArrayLike) -> NDArray[np.float64]:
    """Cells (..., n, 4) of a table with the variant's lengths at q (..., n)."""
    joints = np.asarray(q, dtype=float)
    lengths = {name: x for name, x in v.items() if isinstance(x, int | float)}
    return table.numbers({**lengths, **{name: joints[..., i] for i, name in enumerate(table.joints)}})


def earning_entries(part: Part, reference: Any, varies: Mask, v: Variant) -> Mask:
    """Entries that carry marks: they vary between students and are none of -1, 0, 1 for this one.

    A Jacobian is full of structural zeros and ones, so that a matrix of zeros agrees with many entries of it.
    """
    numbers = reference if isinstance(part.answer, Numbers) else _table_numbers(reference, v, v["q"])
    trivial = np.isclose(numbers[..., None], TRIVIAL, rtol=0, atol=1e-6).any(-1)
    earning = varies & ~trivial
    return earning if earning.any() else np.ones_like(varies)


def varying_entries(answers: list[Any], part: Part, variants: list[Variant]) -> Mask:
    """Entries of a part's reference that differ between the given variants."""
    if isinstance(part.answer, Numbers):
        stack = np.array(answers)
    else:
        stack = np.array([_table_numbers(table, v, v["q"]) for table, v in zip(answers, variants, strict=True)])
    return np.ptp(stack, axis=0) > 1e-6


def fraction(right: Mask, earning: Mask, credit: Credit) -> float:
    """Share of the points in [0, 1]; a wrong entry that earns nothing voids its column.

    A column without any earning entry costs its share of the columns when it is wrong.
    """
    if right.all():
        return 1.0
    if credit == "all":
        return 0.0
    columns = right.reshape(-1, 1) if right.ndim == 1 else right
    weights = earning.reshape(columns.shape)
    sound = (columns | weights).all(axis=-2, keepdims=True)
    whole = columns.all(axis=-2, keepdims=True) if credit == "column" else np.ones_like(sound)
    earned = int((columns & weights & sound & whole).sum())
    barren = ~weights.any(axis=-2, keepdims=True) & ~sound
    return max(0.0, earned / int(weights.sum()) - float(np.mean(barren)))
