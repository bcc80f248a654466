"""Decisions that move several marks, each shown before it counts: accept, regrade, publish."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from ...grader.jail.level import Permission
from ...grader.marking.verdict import ASIDES, Verdict
from ..ledger.copying import copy_ledger
from ..ledger.entries import Change
from ..ledger.gradebook import Gradebook
from ..ledger.term import Acceptance
from ..results.result import Result, recorded_results
from ..settings.asked import asked_parts, exercises_of
from ..settings.config import Course, CourseError, Sheet, hint
from ..term.anywhere import anywhere
from ..term.differences import Move, moves, today
from ..term.opinions import answer_text
from ..term.publication import result_json
from .how import How, this_machine
from .sheets import mark_sheets


def acceptance_like(
    course: Course, gradebook: Gradebook, sheet: Sheet, part: str, student: str
) -> Acceptance:
    """What a student's answer is an example of: the mistake that was named, else this answer.

    Raises:
        CourseError: there is no such part, or the student has no answer to it.
    """
    parts = list(asked_parts(exercises_of(course, sheet)))
    if part not in parts:
        listed = ", ".join(parts)
        raise CourseError(
            f"sheet {sheet.name} has no part {part!r}{hint(part, parts)}; it has: {listed}"
        )
    for verdict in gradebook.current(sheet.name).get(student, ()):
        if verdict.part == part and verdict.status != "missing":
            return _like(sheet, verdict)
    raise CourseError(f"{student} has no answer to {part} on sheet {sheet.name}")


def _like(sheet: Sheet, verdict: Verdict) -> Acceptance:
    for finding in verdict.findings:
        if not finding.private and not finding.text.startswith(ASIDES):
            return Acceptance(sheet.name, verdict.part, "finding", anywhere(finding.text), 1.0)
    return Acceptance(sheet.name, verdict.part, "answer", answer_text(verdict), 1.0)


def moved_by(
    course: Course, gradebook: Gradebook, sheet: Sheet, acceptance: Acceptance
) -> list[Move]:
    """Whose marks would be others, were that accepted."""
    plain = today(recorded_results(course, gradebook, sheet))
    accepted = [*gradebook.term.acceptances(sheet.name), acceptance]
    with_it = recorded_results(course, gradebook, sheet, accepted)
    return moves(plain, today(with_it))


def regrade(
    course: Course,
    gradebook: Gradebook,
    sheets: Sequence[Sheet],
    permission: Permission,
    *,
    dry_run: bool,
) -> list[Move]:
    """Marks all files of some sheets again and says whose marks change.

    With `dry_run` that is done on a copy of the gradebook, which is thrown away.

    Raises:
        JailError: there are notebooks to run, and no permitted level works here.
    """
    before = {sheet.name: today(recorded_results(course, gradebook, sheet)) for sheet in sheets}
    if not dry_run:
        return _marked_again(course, gradebook, sheets, permission, before)
    with TemporaryDirectory(prefix="kinegrade-regrade-") as folder:
        place = Path(folder) / "gradebook.sqlite"
        with Gradebook(place) as copy:
            copy_ledger(gradebook.database, copy.database)
            return _marked_again(course, copy, sheets, permission, before)


def _marked_again(
    course: Course,
    gradebook: Gradebook,
    sheets: Sequence[Sheet],
    permission: Permission,
    before: dict[str, list[Result]],
) -> list[Move]:
    how = How(again=True, permission=permission)
    with this_machine(course, permission) as machine:
        marked = mark_sheets(course, gradebook, sheets, machine, how)
    found: list[Move] = []
    for sheet, results in marked:
        found += moves(before[sheet.name], today(results))
    return found


@dataclass(frozen=True)
class ToPublish:
    """What publishing a sheet would tell.

    Attributes:
        new: Results that were not told before.
        changed: Results that were told otherwise.
        waiting: Results that are not told, as something in them waits for a mark.
    """

    new: list[Result]
    changed: list[Move]
    waiting: list[Result]


def to_publish(course: Course, gradebook: Gradebook, sheet: Sheet) -> ToPublish:
    """The results of a sheet, by what publishing does with them."""
    found = ToPublish([], [], [])
    for result in recorded_results(course, gradebook, sheet):
        now = result.by_now or result
        if now.status == "not_graded":
            found.waiting.append(now)
        elif now.status == "no_submission":
            continue
        elif not result.published:
            found.new.append(now)
        elif result.by_now is not None:
            found.changed.append(Move(result, now))
    return found


def publish(gradebook: Gradebook, sheet: Sheet, found: ToPublish, change: Change) -> None:
    """Keeps what is told from now on; it stays until it is published again."""
    results = [*found.new, *(move.after for move in found.changed)]
    told = {result.student.id: result_json(replace(result, by_now=None)) for result in results}
    gradebook.term.publish(sheet.name, told, change)
