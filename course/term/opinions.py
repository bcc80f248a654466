"""Second opinions: marks that people gave, and what they accepted for everybody."""

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ...exercises.exercise import Manual, Part
from ...grader.marking.verdict import Finding, Status, Verdict
from ..ledger.marks import Mark
from ..ledger.term import Acceptance
from .anywhere import anywhere

CHANGED = "The answer changed since it was marked by hand; it waits for a new mark."
OTHER_ANSWER = "A mark was given by hand, but for another answer; this one was marked anew."
ACCEPTED = "Your instructor accepts this answer"
SHORT = 8  # characters of an answer's name


@dataclass(frozen=True)
class Opinions:
    """What people decided on one sheet.

    Attributes:
        marks: By student and part.
        acceptances: For everybody.
        parts: Of the sheet, by variable.
    """

    marks: Mapping[tuple[str, str], Mark]
    acceptances: Sequence[Acceptance]
    parts: Mapping[str, Part]

    def on(self, student: str, verdicts: Iterable[Verdict]) -> tuple[Verdict, ...]:
        """Verdicts with what was decided on them.

        What is accepted for everybody comes first; a mark for this student goes before it.
        """
        decided: list[Verdict] = []
        for verdict in verdicts:
            part = self.parts.get(verdict.part)
            made = self._accepted(verdict)
            mark = self.marks.get((student, verdict.part))
            if mark is not None and part is not None:
                made = with_mark(made, mark, part, answer_id(verdict))
            decided.append(made)
        return tuple(decided)

    def _accepted(self, verdict: Verdict) -> Verdict:
        """With the best that was accepted for it, where that is more than it has."""
        best: Acceptance | None = None
        for one in self.acceptances:
            if covers(one, verdict) and (best is None or one.share > best.share):
                best = one
        if best is None or verdict.points is None:
            return verdict
        points = round(best.share * verdict.out_of, 2)
        if points <= verdict.points:
            return verdict
        said = f"{ACCEPTED}: {best.reason}" if best.reason else f"{ACCEPTED}."
        findings = (Finding(said), *verdict.findings)
        return replace(verdict, status=_status(points, verdict), points=points, findings=findings)


def covers(acceptance: Acceptance, verdict: Verdict) -> bool:
    """Whether what is accepted is what this verdict is about."""
    if acceptance.part != verdict.part:
        return False
    if acceptance.kind == "answer":
        return acceptance.text == answer_text(verdict)
    return any(anywhere(finding.text) == acceptance.text for finding in verdict.findings)


def with_mark(verdict: Verdict, mark: Mark, part: Part, answer: str) -> Verdict:
    """A verdict with the mark that a person gave; `answer` names the answer as it is now."""
    if mark.answer != answer:
        return _for_another_answer(verdict, mark, part)
    findings = (*_ticked(mark, part), *_comment(mark))
    if not isinstance(part.answer, Manual):
        findings = (*findings, *verdict.findings)
    if mark.points is None:
        return replace(verdict, findings=findings)
    points = min(mark.points, verdict.out_of)  # the part may be worth less since
    return replace(verdict, status=_status(points, verdict), points=points, findings=findings)


def _for_another_answer(verdict: Verdict, mark: Mark, part: Part) -> Verdict:
    if mark.points is None:  # a comment alone goes with what it was about
        return verdict
    if not isinstance(part.answer, Manual):
        note = Finding(OTHER_ANSWER, private=True)
        return replace(verdict, findings=(*verdict.findings, note))
    if verdict.points is None:
        return replace(verdict, findings=(Finding(CHANGED),))
    return verdict


def _ticked(mark: Mark, part: Part) -> list[Finding]:
    """Every line of the rubric, with whether it is met; none where no line was ticked."""
    if not mark.ticks or not isinstance(part.answer, Manual):
        return []
    ticks = mark.ticks.split(",")
    found: list[Finding] = []
    for number, (points, text) in enumerate(part.answer.rubric, 1):
        sign = "✓" if str(number) in ticks else "✗"
        found.append(Finding(f"{sign} {points:g}: {text}", by_person=True))
    return found


def _comment(mark: Mark) -> tuple[Finding, ...]:
    if not mark.comment:
        return ()
    return (Finding(mark.comment, by_person=True),)


def _status(points: float, verdict: Verdict) -> Status:
    if points == verdict.out_of:
        return "correct"
    if points == 0:
        return "incorrect"
    return "partly"


def answer_id(verdict: Verdict) -> str:
    """A short name of what was handed in for a part; nothing has one too."""
    text = verdict.answer
    unreadable = text is None and verdict.status == "failed"
    if unreadable or not isinstance(text, str | None):
        text = answer_text(verdict)
    return hashlib.sha256(str(text or "").encode(errors="replace")).hexdigest()[:SHORT]


def answer_text(verdict: Verdict) -> str:
    """One text for equal answers; of one that could not be read, what was said of it."""
    found: Any = verdict.answer
    if found is None:
        found = [verdict.reading, *(finding.text for finding in verdict.findings[:1])]
    return json.dumps(found, sort_keys=True)
