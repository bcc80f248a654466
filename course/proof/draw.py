"""Proof that one draw of an exercise can be solved and marked.

Its answers are told apart from nonsense and from its known mistakes.
"""

import sys
import traceback
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...exercises.answers import Choice, Manual, Numbers
from ...exercises.exercise import Exercise, solve
from ...exercises.files.loading import stopped
from ...grader.collecting.wire import Raw
from ...grader.kinds.markers import handed_in
from ...grader.marking.answer_key import AnswerKey
from ...grader.marking.mark import mark, mark_part
from ...solutions.errors import KinegradeError
from ..machine.complaints import debugging, marking_failures
from ..settings.config import Sheet, Student
from ..sheet.assignment import Assignment
from ..sheet.given import given_numbers
from ..sheet.notebook import notebooks
from ..sheet.worked import worked_steps
from ..text.formulas import page_text
from ..typeset.mathml import FormulaError
from ..typeset.prose import prose
from .nonsense import NONSENSE
from .solved import unasked, unsolved

LARGEST = 1e5  # a number that is still printed and typed with pleasure
RENDERED = 2  # draws whose sheets are made in full, with figures


Found = Iterator[tuple[str, str]]
"""Variables of parts, empty where a finding is about the whole, with a sentence each."""


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
    proofs = {
        "full marks": _without_full_marks(exercise, v, key),
        "nonsense": _paid_nonsense(exercise, v, key),
        "mistakes": _unnamed_mistakes(exercise, v, key),
        "printable": _unprintable(exercise, key),
        "render": _unrendered(exercise, v, key),
        "solution": _unsolved(exercise, v, key, seed),
    }
    known: set[tuple[str, str]] = set()
    for kind, found in proofs.items():
        for part, sentence in _told(found):
            if (part, sentence) in known:
                continue
            known.add((part, sentence))
            yield Failure(kind, seed, part, sentence)


def _told(found: Found) -> list[tuple[str, str]]:
    """What was found, and in place of what follows from an exception, the exception."""
    told: list[tuple[str, str]] = []
    with marking_failures() as errors:
        try:
            told.extend(found)
        except Exception as error:  # noqa: BLE001 - whatever an exercise file raises is the finding
            told.append(("", because(error)))

    broken: dict[str, str] = {}
    for variable, error in errors:
        broken[variable] = f"marking stopped with {stopped(error)}"
    others = [(variable, sentence) for variable, sentence in told if variable not in broken]
    return [*broken.items(), *others]


def because(error: Exception) -> str:
    """The sentence of an exception; its traceback only where it was asked for."""
    if debugging():
        traceback.print_exception(error, file=sys.stderr)
    if isinstance(error, KinegradeError):
        return str(error)
    return f"it stopped with {stopped(error)}"


def raws_of(exercise: Exercise, answers: dict[str, Any], v: dict[str, Any]) -> dict[str, Raw]:
    """What a student hands in whose answers are these, by variable."""
    raws: dict[str, Raw] = {}
    for part in exercise.asked:
        raws[part.variable] = handed_in(part.answer, answers[part.variable], v)
    return raws


