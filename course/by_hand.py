"""Answers that are marked by hand: what was handed in, the marker's key, and the mark so far."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ..exercises.answers import Manual
from ..exercises.exercise import Part, references
from ..grader.marking.verdict import Verdict
from .config import Course, CourseError, Sheet
from .escape import printable_lines
from .gradebook import Gradebook, Mark
from .record import digest
from .sheets import exercises_of
from .variant_code import read_code, variant_codes


@dataclass(frozen=True)
class ByHand:
    """One part of one student that is marked by hand, with the key and the mark so far."""

    student: str
    sheet: str
    part: Part
    answer: str
    key: str
    mark: Mark | None
    missing: bool
    code: str = ""

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

    def new_mark(self, points: float, comment: str) -> Mark:
        """A mark for the answer as it is now.

        Raises:
            CourseError: the points are out of range.
        """
        most = self.part.points
        if not 0 <= points <= most:
            raise CourseError(
                f"{self.student}, {self.part.variable}: points take 0 to {most:g}, got {points:g}"
            )
        said = printable_lines(comment)
        return Mark(self.student, self.sheet, self.part.variable, points, said, self.answer_id)


def answer_id(answer: Any) -> str:
    """A short name of what was handed in for a part; nothing has one too."""
    return digest(str(answer or "").encode(errors="replace"))[:8]


def by_hand(course: Course, gradebook: Gradebook, sheets: Sequence[Sheet]) -> Iterator[ByHand]:
    """Everything that was handed in and is marked by hand, in the order of sheet and roster."""
    for sheet in sheets:
        yield from _of_sheet(course, gradebook, sheet)


def _of_sheet(course: Course, gradebook: Gradebook, sheet: Sheet) -> Iterator[ByHand]:
    current = gradebook.current(sheet.name)
    marks = gradebook.marks(sheet.name)
    numbers: dict[tuple[str, str], dict[str, Any]] = {}
    records = gradebook.records(sheet.name)
    for record in records:
        numbers[record.student, record.exercise] = record.numbers
    codes = variant_codes(records)

    for exercise in exercises_of(course, sheet):
        for part in exercise.asked:
            if not isinstance(part.answer, Manual):
                continue
            for student in course.students:
                verdict = _verdict_on(part, current.get(student.id, ()))
                drawn = numbers.get((student.id, exercise.slug))
                if verdict is None or drawn is None:
                    continue
                yield ByHand(
                    student=student.id,
                    sheet=sheet.name,
                    part=part,
                    answer=str(verdict.answer or ""),
                    key=str(references(exercise, drawn)[part.variable]),
                    mark=marks.get((student.id, part.variable)),
                    missing=verdict.status == "missing",
                    code=codes[student.id],
                )


def _verdict_on(part: Part, verdicts: Sequence[Verdict]) -> Verdict | None:
    for verdict in verdicts:
        if verdict.part == part.variable:
            return verdict
    return None


def the_one(found: Sequence[ByHand], student: str, part: str, sheet: str = "") -> ByHand:
    """The answer of a student to a part, on the sheet if one is named.

    The code of the variant, as it stands on the pages, may stand for the student.

    Raises:
        CourseError: there is none, or it is on several sheets and none is named.
    """
    code = read_code(student)
    these: list[ByHand] = []
    for one in found:
        named = one.student == student or (code and one.code == code)
        if named and one.part.variable == part and sheet in ("", one.sheet):
            these.append(one)
    if len(these) == 1:
        return these[0]
    if these:
        sheets = ", ".join(one.sheet for one in these)
        raise CourseError(f"{part} is on the sheets {sheets}; name one with --sheet")
    parts = ", ".join(sorted({one.part.variable for one in found})) or "none"
    raise CourseError(
        f"{student}, {part}: there is no such answer to mark by hand; "
        f"the parts marked by hand are: {parts}; "
        "`kinegrade grade` comes first, and a student who handed in nothing has no answer"
    )
