"""Other draws of an exercise, always the same ones: they say what can show in it at all."""

import json
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ...exercises.exercise import Exercise
from .look import Look, Sight

SIBLINGS = 6  # draws of the same structure that say what can show
LOOKED = 240  # draws among which they are sought; a structure that is rarer has none
STRANGERS = 12  # draws of any structure that stand in for them


@dataclass(frozen=True, eq=False)
class Pool:
    """Draws of an exercise by their place, each drawn when it is first asked for."""

    exercise: Exercise
    drawn: list[Look]

    def at(self, place: int) -> Look:
        """The draw at a place, counted from 0."""
        while len(self.drawn) <= place:
            rng = np.random.default_rng([len(self.drawn), SIBLINGS])
            v = json.loads(json.dumps(self.exercise.draw(rng)))
            self.drawn.append(Look(self.exercise, v))
        return self.drawn[place]

    @cached_property
    def used(self) -> dict[str, list[str]]:
        """Labels of printed numbers, each with the parts that use it in one of the first draws.

        They are of any structure, so that each structure need not be looked at for what it lacks.
        """
        used: dict[str, set[str]] = {}
        for place in range(STRANGERS):
            for label, parts in self.at(place).uses.items():
                used.setdefault(label, set()).update(parts)
        return {label: sorted(parts) for label, parts in used.items()}

    @cached_property
    def shown(self) -> dict[Look, frozenset[tuple[str, str]]]:
        """Of draws that were asked for: parts, each with what shows in it."""
        return {}

    def shows(self, look: Look, sight: Sight) -> bool:
        """Whether one of its draws shows this."""
        if look not in self.shown:
            seen = [*look.rules(), *look.numbers(self.used)]
            found = [(sight.part, sight.what) for sight in seen if sight.shows]
            self.shown[look] = frozenset(found)
        return (sight.part, sight.what) in self.shown[look]


@lru_cache(maxsize=64)
def pool(exercise: Exercise) -> Pool:
    """Draws of an exercise, kept for all that look at it."""
    return Pool(exercise, [])


def siblings(look: Look) -> list[Look]:
    """Other draws of the same structure, always the same ones.

    Where a structure is too rare to be met twice, they are draws of any structure.
    """
    draws = pool(look.exercise)
    found: list[Look] = []
    for other in map(draws.at, range(LOOKED)):
        if other.structure == look.structure:
            found.append(other)
        if len(found) == SIBLINGS:
            break
    if len(found) < 2:
        return [draws.at(place) for place in range(STRANGERS)]
    return found
