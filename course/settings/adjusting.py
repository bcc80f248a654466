"""Exercises as a sheet of course.toml has them: its points, decimals, tolerances and parts."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise, Function, Manual, Part
from ...exercises.files.finding import exercise_files, find
from ..errors import CourseError
from .spelling import hint
from .toml_tables import Adjusted, ExerciseTable, PartTable, Sheet

CENTS = 2  # decimals of points that were scaled
ASIS = ExerciseTable()


def exercises_on(sheet: Sheet, own: Path) -> list[Exercise]:
    """The exercises of a sheet, adjusted, in order; `own` is the course's folder of exercise files.

    Raises:
        ExerciseError: one is unknown or broken.
        CourseError: as `adjusted`.
    """
    files = exercise_files(own)
    return adjusted([find(slug, files, own) for slug in sheet.exercises], sheet)


def adjusted(exercises: Sequence[Exercise], sheet: Sheet) -> list[Exercise]:
    """The exercises of a sheet with what its tables set.

    What is set for a part goes before what is set for its exercise, and that before what is set for
    the sheet; points of an exercise or a sheet are spread over what is below in its proportions.

    Raises:
        CourseError: a table names an exercise or a part that is not on the sheet, or all parts of
            an exercise are left out.
    """
    if not sheet.adjustments():
        return list(exercises)
    _refuse_strangers(exercises, sheet)
    made = [_adjusted(exercise, sheet) for exercise in exercises]
    if sheet.points is None:
        return made
    worth = spread([exercise.points for exercise in made], sheet.points)
    return [_worth(exercise, points) for exercise, points in zip(made, worth, strict=True)]


def adjusted_by(adjustments: Mapping[str, Any], exercises: Iterable[Exercise]) -> list[Exercise]:
    """All exercises of a sheet with its adjustments as plain data.

    Raises:
        CourseError: as `adjusted`.
        ValueError: the adjustments are damaged.
    """
    return list(_kept(json.dumps(adjustments, sort_keys=True), tuple(exercises)))


@lru_cache(maxsize=32)
def _kept(adjustments: str, exercises: tuple[Exercise, ...]) -> tuple[Exercise, ...]:
    """Made once for a class: what marking keeps of an exercise is kept by the object."""
    return tuple(adjusted(exercises, _sheet(exercises, json.loads(adjustments))))


def _sheet(exercises: Iterable[Exercise], adjustments: Mapping[str, Any]) -> Sheet:
    slugs = [exercise.slug for exercise in exercises]
    return Sheet.model_validate({"name": "sheet", "exercises": slugs, **adjustments})


def adjusted_here(exercises: Sequence[Exercise], adjustments: Mapping[str, Any]) -> list[Exercise]:
    """Those exercises of a sheet that are installed here, with the adjustments that concern them.

    What points they have among the others cannot be known, and is left as it is.

    Raises:
        ValueError: the adjustments, which a notebook brought along, are damaged.
    """
    whole = _sheet(exercises, adjustments)
    tables = {slug: table for slug, table in whole.exercise.items() if slug in whole.exercises}
    names = asked_names(exercises)
    parts = [table for table in whole.part if table.name in names]
    sheet = whole.model_copy(update={"exercise": tables, "part": tuple(parts), "points": None})
    return adjusted(exercises, sheet)


def asked_names(exercises: Iterable[Exercise]) -> list[str]:
    """The variables that exercises ask for."""
    names: list[str] = []
    for exercise in exercises:
        names += [part.variable for part in exercise.asked]
    return names


def spread(values: Iterable[float], total: float) -> list[float]:
    """Values in their proportions, in hundredths, that add up to the total exactly."""
    sums = [0.0]
    for value in values:
        sums.append(sums[-1] + value)
    marks = [round(total * one / sums[-1], CENTS) for one in sums]
    return [round(end - start, CENTS) for start, end in pairwise(marks)]


def _refuse_strangers(exercises: Sequence[Exercise], sheet: Sheet) -> None:
    slugs = [exercise.slug for exercise in exercises]
    for slug in sheet.exercise:
        if slug not in slugs:
            raise CourseError(
                f"sheet {sheet.name} has a table [sheet.exercise.{slug}]{hint(slug, slugs)}; "
                f"its exercises are: {', '.join(slugs)}"
            )
    names = asked_names(exercises)
    for table in sheet.part:
        if table.name not in names:
            raise CourseError(
                f"sheet {sheet.name} has a [[sheet.part]] {table.name!r}"
                f"{hint(table.name, names)}; its parts are: {', '.join(names)}"
            )


def _adjusted(exercise: Exercise, sheet: Sheet) -> Exercise:
    """One exercise with all but the points of the sheet."""
    own = sheet.exercise.get(exercise.slug, ASIS)
    tables = {table.name: table for table in sheet.part}
    hints = sheet.hints if own.hints is None else own.hints
    parts: list[Part] = []
    for part in exercise.parts:
        table = tables.get(part.variable, PartTable(name=part.variable))
        made = _set(part, (table, own, sheet), hints=hints)
        parts.append(_part_worth(made, table.points or part.points))
        if table.drop:
            parts[-1] = replace(parts[-1], asked=False)

    made_of = replace(exercise, parts=tuple(parts))
    if not made_of.asked:
        raise CourseError(
            f"sheet {sheet.name} leaves out every part of {exercise.slug}; "
            "take the exercise off the sheet instead"
        )
    if own.points is None:
        return made_of
    return _worth(made_of, own.points)


def _set(part: Part, tables: Sequence[Adjusted], *, hints: bool) -> Part:
    """A part with the decimals and the tolerance of the first table that sets them."""
    if not part.asked:
        return part
    decimals = _first(table.decimals for table in tables)
    factor = _first(table.tolerance for table in tables)
    answer = part.answer
    if decimals is not None:
        answer = answer.with_decimals(int(decimals))
    if factor is not None and isinstance(answer, Function):
        answer = replace(answer, tolerance=factor * answer.tolerance)
    return replace(
        part,
        answer=answer,
        tolerance_factor=1.0 if factor is None else factor,
        hints=part.hints if hints else (),
    )


def _first(values: Iterator[float | None]) -> float | None:
    for value in values:
        if value is not None:
            return value
    return None


def _worth(exercise: Exercise, total: float) -> Exercise:
    """An exercise whose asked parts have that many points together."""
    asked = exercise.asked
    worth = spread([part.points for part in asked], total)
    points = {part.variable: one for part, one in zip(asked, worth, strict=True)}
    parts = [_part_worth(part, points.get(part.variable, part.points)) for part in exercise.parts]
    return replace(exercise, parts=tuple(parts))


def _part_worth(part: Part, points: float) -> Part:
    """A part with that many points, and a rubric that adds up to them."""
    if points == part.points:
        return part
    answer = part.answer
    if isinstance(answer, Manual):
        worth = spread([one for one, _ in answer.rubric], points)
        words = [text for _, text in answer.rubric]
        answer = replace(answer, rubric=tuple(zip(worth, words, strict=True)))
    return replace(part, answer=answer, points=points)
