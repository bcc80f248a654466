"""The commands for a course as a whole: demo, init, generate, report."""

from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

from ...solutions.errors import KinegradeError
from ..machine.console import progress, say
from .options import CourseOption, GradebookOption, SheetArguments, opened

INIT = (
    "Write a commented course.toml, a roster.csv, the course's secret, "
    "and a .gitignore that keeps it to yourself."
)


def demo(
    folder: Annotated[Path, typer.Argument(help="Where the course is built.")] = Path(
        "demo-course"
    ),
) -> None:
    """Build a course of 12 students, hand in what a class would, and mark it."""
    from .demo import run_demo

    run_demo(folder)


def init(
    folder: Annotated[Path, typer.Argument(help="A new course folder.")],
    last: Annotated[
        Path | None,
        typer.Option(
            "--from",
            help="A course of another year: its settings and exercises are taken over, "
            "nothing of its people.",
        ),
    ] = None,
) -> None:
    """Write the files of a new course."""
    from .new_course import write_course
    from .next_year import write_next_course

    for path in write_course(folder) if last is None else write_next_course(folder, last):
        print(path)
    say(f"Fill in roster.csv, then: kinegrade generate --course {quote(str(folder))}")


def generate(
    sheets: SheetArguments = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Draw every student's numbers and write the notebooks that are not there yet."""
    from ..handing_out.generate import generate as write_sheets

    with opened(folder, place) as (course, gradebook):
        chosen = course.sheets(tuple(sheets or ()))
        if not course.students:
            raise KinegradeError(
                f"{folder / 'roster.csv'} has no students yet; add lines with an id and a name"
            )
        with progress("Writing sheets", len(course.students) * len(chosen)) as step:
            released = write_sheets(course, gradebook, chosen, step)
        for sheet in released:
            if sheet.new:
                print(sheet.path)
        new = sum(sheet.new for sheet in released)
        say(f"{new} new, {len(released) - new} left as they were released.")


def report(folder: CourseOption = Path(), place: GradebookOption = "") -> None:
    """Write grades.csv, feedback and the report again from the gradebook, without marking."""
    from ..marking.written import write_recorded

    with opened(folder, place) as (course, gradebook):
        print(write_recorded(course, gradebook))
