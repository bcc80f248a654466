"""Validating exercise files: draws of each are looked at, side by side where that is worth it."""

import json
import math
import os
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from ...exercises.exercise import ExerciseError
from ...exercises.files.finding import exercise_files, find, load, own_files
from ..config import CourseError, read_settings
from ..drawn import drawn, prove_drawn
from ..variant import canonical
from .draw import Failure, because, failures_of

KINDS = (
    "solve",
    "full marks",
    "nonsense",
    "mistakes",
    "printable",
    "render",
    "solution",
    "variants",
)
TRIED = 4  # draws after which it is known how long the others take
WORTH = 3.0  # seconds of work that is worth starting processes for
CHUNK = 20  # draws that one process looks at in one go
ENOUGH = 10  # draws in which everything that some variants have should be seen
MOST_ALIKE = 0.05  # share of draws that may repeat an earlier one


@dataclass(frozen=True)
class Validation:
    """What looking at some draws of one exercise found."""

    slug: str
    parts: int
    points: float
    draws: int
    seconds_to_draw: float
    failures: tuple[Failure, ...]
    named: tuple[str, ...] = ()
    source: str = ""


def chosen(names: Sequence[str], folder: Path) -> list[Path]:
    """Files of the named exercises; without names, of all that a course uses, or of all where no course is.

    Raises:
        ExerciseError: a name is neither an exercise nor a file.
        CourseError: the course folder is none, or its course.toml cannot be read.
    """
    if not folder.is_dir():
        raise CourseError(f"{folder} is no folder; --course takes the one with the course.toml")
    own = folder / "exercises"
    files = exercise_files(own)
    if not names and (folder / "course.toml").exists():
        named = [
            slug
            for sheet in read_settings(folder / "course.toml").sheet
            for slug in sheet.exercises
        ]
        names = [*dict.fromkeys([*named, *own_files(own)])]
    paths = [_file_of(name, files, own) for name in names]
    return [*dict.fromkeys(paths or files.values())]


def _file_of(name: str, files: dict[str, Path], own: Path) -> Path:
    """The file that is named, or that of the exercise of that name."""
    path = Path(name)
    if name.isidentifier():
        find(name, files, own)  # says what is known
        return files[name]
    if not path.is_file():
        raise ExerciseError(
            f"{name} is not there; validate takes names of exercises, and files that end in .py"
        )
    return path


def summary(validation: Validation) -> Iterator[str]:
    """One line for every part and kind of failure: how often, and the first of it."""
    groups: dict[tuple[str, str], list[Failure]] = {}
    for failure in validation.failures:
        groups.setdefault((failure.kind, failure.part), []).append(failure)
    for (kind, part), failures in groups.items():
        draws = {failure.seed for failure in failures}
        often = (
            f", in {len(draws)} of {validation.draws} draws, first {min(draws)}"
            if validation.draws
            else ""
        )
        yield f"{kind}{f', {part}' if part else ''}{often}: {failures[0].sentence}"


def validate(
    paths: Sequence[Path], draws: int, step: Callable[[int], None] = lambda _: None
) -> list[Validation]:
    """A validation for every exercise file, in order; `step` is called with the number of draws looked at."""
    if len(paths) == 1:
        return [_one(paths[0], draws, step)]
    chunks = [(path, chunk) for path in paths for chunk in _chunks(range(draws), CHUNK)]
    found: dict[Path, list[_Looked]] = {path: [] for path in paths}
    for (path, chunk), looked in zip(chunks, _side_by_side(chunks), strict=True):
        found[path].append(looked)
        step(len(chunk))
    return [_together(looked) for looked in found.values()]


def validate_file(path: Path, draws: int) -> Validation:
    """The validation of one exercise file, in this process."""
    return _together([_look_at(path, range(draws))])


