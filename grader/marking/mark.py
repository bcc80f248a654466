"""One exercise of one student: right, right from own answers, or wrong with a name."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ...exercises.answers import Manual
from ...exercises.exercise import Exercise, Part, Variant
from ..collecting.wire import Raw
from ..kinds.marker import Wanted
from ..kinds.markers import marker_of, raw_of
from ..reading.unreadable import Unreadable
from .answer_key import AnswerKey
from .follow import HANDED_IN_TOO, Others, Peers, owner_of, shared_with
from .following import following
from .marked import Marked
from .price import Bill
from .priced import Priced, charge, is_better, is_made_up, priced, written
from .unjudged import MOST_TEXT, answer_of, by_hand, interrupted, our_failure, unasked, unreadable
from .verdict import COMPARED, ENTRIES_FOLLOW, FOLLOWS, NOTHING_FOLLOWS, Finding, Verdict
from .vouched import is_vouched

OF_ANOTHER = "it is right for another student's numbers"
SHARED = "another student has the same numbers, and yours are drawn for you alone"
UNRELATED = "hardly any of its numbers comes out of yours"


def mark(
    exercise: Exercise,
    v: Variant,
    raws: Mapping[str, Raw],
    others: Others | None = None,
    key: AnswerKey | None = None,
    *,
    peers: Peers | None = None,
    bill: Bill | None = None,
) -> list[Verdict]:
    """A verdict for every asked part. A failure of ours leaves that part `not_graded` and no other.

    Nothing follows from a wrong answer that is the right one of somebody in `others`, or that
    somebody in `peers` handed in, too. A `key` that was made for the same variant saves making it
    again. A `bill` that goes on from exercise to exercise charges a mistake once a sheet.
    """
    sheet = Marked(key or AnswerKey(exercise, v), bill or Bill(), others or {}, peers or {})
    mark_all(sheet, raws)
    return [
        _with_note(verdict, raws.get(name, Raw("missing")))
        for name, verdict in sheet.verdicts.items()
    ]


def mark_all(sheet: Marked, raws: Mapping[str, Raw]) -> None:
    """Marks every asked part, in order, since later ones follow from earlier ones."""
    for part in sheet.key.exercise.asked:
        raw = raw_of(part, raws)
        if raw.kind == "interrupted" and not getattr(part.answer, "on_paper", False):
            verdict = interrupted(part, raw)
        elif isinstance(part.answer, Manual):
            verdict = by_hand(part, raw, sheet.key.v)
        else:
            verdict = _mark_raw(sheet, part, raw)
        sheet.verdicts[part.variable] = verdict


def mark_part(key: AnswerKey, part: Part, raw: Raw) -> Verdict:
    """The verdict of one part by itself: nothing follows from other answers."""
    return _mark_raw(Marked(key), part, raw)


@np.errstate(all="ignore")  # some hand in numbers at the end of all floats
def _mark_raw(sheet: Marked, part: Part, raw: Raw) -> Verdict:
    if raw.kind == "unasked":
        return unasked(part, raw)
    answer, unjudged = answer_of(part, raw, sheet.key.v)
    if unjudged:
        return unjudged
    try:
        verdict = _mark_readable(sheet, part, answer)
    except Unreadable as error:  # what can be read may still be too much to be compared
        return unreadable(part, raw, str(error))
    sheet.own.answers[part.variable] = answer
    read_as = marker_of(part.answer).read_as(part.answer, raw, answer)
    return replace(verdict, reading=" ".join(filter(None, (read_as, verdict.reading))))


def _mark_readable(sheet: Marked, part: Part, answer: Any) -> Verdict:
    """The verdict of an answer that was read, with a note for the instructor on whose it may be."""
    try:
        verdict = _verdict(sheet, part, answer)
    except Unreadable:
        raise
    except Exception as error:  # noqa: BLE001 - it is logged
        verdict = our_failure(part, error)
    if verdict.status == "correct":
        return verdict
    owner = owner_of(part, answer, sheet.others)
    if owner:
        sheet.own.unfollowed[part.variable] = OF_ANOTHER
        return _with_finding(
            verdict, f"This is the reference answer of {owner}'s variant.", private=True
        )
    peer = shared_with(part, answer, sheet.key.reference[part.variable], sheet.peers)
    if peer:
        sheet.own.unfollowed[part.variable] = SHARED
        return _with_finding(verdict, f"{peer} {HANDED_IN_TOO}", private=True)
    return verdict


def _with_finding(verdict: Verdict, text: str, *, private: bool = False) -> Verdict:
    return replace(verdict, findings=(*verdict.findings, Finding(text, private)))


def _with_note(verdict: Verdict, raw: Raw) -> Verdict:
    """The verdict, with how the cell ended that left the value behind."""
    if not raw.note or verdict.status not in ("correct", "incorrect", "partly", "follows"):
        return verdict
    return _with_finding(verdict, f"In your file: {raw.note[:MOST_TEXT]}.")


def _verdict(sheet: Marked, part: Part, answer: Any) -> Verdict:
    """The better of two: against the reference, and against what follows from own answers."""
    key = sheet.key
    own = priced(sheet, part, key.wanted(part), answer)
    if own.found.all_right:
        return written(part, own, answer, "correct")
    follows = following(key, part, sheet.own, sheet.wrong_before(part))
    if follows.wanted is not None:
        followed = _followed(sheet, part, follows.wanted, answer)
        follow = _follow(sheet, part)
        if followed is not None and is_better(follow, followed, own):
            charge(sheet, part, followed)
            if is_made_up(part, followed, answer, follows.wanted.value):
                sheet.own.unfollowed[part.variable] = UNRELATED
            return _written_following(sheet, part, followed, answer, follow)
    if is_made_up(part, own, answer, key.reference[part.variable]):
        sheet.own.unfollowed[part.variable] = UNRELATED
    charge(sheet, part, own)
    if own.names and own.names[0].fault:
        sheet.named.add(part.variable)
    verdict = written(part, own, answer)
    if follows.why:
        return _with_finding(verdict, f"{NOTHING_FOLLOWS} {follows.why}.")
    return verdict


def _followed(sheet: Marked, part: Part, wanted: Wanted, answer: Any) -> Priced | None:
    try:
        return priced(sheet, part, wanted, answer)
    except Exception:  # noqa: BLE001 - so may a part's own check
        return None


def _follow(sheet: Marked, part: Part) -> float:
    """The share of the points for what follows: all, where own numbers vouch for it."""
    if is_vouched(sheet.key.exercise, part, sheet.verdicts, sheet.named):
        return 1.0
    return part.follow


def _written_following(
    sheet: Marked, part: Part, followed: Priced, answer: Any, follow: float
) -> Verdict:
    """The verdict of what follows from own answers.

    Answers that were accepted though they differ from the reference keep the full share; wrong ones
    earn `follow` of it.
    """
    wrong = sheet.wrong_before(part)
    all_right = followed.found.all_right
    if not wrong:
        return written(part, followed, answer, "correct" if all_right else None)
    status = "follows" if all_right and follow == 1 else None
    verdict = written(part, followed, answer, status, follow)
    says = COMPARED
    if all_right:
        says = FOLLOWS
    elif followed.found.share:
        says = ENTRIES_FOLLOW
    return _with_finding(verdict, f"{says} from your own {wrong}.")
