"""A student's own check of one file: what the sheet's mode allows, from the sheet's numbers."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args

import numpy as np

from ..exercises.exercise import Exercise, Function, references
from ..exercises.files.finding import exercise_files, find
from ..exercises.files.neighbours import is_ours
from ..grader.collecting.ask import Ask, Limits
from ..grader.collecting.wire import Raw
from ..grader.jail.jail import FOR_ONE, Jail
from ..grader.jail.level import ANY
from ..grader.marking.mark import mark
from ..grader.marking.own_work import Remark, readable, remarks
from ..grader.marking.verdict import STATUS_WORDS, Verdict
from ..grader.reading.unreadable import entries_named
from ..solutions.errors import KinegradeError
from .adjusting import adjusted_here
from .config import CourseError, LimitsTable, Mode, PackagesTable, Sheet
from .drawn import drawn
from .escape import printable
from .sheet.about import read_about
from .sheet.handed_in import read_handed_in

MOST_PLACES = 6  # of wrong entries that are named
SAMPLES = 12  # draws that show which answers hang on numbers that the sheet does not print
NOT_PRINTED = (
    "can be read; whether it is right hangs on what your sheet says in words, "
    "which is not looked at here"
)
NOT_INSTALLED = "an exercise of this course that is not installed here; it is not checked"

TOLD: dict[Mode, str] = {
    "practice": "Practice sheet: everything is told but the reference values.",
    "graded": "Graded sheet: this tells whether answers can be read and fit each other, "
    "not if they are right.",
    "exam": "Exam sheet: this tells whether answers can be read, nothing more.",
}
"""What `check` says of a sheet, by its mode."""


@dataclass(frozen=True)
class Handout:
    """What a handed-out notebook says of itself."""

    sheet: str
    mode: Mode
    numbers: Mapping[str, dict[str, Any]]
    limits: Limits = field(default_factory=Limits)
    packages: tuple[str, ...] = ()
    adjustments: Mapping[str, Any] = field(default_factory=dict[str, Any])


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
    installed, missing = _installed(handout, folders)
    if not installed:
        raise CourseError(f"{sheet or path}: {_none_installed(handout, folders)}")
    installed = adjusted_here(installed, handout.adjustments)

    numbers: dict[str, dict[str, Any]] = {}
    for exercise in installed:
        numbers[exercise.slug] = with_samples(exercise, handout.numbers[exercise.slug])
    asks: list[Ask] = []
    for exercise in installed:
        asks += submission.asks(exercise, numbers[exercise.slug])
    # Whoever checks a file runs code of their own, which they ran in Jupyter a minute ago.
    with Jail(ANY, handout.packages, preload=FOR_ONE) as jail:
        raws = submission.raws(asks, handout.limits, jail)

    found = [Remark(slug, ok=True, text=NOT_INSTALLED) for slug in missing]
    for exercise in installed:
        try:
            found += _of_exercise(handout, exercise, numbers[exercise.slug], raws)
        except (KinegradeError, LookupError, TypeError, ValueError, ArithmeticError) as error:
            raise CourseError(
                f"{path}: the numbers of {exercise.slug} in this sheet are damaged: {error!r}"
            ) from error
    return handout, found


def remark_lines(found: Iterable[Remark]) -> Iterator[str]:
    """What is shown of remarks: a mark, the part and a sentence, then what was typed."""
    for remark in found:
        mark_of = "✓" if remark.ok else "✗"
        sentence, *typed = remark.text.split("\n")
        yield f"{mark_of} {remark.part:28} {printable(sentence)}"
        for line in typed:
            yield f"{'':30} {printable(line)}"


def exercise_folders(path: Path, exercises: Path | None) -> list[Path]:
    """Where a course's own exercises are: the folder that is named, else those of `own_folders`.

    Raises:
        CourseError: what is named is no folder.
    """
    if exercises is None:
        return own_folders(path)
    if not exercises.is_dir():
        raise CourseError(
            f"{exercises} is no folder; --exercises takes the one with the course's exercise files"
        )
    return [exercises]


def _installed(handout: Handout, folders: Sequence[Path]) -> tuple[list[Exercise], list[str]]:
    """The sheet's exercises whose files are here, and the names of those whose are not."""
    files = exercise_files(*folders)
    installed: list[Exercise] = []
    missing: list[str] = []
    for slug in handout.numbers:
        if slug in files:
            installed.append(find(slug, files))
        else:
            missing.append(slug)
    return installed, missing


def _none_installed(handout: Handout, folders: Sequence[Path]) -> str:
    looked = "nor is there a folder exercises/"
    if folders:
        looked = f"nor in {' or '.join(map(str, folders))}"
    return (
        f"none of its exercises is installed here: {', '.join(handout.numbers)}; {looked} "
        "(--exercises DIR, if you were given exercise files)"
    )


