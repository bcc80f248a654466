"""A table of points and feedback for systems that we know nothing of."""

import csv
import io
from pathlib import Path

from ..machine.files import write_atomically
from ..text.escape import for_spreadsheet
from .marked import Marked
from .worksheet import BOM


def hand_back(marked: Marked, folder: Path) -> list[Path]:
    """Writes a line for everybody of the roster; where there are no points, the cell is empty."""
    path = folder / f"{marked.sheet.name}.csv"
    write_atomically(path, table(marked))
    return [path]


def table(marked: Marked) -> str:
    """The text of the table; the columns of the roster come first."""
    out = io.StringIO()
    writer = csv.writer(out, quoting=csv.QUOTE_ALL, lineterminator="\r\n")
    more: list[str] = []
    if marked.course.students:
        more = [for_spreadsheet(column) for column, _ in marked.course.students[0].more]
    writer.writerow(["student", "name", *more, "points", "out_of", "status", "feedback"])
    for result in marked.results:
        student = result.student
        row = [student.id, for_spreadsheet(student.name)]
        row += [for_spreadsheet(text) for _, text in student.more]
        points = "" if result.points is None else f"{result.points:g}"
        row += [points, f"{marked.out_of:g}", result.status]
        row.append(for_spreadsheet("\n".join(marked.lines(result))) if result.verdicts else "")
        writer.writerow(row)
    return BOM + out.getvalue()