def _without_full_marks(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """What the reference lacks, and what a student lacks who goes on with rounded answers."""
    rounded = _worked_with_rounding(exercise, v)
    yield from _short_of_full_marks(exercise, v, key, "the solution", key.reference)
    yield from _short_of_full_marks(exercise, v, key, "the solution at the asked decimals", rounded)


def _short_of_full_marks(
    exercise: Exercise, v: dict[str, Any], key: AnswerKey, what: str, answers: dict[str, Any]
) -> Found:
    raws = raws_of(exercise, answers, v)
    for part, verdict in zip(exercise.asked, mark(exercise, v, raws, key=key), strict=True):
        if isinstance(part.answer, Manual) or verdict.points == part.points:
            continue
        said = " ".join(finding.text for finding in verdict.findings)
        earned = f"{verdict.points} of {part.points:g}"
        yield part.variable, f"{what} earns {earned}. {said}"


def _worked_with_rounding(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    """Answers that are each rounded to the asked decimals before others are computed from them."""
    given: dict[str, Any] = {}
    for part in exercise.parts:
        needed = {name: given[name] for name in part.needs}
        value = solve(exercise.slug, part, v, needed)
        if part.asked:
            value = part.answer.rounded(value)
        given[part.variable] = value
    return given


def _paid_nonsense(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """Parts that earn points by nonsense, or in which it is not marked at all."""
    for name, spoil in NONSENSE.items():
        raws: dict[str, Raw] = {}
        for part in exercise.asked:
            raws[part.variable] = spoil(part.answer, key.reference[part.variable], v)

        for part, verdict in zip(exercise.asked, mark(exercise, v, raws, key=key), strict=True):
            left_to_a_person = verdict.points is None and isinstance(part.answer, Manual)
            if verdict.points == 0 or left_to_a_person:
                continue
            yield part.variable, f"{name} earns {verdict.points} of {verdict.out_of:g}"


def _unnamed_mistakes(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """Known mistakes that give the right answer, or have no name."""
    for part in exercise.asked:
        for named, mistaken in key.mistaken(part, key.wanted(part)):
            verdict = mark_part(key, part, handed_in(part.answer, mistaken.value, v))
            if verdict.status == "correct":
                yield part.variable, f"this known mistake gives the right answer: {named.sentence}"
            elif not verdict.findings and not verdict.reading:
                yield part.variable, f"this known mistake is not named: {named.sentence}"


def _unprintable(exercise: Exercise, key: AnswerKey) -> Found:
    """Answers of numbers that are too large to type, or too small to be seen."""
    for part in exercise.asked:
        if not isinstance(part.answer, Numbers):
            continue
        decimals = part.answer.decimals
        sizes = np.abs(np.asarray(key.reference[part.variable]))
        if sizes.max() >= LARGEST:
            yield part.variable, f"an entry is as large as {sizes.max():.3g}"
        if not np.round(sizes, decimals).any():
            yield part.variable, f"all entries are zero at {decimals} decimals"


def _unrendered(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> Found:
    """Texts that cannot be shown: of the exercise, its parts and their worked solutions."""
    about = [*exercise.objectives, exercise.statement(v), *given_numbers(exercise, v)]
    about += [drawing.caption for drawing in exercise.drawings(v)]
    yield from _unset("", about)
    for part in exercise.asked:
        page_text(part.prompt)  # raises on a formula that pages cannot show
        texts = [part.prompt, *part.hints, *worked_steps(part, v, key.reference)]
        if isinstance(part.answer, Choice):
            texts += part.answer.options
        yield from _unset(part.variable, texts)
        for mistake in part.mistakes:
            if "$" in mistake.sentence:
                start = mistake.sentence[:60]
                yield part.variable, f"a finding is plain text, without LaTeX: {start}"


def _unset(variable: str, texts: Sequence[str]) -> Found:
    """Texts with a formula or markup that cannot be set in a PDF."""
    for text in texts:
        if text.count("$") % 2:
            yield variable, f"a dollar sign is left open in: {text[:60]}"
            continue
        try:
            prose(text)
        except FormulaError as error:
            yield variable, str(error)


def _unsolved(exercise: Exercise, v: dict[str, Any], key: AnswerKey, seed: int) -> Found:
    """What cannot be asked, and what notebooks and PDFs lack.

    They take time, so they are made of the first draws; of the very first, the worked solution is
    run and marked.
    """
    known = unasked(exercise, v, key)
    yield from known.items()
    if seed >= RENDERED:
        return
    sheet = Sheet(name="validate", exercises=(exercise.slug,))
    one = Assignment(exercise, v)
    for figure in (*one.figures, *one.solved_figures):
        if figure.lost:
            yield "", f"a figure cannot be drawn: {figure.lost}"
    _, solution = notebooks("validate", sheet, Student("validate", "validate"), [one])
    if seed == 0:
        yield from unsolved(exercise, v, key, solution, known)
