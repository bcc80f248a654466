"""One exercise of one student: readable, right from the reference, or right from the student's own earlier answers."""

import logging
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...exercises.answers import Manual, Numbers
from ...exercises.exercise import Exercise, Part, Variant
from ..collecting.wire import Raw
from ..kinds.marker import Comparison, Wanted
from ..kinds.markers import marker_of, read
from ..reading.unreadable import UNANSWERED, Unreadable
from .answer_key import AnswerKey
from .findings import findings
from .follow import Others, is_trivial, owner_of, zeros_pass
from .judge import judged
from .verdict import Finding, Verdict, not_graded

MOST_TEXT = 400  # of a sentence that repeats what a student's process said
LEAST_FOLLOWED = (
    0.5  # of the points: less is right by chance, and what is computed from it is no achievement
)
UNASKED = "Your answer is kept; the exercise cannot call a function yet: "
BY_HAND = "It is marked by hand."
OUR_FAILURE = "The grader failed on this part; your answer is kept."
log = logging.getLogger(__name__)


@dataclass(frozen=True)
class _Sheet:
    """What marking one exercise of one student refers to: the key and the answers that could be read."""

    key: AnswerKey
    answers: dict[str, Any]
    verdicts: dict[str, Verdict]
    unfollowed: set[str]


def mark(
    exercise: Exercise,
    v: Variant,
    raws: Mapping[str, Raw],
    others: Others | None = None,
    key: AnswerKey | None = None,
) -> list[Verdict]:
    """A verdict for every asked part. A failure of ours in one part leaves that part `not_graded` and no other.

    Nothing follows from a wrong answer that is the right one of somebody in `others`. A `key` that was made for the
    same variant saves making it again.
    """
    sheet = _Sheet(key or AnswerKey(exercise, v), {}, {}, set())
    for part in exercise.asked:
        raw = raws.get(part.variable, Raw("missing"))
        if isinstance(part.answer, Manual):
            sheet.verdicts[part.variable] = _by_hand(part, raw, v)
            continue
        sheet.verdicts[part.variable] = _mark_raw(sheet, part, raw, others or {})
    return [
        _with_note(verdict, raws.get(name, Raw("missing")))
        for name, verdict in sheet.verdicts.items()
    ]


def mark_part(key: AnswerKey, part: Part, raw: Raw) -> Verdict:
    """The verdict of one part by itself: nothing follows from other answers."""
    return _mark_raw(_Sheet(key, {}, {}, set()), part, raw, {})


def _mark_raw(sheet: _Sheet, part: Part, raw: Raw, others: Others) -> Verdict:
    if raw.kind == "unasked":
        return not_graded(part.variable, part.points, f"{UNASKED}{raw.value}.")
    answer, unjudged = _read(part, raw, sheet.key.v)
    if unjudged:
        return unjudged
    verdict = _mark_readable(sheet, part, answer, others)
    sheet.answers[part.variable] = answer
    reading = " ".join(
        filter(None, (marker_of(part.answer).read_as(part.answer, raw, answer), verdict.reading))
    )
    return replace(verdict, reading=reading)


def _mark_readable(sheet: _Sheet, part: Part, answer: Any, others: Others) -> Verdict:
    try:
        verdict = _verdict(sheet, part, answer)
    except Exception:
        log.exception("%s could not be marked", part.variable)
        verdict = not_graded(part.variable, part.points, OUR_FAILURE)
    if verdict.status != "correct" and (owner := owner_of(part, answer, others)):
        sheet.unfollowed.add(part.variable)
        found = Finding(f"This is the reference answer of {owner}'s variant.", private=True)
        verdict = replace(verdict, findings=(*verdict.findings, found))
    return verdict


def _by_hand(part: Part, raw: Raw, v: Variant) -> Verdict:
    """What waits for the marker, with the text to be marked; nothing in the file is worth nothing, unless on paper."""
    assert isinstance(part.answer, Manual)  # noqa: S101 - asked by the caller
    if part.answer.on_paper:
        return not_graded(part.variable, part.points, BY_HAND)
    text, unjudged = _read(part, raw, v)
    return unjudged or replace(not_graded(part.variable, part.points, BY_HAND), answer=text)


def _read(part: Part, raw: Raw, v: Variant) -> tuple[Any, Verdict | None]:
    """The answer, or the verdict of one that was not read, be it the student's fault or ours."""
    try:
        return read(part.answer, raw, v), None
    except Unreadable as error:
        return None, _unreadable(part, raw, str(error))
    except Exception:
        log.exception("%s could not be marked", part.variable)
        return None, not_graded(part.variable, part.points, OUR_FAILURE)


