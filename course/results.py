"""What a student got for a sheet, whether it was marked just now or stands in the gradebook."""

from dataclasses import dataclass

from ..grader.marking.verdict import Finding, Verdict
from .config import Course, Sheet, Student
from .gradebook import Gradebook
from .marks import with_marks
from .received import listed_times
from .sheet.handed_in import unread
from .sheets import asked_parts, exercises_of

UNSAFE_STAMP = Finding(
    "This notebook was run at level unsafe: it could have changed any marks.",
    private=True,
)


@dataclass(frozen=True)
class Result:
    """One student's sheet: verdicts in the order of the parts, or why there are none.

    `passed_over` names files that look like other versions of the one that was marked.
    """

    student: Student
    sheet: str
    verdicts: tuple[Verdict, ...] = ()
    reason: str = ""
    passed_over: tuple[str, ...] = ()

    @property
    def points(self) -> float | None:
        """Points so far; None while a part waits for the instructor, or where nothing came in."""
        known = [verdict.points for verdict in self.verdicts if verdict.points is not None]
        if not known or len(known) < len(self.verdicts):
            return None
        return round(sum(known), 2)

    @property
    def unsafe(self) -> bool:
        """Whether it was run without walls."""
        return any(UNSAFE_STAMP in verdict.findings for verdict in self.verdicts)

    @property
    def status(self) -> str:
        """graded, not_graded or no_submission."""
        if self.points is not None:
            return "graded"
        if self.verdicts:
            return "not_graded"
        return "no_submission"

    @property
    def earned(self) -> dict[str, float | None]:
        """Points by part; None where a part waits for its mark."""
        return {verdict.part: verdict.points for verdict in self.verdicts}

    @property
    def out_of(self) -> float:
        """Points that could be had."""
        return sum(verdict.out_of for verdict in self.verdicts)


def recorded_results(course: Course, gradebook: Gradebook, sheet: Sheet) -> list[Result]:
    """What the gradebook holds for every student of the roster; no submission is marked."""
    current = gradebook.current(sheet.name)
    marks = gradebook.marks(sheet.name)
    damaged = gradebook.damaged(sheet.name)
    parts = asked_parts(exercises_of(course, sheet))
    received = listed_times(course.folder / "submitted")
    names = [one.name for one in course.settings.sheet]

    results: list[Result] = []
    for student in course.students:
        if student.id in damaged or student.id not in current:
            reason = damaged.get(student.id, "nothing marked yet")
            results.append(Result(student, sheet.name, reason=reason))
            continue
        verdicts = with_marks(current[student.id], student.id, marks, parts)
        others = unread(course.folder, student.id, sheet.name, names, received)
        results.append(Result(student, sheet.name, verdicts, passed_over=others))
    return results
