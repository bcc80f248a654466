"""The course's secret, from which all numbers follow: the file `secret`, or KINEGRADE_SECRET."""

import os
import secrets
from pathlib import Path

from ..machine.console import say
from ..machine.files import write_atomically
from ..settings.config import Course, CourseError

FILE = "secret"
VARIABLE = "KINEGRADE_SECRET"
LEAST = 16  # characters
OTHERS = 0o077  # what a file allows those who do not own it


def read_secret(course: Course) -> str:
    """The secret; an older course.toml may still hold it.

    It is looked for only where numbers are to be drawn.

    Raises:
        CourseError: there is none, two differ, or it is too short; the sentence never repeats it.
    """
    path = course.folder / FILE
    found = _from_environment(path) or _from_file(path)
    older = course.settings.secret
    if older is not None:
        return _with_older(course.folder, found, older)
    if found is None:
        raise CourseError(
            f"the course has no secret: {VARIABLE} is not set, and {path} is not there. "
            "All numbers follow from it, so a new one means other numbers: put the backup back. "
            f"Where nothing was handed out yet, `kinegrade init {course.folder}` writes one"
        )
    return found


def _with_older(folder: Path, found: str | None, older: str) -> str:
    """The secret of a course whose course.toml holds one."""
    settings = folder / "course.toml"
    path = folder / FILE
    if found is None:
        say(
            f"{settings} holds the secret. Moved to the file {path}, without key and quotes, "
            "it does the same, and course.toml can be shared."
        )
    elif found != older:
        where = str(path)
        if _variable():
            where = VARIABLE
        raise CourseError(
            f"{settings} and {where} hold different secrets; keep the one that the sheets were "
            "drawn from, and take the other out"
        )
    return older


def write_secret(folder: Path) -> Path | None:
    """Writes a new secret into a course folder that has none.

    Returns:
        Its file, or None where there was one.
    """
    path = folder / FILE
    if path.exists():
        return None
    write_atomically(path, secrets.token_hex(32) + "\n", mode=0o600)
    return path


def _variable() -> str:
    """The variable's text; CI sets it to nothing where it was not given the secret."""
    return os.environ.get(VARIABLE, "").strip()


def _from_environment(path: Path) -> str | None:
    text = _variable()
    if not text:
        return None
    if path.is_file() and path.read_bytes().strip() != text.encode():
        say(f"{VARIABLE} is taken in place of {path}, which holds another secret.")
    return _long_enough(VARIABLE, text)


def _from_file(path: Path) -> str | None:
    try:
        text = path.read_text(encoding="utf-8-sig").strip()
        mode = path.stat().st_mode
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError) as error:
        raise CourseError(f"{path} cannot be read as UTF-8 text: {error}") from error
    if os.name == "posix" and mode & OTHERS:
        say(
            f"{path} can be read by others on this machine; "
            f"`chmod 600 {path}` keeps the secret to yourself."
        )
    return _long_enough(str(path), text)


def _long_enough(where: str, text: str) -> str:
    if len(text) < LEAST:
        raise CourseError(f"{where}: a secret takes at least {LEAST} characters, got {len(text)}")
    return text
