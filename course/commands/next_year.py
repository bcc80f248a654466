"""A course for another year: settings and exercises of the last one, and nothing of its people."""

import re
import tomllib
from pathlib import Path
from shutil import copyfile
from typing import Any

from ..machine.console import say
from ..machine.files import write_atomically
from ..settings.config import CourseError, read_settings
from ..settings.text_file import text_of
from ..variants.secret import write_secret
from .new_course import ignore_file

LEFT_OUT = ("__pycache__",)
SECRET = re.compile(r"[^\S\n]*secret[^\S\n]*=[^\n]*(?:\n|\Z)")
DATED = re.compile(r"[^\S\n]*(?:[\w.\"'-]+\.)?(release|deadline|closes|late_percent)[^\S\n]*=")
DATE = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}")
QUOTED = re.compile(r"\"[^\"]*\"|'[^']*'")
OF_LAST_YEAR = re.compile(r"[^\S\n]*(?:url|show_solutions)[^\S\n]*=")
"""The gradebook of last year on a server, and solutions shown after a deadline that is to come."""


def write_next_course(folder: Path, last: Path) -> list[Path]:
    """A course folder with the settings and exercises of another, a new secret and an empty roster.

    Dates, the address of a gradebook and shown solutions are commented out and named. Gradebook,
    secret, roster, submissions, marks and whatever else lies in the old folder stay there.

    Returns:
        The files that were written.

    Raises:
        CourseError: the folder holds a course already, or the other is none that can be read.
    """
    settings = folder / "course.toml"
    if settings.exists():
        raise CourseError(f"{settings} is already there; init never overwrites a course")
    read_settings(last / "course.toml")
    text, changed = _settings_text(last / "course.toml")

    written = _copied(last / "exercises", folder / "exercises")
    roster = folder / "roster.csv"
    if not roster.exists():
        write_atomically(roster, "student,name\n")
        written.append(roster)
    written += ignore_file(folder / ".gitignore")
    secret = write_secret(folder)
    if secret is not None:
        written.append(secret)
    write_atomically(settings, text)  # last: with it, the folder is a course
    for line in changed:
        say(f"{settings}: commented out, to be set anew: {line}")
    return [*written, settings]


def _settings_text(path: Path) -> tuple[str, list[str]]:
    """course.toml without secret, and with the lines commented out that are of last year alone.

    Raises:
        CourseError: what is left is no course.toml; such lines have to be whole by themselves.
    """
    kept: list[str] = []
    changed: list[str] = []
    for line in text_of(path, "").splitlines():
        if SECRET.match(f"{line}\n"):
            continue
        if _is_of_last_year(line):
            changed.append(line.strip())
            line = f"# {line}"  # noqa: PLW2901 - it stays where it was
        kept.append(line)
    text = "\n".join(kept) + "\n"
    try:
        settings: dict[str, Any] = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise CourseError(
            f"{path}: a date, the secret or the address of the gradebook takes a line of its own, "
            f"so that it can be left out: {error}"
        ) from error
    if "secret" in settings:
        raise CourseError(f"{path}: the secret takes a line of its own, so that it can be left out")
    return text, changed


def _is_of_last_year(line: str) -> bool:
    if DATED.match(line) or OF_LAST_YEAR.match(line):
        return True
    code = QUOTED.sub("", line).partition("#")[0]
    return DATE.search(code) is not None


def _copied(source: Path, target: Path) -> list[Path]:
    """The exercise files and what they take, without links, hidden files and caches."""
    written: list[Path] = []
    for path in sorted(source.rglob("*")):
        inner = path.relative_to(source)
        hidden = [part for part in inner.parts if part.startswith(".") or part in LEFT_OUT]
        if hidden or path.is_dir():
            continue
        if path.is_symlink():
            say(f"{path} is a link and is not copied.")
            continue
        copy = target / inner
        copy.parent.mkdir(parents=True, exist_ok=True)
        copyfile(path, copy)
        written.append(copy)
    return written
