"""The commands `kinegrade marks ...`: what people decide on answers, one by one or from a file."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..machine.console import counted, say
from .options import CourseOption, GradebookOption, SheetArguments, opened

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..settings.config import Course, Sheet

marks = typer.Typer(help="Marks and comments that people give.", no_args_is_help=True)
MarkerOption = Annotated[
    str, typer.Option("--marker", help="Who marks; else the user of this machine.")
]
ReasonOption = Annotated[
    str, typer.Option("--reason", help="Why, for the gradebook; students do not see it.")
]
SheetOption = Annotated[
    str | None, typer.Option("--sheet", help="The sheet, where the part is on several.")
]


@marks.command("list")
def list_marks(
    sheets: SheetArguments = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Answers that wait for a mark, with the key and the rubric."""
    from ..results.marks import by_hand
    from ..results.tables import show_by_hand

    with opened(folder, place) as (course, gradebook):
        found = by_hand(course, gradebook, course.sheets(tuple(sheets or ())))
        show_by_hand([one for one in found if one.waits])


@marks.command("set")
def set_mark(
    student: Annotated[
        str, typer.Argument(help="An id of roster.csv, or the code on the pages of a PDF.")
    ],
    part: Annotated[str, typer.Argument(help="The variable of the part, whoever marks it.")],
    points: Annotated[
        float | None,
        typer.Argument(help="Points, up to those of the part; left out for a comment alone."),
    ] = None,
    comment: Annotated[str, typer.Option("--comment", help="A sentence for the student.")] = "",
    ticks: Annotated[
        str, typer.Option("--ticks", help="Lines of the rubric that are met, such as 1,3.")
    ] = "",
    reason: ReasonOption = "",
    marker: MarkerOption = "",
    sheet: SheetOption = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Enter one mark, or a comment; it goes before what was marked automatically."""
    from ..results.marks import every_answer, read_ticks, the_one

    if points is None and not comment and not ticks:
        raise typer.BadParameter("a mark takes POINTS, --ticks or --comment")
    with opened(folder, place) as (course, gradebook):
        found = list(every_answer(course, gradebook, _chosen(course, sheet)))
        one = the_one(course, found, student, part, sheet or "")
        mark = one.new_mark(points, comment, read_ticks(ticks))
        gradebook.save_marks([mark], author=marker, reason=reason)
        say("Entered. `kinegrade report` writes the pages with it.")


def _chosen(course: "Course", sheet: str | None) -> "Sequence[Sheet]":
    if sheet is None:
        return course.sheets()
    return (course.sheet(sheet),)


@marks.command(
    "write",
    help="Write a CSV file with a line for every answer; fill in points or ticks and comment, "
    "then `marks read`.",
)
def write_marks(
    file: Annotated[Path, typer.Argument(help="A new .csv file.")],
    sheets: SheetArguments = None,
    blind: Annotated[
        bool, typer.Option("--blind", help="The code of the variant instead of the student.")
    ] = False,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Write a CSV file with a line for every answer, to be read back with marks."""
    from ..results.marks import by_hand, write_csv

    with opened(folder, place) as (course, gradebook):
        found = list(by_hand(course, gradebook, course.sheets(tuple(sheets or ()))))
        write_csv(found, file, blind=blind)
        print(file)
        waiting = sum(one.waits for one in found)
        answers = counted(len(found), "answer", "answers")
        wait = "waits" if waiting == 1 else "wait"
        say(f"{answers}, {waiting} of them {wait} for a mark.")


@marks.command("read")
def read_marks(
    file: Annotated[Path, typer.Argument(help="The file of `marks write`, with points filled in.")],
    marker: MarkerOption = "",
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Enter the marks of a CSV file, all or none."""
    from ..results.marks import by_hand, read_csv

    with opened(folder, place) as (course, gradebook):
        found = list(by_hand(course, gradebook, course.sheets()))
        entered = read_csv(file, course, found, gradebook, marker=marker)
        marks_entered = counted(entered, "mark", "marks")
        say(f"{marks_entered} entered. `kinegrade report` writes the pages with what was entered.")


@marks.command("differing")
def list_differing(
    sheets: SheetArguments = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Answers to which several markers gave other points; the newest mark counts."""
    from ..text.escape import printable

    with opened(folder, place) as (course, gradebook):
        for sheet in course.sheets(tuple(sheets or ())):
            for one in gradebook.differing_marks(sheet.name):
                said = ", ".join(f"{who}: {points:g}" for who, points in one.points.items())
                print(printable(f"{one.student}  {one.sheet}  {one.part}  {said}"))


@marks.command("requests")
def list_requests(
    sheets: SheetArguments = None,
    every: Annotated[
        bool, typer.Option("--all", help="Also those that were answered with a mark or comment.")
    ] = False,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """What students ask to have looked at again, in submitted/<student>/<sheet>.request.txt."""
    from ..results.requests import read_requests
    from ..text.escape import printable

    with opened(folder, place) as (course, gradebook):
        for sheet in course.sheets(tuple(sheets or ())):
            for one in read_requests(course, gradebook, sheet):
                if one.answered and not every:
                    continue
                state = "answered" if one.answered else "open"
                line = f"{one.at[:16]}  {one.student}  {one.sheet}  {one.part}  {state}: {one.text}"
                print(printable(line))
        say("`kinegrade marks set STUDENT PART [POINTS] --comment ...` answers one.")
