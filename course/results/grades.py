"""grades.csv: one line a student, all sheets of the course, for a spreadsheet or a registrar."""

import csv
import io
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ...exercises.exercise import Exercise
from ..language.speech import ENGLISH, Language, speaking
from ..language.writing import number_text
from ..settings.asked import asked_parts
from ..settings.config import Sheet, Student
from ..text.escape import for_spreadsheet
from .result import Result

BOM = "\ufeff"
"""Tells a spreadsheet that the file is UTF-8."""


@dataclass(frozen=True)
class SheetResults:
    """One sheet as it was marked: its exercises, and a result for everybody of the roster."""

    sheet: Sheet
    exercises: Sequence[Exercise]
    results: Sequence[Result]

    @property
    def parts(self) -> list[str]:
        """The variables that are asked, in the order of the sheet."""
        return list(asked_parts(self.exercises))

    @property
    def is_due(self) -> bool:
        """Whether anybody has marks, or an answer that waits for them."""
        return any(map(_has_verdicts, self.results))

    @property
    def out_of(self) -> float:
        """Points that could be had."""
        return sum(map(_points, self.exercises))


def _has_verdicts(result: Result) -> bool:
    return bool(result.verdicts)


def _points(exercise: Exercise) -> float:
    return exercise.points


@dataclass(frozen=True)
class Total:
    """What one student has of the course so far.

    Attributes:
        student: Whose it is.
        points: Of all sheets; None while a part waits for its mark, or where nothing came in.
        out_of: Points of all sheets for which anybody has marks, without resits.
        missing: Names of those sheets that the student did not hand in.
        status: graded, incomplete (a sheet is missing), not_graded, no_submission or excused.
    """

    student: Student
    points: float | None
    out_of: float
    missing: tuple[str, ...]
    status: str

    @property
    def percent(self) -> float | None:
        """Points of a hundred, one decimal; None where there are no points."""
        if self.points is None or not self.out_of:
            return None
        return round(100 * self.points / self.out_of, 1)


def totals(sheets: Sequence[SheetResults]) -> list[Total]:
    """The course total of every student, in the order of the roster.

    Of a sheet and its resits, the one with most of its points counts. A sheet for which somebody
    is excused counts neither for nor against them.
    """
    if not sheets:
        return []
    tries = _tries([sheet for sheet in sheets if sheet.is_due])
    found: list[Total] = []
    for i, result in enumerate(sheets[0].results):
        own: list[_Counting] = []
        for these in tries:
            counting = _counting(these, i)
            if counting is not None:
                own.append(counting)
        found.append(_total(result.student, own, due=bool(tries)))
    return found


def _tries(sheets: Sequence[SheetResults]) -> list[list[SheetResults]]:
    """Each sheet with its resits."""
    groups: dict[str, list[SheetResults]] = {}
    for sheet in sheets:
        groups.setdefault(sheet.sheet.resit_of or sheet.sheet.name, []).append(sheet)
    return list(groups.values())


@dataclass(frozen=True)
class _Counting:
    """What counts of a sheet and its resits for one student."""

    result: Result
    points: float | None
    out_of: float


def _counting(tries: Sequence[SheetResults], place: int) -> _Counting | None:
    """The best of the tries; None where the student is excused.

    A resit of other points than the first has these in proportion.
    """
    first = tries[0]
    found: list[_Counting] = []
    for sheet in tries:
        result = sheet.results[place]
        if result.excused:
            return None
        points = result.points
        if points is not None and sheet is not first:
            points = round(points * first.out_of / sheet.out_of, 2)
        found.append(_Counting(result, points, first.out_of))
    return max(found, key=_most)


def _most(one: _Counting) -> tuple[bool, float]:
    """What has points goes before what waits for them, and that before what is missing."""
    return bool(one.result.verdicts), -1.0 if one.points is None else one.points


