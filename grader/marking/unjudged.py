"""Verdicts of what is not judged: waits for a person, could not be read, or failed on our side."""

import logging
from dataclasses import replace
from typing import Any

from ...exercises.answers import Manual
from ...exercises.exercise import Part, Variant
from ..collecting.wire import Raw
from ..kinds.markers import read
from ..reading.unreadable import UNANSWERED, Unreadable
from .verdict import Finding, Status, Verdict, not_graded

MOST_TEXT = 400  # of a sentence that repeats what a student's process said
KEPT = "Your answer is kept"
UNASKED = "Your answer is kept; the exercise cannot call a function yet: "
BY_HAND = "It is marked by hand."
OUR_FAILURE = "The grader failed on this part; your answer is kept."
log = logging.getLogger(__name__)


def interrupted(part: Part, raw: Raw) -> Verdict:
    """Of what was stopped from outside, and will be tried again."""
    return not_graded(part.variable, part.points, f"{KEPT}: {raw.value}.")


def unasked(part: Part, raw: Raw) -> Verdict:
    """Of a function that could not be called."""
    return not_graded(part.variable, part.points, f"{UNASKED}{raw.value}.")


def our_failure(part: Part, error: Exception) -> Verdict:
    """Of a part on which the grader failed; the error is logged."""
    log.error("%s could not be marked", part.variable, exc_info=error)
    return not_graded(part.variable, part.points, OUR_FAILURE)


def by_hand(part: Part, raw: Raw, v: Variant) -> Verdict:
    """What waits for the marker, with the text; nothing is worth nothing, unless it is on paper."""
    assert isinstance(part.answer, Manual)  # noqa: S101 - asked by the caller
    if part.answer.on_paper:
        return not_graded(part.variable, part.points, BY_HAND)
    text, unjudged = answer_of(part, raw, v)
    return unjudged or replace(not_graded(part.variable, part.points, BY_HAND), answer=text)


def answer_of(part: Part, raw: Raw, v: Variant) -> tuple[Any, Verdict | None]:
    """The answer, or the verdict of one that was not read, be it the student's fault or ours."""
    try:
        return read(part.answer, raw, v), None
    except Unreadable as error:
        return None, unreadable(part, raw, str(error))
    except Exception as error:  # noqa: BLE001 - it is logged
        return None, our_failure(part, error)


def unreadable(part: Part, raw: Raw, sentence: str) -> Verdict:
    """Of what is no answer of the kind that is asked for; the sentence says why."""
    if sentence == UNANSWERED:
        hint = ""
        if raw.kind == "missing" and raw.value:
            hint = f"In your file: {raw.value}."
        return _earning_nothing(part, "missing", hint)
    if sentence.startswith(UNANSWERED):  # a function as it was handed out
        return _earning_nothing(part, "missing", "The function returns nothing.")

    said, *typed = sentence[:MOST_TEXT].split("\n")
    stop = "" if said.endswith(("?", ".")) else "."
    if raw.kind == "error":
        said = f"In your file: {said}{stop}"
    else:
        said = f"{said[:1].upper()}{said[1:]}{stop}"
    return _earning_nothing(part, "failed", "\n".join([said, *typed]))


def _earning_nothing(part: Part, status: Status, said: str) -> Verdict:
    findings = (Finding(said),) if said else ()
    return Verdict(part.variable, status, 0.0, part.points, findings)
