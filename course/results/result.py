"""What a student got for a sheet, whether it was marked just now or stands in the gradebook."""

from collections.abc import Mapping, Sequence

from ...grader.marking.verdict import not_graded
from ..ledger.gradebook import Gradebook
from ..ledger.term import Acceptance
from ..settings.asked import asked_parts, exercises_of
from ..settings.config import Course, Sheet
from ..term.opinions import Opinions
from ..term.result import UNSAFE_STAMP, Attempts, Result
from ..term.standing import Standing
from .hand_ins import HandIns

COSTLY = ("mark", "extension", "arrival")
"""Tables of which a damaged row leaves a student's points open."""
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
    current = gradebook.current(sheet.name, asked_parts(exercises_of(course, sheet)))
    hand_ins = HandIns(course, sheet)
    results: list[Result] = []
    for student in course.students:
        if student.id not in current:
            results.append(Result(student, sheet.name, reason="nothing marked yet"))
            continue
        others = hand_ins.unread(student.id)
        results.append(Result(student, sheet.name, tuple(current[student.id]), passed_over=others))
    results = damaged_wait(course, sheet, results, gradebook.damaged(sheet.name, "grade"))
    return standing(course, gradebook, sheet, results, accepted)


def damaged_wait(
    course: Course, sheet: Sheet, results: Sequence[Result], damaged: Mapping[str, str]
) -> list[Result]:
    """Results, but for those whose row is damaged: all their parts wait, and it is said why."""
    parts = asked_parts(exercises_of(course, sheet)).values()
    found: list[Result] = []
    for result in results:
        reason = damaged.get(result.student.id)
        if reason is None:
            found.append(result)
            continue
        verdicts = tuple(not_graded(part.variable, part.points, reason) for part in parts)
        found.append(Result(result.student, sheet.name, verdicts, reason=reason))
    return found


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
    damaged = gradebook.damaged(sheet.name, *COSTLY)
    return found.of(damaged_wait(course, sheet, results, damaged))