def _one(path: Path, draws: int, step: Callable[[int], None]) -> Validation:
    """The first draws in this process; the others too, unless they take longer than it takes to start more."""
    looked: list[_Looked] = []
    seconds: list[float] = []
    for seed in range(min(draws, TRIED)):
        start = time.process_time()
        looked.append(_look_at(path, [seed]))
        seconds.append(time.process_time() - start)
        step(1)
    rest = range(draws)[len(looked) :]
    if not looked[0][0].draws:  # it cannot be loaded
        return _together(looked[:1])
    quick = len(rest) * min(seconds) < WORTH  # the first ones load and render
    chunks = [
        (path, chunk) for chunk in _chunks(rest, 1 if quick else math.ceil(len(rest) / _cores()))
    ]
    for (_, chunk), more in zip(
        chunks, map(_look_in, chunks) if quick else _side_by_side(chunks), strict=True
    ):
        looked.append(more)
        step(len(chunk))
    return _together(looked)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _never_drawn(named: Sequence[str], texts: Sequence[str]) -> list[Failure]:
    """Names that the exercise says are drawn, and no draw has; a few draws are no proof."""
    if not named or len(texts) < ENOUGH:
        return []
    missing = {*named}.difference(*map(json.loads, texts))
    if not missing:
        return []
    listed = ", ".join(sorted(missing))
    sentence = f"no draw has {listed}, though units, hidden or structure name it; is it misspelt there or in draw?"
    return [Failure("variants", 0, "", sentence)]


def _chunks(seeds: range, size: int) -> list[range]:
    step = max(1, min(size, CHUNK))
    return [seeds[start : start + step] for start in range(0, len(seeds), step)]


def _side_by_side(chunks: Sequence[tuple[Path, range]]) -> Iterator["_Looked"]:
    """What each chunk shows, in order, from as many processes as there are cores."""
    workers = min(_cores(), len(chunks))
    with ProcessPoolExecutor(
        workers, mp_context=get_context("spawn")
    ) as pool:  # typst does not survive a fork
        yield from pool.map(_look_in, chunks)


def _look_in(chunk: tuple[Path, range]) -> "_Looked":
    return _look_at(*chunk)


def _together(results: "Sequence[_Looked]") -> Validation:
    """One validation of all chunks, and whether draws repeat each other too often."""
    first = results[0][0]
    texts = [text for _, looked in results for text in looked]
    failures = [
        *dict.fromkeys(failure for validation, _ in results for failure in validation.failures)
    ]
    alike = len(texts) - len(set(texts))
    if alike > max(1, MOST_ALIKE * len(texts)):
        sentence = f"{alike} of {len(texts)} draws repeat an earlier one; draw from wider sets"
        failures.append(Failure("variants", 0, "", sentence))
    failures += _never_drawn(first.named, texts)
    seconds = max(validation.seconds_to_draw for validation, _ in results)
    draws = sum(validation.draws for validation, _ in results)
    return replace(first, draws=draws, seconds_to_draw=seconds, failures=tuple(failures))


_Looked = tuple[Validation, list[str]]
"""What some draws showed, and the drawn numbers as text."""


def _look_at(path: Path, seeds: Sequence[int]) -> _Looked:
    try:
        exercise = load(path)
    except ExerciseError as error:
        return Validation(path.stem, 0, 0, 0, 0.0, (Failure("solve", 0, "", str(error)),)), []
    failures: list[Failure] = []
    texts: list[str] = []
    seconds = 0.0
    for seed in seeds:
        try:
            start = time.perf_counter()
            v = drawn(exercise, np.random.default_rng(seed))
            seconds = max(seconds, time.perf_counter() - start)
            prove_drawn(exercise, seed, v)
            texts.append(canonical(v))
            failures += failures_of(exercise, v, seed)
        except Exception as error:  # noqa: BLE001 - an exercise file may fail in any way; that is the finding
            failures.append(Failure("solve", seed, "", because(error)))
    validation = Validation(
        exercise.slug,
        len(exercise.asked),
        exercise.points,
        len(seeds),
        seconds,
        tuple(failures),
        exercise.named,
        exercise.source,
    )
    return validation, texts
