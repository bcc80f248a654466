"""Marks for the parts that are marked by hand, entered one by one or from a CSV file."""

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from ...solutions.plain_number import plain_number
from ..errors import CourseError
from ..ledger.gradebook import Gradebook, Mark
from ..machine.files import write_atomically
from ..settings.config import Course
from ..settings.text_file import csv_rows, text_of
from ..text.escape import for_spreadsheet, from_spreadsheet
from .by_hand import ByHand, by_hand, every_answer, the_one
from .grades import BOM

__all__ = [
    "ByHand",
    "by_hand",
    "every_answer",
    "read_csv",
    "read_ticks",
    "the_one",
    "to_csv",
    "write_csv",
]
COLUMNS: tuple[str, ...] = (
    "student", "sheet", "part", "points", "out_of",
    "comment", "ticks", "answer", "key", "rubric", "answer_id", "code",
)  # fmt: skip
NEEDED = (
    "student",
    "sheet",
    "part",
    "points",
    "answer_id",
)  # the others are for the marker to read
ID = "id-"  # in front of an answer's id: no spreadsheet takes the whole for a number or a date


def to_csv(found: Sequence[ByHand], *, blind: bool = False) -> str:
    """One line for every answer; fill in points and comment, and read it back.

    With `blind`, the code of the variant stands in the place of the student.
    """
    out = io.StringIO()
    writer = csv.DictWriter(out, COLUMNS, quoting=csv.QUOTE_ALL, lineterminator="\n")
    writer.writeheader()
    lines = sorted(found, key=_by_code) if blind else found
    for one in lines:
        writer.writerow(_row(one, blind=blind))
    return out.getvalue()


def _by_code(one: ByHand) -> tuple[str, str, str]:
    """Within each part: the order of the roster would tell who it is."""
    return one.sheet, one.part.variable, one.code


def _row(one: ByHand, *, blind: bool) -> dict[str, str]:
    points = ""
    comment = ""
    ticks = ""
    if one.mark is not None:
        comment = one.mark.comment
        if not one.waits and one.mark.points is not None:
            points = f"{one.mark.points:g}"
            ticks = one.mark.ticks
    rubric = [f"({i}) {worth:g}: {text}" for i, (worth, text) in enumerate(one.rubric, 1)]
    return {
        "student": one.code if blind else one.student,
        "sheet": one.sheet,
        "part": one.part.variable,
        "points": points,
        "out_of": f"{one.part.points:g}",
        "comment": for_spreadsheet(comment),
        "answer": for_spreadsheet(one.answer),
        "key": for_spreadsheet(one.key),
        "rubric": for_spreadsheet("; ".join(rubric)),
        "ticks": ticks,
        "answer_id": f"{ID}{one.answer_id}",
        "code": one.code,
    }


def write_csv(found: Sequence[ByHand], path: Path, *, blind: bool = False) -> None:
    """The lines of `to_csv` as a file that spreadsheets, too, take for UTF-8.

    Raises:
        CourseError: a file is there already; it may hold marks.
    """
    if path.exists():
        raise CourseError(f"{path} is already there and may hold marks; name another file")
    write_atomically(path, BOM + to_csv(found, blind=blind))


def read_csv(
    path: Path,
    course: Course,
    found: Sequence[ByHand],
    gradebook: Gradebook,
    *,
    marker: str = "",
) -> int:
    """Enters all marks of a file, or none; lines that say nothing new are passed over.

    A comment alone leaves points that an answer has as they are.

    Returns:
        How many were entered.

    Raises:
        CourseError: a line cannot be entered; the sentence names it.
    """
    marks: list[Mark] = []
    for line, row in _rows(path):
        try:
            mark = _read_mark(course, found, row)
        except CourseError as error:
            raise CourseError(f"{path}, line {line}: {error}; nothing was entered") from error
        if mark is not None:
            marks.append(mark)
    gradebook.save_marks(marks, author=marker)
    return len(marks)


def _rows(path: Path) -> Iterator[tuple[int, dict[str, str]]]:
    """The rows of a file with their lines; a cell that is not there is empty."""
    text = text_of(path, "`kinegrade marks write` makes it")
    rows = csv_rows(path, text)
    heading = next(rows, None)
    columns: list[str] = []
    if heading is not None:
        # A script that took the file for plain UTF-8 leaves our mark of it in the first heading.
        columns = [cell.strip().strip(BOM + '"').lower() for cell in heading.cells]
    for name in NEEDED:
        if name not in columns:
            raise CourseError(
                f"{path}: the column {name!r} is missing; `kinegrade marks write` has all columns"
            )
    for row in rows:
        cells: dict[str, str] = {"comment": "", "ticks": ""}
        cells |= dict.fromkeys(NEEDED, "")
        cells.update(zip(columns, row.cells, strict=False))  # a row may be shorter
        yield row.first, cells


def _read_mark(course: Course, found: Sequence[ByHand], row: Mapping[str, str]) -> Mark | None:
    """The mark of a line; None where it holds nothing but the comment that is there already."""
    points = row["points"].strip()
    ticks = read_ticks(row["ticks"])
    comment = from_spreadsheet(row["comment"])
    if not points and not ticks and not comment.strip():
        return None
    one = the_one(course, found, row["student"].strip(), row["part"].strip(), row["sheet"].strip())
    if not points and not ticks and one.mark is not None and comment == one.mark.comment:
        return None
    if row["answer_id"].strip().removeprefix(ID) != one.answer_id:
        raise CourseError(
            f"{one.student}, {one.part.variable}: the answer changed since this file was written"
        )
    if points:
        return one.new_mark(_points(points), comment, ticks)
    if not ticks and one.mark is not None and not one.waits:
        return replace(one.mark, comment=comment)
    return one.new_mark(None, comment, ticks)


def read_ticks(text: str) -> tuple[int, ...]:
    """The lines of a rubric as somebody types them: "1,3", "1; 3" or "1 3".

    Raises:
        CourseError: something else than numbers of lines.
    """
    numbers = text.replace(",", " ").replace(";", " ").split()
    for number in numbers:
        if not number.isdecimal():
            raise CourseError(f"ticks take numbers of lines, such as 1,3, got {text[:20]!r}")
    return tuple(int(number) for number in numbers)


def _points(text: str) -> float:
    points = plain_number(text.replace(",", "."))
    if points is None:
        raise CourseError(f"points take a number, got {text[:20]!r}")
    return points
