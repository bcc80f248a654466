"""What several commands take, and the course that they open."""

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from collections.abc import Generator

    from .config import Course
    from .gradebook import Gradebook

CourseOption = Annotated[Path, typer.Option("--course", "-c", help="The course folder.")]
SheetArguments = Annotated[
    list[str] | None, typer.Argument(help="Names of sheets; all when none is given.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]


@contextmanager
def opened(folder: Path) -> "Generator[tuple[Course, Gradebook]]":
    """The course of a folder and its gradebook, which is closed at the end.

    Raises:
        CourseError: a file of the course is missing, unreadable, or cannot be meant.
    """
    from .config import read_course
    from .gradebook import Gradebook

    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        yield course, gradebook
