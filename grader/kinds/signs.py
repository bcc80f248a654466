"""A sign that is wrong and nothing else, in a sentence."""

from collections.abc import Iterator

import numpy as np

from ..reading.unreadable import entries_named
from .marker import Mask

MOST_PLACES = 3  # of entries with a wrong sign that are named


def said_of_signs(flipped: Mask, wrong: Mask) -> Iterator[str]:
    """The sentence where entries with a reversed sign are all that is wrong, and few."""
    if flipped.any() and (flipped == wrong).all() and wrong.sum() <= max(3, wrong.size // 4):
        yield f"Only a sign is wrong{f': {_places(flipped)}' if flipped.ndim else ''}."


def _places(flipped: Mask) -> str:
    """Entries in words, a whole column as one."""
    columns = sorted({int(where[-1]) for where in np.argwhere(flipped)})
    if flipped.ndim == 2 and len(columns) == 1 and flipped.sum() > 1:
        return f"column {columns[0] + 1}"
    return entries_named(flipped, MOST_PLACES)
