"""When may an answer be judged from own earlier ones? Not from copied, made-up, easier data."""

from collections.abc import Callable, Mapping
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Variant
from ...exercises.exercise import Exercise, Numbers, Part
from ...solutions.expression_array import ExpressionArray, sample
from ..kinds.allowed import Allowed

Others = Mapping[str, Mapping[str, Any]]
"""Student to the recorded reference answers of that student's variant of the same exercise."""
Peers = Mapping[str, Mapping[str, Any]]
"""Student to what that student handed in for the same exercise, as nested lists."""
SAME = 2e-3  # two answers this close in every entry were not computed from different numbers
TELLING = 5  # different numbers that tell whose an answer is: many share a joint axis
HANDED_IN_TOO = "handed in the same numbers."
NEAR = 0.01  # of a number: as near as rounded numbers are to each other
ROUNDED = 6e-4  # between numbers with three decimals that are the same
RELATED = 0.25  # of an answer's numbers: by chance fewer are among those of the reference
PAIR = 2  # a sine comes with its cosine, so that two of many agree as easily as one
MANY = 8  # different numbers
MOST_ZEROS = 0.25


def is_trivial(reference: Any, own: Any) -> bool:
    """Whether own numbers or formulas are easier than the reference.

    That is less than half as many different ones, or half the rank or less.
    """
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
    return 2 * different_numbers(own) < different_numbers(reference)


def zeros_pass(
    wanted: NDArray[np.float64], allowed: Allowed, earning: Callable[[], NDArray[np.bool_]]
) -> bool:
    """Whether a matrix of zeros would agree with many of the entries that carry points.

    Which do is asked only where some would.
    """
    zeros = allowed.holds(np.abs(wanted))
    return bool(zeros.any() and zeros[earning()].mean() > MOST_ZEROS)


def owner_of(part: Part, answer: Any, others: Others) -> str:
    """The student whose variant an answer is right for; empty when none, or it cannot tell."""
    if not isinstance(part.answer, Numbers) or different_numbers(answer) < TELLING:
        return ""
    for student, answers in others.items():
        theirs = np.asarray(answers.get(part.variable, np.nan), dtype=float)
        if theirs.shape == answer.shape and np.abs(theirs - answer).max() <= SAME:
            return student
    return ""


def shared_with(part: Part, answer: Any, reference: Any, peers: Peers) -> str:
    """A student who handed in the same wrong numbers; empty where there is none, or it cannot tell.

    Every student has other numbers, so equal wrong ones were not computed twice. Whoever has many
    that are right, too, computed them: the other one took them.
    """
    if not isinstance(part.answer, Numbers):
        return ""
    wrong = np.abs(answer - reference) > SAME
    if different_numbers(np.where(wrong, answer, 0.0)) < TELLING or is_own(answer, ~wrong):
        return ""
    for student, answers in peers.items():
        theirs = _array(answers.get(part.variable))
        if theirs is None or theirs.shape != answer.shape:
            continue
        if np.abs(theirs - answer)[wrong].max() <= SAME:
            return student
    return ""


def is_own(answer: Any, right: Any) -> bool:
    """Whether enough numbers of an answer are right to tell that its student computed them."""
    return different_numbers(np.where(right, answer, 0.0)) >= TELLING


def _array(value: Any) -> NDArray[np.float64] | None:
    """What was handed in as an array; None where it is none."""
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        return None


def is_unrelated(part: Part, reference: Any, answer: Any) -> bool:
    """Whether hardly any number of an answer is one of the reference, whatever its sign and place.

    An honest mistake leaves some numbers of one's own arm; numbers that are made up have none.
    """
    if not isinstance(part.answer, Numbers):
        return False
    own, wanted = _sizes(answer), _sizes(reference)
    if not len(own) or not len(wanted):
        return False
    is_filled = np.size(answer) > 1 and np.ptp(np.abs(answer)) == 0
    if len(own) < 2 and not is_filled:  # a single number says little of where it is from
        return False
    apart = np.abs(own[:, None] - wanted).min(axis=1)
    close = np.minimum(ROUNDED, NEAR * own)
    near = apart <= close
    by_chance = PAIR if len(own) >= MANY else 0
    return bool(near.mean() < RELATED or near.sum() <= by_chance)


def is_printed(exercise: Exercise, v: Variant, answer: Any) -> bool:
    """Whether an answer of numbers is an array that the sheet prints, as it is or transposed."""
    if not isinstance(answer, np.ndarray):
        return False
    answer = cast("NDArray[np.float64]", answer)
    if different_numbers(answer) < TELLING:
        return False
    for name in exercise.units:
        printed = _array(v.get(name))
        if printed is None:
            continue
        for copied in (printed, printed.T):
            if copied.shape == answer.shape and np.abs(copied - answer).max() <= SAME:
                return True
    return False


def _sizes(array: Any) -> NDArray[np.float64]:
    """The sizes of an array's numbers, without those that are common to everybody."""
    with np.errstate(over="ignore"):  # some hand in numbers at the end of all floats
        rounded = np.round(np.abs(np.asarray(array, dtype=np.float64)), 4)
    sizes = {*np.asarray(rounded, dtype=np.float64).ravel().tolist()} - {0.0, 1.0}
    return np.array(sorted(sizes))


def different_numbers(array: Any) -> int:
    """How many numbers of an array differ in size, 0 and 1 not counted."""
    return len(_sizes(array))
