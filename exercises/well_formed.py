"""Whether the parts and units of an exercise can be collected, computed, printed and marked."""

import math
from collections.abc import Collection, Mapping, Sequence
from keyword import iskeyword
from typing import Any, cast

import numpy as np

from .answers import Configurations, Function, Manual, Numbers
from .errors import ExerciseError
from .marked_part import Part
from .units import UnitError, refuse_unknown_unit


def check_part(slug: str, part: Part, known: Mapping[str, Part]) -> None:
    """Refuses a part that could not be collected, computed, printed or marked behind the known."""
    _check_variable(slug, part.variable, known)
    for need in part.needs:
        _check_need(slug, part.variable, need, known)
    if part.asked and not (part.points > 0 and part.prompt):
        raise ExerciseError(
            f"exercise {slug}: {part.variable} takes a prompt, in an exercise file the docstring "
            "of its function, and positive points"
        )
    _check_marking(slug, part)
    if isinstance(part.answer, Numbers | Configurations):
        _check_answer_units(f"exercise {slug}: units of {part.variable}", part.answer)


def _check_variable(slug: str, name: str, known: Collection[str]) -> None:
    if not name.isidentifier() or iskeyword(name) or not name.startswith(f"{slug}_"):
        raise ExerciseError(
            f"exercise {slug}: a variable takes a Python name that starts with {slug}_, "
            f"got {name!r}"
        )
    if name in known:
        raise ExerciseError(
            f"exercise {slug}: two parts are called {name}; a sheet collects answers by name"
        )


def _check_need(slug: str, name: str, need: str, known: Mapping[str, Part]) -> None:
    if need not in known:
        raise ExerciseError(f"exercise {slug}: {name} needs {need}, which is not an earlier part")
    if isinstance(known[need].answer, Function | Manual):
        raise ExerciseError(
            f"exercise {slug}: {name} cannot need {need}: nothing can be computed from it"
        )


def _check_marking(slug: str, part: Part) -> None:
    name, answer = part.variable, part.answer
    if isinstance(answer, Configurations) and part.check is None:
        raise ExerciseError(
            f"exercise {slug}: {name} asks for configurations, which take a check that judges them"
        )
    if isinstance(answer, Manual):
        rubric = sum(points for points, _ in answer.rubric)
        if not math.isclose(rubric, part.points):
            raise ExerciseError(
                f"exercise {slug}: {name} has {part.points:g} points, its rubric {rubric:g}"
            )


def check_units(where: str, units: Any) -> None:
    """Refuses a text among nested units that is none."""
    if isinstance(units, list | tuple | np.ndarray):
        for inner in cast("Sequence[Any]", units):
            check_units(where, inner)
        return
    try:
        refuse_unknown_unit(units)
    except UnitError as error:
        raise ExerciseError(f"{where}: {error}") from error


def _check_answer_units(where: str, answer: Numbers | Configurations) -> None:
    check_units(where, answer.units)
    if isinstance(answer, Numbers):
        try:
            answer.unit_of_entries()
        except ValueError as error:
            raise ExerciseError(
                f"{where} take the shape of its entries, {answer.shape}, or one unit"
            ) from error
