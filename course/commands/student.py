"""The commands of students, which need no course folder: check and practice."""

from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

from ..machine.console import say


def check(
    file: Annotated[
        Path, typer.Argument(help="Your notebook, .py, .json, .csv, .mat, .m or .zip.")
    ],
    sheet: Annotated[
        Path | None, typer.Option("--sheet", help="The notebook as it was handed out.")
    ] = None,
    exercises: Annotated[
        Path | None,
        typer.Option(
            "--exercises",
            help="A folder with exercise files of the course, which are run; "
            "else exercises/ beside the notebook and in this folder.",
        ),
    ] = None,
) -> None:
    """Look at one's own answers, as far as the sheet's mode allows; needs no course folder."""
    from ..student.check import check_file, remark_lines

    handout, found = check_file(file, sheet, exercises)
    for line in remark_lines(found):
        print(line)
    say(handout.told())
    if not all(remark.ok for remark in found):
        raise typer.Exit(1)


def practice(
    exercise: Annotated[str, typer.Argument(help="The name of an exercise, such as rrt.")],
    seed: Annotated[
        int | None, typer.Option("--seed", min=0, help="Which variant; else another every time.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="An .ipynb or a .pdf file.")
    ] = None,
    solution: Annotated[
        bool, typer.Option("--solution", help="Write the worked solution beside it, too.")
    ] = False,
    exercises: Annotated[
        Path | None,
        typer.Option(
            "--exercises", help="A folder with exercise files of a course, which are run."
        ),
    ] = None,
) -> None:
    """Write a sheet with fresh numbers to practise on; needs no course folder."""
    from ..student.practice import practice as draw
    from ..student.practice import write_practice

    made = draw(exercise, seed, exercises)
    first, *others = write_practice(made, output, solution=solution)
    for path in (first, *others):
        print(path)
    say(f"Seed {made.seed}: --seed {made.seed} gives these numbers again.")
    if first.suffix == ".ipynb":
        say(f"When you have answered: kinegrade check {quote(str(first))}")
