"""What is wrong with few entries and nothing else: a sign, a copied number, two lines exchanged."""

from collections.abc import Callable, Iterator
from itertools import combinations

import numpy as np

from ..reading.unreadable import entries_named
from .marker import Array, Mask, Named

LEAST_ENTRIES = 4  # of an answer, for a single wrong one to be a slip
MOST_PLACES = 3  # of entries with a wrong sign that are named


def said_of_signs(flipped: Mask, wrong: Mask) -> Iterator[Named]:
    """The name where entries with a reversed sign are all that is wrong, and few or in one column.

    `flipped` has the wrong entries that are right with the other sign.
    """
    few = wrong.sum() <= max(3, wrong.size // 4) or _is_one_column(wrong)
    if not few or not flipped.any() or (flipped != wrong).any():
        return
    if flipped.ndim == 0:
        yield Named("Only a sign is wrong.", "slip", local=True)
    else:
        yield Named(f"Only a sign is wrong: {_places(flipped)}.", "slip", local=True)


def said_of_one_entry(right: Mask) -> Iterator[Named]:
    """The name where a single entry of several is wrong, whatever stands there."""
    if right.size >= LEAST_ENTRIES and (~right).sum() == 1:
        place = entries_named(~right, 1)
        yield Named(f"Only {place} is wrong; all the rest is right.", "slip", local=True)


def said_of_exchanged(agrees: Callable[[Array], bool], own: Array) -> Iterator[Named]:
    """The name where two rows or two columns are exchanged; `agrees` looks at a whole array."""
    if own.ndim != 2:
        return
    for axis, line in ((0, "Rows"), (1, "Columns")):
        for i, j in combinations(range(own.shape[axis]), 2):
            order = [*range(own.shape[axis])]
            order[i], order[j] = j, i
            exchanged = np.take(own, order, axis=axis)
            if agrees(exchanged):
                yield Named(f"{line} {i + 1} and {j + 1} are exchanged.", "slip", local=True)
                return


def _is_one_column(wrong: Mask) -> bool:
    """Whether all that is wrong stands in one of several columns, as when an axis is reversed."""
    return wrong.ndim == 2 and wrong.shape[1] > 1 and wrong.any(axis=0).sum() == 1


def _places(flipped: Mask) -> str:
    """Entries in words, a whole column as one."""
    columns = np.unique(np.argwhere(flipped)[:, -1])
    if flipped.ndim == 2 and len(columns) == 1 and flipped.sum() > 1:
        return f"column {columns[0] + 1}"
    return entries_named(flipped, MOST_PLACES)
