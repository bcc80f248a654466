"""The commands that exchange files with other systems: collect, handout, handback, export."""

from pathlib import Path
from typing import Annotated

import typer

from .console import say
from .options import CourseOption

exchange = typer.Typer()
ZoneOption = Annotated[
    str,
    typer.Option(
        "--zone",
        help="The time zone of times that name none, such as Europe/Berlin; "
        "else that of this machine.",
    ),
]
WorksheetOption = Annotated[
    Path | None,
    typer.Option("--worksheet", help="The table of people that the system exports, as CSV."),
]


@exchange.command()
def collect(
    download: Annotated[Path, typer.Argument(help="A zip file or a folder.")],
    system: Annotated[
        str,
        typer.Option(
            "--from",
            help="moodle, canvas, gradescope, nbgrader or classroom; else it is found out.",
        ),
    ] = "",
    worksheet: WorksheetOption = None,
    sheet: Annotated[
        str, typer.Option("--sheet", help="The sheet, for files that do not say which.")
    ] = "",
    zone: ZoneOption = "",
    folder: CourseOption = Path(),
) -> None:
    """Take what was handed in from a system's download into submitted/, with the times."""
    from .config import read_course
    from .exchange.collection import collect as take_in
    from .exchange.moments import zone_named

    taken = take_in(read_course(folder), download, system, worksheet, sheet, zone_named(zone))
    for path in taken.paths:
        print(path)  # noqa: T201 - data of the command
    for sentence in (*taken.conflicts, *taken.notes):
        say(sentence)
    say(f"{len(taken.paths)} files taken, {taken.unchanged} unchanged.")
    if taken.conflicts:
        raise typer.Exit(1)
