"""What explains a wrong answer: known mistakes, presentations, printed numbers taken otherwise."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Part, Rows
from ..kinds.marker import Asked, Named, Presentation, Wanted
from ..kinds.markers import marker_of
from .answer_key import AnswerKey
from .compare import compare

Array = NDArray[np.float64]


def _swapped_blocks(J: Array) -> Array | None:
    return np.concatenate([J[3:], J[:3]]) if J.shape[:1] == (6,) else None


def _transposed(J: Array) -> Array | None:
    """The transposed matrix where it has the same shape; of a stack, every matrix of it."""
    if J.ndim == 2 and J.shape[0] == J.shape[1]:
        return J.T
    return np.swapaxes(J, -1, -2) if J.ndim == 3 else None


def _columns_reversed(J: Array) -> Array | None:
    return J[:, ::-1] if J.ndim == 2 else None


TRANSPOSED = Presentation(_transposed, "It looks transposed: rows and columns are exchanged.")
SWAPPED: dict[Rows, Presentation] = {
    "linear, angular": Presentation(
        _swapped_blocks,
        "The angular rows seem to stand above the linear ones; linear rows come first.",
    ),
    "angular, linear": Presentation(
        _swapped_blocks,
        "The linear rows seem to stand above the angular ones; angular rows come first.",
    ),
}
REVERSED = (
    Presentation(np.negative, "Every sign is reversed.", "concept"),
    Presentation(_columns_reversed, "The columns stand in reverse order."),
)


def named(key: AnswerKey, part: Part, wanted: Wanted, value: Any, right: Any) -> Iterator[Named]:
    """What explains a readable but wrong answer, the most telling first.

    First what the exercise knows, then what may happen to any finished answer, then what may happen
    to the printed numbers.
    """
    for mistake, mistaken in key.mistaken(part, wanted):
        if compare(key, part, mistaken, value).all_right:
            yield mistake
            return
    known = presentation(key, part, wanted, value)
    if known:
        yield Named(known.sentence, known.fault)
        return
    marker = marker_of(part.answer)
    found = [*marker.found(_asked(key, part, wanted), value, right)]
    if found:
        yield from found
        return
    if marker.priced(part.answer, value):
        for mistake, mistaken in key.misread(part, wanted):
            if compare(key, part, mistaken, value).all_right:
                yield mistake


def presentation(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Presentation | None:
    """The first known presentation of the reference that an answer agrees with."""
    marker = marker_of(part.answer)
    arrays = marker.arrays(_asked(key, part, wanted), value)
    if not arrays:
        return None
    blocks = (SWAPPED[key.exercise.rows],) if marker.has_blocks(part.answer) else ()
    for known in (TRANSPOSED, *blocks, *REVERSED, *marker.in_other_units(part.answer)):
        if all(_agree(own, known.of(reference), allowed) for own, reference, allowed in arrays):
            return known
    return None


def _asked(key: AnswerKey, part: Part, wanted: Wanted) -> Asked:
    return Asked(part.answer, key.v, wanted, lambda: key.in_degrees.get(part.variable))


def _agree(value: Array, seen: Array | None, allowed: Array) -> bool:
    return (
        seen is not None
        and seen.shape == value.shape
        and bool((np.abs(value - seen) <= allowed).all())
    )
