"""Proof that one draw of an exercise can be solved, marked and told apart from nonsense and from its known mistakes."""

import sys
import traceback
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...exercises.answers import Manual, Numbers
from ...exercises.exercise import Exercise, solve
from ...exercises.files.loading import stopped
from ...grader.kinds.markers import handed_in
from ...grader.marking.answer_key import AnswerKey
from ...grader.marking.mark import mark, mark_part
from ...solutions.errors import KinegradeError
from ..complaints import debugging, marking_failures
from ..config import Sheet, Student
from ..formulas import page_text
from ..sheet.notebook import notebooks, worked_steps
from .nonsense import NONSENSE
from .solved import unasked, unsolved

LARGEST = 1e5  # a number that is still printed and typed with pleasure
RENDERED = 2  # draws whose sheets are made in full, with figures


@dataclass(frozen=True)
class Failure:
    """What is wrong with one draw of an exercise; `part` is empty where it is about the whole."""

    kind: str
    seed: int
    part: str
    sentence: str


def failures_of(exercise: Exercise, v: dict[str, Any], seed: int) -> Iterator[Failure]:
    """All that is wrong with one draw, each under the first kind of proof that it spoils."""
    key = AnswerKey(exercise, v)
    known: set[tuple[str, str]] = set()
    for kind, found in (
        ("full marks", _without_full_marks(exercise, v, key)),
        ("nonsense", _paid_nonsense(exercise, v, key)),
        ("mistakes", _unnamed_mistakes(exercise, v, key)),
        ("printable", _unprintable(exercise, key)),
        ("render", _unrendered(exercise, v, key)),
        ("solution", _unsolved(exercise, v, key, seed)),
    ):
        for part, sentence in _told(found):
            if (part, sentence) not in known:
                known.add((part, sentence))
                yield Failure(kind, seed, part, sentence)


def _told(found: "Found") -> list[tuple[str, str]]:
    """What was found, and in place of what follows from an exception, the exception."""
    told: list[tuple[str, str]] = []
    with marking_failures() as errors:
        try:
            told.extend(found)
        except Exception as error:  # noqa: BLE001 - an exercise file may fail in any way; that is the finding
            told.append(("", because(error)))
    broken = {part: f"marking stopped with {stopped(error)}" for part, error in errors}
    return [*broken.items(), *((part, sentence) for part, sentence in told if part not in broken)]


def because(error: Exception) -> str:
    """The sentence of an exception; its traceback only where it was asked for."""
    if debugging():
        traceback.print_exception(error, file=sys.stderr)
    return str(error) if isinstance(error, KinegradeError) else f"it stopped with {stopped(error)}"


Found = Iterator[tuple[str, str]]


def _without_full_marks(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """The reference, and what a student gets who rounds every answer to the asked decimals and goes on with it."""
    for how, answers in (
        ("", key.reference),
        (" at the asked decimals", _worked_with_rounding(exercise, v)),
    ):
        raws = {
            part.variable: handed_in(part.answer, answers[part.variable], v)
            for part in exercise.asked
        }
        for part, verdict in zip(exercise.asked, mark(exercise, v, raws, key=key), strict=True):
            if not isinstance(part.answer, Manual) and verdict.points != part.points:
                said = " ".join(finding.text for finding in verdict.findings)
                yield (
                    part.variable,
                    f"the solution{how} earns {verdict.points} of {part.points:g}. {said}",
                )


def _worked_with_rounding(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    given: dict[str, Any] = {}
    for part in exercise.parts:
        value = solve(exercise.slug, part, v, {name: given[name] for name in part.needs})
        given[part.variable] = part.answer.rounded(value) if part.asked else value
    return given


def _paid_nonsense(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    for name, spoil in NONSENSE.items():
        raws = {
            part.variable: spoil(part.answer, key.reference[part.variable], v)
            for part in exercise.asked
        }
        for verdict in mark(exercise, v, raws, key=key):
            if verdict.points or (
                verdict.points is None and not _is_manual(exercise, verdict.part)
            ):
                yield verdict.part, f"{name} earns {verdict.points} of {verdict.out_of:g}"


def _is_manual(exercise: Exercise, variable: str) -> bool:
    return any(
        part.variable == variable and isinstance(part.answer, Manual) for part in exercise.asked
    )


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
                yield (
                    part.variable,
                    f"a finding is plain text, without LaTeX: {mistake.sentence[:60]}",
                )
    for text in texts:
        if text.count("$") % 2:
            yield "", f"a dollar sign is left open in: {text[:60]}"


def _unsolved(exercise: Exercise, v: dict[str, Any], key: AnswerKey, seed: int) -> Found:
    """What cannot be asked; of the first draws the notebooks, of the very first the worked solution run and marked."""
    known = unasked(exercise, v, key)
    yield from known.items()
    if seed >= RENDERED:
        return
    sheet = Sheet(name="validate", exercises=(exercise.slug,))
    _, solution = notebooks("validate", sheet, Student("validate", "validate"), [(exercise, v)])
    if seed == 0:
        yield from unsolved(exercise, v, key, solution, known)
