"""What a student got for a sheet, whether it was marked just now or stands in the gradebook."""

from collections.abc import Sequence

from ..ledger.gradebook import Gradebook
from ..ledger.term import Acceptance
from ..settings.asked import asked_parts, exercises_of
from ..settings.config import Course, Sheet
from ..term.opinions import Opinions
from ..term.result import UNSAFE_STAMP, Attempts, Result
from ..term.standing import Standing
from .hand_ins import HandIns

__all__ = ["UNSAFE_STAMP", "Attempts", "Result", "recorded_results", "standing"]


def recorded_results(
    course: Course,
    gradebook: Gradebook,
    sheet: Sheet,
    accepted: Sequence[Acceptance] | None = None,
) -> list[Result]:
    """What the gradebook holds for every student of the roster; no submission is marked.

    `accepted` is as in `standing`.
    """
    current = gradebook.current(sheet.name)
    damaged = gradebook.damaged(sheet.name)
    hand_ins = HandIns(course, sheet)
    results: list[Result] = []
    for student in course.students:
        if student.id in damaged or student.id not in current:
            reason = damaged.get(student.id, "nothing marked yet")
            results.append(Result(student, sheet.name, reason=reason))
            continue
        others = hand_ins.unread(student.id)
        results.append(Result(student, sheet.name, tuple(current[student.id]), passed_over=others))
    return standing(course, gradebook, sheet, results, accepted)


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
