"""The command `kinegrade`. stdout carries data, stderr progress and complaints.

Exit 0: done. 1: `check` found something wrong, or another command could not do its work.
2: wrong usage.
"""

import io
import sys
from pathlib import Path
from shlex import quote
from typing import Annotated, NoReturn

import typer

from ..solutions.errors import KinegradeError
from .commands.exchange import exchange
from .commands.grade import grade
from .commands.gradebook import book
from .commands.marks import marks
from .commands.options import CourseOption, GradebookOption, JsonOption, SheetArguments, opened
from .commands.plot import plot
from .commands.term import term
from .machine.complaints import debugging, one_of_each
from .machine.console import progress, say

app = typer.Typer(
    help="Personal exercise sheets, worked solutions and marking for the robot Jacobian.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.add_typer(marks, name="marks")
app.add_typer(book, name="gradebook")
app.add_typer(term)
app.add_typer(exchange)
STOPPED = 130  # what typer makes of Ctrl-C


def main() -> None:
    """Runs the command line; a complaint is one sentence, never a traceback."""
    _show_what_the_console_can()
    try:
        with one_of_each():
            app()
    except KinegradeError as error:
        _stop(str(error))
    except OSError as error:
        _stop(f"{error.filename or 'a file'}: {error.strerror or error}")
    except Exception as error:
        if debugging():
            raise
        said = f"{type(error).__name__}: {error}"
        _stop(f"this is our fault, not yours: {said} (KINEGRADE_DEBUG=1 shows where)")
    except SystemExit as stop:
        if stop.code == STOPPED:
            sys.stderr.write(
                "\nkinegrade: stopped; what was done is kept, "
                "and the same command goes on from there\n"
            )
        raise


def _show_what_the_console_can() -> None:
    """A console without ✓ shows a question mark."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def _stop(complaint: str) -> NoReturn:
    sys.stderr.write(f"kinegrade: {complaint}\n")
    sys.exit(1)


@app.command()
def demo(
    folder: Annotated[Path, typer.Argument(help="Where the course is built.")] = Path(
        "demo-course"
    ),
) -> None:
    """Build a course of 12 students, hand in what a class would, and mark it."""
    from .commands.demo import run_demo

    run_demo(folder)


@app.command(
    help="Write a commented course.toml, a roster.csv, the course's secret, "
    "and a .gitignore that keeps it to yourself."
)
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
    from .commands.new_course import write_course
    from .commands.next_year import write_next_course

    for path in write_course(folder) if last is None else write_next_course(folder, last):
        print(path)
    say(f"Fill in roster.csv, then: kinegrade generate --course {quote(str(folder))}")


@app.command()
def generate(
    sheets: SheetArguments = None,
    folder: CourseOption = Path(),
    place: GradebookOption = "",
) -> None:
    """Draw every student's numbers and write the notebooks that are not there yet."""
    from .handing_out.generate import generate as write_sheets

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


app.command()(grade)


@app.command()
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
    from .student.check import check_file, remark_lines

    handout, found = check_file(file, sheet, exercises)
    for line in remark_lines(found):
        print(line)
    say(handout.told())
    if not all(remark.ok for remark in found):
        raise typer.Exit(1)


@app.command()
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
    from .student.practice import practice as draw
    from .student.practice import write_practice

    made = draw(exercise, seed, exercises)
    first, *others = write_practice(made, output, solution=solution)
    for path in (first, *others):
        print(path)
    say(f"Seed {made.seed}: --seed {made.seed} gives these numbers again.")
    if first.suffix == ".ipynb":
        say(f"When you have answered: kinegrade check {quote(str(first))}")


@app.command()
def report(folder: CourseOption = Path(), place: GradebookOption = "") -> None:
    """Write grades.csv, feedback and the report again from the gradebook, without marking."""
    from .marking.written import write_recorded

    with opened(folder, place) as (course, gradebook):
        print(write_recorded(course, gradebook))


@app.command(
    help="Prove that exercises can be solved, marked and told apart from nonsense "
    "and known mistakes."
)
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
    from .proof.validate import chosen
    from .proof.validate import validate as look
    from .proof.validation_table import show_validations, validations_json

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


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="What the exercise is called, such as tip_speed.")],
    folder: CourseOption = Path(),
) -> None:
    """Write an exercise file that runs, with comments, into the course's exercises/ folder."""
    from .commands.new_exercise import write_exercise

    path = write_exercise(name, folder)
    print(path)
    where = ""
    if folder != Path():
        where = f" --course {quote(str(folder))}"
    say(f"See it: kinegrade preview {name}{where}   Prove it: kinegrade validate {name}{where}")


@app.command()
def preview(
    exercise: Annotated[str, typer.Argument(help="The name or the file of an exercise.")],
    seed: Annotated[int, typer.Option("--seed", min=0, help="Which draw is shown.")] = 0,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="An .html file.")] = None,
    folder: CourseOption = Path(),
    show: Annotated[bool, typer.Option("--open/--no-open", help="Open it in a browser.")] = True,
) -> None:
    """Write sheet, worked solution and the feedback of every known mistake as one page."""
    from ..exercises.files.finding import load
    from .machine.files import write_atomically
    from .proof.preview import preview_page
    from .proof.validate import chosen

    (file,) = chosen((exercise,), folder)
    made = load(file)
    path = output or Path(f"{made.slug}-preview.html")
    write_atomically(path, preview_page(made, seed))
    print(path)
    if show and sys.stdout.isatty():
        typer.launch(str(path))


app.command()(plot)
