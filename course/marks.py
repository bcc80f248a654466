"""Marks for the parts that are marked by hand: what waits, entered one by one or from a CSV file."""

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..exercises.answers import Manual
from ..exercises.exercise import Exercise, Part, references
from ..grader.marking.verdict import Finding, Status, Verdict
from .config import Course, CourseError, Sheet
from .escape import no_formula
from .files import write_atomically
from .gradebook import Gradebook, Mark
from .sheets import exercises_of
from .variant import digest

COLUMNS = (
    "student",
    "sheet",
    "part",
    "points",
    "out_of",
    "comment",
    "answer",
    "key",
    "rubric",
    "answer_id",
)
NEEDED = ("student", "sheet", "part", "points", "answer_id")
CHANGED = "The answer changed since it was marked by hand; it waits for a new mark."


@dataclass(frozen=True)
class ByHand:
    """One part of one student that is marked by hand: what was handed in, the marker's key, and the mark so far."""

    student: str
    sheet: str
    part: Part
    answer: str
    key: str
    mark: Mark | None
    missing: bool

    @property
    def answer_id(self) -> str:
        """A short name of the answer; a mark belongs to the answer that was read."""
        return answer_id(self.answer)

    @property
    def waits(self) -> bool:
        """Whether there is an answer and no mark for it as it is now."""
        if self.missing:
            return False
        return self.mark is None or self.mark.answer != self.answer_id


def answer_id(answer: Any) -> str:
    """A short name of what was handed in for a part; nothing has one too."""
    return digest(str(answer or "").encode(errors="replace"))[:8]


def with_marks(
    verdicts: Sequence[Verdict],
    student: str,
    marks: Mapping[tuple[str, str], Mark],
    parts: Mapping[str, Part],
) -> tuple[Verdict, ...]:
    """Verdicts with the marks that were entered by hand for these answers; `marks` go by student and part."""
    return tuple(
        _marked(verdict, marks.get((student, verdict.part)), parts.get(verdict.part))
        for verdict in verdicts
    )


def _marked(verdict: Verdict, mark: Mark | None, part: Part | None) -> Verdict:
    if mark is None or part is None or not isinstance(part.answer, Manual):
        return verdict
    if mark.answer != answer_id(verdict.answer):
        return replace(verdict, findings=(Finding(CHANGED),)) if verdict.points is None else verdict
    points = min(mark.points, verdict.out_of)
    status: Status = "correct" if points == verdict.out_of else "partly" if points else "incorrect"
    comment = (Finding(mark.comment),) if mark.comment else ()
    return replace(verdict, status=status, points=points, findings=comment)


def by_hand(course: Course, gradebook: Gradebook, sheets: Sequence[Sheet]) -> Iterator[ByHand]:
    """Everything that was handed in and is marked by hand, in the order of roster and sheet."""
    for sheet in sheets:
        current, marks = gradebook.current(sheet.name), gradebook.marks(sheet.name)
        numbers = {
            (record.student, record.exercise): record.numbers
            for record in gradebook.records(sheet.name)
        }
        for exercise in exercises_of(course, sheet):
            for part in (part for part in exercise.asked if isinstance(part.answer, Manual)):
                for student in (student.id for student in course.students if student.id in current):
                    verdict = next(
                        (found for found in current[student] if found.part == part.variable), None
                    )
                    if verdict and (student, exercise.slug) in numbers:
                        key = _key(exercise, part, numbers[student, exercise.slug])
                        mark, answer = (
                            marks.get((student, part.variable)),
                            str(verdict.answer or ""),
                        )
                        yield ByHand(
                            student,
                            sheet.name,
                            part,
                            answer,
                            key,
                            mark,
                            verdict.status == "missing",
                        )


def _key(exercise: Exercise, part: Part, numbers: dict[str, Any]) -> str:
    return str(references(exercise, numbers)[part.variable])


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
    gradebook.save_marks([_mark(_one(found, student, part, sheet), points, comment)])


