"""An answer judged in full: compared, then by the part's own check where it has one."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...exercises.exercise import Part
from ..kinds.marker import Comparison, Wanted
from ..kinds.markers import marker_of
from .answer_key import AnswerKey
from .compare import compare, shared


def judged(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Comparison:
    """A readable answer against what is wanted."""
    found = compare(key, part, wanted, value)
    if part.check:
        outcome = part.check(key.v, wanted.given, value)
        found = _checked(key, part, wanted, value, found, outcome.right)
        said = [outcome.finding] if outcome.finding else []
        found = replace(found, findings=(*said, *found.findings), reading=outcome.reading)
        if outcome.share is not None:
            found = replace(found, share=outcome.share, settled=outcome.final)
    return found


def judges(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> bool:
    """Whether a part's own check says what is right, and not only what an answer is.

    Some say so of right answers alone, so that it is asked of one, too.
    """
    if part.check is None:
        return False
    for answer in (wanted.value, value):
        outcome = part.check(key.v, wanted.given, answer)
        if outcome.right is not None or outcome.share is not None:
            return True
    return False


def _checked(
    key: AnswerKey, part: Part, wanted: Wanted, value: Any, found: Comparison, right: Any
) -> Comparison:
    """What is right by the part's own check; where it leaves that open, by the comparison."""
    checked = marker_of(part.answer).checked
    if checked and right is not None:
        return checked(part.answer, key.v, wanted, value, right)
    if right is None:
        return found if checked else replace(found, findings=())
    mask = np.broadcast_to(np.asarray(right, dtype=bool), np.shape(found.right))
    share = float(mask.all()) if part.credit == "all" else shared(key, part, mask)
    return Comparison(mask, share)
