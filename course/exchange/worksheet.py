"""A table of people that a system exported: read by its headings, written back as it was."""

import csv
import io
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import CourseError
from ..settings.text_file import SEPARATORS, csv_rows, text_of
from .headings import HEADINGS

BOM = "\ufeff"
DIGITS_AT_END = re.compile(r"\d+$")


@dataclass(frozen=True)
class Worksheet:
    """A CSV file of a system.

    Attributes:
        path: Its file.
        columns: Its headings.
        rows: Its lines, each as long as the headings.
        separator: What stands between two cells.
        start: The mark of UTF-8 that it begins with, or nothing.
        ending: How its lines end.
    """

    path: Path
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    separator: str
    start: str
    ending: str

    def has(self, purpose: str) -> bool:
        """Whether there is a column for it."""
        return self._place(purpose) is not None

    def column(self, purpose: str) -> int:
        """The place of the column that is for `grade`, `feedback` and the like.

        Raises:
            CourseError: there is none whose heading we know.
        """
        place = self._place(purpose)
        if place is None:
            known = ", ".join(HEADINGS[purpose])
            raise CourseError(
                f"{self.path}: no column is called {known}; "
                f"the first line has: {', '.join(self.columns)}"
            )
        return place

    def cell(self, row: Sequence[str], purpose: str) -> str:
        """What a row has in that column; empty where there is no such column."""
        place = self._place(purpose)
        return "" if place is None else row[place].strip()

    def cells(self, row: Sequence[str], *purposes: str) -> tuple[str, ...]:
        """What a row has in all columns for these purposes, without empty ones."""
        headings: set[str] = set()
        for purpose in purposes:
            headings.update(HEADINGS[purpose])
        found: list[str] = []
        for column, cell in zip(self.columns, row, strict=True):
            if _plain(column) in headings and cell.strip():
                found.append(cell.strip())
        return tuple(found)

    def _place(self, purpose: str) -> int | None:
        plain = [_plain(column) for column in self.columns]
        for heading in HEADINGS[purpose]:
            if heading in plain:
                return plain.index(heading)
        return None

    def with_rows(self, rows: Sequence[Sequence[str]]) -> "Worksheet":
        """The same with other lines."""
        return replace(self, rows=tuple(map(tuple, rows)))

    def with_columns(self, columns: Sequence[str]) -> "Worksheet":
        """The same under other headings."""
        return replace(self, columns=tuple(columns))

    def text(self) -> str:
        """The file's text."""
        out = io.StringIO()
        writer = csv.writer(out, delimiter=self.separator, lineterminator=self.ending)
        writer.writerow(self.columns)
        writer.writerows(self.rows)
        return self.start + out.getvalue()


def read_worksheet(path: Path) -> Worksheet:
    """A table as a system wrote it.

    Raises:
        CourseError: it is not there, or no CSV file in UTF-8.
    """
    text = text_of(path, "export it from the system that has the assignment")
    rows = list(_filled(path, text))
    if not rows:
        raise CourseError(f"{path} is empty; export it again")
    columns = rows[0]
    lines: list[tuple[str, ...]] = []
    for row in rows[1:]:
        if any(row[len(columns) :]):
            raise CourseError(f"{path}: a line has {len(row)} cells for {len(columns)} columns")
        lines.append((*row, *[""] * (len(columns) - len(row)))[: len(columns)])
    first = text.partition("\n")[0]
    return Worksheet(
        path,
        columns,
        tuple(lines),
        separator=max(SEPARATORS, key=first.count),
        start=BOM if path.read_bytes().startswith(BOM.encode()) else "",
        ending="\r\n" if first.endswith("\r") else "\n",
    )


def _filled(path: Path, text: str) -> Iterator[tuple[str, ...]]:
    for row in csv_rows(path, text):
        if any(cell.strip() for cell in row.cells):
            yield tuple(row.cells)


def _plain(heading: str) -> str:
    return " ".join(heading.split()).casefold()


def digits_at_end(cell: str) -> str:
    """The number of `Participant 12345`, whatever the language; empty where there is none."""
    found = DIGITS_AT_END.search(cell.strip())
    return found[0] if found else ""
