"""Drawing one variant of an exercise: plain numbers that JSON keeps, or what to write instead."""

import json
import math
from collections.abc import Iterator
from typing import Any, cast

import numpy as np

from ...exercises.exercise import Exercise, ExerciseError
from ...exercises.files.loading import stopped
from ...solutions.errors import KinegradeError

PLAIN = (str, int, float, bool, type(None))


def drawn(exercise: Exercise, rng: np.random.Generator) -> dict[str, Any]:
    """What `draw` gives, after it went through JSON.

    Raises:
        ExerciseError: `draw` stopped, or gave what JSON cannot hold; the sentence says what to
            write instead.
    """
    return _through_json(exercise, _draw(exercise, rng))


def prove_drawn(exercise: Exercise, rng: np.random.Generator, numbers: dict[str, Any]) -> None:
    """Holds what was drawn against a second draw with an equal generator.

    Raises:
        ExerciseError: JSON changed something, or an equal generator gives other numbers.
    """
    given = _draw(exercise, rng)
    again = _through_json(exercise, given)
    if again != given:
        hint = next(_changed("", given), "write numbers, text, lists and dicts with text as keys")
        raise ExerciseError(
            f"exercise {exercise.slug}: the drawn numbers change on their way through JSON: {hint}"
        )
    if again != numbers:
        raise ExerciseError(
            f"exercise {exercise.slug}: draw gives other numbers from an equal generator; "
            "take every random number from the rng that it is called with, "
            "none from np.random or random"
        )


def _draw(exercise: Exercise, rng: np.random.Generator) -> dict[str, Any]:
    try:
        given: Any = exercise.draw(rng)
    except KinegradeError as error:
        raise ExerciseError(f"exercise {exercise.slug}: draw: {error}") from error
    except Exception as error:
        raise ExerciseError(
            f"exercise {exercise.slug}: draw stopped with {stopped(error)}"
        ) from error
    if not isinstance(given, dict):
        raise ExerciseError(
            f"exercise {exercise.slug}: draw takes a dict of names and numbers, "
            f'such as {{"a": 0.5}}, got {type(given).__name__}'
        )
    return cast("dict[str, Any]", given)


def _through_json(exercise: Exercise, given: dict[str, Any]) -> dict[str, Any]:
    try:
        return json.loads(json.dumps(given))
    except (TypeError, ValueError, RecursionError) as error:
        why = next(_unplain("", given), str(error))
        raise ExerciseError(
            f"exercise {exercise.slug}: draw gives what JSON cannot hold: {why}"
        ) from error


def _unplain(place: str, value: Any) -> Iterator[str]:
    """What is no plain number, text, list or dict, and what to write for it."""
    if isinstance(value, dict):
        for name, inner in cast("dict[Any, Any]", value).items():
            yield from _unplain(_inside(place, name), inner)
    elif isinstance(value, list | tuple):
        for i, inner in enumerate(cast("list[Any]", value)):
            yield from _unplain(f"{place}[{i}]", inner)
    elif not isinstance(value, PLAIN):
        yield _instead(place, value)


def _inside(place: str, name: Any) -> str:
    """What stands under a key of a dict; of the outermost, the key alone."""
    if not place:
        return str(name)
    return f"{place}[{name!r}]"


def _instead(place: str, value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{place} is a numpy array; write {place}.tolist()"
    if isinstance(value, np.generic):
        scalar = cast("Any", value)
        kind = type(scalar).__name__
        return f"{place} is a numpy {kind}; write {type(scalar.item()).__name__}({place})"
    return f"{place} is of type {type(value).__name__}; write numbers, text, lists and dicts"


def _changed(place: str, value: Any) -> Iterator[str]:
    """What JSON gives back otherwise, and what to write for it."""
    if isinstance(value, dict):
        for name, inner in cast("dict[Any, Any]", value).items():
            if not isinstance(name, str):
                yield f"{place or 'the dict'} has the key {name!r}; write text for it"
            yield from _changed(_inside(place, name), inner)
    elif isinstance(value, tuple):
        yield f"{place} is a tuple; write a list"
    elif isinstance(value, list):
        for i, inner in enumerate(cast("list[Any]", value)):
            yield from _changed(f"{place}[{i}]", inner)
    elif isinstance(value, float) and math.isnan(value):
        yield f"{place} is not a number"
