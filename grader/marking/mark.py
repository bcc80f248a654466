"""One exercise of one student: right, right from own answers, or wrong with a name."""

import logging
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...exercises.answers import Manual
from ...exercises.exercise import Exercise, Part, Variant
from ..collecting.wire import Raw
from ..kinds.marker import Comparison, Named, Wanted
from ..kinds.markers import marker_of, raw_of, read
from ..reading.unreadable import UNANSWERED, Unreadable
from .answer_key import AnswerKey
from .findings import named
from .follow import (
    HANDED_IN_TOO,
    Others,
    Peers,
    is_printed,
    is_unrelated,
    owner_of,
    shared_with,
)
from .following import OwnAnswers, following
from .judge import judged
from .price import Bill
from .verdict import (
    CHARGED,
    COMPARED,
    ENTRIES_FOLLOW,
    FOLLOWS,
    NOTHING_FOLLOWS,
    Finding,
    Status,
    Verdict,
    not_graded,
)
from .vouched import is_vouched

MOST_TEXT = 400  # of a sentence that repeats what a student's process said
HALF = 0.5  # of the points: what has earned less, and has no name, may be made up
KEPT = "Your answer is kept"
UNASKED = "Your answer is kept; the exercise cannot call a function yet: "
BY_HAND = "It is marked by hand."
OUR_FAILURE = "The grader failed on this part; your answer is kept."
OF_ANOTHER = "it is right for another student's numbers"
SHARED = "another student has the same numbers, and yours are drawn for you alone"
UNRELATED = "hardly any of its numbers comes out of yours"
log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Marked:
    """What marking one exercise of one student refers to, and what was found so far.

    Attributes:
        key: What answers are compared with.
        bill: What was charged for already, on the whole sheet.
        others: The reference answers of other students.
        peers: What other students handed in.
        own: The answers that could be read.
        verdicts: Of all parts so far.
        named: Wrong parts whose mistake has a name and a price.
        suspected: The known mistakes of any arm that may explain each part.
    """

    key: AnswerKey
    bill: Bill = field(default_factory=Bill)
    others: Others = field(default_factory=dict[str, Mapping[str, Any]])
    peers: Peers = field(default_factory=dict[str, Mapping[str, Any]])
    own: OwnAnswers = field(default_factory=OwnAnswers)
    verdicts: dict[str, Verdict] = field(default_factory=dict[str, Verdict])
    named: set[str] = field(default_factory=set[str])
    suspected: dict[str, frozenset[str]] = field(default_factory=dict[str, frozenset[str]])


@dataclass(frozen=True)
class _Judged:
    """An answer against what is wanted: the comparison, what explains it, and what it is worth."""

    found: Comparison
    names: tuple[Named, ...]
    share: float
    notes: tuple[str, ...]


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
            verdict = not_graded(part.variable, part.points, f"{KEPT}: {raw.value}.")
        elif isinstance(part.answer, Manual):
            verdict = _by_hand(part, raw, sheet.key.v)
        else:
            verdict = _mark_raw(sheet, part, raw)
        sheet.verdicts[part.variable] = verdict


def mark_part(key: AnswerKey, part: Part, raw: Raw) -> Verdict:
    """The verdict of one part by itself: nothing follows from other answers."""
    return _mark_raw(Marked(key), part, raw)


def _mark_raw(sheet: Marked, part: Part, raw: Raw) -> Verdict:
    if raw.kind == "unasked":
        return not_graded(part.variable, part.points, f"{UNASKED}{raw.value}.")
    answer, unjudged = _read(part, raw, sheet.key.v)
    if unjudged:
        return unjudged
    try:
        verdict = _mark_readable(sheet, part, answer)
    except Unreadable as error:  # what can be read may still be too much to be compared
        return _unreadable(part, raw, str(error))
    sheet.own.answers[part.variable] = answer
    read_as = marker_of(part.answer).read_as(part.answer, raw, answer)
    return replace(verdict, reading=" ".join(filter(None, (read_as, verdict.reading))))


def _mark_readable(sheet: Marked, part: Part, answer: Any) -> Verdict:
    """The verdict of an answer that was read, with a note for the instructor on whose it may be."""
    try:
        verdict = _verdict(sheet, part, answer)
    except Unreadable:
        raise
    except Exception:
        log.exception("%s could not be marked", part.variable)
        verdict = not_graded(part.variable, part.points, OUR_FAILURE)
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


def _by_hand(part: Part, raw: Raw, v: Variant) -> Verdict:
    """What waits for the marker, with the text; nothing is worth nothing, unless it is on paper."""
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
    if not raw.note or verdict.status not in ("correct", "incorrect", "partly", "follows"):
        return verdict
    return _with_finding(verdict, f"In your file: {raw.note[:MOST_TEXT]}.")


def _unreadable(part: Part, raw: Raw, sentence: str) -> Verdict:
    if sentence == UNANSWERED:
        hint = ()
        if raw.kind == "missing" and raw.value:
            hint = (Finding(f"In your file: {raw.value}."),)
        return Verdict(part.variable, "missing", 0.0, part.points, hint)
    if sentence.startswith(UNANSWERED):  # a function as it was handed out
        return Verdict(
            part.variable, "missing", 0.0, part.points, (Finding("The function returns nothing."),)
        )
    said, *typed = sentence[:MOST_TEXT].split("\n")
    stop = "" if said.endswith(("?", ".")) else "."
    if raw.kind == "error":
        said = f"In your file: {said}{stop}"
    else:
        said = f"{said[:1].upper()}{said[1:]}{stop}"
    text = "\n".join([said, *typed])
    return Verdict(part.variable, "failed", 0.0, part.points, (Finding(text),))


