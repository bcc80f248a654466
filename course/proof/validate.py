"""Validating exercise files: draws of each are looked at, side by side where that is worth it."""

import math
import os
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import TypeVar

import numpy as np

from ...exercises.exercise import ExerciseError
from ...exercises.files.finding import exercise_files, find, load, own_files
from ..settings.config import read_settings, refuse_no_folder
from ..variants.drawn import drawn
from ..variants.record import canonical
from .draw import Failure, because, failures_of
from .guessing import guess_failures
from .telling import Telling, accepted, all_told, told
from .validation import ENOUGH, KINDS, Looked, Validation, summary, together

__all__ = ["KINDS", "Validation", "chosen", "summary", "validate", "validate_file"]

T = TypeVar("T")
R = TypeVar("R")
TRIED = 4  # draws after which it is known how long the others take
WORTH = 3.0  # seconds of work that is worth starting processes for
CHUNK = 20  # draws that one process looks at in one go


def chosen(names: Sequence[str], folder: Path) -> list[Path]:
    """Files of the named exercises, each once.

    Without names, those of all that a course uses, or of all there are where no course is.

    Raises:
        ExerciseError: a name is neither an exercise nor a file.
        CourseError: the course folder is none, or its course.toml cannot be read.
    """
    refuse_no_folder(folder)
    own = folder / "exercises"
    files = exercise_files(own)
    if not names:
        names = _names_in_use(folder)

    paths = [_file_of(name, files, own) for name in names]
    return [*dict.fromkeys(paths or files.values())]


def _names_in_use(folder: Path) -> list[str]:
    """Exercises on a course's sheets, then all of its own; none where no course is."""
    settings = folder / "course.toml"
    if not settings.exists():
        return []
    names: list[str] = []
    for sheet in read_settings(settings).sheet:
        names += sheet.exercises
    names += own_files(folder / "exercises")
    return [*dict.fromkeys(names)]


def _file_of(name: str, files: dict[str, Path], own: Path) -> Path:
    """The file that is named, or that of the exercise of that name."""
    if name.isidentifier():
        find(name, files, own)  # says what is known
        return files[name]
    path = Path(name)
    if not path.is_file():
        raise ExerciseError(
            f"{name} is not there; validate takes names of exercises, and files that end in .py"
        )
    return path


def validate(
    paths: Sequence[Path], draws: int, step: Callable[[int], None] = lambda _: None
) -> list[Validation]:
    """A validation for every exercise file, in order.

    `step` is called with the number of draws that have been looked at since it was called last.
    """
    each = [*dict.fromkeys(paths)]
    return _with_guesses(each, _validated(paths, draws, step))


def _with_guesses(paths: Sequence[Path], validations: Sequence[Validation]) -> list[Validation]:
    """With what guessing earns too much of, in files that are sound otherwise.

    A few draws are looked at to see whether a file works at all; then this has time.
    """
    sound: list[Path] = []
    for path, validation in zip(paths, validations, strict=True):
        if validation.draws >= ENOUGH and not validation.failures:
            sound.append(path)
    looked: Iterable[list[Failure]] = map(guess_failures, sound)
    if len(sound) > 1:
        looked = _in_processes(guess_failures, sound)

    found = dict(zip(sound, looked, strict=True))
    completed: list[Validation] = []
    for path, validation in zip(paths, validations, strict=True):
        more = found.get(path, [])
        completed.append(replace(validation, guessing=tuple(more)))
    return completed


def _validated(paths: Sequence[Path], draws: int, step: Callable[[int], None]) -> list[Validation]:
    if len(paths) == 1:
        return [_one(paths[0], draws, step)]

    chunks: list[tuple[Path, range]] = []
    found: dict[Path, list[Looked]] = {}
    for path in paths:
        found[path] = []
        chunks += _chunks(path, range(draws), CHUNK)
    for (path, seeds), looked in zip(chunks, _side_by_side(chunks), strict=True):
        found[path].append(looked)
        step(len(seeds))
    return [together(looked) for looked in found.values()]


def validate_file(path: Path, draws: int) -> Validation:
    """The validation of one exercise file, in this process."""
    return together([_look_at(path, range(draws))])


def _one(path: Path, draws: int, step: Callable[[int], None]) -> Validation:
    """The first draws in this process.

    The others too, unless they take longer than it takes to start more.
    """
    looked: list[Looked] = []
    seconds: list[float] = []
    for seed in range(min(draws, TRIED)):
        start = time.process_time()
        looked.append(_look_at(path, [seed]))
        seconds.append(time.process_time() - start)
        step(1)
    if not looked[0][0].draws:  # it cannot be loaded
        return together(looked[:1])

    rest = range(draws)[len(looked) :]
    others: Iterable[Looked]
    if len(rest) * min(seconds) < WORTH:  # not the mean: the first draws load and render
        chunks = _chunks(path, rest, 1)
        others = map(_look_in, chunks)
    else:
        chunks = _chunks(path, rest, math.ceil(len(rest) / _cores()))
        others = _side_by_side(chunks)
    for (_, seeds), more in zip(chunks, others, strict=True):
        looked.append(more)
        step(len(seeds))
    return together(looked)


def _cores() -> int:
    """Those that this process may use, where the system says which."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _chunks(path: Path, seeds: range, size: int) -> list[tuple[Path, range]]:
    """Draws of a file in shares of that size, or of CHUNK where that is less."""
    step = max(1, min(size, CHUNK))
    return [(path, seeds[start : start + step]) for start in range(0, len(seeds), step)]


def _side_by_side(chunks: Sequence[tuple[Path, range]]) -> Iterator[Looked]:
    """What each chunk shows, in order."""
    yield from _in_processes(_look_in, chunks)


def _in_processes(look: Callable[[T], R], things: Sequence[T]) -> Iterator[R]:
    """What comes of each, in order, from as many processes as there are cores."""
    workers = min(_cores(), len(things))
    spawn = get_context("spawn")  # typst does not survive a fork
    with ProcessPoolExecutor(workers, mp_context=spawn) as pool:
        yield from pool.map(look, things)


def _look_in(chunk: tuple[Path, range]) -> Looked:
    return _look_at(*chunk)


def _look_at(path: Path, seeds: Sequence[int]) -> Looked:
    """What some draws of a file show; whatever is raised meanwhile is a failure of its draw."""
    try:
        exercise = load(path)
    except ExerciseError as error:
        unloaded = Failure("solve", 0, "", str(error))
        return Validation(path.stem, 0, 0, 0, 0.0, (unloaded,)), []

    failures: list[Failure] = []
    texts: list[str] = []
    telling: list[Telling] = []
    slowest = 0.0
    for seed in seeds:
        try:
            start = time.perf_counter()
            drawn(exercise, np.random.default_rng(seed))
            slowest = max(slowest, time.perf_counter() - start)
            v, refused = accepted(exercise, seed)
            telling.append(told(exercise, v, refused))
            texts.append(canonical(v))
            failures += failures_of(exercise, v, seed)
        except Exception as error:  # noqa: BLE001 - whatever an exercise file raises is the finding
            failures.append(Failure("solve", seed, "", because(error)))
    validation = Validation(
        exercise.slug,
        len(exercise.asked),
        exercise.points,
        len(seeds),
        slowest,
        tuple(failures),
        exercise.named,
        exercise.source,
        all_told(telling),
        exercise.harder,
    )
    return validation, texts
