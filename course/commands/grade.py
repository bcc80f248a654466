"""The command `kinegrade grade`: a class marked, here or on other machines."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..machine.console import say
from .options import CourseOption, GradebookOption, JsonOption, SheetArguments, opened

if TYPE_CHECKING:
    from ..marking.sheets import Marked
    from ..results.result import Result

StudentsOption = Annotated[
    list[str] | None,
    typer.Option("--student", help="Mark the file of this student alone; may be given again."),
]
AcceptChangeOption = Annotated[
    bool,
    typer.Option(
        "--accept-change", help="Mark by reference answers that changed since the hand-out."
    ),
]
AgainOption = Annotated[bool, typer.Option("--again", help="Mark anew what is marked already.")]
MediumOption = Annotated[
    bool,
    typer.Option(
        "--accept-medium", help="Run notebooks without bubblewrap where it does not work."
    ),
]
UnsafeOption = Annotated[
    bool,
    typer.Option(
        "--unsafe", help="Run notebooks without walls where none can be had; the marks say so."
    ),
]
ClusterOption = Annotated[
    str,
    typer.Option(
        "--cluster", help="Mark on the workers of a Dask scheduler, such as tcp://127.0.0.1:8786."
    ),
]


def grade(
    sheets: SheetArguments = None,
    students: StudentsOption = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
    accept_change: AcceptChangeOption = False,
    again: AgainOption = False,
    accept_medium: MediumOption = False,
    unsafe: UnsafeOption = False,
    cluster: ClusterOption = "",
    as_json: JsonOption = False,
) -> None:
    """Mark what was handed in; write grades.csv, feedback and the report."""
    from ...grader.jail.level import Permission
    from ..marking.how import How
    from ..marking.written import level_line, mark_and_write, show
    from ..results.tables import results_json

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheets(tuple(sheets or ()))
        only = tuple(course.student(name).id for name in students or ())
        how = How(accept_change, again, Permission(accept_medium, unsafe), cluster, only)
        marked: Marked = []
        for sheet, results in mark_and_write(course, gradebook, chosen, how):
            shown = [one for one in results if not only or one.student.id in only]
            marked.append((sheet, shown))
        level = level_line(gradebook.noted_level())
        if not as_json:
            show(course, marked, level)
            return
        if level:
            say(level)
        of_all_sheets: list[Result] = []
        for _, results in marked:
            of_all_sheets += results
        print(results_json(of_all_sheets))