def _total(student: Student, own: Sequence[_Counting], *, due: bool) -> Total:
    """The sum of what counts; `due` says whether anything is, for anybody."""
    points, out_of = 0.0, 0.0
    missing, status = list[str](), "graded"
    for one in own:
        out_of += one.out_of
        if not one.result.verdicts:
            missing.append(one.result.sheet)
        elif one.points is None:
            status = "not_graded"
        else:
            points += one.points

    if not own:
        status = "excused" if due else "not_graded"
    elif len(missing) == len(own):
        status = "no_submission"
    elif missing and status == "graded":
        status = "incomplete"
    known = round(points, 2) if status in ("graded", "incomplete") else None
    return Total(student, known, out_of, tuple(missing), status)


def grades_csv(sheets: Sequence[SheetResults], language: Language = ENGLISH) -> str:
    """Every cell quoted; a grade that is not there is empty, never a zero.

    The columns of the roster come first, then the course total, then sheet by sheet its points, its
    status, what being late took off, where it has a deadline, and its parts. Where a notebook ran
    without walls, a last column says whose. Where the language has a decimal comma, numbers have
    it, and semicolons stand between the cells, as spreadsheets of that language want it.
    """
    with speaking(language):
        return _grades_csv(sheets)


def _grades_csv(sheets: Sequence[SheetResults]) -> str:
    out = io.StringIO()
    separator = ";" if number_text(0.5) == "0,5" else ","
    writer = csv.writer(out, delimiter=separator, quoting=csv.QUOTE_ALL, lineterminator="\n")
    people = totals(sheets)
    stamped = any(_is_unsafe(sheets, i) for i in range(len(people)))
    stamp = ["level"] if stamped else []
    writer.writerow([*_header(sheets, people), *stamp])
    for i, total in enumerate(people):
        row = [total.student.id, for_spreadsheet(total.student.name)]
        row += [for_spreadsheet(text) for _, text in total.student.more]
        row += [_number(total.points), _number(total.out_of), _number(total.percent), total.status]
        for sheet in sheets:
            row += _sheet_cells(sheet, sheet.results[i])
        if stamped:
            row.append("unsafe" if _is_unsafe(sheets, i) else "")
        writer.writerow(row)
    return BOM + out.getvalue()


def _is_unsafe(sheets: Sequence[SheetResults], place: int) -> bool:
    """Whether a notebook of the student at that place of the roster ran without walls."""
    return any(sheet.results[place].unsafe for sheet in sheets)


def _header(sheets: Sequence[SheetResults], people: Sequence[Total]) -> list[str]:
    columns = ["student", "name"]
    if people:
        columns += [for_spreadsheet(column) for column, _ in people[0].student.more]
    columns += ["points", "out_of", "percent", "status"]
    counts: Counter[str] = Counter()
    for sheet in sheets:
        counts.update(sheet.parts)
    for sheet in sheets:
        name = sheet.sheet.name
        columns += [f"{name}_points", f"{name}_out_of", f"{name}_status"]
        if sheet.sheet.deadline is not None:
            columns.append(f"{name}_late_percent")
        columns += _part_columns(name, sheet.parts, counts)
    return columns


def _part_columns(sheet: str, parts: Iterable[str], counts: Counter[str]) -> list[str]:
    """The parts by their variables; one that is on several sheets with the sheet before it."""
    columns: list[str] = []
    for part in parts:
        if counts[part] > 1:
            columns.append(f"{sheet}/{part}")
        else:
            columns.append(part)
    return columns


def _sheet_cells(sheet: SheetResults, result: Result) -> list[str]:
    out_of = result.out_of if result.verdicts else None
    cells = [_number(result.points), _number(out_of), result.status]
    if sheet.sheet.deadline is not None:
        cells.append(_number(result.late.percent if result.verdicts else None))
    cells.extend(map(_number, map(result.earned.get, sheet.parts)))
    return cells


def _number(points: float | None) -> str:
    if points is None:
        return ""
    return number_text(points)
