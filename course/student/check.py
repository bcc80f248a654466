"""A student's own check of one file: what the sheet's mode allows, from the sheet's numbers."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Any

import numpy as np

from ...exercises.exercise import Exercise, Formulas
from ...grader.collecting.wire import Raw
from ...grader.jail.jail import FOR_ONE, Jail
from ...grader.jail.level import ANY
from ...grader.marking.mark import mark
from ...grader.marking.own_work import Remark, readable, remarks
from ...grader.marking.verdict import STATUS_WORDS, Verdict
from ...grader.reading.unreadable import entries_named
from ...solutions.errors import KinegradeError
from ..language.speech import later, phrase, retold, speaking
from ..language.translated import translations
from ..machine.console import shown
from ..settings.adjusting import adjusted_here
from ..settings.config import CourseError, Mode
from ..sheet.handed_in import read_handed_in
from ..sheet.handout import Handout, handout_in, read_handout
from ..text.escape import printable
from .not_printed import unseen_parts, with_samples
from .own_exercises import exercise_folders, installed, none_installed

if TYPE_CHECKING:
    from ...grader.collecting.ask import Ask

MOST_PLACES = 6  # of wrong entries that are named
NOT_PRINTED = later(
    "can be read; whether it is right hangs on what your sheet says in words, "
    "which is not looked at here"
)
NOT_INSTALLED = later("an exercise of this course that is not installed here; it is not checked")


def check_file(
    path: Path, sheet: Path | None = None, exercises: Path | None = None
) -> tuple[Handout, list[Remark]]:
    """Remarks on every part of a student's file.

    `sheet` is the handed-out notebook, where the file is not one. A course's own exercises are
    looked for in the folder `exercises`, else in those of `own_folders`.

    Raises:
        CourseError: a file cannot be read, or does not say which sheet it belongs to.
        ExerciseError: an exercise file of the course cannot be run.
    """
    folders = exercise_folders(path, exercises)
    submission = read_handed_in(path)
    handout = read_handout(sheet) if sheet else handout_in(submission.data, submission.path)
    here, missing = installed(handout.numbers, folders)
    if not here:
        raise CourseError(f"{sheet or path}: {none_installed(handout.numbers, folders)}")
    exercises_here = adjusted_here(here, handout.adjustments)

    numbers: dict[str, dict[str, Any]] = {}
    for exercise in exercises_here:
        numbers[exercise.slug] = with_samples(exercise, handout.numbers[exercise.slug])
    asks: list[Ask] = []
    for exercise in exercises_here:
        asks += submission.asks(exercise, numbers[exercise.slug])
    Thread(target=_load_for, args=(exercises_here,), daemon=True).start()
    # Whoever checks a file runs code of their own, which they ran in Jupyter a minute ago.
    with Jail(ANY, handout.packages, preload=FOR_ONE) as jail:
        raws = submission.raws(asks, handout.limits, jail)

    beside = translations([*handout.numbers], handout.language, *folders)
    with speaking(handout.language, tuple(beside.values())):
        found = [Remark(slug, ok=True, text=phrase(NOT_INSTALLED)) for slug in missing]
        found += _of_all(path, handout, exercises_here, numbers, raws)
    return handout, found


def _load_for(exercises: Iterable[Exercise]) -> None:
    """Loads what formulas are compared with: it takes as long as a notebook, and goes beside it."""
    asked = (part.answer for exercise in exercises for part in exercise.asked)
    if any(isinstance(answer, Formulas) for answer in asked):
        import_module("sympy")


def _of_all(
    path: Path,
    handout: Handout,
    exercises: Sequence[Exercise],
    numbers: Mapping[str, dict[str, Any]],
    raws: Mapping[str, Raw],
) -> list[Remark]:
    """Remarks on every exercise that is installed here, in the language that is spoken."""
    found: list[Remark] = []
    for exercise in exercises:
        try:
            found += _of_exercise(handout, exercise, numbers[exercise.slug], raws)
        except (KinegradeError, LookupError, TypeError, ValueError, ArithmeticError) as error:
            raise CourseError(
                f"{path}: the numbers of {exercise.slug} in this sheet are damaged: {error!r}"
            ) from error
    return found


def remark_lines(found: Iterable[Remark]) -> Iterator[str]:
    """What is shown of remarks: a mark, the part and a sentence, then what was typed."""
    for remark in found:
        mark_of = shown("✓" if remark.ok else "✗")
        sentence, *typed = remark.text.split("\n")
        yield f"{mark_of} {remark.part:28} {printable(sentence)}"
        for line in typed:
            yield f"{'':30} {printable(line)}"


def _of_exercise(
    handout: Handout, exercise: Exercise, v: dict[str, Any], raws: Mapping[str, Raw]
) -> Iterator[Remark]:
    """Remarks on an exercise; where a part cannot be judged here, whether it can be read."""
    parts = {part.variable: part for part in exercise.asked}
    unseen = unseen_parts(exercise, handout.numbers[exercise.slug])
    for remark in _remarks(handout.mode, exercise, v, raws):
        if remark.part in unseen:
            yield readable(parts[remark.part], raws, v, phrase(NOT_PRINTED))
        else:
            yield remark


def _remarks(
    mode: Mode, exercise: Exercise, v: dict[str, Any], raws: Mapping[str, Raw]
) -> Iterator[Remark]:
    if mode == "practice":
        return map(_told, mark(exercise, v, raws))
    return map(_retold, remarks(exercise, v, raws, consistency=mode == "graded"))


def _retold(remark: Remark) -> Remark:
    """A remark in the language spoken; what was typed, below its first line, stays as it is."""
    said, *typed = remark.text.split("\n")
    return replace(remark, text="\n".join([retold(said), *typed]))


def _wrong_entries(right: Any) -> str:
    """How many entries are right, and the first places of those that are not."""
    try:
        mask = np.array(right, dtype=bool)
    except ValueError:  # groups of calls of different sizes speak for themselves
        return ""
    if right is None or mask.size < 2:
        return ""
    if mask.all() or not mask.any():
        return ""
    wrong = entries_named(~mask, MOST_PLACES)
    return phrase(
        "{right} of {of} entries right, not these: {wrong}.",
        right=mask.sum(),
        of=mask.size,
        wrong=retold(wrong),
    )


def _told(verdict: Verdict) -> Remark:
    """All of a verdict but the reference: status, reading, findings, which entries are right."""
    findings = [finding.text for finding in verdict.findings if not finding.private]
    texts = [retold(verdict.reading), *map(retold, findings), _wrong_entries(verdict.right)]
    said = " ".join(filter(None, texts))

    told = retold(STATUS_WORDS[verdict.status])
    if said:
        told = f"{told}: {said}"
    # What waits for somebody else, or is right from wrong answers, has nothing to mend in it.
    ok = verdict.status in ("correct", "follows", "not_graded")
    return Remark(verdict.part, ok, told)
