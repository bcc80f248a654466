"""When may an answer be judged from the student's own earlier answers? Not from copied, guessed or easier data."""

from collections.abc import Mapping
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Numbers, Part
from ...solutions.expression_array import ExpressionArray, sample

Others = Mapping[str, Mapping[str, Any]]
"""Student to the recorded reference answers of that student's variant of the same exercise."""
SAME = 2e-3  # two answers this close in every entry were not computed from different numbers
TELLING = 5  # different numbers that an answer takes to tell whose it is: a joint axis alone is shared by many
MOST_ZEROS = 0.25


def is_trivial(reference: Any, own: Any) -> bool:
    """Whether own numbers or formulas are easier than the reference: less than half as many, or half the rank."""
    if isinstance(own, ExpressionArray):
        values = sample(sorted(own.names | reference.names), 1)
        own, reference = (
            np.asarray(array.at(values)).reshape(array.shape) for array in (own, reference)
        )
    if not isinstance(own, np.ndarray):
        return False
    own = cast("NDArray[np.float64]", own)
    if own.ndim == 2 and 2 * np.linalg.matrix_rank(own, 1e-6) <= np.linalg.matrix_rank(
        reference, 1e-6
    ):
        return True
    return 2 * _different_numbers(own) < _different_numbers(reference)


def zeros_pass(
    wanted: NDArray[np.float64], allowed: NDArray[np.float64], earning: NDArray[np.bool_]
) -> bool:
    """Whether a matrix of zeros would agree with many of the entries that carry points."""
    return bool((np.abs(wanted) <= allowed)[earning].mean() > MOST_ZEROS)


def owner_of(part: Part, answer: Any, others: Others) -> str:
    """The student whose variant an answer of numbers is right for; empty when there is none, or it cannot tell."""
    if not isinstance(part.answer, Numbers) or _different_numbers(answer) < TELLING:
        return ""
    for student, answers in others.items():
        theirs = np.asarray(answers.get(part.variable, np.nan), dtype=float)
        if theirs.shape == answer.shape and np.abs(theirs - answer).max() <= SAME:
            return student
    return ""


def _different_numbers(array: Any) -> int:
    sizes = np.unique(np.round(np.abs(np.asarray(array, dtype=np.float64)), 4))
    return int(((sizes != 0) & (sizes != 1)).sum())
