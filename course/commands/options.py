"""What several commands take, and the course that they open."""

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from collections.abc import Generator

    from ..ledger.gradebook import Gradebook
    from ..settings.config import Course

CourseOption = Annotated[Path, typer.Option("--course", "-c", help="The course folder.")]
SheetArguments = Annotated[
    list[str] | None, typer.Argument(help="Names of sheets; all when none is given.")
]
GradebookOption = Annotated[
    str,
    typer.Option(
        "--gradebook",
        envvar="KINEGRADE_GRADEBOOK",
        help="A file, or postgresql://user@host/database; else what course.toml says, "
        "else gradebook.sqlite in the course folder.",
        show_envvar=True,
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]


@contextmanager
def opened(folder: Path, place: str = "") -> "Generator[tuple[Course, Gradebook]]":
    """The course of a folder and its gradebook, which is closed at the end.

    What a killed run left in the folder is cleared away first.

    Raises:
        CourseError: a file of the course is missing, unreadable, or cannot be meant.
    """
    from ..ledger.gradebook import gradebook_of
    from ..machine.leftovers import cleared
    from ..settings.config import read_course

    course = read_course(folder)
    with cleared(folder), gradebook_of(course, place) as gradebook:
        yield course, gradebook
