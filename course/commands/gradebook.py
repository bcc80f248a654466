"""The commands `kinegrade gradebook ...`: what happened to a sheet, and a copy of it all."""

from pathlib import Path
from typing import Annotated

import typer

from ..machine.console import say
from .options import CourseOption, GradebookOption, SheetArguments, opened

book = typer.Typer(help="What the gradebook holds, and copies of it.", no_args_is_help=True)


@book.command("history")
def show_history(
    student: Annotated[str, typer.Argument(help="An id of roster.csv.")],
    sheets: SheetArguments = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """All that happened to a student's sheets: when (UTC), by whom, what and why."""
    from ..text.escape import printable

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheets(tuple(sheets or ()))
        histories = {sheet.name: gradebook.history(student, sheet.name) for sheet in chosen}
        if not any(histories.values()):
            course.student(student)  # who left the course still has a history
        for sheet, events in histories.items():
            for event in events:
                line = f"{event.at[:19]}  {sheet}  {event.author}  {event.what}"
                if event.reason:
                    line += f"  ({event.reason})"
                print(printable(line))


@book.command("copy")
def copy_gradebook(
    target: Annotated[str, typer.Argument(help="A new file, or a URL as of --gradebook.")],
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Copy all to a new place: a backup at any time, or the way from one database to another."""
    from ..ledger.copying import copy_ledger
    from ..ledger.gradebook import Gradebook

    is_new = not Path(target).exists()
    try:
        with opened(folder, place) as (_, gradebook), Gradebook(target) as other:
            changes = copy_ledger(gradebook.database, other.database)
            say(f"{changes} changes copied from {gradebook.place} to {other.place}.")
    except BaseException:
        if is_new:  # half a copy is none
            Path(target).unlink(missing_ok=True)
        raise
