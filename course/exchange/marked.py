"""A sheet as it is handed back: recorded results, their pages, and what is said of each in text."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...exercises.exercise import Exercise
from ...grader.marking.verdict import STATUS_WORDS, Verdict
from ..ledger.gradebook import Gradebook
from ..machine.console import say
from ..pages.sentences import sentence
from ..results.grades import SheetResults
from ..results.result import Result, recorded_results
from ..settings.asked import asked_parts, exercises_of
from ..settings.config import Course, Sheet, Student
from ..settings.times import late_text
from ..text.escape import printable

NOTHING = "nothing marked yet"


@dataclass(frozen=True)
class Marked:
    """One sheet of a course with what the gradebook has of everybody on the roster."""

    course: Course
    sheet: Sheet
    exercises: Sequence[Exercise]
    results: Sequence[Result]

    @property
    def title(self) -> str:
        """What the sheet is called in other systems."""
        return self.sheet.title or self.sheet.name

    @property
    def out_of(self) -> float:
        """Points that can be had."""
        return SheetResults(self.sheet, self.exercises, self.results).out_of

    def result(self, student: str) -> Result | None:
        """The result of a student; None where nothing of theirs was marked."""
        for result in self.results:
            if result.student.id == student and result.verdicts:
                return result
        return None

    def pages(self) -> list[tuple[Student, Path]]:
        """The feedback page of everybody who has results and one."""
        found: list[tuple[Student, Path]] = []
        for result in self.results:
            folder = self.course.folder / "feedback" / result.student.id
            path = folder / f"{self.sheet.name}.html"
            if result.verdicts and path.is_file():
                found.append((result.student, path))
        return found

    def lines(self, result: Result) -> list[str]:
        """What is said of a result, a line a part, without what is for the instructor."""
        parts = asked_parts(self.exercises)
        told = [_total(result)]
        for verdict in result.verdicts:
            said = list(_findings(verdict))
            if verdict.part in parts:
                said.append(sentence(parts[verdict.part], verdict))
            told.append(" ".join(filter(None, [f"{verdict.part}: {_earned(verdict)}", *said])))
        return told


def read_marked(course: Course, gradebook: Gradebook, sheet: Sheet) -> Marked:
    """What is recorded of a sheet; names on stderr those whose marks are not complete."""
    results = recorded_results(course, gradebook, sheet)
    waiting = [result.student.id for result in results if result.status == "not_graded"]
    if waiting:
        say(
            f"Not graded yet, so without points: {', '.join(waiting)}. "
            "`kinegrade marks list` shows what waits."
        )
    for result in results:
        if not result.verdicts and result.reason not in ("", NOTHING):
            say(f"{result.student.id}: {result.reason}; the cell is left as it is.")
    _say_unpublished(sheet, results)
    return Marked(course, sheet, exercises_of(course, sheet), results)


def _say_unpublished(sheet: Sheet, results: Sequence[Result]) -> None:
    """What goes to students may still change until it is published."""
    open_ = [result.student.id for result in results if result.verdicts and not result.published]
    if open_:
        say(
            f"Not published, so they may still change: {', '.join(open_)}. "
            f"`kinegrade publish {sheet.name}` freezes marks."
        )


def _total(result: Result) -> str:
    if result.excused:
        return "You are excused from this sheet: it does not count for you."
    if result.points is None:
        total = f"Not graded yet, of {result.out_of:g} points."
    else:
        total = f"{result.points:g} of {result.out_of:g} points."
    return " ".join(filter(None, [total, late_text(result.late)]))


def _earned(verdict: Verdict) -> str:
    words = STATUS_WORDS[verdict.status]
    if verdict.points is None:
        return f"{words}."
    return f"{words}, {verdict.points:g} of {verdict.out_of:g}."


def _findings(verdict: Verdict) -> Iterator[str]:
    """What the student reads of a part, on one line."""
    if verdict.reading:
        yield printable(verdict.reading)
    for finding in verdict.findings:
        if not finding.private:
            yield printable(finding.text.partition("\n")[0])
