"""What was handed out of a sheet, as the gradebook has it, and which answers moved since."""

import logging
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from ..exercises.exercise import Exercise
from .config import CourseError
from .gradebook import Gradebook
from .variant import Record, fingerprint, moved_parts

log = logging.getLogger(__name__)


class HandedOut:
    """The records of one sheet, held against the reference answers of today."""

    def __init__(
        self,
        gradebook: Gradebook,
        sheet: str,
        exercises: Sequence[Exercise],
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

        for recorded in gradebook.records(sheet):
            exercise = known.get(recorded.exercise)
            if exercise is None:
                continue
            record = recorded
            moved = _moved(record, exercise)
            if moved and accept_change:
                before_accepting(record.student)
                record = _accepted(record, exercise, gradebook)
                self._accepted.add(record.student)
                moved = []
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

    def answers_of_others(self, exercise: Exercise, student: str) -> dict[str, dict[str, Any]]:
        """The recorded answers of everybody else who has the exercise, by student."""
        others: dict[str, dict[str, Any]] = {}
        for other, records in self._records.items():
            if other != student and exercise.slug in records:
                others[other] = records[exercise.slug].answers
        return others


def _moved(record: Record, exercise: Exercise) -> list[str]:
    try:
        return moved_parts(record, exercise)
    except Exception:  # an exercise edited since may need numbers that were never drawn
        log.exception("exercise %s fails on the numbers of %s", exercise.slug, record.student)
        return [part.variable for part in exercise.asked]


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
