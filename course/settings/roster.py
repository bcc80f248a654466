"""roster.csv: who takes part, in the order of the file, or the line that cannot be meant."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import CourseError
from ..text.escape import printable
from .roster_columns import Columns, roster_columns
from .text_file import SEPARATORS, Row, csv_rows, text_of

SAFE_NAME = re.compile(r"[A-Za-z0-9]([A-Za-z0-9._-]{0,62}[A-Za-z0-9_-])?")
DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE)
"""No file can be called so on Windows."""
FORMULA = re.compile(r'="?([^"]*)"?')
"""How people keep a spreadsheet from taking an id for a number: ="00123"."""


@dataclass(frozen=True)
class Student:
    """One line of roster.csv; `more` are its other columns, name and text of each."""

    id: str
    name: str
    more: tuple[tuple[str, str], ...] = ()


def read_roster(path: Path) -> Iterator[Student]:
    """Students in the order of roster.csv, which takes the columns student and name.

    Or those that other systems export: an id number or a login, first and last names, Canvas's
    gradebook. Control characters in a name, which a page or a terminal would obey, are replaced.

    Raises:
        CourseError: it is missing or unreadable, or a line of it cannot be meant.
    """
    text = text_of(path, "a course folder takes a roster.csv with the columns student,name")
    rows = csv_rows(path, text)
    heading = _heading(rows)
    columns = _columns(path, heading)
    people: dict[int, list[str]] = {}
    for row in rows:
        cells = _cells(path, row, heading)
        if any(cells) and _name(columns, cells).casefold() not in columns.nobody:
            people[row.first] = cells

    place_of_id = _filled(columns.ids, [*people.values()])
    seen: dict[str, tuple[int, str]] = {}
    for line, cells in people.items():
        student = _without_formula(cells[place_of_id])
        place = f"{path}, line {line}"
        _refuse_as_folder_name(place, student)
        folder = student.casefold()  # ADA and ada are one folder on some machines
        if folder in seen:
            raise CourseError(f"{place}: {_stands_already(student, *seen[folder])}")
        seen[folder] = line, student
        more = [(heading[i], cells[i]) for i in columns.more if i != place_of_id]
        yield Student(student, _name(columns, cells) or student, tuple(more))


def _stands_already(student: str, line: int, there: str) -> str:
    said = f"student {student!r} is already in line {line}"
    if there == student:
        return said
    return f"{said}, as {there!r}: an id names a folder, in which capitals do not count"


def _name(columns: Columns, cells: Sequence[str]) -> str:
    return " ".join(filter(None, [cells[i] for i in columns.names]))


def _heading(rows: Iterator[Row]) -> list[str]:
    """The first line that is not empty."""
    for row in rows:
        heading = [cell.strip() for cell in row.cells]
        if any(heading):
            return heading
    return []


def _columns(path: Path, heading: Sequence[str]) -> Columns:
    """The columns of ids and names, which have to be there, and the others."""
    found = ", ".join(heading) or "nothing"
    small = [cell.casefold() for cell in heading]
    for column in ("student", "name"):
        if small.count(column) > 1:
            raise CourseError(
                f"{path}: the column {column!r} is there twice; the first line has: {found}"
            )
    columns = roster_columns(heading)
    for column, places in (("student", columns.ids), ("name", columns.names)):
        if not places:
            raise CourseError(
                f"{path}: the column {column!r} is missing; the first line has: {found}"
            )
    return columns


def _filled(places: Sequence[int], people: Sequence[Sequence[str]]) -> int:
    """The first column of ids in which everybody has one that can name a folder."""
    for i in places:
        ids = [_without_formula(cells[i]) for cells in people]
        if all(map(SAFE_NAME.fullmatch, ids)):
            return i
    return places[0]


def _without_formula(cell: str) -> str:
    found = FORMULA.fullmatch(cell)
    return found[1] if found else cell


def _cells(path: Path, row: Row, heading: Sequence[str]) -> list[str]:
    """The cells of a row, one a heading, with single spaces and nothing that is not seen."""
    if any(row.cells[len(heading) :]):
        raise CourseError(
            f"{path}, line {row.first}: {len(row.cells)} cells for {len(heading)} columns; "
            'a name with a comma takes quotes: "Lovelace, Ada"'
        )
    if any(map(_is_a_line_too_many, row.cells)):
        raise CourseError(
            f"{path}, line {row.first}: a cell goes on to line {row.last} and holds what looks "
            "like the next student; a quotation mark may be left open"
        )
    cells = [""] * len(heading)
    for i, text in enumerate(row.cells[: len(heading)]):  # a row may be shorter
        cells[i] = printable(" ".join(text.split()))
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
