"""Sheets marked one after the other; the marks stand in the gradebook and nowhere else."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict

from ...grader.jail.packages import not_installed
from ..grading.place import Place
from ..ledger.gradebook import Gradebook
from ..machine.console import progress, say
from ..results.result import Result
from ..settings.config import Course, CourseError, Sheet
from ..sheet.about import NOTEBOOK
from ..sheet.handed_in import strangers
from ..sheet.handout import read_handout
from .how import AS_USUAL, How, marking_place
from .marker import SheetMarker

Marked = list[tuple[Sheet, list[Result]]]
"""Sheets with the results of the roster."""


def mark_sheets(
    course: Course,
    gradebook: Gradebook,
    sheets: Sequence[Sheet],
    machine: Place,
    how: How = AS_USUAL,
) -> Marked:
    """Marks sheets on this `machine` or, where `how` names one, on a cluster.

    Raises:
        JailError: there are notebooks to run, and no permitted level works there.
        ClusterError: the cluster cannot be used.
    """
    _say_what_is_odd(course)
    marked: Marked = []
    steps = len(course.students) * len(sheets)
    with marking_place(course, how, machine) as place, progress("Marking", steps) as step:
        for sheet in sheets:
            _say_lower_limits(course, sheet)
            marker = SheetMarker(
                course,
                gradebook,
                sheet,
                place,
                accept_change=how.accept_change,
                again=how.again,
                only=how.students,
            )
            _renew_solutions(course, gradebook, sheet, marker.accepted)
            marked.append((sheet, marker.results(step)))
            _say_absent(sheet, marker.absent)
    return marked


def _say_what_is_odd(course: Course) -> None:
    """Names folders of nobody, and packages that the course allows and that are not there."""
    roster = {student.id for student in course.students}
    for name in strangers(course.folder, roster):
        folder = course.folder / "submitted" / name
        say(f"{folder} belongs to nobody of roster.csv and is not marked.")

    for name in not_installed(course.settings.packages.allow):
        say(f"course.toml allows the package {name}, which is not installed here.")


def _say_lower_limits(course: Course, sheet: Sheet) -> None:
    """Names limits that students were promised more of: one of their sheets stands for all."""
    released = course.folder.glob(f"released/*/{sheet.name}{NOTEBOOK}")
    try:
        promised = asdict(read_handout(next(released)).limits)
    except (StopIteration, CourseError):
        return
    now = course.settings.limits.model_dump()
    for name, value in promised.items():
        if now.get(name, value) < value:
            say(
                f"Sheet {sheet.name} was handed out with {name} = {value:g}, and course.toml says "
                f"{now[name]:g}: students count on what is printed there, so put it back."
            )


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
            f"Sheet {sheet.name}: notebooks ask for {package}, which is not there "
            f"({who}). If the course wants it, install it, list it under [packages] in "
            "course.toml, and `kinegrade grade --again`."
        )
