"""The commands `kinegrade marks ...`, for the parts that are marked by hand."""

from pathlib import Path
from typing import Annotated

import typer

from .console import say
from .options import CourseOption, GradebookOption, SheetArguments, opened

marks = typer.Typer(help="Marks for the parts that are marked by hand.", no_args_is_help=True)


@marks.command("list")
def list_marks(
    sheets: SheetArguments = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Answers that wait for a mark, with the key and the rubric."""
    from .marks import by_hand
    from .tables import show_by_hand

    with opened(folder, place) as (course, gradebook):
        found = by_hand(course, gradebook, course.sheets(tuple(sheets or ())))
        show_by_hand([one for one in found if one.waits])


@marks.command("set")
def set_mark(
    student: Annotated[
        str, typer.Argument(help="An id of roster.csv, or the code on the pages of a PDF.")
    ],
    part: Annotated[str, typer.Argument(help="The variable of the part.")],
    points: Annotated[float, typer.Argument(help="Points, up to those of the part.")],
    comment: Annotated[str, typer.Option("--comment", help="A sentence for the student.")] = "",
    sheet: Annotated[
        str | None, typer.Option("--sheet", help="The sheet, where the part is on several.")
    ] = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Enter one mark."""
    from .marks import by_hand, enter

    with opened(folder, place) as (course, gradebook):
        sheets = course.sheets()
        if sheet:
            sheets = course.sheets((sheet,))
        found = list(by_hand(course, gradebook, sheets))
        enter(found, gradebook, student, part, points, comment)
        say("Entered. `kinegrade report` writes the pages with it.")


@marks.command(
    "write",
    help="Write a CSV file with a line for every answer; fill in points and comment, "
    "then `marks read`.",
)
def write_marks(
    file: Annotated[Path, typer.Argument(help="A new .csv file.")],
    sheets: SheetArguments = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Write a CSV file with a line for every answer, to be read back with marks."""
    from .marks import by_hand, write_csv

    with opened(folder, place) as (course, gradebook):
        found = list(by_hand(course, gradebook, course.sheets(tuple(sheets or ()))))
        write_csv(found, file)
        print(file)  # noqa: T201 - data of the command
        waiting = sum(one.waits for one in found)
        say(f"{len(found)} answers, {waiting} of them wait for a mark.")


@marks.command("read")
def read_marks(
    file: Annotated[Path, typer.Argument(help="The file of `marks write`, with points filled in.")],
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Enter the marks of a CSV file, all or none."""
    from .marks import by_hand, read_csv

    with opened(folder, place) as (course, gradebook):
        found = list(by_hand(course, gradebook, course.sheets()))
        entered = read_csv(file, found, gradebook)
        say(f"{entered} marks entered. `kinegrade report` writes the pages with them.")
