"""Proof that an exercise can be solved, marked and told apart from nonsense and from its known mistakes."""

import math
import os
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

from ..exercises.answers import Manual, Numbers
from ..exercises.catalogue import exercise_files, find, load, own_files
from ..exercises.exercise import Exercise, ExerciseError, solve
from ..exercises.loading import stopped
from ..grader.answer_key import AnswerKey
from ..grader.handed_in import handed_in, rounded
from ..grader.mark import mark, mark_part
from ..solutions.errors import KinegradeError
from .complaints import debugging, marking_failures
from .config import Sheet, Student, read_settings
from .drawn import drawn_strictly
from .formulas import page_text
from .nonsense import NONSENSE
from .notebook import notebooks, worked_steps
from .variant import canonical

KINDS = ("solve", "full marks", "nonsense", "mistakes", "printable", "render", "variants")
LARGEST = 1e5  # a number that is still printed and typed with pleasure
RENDERED = 2  # draws whose sheets are made in full, with figures
TRIED = 4  # draws after which it is known how long the others take
WORTH = 2.0  # seconds of work that is worth starting processes for
CHUNK = 20  # draws that one process looks at in one go
MOST_ALIKE = 0.05  # share of draws that may repeat an earlier one


@dataclass(frozen=True)
class Failure:
    """What is wrong with one draw of an exercise; `part` is empty where it is about the whole."""

    kind: str
    seed: int
    part: str
    sentence: str


@dataclass(frozen=True)
class Validation:
    """What looking at some draws of one exercise found."""

    slug: str
    parts: int
    points: float
    draws: int
    seconds_to_draw: float
    failures: tuple[Failure, ...]


def chosen(names: Sequence[str], folder: Path) -> list[Path]:
    """Files of the named exercises; without names, of all that a course uses, or of all where no course is.

    Raises:
        ExerciseError: a name is neither an exercise nor a file.
        CourseError: course.toml cannot be read.
    """
    own = folder / "exercises"
    files = exercise_files(own)
    if not names and (folder / "course.toml").exists():
        named = [slug for sheet in read_settings(folder / "course.toml").sheet for slug in sheet.exercises]
        names = [*dict.fromkeys([*named, *own_files(own)])]
    for name in names:
        if not _is_file(name):
            find(name, files, own)  # says what is known
    return [Path(name) if _is_file(name) else files[name] for name in names] or [*files.values()]


def _is_file(name: str) -> bool:
    return name.endswith(".py") and Path(name).exists()


def summary(validation: Validation) -> Iterator[str]:
    """One line for every part and kind of failure: how often, and the first of it."""
    groups: dict[tuple[str, str], list[Failure]] = {}
    for failure in validation.failures:
        groups.setdefault((failure.kind, failure.part), []).append(failure)
    for (kind, part), failures in groups.items():
        draws = {failure.seed for failure in failures}
        often = f", in {len(draws)} of {validation.draws} draws, first {min(draws)}" if validation.draws else ""
        yield f"{kind}{f', {part}' if part else ''}{often}: {failures[0].sentence}"


def validate(paths: Sequence[Path], draws: int, step: Callable[[int], None] = lambda _: None) -> list[Validation]:
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
        start = time.perf_counter()
        looked.append(_look_at(path, [seed]))
        seconds.append(time.perf_counter() - start)
        step(1)
    rest = range(draws)[len(looked) :]
    if not looked[0][0].draws:  # it cannot be loaded
        return _together(looked[:1])
    quick = len(rest) * min(seconds) < WORTH  # the first ones load and render
    chunks = [(path, chunk) for chunk in _chunks(rest, 1 if quick else math.ceil(len(rest) / _cores()))]
    for (_, chunk), more in zip(chunks, map(_look_in, chunks) if quick else _side_by_side(chunks), strict=True):
        looked.append(more)
        step(len(chunk))
    return _together(looked)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _chunks(seeds: range, size: int) -> list[range]:
    step = max(1, min(size, CHUNK))
    return [seeds[start : start + step] for start in range(0, len(seeds), step)]


def _side_by_side(chunks: Sequence[tuple[Path, range]]) -> Iterator["_Looked"]:
    """What each chunk shows, in order, from as many processes as there are cores."""
    workers = min(_cores(), len(chunks))
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:  # typst does not survive a fork
        yield from pool.map(_look_in, chunks)


def _look_in(chunk: tuple[Path, range]) -> "_Looked":
    return _look_at(*chunk)


def _together(results: "Sequence[_Looked]") -> Validation:
    """One validation of all chunks, and whether draws repeat each other too often."""
    first = results[0][0]
    drawn = [text for _, texts in results for text in texts]
    failures = [*dict.fromkeys(failure for validation, _ in results for failure in validation.failures)]
    alike = len(drawn) - len(set(drawn))
    if alike > max(1, MOST_ALIKE * len(drawn)):
        sentence = f"{alike} of {len(drawn)} draws repeat an earlier one; draw from wider sets"
        failures.append(Failure("variants", 0, "", sentence))
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
    drawn: list[str] = []
    seconds = 0.0
    for seed in seeds:
        try:
            start = time.perf_counter()
            v = drawn_strictly(exercise, seed)
            seconds = max(seconds, time.perf_counter() - start)
            drawn.append(canonical(v))
            failures += _failures(exercise, v, seed)
        except Exception as error:  # noqa: BLE001 - an exercise file may fail in any way; that is the finding
            failures.append(Failure("solve", seed, "", _because(error)))
    validation = Validation(exercise.slug, len(exercise.asked), exercise.points, len(seeds), seconds, tuple(failures))
    return validation, drawn


