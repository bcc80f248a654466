"""When files were handed in: as submitted/received.csv says, else by the time of the file.

A file is named as it lies in submitted/<student>/, also one that a newer one replaced.
"""

import csv
import io
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, datetime, tzinfo
from pathlib import Path

from ..errors import CourseError
from ..machine.files import write_atomically
from ..settings.text_file import csv_rows, text_of
from ..settings.times import read_time

FILE = "received.csv"
COLUMNS = ("student", "sheet", "file", "received")


@dataclass(frozen=True)
class Receipt:
    """One file of a student and the time at which it came in, with a zone."""

    student: str
    sheet: str
    file: str
    received: datetime


def read_receipts(folder: Path, zone: tzinfo = UTC) -> list[Receipt]:
    """What submitted/received.csv of a course folder says; nothing where it is not there.

    `zone` is that of times that name none.

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
            found.append(_receipt(f"{path}, line {row.first}", cells, zone))
    return found


def listed_times(folder: Path, zone: tzinfo = UTC) -> dict[tuple[str, str, str], datetime]:
    """Student, sheet and name of a file to when it came in; of several lines the latest counts.

    Raises:
        CourseError: as `read_receipts`.
    """
    found: dict[tuple[str, str, str], datetime] = {}
    for one in read_receipts(folder, zone):
        key = (one.student, one.sheet, one.file)
        found[key] = max(one.received, found.get(key, one.received))
    return found


def _receipt(place: str, cells: dict[str, str], zone: tzinfo) -> Receipt:
    missing = [column for column in COLUMNS if not cells.get(column)]
    if missing:
        raise CourseError(f"{place}: {missing[0]} is missing; a line takes {','.join(COLUMNS)}")
    try:
        received = read_time(cells["received"], zone)
    except CourseError as error:
        raise CourseError(f"{place}: {error}") from error
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


def file_time(path: Path) -> datetime:
    """When a file was last written."""
    return datetime.fromtimestamp(path.stat().st_mtime, UTC)
