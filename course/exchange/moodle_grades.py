"""For Moodle: its grading worksheet with points and comments, and zips of files for everybody."""

from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

from ..machine.console import say
from ..machine.files import write_atomically
from ..settings.config import Student
from .marked import Marked
from .members import Member, members
from .packing import write_zip
from .scale import scale
from .worksheet import Worksheet, digits_at_end


def hand_back(
    marked: Marked, worksheet: Worksheet, folder: Path, *, convert: bool = False
) -> list[Path]:
    """Writes the filled worksheet, and a zip with the feedback pages; their paths.

    Raises:
        CourseError: the worksheet has nobody of the roster, lacks a column, or has other points.
    """
    listed = members(marked.course, worksheet, worksheet.rows)
    filled = filled_worksheet(marked, worksheet, listed, convert=convert)
    grades = folder / f"{marked.sheet.name}-moodle.csv"
    write_atomically(grades, filled.text())

    files = files_for(worksheet, listed, marked.pages())
    return [grades, write_zip(folder / f"{marked.sheet.name}-moodle-feedback.zip", files)]


def filled_worksheet(
    marked: Marked, worksheet: Worksheet, listed: Sequence[Member], *, convert: bool = False
) -> Worksheet:
    """The worksheet with points and comments of everybody who has results.

    All other cells stay as they are, also those of people who handed in nothing. A grade that is
    not complete is an empty cell.
    """
    grade = worksheet.column("grade")
    rows: list[tuple[str, ...]] = []
    for member in listed:
        result = None if member.student is None else marked.result(member.student.id)
        if result is None:
            rows.append(member.row)
            continue
        most = worksheet.cell(member.row, "most")
        points = scale(marked.out_of, most, str(worksheet.path), convert=convert)
        cells = list(member.row)
        cells[grade] = points.text(result.points)
        if worksheet.has("feedback"):
            cells[worksheet.column("feedback")] = "<br>".join(map(escape, marked.lines(result)))
        rows.append(tuple(cells))
    return worksheet.with_rows(rows)


def files_for(
    worksheet: Worksheet, listed: Iterable[Member], files: Iterable[tuple[Student, Path]]
) -> dict[str, bytes]:
    """What goes into a zip of feedback files: each in the folder that Moodle takes for its student.

    Who is not in the worksheet is said.
    """
    folders: dict[str, str] = {}
    for member in listed:
        if member.student is not None:
            folders[member.student.id] = _folder(worksheet, member.row)
    found: dict[str, bytes] = {}
    for student, path in files:
        if student.id in folders:
            found[f"{folders[student.id]}/{path.name}"] = path.read_bytes()
        else:
            say(f"{student.id} is not in {worksheet.path}; {path} is not in the zip.")
    return found


def _folder(worksheet: Worksheet, row: Sequence[str]) -> str:
    """The folder of a participant; with `_` at its end, Moodle before 4.1 takes it, too."""
    number = digits_at_end(row[worksheet.column("number")])
    name = worksheet.cell(row, "name") or "Participant"
    plain = name.replace("_", " ").replace("/", " ").replace("\\", " ").strip(". ")
    return f"{plain}_{number}_assignsubmission_file_"