def _failures(exercise: Exercise, v: dict[str, Any], seed: int) -> Iterator[Failure]:
    key = AnswerKey(exercise, v)
    for kind, found in (
        ("full marks", _without_full_marks(exercise, v, key)),
        ("nonsense", _paid_nonsense(exercise, v, key)),
        ("mistakes", _unnamed_mistakes(exercise, v, key)),
        ("printable", _unprintable(exercise, key)),
        ("render", _unrendered(exercise, v, key, in_full=seed < RENDERED)),
    ):
        for part, sentence in _told(found):
            yield Failure(kind, seed, part, sentence)


def _told(found: "Found") -> list[tuple[str, str]]:
    """What was found, and in place of what follows from an exception, the exception."""
    told: list[tuple[str, str]] = []
    with marking_failures() as errors:
        try:
            told.extend(found)
        except Exception as error:  # noqa: BLE001 - an exercise file may fail in any way; that is the finding
            told.append(("", _because(error)))
    broken = {part: f"marking stopped with {stopped(error)}" for part, error in errors}
    return [*broken.items(), *((part, sentence) for part, sentence in told if part not in broken)]


def _because(error: Exception) -> str:
    """The sentence of an exception; its traceback only where it was asked for."""
    if debugging():
        traceback.print_exception(error, file=sys.stderr)
    return str(error) if isinstance(error, KinegradeError) else f"it stopped with {stopped(error)}"


Found = Iterator[tuple[str, str]]


def _without_full_marks(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """The reference, and what a student gets who rounds every answer to the asked decimals and goes on with it."""
    for how, answers in (("", key.reference), (" at the asked decimals", _worked_with_rounding(exercise, v))):
        raws = {part.variable: handed_in(part.answer, answers[part.variable], v) for part in exercise.asked}
        for part, verdict in zip(exercise.asked, mark(exercise, v, raws, key=key), strict=True):
            if not isinstance(part.answer, Manual) and verdict.points != part.points:
                said = " ".join(finding.text for finding in verdict.findings)
                yield part.variable, f"the solution{how} earns {verdict.points} of {part.points:g}. {said}"


def _worked_with_rounding(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    given: dict[str, Any] = {}
    for part in exercise.parts:
        value = solve(exercise.slug, part, v, {name: given[name] for name in part.needs})
        given[part.variable] = rounded(part.answer, value) if part.asked else value
    return given


def _paid_nonsense(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    for name, spoil in NONSENSE.items():
        raws = {part.variable: spoil(part.answer, key.reference[part.variable], v) for part in exercise.asked}
        for verdict in mark(exercise, v, raws, key=key):
            if verdict.points or (verdict.points is None and not _is_manual(exercise, verdict.part)):
                yield verdict.part, f"{name} earns {verdict.points} of {verdict.out_of:g}"


def _is_manual(exercise: Exercise, variable: str) -> bool:
    return any(part.variable == variable and isinstance(part.answer, Manual) for part in exercise.asked)


def _unnamed_mistakes(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """Known mistakes that give the right answer, or have no name."""
    for part in exercise.asked:
        for sentence, mistaken in key.mistaken(part, key.wanted(part)):
            verdict = mark_part(key, part, handed_in(part.answer, mistaken.value, v))
            if verdict.status == "correct":
                yield part.variable, f"this known mistake gives the right answer: {sentence}"
            elif not verdict.findings and not verdict.reading:
                yield part.variable, f"this known mistake is not named: {sentence}"


def _unprintable(exercise: Exercise, key: AnswerKey) -> Found:
    for part in exercise.asked:
        if isinstance(part.answer, Numbers):
            sizes = np.abs(np.asarray(key.reference[part.variable]))
            if sizes.max() >= LARGEST:
                yield part.variable, f"an entry is as large as {sizes.max():.3g}"
            if not np.round(sizes, part.answer.decimals).any():
                yield part.variable, f"all entries are zero at {part.answer.decimals} decimals"


def _unrendered(exercise: Exercise, v: dict[str, Any], key: AnswerKey, *, in_full: bool) -> Found:
    """Texts and worked solution of every draw; of the first ones the notebooks with their figures too."""
    texts = [exercise.statement(v)]
    for part in exercise.asked:
        page_text(part.prompt)
        texts += [part.prompt, *part.hints, *worked_steps(part, v, key.reference)]
        for mistake in part.mistakes:
            if "$" in mistake.sentence:
                yield part.variable, f"a finding is plain text, without LaTeX: {mistake.sentence[:60]}"
    for text in texts:
        if text.count("$") % 2:
            yield "", f"a dollar sign is left open in: {text[:60]}"
    if in_full:
        sheet = Sheet(name="validate", exercises=(exercise.slug,))
        notebooks("validate", sheet, Student("validate", "validate"), [(exercise, v)])
