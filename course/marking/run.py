"""A marking run: progress while it goes, then grades.csv, feedback, report and the table."""

import sys
from collections.abc import Collection, Generator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from rich.console import Console
from rich.text import Text

from ...grader.jail.jail import Jail
from ...grader.jail.level import WALLS, Level, Permission
from ...grader.jail.packages import not_installed
from ...solutions.errors import KinegradeError
from ..grading.place import Place
from ..grading.processes import ThisMachine
from ..ledger.gradebook import Gradebook
from ..machine.console import progress, say
from ..machine.files import write_atomically
from ..pages.feedback_pages import write_all_feedback
from ..pages.report import write_report
from ..results.grades import SheetResults, grades_csv
from ..results.requests import read_requests
from ..results.result import Result, recorded_results
from ..results.tables import legend, terminal_table
from ..settings.asked import exercises_of
from ..settings.config import Course, Sheet
from ..sheet.handed_in import strangers
from .marker import SheetMarker

STRONG = Permission()
Marked = list[tuple[Sheet, list[Result]]]
"""Sheets with the results of the roster."""


@dataclass(frozen=True)
class How:
    """How sheets are marked.

    Attributes:
        accept_change: Whether moved references become the recorded ones.
        again: Whether marked files are marked anew.
        permission: How far down the walls around notebooks may go.
        cluster: The address of a Dask scheduler that it is marked by; else here.
        students: Ids of those whose files are marked; of all where none is named.
    """

    accept_change: bool = False
    again: bool = False
    permission: Permission = STRONG
    cluster: str = ""
    students: tuple[str, ...] = ()


def mark_sheets(
    course: Course, gradebook: Gradebook, sheets: Sequence[Sheet], how: How | None = None
) -> Marked:
    """Marks sheets with a progress bar and writes all that follows from the marks.

    Raises:
        JailError: there are notebooks to run, and no permitted level works there.
        ClusterError: the cluster cannot be used.
    """
    how = how or How()
    with this_machine(course, how.permission) as machine:
        with _marking_place(course, how, machine) as place:
            marked = _marked_in(place, course, gradebook, sheets, how)
        write_results(course, gradebook, _with_recorded(course, gradebook, marked), machine)
    return marked


def marked_sheets(
    course: Course, gradebook: Gradebook, sheets: Sequence[Sheet], how: How | None = None
) -> Marked:
    """Marks sheets with a progress bar; the marks stand in the gradebook and nowhere else.

    Raises:
        JailError: there are notebooks to run, and no permitted level works there.
        ClusterError: the cluster cannot be used.
    """
    how = how or How()
    with (
        this_machine(course, how.permission) as machine,
        _marking_place(course, how, machine) as place,
    ):
        return _marked_in(place, course, gradebook, sheets, how)


@contextmanager
def this_machine(course: Course, permission: Permission | None = None) -> Generator[ThisMachine]:
    """This machine, with all that is started on it ended at the end."""
    allowed = course.settings.packages.allow
    with Jail(permission, allowed) as jail, closing(ThisMachine(jail, allowed)) as machine:
        yield machine


@contextmanager
def _marking_place(course: Course, how: How, machine: Place) -> Generator[Place]:
    """Where submissions are marked; pages are written on this machine in any case."""
    if not how.cluster:
        yield machine
        return
    from ..grading.cluster import Cluster

    allowed = course.settings.packages.allow
    with closing(Cluster(how.cluster, how.permission, allowed)) as cluster:
        yield cluster


def _marked_in(
    place: Place, course: Course, gradebook: Gradebook, sheets: Sequence[Sheet], how: How
) -> Marked:
    roster = {student.id for student in course.students}
    for name in strangers(course.folder, roster):
        folder = course.folder / "submitted" / name
        say(f"{folder} belongs to nobody of roster.csv and is not marked.")

    for name in not_installed(course.settings.packages.allow):
        say(f"course.toml allows the package {name}, which is not installed here.")

    marked: Marked = []
    with progress("Marking", len(course.students) * len(sheets)) as step:
        for sheet in sheets:
            marker = SheetMarker(
                course,
                gradebook,
                sheet,
                place=place,
                accept_change=how.accept_change,
                again=how.again,
                only=how.students,
            )
            _renew_solutions(course, gradebook, sheet, marker.accepted)
            marked.append((sheet, marker.results(step)))
            _say_absent(sheet, marker.absent)
    return marked


def _renew_solutions(
    course: Course, gradebook: Gradebook, sheet: Sheet, students: Collection[str]
) -> None:
    """Brings worked solutions up to the answers that were accepted, and says so."""
    if not students:
        return
    from ..handing_out.generate import renew_solutions

    renewed = renew_solutions(course, gradebook, sheet, students)
    say(
        f"Sheet {sheet.name}: answers of {len(students)} students changed, which was accepted; "
        f"{renewed} worked solutions were written again. Hand them out again, too."
    )


def _say_absent(sheet: Sheet, absent: Mapping[str, Collection[str]]) -> None:
    """Names packages that notebooks would have taken: it is for the instructor to allow them."""
    for package, students in absent.items():
        who = ", ".join(sorted(students))
        say(
            f"Sheet {sheet.name}: notebooks need {package}, which is not there ({who}); "
            "install it, list it under [packages] in course.toml, and `kinegrade grade --again`."
        )


def level_line(level: str) -> str:
    """A sentence on what stood between the notebooks and this machine; empty where none ran."""
    if not level:
        return ""
    return f"Notebooks were run at level {level} - {WALLS[Level(level)]}."


def _with_recorded(course: Course, gradebook: Gradebook, marked: Marked) -> Marked:
    """Marked sheets and, as a report is about all of the course, what is recorded of the others."""
    fresh = {sheet.name: results for sheet, results in marked}
    reported: Marked = []
    for sheet in _reported(course):
        results = fresh.get(sheet.name) or recorded_results(course, gradebook, sheet)
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


def write_recorded(course: Course, gradebook: Gradebook) -> Path:
    """All that follows from the marks in the gradebook, without marking; the report's path.

    Raises:
        KinegradeError: no sheet can be read.
    """
    with this_machine(course) as machine:
        recorded = _with_recorded(course, gradebook, [])
        return write_results(course, gradebook, recorded, machine)


def write_results(course: Course, gradebook: Gradebook, marked: Marked, machine: Place) -> Path:
    """grades.csv, one feedback page per student and sheet, and the report; the report's path."""
    sheets: list[SheetResults] = []
    for sheet, results in marked:
        sheets.append(SheetResults(sheet, exercises_of(course, sheet), results))
    write_atomically(course.folder / "grades.csv", grades_csv(sheets, course.settings.language))

    pages = sum(bool(result.verdicts) for sheet in sheets for result in sheet.results)
    with progress("Writing feedback", pages) as step:
        for sheet in sheets:
            write_all_feedback(course, gradebook, sheet, machine, step)
    asked = [read_requests(course, gradebook, sheet.sheet) for sheet in sheets]
    level = level_line(gradebook.noted_level())
    return write_report(course, sheets, level, list(chain.from_iterable(asked)))


def show(course: Course, marked: Sequence[tuple[Sheet, Sequence[Result]]], level: str = "") -> None:
    """The table of every sheet on stdout, and where to look on stderr."""
    console = Console()
    if not sys.stdout.isatty():
        console = Console(width=140)  # a file has no width of its own
    for sheet, results in marked:
        console.print(Text(sheet.title or sheet.name, style="bold"))
        console.print(terminal_table(results, exercises_of(course, sheet)))
    say(legend())
    if level:
        say(level)
    say(f"Report: {course.folder / 'report' / 'index.html'}")
