"""How much goes into an answer: the numbers that it would be computed from by hand."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Part, solve
from ..marking.answer_key import AnswerKey
from .look import Look
from .numbers import LARGE, number_parts

DUST = 1e-9  # what is less is an error of binary fractions


def work(look: Look) -> dict[str, int]:
    """For every part of numbers, how many printed numbers and earlier entries move it."""
    counts: dict[str, int] = {}
    for part in number_parts(look.exercise):
        printed = sum(part.variable in parts for parts in look.uses.values())
        earlier = sum(_moving_entries(look.key, part, name) for name in part.needs)
        counts[part.variable] = printed + earlier
    return counts


def _moving_entries(key: AnswerKey, part: Part, name: str) -> int:
    """How many entries of an earlier answer of numbers move a part."""
    value: Any = key.reference[name]
    if not isinstance(value, np.ndarray):
        return 0
    count = 0
    for changed in _each_changed(np.asarray(value, dtype=np.float64)):
        given = {need: key.reference[need] for need in part.needs}
        count += _moves(key, part, {**given, name: changed})
    return count


def _each_changed(array: NDArray[np.float64]) -> Iterator[NDArray[np.float64]]:
    for place in np.ndindex(array.shape):
        changed = array.copy()
        changed[place] += LARGE
        yield changed


def _moves(key: AnswerKey, part: Part, given: dict[str, Any]) -> bool:
    try:
        with np.errstate(all="ignore"):
            value = solve(key.exercise.slug, part, key.v, given)
    except Exception:  # noqa: BLE001 - an exercise may refuse such numbers in any way: they matter
        return True
    return not np.allclose(value, key.reference[part.variable], rtol=0, atol=DUST)
