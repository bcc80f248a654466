"""Commands of a term: accept, regrade, publish, extend, excuse, oral."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..errors import CourseError
from ..machine.console import say
from .marks import MarkerOption
from .options import CourseOption, GradebookOption, SheetArguments, opened

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..ledger.term import Acceptance
    from ..term.differences import Move

term = typer.Typer(help="What a term brings.", no_args_is_help=True)
SheetArgument = Annotated[str, typer.Argument(help="The name of a sheet.")]
StudentArgument = Annotated[str, typer.Argument(help="An id of roster.csv.")]
WhyOption = Annotated[str, typer.Option("--reason", help="Why, for the gradebook.")]
DryRunOption = Annotated[
    bool, typer.Option("--dry-run", help="Show what would change, and change nothing.")
]


@term.command()
def accept(
    sheet: SheetArgument,
    part: Annotated[str, typer.Argument(help="The variable of the part.")],
    like: Annotated[
        str,
        typer.Option("--like", help="A student whose answer is an example of what is accepted."),
    ],
    share: Annotated[
        float, typer.Option("--share", min=0, max=1, help="Of the points that it is worth.")
    ] = 1.0,
    reason: Annotated[
        str, typer.Option("--reason", help="Why; it stands on the students' pages.")
    ] = "",
    yes: Annotated[bool, typer.Option("--yes", help="Do not ask.")] = False,
    no_longer: Annotated[
        bool, typer.Option("--no-longer", help="Take back what was accepted.")
    ] = False,
    dry_run: DryRunOption = False,
    marker: MarkerOption = "",
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Accept a reading or an answer for everybody, from now on; shows first whom it moves."""
    from dataclasses import replace

    from ..ledger.entries import Change
    from ..marking.second_looks import acceptance_like, moved_by

    with opened(folder, place) as (course, gradebook):
        marked = course.sheet(sheet)
        alike = acceptance_like(course, gradebook, marked, part, like)
        acceptance = replace(alike, share=share, reason=reason)
        what = _accepted_answers(acceptance)
        change = Change(marker, reason)
        if no_longer:
            gradebook.term.accept(acceptance, change, no_longer=True)
            say(f"{part}: no longer accepted are {what}")
            return
        say(f"{part}: {what}")
        _show(moved_by(course, gradebook, marked, acceptance))
        if dry_run or not _confirmed(yes=yes):
            say("Nothing was changed.")
            return
        gradebook.term.accept(acceptance, change)
        say("Accepted. `kinegrade report` writes the pages with it.")


def _accepted_answers(acceptance: "Acceptance") -> str:
    """Which answers an acceptance is about."""
    if acceptance.kind == "answer":
        return f"the answer {acceptance.text}"
    return f"answers of which it is said: {acceptance.text}"


@term.command()
def regrade(
    sheets: SheetArguments = None,
    dry_run: DryRunOption = False,
    accept_medium: Annotated[
        bool,
        typer.Option(
            "--accept-medium", help="Run notebooks without bubblewrap where it does not work."
        ),
    ] = False,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Mark again what was handed in, and show whose marks change."""
    from ...grader.jail.level import Permission
    from ..marking.second_looks import regrade as mark_again
    from ..marking.written import write_recorded

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheets(tuple(sheets or ()))
        permission = Permission(accept_medium)
        found = mark_again(course, gradebook, chosen, permission, dry_run=dry_run)
        _show(found)
        if dry_run:
            say("Nothing was changed.")
        else:
            say(f"Report: {write_recorded(course, gradebook)}")


@term.command()
def publish(
    sheets: Annotated[list[str], typer.Argument(help="Names of sheets.")],
    reason: WhyOption = "",
    dry_run: DryRunOption = False,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Freeze the marks of sheets and write what students get; later changes are listed."""
    from ..ledger.entries import Change
    from ..marking.second_looks import publish as freeze
    from ..marking.second_looks import to_publish
    from ..marking.written import write_recorded

    with opened(folder, place) as (course, gradebook):
        for sheet in course.sheets(tuple(sheets)):
            found = to_publish(course, gradebook, sheet)
            _print(found.changed)
            for result in found.waiting:
                say(f"{result.student.id}, sheet {sheet.name}: waits for a mark, not published")
            if not dry_run:
                freeze(gradebook, sheet, found, Change(reason=reason))
            done = "would be published" if dry_run else "published"
            say(
                f"Sheet {sheet.name}: {len(found.new)} results {done}, "
                f"{len(found.changed)} changed, {len(found.waiting)} wait."
            )
        if not dry_run:
            write_recorded(course, gradebook)
            say(f"What students get: {course.folder / 'feedback'}/<student>/<sheet>.html")


@term.command()
def extend(
    student: StudentArgument,
    sheet: SheetArgument,
    until: Annotated[
        str,
        typer.Option("--until", help="Such as 2026-10-10T23:59; empty takes an extension back."),
    ],
    reason: WhyOption = "",
    marker: MarkerOption = "",
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Give one student another deadline for a sheet."""
    from ..ledger.entries import Change
    from ..ledger.term import Extension
    from ..settings.times import read_time, time_text

    with opened(folder, place) as (course, gradebook):
        course.student(student)
        chosen = course.sheet(sheet)
        given = Extension()
        if until:
            if chosen.deadline is None and chosen.closes is None:
                raise CourseError(f"sheet {sheet} has no deadline that could be extended")
            given = Extension(read_time(until, course.settings.zone))
        gradebook.term.extend(student, sheet, given, Change(marker, reason))
        if given.until is None:
            say(f"{student} has the deadline of all for sheet {sheet} again.")
        else:
            say(f"{student} has until {time_text(given.until)} for sheet {sheet}.")


@term.command()
def excuse(
    student: StudentArgument,
    sheet: SheetArgument,
    reason: WhyOption = "",
    no_longer: Annotated[bool, typer.Option("--no-longer", help="It counts again.")] = False,
    marker: MarkerOption = "",
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Leave a sheet out of one student's total."""
    from ..ledger.entries import Change
    from ..ledger.term import Extension

    with opened(folder, place) as (course, gradebook):
        course.student(student)
        course.sheet(sheet)
        given = Extension(excused=not no_longer)
        gradebook.term.extend(student, sheet, given, Change(marker, reason))
        counts = "counts again" if no_longer else "does not count"
        say(f"Sheet {sheet} {counts} for {student}. `kinegrade report` writes the pages with it.")


@term.command()
def oral(
    sheet: SheetArgument,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Write a page of equal wrong answers and code that is alike, to talk about with students."""
    from ..pages.oral import write_oral_sheet

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheet(sheet)
        path, found = write_oral_sheet(course, gradebook, chosen)
        print(path)
        say(f"{len(found.students)} students to talk to; nobody lost a point by it.")


def _show(found: "Sequence[Move]") -> None:
    """The moves on stdout, their number on stderr."""
    _print(found)
    who = "one student" if len(found) == 1 else f"{len(found)} students"
    say(f"Marks of {who} change.")


def _print(found: "Sequence[Move]") -> None:
    from ..text.escape import printable

    for move in found:
        print(printable(move.line()))


def _confirmed(*, yes: bool) -> bool:
    """Asks on a terminal; elsewhere it takes --yes."""
    if yes:
        return True
    if not sys.stdin.isatty():
        say("--yes lets it count.")
        return False
    return typer.confirm("Accept?")
