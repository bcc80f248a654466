"""What explains a wrong answer: known mistakes, presentations, printed numbers taken otherwise."""

from collections.abc import Collection, Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Part, Rows
from ..diagnosis.explain import Alternatives
from ..kinds.allowed import Allowed
from ..kinds.marker import Asked, Named, Presentation, Wanted
from ..kinds.markers import marker_of
from .answer_key import AnswerKey
from .arm_mistakes import Answered, one_mistake, two_mistakes
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


def named(
    key: AnswerKey,
    part: Part,
    wanted: Wanted,
    value: Any,
    right: Any,
    suspected: Iterable[Collection[str]] = (),
) -> Iterator[Named]:
    """What explains a readable but wrong answer, the most telling first.

    First what the exercise knows, then what may happen to any finished answer, to any arm, and to
    the printed numbers. `suspected` are the known mistakes of any arm that explained other answers
    of the same student.
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
    is_personal = marker.priced(part.answer, value)
    known = key.of_arm(part, wanted) if is_personal else None
    if known:
        of_arm = one_mistake(known, seen(key, part, wanted, value), found, suspected)
        found = [of_arm] if of_arm else found
    if found:
        yield from found
        return
    if is_personal:
        yield from _misread(key, part, wanted, value, known)


def _misread(
    key: AnswerKey, part: Part, wanted: Wanted, value: Any, known: Alternatives | None
) -> Iterator[Named]:
    """Printed numbers taken otherwise; if there are none, two mistakes at once."""
    fits = False
    for mistake, mistaken in key.misread(part, wanted):
        if compare(key, part, mistaken, value).all_right:
            fits = True
            yield mistake
    if known and not fits:
        yield from two_mistakes(known, seen(key, part, wanted, value))


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


def seen(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Answered:
    """An answer as numbers, with how far each may be off."""
    arrays = marker_of(part.answer).arrays(_asked(key, part, wanted), value)
    return Answered(part.answer, arrays)


def _asked(key: AnswerKey, part: Part, wanted: Wanted) -> Asked:
    return Asked(part.answer, key.v, wanted, lambda: key.in_degrees.get(part.variable))


def _agree(value: Array, seen: Array | None, allowed: Allowed) -> bool:
    if seen is None or seen.shape != value.shape:
        return False
    return allowed.holds_everywhere(np.abs(value - seen))
