"""Who of a class handed in the same numbers, whatever the order in which they are marked."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ...exercises.exercise import Numbers, Part
from .follow import SAME, TELLING, Peers, different_numbers

Handed = Mapping[str, Mapping[str, Any]]
"""Student to what that student handed in, by variable, as nested lists."""


def sharing(parts: Iterable[Part], handed: Handed) -> dict[str, Peers]:
    """For every student with numbers that somebody else has too, those of the others.

    Whether they are right, and so no wonder, is for marking to say: students who share a variable
    that holds the same right numbers for everybody are found here, too.
    """
    found: dict[str, dict[str, dict[str, Any]]] = {}
    for part in parts:
        if not isinstance(part.answer, Numbers):
            continue
        answers = _arrays(part.variable, part.answer.shape, handed)
        for one, others in _equal(answers).items():
            for other in others:
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


def _equal(arrays: Mapping[str, Any]) -> dict[str, list[str]]:
    """Students whose array is that of others in every entry, and who those are."""
    students = [*arrays]
    if len(students) < 2:
        return {}
    stacked = np.stack([arrays[student] for student in students])
    found: dict[str, list[str]] = {}
    for student, array in zip(students, stacked, strict=True):
        equal = (np.abs(stacked - array) <= SAME).all(axis=1)
        others = [other for other, same in zip(students, equal, strict=True) if same]
        others.remove(student)
        if others:
            found[student] = others
    return found
