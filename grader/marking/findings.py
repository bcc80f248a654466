"""Known ways to present or compute a right answer wrongly, as a table: what it does, and the sentence that names it."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Part, Rows
from ..kinds.marker import Asked, Presentation, Wanted
from ..kinds.markers import marker_of
from .answer_key import AnswerKey
from .compare import compare
from .verdict import Finding

Array = NDArray[np.float64]


def _swapped_blocks(J: Array) -> Array | None:
    return np.concatenate([J[3:], J[:3]]) if J.shape[:1] == (6,) else None


def _transposed(J: Array) -> Array | None:
    return (
        J.T
        if J.ndim == 2 and J.shape[0] == J.shape[1]
        else np.swapaxes(J, -1, -2)
        if J.ndim == 3
        else None
    )


TRANSPOSED = Presentation(
    _transposed, "It looks transposed: rows and columns are exchanged.", worthless=True
)
SWAPPED: dict[Rows, Presentation] = {
    "linear, angular": Presentation(
        _swapped_blocks,
        "The angular rows seem to stand above the linear ones; linear rows come first.",
        worthless=True,
    ),
    "angular, linear": Presentation(
        _swapped_blocks,
        "The linear rows seem to stand above the angular ones; angular rows come first.",
        worthless=True,
    ),
}
REVERSED = (
    Presentation(np.negative, "Every sign is reversed.", worthless=True),
    Presentation(
        lambda J: J[:, ::-1] if J.ndim == 2 else None,
        "The columns stand in reverse order.",
        worthless=True,
    ),
)


def presentation(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Presentation | None:
    """The first known presentation of the reference that an answer of numbers or formulas agrees with."""
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


def findings(
    key: AnswerKey, part: Part, wanted: Wanted, value: Any, right: Any
) -> Iterator[Finding]:
    """Sentences for a readable but wrong answer: what the exercise knows, then what may happen to any answer."""
    for sentence, mistaken in key.mistaken(part, wanted):
        if compare(key, part, mistaken, value).all_right:
            yield Finding(sentence)
            return
    known = presentation(key, part, wanted, value)
    if known:
        yield Finding(known.sentence)
        return
    found = marker_of(part.answer).found
    yield from map(Finding, found(_asked(key, part, wanted), value, right))
