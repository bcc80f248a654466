"""How the students of a sheet stand: attempts, lateness, people's decisions, publication."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime

from ...grader.marking.verdict import Verdict
from ..ledger.grades import Attempt
from ..ledger.term import Extension, Publication
from ..settings.times import IN_TIME, Lateness, lateness, time_text
from ..settings.toml_tables import Sheet
from .opinions import Opinions
from .publication import read_result
from .result import Attempts, Result

NOT_EXTENDED = Extension()
TOO_LATE = "what was handed in came after the sheet was closed ({closed}) and does not count"
TOO_MANY = "more files were handed in than the {most} that count"


@dataclass(frozen=True)
class Standing:
    """All that results of a sheet follow from besides the verdicts.

    Attributes:
        sheet: With its deadline and rules.
        opinions: Marks and what was accepted.
        extensions: By student.
        arrivals: When submissions came in, by student and hash.
        attempts: All marked submissions of each student, the first seen first.
        published: By student, what was told.
    """

    sheet: Sheet
    opinions: Opinions
    extensions: Mapping[str, Extension]
    arrivals: Mapping[tuple[str, str], datetime]
    attempts: Mapping[str, Sequence[Attempt]]
    published: Mapping[str, Publication]

    def of(self, results: Iterable[Result]) -> list[Result]:
        """Results with all that holds for them; what was published stays as it was told."""
        return [self._of(result) for result in results]

    def _of(self, result: Result) -> Result:
        now = self._by_now(result)
        told = self.published.get(result.student.id)
        if told is None:
            return now
        frozen = read_result(told, now)
        if frozen is None:
            return now
        if frozen.tells_the_same_as(now):
            return frozen
        return replace(frozen, by_now=now)

    def _by_now(self, result: Result) -> Result:
        student = result.student.id
        extension = self.extensions.get(student, NOT_EXTENDED)
        verdicts = self.opinions.on(student, result.verdicts)
        made = replace(result, verdicts=verdicts, excused=extension.excused)
        if not result.verdicts or result.reason or extension.excused:
            return made  # where a file waits to be read, an earlier one does not stand for it
        return self._by_the_clock(made, extension)

    def _by_the_clock(self, result: Result, extension: Extension) -> Result:
        """The attempt that counts, with what being late costs it."""
        student = result.student.id
        attempts = self.attempts.get(student, ())
        if not attempts:
            return result
        allowed = attempts[: self.sheet.most_attempts]
        in_time: list[Result] = []
        for number, attempt in enumerate(allowed, 1):
            late = self._lateness(student, attempt.submission, extension)
            if not late.too_late:
                place = Attempts(number, len(attempts), stands=attempt.counts)
                in_time.append(self._attempt(result, attempt.verdicts, late, place))
        if not in_time:
            return replace(result, verdicts=(), reason=self._why_none(extension))
        if self.sheet.attempts == "best":
            return max(in_time, key=_worth)
        return max(in_time, key=_stands)

    def _attempt(
        self, result: Result, verdicts: Sequence[Verdict], late: Lateness, place: Attempts
    ) -> Result:
        decided = self.opinions.on(result.student.id, verdicts)
        return replace(result, verdicts=decided, late=late, attempts=place)

    def _lateness(self, student: str, submission: str, extension: Extension) -> Lateness:
        received = self.arrivals.get((student, submission))
        if received is None:
            return IN_TIME
        return lateness(self.sheet, received, extension.until or self.sheet.deadline)

    def _why_none(self, extension: Extension) -> str:
        closed = self.sheet.closes or extension.until
        if closed is None:
            return TOO_MANY.format(most=self.sheet.most_attempts)
        return TOO_LATE.format(closed=time_text(closed))


def _stands(result: Result) -> tuple[bool, int]:
    """The file that lies there, else the latest of those that came before it in time."""
    return result.attempts.stands, result.attempts.this


def _worth(result: Result) -> tuple[float, int]:
    """Of equal points, the later attempt, as it is what the student stands by."""
    return result.so_far, result.attempts.this
