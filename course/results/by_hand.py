"""Answers as markers see them: what was handed in, the marker's key, and the mark so far."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ...exercises.answers import Manual
from ...exercises.exercise import Part, references
from ...grader.marking.verdict import Verdict
from ..ledger.gradebook import Gradebook, Mark
from ..settings.asked import exercises_of
from ..settings.config import Course, CourseError, Sheet, hint
from ..term.opinions import answer_id
from ..text.escape import printable_lines
from ..variants.variant_code import read_code, variant_codes


@dataclass(frozen=True)
class ByHand:
    """One part of one student, with the key and the mark so far.

    `answer_id` is a short name of the answer: a mark belongs to the one that was read. Parts that
    are marked by themselves have no key.
    """

    student: str
    sheet: str
    part: Part
    answer: str
    answer_id: str
    key: str
    mark: Mark | None
    missing: bool
    code: str = ""

    @property
    def waits(self) -> bool:
        """Whether there is an answer and no mark for it as it is now."""
        if self.missing:
            return False
        mark = self.mark
        return mark is None or mark.points is None or mark.answer != self.answer_id

    @property
    def rubric(self) -> tuple[tuple[float, str], ...]:
        """Points and what earns them; empty for what is not marked by hand."""
        if isinstance(self.part.answer, Manual):
            return self.part.answer.rubric
        return ()

    def ticked(self, ticks: Collection[int]) -> float:
        """The points of some lines of the rubric, which are counted from 1.

        Raises:
            CourseError: there is no such line.
        """
        points = 0.0
        for tick in sorted(set(ticks)):
            if not 1 <= tick <= len(self.rubric):
                raise CourseError(
                    f"{self.student}, {self.part.variable}: its rubric has {len(self.rubric)} "
                    f"lines, got {tick}"
                )
            points += self.rubric[tick - 1][0]
        return points

    def new_mark(
        self, points: float | None, comment: str = "", ticks: Collection[int] = ()
    ) -> Mark:
        """A mark for the answer as it is now, by points or by ticked lines; or a comment alone.

        Raises:
            CourseError: the points are out of range, or there is no such line.
        """
        of_ticks = self.ticked(ticks)
        if ticks and points is None:
            points = of_ticks
        most = self.part.points
        if points is not None and not 0 <= points <= most:
            raise CourseError(
                f"{self.student}, {self.part.variable}: points take 0 to {most:g}, got {points:g}"
            )
        listed = ",".join(map(str, sorted(set(ticks))))
        said = printable_lines(comment)
        name = self.part.variable
        return Mark(self.student, self.sheet, name, points, said, self.answer_id, listed)


def by_hand(course: Course, gradebook: Gradebook, sheets: Sequence[Sheet]) -> Iterator[ByHand]:
    """Everything that was handed in and is marked by hand, in the order of sheet and roster."""
    for sheet in sheets:
        yield from _of_sheet(course, gradebook, sheet, every=False)


def every_answer(course: Course, gradebook: Gradebook, sheets: Sequence[Sheet]) -> Iterator[ByHand]:
    """Everything that was handed in, by whomever it is marked, in the order of sheet and roster."""
    for sheet in sheets:
        yield from _of_sheet(course, gradebook, sheet, every=True)


def _of_sheet(
    course: Course, gradebook: Gradebook, sheet: Sheet, *, every: bool
) -> Iterator[ByHand]:
    current = gradebook.current(sheet.name)
    marks = gradebook.marks(sheet.name)
    numbers: dict[tuple[str, str], dict[str, Any]] = {}
    records = gradebook.records(sheet.name)
    for record in records:
        numbers[record.student, record.exercise] = record.numbers
    codes = variant_codes(records)

    for exercise in exercises_of(course, sheet):
        for part in exercise.asked:
            manual = isinstance(part.answer, Manual)
            if not manual and not every:
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
                    answer_id=answer_id(verdict),
                    key=str(references(exercise, drawn)[part.variable]) if manual else "",
                    mark=marks.get((student.id, part.variable)),
                    missing=verdict.status == "missing",
                    code=codes[student.id],
                )


def _verdict_on(part: Part, verdicts: Sequence[Verdict]) -> Verdict | None:
    for verdict in verdicts:
        if verdict.part == part.variable:
            return verdict
    return None


def the_one(
    course: Course, found: Sequence[ByHand], student: str, part: str, sheet: str = ""
) -> ByHand:
    """The answer of a student to a part, on the sheet if one is named.

    The code of the variant, as it stands on the pages, may stand for the student.

    Raises:
        CourseError: there is none, it is on several sheets and none is named, or nobody is called
            so.
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
    _refuse_stranger(course, found, student)
    if sheet:
        course.sheet(sheet)
    parts = sorted({one.part.variable for one in found})
    listed = ", ".join(parts) or "none"
    raise CourseError(
        f"{student}, {part}: there is no such answer to mark{hint(part, parts)}; "
        f"the parts are: {listed}; "
        "`kinegrade grade` comes first, and a student who handed in nothing has no answer"
    )


def _refuse_stranger(course: Course, found: Sequence[ByHand], student: str) -> None:
    """Refuses what is neither an id of the roster nor the code of somebody who handed in."""
    known = [one.id for one in course.students]
    code = read_code(student)
    if student in known or code in [one.code for one in found]:
        return
    no_code = " and no answer has that code" if code else ""
    roster = course.folder / "roster.csv"
    raise CourseError(f"{roster} has no student {student!r}{hint(student, known)}{no_code}")
