"""roster.csv: who takes part, in the order of the file, or the line that cannot be meant."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from .errors import CourseError
from .escape import printable
from .text_file import SEPARATORS, Row, csv_rows, text_of

SAFE_NAME = re.compile(r"[A-Za-z0-9]([A-Za-z0-9._-]{0,62}[A-Za-z0-9_-])?")
DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE)
"""No file can be called so on Windows."""
COLUMNS = ("student", "name")


@dataclass(frozen=True)
class Student:
    """One line of roster.csv; `more` are its other columns, name and text of each."""

    id: str
    name: str
    more: tuple[tuple[str, str], ...] = ()


def read_roster(path: Path) -> Iterator[Student]:
    """Students in the order of roster.csv, which takes the columns student and name.

    Control characters in a name, which a page or a terminal would obey, are replaced.

    Raises:
        CourseError: it is missing or unreadable, or a line of it cannot be meant.
    """
    text = text_of(path, "a course folder takes a roster.csv with the columns student,name")
    rows = csv_rows(path, text)
    columns = _columns(path, rows)
    others = [column for column in columns if column not in ("", *COLUMNS)]
    seen: dict[str, int] = {}
    for row in rows:
        cells = _cells(path, row, columns)
        if not any(cells.values()):
            continue
        student = cells["student"]
        place = f"{path}, line {row.first}"
        _refuse_as_folder_name(place, student)
        folder = student.casefold()  # ADA and ada are one folder on some machines
        if folder in seen:
            raise CourseError(f"{place}: student {student!r} is already in line {seen[folder]}")
        seen[folder] = row.first
        more = [(column, text) for column, text in cells.items() if column in others]
        yield Student(student, cells["name"] or student, tuple(more))


def _columns(path: Path, rows: Iterator[Row]) -> list[str]:
    """The names in the first line that is not empty; those that we look for in small letters."""
    heading: list[str] = []
    for row in rows:
        heading = [cell.strip() for cell in row.cells]
        if any(heading):
            break
    columns: list[str] = []
    for cell in heading:
        small = cell.lower()
        columns.append(small if small in COLUMNS else cell)
    found = ", ".join(heading) or "nothing"
    for column in COLUMNS:
        if columns.count(column) == 0:
            raise CourseError(
                f"{path}: the column {column!r} is missing; the first line has: {found}"
            )
        if columns.count(column) > 1:
            raise CourseError(
                f"{path}: the column {column!r} is there twice; the first line has: {found}"
            )
    return columns


def _cells(path: Path, row: Row, columns: Sequence[str]) -> Mapping[str, str]:
    """The cells of a row by column, with single spaces and nothing that is not seen."""
    if any(row.cells[len(columns) :]):
        raise CourseError(
            f"{path}, line {row.first}: {len(row.cells)} cells for {len(columns)} columns; "
            'a name with a comma takes quotes: "Lovelace, Ada"'
        )
    if any(map(_is_a_line_too_many, row.cells)):
        raise CourseError(
            f"{path}, line {row.first}: a cell goes on to line {row.last} and holds what looks "
            "like the next student; a quotation mark may be left open"
        )
    cells = dict.fromkeys(columns, "")
    for column, text in zip(columns, row.cells, strict=False):  # a row may be shorter
        cells[column] = printable(" ".join(text.split()))
    return cells


def _is_a_line_too_many(cell: str) -> bool:
    """Whether a cell has line breaks, as spreadsheets allow, and cells within its lines."""
    return len(cell.splitlines()) > 1 and any(mark in cell for mark in SEPARATORS)


def _refuse_as_folder_name(place: str, student: str) -> None:
    if not SAFE_NAME.fullmatch(student) or DEVICE.fullmatch(student):
        raise CourseError(
            f"{place}: a student takes an id of letters, digits, '.', '_' and '-' "
            f"(it names a folder, so CON and the like are out), got {student!r}"
        )
