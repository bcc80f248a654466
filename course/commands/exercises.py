"""The commands for writers of exercises: new, preview, validate."""

import sys
from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

from ..machine.console import progress, say
from .options import CourseOption, JsonOption

VALIDATE = (
    "Prove that exercises can be solved, marked and told apart from nonsense and known mistakes."
)


def new(
    name: Annotated[str, typer.Argument(help="What the exercise is called, such as tip_speed.")],
    folder: CourseOption = Path(),
) -> None:
    """Write an exercise file that runs, with comments, into the course's exercises/ folder."""
    from .new_exercise import write_exercise

    path = write_exercise(name, folder)
    print(path)
    where = ""
    if folder != Path():
        where = f" --course {quote(str(folder))}"
    say(f"See it: kinegrade preview {name}{where}   Prove it: kinegrade validate {name}{where}")


def preview(
    exercise: Annotated[str, typer.Argument(help="The name or the file of an exercise.")],
    seed: Annotated[int, typer.Option("--seed", min=0, help="Which draw is shown.")] = 0,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="An .html file.")] = None,
    folder: CourseOption = Path(),
    show: Annotated[bool, typer.Option("--open/--no-open", help="Open it in a browser.")] = True,
) -> None:
    """Write sheet, worked solution and the feedback of every known mistake as one page."""
    from ...exercises.files.finding import load
    from ..machine.files import write_atomically
    from ..proof.preview import preview_page
    from ..proof.validate import chosen

    (file,) = chosen((exercise,), folder)
    made = load(file)
    path = output or Path(f"{made.slug}-preview.html")
    write_atomically(path, preview_page(made, seed))
    print(path)
    if show and sys.stdout.isatty():
        typer.launch(str(path))


def validate(
    exercises: Annotated[
        list[str] | None,
        typer.Argument(
            help="Names or files of exercises; when none is given, all that the course uses, "
            "or without a course all."
        ),
    ] = None,
    folder: CourseOption = Path(),
    draws: Annotated[
        int, typer.Option("--draws", min=1, help="How many draws of each are looked at.")
    ] = 20,
    seeds: Annotated[
        int | None, typer.Option("--seeds", min=1, hidden=True, help="The same as --draws.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Prove exercises on many draws."""
    from ..proof.validate import chosen
    from ..proof.validate import validate as look
    from ..proof.validation_table import show_validations, validations_json

    draws = seeds or draws
    paths = chosen(tuple(exercises or ()), folder)
    with progress("Validating", len(paths) * draws) as step:
        validations = look(paths, draws, step)
    if as_json:
        print(validations_json(validations))
    else:
        show_validations(validations)
    if any(validation.failures for validation in validations):
        raise typer.Exit(1)
