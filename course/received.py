"""When files were handed in, as submitted/received.csv says; other files have their own times."""

from datetime import UTC, datetime, tzinfo
from pathlib import Path

from .config import CourseError
from .text_file import csv_rows, text_of

FILE = "received.csv"
COLUMNS = ("student", "sheet", "file", "received")


def listed_times(submitted: Path, zone: tzinfo = UTC) -> dict[tuple[str, str, str], datetime]:
    """Student, sheet and name of a file to when it came in; nothing where no such list is.

    Of several lines for a file the latest counts. Times that name no zone are of `zone`.

    Raises:
        CourseError: a column is missing, or a time cannot be read; the sentence names the line.
    """
    path = submitted / FILE
    if not path.exists():
        return {}
    rows = csv_rows(path, text_of(path, ""))
    heading = next(rows, None)
    columns = [cell.strip().lower() for cell in heading.cells] if heading else []
    for column in COLUMNS:
        if column not in columns:
            raise CourseError(
                f"{path}: the column {column!r} is missing; it takes all of {COLUMNS}"
            )

    found: dict[tuple[str, str, str], datetime] = {}
    for row in rows:
        cells = dict(zip(columns, map(str.strip, row.cells), strict=False))
        if not any(cells.values()):
            continue
        time = _time(f"{path}, line {row.first}", cells.get("received", ""), zone)
        key = (cells["student"], cells["sheet"], cells["file"])
        found[key] = max(time, found.get(key, time))
    return found


def _time(place: str, text: str, zone: tzinfo) -> datetime:
    try:
        time = datetime.fromisoformat(text)
    except ValueError:
        raise CourseError(
            f"{place}: received takes a time such as 2026-11-23T23:59:00+01:00, got {text!r}"
        ) from None
    return time if time.tzinfo else time.replace(tzinfo=zone)
