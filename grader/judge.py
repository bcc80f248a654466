"""An answer judged in full: compared, then by the part's own check where it has one."""

from typing import Any

import numpy as np

from ..exercises.exercise import Function, Outcome, Part
from .answer_key import AnswerKey, Wanted
from .calls import accepted, failed_calls, groups_of
from .calls import share as share_of_groups
from .compare import Comparison, compare, shared
from .findings import presentation


def judged(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Comparison:
    """A readable answer against what is wanted; a presentation that earns nothing by chance has no share."""
    found = compare(key, part, wanted, value)
    right, share, findings, reading = found.right, found.share, found.findings, found.reading
    if part.check:
        outcome = part.check(key.v, wanted.given, value)
        right, share, why = _checked(key, part, wanted, value, found, outcome)
        share = share if outcome.share is None else outcome.share
        reading, findings = outcome.reading, (*filter(None, [outcome.finding]), *why)
    if 0 < share < 1:
        known = presentation(key, part, wanted, value)
        share = 0.0 if known and known.worthless else share
    return Comparison(right, share, findings, reading)


def _checked(
    key: AnswerKey, part: Part, wanted: Wanted, value: Any, found: Comparison, outcome: Outcome
) -> tuple[Any, float, list[str]]:
    """What is right by the check, the share that earns, and why calls of a function gave nothing to judge."""
    if isinstance(part.answer, Function):
        groups = groups_of(part.answer, key.v, wanted.value, value)
        if outcome.right is None:
            return found.right, found.share, [*found.findings]
        right = accepted(groups, outcome.right)
        return right, share_of_groups(groups, right), failed_calls(groups)
    if outcome.right is None:
        return found.right, found.share, []
    right = np.broadcast_to(np.asarray(outcome.right, dtype=bool), np.shape(found.right))
    share = float(right.all()) if part.credit == "all" else shared(key, part, right)
    return right, share, []
