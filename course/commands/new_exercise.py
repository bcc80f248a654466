"""`kinegrade new`: an exercise file that runs as it stands, to be changed line by line."""

import re
from importlib.resources import files
from pathlib import Path

from ...exercises.files.finding import exercise_files
from ..machine.files import write_atomically
from ..settings.config import CourseError, refuse_no_folder

SLUG = re.compile(r"[a-z][a-z0-9_]{0,39}")


def write_exercise(name: str, folder: Path) -> Path:
    """exercises/<name>.py in a folder, commented; never over a file that is there.

    Raises:
        CourseError: the name is none for an exercise, or is taken; or there is no such folder.
    """
    if not SLUG.fullmatch(name):
        raise CourseError(
            "an exercise takes a name of small letters, digits and '_', "
            f"which starts the names of its variables, such as tip_speed; got {name!r}"
        )
    refuse_no_folder(folder)
    path = folder / "exercises" / f"{name}.py"
    if path.exists():
        raise CourseError(f"{path} is already there; new never overwrites a file")
    if name in exercise_files():
        raise CourseError(
            f"{name} is an exercise that comes with the package; another name keeps the two apart"
        )
    template = files("kinegrade.course.commands").joinpath("exercise.txt")
    write_atomically(path, template.read_text(encoding="utf-8").replace("@NAME@", name))
    return path
