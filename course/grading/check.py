"""Whether recorded answers are still those of an exercise: a few records at a time."""

import logging
from collections.abc import Callable
from dataclasses import dataclass

from ...exercises.exercise import Exercise
from ...exercises.files.text import Text, exercise_of
from ...grader.jail.jail import Jail
from ..variants.record import Record, moved_parts
from .overheard import Complaint
from .work import AS_JSON, Walls

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Check:
    """Records of one exercise, with their numbers and answers."""

    __pydantic_config__ = AS_JSON

    exercise: Text
    records: tuple[Record, ...]


@dataclass(frozen=True)
class Checked:
    """Of every record, the variables whose answer is another now; all where it fails."""

    moved: tuple[tuple[str, ...], ...]
    complaints: tuple[Complaint, ...] = ()


def checked(check: Check, _: Callable[[Walls], Jail]) -> Checked:
    """Which answers moved."""
    exercise = exercise_of(check.exercise)
    return Checked(tuple(_moved(record, exercise) for record in check.records))


def _moved(record: Record, exercise: Exercise) -> tuple[str, ...]:
    try:
        return tuple(moved_parts(record, exercise))
    except Exception:  # an exercise edited since may need numbers that were never drawn
        log.exception("exercise %s fails on the numbers of %s", exercise.slug, record.student)
        return tuple(part.variable for part in exercise.asked)