def own_folders(path: Path) -> list[Path]:
    """Folders of exercise files that this machine's owner made: beside the notebook, and here.

    What lies in a course's submitted/ came from somebody else and is not run.
    """
    found: dict[Path, Path] = {}
    for place in (path.parent, Path()):
        folder = place / "exercises"
        real = folder.resolve()
        if real.is_dir() and not is_ours(real) and not _is_handed_in(place):
            found[real] = folder
    return list(found.values())


def _is_handed_in(place: Path) -> bool:
    folder = place.resolve()
    for outer in (folder, *folder.parents):
        if outer.name == "submitted" and (outer.parent / "course.toml").exists():
            return True
    return False


def with_samples(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    """The sheet's numbers; for those that the instructor keeps, what some draw gives instead."""
    if not exercise.hidden:
        return v
    sample = drawn(exercise, np.random.default_rng(0))
    numbers: dict[str, Any] = {}
    for name in exercise.hidden:
        if name in sample:
            numbers[name] = sample[name]
    return numbers | v


def unseen_parts(exercise: Exercise, v: dict[str, Any]) -> set[str]:
    """Parts whose right answer hangs on numbers that the sheet does not print.

    What a function returns does not: only what it is called with.
    """
    missing = [name for name in exercise.hidden if name not in v]
    if not missing:
        return set()
    seen: dict[str, set[str]] = {part.variable: set() for part in exercise.asked}
    for seed in range(SAMPLES):
        sample = drawn(exercise, np.random.default_rng(seed))
        numbers = v | {name: sample[name] for name in missing if name in sample}
        answers = references(exercise, numbers)
        for part in exercise.asked:
            if not isinstance(part.answer, Function):
                seen[part.variable].add(repr(answers[part.variable]))
    return {variable for variable, answers in seen.items() if len(answers) > 1}


def read_handout(path: Path) -> Handout:
    """Sheet, mode and numbers from what a notebook or script says of itself.

    Raises:
        CourseError: it is neither, or that was lost; it says what to do then.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise CourseError(f"{path} cannot be read: {error.strerror}") from error
    return handout_in(data, path)


def handout_in(data: bytes, path: Path) -> Handout:
    """As `read_handout`, of bytes that were read from there."""
    try:
        return _handout(read_about(data, path.suffix.lower()))
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise CourseError(
            f"{path} does not say which sheet it belongs to (another program may have dropped "
            "that); add the notebook as it was handed out: "
            "kinegrade check FILE --sheet HANDED_OUT.ipynb"
        ) from error


def _handout(about: Any) -> Handout:
    """Raises an error of a type that says little, as all kinds of damage get one sentence."""
    numbers: dict[str, dict[str, Any]] = {}
    for slug in about["exercises"]:
        given = about["numbers"][slug]
        if not isinstance(given, dict):
            raise TypeError(slug)
        numbers[slug] = given
    mode = about["mode"]
    if mode not in get_args(Mode):
        raise ValueError(mode)
    limits = LimitsTable.model_validate(about.get("limits", {}))
    packages = PackagesTable.model_validate(about.get("packages", {}))
    adjustments = Sheet.model_validate(
        {"name": "sheet", "exercises": tuple(numbers), **about.get("adjusted", {})}
    ).adjustments()
    return Handout(
        str(about["sheet"]),
        mode,
        numbers,
        Limits(**limits.model_dump()),
        packages.allow,
        adjustments,
    )


def _of_exercise(
    handout: Handout, exercise: Exercise, v: dict[str, Any], raws: Mapping[str, Raw]
) -> Iterator[Remark]:
    """Remarks on an exercise; where a part cannot be judged here, whether it can be read."""
    parts = {part.variable: part for part in exercise.asked}
    unseen = unseen_parts(exercise, handout.numbers[exercise.slug])
    for remark in _remarks(handout.mode, exercise, v, raws):
        if remark.part in unseen:
            yield readable(parts[remark.part], raws, v, NOT_PRINTED)
        else:
            yield remark


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
    if right is None or mask.size < 2:
        return ""
    if mask.all() or not mask.any():
        return ""
    wrong = entries_named(~mask, MOST_PLACES)
    return f"{mask.sum()} of {mask.size} entries right, not these: {wrong}."


def _told(verdict: Verdict) -> Remark:
    """All of a verdict but the reference: status, reading, findings, which entries are right."""
    findings = [finding.text for finding in verdict.findings if not finding.private]
    texts = [verdict.reading, *findings, _wrong_entries(verdict.right)]
    said = " ".join(filter(None, texts))

    told = STATUS_WORDS[verdict.status]
    if said:
        told = f"{told}: {said}"
    # What waits for somebody else, or is right from wrong answers, has nothing to mend in it.
    ok = verdict.status in ("correct", "follows", "not_graded")
    return Remark(verdict.part, ok, told)
