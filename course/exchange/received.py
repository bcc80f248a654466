"""submitted/received.csv: when each file came in, as the system says that it came from.

A file is named as it lies in submitted/<student>/, also one that a newer one replaced.
"""

import csv
import io
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from ..errors import CourseError
from ..files import write_atomically
from ..text_file import csv_rows, text_of

FILE = "received.csv"
COLUMNS = ("student", "sheet", "file", "received")


@dataclass(frozen=True)
class Receipt:
    """One file of a student and the time at which it came in, with a zone."""

    student: str
    sheet: str
    file: str
    received: datetime


def read_receipts(folder: Path) -> list[Receipt]:
    """What submitted/received.csv of a course folder says; nothing where it is not there.

    Raises:
        CourseError: a line of it cannot be meant.
    """
    path = folder / "submitted" / FILE
    if not path.exists():
        return []
    rows = csv_rows(path, text_of(path, "`kinegrade collect` writes it"))
    heading = next(rows, None)
    if heading is None:
        return []
    columns = tuple(cell.strip().lower() for cell in heading.cells)
    found: list[Receipt] = []
    for row in rows:
        cells = dict(zip(columns, map(str.strip, row.cells), strict=False))
        if any(cells.values()):
            found.append(_receipt(f"{path}, line {row.first}", cells))
    return found


def _receipt(place: str, cells: dict[str, str]) -> Receipt:
    missing = [column for column in COLUMNS if not cells.get(column)]
    if missing:
        raise CourseError(f"{place}: {missing[0]} is missing; a line takes {','.join(COLUMNS)}")
    try:
        received = datetime.fromisoformat(cells["received"])
    except ValueError:
        received = None
    if received is None or received.tzinfo is None:
        raise CourseError(
            f"{place}: received takes a time with its zone such as 2026-11-23T23:59:00+01:00, "
            f"got {cells['received']!r}"
        )
    return Receipt(cells["student"], cells["sheet"], cells["file"], received)


def write_receipts(folder: Path, receipts: Iterable[Receipt]) -> None:
    """Writes them sorted, all or nothing; where nothing changed, the file stays as it is."""
    lines = sorted((one.student, one.sheet, one.file, one.received.isoformat()) for one in receipts)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerows(lines)
    path = folder / "submitted" / FILE
    if lines and not (path.exists() and path.read_bytes() == out.getvalue().encode()):
        write_atomically(path, out.getvalue())
