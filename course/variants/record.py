"""What was drawn for one student, a fingerprint of its answers, and which of these moved since."""

import hashlib
import json
import logging
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...exercises.exercise import Exercise, Part, references

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Record:
    """What was drawn for one student and exercise of a sheet, and what its answers came to."""

    student: str
    sheet: str
    exercise: str
    attempt: int
    numbers: dict[str, Any]
    answers: dict[str, Any]


def fingerprint(
    exercise: Exercise, numbers: dict[str, Any], answers: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """Every reference answer that can be pictured as numbers, rounded to 1e-9.

    It moves when a file, a row of a robot or a library changes an answer. `answers` are the
    reference answers, where they are known already.
    """
    if answers is None:
        answers = references(exercise, numbers)
    pictures: dict[str, Any] = {}
    for part in exercise.parts:
        picture = _picture(part, answers[part.variable], numbers)
        if picture is not None:
            pictures[part.variable] = picture
    return pictures


def _picture(part: Part, answer: Any, numbers: dict[str, Any]) -> Any:
    picture = part.answer.pictured(answer, numbers)
    if picture is None:
        return None
    rounded = np.round(picture, 9) + 0.0  # no minus zero in the record
    return rounded.tolist()


def moved_parts(record: Record, exercise: Exercise) -> list[str]:
    """Parts whose reference is no longer what was recorded at the hand-out, or not to be pictured.

    Raises:
        Exception: of any kind, where the exercise fails on the recorded numbers.
    """
    answers = references(exercise, record.numbers)
    moved = sorted(set(record.answers) - set(answers))
    for part in exercise.parts:
        name = part.variable
        try:
            now = _picture(part, answers[name], record.numbers)
        except Exception:
            # The inputs of a function may fail in any way; the other parts are marked all the same.
            log.exception("%s cannot be compared with what was recorded", name)
            moved.append(name)
            continue
        if not _same(now, record.answers.get(name)):
            moved.append(name)
    return moved


def _same(now: Any, recorded: Any) -> bool:
    if now is None or recorded is None:
        return now is None and recorded is None
    first = np.asarray(now, dtype=float)
    second = np.asarray(recorded, dtype=float)
    return first.shape == second.shape and bool(np.allclose(first, second, rtol=0, atol=1e-8))


def canonical(numbers: Any) -> str:
    """One text for equal numbers, to compare and to hash."""
    return json.dumps(numbers, sort_keys=True, separators=(",", ":"))


def digest(data: bytes) -> str:
    """A short name for some bytes."""
    return hashlib.sha256(data).hexdigest()[:32]
