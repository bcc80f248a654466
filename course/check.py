"""A student's own check: verdicts on one file as far as the sheet's mode allows, from the sheet's own numbers."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import numpy as np

from ..exercises.exercise import Exercise
from ..exercises.files.finding import exercise_files, find
from ..exercises.files.neighbours import is_ours
from ..grader.collecting.ask import Limits
from ..grader.collecting.wire import Raw
from ..grader.marking.mark import mark
from ..grader.marking.own_work import Remark, remarks
from ..grader.marking.verdict import STATUS_WORDS, Verdict
from ..grader.reading.unreadable import entries_named
from ..solutions.errors import KinegradeError
from .config import CourseError, Mode
from .drawn import drawn
from .sheet.notebook import KEY
from .sheet.submissions import read_submission

MOST_PLACES = 6  # of wrong entries that are named


@dataclass(frozen=True)
class Handout:
    """What a handed-out notebook says of itself."""

    sheet: str
    mode: Mode
    numbers: Mapping[str, dict[str, Any]]


def check_file(
    path: Path, sheet: Path | None = None, exercises: Path | None = None
) -> tuple[Handout, list[Remark]]:
    """Remarks on every part of a student's file. `sheet` is the handed-out notebook, where the file is not one.

    A course's own exercises are looked for in the folder `exercises`, else in those of `own_folders`.

    Raises:
        CourseError: a file cannot be read, or does not say which sheet it belongs to.
        ExerciseError: an exercise file of the course cannot be run.
    """
    if exercises is not None and not exercises.is_dir():
        raise CourseError(
            f"{exercises} is no folder; --exercises takes the one with the course's exercise files"
        )
    submission = read_submission(path)
    handout = read_handout(sheet or path)
    folders = [exercises] if exercises else own_folders(path)
    files = exercise_files(*folders)
    known = [find(slug, files) for slug in handout.numbers if slug in files]
    if not known:
        looked = (
            f"nor in {' or '.join(map(str, folders))}"
            if folders
            else "nor is there a folder exercises/"
        )
        raise CourseError(
            f"{sheet or path}: none of its exercises is installed here: {', '.join(handout.numbers)}; {looked} "
            "(--exercises DIR, if you were given exercise files)"
        )
    numbers = {
        exercise.slug: with_samples(exercise, handout.numbers[exercise.slug]) for exercise in known
    }
    asks = [ask for exercise in known for ask in submission.asks(exercise, numbers[exercise.slug])]
    raws = submission.raws(asks, Limits())
    unknown = "an exercise of this course that is not installed here; it is not checked"
    found = [Remark(slug, ok=True, text=unknown) for slug in handout.numbers if slug not in files]
    for exercise in known:
        try:
            found += _remarks(handout.mode, exercise, numbers[exercise.slug], raws)
        except (KinegradeError, LookupError, TypeError, ValueError, ArithmeticError) as error:
            raise CourseError(
                f"{path}: the numbers of {exercise.slug} in this sheet are damaged: {error!r}"
            ) from error
    return handout, found


def own_folders(path: Path) -> list[Path]:
    """Where exercise files may lie that this machine's owner put there: beside the notebook, and where one is.

    What lies in a course's submitted/ came from somebody else and is not run.
    """
    places = [place for place in (path.parent, Path()) if not _is_handed_in(place)]
    found = {(place / "exercises").resolve(): place / "exercises" for place in places}
    return [folder for real, folder in found.items() if real.is_dir() and not is_ours(real)]


def _is_handed_in(place: Path) -> bool:
    folder = place.resolve()
    return any(
        outer.name == "submitted" and (outer.parent / "course.toml").exists()
        for outer in (folder, *folder.parents)
    )


def with_samples(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    """The sheet's numbers, and in place of those that the instructor keeps what a first draw would have."""
    if not exercise.hidden:
        return v
    sample = drawn(exercise, np.random.default_rng(0))
    return {**{name: sample[name] for name in exercise.hidden if name in sample}, **v}


def read_handout(path: Path) -> Handout:
    """Sheet, mode and numbers from a notebook's metadata.

    Raises:
        CourseError: it is no notebook, or the metadata were lost; the sentence says what to do then.
    """
    try:
        about: Any = json.loads(path.read_bytes())["metadata"][KEY]
        numbers: dict[str, Any] = {slug: about["numbers"][slug] for slug in about["exercises"]}
        mode = about["mode"]
        if mode not in get_args(Mode) or not all(isinstance(v, dict) for v in numbers.values()):
            raise ValueError(mode)  # noqa: TRY301 - one sentence for every way of being damaged
        return Handout(str(about["sheet"]), mode, numbers)
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror}") from error
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise CourseError(
            f"{path} does not say which sheet it belongs to (another program may have dropped that); "
            "add the notebook as it was handed out: kinegrade check FILE --sheet HANDED_OUT.ipynb"
        ) from error


def _remarks(
    mode: Mode, exercise: Exercise, v: dict[str, Any], raws: Mapping[str, Raw]
) -> Iterator[Remark]:
    if mode == "practice":
        return map(_told, mark(exercise, v, raws))
    return remarks(exercise, v, raws, consistency=mode == "graded")


def _wrong_entries(right: Any) -> str:
    """How many entries are right, and the first places of those that are not."""
    try:
        mask = np.array(right, dtype=bool)
    except ValueError:  # groups of calls of different sizes speak for themselves
        return ""
    if right is None or mask.size < 2 or mask.all() or not mask.any():
        return ""
    return f"{mask.sum()} of {mask.size} entries right, not these: {entries_named(~mask, MOST_PLACES)}."


def _told(verdict: Verdict) -> Remark:
    """All of a verdict but the reference: status, reading, findings, and which entries are right."""
    findings = (finding.text for finding in verdict.findings if not finding.private)
    texts = [verdict.reading, *findings, _wrong_entries(verdict.right)]
    said = " ".join(text for text in texts if text)
    words = STATUS_WORDS[verdict.status]
    ok = verdict.status in (
        "correct",
        "not_graded",
    )  # what waits for somebody else is not to be looked at again
    return Remark(verdict.part, ok, f"{words}: {said}" if said else words)
