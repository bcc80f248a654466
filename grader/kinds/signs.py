"""A sign that is wrong and nothing else, in a sentence."""

from collections.abc import Iterator

import numpy as np

from ..reading.unreadable import entries_named
from .marker import Mask

MOST_PLACES = 3  # of entries with a wrong sign that are named


def said_of_signs(flipped: Mask, wrong: Mask) -> Iterator[str]:
    """The sentence where entries with a reversed sign are all that is wrong, and few.

    `flipped` has the wrong entries that are right with the other sign.
    """
    few = wrong.sum() <= max(3, wrong.size // 4)
    if not few or not flipped.any() or (flipped != wrong).any():
        return
    if flipped.ndim == 0:
        yield "Only a sign is wrong."
    else:
        yield f"Only a sign is wrong: {_places(flipped)}."


def _places(flipped: Mask) -> str:
    """Entries in words, a whole column as one."""
    columns = np.unique(np.argwhere(flipped)[:, -1])
    if flipped.ndim == 2 and len(columns) == 1 and flipped.sum() > 1:
        return f"column {columns[0] + 1}"
    return entries_named(flipped, MOST_PLACES)
