"""Whether own numbers vouch for what follows in letters from an own mistake.

Letters are the same for everybody who errs alike, so that they can be handed on: what follows in
them earns `follow` of the points. Whoever has carried the same mistake through numbers drawn for
them alone has worked with it, and keeps all.
"""

from collections.abc import Collection, Iterator, Mapping

import numpy as np

from ...exercises.exercise import Exercise, Numbers, Part
from .follow import TELLING, different_numbers
from .verdict import Verdict


def is_vouched(
    exercise: Exercise, part: Part, verdicts: Mapping[str, Verdict], named: Collection[str]
) -> bool:
    """Whether every mistake behind a part has a name, and own numbers that follow from it.

    `verdicts` are those of earlier parts, `named` the ones among them whose mistake has a name. A
    part of numbers is never vouched for: its `follow` says how much work is left.
    """
    if isinstance(part.answer, Numbers):
        return False
    mistakes = {*_mistakes(exercise, part, verdicts)}
    if not mistakes or not mistakes <= {*named}:
        return False
    return all(_carried_on(exercise, mistake, verdicts) for mistake in mistakes)


def _mistakes(exercise: Exercise, part: Part, verdicts: Mapping[str, Verdict]) -> Iterator[str]:
    """The wrong own answers that a part goes back to; what follows from another is none itself."""
    parts = {one.variable: one for one in exercise.parts}
    for need in part.needs:
        status = verdicts[need].status if need in verdicts else "missing"
        if status == "follows":
            yield from _mistakes(exercise, parts[need], verdicts)
        elif status != "correct":
            yield need


def _carried_on(exercise: Exercise, mistake: str, verdicts: Mapping[str, Verdict]) -> bool:
    """Whether enough personal numbers follow from a mistake."""
    for part in exercise.asked:
        verdict = verdicts.get(part.variable)
        if verdict is None or verdict.status != "follows" or mistake not in part.needs:
            continue
        if isinstance(part.answer, Numbers) and _tells(verdict):
            return True
    return False


def _tells(verdict: Verdict) -> bool:
    return different_numbers(np.asarray(verdict.answer, dtype=float)) >= TELLING
