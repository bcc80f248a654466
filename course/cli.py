"""The command `kinegrade`. stdout carries data, stderr progress and complaints.

Exit 0: done. 1: `check` found something wrong, or another command could not do its work. 2: wrong usage.
"""

import io
import sys
from contextlib import contextmanager
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING, Annotated

import typer

from ..solutions.errors import KinegradeError
from .complaints import debugging, one_of_each
from .console import progress, say

if TYPE_CHECKING:
    from collections.abc import Generator

    from .config import Course
    from .gradebook import Gradebook

app = typer.Typer(
    help="Personal exercise sheets, worked solutions and marking for the robot Jacobian.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
marks = typer.Typer(help="Marks for the parts that are marked by hand.", no_args_is_help=True)
app.add_typer(marks, name="marks")
CourseOption = Annotated[Path, typer.Option("--course", "-c", help="The course folder.")]
STOPPED = 130  # what typer makes of Ctrl-C
SheetArguments = Annotated[
    list[str] | None, typer.Argument(help="Names of sheets; all when none is given.")
]


def main() -> None:
    """Runs the command line; a complaint is one sentence, never a traceback."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a console without ✓ shows a question mark
    try:
        with one_of_each():
            app()
    except KinegradeError as error:
        sys.stderr.write(f"kinegrade: {error}\n")
        sys.exit(1)
    except OSError as error:
        sys.stderr.write(f"kinegrade: {error.filename or 'a file'}: {error.strerror or error}\n")
        sys.exit(1)
    except Exception as error:
        if debugging():
            raise
        said = f"{type(error).__name__}: {error}"
        sys.stderr.write(
            f"kinegrade: this is our fault, not yours: {said} (KINEGRADE_DEBUG=1 shows where)\n"
        )
        sys.exit(1)
    except SystemExit as stop:
        if stop.code == STOPPED:
            sys.stderr.write(
                "\nkinegrade: stopped; what was done is kept, and the same command goes on from there\n"
            )
        raise


@app.command()
def demo(
    folder: Annotated[Path, typer.Argument(help="Where the course is built.")] = Path(
        "demo-course"
    ),
) -> None:
    """Build a course of 12 students, hand in what a class would, and mark it."""
    from .demo import run_demo

    run_demo(folder)


@app.command()
def init(folder: Annotated[Path, typer.Argument(help="A new course folder.")]) -> None:
    """Write a commented course.toml, a roster.csv, the course's secret, and a .gitignore that keeps it to yourself."""
    from .new_course import write_course

    for path in write_course(folder):
        print(path)
    say(f"Fill in roster.csv, then: kinegrade generate --course {quote(str(folder))}")


@app.command()
def generate(sheets: SheetArguments = None, course: CourseOption = Path()) -> None:
    """Draw every student's numbers and write the notebooks that are not there yet."""
    from .sheets import generate as write_sheets

    with _opened(course) as (opened, gradebook):
        chosen = opened.sheets(tuple(sheets or ()))
        if not opened.students:
            raise KinegradeError(
                f"{course / 'roster.csv'} has no students yet; add lines with an id and a name"
            )
        with progress("Writing sheets", len(opened.students) * len(chosen)) as step:
            released = write_sheets(opened, gradebook, chosen, step)
        for sheet in released:
            if sheet.new:
                print(sheet.path)
        new = sum(sheet.new for sheet in released)
        say(f"{new} new, {len(released) - new} left as they were released.")


@app.command()
def grade(
    sheets: SheetArguments = None,
    course: CourseOption = Path(),
    accept_change: Annotated[
        bool,
        typer.Option(
            "--accept-change", help="Mark by reference answers that changed since the hand-out."
        ),
    ] = False,
    again: Annotated[
        bool, typer.Option("--again", help="Mark anew what is marked already.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
) -> None:
    """Mark what was handed in; write grades.csv, feedback and the report."""
    from .marking import mark_sheets, show
    from .tables import results_json

    with _opened(course) as (opened, gradebook):
        marked = mark_sheets(
            opened,
            gradebook,
            opened.sheets(tuple(sheets or ())),
            accept_change=accept_change,
            again=again,
        )
        if as_json:
            print(results_json([result for _, results in marked for result in results]))
        else:
            show(opened, marked)


@app.command()
def check(
    file: Annotated[Path, typer.Argument(help="Your notebook, .json, .csv or .mat.")],
    sheet: Annotated[
        Path | None, typer.Option("--sheet", help="The notebook as it was handed out.")
    ] = None,
    exercises: Annotated[
        Path | None,
        typer.Option(
            "--exercises",
            help="A folder with exercise files of the course, which are run; else exercises/ beside the notebook "
            "and in this folder.",
        ),
    ] = None,
) -> None:
    """Look at one's own answers, as far as the sheet's mode allows; needs no course folder."""
    from .check import check_file
    from .escape import printable

    handout, found = check_file(file, sheet, exercises)
    for remark in found:
        sentence, *typed = remark.text.split("\n")
        print(f"{'✓' if remark.ok else '✗'} {remark.part:28} {printable(sentence)}")
        for line in typed:
            print(f"{'':30} {printable(line)}")
    told = {
        "practice": "Practice sheet: everything is told but the reference values.",
        "graded": "Graded sheet: this tells whether answers can be read and fit each other, not if they are right.",
        "exam": "Exam sheet: this tells whether answers can be read, nothing more.",
    }
    say(told[handout.mode])
    raise typer.Exit(0 if all(remark.ok for remark in found) else 1)


@marks.command("list")
def list_marks(sheets: SheetArguments = None, course: CourseOption = Path()) -> None:
    """Answers that wait for a mark, with the key and the rubric."""
    from .marks import by_hand
    from .tables import show_by_hand

    with _opened(course) as (opened, gradebook):
        show_by_hand(
            [
                one
                for one in by_hand(opened, gradebook, opened.sheets(tuple(sheets or ())))
                if one.waits
            ]
        )


@marks.command("set")
def set_mark(
    student: Annotated[str, typer.Argument(help="An id of roster.csv.")],
    part: Annotated[str, typer.Argument(help="The variable of the part.")],
    points: Annotated[float, typer.Argument(help="Points, up to those of the part.")],
    comment: Annotated[str, typer.Option("--comment", help="A sentence for the student.")] = "",
    sheet: Annotated[
        str | None, typer.Option("--sheet", help="The sheet, where the part is on several.")
    ] = None,
    course: CourseOption = Path(),
) -> None:
    """Enter one mark."""
    from .marks import by_hand, enter

    with _opened(course) as (opened, gradebook):
        found = by_hand(opened, gradebook, opened.sheets((sheet,) if sheet else ()))
        enter([*found], gradebook, student, part, points, comment)
        say("Entered. `kinegrade report` writes the pages with it.")


@marks.command("write")
def write_marks(
    file: Annotated[Path, typer.Argument(help="A new .csv file.")],
    sheets: SheetArguments = None,
    course: CourseOption = Path(),
) -> None:
    """Write a CSV file with a line for every answer; fill in points and comment, then `marks read`."""
    from .marks import by_hand, write_csv

    with _opened(course) as (opened, gradebook):
        found = [*by_hand(opened, gradebook, opened.sheets(tuple(sheets or ())))]
        write_csv(found, file)
        print(file)
        say(f"{len(found)} answers, {sum(one.waits for one in found)} of them wait for a mark.")


@marks.command("read")
def read_marks(
    file: Annotated[Path, typer.Argument(help="The file of `marks write`, with points filled in.")],
    course: CourseOption = Path(),
) -> None:
    """Enter the marks of a CSV file, all or none."""
    from .marks import by_hand, read_csv

    with _opened(course) as (opened, gradebook):
        entered = read_csv(file, [*by_hand(opened, gradebook, opened.sheets())], gradebook)
        say(f"{entered} marks entered. `kinegrade report` writes the pages with them.")


@app.command()
def report(course: CourseOption = Path()) -> None:
    """Write grades.csv, feedback and the report again from the gradebook, without marking."""
    from .marking import write_recorded

    with _opened(course) as (opened, gradebook):
        print(write_recorded(opened, gradebook))


@app.command()
def validate(
    exercises: Annotated[
        list[str] | None,
        typer.Argument(
            help="Names or files of exercises; when none is given, all that the course uses, or without a course all."
        ),
    ] = None,
    course: CourseOption = Path(),
    draws: Annotated[
        int, typer.Option("--draws", min=1, help="How many draws of each are looked at.")
    ] = 20,
    seeds: Annotated[
        int | None, typer.Option("--seeds", min=1, hidden=True, help="The same as --draws.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
) -> None:
    """Prove that exercises can be solved, marked and told apart from nonsense and known mistakes."""
    from .proof.validate import chosen
    from .proof.validate import validate as look
    from .proof.validation_table import show_validations, validations_json

    draws = seeds or draws
    paths = chosen(tuple(exercises or ()), course)
    with progress("Validating", len(paths) * draws) as step:
        validations = look(paths, draws, step)
    if as_json:
        print(validations_json(validations))
    else:
        show_validations(validations)
    raise typer.Exit(1 if any(validation.failures for validation in validations) else 0)


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="What the exercise is called, such as tip_speed.")],
    course: CourseOption = Path(),
) -> None:
    """Write an exercise file that runs, with comments, into the course's exercises/ folder."""
    from .new_exercise import write_exercise

    path = write_exercise(name, course)
    print(path)
    where = "" if course == Path() else f" --course {quote(str(course))}"
    say(f"See it: kinegrade preview {name}{where}   Prove it: kinegrade validate {name}{where}")


@app.command()
def preview(
    exercise: Annotated[str, typer.Argument(help="The name or the file of an exercise.")],
    seed: Annotated[int, typer.Option("--seed", min=0, help="Which draw is shown.")] = 0,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="An .html file.")] = None,
    course: CourseOption = Path(),
    show: Annotated[bool, typer.Option("--open/--no-open", help="Open it in a browser.")] = True,
) -> None:
    """Write sheet, worked solution and the feedback of every known mistake as one page."""
    from ..exercises.files.finding import load
    from .files import write_atomically
    from .proof.preview import preview_page
    from .proof.validate import chosen

    (file,) = chosen((exercise,), course)
    made = load(file)
    path = output or Path(f"{made.slug}-preview.html")
    write_atomically(path, preview_page(made, seed))
    print(path)
    if show and sys.stdout.isatty():
        typer.launch(str(path))


@app.command()
def plot(
    robot: Annotated[str, typer.Argument(help="A robot of the catalogue, such as puma560.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="A .png, .svg or .pdf file.")
    ] = None,
) -> None:
    """Draw workspace and singularities of a robot."""
    from ..grader.figures.maps import describe, picture
    from ..solutions.robots import robot as find_robot
    from .files import write_atomically

    arm = find_robot(robot)
    path = output or Path(f"{robot}.png")
    write_atomically(path, picture(arm, path.suffix))
    print(path)
    say(describe(arm))


@contextmanager
def _opened(folder: Path) -> "Generator[tuple[Course, Gradebook]]":
    from .config import read_course
    from .gradebook import Gradebook

    course = read_course(folder)
    with Gradebook(folder / "gradebook.sqlite") as gradebook:
        yield course, gradebook
