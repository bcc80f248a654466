"""Proof that an exercise can be solved, marked and told apart from nonsense and from its known mistakes."""

import json
import os
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

from ..exercises.answers import Manual, Numbers
from ..exercises.catalogue import exercise_files, find, load
from ..exercises.exercise import Exercise, ExerciseError, solve
from ..grader.answer_key import AnswerKey
from ..grader.handed_in import handed_in, rounded
from ..grader.mark import mark, mark_part
from .config import Sheet, Student
from .formulas import page_text
from .nonsense import NONSENSE
from .notebook import notebooks, worked_steps
from .solved import unsolved
from .variant import canonical

KINDS = ("solve", "full marks", "nonsense", "mistakes", "printable", "render", "solution", "variants")
LARGEST = 1e5  # a number that is still printed and typed with pleasure
RENDERED = 2  # draws whose sheets are made in full, with figures
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
    """Files of the named exercises, or of all that come with the package and lie in a course's folder.

    Raises:
        ExerciseError: a name is neither an exercise nor a file.
    """
    files = exercise_files(folder)
    for name in names:
        path = Path(name)
        if path.suffix != ".py" or not path.exists():
            find(name, files)  # says what is known
    return [Path(name) if name.endswith(".py") else files[name] for name in names] or [*files.values()]


def summary(validation: Validation) -> Iterator[str]:
    """One line for every part and kind of failure: how often, and the first of it."""
    groups: dict[tuple[str, str], list[Failure]] = {}
    for failure in validation.failures:
        groups.setdefault((failure.kind, failure.part), []).append(failure)
    for (kind, part), failures in groups.items():
        draws = {failure.seed for failure in failures}
        often = f"in {len(draws)} of {validation.draws} draws, first {min(draws)}"
        yield f"{kind}{f', {part}' if part else ''}, {often}: {failures[0].sentence}"


def validate(paths: Sequence[Path], seeds: int, step: Callable[[], None] = lambda: None) -> list[Validation]:
    """A validation for every exercise file, in order; `step` is called after each chunk of draws."""
    chunks = [(path, range(seeds)[start : start + CHUNK]) for path in paths for start in range(0, seeds, CHUNK)]
    found: dict[Path, list[tuple[Validation, list[str]]]] = {path: [] for path in paths}
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("spawn")) as pool:  # typst does not survive a fork
        for (path, _), result in zip(chunks, pool.map(_look_at, *zip(*chunks, strict=True)), strict=True):
            found[path].append(result)
            step()
    return [_together(results) for results in found.values()]


def steps(files: int, seeds: int) -> int:
    """How often `validate` calls its step."""
    return files * len(range(0, seeds, CHUNK))


def validate_file(path: Path, seeds: int) -> Validation:
    """The validation of one exercise file, in this process."""
    return _together([_look_at(path, range(seeds))])


def _together(results: Sequence[tuple[Validation, list[str]]]) -> Validation:
    """One validation of all chunks, and whether draws repeat each other too often."""
    first = results[0][0]
    drawn = [text for _, texts in results for text in texts]
    failures = [failure for validation, _ in results for failure in validation.failures]
    alike = len(drawn) - len(set(drawn))
    if alike > max(1, MOST_ALIKE * len(drawn)):
        sentence = f"{alike} of {len(drawn)} draws repeat an earlier one; draw from wider sets"
        failures.append(Failure("variants", 0, "", sentence))
    seconds = max(validation.seconds_to_draw for validation, _ in results)
    return replace(first, draws=len(drawn), seconds_to_draw=seconds, failures=tuple(failures))


def _look_at(path: Path, seeds: Iterable[int]) -> tuple[Validation, list[str]]:
    """What some draws show, and the drawn numbers as text."""
    try:
        exercise = load(path)
    except ExerciseError as error:
        return Validation(path.stem, 0, 0, 0, 0.0, (Failure("solve", 0, "", str(error)),)), []
    failures, drawn, seconds = list[Failure](), list[str](), 0.0
    for seed in seeds:
        try:
            start = time.perf_counter()
            v = exercise.draw(np.random.default_rng(seed))
            seconds = max(seconds, time.perf_counter() - start)
            after = json.loads(json.dumps(v))
            if after != v:
                raise ValueError("the drawn numbers change on their way through JSON")  # noqa: TRY301
            drawn.append(canonical(after))
            failures += _failures(exercise, after, seed)
        except Exception as error:  # noqa: BLE001 - an exercise file may fail in any way; that is the finding
            failures.append(Failure("solve", seed, "", f"{type(error).__name__}: {error}"))
    validation = Validation(exercise.slug, len(exercise.asked), exercise.points, len(drawn), seconds, tuple(failures))
    return validation, drawn


def _failures(exercise: Exercise, v: dict[str, Any], seed: int) -> Iterator[Failure]:
    key = AnswerKey(exercise, v)
    for kind, found in (
        ("full marks", _without_full_marks(exercise, v, key)),
        ("nonsense", _paid_nonsense(exercise, v, key)),
        ("mistakes", _unnamed_mistakes(exercise, v, key)),
        ("printable", _unprintable(exercise, key)),
        ("render", _unrendered(exercise, v, key)),
        ("solution", _unsolved(exercise, v, key, seed)),
    ):
        yield from (Failure(kind, seed, part, sentence) for part, sentence in found)


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


def _unrendered(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """Texts and worked solution."""
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


def _unsolved(exercise: Exercise, v: dict[str, Any], key: AnswerKey, seed: int) -> Found:
    """Of the first draws the notebooks with their figures; of the very first, the worked solution run and marked."""
    if seed < RENDERED:
        sheet = Sheet(name="validate", exercises=(exercise.slug,))
        _, solution = notebooks("validate", sheet, Student("validate", "validate"), [(exercise, v)])
        if seed == 0:
            yield from unsolved(exercise, v, key, solution)
