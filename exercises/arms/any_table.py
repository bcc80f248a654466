"""Arms of any structure as a function gets them: a table, the joint types and q, right and misread.

`dh` (n, 4) is a standard table with rows theta, d, a, alpha [rad, m], to which q (n,) [rad, m] is
added in theta or d; `kinds` are joint types, such as "RRP". A `TableFunction` returns J (6, n) of
the last frame's origin in base axes.
"""

from collections.abc import Callable
from itertools import accumulate
from typing import Any

import numpy as np

from ...solutions.chain import from_modified, standard_transform
from ...solutions.jacobian import jacobian as jacobian_of_chain
from ..arm import Array
from ..calculations.columns import ANGULAR_FIRST, SLIPS, Columns, Slip, angular_first, right

TableFunction = Callable[[Any, str, Any], Array]


def any_table(rng: np.random.Generator, kinds: str, *, planar: bool = False) -> list[Any]:
    """An arm as [dh, kinds, q], with offsets, oblique axes and links in both directions.

    A `planar` arm has parallel axes.
    """
    n = len(kinds)
    theta = rng.uniform(-3, 3, n)
    alpha = rng.choice([-1, 1], n) * rng.uniform(0.4, 2.7, n)
    if planar:
        alpha = np.zeros(n)  # drawn all the same: what comes after stays as it was
    d = rng.choice([-1, 1], n) * rng.uniform(0.1, 0.8, n)
    a = rng.choice([-1, 1], n) * rng.uniform(0.1, 0.8, n)
    q = np.where(turning(kinds), rng.uniform(-2.5, 2.5, n), rng.uniform(0.2, 0.9, n))
    dh = np.round(np.stack([theta, d, a, alpha], axis=1), 3) + 0.0
    return [dh.tolist(), kinds, np.round(q, 3).tolist()]


def turning(kinds: str) -> Array:
    """Which joints are revolute, (n,)."""
    return np.array([kind == "R" for kind in kinds])


def by_columns(way: Columns) -> TableFunction:
    """A function that puts the columns together in this way."""

    def jacobian(dh: Any, kinds: str, q: Any) -> Array:
        rows = np.array(dh, dtype=float)
        rows[:, 0] += np.where(turning(kinds), q, 0.0)
        rows[:, 1] += np.where(turning(kinds), 0.0, q)
        frames = accumulate(standard_transform(rows), np.matmul, initial=np.eye(4))
        return way(np.array([*frames]), kinds)

    return jacobian


def without_offsets(dh: Any, kinds: str, q: Any) -> Array:
    """The joint variables in place of what stands in the table."""
    rows = np.array(dh, dtype=float)
    rows[turning(kinds), 0] = 0.0
    rows[~turning(kinds), 1] = 0.0
    return by_columns(right)(rows, kinds, q)


def modified(dh: Any, kinds: str, q: Any) -> Array:
    """The table read in the modified convention."""
    return jacobian_of_chain(from_modified(dh, kinds), q)


def in_degrees(dh: Any, kinds: str, q: Any) -> Array:
    """All angles taken as degrees."""
    rows = np.array(dh, dtype=float)
    rows[:, (0, 3)] = np.radians(rows[:, (0, 3)])
    return by_columns(right)(rows, kinds, np.where(turning(kinds), np.radians(q), q))


WRONG_COLUMNS = (*SLIPS, Slip(ANGULAR_FIRST, angular_first))
MISREAD: tuple[tuple[str, TableFunction], ...] = (
    *[(slip.sentence, by_columns(slip.columns)) for slip in WRONG_COLUMNS],
    ("The offsets in the table are lost: q is added to them.", without_offsets),
    ("The table is read in the modified convention; it is a standard one.", modified),
    ("The angles seem to be taken as degrees; they are radians.", in_degrees),
)
