"""When files were handed in: as submitted/received.csv says, else by the time of the file."""

from collections.abc import Mapping
from datetime import UTC, datetime, tzinfo
from pathlib import Path

from ..errors import CourseError
from ..text_file import csv_rows, text_of
from ..times import read_time

FILE = "received.csv"
COLUMNS = ("student", "sheet", "file", "received")
Listed = Mapping[tuple[str, str, str], datetime]
"""Student, sheet and the name of a file to when it came in."""


def listed_times(submitted: Path, zone: tzinfo = UTC) -> dict[tuple[str, str, str], datetime]:
    """What received.csv in the folder of submissions says; nothing where there is none.

    Raises:
        CourseError: a column is missing, or a time cannot be read; the sentence names the line.
    """
    path = submitted / FILE
    if not path.exists():
        return {}
    rows = csv_rows(path, text_of(path, ""))
    heading = next(rows, None)
    columns = [cell.strip().lower() for cell in heading.cells] if heading else []
    for name in COLUMNS:
        if name not in columns:
            raise CourseError(
                f"{path}: the column {name!r} is missing; it has {', '.join(COLUMNS)}"
            )

    found: dict[tuple[str, str, str], datetime] = {}
    for row in rows:
        cells = dict(zip(columns, row.cells, strict=False))
        if not any(cells.values()):
            continue
        try:
            time = read_time(cells.get("received", ""), zone)
        except CourseError as error:
            raise CourseError(f"{path}, line {row.first}: {error}") from error
        found[cells["student"], cells["sheet"], cells["file"]] = time
    return found


def file_time(path: Path) -> datetime:
    """When a file was last written."""
    return datetime.fromtimestamp(path.stat().st_mtime, UTC)