def _verdict(sheet: Marked, part: Part, answer: Any) -> Verdict:
    """The better of two: against the reference, and against what follows from own answers."""
    key = sheet.key
    own = _judge(sheet, part, key.wanted(part), answer)
    if own.found.all_right:
        return _written(part, own, answer, "correct")
    follows = following(key, part, sheet.own, _wrong(sheet, part))
    if follows.wanted is not None:
        followed = _followed(sheet, part, follows.wanted, answer)
        follow = _follow(sheet, part)
        if followed is not None and _is_better(follow, followed, own):
            _charge(sheet, part, followed)
            if _is_made_up(part, followed, answer, follows.wanted.value):
                sheet.own.unfollowed[part.variable] = UNRELATED
            return _written_following(sheet, part, followed, answer, follow)
    if _is_made_up(part, own, answer, key.reference[part.variable]):
        sheet.own.unfollowed[part.variable] = UNRELATED
    _charge(sheet, part, own)
    if own.names and own.names[0].fault:
        sheet.named.add(part.variable)
    verdict = _written(part, own, answer)
    if follows.why:
        return _with_finding(verdict, f"{NOTHING_FOLLOWS} {follows.why}.")
    return verdict


def _is_made_up(part: Part, judged: _Judged, answer: Any, wanted: Any) -> bool:
    """Whether an answer earned little, has no name, and hardly any number of what is wanted."""
    return not judged.names and judged.share < HALF and is_unrelated(part, wanted, answer)


def _charge(sheet: Marked, part: Part, chosen: _Judged) -> None:
    """Writes down what the part has paid for, and which mistake of its arm it may be."""
    if chosen.names and not chosen.found.settled:
        sheet.bill.charge(part, chosen.names[0])
    for name in chosen.names[:1]:
        sheet.suspected[part.variable] = name.titles


def _follow(sheet: Marked, part: Part) -> float:
    """The share of the points for what follows: all, where own numbers vouch for it."""
    if is_vouched(sheet.key.exercise, part, sheet.verdicts, sheet.named):
        return 1.0
    return part.follow


def _is_better(follow: float, followed: _Judged, own: _Judged) -> bool:
    """Whether what follows from own answers earns more, or as much and all of it follows.

    A known mistake of the arm that was made in an earlier answer is carried on, not made again: it
    is worth what follows, or what is right of the entries.
    """
    earns = followed.share * follow
    worth = own.share
    if any(name.titles for name in own.names):
        worth = own.found.share
    return earns > own.share or (followed.found.all_right and earns >= worth)


def _judge(sheet: Marked, part: Part, wanted: Wanted, answer: Any) -> _Judged:
    """An answer compared, explained and priced; the bill is written when the verdict is."""
    found = judged(sheet.key, part, wanted, answer)
    if found.all_right:
        return _Judged(found, (), 1.0, ())
    suspected = sheet.suspected.values()
    names = tuple(named(sheet.key, part, wanted, answer, found.right, suspected))
    if not names:
        return _Judged(found, (), found.share, found.findings)
    share, before = 0.0, ""
    if not found.settled and not is_printed(sheet.key.exercise, sheet.key.v, answer):
        share, before = sheet.bill.share(part, names[0], answer)
    notes = found.findings
    told = found.reading or (part.check and notes)  # the part's own check says it better
    if not told:
        notes = (*notes, *(name.sentence for name in names))
    if before and share > found.share:
        notes = (*notes, f"{CHARGED} {before} already.")
    return _Judged(found, names, max(found.share, share), notes)


def _written(
    part: Part, own: _Judged, answer: Any, status: Status | None = None, follow: float = 1.0
) -> Verdict:
    found = own.found
    if status is None:
        status = "partly" if own.share > 0 else "incorrect"
    right: Any = found.right.tolist() if hasattr(found.right, "tolist") else found.right
    points = round(part.points * own.share * follow, 2)
    notes = () if status == "correct" else tuple(map(Finding, own.notes))
    shown = marker_of(part.answer).shown(answer)
    return Verdict(part.variable, status, points, part.points, notes, found.reading, right, shown)


def _followed(sheet: Marked, part: Part, wanted: Wanted, answer: Any) -> _Judged | None:
    try:
        with np.errstate(all="ignore"):
            return _judge(sheet, part, wanted, answer)
    except Exception:  # noqa: BLE001 - so may a part's own check
        return None


def _written_following(
    sheet: Marked, part: Part, followed: _Judged, answer: Any, follow: float
) -> Verdict:
    """The verdict of what follows from own answers.

    Answers that were accepted though they differ from the reference keep the full share; wrong ones
    earn `follow` of it.
    """
    wrong = _wrong(sheet, part)
    all_right = followed.found.all_right
    if not wrong:
        return _written(part, followed, answer, "correct" if all_right else None)
    status = "follows" if all_right and follow == 1 else None
    verdict = _written(part, followed, answer, status, follow)
    says = COMPARED
    if all_right:
        says = FOLLOWS
    elif followed.found.share:
        says = ENTRIES_FOLLOW
    return _with_finding(verdict, f"{says} from your own {wrong}.")


def _wrong(sheet: Marked, part: Part) -> str:
    """The own answers that the part needs and that are not right."""
    own = sheet.own.needed(part)
    return " and ".join(name for name in own if sheet.verdicts[name].status != "correct")
