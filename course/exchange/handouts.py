"""Personal sheets for other systems: a zip with a folder for every student."""

from pathlib import Path

from ..errors import CourseError
from ..machine.console import say
from ..settings.config import Course, Sheet, Student
from .members import members
from .moodle_grades import files_for
from .packing import write_zip
from .worksheet import Worksheet

SUFFIXES = (".ipynb", ".pdf", ".m")


def released_files(course: Course, sheet: Sheet) -> list[tuple[Student, Path]]:
    """What was generated of a sheet, with whose it is; who has none is said.

    Raises:
        CourseError: nothing was generated.
    """
    found: list[tuple[Student, Path]] = []
    without: list[str] = []
    for student in course.students:
        folder = course.folder / "released" / student.id
        paths = [folder / f"{sheet.name}{suffix}" for suffix in SUFFIXES]
        own = [(student, path) for path in paths if path.is_file()]
        found += own
        if not own:
            without.append(student.id)
    if not found:
        raise CourseError(
            f"nothing of sheet {sheet.name} is in released/; `kinegrade generate` writes it"
        )
    if without:
        say(f"Without a sheet: {', '.join(without)}. `kinegrade generate` adds them.")
    return found


def for_moodle(course: Course, sheet: Sheet, worksheet: Worksheet, folder: Path) -> Path:
    """A zip that Moodle takes with "Upload multiple feedback files in a zip"; its path.

    Raises:
        CourseError: nothing was generated, or the worksheet has nobody of the roster.
    """
    listed = members(course, worksheet, worksheet.rows)
    files = files_for(worksheet, listed, released_files(course, sheet))
    return write_zip(folder / f"{sheet.name}-moodle-sheets.zip", files)


def plain(course: Course, sheet: Sheet, folder: Path) -> Path:
    """A zip with a folder for every student, called by the id; its path.

    Raises:
        CourseError: nothing was generated.
    """
    files: dict[str, bytes] = {}
    for student, path in released_files(course, sheet):
        files[f"{student.id}/{path.name}"] = path.read_bytes()
    return write_zip(folder / f"{sheet.name}-sheets.zip", files)
