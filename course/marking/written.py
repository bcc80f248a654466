"""All that follows from marks: grades.csv, feedback, the report, the table on the terminal."""

import sys
from collections.abc import Sequence
from itertools import chain
from pathlib import Path

from rich.console import Console
from rich.text import Text

from ...grader.jail.level import WALLS, Level
from ...solutions.errors import KinegradeError
from ..grading.place import Place
from ..ledger.gradebook import Gradebook
from ..machine.console import progress, say
from ..machine.files import write_atomically
from ..pages.feedback_pages import write_all_feedback
from ..pages.report import write_report
from ..results.grades import SheetResults, grades_csv
from ..results.requests import read_requests
from ..results.result import Result, recorded_results
from ..results.tables import legend, print_table
from ..settings.asked import exercises_of
from ..settings.config import Course, Sheet
from .handed_out import refuse_a_lost_gradebook
from .how import AS_USUAL, How, this_machine
from .sheets import Marked, mark_sheets

UNKNOWN_LEVEL = (
    "At which level notebooks were run cannot be read: a row of the gradebook is damaged."
)


def mark_and_write(
    course: Course, gradebook: Gradebook, sheets: Sequence[Sheet], how: How = AS_USUAL
) -> Marked:
    """Marks sheets, and writes all that follows from the marks.

    Raises:
        JailError: there are notebooks to run, and no permitted level works there.
        ClusterError: the cluster cannot be used.
    """
    with this_machine(course, how.permission) as machine:
        marked = mark_sheets(course, gradebook, sheets, machine, how)
        write_results(course, gradebook, machine, marked)
    return marked


def write_recorded(course: Course, gradebook: Gradebook) -> Path:
    """All that follows from the marks in the gradebook, without marking; the report's path.

    Raises:
        KinegradeError: no sheet can be read, or the gradebook of released sheets is lost.
    """
    with this_machine(course) as machine:
        return write_results(course, gradebook, machine, [])


def write_results(course: Course, gradebook: Gradebook, machine: Place, marked: Marked) -> Path:
    """grades.csv, one feedback page per student and sheet, and the report; the report's path.

    They are about all sheets of the course: what was `marked` just now, and what is recorded of the
    others.

    Raises:
        KinegradeError: no sheet can be read, or the gradebook of released sheets is lost.
    """
    sheets: list[SheetResults] = []
    for sheet, results in _with_recorded(course, gradebook, marked):
        sheets.append(SheetResults(sheet, exercises_of(course, sheet), results))
    write_atomically(course.folder / "grades.csv", grades_csv(sheets, course.settings.language))

    pages = sum(bool(result.verdicts) for sheet in sheets for result in sheet.results)
    with progress("Writing feedback", pages) as step:
        for sheet in sheets:
            write_all_feedback(course, gradebook, sheet, machine, step)
    asked = [read_requests(course, gradebook, sheet.sheet) for sheet in sheets]
    level = level_line(gradebook.noted_level())
    _say_damages(gradebook, sheets)
    return write_report(course, sheets, level, list(chain.from_iterable(asked)))


def _say_damages(gradebook: Gradebook, sheets: Sequence[SheetResults]) -> None:
    """Names every row that was read and could not be."""
    for sheet in sheets:
        name = sheet.sheet.name
        for sentence in gradebook.damaged(name).values():
            say(f"Sheet {name}: {sentence}.")


def _with_recorded(course: Course, gradebook: Gradebook, marked: Marked) -> Marked:
    """Marked sheets and, as a report is about all of the course, what is recorded of the others."""
    fresh = {sheet.name: results for sheet, results in marked}
    reported: Marked = []
    for sheet in _reported(course):
        results = fresh.get(sheet.name)
        if not results:
            nothing = not gradebook.records(sheet.name)
            refuse_a_lost_gradebook(course, gradebook, sheet, nothing=nothing)
            results = recorded_results(course, gradebook, sheet)
        reported.append((sheet, results))
    return reported


def _reported(course: Course) -> list[Sheet]:
    """The sheets of the report: those whose exercises can be read; it is said which are left out.

    Raises:
        KinegradeError: none can be read.
    """
    errors: dict[str, KinegradeError] = {}
    readable: list[Sheet] = []
    for sheet in course.settings.sheet:
        try:
            exercises_of(course, sheet)
        except KinegradeError as error:
            errors[sheet.name] = error
        else:
            readable.append(sheet)
    if not readable:
        raise next(iter(errors.values()))
    for name, error in errors.items():
        say(f"Sheet {name} is left out of the report: {error}")
    return readable


def level_line(level: str) -> str:
    """A sentence on what stood between the notebooks and this machine; empty where none ran."""
    if not level:
        return ""
    if level not in WALLS:
        return UNKNOWN_LEVEL
    return f"Notebooks were run at level {level} - {WALLS[Level(level)]}."


def show(course: Course, marked: Sequence[tuple[Sheet, Sequence[Result]]], level: str = "") -> None:
    """The table of every sheet on stdout, and where to look on stderr."""
    console = Console()
    if not sys.stdout.isatty():
        console = Console(width=140)  # a file has no width of its own
    for sheet, results in marked:
        console.print(Text(sheet.title or sheet.name, style="bold"))
        print_table(console, results, exercises_of(course, sheet))
    say(legend())
    if level:
        say(level)
    say(f"Report: {course.folder / 'report' / 'index.html'}")
