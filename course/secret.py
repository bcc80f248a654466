"""The course's secret, from which all numbers follow: the file `secret`, or KINEGRADE_SECRET, which replaces it."""

import os
import secrets
from pathlib import Path

from .config import Course, CourseError
from .console import say
from .files import write_atomically

FILE = "secret"
VARIABLE = "KINEGRADE_SECRET"
LEAST = 16  # characters
OTHERS = 0o077  # what a file allows those who do not own it


def read_secret(course: Course) -> str:
    """The secret, looked for only where numbers are to be drawn. An older course.toml may still hold it.

    Raises:
        CourseError: there is none, two differ, or it is too short; the sentence never repeats it.
    """
    path = course.folder / FILE
    found = _from_environment(path) or _from_file(path)
    older = course.settings.secret
    if found is None and older is None:
        raise CourseError(
            f"the course has no secret: {VARIABLE} is not set, and {path} is not there. All numbers follow from it, so "
            "a new one means other numbers: put the backup back. Where nothing was handed out yet, "
            f"`kinegrade init {course.folder}` writes one"
        )
    if found is None and older is not None:
        say(
            f"{course.folder / 'course.toml'} holds the secret. Moved to the file {path}, without key and quotes, it "
            "does the same, and course.toml can be shared."
        )
        return older
    if older is not None and older != found:
        where = VARIABLE if os.environ.get(VARIABLE, "").strip() else str(path)
        raise CourseError(
            f"{course.folder / 'course.toml'} and {where} hold different secrets; keep the one that the sheets were "
            "drawn from, and take the other out"
        )
    assert found is not None  # noqa: S101 - what else there is was dealt with
    return found


def write_secret(folder: Path) -> Path | None:
    """Writes a new secret into a course folder that has none; its file, or None where there is one."""
    path = folder / FILE
    if path.exists():
        return None
    write_atomically(path, secrets.token_hex(32) + "\n", mode=0o600)
    return path


def _from_environment(path: Path) -> str | None:
    """The variable; one that is set to nothing, as CI does for a secret it was not given, counts as not set."""
    text = os.environ.get(VARIABLE, "").strip()
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
            f"{path} can be read by others on this machine; `chmod 600 {path}` keeps the secret to yourself."
        )
    return _long_enough(str(path), text)


def _long_enough(where: str, text: str) -> str:
    if len(text) < LEAST:
        raise CourseError(f"{where}: a secret takes at least {LEAST} characters, got {len(text)}")
    return text
