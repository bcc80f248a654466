"""Numbers that a sheet does not print, as a choice of form: what hangs on them is not checked."""

from typing import Any

import numpy as np

from ...exercises.exercise import Exercise, Function, references
from ..variants.drawn import drawn

SAMPLES = 12  # draws that show which answers hang on numbers that the sheet does not print


def with_samples(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    """The sheet's numbers; for those that the instructor keeps, what some draw gives instead."""
    if not exercise.hidden:
        return v
    sample = drawn(exercise, np.random.default_rng(0))
    numbers: dict[str, Any] = {}
    for name in exercise.hidden:
        if name in sample:
            numbers[name] = sample[name]
    return numbers | v


def unseen_parts(exercise: Exercise, v: dict[str, Any]) -> set[str]:
    """Parts whose right answer hangs on numbers that the sheet does not print.

    What a function returns does not: only what it is called with.
    """
    missing = [name for name in exercise.hidden if name not in v]
    if not missing:
        return set()
    seen: dict[str, set[str]] = {part.variable: set() for part in exercise.asked}
    for seed in range(SAMPLES):
        sample = drawn(exercise, np.random.default_rng(seed))
        numbers = v | {name: sample[name] for name in missing if name in sample}
        answers = references(exercise, numbers)
        for part in exercise.asked:
            if not isinstance(part.answer, Function):
                seen[part.variable].add(repr(answers[part.variable]))
    return {variable for variable, answers in seen.items() if len(answers) > 1}