def _with_note(verdict: Verdict, raw: Raw) -> Verdict:
    """The verdict, with how the cell ended that left the value behind."""
    if not raw.note or verdict.status not in ("correct", "incorrect", "partly"):
        return verdict
    return replace(
        verdict, findings=(*verdict.findings, Finding(f"In your file: {raw.note[:MOST_TEXT]}."))
    )


def _unreadable(part: Part, raw: Raw, sentence: str) -> Verdict:
    if sentence == UNANSWERED:
        return Verdict(part.variable, "missing", 0.0, part.points)
    if sentence.startswith(UNANSWERED):  # a function as it was handed out
        return Verdict(
            part.variable, "missing", 0.0, part.points, (Finding("The function returns nothing."),)
        )
    said, *typed = sentence[:MOST_TEXT].split("\n")
    stop = "" if said.endswith(("?", ".")) else "."
    said = (
        f"In your file: {said}{stop}"
        if raw.kind == "error"
        else f"{said[:1].upper()}{said[1:]}{stop}"
    )
    text = "\n".join([said, *typed])
    return Verdict(part.variable, "failed", 0.0, part.points, (Finding(text),))


def _verdict(sheet: _Sheet, part: Part, answer: Any) -> Verdict:
    wanted = sheet.key.wanted(part)
    found = judged(sheet.key, part, wanted, answer)
    verdict = _written(part, found, answer)
    if verdict.status == "correct":
        return verdict
    named = tuple(findings(sheet.key, part, wanted, answer, found.right))
    if not named and found.share < LEAST_FOLLOWED:
        sheet.unfollowed.add(part.variable)
    followed = _follow(sheet, part, answer)
    if followed and (followed.points or 0) > (verdict.points or 0):
        sheet.unfollowed.discard(part.variable)
        return followed
    return replace(verdict, findings=(*verdict.findings, *(() if found.reading else named)))


def _written(part: Part, found: Comparison, answer: Any) -> Verdict:
    status = "correct" if found.all_right else "partly" if found.share > 0 else "incorrect"
    noted = tuple(map(Finding, found.findings)) if status != "correct" else ()
    right: Any = found.right.tolist() if hasattr(found.right, "tolist") else found.right
    points = round(part.points * found.share, 2)
    return Verdict(
        part.variable,
        status,
        points,
        part.points,
        noted,
        found.reading,
        right,
        marker_of(part.answer).shown(answer),
    )


def _follow(sheet: _Sheet, part: Part, answer: Any) -> Verdict | None:
    """The verdict against what follows from the student's own earlier answers; None where nothing follows.

    Answers that were accepted though they differ from the reference keep the full share; wrong ones earn `follow`.
    """
    key = sheet.key
    own = [name for name in part.needs if name in sheet.answers]
    if not own or part.follow == 0 or sheet.unfollowed & set(own):
        return None
    given = {name: sheet.answers.get(name, key.reference[name]) for name in part.needs}
    try:
        with np.errstate(all="ignore"):
            wanted = key.following(part, given)
            if _is_easier(key, part, wanted):
                return None
            found = judged(key, part, wanted, answer)
            if found.share < LEAST_FOLLOWED:
                return None
            verdict = _written(part, found, answer)
    except Exception:  # noqa: BLE001 - solve() on a student's data may fail in any way; then nothing follows from it
        return None
    wrong = " and ".join(name for name in own if sheet.verdicts[name].status != "correct")
    if not wrong:
        return verdict
    all_right = verdict.status == "correct"
    noted = Finding(
        f"{'It follows' if all_right else 'The entries marked right follow'} from your own {wrong}."
    )
    status = "partly" if all_right and part.follow < 1 else verdict.status
    points = round((verdict.points or 0.0) * part.follow, 2)
    return replace(verdict, status=status, points=points, findings=(*verdict.findings, noted))


def _is_easier(key: AnswerKey, part: Part, wanted: Wanted) -> bool:
    """Whether the student's own data made the part easier than it is."""
    values = {**wanted.given, part.variable: wanted.value}
    if any(is_trivial(key.reference[name], value) for name, value in values.items()):
        return True
    if not isinstance(part.answer, Numbers):
        return False
    return zeros_pass(wanted.value, wanted.allowed, key.earning(part))
