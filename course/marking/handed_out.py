"""What was handed out of a sheet, as the gradebook has it, and which answers moved since."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any, get_args

from ...exercises.exercise import Exercise
from ..ledger.gradebook import Gradebook
from ..settings.config import Course, CourseError, Format, Sheet
from ..variants.record import Record, fingerprint

Moved = Callable[[Sequence[Record]], Mapping[tuple[str, str], Collection[str]]]
"""Of some records, by student and exercise, the variables whose answers are others today."""


class HandedOut:
    """The records of one sheet, held against the reference answers of today."""

    def __init__(
        self,
        gradebook: Gradebook,
        sheet: str,
        exercises: Sequence[Exercise],
        moved: Moved,
        *,
        accept_change: bool = False,
        before_accepting: Callable[[str], None] = lambda _: None,
    ) -> None:
        """Reads the records; with `accept_change`, moved answers become the recorded ones.

        `before_accepting` gets the student whose answers are going to be replaced.

        Raises:
            CourseError: a change cannot be accepted, as the exercise fails on recorded numbers.
        """
        self._records: dict[str, dict[str, Record]] = {}
        self._moved: dict[str, set[str]] = {}
        self._accepted: set[str] = set()
        known = {exercise.slug: exercise for exercise in exercises}
        recorded = [one for one in gradebook.records(sheet) if one.exercise in known]
        found = moved(recorded)

        for record in recorded:
            parts = found.get((record.student, record.exercise), ())
            if parts and accept_change:
                before_accepting(record.student)
                self._add(_accepted(record, known[record.exercise], gradebook), ())
                self._accepted.add(record.student)
            else:
                self._add(record, parts)

    def _add(self, record: Record, moved: Collection[str]) -> None:
        self._records.setdefault(record.student, {})[record.exercise] = record
        self._moved.setdefault(record.student, set()).update(moved)

    @property
    def nothing(self) -> bool:
        """Whether the gradebook knows of no student's sheet."""
        return not self._records

    @property
    def accepted(self) -> frozenset[str]:
        """Students whose recorded answers were replaced by those of today."""
        return frozenset(self._accepted)

    def records(self, student: str) -> dict[str, Record]:
        """A student's records by exercise; none where no sheet was drawn."""
        return self._records.get(student, {})

    def moved(self, student: str) -> frozenset[str]:
        """Variables of the parts whose reference is no longer that of the day of the hand-out."""
        return frozenset(self._moved.get(student, ()))

    def answers(self, exercise: str) -> dict[str, dict[str, Any]]:
        """The recorded answers of everybody who has the exercise, by student."""
        found: dict[str, dict[str, Any]] = {}
        for student, records in self._records.items():
            if exercise in records:
                found[student] = records[exercise].answers
        return found


def _accepted(record: Record, exercise: Exercise, gradebook: Gradebook) -> Record:
    """The record with the answers of today, here and in the gradebook."""
    try:
        answers = fingerprint(exercise, record.numbers)
    except Exception as error:
        raise CourseError(
            f"exercise {exercise.slug} cannot be accepted: it fails with {type(error).__name__}: "
            f"{error} on the numbers of {record.student}, which were handed out before it changed"
        ) from error
    gradebook.accept_answers(record, answers, "grade --accept-change")
    return replace(record, answers=answers)


def refuse_a_lost_gradebook(
    course: Course, gradebook: Gradebook, sheet: Sheet, *, nothing: bool
) -> None:
    """What was released is in the gradebook; `nothing` says whether it has no record of the sheet.

    Raises:
        CourseError: the sheet was handed out, but the gradebook knows nothing of it.
    """
    if not nothing or gradebook.damaged(sheet.name, "record"):
        return
    suffix = course.settings.formats[0]
    if any(course.folder.glob(f"released/*/{sheet.name}.{suffix}")):
        raise CourseError(
            f"{gradebook.place} knows nothing of sheet {sheet.name}, though it was released; "
            "put the backup back, or run `kinegrade generate`, which draws the same numbers from "
            "the same secret"
        )


def drop_solutions(course: Course, sheet: Sheet, student: str) -> None:
    """Removes the worked solutions of a student's sheet, which are no longer right."""
    for suffix in get_args(Format):
        path = course.folder / "solutions" / student / f"{sheet.name}.{suffix}"
        path.unlink(missing_ok=True)
