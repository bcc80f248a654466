"""The commands that exchange files with other systems: collect, handout, handback, export."""

from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

import typer

from ..machine.console import counted, say
from .options import CourseOption, GradebookOption, opened

exchange = typer.Typer()
export = typer.Typer(
    help="A sheet or its results in the form of another system.", no_args_is_help=True
)
exchange.add_typer(export, name="export")
OUTPUT = "exchange"
SheetArgument = Annotated[str, typer.Argument(help="The name of a sheet.")]
OutputOption = Annotated[
    Path | None,
    typer.Option("--output", "-o", help=f"A folder; else {OUTPUT}/ in the course folder."),
]
ZoneOption = Annotated[
    str,
    typer.Option(
        "--zone",
        help="The time zone of times that name none, such as Europe/Berlin; "
        "else that of course.toml or of this machine.",
    ),
]
WorksheetOption = Annotated[
    Path | None,
    typer.Option("--worksheet", help="The table of people that the system exports, as CSV."),
]


FromOption = Annotated[
    str,
    typer.Option(
        "--from", help="moodle, canvas, gradescope, nbgrader or classroom; else it is found out."
    ),
]
ReceivedOption = Annotated[
    str,
    typer.Option(
        "--received",
        help="When files came in of which the download says no time and not that they are late, "
        "such as 2026-11-23T23:59.",
    ),
]


@exchange.command()
def collect(
    download: Annotated[Path, typer.Argument(help="A zip file or a folder.")],
    system: FromOption = "",
    worksheet: WorksheetOption = None,
    sheet: Annotated[
        str, typer.Option("--sheet", help="The sheet, for files that do not say which.")
    ] = "",
    zone: ZoneOption = "",
    received: ReceivedOption = "",
    folder: CourseOption = Path(),
) -> None:
    """Take what was handed in from a system's download into submitted/, with the times."""
    from ..exchange.collection import Wanted
    from ..exchange.collection import collect as take_in
    from ..exchange.moments import time_given, zone_named
    from ..machine.leftovers import cleared
    from ..settings.config import read_course

    course = read_course(folder)
    if not zone and "timezone" in course.settings.model_fields_set:
        zone = course.settings.timezone
    own = zone_named(zone)
    wanted = Wanted(system, worksheet, sheet, own, time_given(received, own))
    with cleared(folder):
        taken = take_in(course, download, wanted)
    for path in taken.paths:
        print(path)
    for sentence in (*taken.conflicts, *taken.notes):
        say(sentence)
    files = counted(len(taken.paths), "file", "files")
    say(f"{files} taken, {taken.unchanged} unchanged.")
    if taken.conflicts:
        raise typer.Exit(1)


@exchange.command()
def handout(
    sheet: SheetArgument,
    worksheet: WorksheetOption = None,
    output: OutputOption = None,
    folder: CourseOption = Path(),
) -> None:
    """Write zips of the personal sheets: a folder a student, and for Moodle with its worksheet."""
    from ..exchange.handouts import for_moodle, plain
    from ..exchange.worksheet import read_worksheet
    from ..machine.leftovers import cleared
    from ..settings.config import read_course
    from ..settings.times import time_text

    course = read_course(folder)
    chosen = course.sheet(sheet)
    if chosen.release is not None and chosen.release > datetime.now(UTC):
        say(f"Sheet {sheet} is for {time_text(chosen.release)}; do not hand it out before.")
    place = output or folder / OUTPUT
    with cleared(folder):
        print(plain(course, chosen, place))
        if worksheet is not None:
            table = read_worksheet(worksheet)
            print(for_moodle(course, chosen, table, place))


@exchange.command()
def handback(
    sheet: SheetArgument,
    system: Annotated[
        str, typer.Option("--to", help="moodle, canvas, gradescope, nbgrader or csv.")
    ],
    worksheet: WorksheetOption = None,
    download: Annotated[
        Path | None,
        typer.Option("--download", help="Canvas's download of submissions, for comment files."),
    ] = None,
    column: Annotated[
        str, typer.Option("--column", help="Canvas's column, if not called after the sheet.")
    ] = "",
    convert: Annotated[
        bool, typer.Option("--scale", help="Convert points to those that the system gives.")
    ] = False,
    output: OutputOption = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Write marks and feedback of a sheet as a system takes them back."""
    from ..exchange.handback import Way, hand_back
    from ..exchange.marked import read_marked

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheet(sheet)
        way = Way(system, output or folder / OUTPUT, worksheet, download, column, convert)
        for path in hand_back(read_marked(course, gradebook, chosen), way):
            print(path)


@export.command("gradescope")
def export_gradescope(
    sheet: SheetArgument,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="A .zip file; else in exchange/.")
    ] = None,
    accept_medium: Annotated[
        bool,
        typer.Option(
            "--accept-medium",
            help="Let it mark without bubblewrap, which Gradescope's containers do not allow.",
        ),
    ] = False,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Write an autograder that marks a sheet on Gradescope, as `kinegrade grade` does."""
    from ...grader.jail.level import Permission
    from ..exchange.autograder import write_autograder

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheet(sheet)
        path = output or folder / OUTPUT / f"{sheet}-gradescope.zip"
        permission = Permission(accept_medium=accept_medium)
        print(write_autograder(course, gradebook, chosen, path, permission))
    say("It holds every answer of the sheet: give it to Gradescope, and to nobody else.")


@export.command("junit")
def export_junit(
    sheet: SheetArgument,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="An .xml file; else in exchange/.")
    ] = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Write recorded results as JUnit XML: a suite a student, a case a part."""
    from ..exchange.junit import junit
    from ..exchange.marked import read_marked
    from ..machine.files import write_atomically

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheet(sheet)
        path = output or folder / OUTPUT / f"{sheet}-junit.xml"
        write_atomically(path, junit(read_marked(course, gradebook, chosen)))
        print(path)


@export.command("classroom")
def export_classroom(
    sheet: SheetArgument,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="A folder; else one in exchange/.")
    ] = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Write the workflow of a GitHub Classroom template, and recorded results as it reads them."""
    from ..exchange.classroom_files import write_results, write_template
    from ..exchange.marked import read_marked

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheet(sheet)
        target = output or folder / OUTPUT / f"{sheet}-classroom"
        paths = write_template(chosen, target / "template")
        paths += write_results(read_marked(course, gradebook, chosen), target / "results")
        for path in paths:
            print(path)
