"""Tolerances from the asked decimals: how far rounding what a part needs can move its answer."""

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Exercise, Given, Numbers, Part, Variant, solve
from ..kinds.allowed import Allowed, exactly

DRAWS = 64
CAP = 0.02  # of the block's scale; beyond it, zero would pass for small entries
FLOOR = 1e-9


def tolerance(
    exercise: Exercise, part: Part, v: Variant, given: Given, reference: NDArray[np.float64]
) -> Allowed:
    """Allowed absolute error of every entry of numbers, in the entry's own unit.

    The worst change of the answer over 64 roundings of what the part needs, times 1.5, plus a unit
    of the last asked decimal, so that cutting off is as good as rounding; at least 1e-9 of the
    block's scale, at most 0.02 of it. The roundings are only solved where an answer lies between
    what is allowed without and what is never allowed. `reference` follows from `given`.
    """
    answer = part.answer
    if not isinstance(answer, Numbers):
        raise TypeError(
            f"{part.variable}: a tolerance is for numbers, not for {type(answer).__name__}"
        )
    factor = part.tolerance_factor
    if part.tolerance is not None:
        return exactly(np.full(reference.shape, factor * part.tolerance))
    block = block_scale(answer, reference, exercise.scale(v))
    unit = 10.0**-answer.decimals

    def computed(worst: NDArray[np.float64] | float) -> NDArray[np.float64]:
        # A value cut off at the asked decimals is off by a unit and an error of binary fractions.
        return factor * np.clip(1.5 * worst + 1.001 * unit, FLOOR * block, CAP * block)

    if not _roundings(exercise, part, given):
        return exactly(computed(0.0))
    return Allowed(
        computed(0.0),
        factor * CAP * block,
        lambda: computed(_spread(exercise, part, v, given, reference)),
    )


def _spread(
    exercise: Exercise, part: Part, v: Variant, given: Given, reference: NDArray[np.float64]
) -> NDArray[np.float64]:
    worst = np.zeros(reference.shape)
    steps = _roundings(exercise, part, given)
    rng = np.random.default_rng(0)
    for _ in range(DRAWS):
        rounded = {
            name: given[name] + rng.uniform(-h, h, np.shape(given[name]))
            for name, h in steps.items()
        }
        worst = np.maximum(
            worst, np.abs(solve(exercise.slug, part, v, {**given, **rounded}) - reference)
        )
    return worst


def _roundings(exercise: Exercise, part: Part, given: Given) -> dict[str, float]:
    """Half a unit of the last decimal of each needed array, or of this part where it has fewer."""
    assert isinstance(part.answer, Numbers)  # noqa: S101 - a tolerance is for numbers
    own = part.answer.decimals
    asked = {
        other.variable: other.answer.decimals
        for other in exercise.parts
        if isinstance(other.answer, Numbers)
    }
    arrays = (name for name, value in given.items() if isinstance(value, np.ndarray))
    return {name: 0.5 * 10.0 ** -min(asked.get(name, own), own) for name in arrays}


def block_scale(
    answer: Numbers, reference: NDArray[np.float64], length: float
) -> NDArray[np.float64]:
    """What an entry is large against: a length [m] in linear rows, 1 in angular ones, its block."""
    units = answer.unit_of_entries()
    block = np.ones(reference.shape)
    for unit in {*units.ravel().tolist()}:
        mine = units == unit
        if unit in ("m", "m/rad"):
            block[mine] = length
        elif unit not in ("1", "rad"):
            block[mine] = max(float(np.abs(reference[mine]).max()), 1e-3)
    return block
