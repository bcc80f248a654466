"""A new course folder: settings with comments, a roster to fill in, a secret, a .gitignore."""

from importlib.resources import files
from pathlib import Path
from textwrap import wrap

from ...exercises.files.finding import exercise_files
from ..machine.console import say
from ..machine.files import write_atomically
from ..settings.config import Course, CourseError, read_settings
from ..variants.secret import FILE, write_secret

ROSTER = "student,name\nstudent01,First Student\nstudent02,Second Student\n"
PRIVATE = (
    FILE, "gradebook.sqlite*",
    "released/", "solutions/", "submitted/", "feedback/", "report/", "exchange/",
    "grades*.csv",
)  # fmt: skip
"""What a course repository does not hold, as it would give away the secret, answers or marks."""


def course_text(title: str) -> str:
    """A commented course.toml."""
    template = files("kinegrade.course.commands").joinpath("course.toml")
    known = "\n# ".join(wrap(", ".join(sorted(exercise_files())), 100))
    text = template.read_text(encoding="utf-8")
    return text.replace("@TITLE@", title).replace("@EXERCISES@", known)


def write_course(folder: Path, title: str = "The robot Jacobian") -> list[Path]:
    """Completes a new course folder; no file that is there is overwritten.

    In a course that was cloned and has handed out nothing, what is missing is the secret.

    Returns:
        The files that were written.

    Raises:
        CourseError: the folder already holds a course with its secret, or one whose secret is lost.
    """
    settings = folder / "course.toml"
    roster = folder / "roster.csv"
    if settings.exists():
        _refuse_what_is_complete(folder, settings)

    written: list[Path] = []
    if not roster.exists():
        written += _written(roster, ROSTER)
    written += ignore_file(folder / ".gitignore")
    secret = write_secret(folder)
    if secret is not None:
        written.append(secret)
    if not settings.exists():  # last: with it, the folder is a course
        written += _written(settings, course_text(title))
    return written


def _refuse_what_is_complete(folder: Path, settings: Path) -> None:
    secret = folder / FILE
    if secret.exists() or read_settings(settings).secret:
        raise CourseError(f"{settings} is already there; init never overwrites a course")
    handed_out = (folder / "released").exists()
    if handed_out or _has_records(Course(folder, read_settings(settings), ())):
        raise CourseError(
            f"{settings} is already there and has handed out sheets, but {secret} is not there; "
            "put the backup of the secret back, since from a new one follow other numbers"
        )


def _has_records(course: Course) -> bool:
    """Whether numbers were drawn; a gradebook alone is made by every command that looks for one."""
    from ..ledger.gradebook import FILE as OWN  # brings SQLAlchemy
    from ..ledger.gradebook import gradebook_of

    elsewhere = course.settings.gradebook.url
    if not elsewhere and not (course.folder / OWN).exists():
        return False
    with gradebook_of(course) as gradebook:
        for sheet in course.settings.sheet:
            if gradebook.records(sheet.name) or gradebook.damaged(sheet.name):
                return True
    return False


def _written(path: Path, text: str) -> list[Path]:
    write_atomically(path, text)
    return [path]


def ignore_file(path: Path) -> list[Path]:
    """Writes .gitignore; one that is there is left alone, and what it does not name is told."""
    if not path.exists():
        return _written(path, "\n".join(PRIVATE) + "\n")
    text = path.read_text(encoding="utf-8", errors="replace")
    named = {line.strip().strip("/") for line in text.splitlines()}
    missing = [name for name in PRIVATE if name.strip("/") not in named]
    if missing:
        say(f"{path} was there and is left alone; it should also name: {' '.join(missing)}")
    return []
