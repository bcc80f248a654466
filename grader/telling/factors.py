"""Factors of a determinant that are nearly zero where the exercise does not mean it."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Exercise
from .look import Look
from .siblings import STRANGERS, pool, siblings

NEAR = 0.1  # of a factor's usual size: less is nearly zero


def too_many_near_zero(look: Look) -> bool:
    """Whether more factors are nearly zero than in most draws of the same structure.

    So an exercise may draw singular postures, or a family of nearly singular ones; a second factor
    that is nearly zero by chance is found.
    """
    own = near_zero(look)
    if not own:
        return False
    others = [near_zero(other) for other in siblings(look)]
    return own > float(np.median(others))


def near_zero(look: Look) -> int:
    """How many factors of the determinant are nearly zero."""
    sizes = _sizes(look)
    if not len(sizes):
        return 0
    return int((sizes < NEAR * _usual(look.exercise, len(sizes))).sum())


def _sizes(look: Look) -> NDArray[np.float64]:
    if look.exercise.factors is None:
        return np.zeros(0)
    return np.abs(np.asarray(look.exercise.factors(look.v), dtype=np.float64))


@lru_cache(maxsize=64)
def _usual(exercise: Exercise, count: int) -> NDArray[np.float64]:
    """The median of each factor's size over some draws, of those with so many factors."""
    drawn: list[NDArray[np.float64]] = []
    for place in range(STRANGERS):
        sizes = _sizes(pool(exercise).at(place))
        if len(sizes) == count:
            drawn.append(sizes)
    if not drawn:
        return np.zeros(count)
    return np.asarray(np.median(drawn, axis=0))
