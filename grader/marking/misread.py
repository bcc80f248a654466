"""Printed numbers that were taken otherwise: one sign, one forgotten, two exchanged.

What comes out is computed with the part's own function, so that it is known for every exercise. The
answers of one variant are computed once, when the first wrong answer without another name is met.
"""

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any, cast

from ...exercises.answers import Variant
from ...exercises.exercise import Exercise, Fault

MOST = 60  # ways of one variant that are looked at
Way = tuple[str, Fault, Variant]
"""The sentence, what kind of mistake it is, and the numbers as they were taken."""


def misread(exercise: Exercise, v: Variant) -> list[Way]:
    """Ways to take the printed numbers of a variant otherwise, at most `MOST`."""
    found: list[Way] = []
    for way in _ways(exercise, v):
        if len(found) < MOST:
            found.append(way)
    return found


def _ways(exercise: Exercise, v: Variant) -> Iterator[Way]:
    printed = [name for name in exercise.units if name in v]
    lengths = [name for name in printed if isinstance(v[name], int | float)]
    for name in lengths:
        if v[name]:
            yield (
                f"It fits {name} = 0: that number seems to be forgotten.",
                "concept",
                {**v, name: 0.0},
            )
            yield f"It fits the other sign of {name}.", "slip", {**v, name: -v[name]}
    for one, other in combinations(lengths, 2):
        if v[one] != v[other] and exercise.units[one] == exercise.units[other]:
            exchanged = {**v, one: v[other], other: v[one]}
            yield f"It fits {one} and {other} exchanged.", "slip", exchanged
    for name in printed:
        if _is_vector(v[name]):
            yield from _of_vector(name, v)


def _of_vector(name: str, v: Variant) -> Iterator[Way]:
    numbers = cast("list[float]", v[name])
    for i, number in enumerate(numbers):
        if number:
            place = f"{name}[{i + 1}]"
            sign = _with(v, name, {i: -number})
            yield f"It fits the other sign of {place}.", "slip", sign
            yield (
                f"It fits {place} = 0: that number seems to be forgotten.",
                "concept",
                _with(v, name, {i: 0.0}),
            )
    for i, j in combinations(range(len(numbers)), 2):
        if numbers[i] != numbers[j]:
            exchanged = _with(v, name, {i: numbers[j], j: numbers[i]})
            yield f"It fits {name}[{i + 1}] and {name}[{j + 1}] exchanged.", "slip", exchanged


def _with(v: Variant, name: str, changes: Mapping[int, float]) -> Variant:
    numbers = [*v[name]]
    for i, number in changes.items():
        numbers[i] = number
    return {**v, name: numbers}


def _is_vector(value: Any) -> bool:
    if not isinstance(value, list):
        return False
    return all(isinstance(number, int | float) for number in cast("list[Any]", value))
