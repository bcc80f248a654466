"""An answer compared, explained and priced, and the verdict that is written of it."""

from dataclasses import dataclass
from typing import Any

from ...exercises.exercise import Part
from ..kinds.marker import Comparison, Named, Wanted
from ..kinds.markers import marker_of
from .findings import named
from .follow import is_printed, is_unrelated
from .judge import judged
from .marked import Marked
from .verdict import CHARGED, Finding, Status, Verdict

HALF = 0.5  # of the points: what has earned less, and has no name, may be made up


@dataclass(frozen=True)
class Priced:
    """An answer against what is wanted.

    Attributes:
        found: The comparison.
        names: The mistakes that explain it, the nearest first.
        share: What it earns of the points.
        notes: What is said of it.
    """

    found: Comparison
    names: tuple[Named, ...]
    share: float
    notes: tuple[str, ...]


def priced(sheet: Marked, part: Part, wanted: Wanted, answer: Any) -> Priced:
    """An answer compared, explained and priced; the bill is written when the verdict is."""
    found = judged(sheet.key, part, wanted, answer)
    if found.all_right:
        return Priced(found, (), 1.0, ())
    suspected = sheet.suspected.values()
    names = tuple(named(sheet.key, part, wanted, answer, found.right, suspected))
    if not names:
        return Priced(found, (), found.share, found.findings)
    share, before = 0.0, ""
    if not found.settled and not is_printed(sheet.key.exercise, sheet.key.v, answer):
        share, before = sheet.bill.share(part, names[0], answer)
    notes = found.findings
    told = found.reading or (part.check and notes)  # the part's own check says it better
    if not told:
        notes = (*notes, *(name.sentence for name in names))
    if before and share > found.share:
        notes = (*notes, f"{CHARGED} {before} already.")
    return Priced(found, names, max(found.share, share), notes)


def charge(sheet: Marked, part: Part, chosen: Priced) -> None:
    """Writes down what the part has paid for, and which mistake of its arm it may be."""
    if chosen.names and not chosen.found.settled:
        sheet.bill.charge(part, chosen.names[0])
    for name in chosen.names[:1]:
        sheet.suspected[part.variable] = name.titles


def is_better(follow: float, followed: Priced, own: Priced) -> bool:
    """Whether what follows from own answers earns more, or as much and all of it follows.

    A known mistake of the arm that was made in an earlier answer is carried on, not made again: it
    is worth what follows, or what is right of the entries.
    """
    earns = followed.share * follow
    worth = own.share
    if any(name.titles for name in own.names):
        worth = own.found.share
    return earns > own.share or (followed.found.all_right and earns >= worth)


def is_made_up(part: Part, own: Priced, answer: Any, wanted: Any) -> bool:
    """Whether an answer earned little, has no name, and hardly any number of what is wanted."""
    return not own.names and own.share < HALF and is_unrelated(part, wanted, answer)


def written(
    part: Part, own: Priced, answer: Any, status: Status | None = None, follow: float = 1.0
) -> Verdict:
    """The verdict of an answer, which has earned `follow` of its share.

    Where no status is given, it is wrong, or partly so.
    """
    found = own.found
    if status is None:
        status = "partly" if own.share > 0 else "incorrect"
    right: Any = found.right.tolist() if hasattr(found.right, "tolist") else found.right
    points = round(part.points * own.share * follow, 2)
    notes = () if status == "correct" else tuple(map(Finding, own.notes))
    shown = marker_of(part.answer).shown(answer)
    return Verdict(part.variable, status, points, part.points, notes, found.reading, right, shown)
