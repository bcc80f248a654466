"""What went wrong in a class: every mistake with those who made it, and what holds marks up."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from ...exercises.exercise import Manual
from ...grader.marking.verdict import ASIDES, Finding, Verdict
from ..settings.asked import asked_parts
from ..term.anywhere import anywhere
from ..term.opinions import ACCEPTED
from .grades import SheetResults

UNNAMED = "Wrong, and no known mistake fits."
WRONG = ("partly", "incorrect", "failed")


@dataclass(frozen=True)
class Mistake:
    """A sentence, the parts of which it was said, and the ids of the students concerned."""

    sentence: str
    parts: tuple[str, ...]
    students: tuple[str, ...]


Found = Iterator[tuple[str, str, str]]
"""Sentence, part and student."""
Search = Callable[[SheetResults], Found]


def mistakes(*sheets: SheetResults) -> list[Mistake]:
    """What students were told that is wrong, the most frequent first."""
    return _gathered(sheets, _told)


def waiting(*sheets: SheetResults) -> list[Mistake]:
    """Why parts have no marks yet, the most frequent reason first."""
    return _gathered(sheets, _reasons)


def private_notes(*sheets: SheetResults) -> list[Mistake]:
    """What only the instructor reads, such as whose numbers somebody handed in."""
    return _gathered(sheets, _private)


def absent(sheet: SheetResults) -> dict[str, list[str]]:
    """Reason to the ids of those of whom nothing was marked."""
    reasons: dict[str, list[str]] = {}
    for result in sheet.results:
        if not result.verdicts:
            reasons.setdefault(result.reason or "no submission", []).append(result.student.id)
    return reasons


def _told(sheet: SheetResults) -> Found:
    by_hand: set[str] = set()
    for name, part in asked_parts(sheet.exercises).items():
        if isinstance(part.answer, Manual):
            by_hand.add(name)
    for student, verdict in _verdicts(sheet):
        if verdict.status not in WRONG or verdict.part in by_hand:
            continue
        named = [finding for finding in verdict.findings if _names(finding)]
        for finding in named:
            yield anywhere(_first_line(finding)), verdict.part, student
        if not named:
            yield UNNAMED, verdict.part, student


def _names(finding: Finding) -> bool:
    """Whether a finding tells the student what is wrong."""
    aside = finding.text.startswith((*ASIDES, ACCEPTED))
    return not finding.private and not finding.by_person and not aside


def _reasons(sheet: SheetResults) -> Found:
    for student, verdict in _verdicts(sheet):
        if verdict.points is not None:
            continue
        for finding in verdict.findings:
            yield _first_line(finding), verdict.part, student


def _private(sheet: SheetResults) -> Found:
    for student, verdict in _verdicts(sheet):
        for finding in verdict.findings:
            if finding.private:
                yield finding.text, verdict.part, student


def _verdicts(sheet: SheetResults) -> Iterator[tuple[str, Verdict]]:
    """Every verdict with the id of its student."""
    for result in sheet.results:
        for verdict in result.verdicts:
            yield result.student.id, verdict


def _first_line(finding: Finding) -> str:
    """The sentence, without the typed lines behind it."""
    return finding.text.partition("\n")[0]


def _gathered(sheets: Iterable[SheetResults], search: Search) -> list[Mistake]:
    parts: dict[str, dict[str, None]] = {}  # sets that keep the order
    students: dict[str, set[str]] = {}
    for sheet in sheets:
        for sentence, part, student in search(sheet):
            parts.setdefault(sentence, {})[part] = None
            students.setdefault(sentence, set()).add(student)
    ranked = [Mistake(one, tuple(parts[one]), _sorted(students[one])) for one in parts]
    return sorted(ranked, key=_rank)


def _sorted(students: Iterable[str]) -> tuple[str, ...]:
    return tuple(sorted(students))


def _rank(mistake: Mistake) -> tuple[bool, int, int]:
    """The most frequent first; what has no name behind all that has."""
    return mistake.sentence == UNNAMED, -len(mistake.students), -len(mistake.parts)


def to_talk_about(sheets: Sequence[SheetResults], count: int) -> list[Mistake]:
    """The named mistakes that most students made, on whichever sheet."""
    named = [one for one in mistakes(*sheets) if one.sentence != UNNAMED]
    return named[:count]
