"""Marks and feedback for the systems that courses use, each in the form that it takes back."""

from dataclasses import dataclass
from pathlib import Path

from ..errors import CourseError
from . import canvas_grades, gradescope_back, moodle_grades, nbgrader_feedback, plain_csv
from .marked import Marked
from .worksheet import Worksheet, read_worksheet

SYSTEMS = ("moodle", "canvas", "gradescope", "nbgrader", "csv")
TABLES = {
    "moodle": "its grading worksheet (View all submissions, Download grading worksheet)",
    "canvas": "its gradebook (Grades, Export)",
}


@dataclass(frozen=True)
class Way:
    """How marks are handed back.

    Attributes:
        system: Which one.
        folder: Where the files are written.
        worksheet: The table that the system exported.
        download: Canvas's download of submissions, whose names the comments take.
        column: Canvas's column, where it is called otherwise than the sheet.
        convert: Whether points are converted to those of the system.
    """

    system: str
    folder: Path
    worksheet: Path | None = None
    download: Path | None = None
    column: str = ""
    convert: bool = False


def hand_back(marked: Marked, way: Way) -> list[Path]:
    """Writes files for a system; their paths.

    Raises:
        CourseError: the system is unknown, or its table is missing or not as it should be.
    """
    if way.system == "moodle":
        table = _table(way)
        return moodle_grades.hand_back(marked, table, way.folder, convert=way.convert)
    if way.system == "canvas":
        return canvas_grades.hand_back(
            marked,
            _table(way),
            way.folder,
            convert=way.convert,
            column=way.column,
            download=way.download,
        )
    if way.system == "gradescope":
        return gradescope_back.hand_back(marked, way.folder)
    if way.system == "nbgrader":
        return nbgrader_feedback.hand_back(marked, way.folder)
    if way.system == "csv":
        return plain_csv.hand_back(marked, way.folder)
    raise CourseError(f"--to takes one of {', '.join(SYSTEMS)}, got {way.system!r}")


def _table(way: Way) -> Worksheet:
    if way.worksheet is None:
        raise CourseError(f"--to {way.system} takes --worksheet FILE.csv, {TABLES[way.system]}")
    return read_worksheet(way.worksheet)
