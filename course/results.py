"""What a student got for a sheet, whether it was marked just now or stands in the gradebook."""

from collections.abc import Sequence
from zoneinfo import ZoneInfo

from .config import Course, Sheet
from .gradebook import Gradebook
from .ledger.term import Acceptance
from .sheet.handed_in import unread
from .sheets import asked_parts, exercises_of
from .term.opinions import Opinions
from .term.received import listed_times
from .term.result import UNSAFE_STAMP, Attempts, Result
from .term.standing import Standing

__all__ = ["UNSAFE_STAMP", "Attempts", "Result", "recorded_results", "standing"]


def recorded_results(course: Course, gradebook: Gradebook, sheet: Sheet) -> list[Result]:
    """What the gradebook holds for every student of the roster; no submission is marked."""
    current = gradebook.current(sheet.name)
    damaged = gradebook.damaged(sheet.name)
    received = listed_times(course.folder, ZoneInfo(course.settings.timezone))
    names = [one.name for one in course.settings.sheet]
    results: list[Result] = []
    for student in course.students:
        if student.id in damaged or student.id not in current:
            reason = damaged.get(student.id, "nothing marked yet")
            results.append(Result(student, sheet.name, reason=reason))
            continue
        others = unread(course.folder, student.id, sheet.name, names, received)
        results.append(Result(student, sheet.name, tuple(current[student.id]), passed_over=others))
    return standing(course, gradebook, sheet, results)


def standing(
    course: Course,
    gradebook: Gradebook,
    sheet: Sheet,
    results: Sequence[Result],
    accepted: Sequence[Acceptance] | None = None,
) -> list[Result]:
    """Results as marked, with what deadlines, attempts and people make of them.

    `accepted` stands for what the gradebook says is accepted.
    """
    term = gradebook.term
    attempts = gradebook.attempts(sheet.name) if sheet.is_timed else {}
    found = Standing(
        sheet=sheet,
        opinions=Opinions(
            marks=gradebook.marks(sheet.name),
            acceptances=term.acceptances(sheet.name) if accepted is None else accepted,
            parts=asked_parts(exercises_of(course, sheet)),
        ),
        extensions=term.extensions(sheet.name),
        arrivals=term.arrivals(sheet.name),
        attempts=attempts,
        published=term.published(sheet.name),
    )
    return found.of(results)
