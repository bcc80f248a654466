"""Marks for the parts that are marked by hand, entered one by one or from a CSV file."""

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from ..exercises.answers import Manual
from ..exercises.exercise import Part
from ..grader.marking.verdict import Finding, Status, Verdict
from ..solutions.plain_number import plain_number
from .by_hand import ByHand, answer_id, by_hand, the_one
from .errors import CourseError
from .escape import for_spreadsheet, from_spreadsheet
from .files import write_atomically
from .gradebook import Gradebook, Mark
from .text_file import csv_rows, text_of

__all__ = [
    "ByHand",
    "answer_id",
    "by_hand",
    "enter",
    "read_csv",
    "to_csv",
    "with_marks",
    "write_csv",
]
COLUMNS: tuple[str, ...] = (
    "student", "sheet", "part", "points", "out_of",
    "comment", "answer", "key", "rubric", "answer_id", "code",
)  # fmt: skip
NEEDED = (
    "student",
    "sheet",
    "part",
    "points",
    "answer_id",
)  # the others are for the marker to read
ID = "id-"  # in front of an answer's id: no spreadsheet takes the whole for a number or a date
CHANGED = "The answer changed since it was marked by hand; it waits for a new mark."


def with_marks(
    verdicts: Sequence[Verdict],
    student: str,
    marks: Mapping[tuple[str, str], Mark],
    parts: Mapping[str, Part],
) -> tuple[Verdict, ...]:
    """Verdicts with the marks that were entered by hand for these answers.

    Args:
        verdicts: of one student.
        student: whose verdicts they are.
        marks: of the sheet, by student and part.
        parts: of the sheet, by variable.
    """
    marked: list[Verdict] = []
    for verdict in verdicts:
        mark = marks.get((student, verdict.part))
        marked.append(_marked(verdict, mark, parts.get(verdict.part)))
    return tuple(marked)


def _marked(verdict: Verdict, mark: Mark | None, part: Part | None) -> Verdict:
    if mark is None or part is None or not isinstance(part.answer, Manual):
        return verdict
    if mark.answer != answer_id(verdict.answer):
        if verdict.points is None:
            return replace(verdict, findings=(Finding(CHANGED),))
        return verdict

    points = min(mark.points, verdict.out_of)  # the part may be worth less since
    status: Status = "partly"
    if points == verdict.out_of:
        status = "correct"
    elif points == 0:
        status = "incorrect"
    findings: tuple[Finding, ...] = ()
    if mark.comment:
        findings = (Finding(mark.comment),)
    return replace(verdict, status=status, points=points, findings=findings)


def enter(
    found: Sequence[ByHand],
    gradebook: Gradebook,
    student: str,
    part: str,
    points: float,
    comment: str = "",
    sheet: str = "",
) -> None:
    """Enters one mark for the answer as it is now.

    Raises:
        CourseError: nothing by that name is marked by hand, or the points are out of range.
    """
    one = the_one(found, student, part, sheet)
    gradebook.save_marks([one.new_mark(points, comment)])


def to_csv(found: Sequence[ByHand]) -> str:
    """One line for every answer; fill in points and comment, and read it back."""
    out = io.StringIO()
    writer = csv.DictWriter(out, COLUMNS, quoting=csv.QUOTE_ALL, lineterminator="\n")
    writer.writeheader()
    for one in found:
        writer.writerow(_row(one))
    return out.getvalue()


def _row(one: ByHand) -> dict[str, str]:
    assert isinstance(one.part.answer, Manual)  # noqa: S101 - that is what was looked for
    points = ""
    comment = ""
    if one.mark is not None:
        comment = one.mark.comment
        if not one.waits:
            points = f"{one.mark.points:g}"
    rubric = [f"{worth:g}: {text}" for worth, text in one.part.answer.rubric]
    return {
        "student": one.student,
        "sheet": one.sheet,
        "part": one.part.variable,
        "points": points,
        "out_of": f"{one.part.points:g}",
        "comment": for_spreadsheet(comment),
        "answer": for_spreadsheet(one.answer),
        "key": for_spreadsheet(one.key),
        "rubric": for_spreadsheet("; ".join(rubric)),
        "answer_id": f"{ID}{one.answer_id}",
        "code": one.code,
    }


def write_csv(found: Sequence[ByHand], path: Path) -> None:
    """The lines of `to_csv` as a file.

    Raises:
        CourseError: a file is there already; it may hold marks.
    """
    if path.exists():
        raise CourseError(f"{path} is already there and may hold marks; name another file")
    write_atomically(path, to_csv(found))


def read_csv(path: Path, found: Sequence[ByHand], gradebook: Gradebook) -> int:
    """Enters all marks of a file, or none; lines without points are passed over.

    Returns:
        How many were entered.

    Raises:
        CourseError: a line cannot be entered; the sentence names it.
    """
    marks: list[Mark] = []
    for line, row in _rows(path):
        if not row["points"].strip():
            continue
        try:
            marks.append(_read_mark(found, row))
        except CourseError as error:
            raise CourseError(f"{path}, line {line}: {error}; nothing was entered") from error
    gradebook.save_marks(marks)
    return len(marks)


def _rows(path: Path) -> Iterator[tuple[int, dict[str, str]]]:
    """The rows of a file with their lines; a cell that is not there is empty."""
    text = text_of(path, "`kinegrade marks write` makes it")
    rows = csv_rows(path, text)
    heading = next(rows, None)
    columns: list[str] = []
    if heading is not None:
        columns = [cell.strip().lower() for cell in heading.cells]
    for name in NEEDED:
        if name not in columns:
            raise CourseError(
                f"{path}: the column {name!r} is missing; `kinegrade marks write` has all columns"
            )
    for row in rows:
        cells: dict[str, str] = {"comment": ""}
        cells |= dict.fromkeys(NEEDED, "")
        cells.update(zip(columns, row.cells, strict=False))  # a row may be shorter
        yield row.first, cells


def _read_mark(found: Sequence[ByHand], row: Mapping[str, str]) -> Mark:
    one = the_one(found, row["student"].strip(), row["part"].strip(), row["sheet"].strip())
    if row["answer_id"].strip().removeprefix(ID) != one.answer_id:
        raise CourseError(
            f"{one.student}, {one.part.variable}: the answer changed since this file was written"
        )
    return one.new_mark(_points(row["points"].strip()), from_spreadsheet(row["comment"]))


def _points(text: str) -> float:
    points = plain_number(text.replace(",", "."))
    if points is None:
        raise CourseError(f"points take a number, got {text[:20]!r}")
    return points
