"""The command `kinegrade`. stdout carries data, stderr progress and complaints.

Exit 0: done. 1: `check` found something wrong, or another command could not do its work.
2: wrong usage.
"""

import io
import sys
from typing import Annotated, NoReturn

import typer

from ..solutions.errors import KinegradeError
from .commands.course import INIT, demo, generate, init, report
from .commands.exchange import exchange
from .commands.exercises import VALIDATE, new, preview, validate
from .commands.grade import grade
from .commands.gradebook import book
from .commands.marks import marks
from .commands.plot import plot
from .commands.student import check, practice
from .commands.term import term
from .machine.complaints import debugging, one_of_each

app = typer.Typer(
    help="Personal exercise sheets, worked solutions and marking for the robot Jacobian.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _print_version(asked: bool) -> None:
    if asked:
        from importlib.metadata import version

        sys.stdout.write(f"{version('kinegrade')}\n")
        raise typer.Exit


@app.callback()
def options(
    _: Annotated[
        bool,
        typer.Option(
            "--version", help="Print the version.", callback=_print_version, is_eager=True
        ),
    ] = False,
) -> None:
    """What goes before a command."""


app.command()(demo)
app.command(help=INIT)(init)
app.command()(generate)
app.command()(grade)
app.command()(check)
app.command()(practice)
app.command()(report)
app.command(help=VALIDATE)(validate)
app.command()(new)
app.command()(preview)
app.command()(plot)
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
    """A letter that a console does not have is shown as a question mark."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def _stop(complaint: str) -> NoReturn:
    sys.stderr.write(f"kinegrade: {complaint}\n")
    sys.exit(1)
