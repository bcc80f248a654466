"""A student's personal numbers: drawn from the course secret, recorded with a fingerprint of the answers."""

import hashlib
import hmac
import json
import logging
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..exercises.exercise import Exercise, ExerciseError, Part, references
from ..exercises.files.loading import stopped
from ..solutions.errors import KinegradeError
from .drawn import drawn

ATTEMPTS = 1000
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


def draw_record(
    secret: str,
    sheet: str,
    student: str,
    exercise: Exercise,
    taken: Collection[str],
    pinned: Mapping[str, Any] | None = None,
) -> Record:
    """The first attempt with the `pinned` choices of form whose numbers nobody else has.

    `taken` holds recorded numbers as `canonical` text.

    Raises:
        ExerciseError: a thousand attempts drew nothing new, as the exercise has too few variants for the class; or none
            had what is pinned; or what was drawn cannot be solved.
    """
    seen: dict[str, set[str]] = {}
    fitting = 0
    for attempt in range(ATTEMPTS):
        numbers = drawn(exercise, generator(secret, sheet, exercise.slug, student, attempt))
        for name in pinned or {}:
            seen.setdefault(name, set()).add(repr(numbers.get(name)))
        if any(numbers.get(name) != value for name, value in (pinned or {}).items()):
            continue
        fitting += 1
        if canonical(numbers) not in taken:
            return Record(
                student, sheet, exercise.slug, attempt, numbers, _solved(student, exercise, numbers)
            )
    if not fitting:
        gave = "; ".join(f"{name} was {', '.join(sorted(values))}" for name, values in seen.items())
        raise ExerciseError(
            f"sheet {sheet}: {ATTEMPTS} draws of {exercise.slug} never gave what is pinned: {gave}"
        )
    raise ExerciseError(
        f"exercise {exercise.slug}: {ATTEMPTS} draws gave no new numbers; draw from a wider set"
    )


def generator(secret: str, *where: str | int) -> np.random.Generator:
    """A generator seeded by HMAC-SHA256 of sheet, exercise, student and attempt under the course secret."""
    digest = hmac.digest(secret.encode(), "\0".join(map(str, where)).encode(), "sha256")
    return np.random.Generator(np.random.PCG64(int.from_bytes(digest, "big")))


def canonical(numbers: Any) -> str:
    """One text for equal numbers, to compare and to hash."""
    return json.dumps(numbers, sort_keys=True, separators=(",", ":"))


def _solved(student: str, exercise: Exercise, numbers: dict[str, Any]) -> dict[str, Any]:
    try:
        return fingerprint(exercise, numbers)
    except KinegradeError:
        raise
    except Exception as error:
        raise ExerciseError(
            f"exercise {exercise.slug} cannot be solved for {student}: it stopped with {stopped(error)}; "
            f"`kinegrade validate {exercise.slug}` looks at more draws"
        ) from error


def fingerprint(exercise: Exercise, numbers: dict[str, Any]) -> dict[str, Any]:
    """Every reference answer as numbers, rounded to 1e-9: it moves when a file, a row or a library changes one."""
    answers = references(exercise, numbers)
    pictures = {
        part.variable: _picture(part, answers[part.variable], numbers) for part in exercise.parts
    }
    return {name: picture for name, picture in pictures.items() if picture is not None}


def _picture(part: Part, answer: Any, numbers: dict[str, Any]) -> Any:
    picture = part.answer.pictured(answer, numbers)
    return (
        None if picture is None else (np.round(picture, 9) + 0.0).tolist()
    )  # no minus zero in the record


def moved_parts(record: Record, exercise: Exercise) -> list[str]:
    """Parts whose reference is no longer what was recorded when the sheet was handed out, or cannot be pictured."""
    answers = references(exercise, record.numbers)
    moved = sorted(set(record.answers) - set(answers))
    for part in exercise.parts:
        try:
            now = _picture(part, answers[part.variable], record.numbers)
        except (
            Exception
        ):  # the inputs of a function may fail in any way; the other parts are marked all the same
            log.exception("%s cannot be compared with what was recorded", part.variable)
            moved.append(part.variable)
            continue
        if not _same(now, record.answers.get(part.variable)):
            moved.append(part.variable)
    return moved


def _same(now: Any, recorded: Any) -> bool:
    if now is None or recorded is None:
        return now is None and recorded is None
    return _close(now, recorded)


def _close(a: Any, b: Any) -> bool:
    first, second = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    return first.shape == second.shape and bool(np.allclose(first, second, rtol=0, atol=1e-8))


def digest(data: bytes) -> str:
    """A short name for some bytes."""
    return hashlib.sha256(data).hexdigest()[:32]