def _one(found: Sequence[ByHand], student: str, part: str, sheet: str = "") -> ByHand:
    these = [
        one
        for one in found
        if (one.student, one.part.variable) == (student, part) and sheet in ("", one.sheet)
    ]
    if len(these) > 1:
        sheets = ", ".join(one.sheet for one in these)
        raise CourseError(f"{part} is on the sheets {sheets}; name one with --sheet")
    if these:
        return these[0]
    parts = ", ".join(sorted({one.part.variable for one in found})) or "none"
    raise CourseError(
        f"{student}, {part}: there is no such answer to mark by hand; the parts marked by hand are: {parts}; "
        "`kinegrade grade` comes first, and a student who handed in nothing has no answer"
    )


def _mark(one: ByHand, points: float, comment: str) -> Mark:
    if not 0 <= points <= one.part.points:
        raise CourseError(
            f"{one.student}, {one.part.variable}: points take 0 to {one.part.points:g}, got {points:g}"
        )
    return Mark(one.student, one.sheet, one.part.variable, points, comment, one.answer_id)


def to_csv(found: Sequence[ByHand]) -> str:
    """One line for every answer; fill in points and comment, and read it back."""
    out = io.StringIO()
    writer = csv.writer(out, quoting=csv.QUOTE_ALL, lineterminator="\n")
    writer.writerow(COLUMNS)
    for one in found:
        assert isinstance(one.part.answer, Manual)  # noqa: S101 - that is what was looked for
        points = "" if one.mark is None or one.waits else f"{one.mark.points:g}"
        comment = one.mark.comment if one.mark else ""
        rubric = "; ".join(f"{worth:g}: {text}" for worth, text in one.part.answer.rubric)
        place = (one.student, one.sheet, one.part.variable)
        shown = map(no_formula, (comment, one.answer, one.key, rubric))
        writer.writerow((*place, points, f"{one.part.points:g}", *shown, one.answer_id))
    return out.getvalue()


def write_csv(found: Sequence[ByHand], path: Path) -> None:
    """The lines of `to_csv` as a file. Raises CourseError where one is there already: it may hold marks."""
    if path.exists():
        raise CourseError(f"{path} is already there and may hold marks; name another file")
    write_atomically(path, to_csv(found))


def read_csv(path: Path, found: Sequence[ByHand], gradebook: Gradebook) -> int:
    """Enters all marks of a file, or none; lines without points are passed over. Returns how many were entered.

    Raises:
        CourseError: a line cannot be entered; the sentence names it.
    """
    marks: list[Mark] = []
    for line, row in _rows(path):
        text = (row.get("points") or "").strip()
        if not text:
            continue
        try:
            marks.append(
                _mark(_of_row(found, row), _points(text), _comment(row.get("comment") or ""))
            )
        except CourseError as error:
            raise CourseError(f"{path}, line {line}: {error}; nothing was entered") from error
    gradebook.save_marks(marks)
    return len(marks)


def _of_row(found: Sequence[ByHand], row: Mapping[str, str]) -> ByHand:
    one = _one(found, row["student"].strip(), row["part"].strip(), row["sheet"].strip())
    if row["answer_id"].strip() != one.answer_id:
        raise CourseError(
            f"{one.student}, {one.part.variable}: the answer changed since this file was written"
        )
    return one


def _rows(path: Path) -> Iterator[tuple[int, dict[str, str]]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise CourseError(f"{path} cannot be read as UTF-8 text: {error}") from error
    separator = (
        ";" if text.partition("\n")[0].count(";") > text.partition("\n")[0].count(",") else ","
    )
    reader = csv.DictReader(io.StringIO(text, newline=""), delimiter=separator)
    missing = [name for name in NEEDED if name not in (reader.fieldnames or ())]
    if missing:
        raise CourseError(
            f"{path}: the column {missing[0]!r} is missing; `kinegrade marks write` has all columns"
        )
    try:
        for row in reader:
            yield reader.line_num, {key: value or "" for key, value in row.items() if key}
    except csv.Error as error:
        raise CourseError(f"{path}: not a CSV file: {error}") from error


def _points(text: str) -> float:
    try:
        return float(text.replace(",", "."))
    except ValueError:
        raise CourseError(f"points take a number, got {text[:20]!r}") from None


def _comment(text: str) -> str:
    return " ".join(text.split())
