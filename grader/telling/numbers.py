"""Which printed numbers matter: a change by one per cent has to change an answer visibly.

A part is held against a printed number (a length, a speed, one angle) by computing everything anew
from the changed one, and against an entry of a printed vector by computing the part anew from the
same earlier answers: so an entry of q belongs to the parts that take q. Visibly means by more than
the tolerance of an entry of the answer. A change by one per cent of an angle is 0.01 rad: where an
angle is zero is a convention, so that a share of it says nothing.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from ...exercises.answers import Variant
from ...exercises.exercise import (
    Choice,
    Exercise,
    Function,
    Given,
    Manual,
    Numbers,
    Part,
    references,
    solve,
)
from ..marking.answer_key import AnswerKey
from .rules import passes

SMALL = 0.01  # of a number, or rad
LARGE = 0.3  # of a number, or rad: what a part uses shows such a change
CHANGES = (LARGE, -2.0, 10.0)  # larger, of the other sign, much larger: a choice may stay the same


@dataclass(frozen=True)
class Printed:
    """A printed number: its name, its place in a vector from 0 where it is in one, its unit."""

    name: str
    place: int | None
    unit: str

    @property
    def label(self) -> str:
        """As it is told, such as "a2" or "q[3]"."""
        if self.place is None:
            return self.name
        return f"{self.name}[{self.place + 1}]"

    def changed(self, v: Variant, share: float) -> Variant:
        """The variant with this number larger by a share of it, or an angle by so much [rad]."""
        if self.place is None:
            return {**v, self.name: _larger(v[self.name], self.unit, share)}
        numbers = [*v[self.name]]
        numbers[self.place] = _larger(numbers[self.place], self.unit, share)
        return {**v, self.name: numbers}


def _larger(number: float, unit: str, share: float) -> float:
    if unit == "rad":
        return number + share
    return number * (1 + share)


def printed_numbers(exercise: Exercise, v: Variant) -> list[Printed]:
    """The numbers and entries of vectors on the sheet of a variant, but for zeros.

    Matrices are left out: their entries belong together.
    """
    found: list[Printed] = []
    for name, unit in exercise.units.items():
        value: Any = v.get(name)
        if _is_number(value):
            found.append(Printed(name, None, str(unit)))
        elif isinstance(value, list):
            found += _entries(name, cast("list[Any]", value), unit)
    return [number for number in found if number.changed(v, SMALL) != v]


def _entries(name: str, values: list[Any], unit: Any) -> Iterator[Printed]:
    if not all(map(_is_number, values)):
        return
    for place, one in enumerate(np.broadcast_to(np.asarray(unit), len(values))):
        yield Printed(name, place, str(one))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def number_parts(exercise: Exercise) -> list[Part]:
    """The parts that are held against printed numbers: those that ask for numbers."""
    return [part for part in exercise.asked if isinstance(part.answer, Numbers)]


def blind_parts(key: AnswerKey, number: Printed, among: Collection[str]) -> set[str]:
    """Which parts of numbers do not show a small change of one printed number.

    A change that the exercise cannot compute with shows everywhere.
    """
    blind: set[str] = set()
    answers = recomputed(key, number)
    for part in number_parts(key.exercise):
        name = part.variable
        if name not in among or name not in answers:
            continue
        if passes(key, part, key.wanted(part), answers[name]):
            blind.add(name)
    return blind


def moved_parts(key: AnswerKey, number: Printed) -> set[str]:
    """Parts of numbers that use a printed number: a large change of it shows in them."""
    answers = recomputed(key, number, LARGE)
    moved: set[str] = set()
    for part in number_parts(key.exercise):
        name = part.variable
        if name in answers and not passes(key, part, key.wanted(part), answers[name]):
            moved.add(name)
    return moved


def idle_numbers(key: AnswerKey) -> list[str]:
    """Labels of printed numbers that matter for no part of any kind, however they are changed."""
    numbers = printed_numbers(key.exercise, key.v)
    return [number.label for number in numbers if not _matters(key, number)]


def _matters(key: AnswerKey, number: Printed) -> bool:
    asked = key.exercise.asked
    if any(_changes(key, number.changed(key.v, share), asked) for share in CHANGES):
        return True
    if number.place is None:
        return False
    # One entry may not be enough for another choice, where the whole vector is.
    choices = [part for part in asked if isinstance(part.answer, Choice)]
    turned = [-one for one in key.v[number.name]]
    return _changes(key, {**key.v, number.name: turned}, choices)


def _changes(key: AnswerKey, v: Variant, parts: Sequence[Part]) -> bool:
    """Whether one of these parts has another answer for other numbers; a function is taken to."""
    try:
        with np.errstate(all="ignore"):
            answers = references(key.exercise, v)
    except Exception:  # noqa: BLE001 - numbers that an exercise refuses matter
        return True
    for part in parts:
        if isinstance(part.answer, Function | Manual):
            return True
        if not passes(key, part, key.wanted(part), answers[part.variable]):
            return True
    return False


def recomputed(key: AnswerKey, number: Printed, share: float = SMALL) -> dict[str, Any]:
    """Answers of the parts of numbers from one changed number; none where that stops."""
    try:
        return _recomputed(key, number.changed(key.v, share), carried=number.place is None)
    except Exception:  # noqa: BLE001 - an exercise may refuse such numbers in any way
        return {}


def _recomputed(key: AnswerKey, v: Variant, *, carried: bool) -> dict[str, Any]:
    """Answers of the parts of numbers from changed numbers.

    With `carried` from earlier answers that follow from them too, else from the right ones.
    """
    answers: dict[str, Any] = {}
    for part in _needed(key.exercise):
        source: Given = answers if carried else key.reference
        given = {name: source[name] for name in part.needs}
        if carried or isinstance(part.answer, Numbers):
            with np.errstate(all="ignore"):
                answers[part.variable] = solve(key.exercise.slug, part, v, given)
    return answers


def _needed(exercise: Exercise) -> list[Part]:
    """The parts of numbers, and what they need, in order."""
    needed: list[Part] = []
    wanted: set[str] = set()
    for part in reversed(exercise.parts):
        if part.variable in wanted or isinstance(part.answer, Numbers):
            needed.append(part)
            wanted.update(part.needs)
    return needed[::-1]
