"""Who of a class handed in the same numbers, whatever the order in which they are marked."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ...exercises.exercise import Numbers, Part
from .follow import SAME, TELLING, Peers, different_numbers
from .near import Near

Handed = Mapping[str, Mapping[str, Any]]
"""Student to what that student handed in, by variable, as nested lists."""


def sharing(parts: Iterable[Part], handed: Handed) -> dict[str, Peers]:
    """For every student with numbers that somebody else has too, those of the first such other.

    Whether they are right, and so no wonder, is for marking to say: students who share a variable
    that holds the same right numbers for everybody are found here, too.
    """
    found: dict[str, dict[str, dict[str, Any]]] = {}
    for part in parts:
        if not isinstance(part.answer, Numbers):
            continue
        answers = _arrays(part.variable, part.answer.shape, handed)
        for one, other in _first_others(answers).items():
            theirs = found.setdefault(one, {}).setdefault(other, {})
            theirs[part.variable] = handed[other][part.variable]
    return {student: dict(peers) for student, peers in found.items()}


def _arrays(variable: str, shape: tuple[int, ...], handed: Handed) -> dict[str, Any]:
    """What was handed in as arrays of the shape that have enough numbers to tell them apart."""
    arrays: dict[str, Any] = {}
    for student, answers in handed.items():
        try:
            array = np.asarray(answers.get(variable), dtype=np.float64)
        except (TypeError, ValueError):
            continue
        if array.shape == shape and different_numbers(array) >= TELLING:
            arrays[student] = array.ravel()
    return arrays


def _first_others(arrays: Mapping[str, Any]) -> dict[str, str]:
    """Of students whose array is that of others in every entry, the first other.

    Equal arrays are looked at once, so that a class that copies takes no longer than any.
    """
    students = [*arrays]
    if len(students) < 2:
        return {}
    equal: dict[bytes, list[int]] = {}
    for place, student in enumerate(students):
        equal.setdefault(arrays[student].tobytes(), []).append(place)
    groups = [*equal.values()]
    rows = np.stack([arrays[students[places[0]]] for places in groups])
    near = Near(rows, SAME)

    found: dict[str, str] = {}
    for row, places in zip(rows, groups, strict=True):
        heads: list[int] = []
        for group in near.to(row):
            heads += groups[group][:2]
        heads.sort()
        for place in places:
            others = [head for head in heads if head != place]
            if others:
                found[students[place]] = students[others[0]]
    return found
