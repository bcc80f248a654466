"""An answer judged in full: compared, then by the part's own check where it has one."""

from typing import Any

import numpy as np

from ..exercises.exercise import Part
from .answer_key import AnswerKey, Wanted
from .compare import Comparison, compare, shared
from .findings import presentation


def judged(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Comparison:
    """A readable answer against what is wanted; a presentation that earns nothing by chance has no share."""
    found = compare(key, part, wanted, value)
    right, share, findings, reading = found.right, found.share, found.findings, found.reading
    if part.check:
        outcome = part.check(key.v, wanted.given, value)
        if outcome.right is not None:
            right = np.broadcast_to(np.asarray(outcome.right, dtype=bool), np.shape(right))
            share = float(right.all()) if part.credit == "all" else shared(key, part, right)
        share = share if outcome.share is None else outcome.share
        reading, findings = outcome.reading, (outcome.finding,) if outcome.finding else ()
    if 0 < share < 1:
        known = presentation(key, part, wanted, value)
        share = 0.0 if known and known.worthless else share
    return Comparison(right, share, findings, reading)
