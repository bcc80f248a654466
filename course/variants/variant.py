"""A student's personal numbers, drawn from the secret."""

import hmac
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from ...exercises.exercise import Exercise, ExerciseError
from ...exercises.files.loading import stopped
from ...grader.telling.look import Look
from ...grader.telling.objections import objections
from ...solutions.errors import KinegradeError
from .drawn import drawn
from .record import Record, canonical, digest, fingerprint, moved_parts

__all__ = [
    "Record",
    "canonical",
    "digest",
    "draw_record",
    "fingerprint",
    "generator",
    "moved_parts",
]

ATTEMPTS = 1000
REFUSED = 16  # draws that cannot tell right from wrong, after which the best of them is taken


def draw_record(
    secret: str,
    sheet: str,
    student: str,
    exercise: Exercise,
    taken: Collection[str],
    pinned: Mapping[str, Any] | None = None,
) -> Record:
    """The first attempt with the `pinned` choices of form that can be handed out.

    That is one whose numbers nobody else has, and which tells right from wrong
    (grader/telling/objections.py). Where many could not, as on an arm with lengths that a few
    decimals hardly show, it is the one against which least speaks. `taken` holds recorded numbers
    as `canonical` text.

    Raises:
        ExerciseError: a thousand attempts drew nothing new, as the exercise has too few variants
            for the class; none had what is pinned; or what was drawn cannot be solved.
    """
    pins = pinned or {}
    seen: dict[str, set[str]] = {name: set() for name in pins}
    refused: list[tuple[int, Record]] = []
    fitting = 0
    for attempt in range(ATTEMPTS):
        numbers = drawn(exercise, generator(secret, sheet, exercise.slug, student, attempt))
        for name in pins:
            seen[name].add(repr(numbers.get(name)))
        if not _fits(numbers, pins):
            continue
        fitting += 1
        if canonical(numbers) in taken:
            continue
        answers, against = _solved(student, exercise, numbers)
        record = Record(student, sheet, exercise.slug, attempt, numbers, answers)
        if not against:
            return record
        refused.append((against, record))
        if len(refused) == REFUSED:
            break

    if refused:
        return min(refused, key=_objections)[1]
    if fitting:
        raise ExerciseError(
            f"exercise {exercise.slug}: {ATTEMPTS} draws gave no new numbers; draw from a wider set"
        )
    raise ExerciseError(_never_pinned(sheet, exercise.slug, seen))


def _never_pinned(sheet: str, slug: str, seen: Mapping[str, Collection[str]]) -> str:
    """The sentence where no draw had what is pinned, with what they had instead."""
    gave = [f"{name} was {', '.join(sorted(values))}" for name, values in seen.items()]
    return f"sheet {sheet}: {ATTEMPTS} draws of {slug} never gave what is pinned: {'; '.join(gave)}"


def _objections(refused: tuple[int, Record]) -> int:
    return refused[0]


def _fits(numbers: Mapping[str, Any], pins: Mapping[str, Any]) -> bool:
    return all(numbers.get(name) == value for name, value in pins.items())


def generator(secret: str, *where: str | int) -> np.random.Generator:
    """A generator seeded by HMAC-SHA256 under the course secret.

    `where` is what it is for: sheet, exercise, student and attempt.
    """
    place = "\0".join(map(str, where))
    seed = hmac.digest(secret.encode(), place.encode(), "sha256")
    return np.random.Generator(np.random.PCG64(int.from_bytes(seed, "big")))


def _solved(
    student: str, exercise: Exercise, numbers: dict[str, Any]
) -> tuple[dict[str, Any], int]:
    """The fingerprint of a draw, and how much speaks against it."""
    try:
        look = Look(exercise, numbers)
        answers = fingerprint(exercise, numbers, look.key.reference)
        return answers, len([*objections(look)])
    except KinegradeError:
        raise
    except Exception as error:
        raise ExerciseError(
            f"exercise {exercise.slug} cannot be solved for {student}: "
            f"it stopped with {stopped(error)}; "
            f"`kinegrade validate {exercise.slug}` looks at more draws"
        ) from error
