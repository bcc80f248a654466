"""A new course folder: settings with comments, a roster to fill in, a secret, and what to keep out of a repository."""

from importlib.resources import files
from pathlib import Path
from textwrap import wrap

from ..exercises.files.finding import exercise_files
from .config import CourseError, Settings, read_settings
from .console import say
from .files import write_atomically
from .secret import FILE, write_secret

ROSTER = "student,name\nstudent01,First Student\nstudent02,Second Student\n"
PRIVATE = (
    FILE,
    "gradebook.sqlite*",
    "released/",
    "solutions/",
    "submitted/",
    "feedback/",
    "report/",
    "grades*.csv",
)
"""What a course repository does not hold: it would give away the secret, the answers or somebody's marks."""


def course_text(title: str) -> str:
    """A commented course.toml."""
    template = (
        files("kinegrade.course").joinpath("templates/course.toml").read_text(encoding="utf-8")
    )
    known = "\n# ".join(wrap(", ".join(sorted(exercise_files())), 100))
    return template.replace("@TITLE@", title).replace("@EXERCISES@", known)


def write_course(folder: Path, title: str = "The robot Jacobian") -> list[Path]:
    """Completes a new course folder and returns the files it wrote; none that is there is overwritten.

    In a course that was cloned and has handed out nothing, what is missing is the secret.

    Raises:
        CourseError: the folder already holds a course with its secret, or one whose secret is lost.
    """
    settings = folder / "course.toml"
    if settings.exists():
        _refuse_what_is_complete(folder)
    written: list[Path] = []
    if not (folder / "roster.csv").exists():
        written += _written(folder / "roster.csv", ROSTER)
    written += _ignore_file(folder / ".gitignore")
    secret = write_secret(folder)
    written += [secret] if secret else []
    if not settings.exists():  # last: with it, the folder is a course
        written += _written(settings, course_text(title))
    return written


def _refuse_what_is_complete(folder: Path) -> None:
    settings = folder / "course.toml"
    if (folder / FILE).exists() or read_settings(settings).secret:
        raise CourseError(f"{settings} is already there; init never overwrites a course")
    if (folder / "released").exists() or _has_records(
        folder / "gradebook.sqlite", read_settings(settings)
    ):
        raise CourseError(
            f"{settings} is already there and has handed out sheets, but {folder / FILE} is not there; put the backup "
            "of the secret back, since from a new one follow other numbers"
        )


def _has_records(path: Path, settings: Settings) -> bool:
    """Whether numbers were drawn; a gradebook alone is made by every command that looks for one."""
    if not path.exists():
        return False
    from .gradebook import Gradebook  # brings SQLAlchemy

    with Gradebook(path) as gradebook:
        return any(gradebook.records(sheet.name) for sheet in settings.sheet)


def _written(path: Path, text: str) -> list[Path]:
    write_atomically(path, text)
    return [path]


def _ignore_file(path: Path) -> list[Path]:
    """Writes .gitignore; one that is there is left alone, and what it does not name is told."""
    if not path.exists():
        return _written(path, "\n".join(PRIVATE) + "\n")
    lines = {
        line.strip().strip("/")
        for line in path.read_text(encoding="utf-8", errors="replace").splitlines()
    }
    missing = [name for name in PRIVATE if name.strip("/") not in lines]
    if missing:
        say(f"{path} was there and is left alone; it should also name: {' '.join(missing)}")
    return []
