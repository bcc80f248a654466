"""For Canvas: a gradebook with the column of a sheet, and a zip of comment files."""

import re
from collections.abc import Sequence
from pathlib import Path

from ..errors import CourseError
from ..machine.files import write_atomically
from . import canvas
from .archive import Contents, opened_download
from .marked import Marked
from .members import members
from .packing import write_zip
from .people import People
from .scale import scale
from .worksheet import Worksheet

ASSIGNMENT = re.compile(r"(?P<title>.*) \(\d+\)", re.DOTALL)
POINTS_POSSIBLE = "points possible"
EXCUSED = "EX"


def hand_back(
    marked: Marked,
    worksheet: Worksheet,
    folder: Path,
    *,
    convert: bool = False,
    column: str = "",
    download: Path | None = None,
) -> list[Path]:
    """Writes the gradebook and, for the submissions of a download, a zip of comments; their paths.

    Raises:
        CourseError: the gradebook has nobody of the roster, or no column for the sheet.
    """
    grades = folder / f"{marked.sheet.name}-canvas.csv"
    write_atomically(grades, gradebook(marked, worksheet, column, convert=convert).text())
    paths = [grades]
    if download is not None:
        people = People(marked.course.students, canvas.persons(worksheet))
        with opened_download(download) as contents:
            files = comments(marked, contents, people)
        paths.append(write_zip(folder / f"{marked.sheet.name}-canvas-comments.zip", files))
    return paths


def gradebook(
    marked: Marked, worksheet: Worksheet, column: str = "", *, convert: bool = False
) -> Worksheet:
    """Who everybody is and the column of the sheet, as Canvas takes it back.

    Columns of other assignments are left out, so that Canvas leaves them as they are. A cell of
    somebody who handed in nothing stays as it was exported.
    """
    place = _column(marked, worksheet, column)
    section = worksheet.column("section")
    points = scale(marked.out_of, _possible(worksheet, place), str(worksheet.path), convert=convert)
    rows: list[tuple[str, ...]] = [row for row in worksheet.rows if _is_possible(worksheet, row)]
    for member in members(marked.course, worksheet, canvas.student_rows(worksheet)):
        if member.student is None:
            continue
        result = marked.result(member.student.id)
        cells = list(member.row)
        if result is not None:
            cells[place] = EXCUSED if result.excused else points.text(result.points)
        rows.append(tuple(cells))
    kept = [*range(section + 1), place]
    short = worksheet.with_rows([[row[i] for i in kept] for row in rows])
    return short.with_columns([worksheet.columns[i] for i in kept])


def _column(marked: Marked, worksheet: Worksheet, column: str) -> int:
    """The place of the column `Title (id)` of a sheet, or of the one that is named."""
    assignments: list[str] = []
    found: list[int] = []
    for i, heading in enumerate(worksheet.columns):
        match = ASSIGNMENT.fullmatch(heading.strip())
        if match is None:
            continue
        assignments.append(heading)
        title = match["title"].casefold()
        if heading == column or (not column and title == marked.title.casefold()):
            found.append(i)
    if len(found) != 1:
        raise CourseError(
            f"{worksheet.path}: {len(found)} columns are called {column or marked.title!r}; "
            f"--column takes one of: {', '.join(assignments) or 'nothing, as there are none'}"
        )
    return found[0]


def _possible(worksheet: Worksheet, place: int) -> str:
    for row in worksheet.rows:
        if _is_possible(worksheet, row):
            return row[place]
    return ""


def _is_possible(worksheet: Worksheet, row: Sequence[str]) -> bool:
    return worksheet.cell(row, "name").casefold() == POINTS_POSSIBLE


def comments(marked: Marked, contents: Contents, people: People) -> dict[str, bytes]:
    """The feedback page of everybody who handed in, under the name that Canvas knows it by."""
    newest: dict[str, tuple[int, str]] = {}
    for upload in canvas.uploads(contents):
        found = canvas.FILE.fullmatch(upload.file.path.name)
        student = people.find(upload.owner)
        if found is None or student is None:
            continue
        start = upload.file.path.name.removesuffix(found["file"])
        number = int(found["attachment"])
        newest[student.id] = max(newest.get(student.id, (0, "")), (number, start))

    files: dict[str, bytes] = {}
    for student, page in marked.pages():
        if student.id in newest:
            _, start = newest[student.id]
            files[f"{start}{marked.sheet.name}.html"] = page.read_bytes()
    return files
