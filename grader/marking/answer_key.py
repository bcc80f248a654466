"""What one variant's answers are compared with: reference, tolerance, entries that carry points."""

import json
from dataclasses import replace
from functools import cached_property, lru_cache, wraps
from typing import Any

import numpy as np

from ...exercises.answers import Numbers, Variant
from ...exercises.exercise import Exercise, Given, Part, references, solve
from ..diagnosis.explain import Alternatives
from ..kinds.marker import Mask, Named, Wanted
from ..kinds.markers import marker_of
from .arm_mistakes import ArmMistakes
from .misread import Way, misread
from .tolerance import tolerance

SAMPLE = 12  # draws that decide which entries vary between students


def remembering(value: Any) -> Any:
    """A function that is called once for each of its inputs; any other value as it is."""
    if not callable(value):
        return value
    results: dict[str, Any] = {}

    @wraps(value)
    def remembered(*call: Any) -> Any:
        name = json.dumps(
            call, default=_plain
        )  # repr() leaves out what is in the middle of an array
        if name not in results:
            results[name] = value(*call)
        return results[name]

    return remembered


def _plain(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else repr(value)


class AnswerKey:
    """The key of one exercise for one variant; what costs time is computed when asked for."""

    def __init__(self, exercise: Exercise, v: Variant) -> None:
        """Solves all parts. Raises ExerciseError where the exercise breaks its own declaration."""
        self.exercise, self.v = exercise, v
        self.reference = {
            name: remembering(value) for name, value in references(exercise, v).items()
        }
        self._wanted: dict[str, Wanted] = {}
        self._mistaken: dict[str, list[tuple[Named, Wanted]]] = {}
        self._misread: dict[str, list[tuple[Named, Wanted]]] = {}
        self._earning: dict[str, Mask] = {}
        self._of_arm = ArmMistakes(exercise, v, self.reference)

    def wanted(self, part: Part) -> Wanted:
        """What follows from the reference answers."""
        if part.variable not in self._wanted:
            given = {name: self.reference[name] for name in part.needs}
            self._wanted[part.variable] = self._with_tolerance(
                part, self.reference[part.variable], given
            )
        return self._wanted[part.variable]

    def mistaken(self, part: Part, wanted: Wanted) -> list[tuple[Named, Wanted]]:
        """Each known mistake, and what it leads to from the same earlier answers."""
        if wanted is not self._wanted.get(part.variable):
            return self._mistakes(part, wanted)
        if part.variable not in self._mistaken:
            self._mistaken[part.variable] = self._mistakes(part, wanted)
        return self._mistaken[part.variable]

    def _mistakes(self, part: Part, wanted: Wanted) -> list[tuple[Named, Wanted]]:
        found: list[tuple[Named, Wanted]] = []
        for mistake in part.mistakes:
            value = part.answer.declared(mistake.solve(self.v, wanted.given), self.v)
            named = Named(mistake.sentence, mistake.fault)
            found.append((named, replace(wanted, value=remembering(value))))
        return found

    def misread(self, part: Part, wanted: Wanted) -> list[tuple[Named, Wanted]]:
        """What comes out where printed numbers are taken otherwise, from the same answers."""
        if wanted is not self._wanted.get(part.variable):
            return self._misreadings(part, wanted)
        if part.variable not in self._misread:
            self._misread[part.variable] = self._misreadings(part, wanted)
        return self._misread[part.variable]

    def _misreadings(self, part: Part, wanted: Wanted) -> list[tuple[Named, Wanted]]:
        found: list[tuple[Named, Wanted]] = []
        for sentence, fault, v in self._ways:
            try:
                with np.errstate(all="ignore"):
                    value = solve(self.exercise.slug, part, v, wanted.given)
            except Exception:  # noqa: BLE001, S112 - an exercise may refuse such numbers in any way
                continue
            found.append((Named(sentence, fault), replace(wanted, value=value)))
        return found

    def of_arm(self, part: Part, wanted: Wanted) -> Alternatives | None:
        """What known mistakes of any arm lead to, where the right answer follows from the arm."""
        if wanted is not self._wanted.get(part.variable):
            return None
        return self._of_arm.alternatives(part)

    @cached_property
    def _ways(self) -> list[Way]:
        return misread(self.exercise, self.v)

    @cached_property
    def in_degrees(self) -> dict[str, Any]:
        """Answers of somebody who takes every printed angle for degrees; empty if none follow."""
        converted = dict(self.v)
        for name, unit in self.exercise.units.items():
            units = np.array(unit)
            if name in self.v and (units == "rad").any():
                numbers = np.asarray(self.v[name], dtype=float)
                converted[name] = np.where(units == "rad", np.radians(numbers), numbers).tolist()
        try:
            return references(self.exercise, converted)
        except Exception:  # noqa: BLE001 - an exercise may refuse such angles in any way; then it is no explanation
            return {}

    def following(self, part: Part, given: Given) -> Wanted:
        """What follows from other earlier answers. Raises whatever `solve` makes of them."""
        return self._with_tolerance(part, solve(self.exercise.slug, part, self.v, given), given)

    def _with_tolerance(self, part: Part, value: Any, given: Given) -> Wanted:
        if not isinstance(part.answer, Numbers):
            return Wanted(remembering(value), given)
        return Wanted(value, given, tolerance(self.exercise, part, self.v, given, value))

    def earning(self, part: Part) -> Mask:
        """Entries of numbers, tables and formulas that carry points.

        They vary between students and are none of -1, 0, 1 for this one: a Jacobian is full of
        structural zeros and ones, so that a matrix of zeros agrees with many of its entries. A
        formula is told by its names.
        """
        if part.variable not in self._earning:
            self._earning[part.variable] = self._earning_entries(part)
        return self._earning[part.variable]

    def _earning_entries(self, part: Part) -> Mask:
        marker = marker_of(part.answer)
        earning = ~marker.trivial(part.answer, self.wanted(part), self.v)
        if marker.varies:
            earning &= varying(self.exercise, part.variable)
        return earning if earning.any() else np.ones_like(earning)


@lru_cache(maxsize=512)
def varying(exercise: Exercise, variable: str) -> Mask:
    """Entries of a part of numbers or a table that differ between draws."""
    (asked,) = [part for part in exercise.asked if part.variable == variable]
    pictures: list[Any] = []
    for v, answers in _sample(exercise):
        for part in _needed(exercise, asked):
            if part.variable not in answers:
                given = {name: answers[name] for name in part.needs}
                answers[part.variable] = solve(exercise.slug, part, v, given)
        pictures.append(asked.answer.pictured(answers[variable], v))
    return np.asarray(np.ptp(np.array(pictures), axis=0) > 1e-6)


@lru_cache(maxsize=64)
def _sample(exercise: Exercise) -> list[tuple[Variant, dict[str, Any]]]:
    """Variants, each with a place for the answers that were asked for so far."""
    return [(exercise.draw(np.random.default_rng(seed)), {}) for seed in range(SAMPLE)]


def _needed(exercise: Exercise, part: Part) -> list[Part]:
    """A part behind those that it needs, and that these need: no formulas for mere numbers."""
    wanted = {part.variable}
    found: list[Part] = []
    for earlier in reversed(exercise.parts):
        if earlier.variable in wanted:
            found.append(earlier)
            wanted.update(earlier.needs)
    return found[::-1]
