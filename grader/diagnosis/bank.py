"""What every known mistake of one student's arm leads to, computed once and kept."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import combinations

import numpy as np

from .columns import in_columns, in_frames, in_output
from .mistake import STAGES, Mistake
from .numbers import in_numbers
from .pipeline import Solved
from .steps import Array, Steps
from .switches import Switches, as_it_is, edit
from .views import Setting, View, find_view

Rules = tuple[Mistake, ...]
LIKELY = 0.1  # prior below which a mistake is thought of beside another one
LEAST_JOINTS = 3  # of an arm, for two mistakes to be told from others
NOTHING: Rules = ()


def mistakes_of(steps: Steps, setting: Setting) -> list[Mistake]:
    """All known mistakes of an arm, for a Jacobian in these axes at this point."""
    return [
        *in_numbers(steps),
        *in_frames(steps),
        *in_columns(steps),
        *in_output(*setting),
    ]


class Bank:
    """The known mistakes of one arm at one posture, or at several for formulas.

    Nothing is computed before it is asked for.
    """

    def __init__(self, places: Sequence[Steps]) -> None:
        """Takes the motions of the arm at each posture; numbers differ, joints do not."""
        self.places = tuple(places)
        self._truths: dict[Setting, list[Solved]] = {}
        self._singles: dict[Setting, tuple[list[Rules], list[Solved]]] = {}
        self._pairs: dict[Setting, tuple[list[Rules], list[Solved]]] = {}

    def truth(self, setting: Setting) -> list[Solved]:
        """The right hypothesis alone, at every place."""
        if setting not in self._truths:
            self._truths[setting] = [_solved(steps, setting, [NOTHING]) for steps in self.places]
        return self._truths[setting]

    def singles(self, setting: Setting) -> tuple[list[Rules], list[Solved]]:
        """Every mistake by itself, and what it leads to at every place."""
        if setting not in self._singles:
            per_place = [mistakes_of(steps, setting) for steps in self.places]
            known = [(mistake,) for mistake in per_place[0]]
            self._singles[setting] = known, self._solved(setting, _in_turn(per_place))
        return self._singles[setting]

    def pairs(self, setting: Setting) -> tuple[list[Rules], list[Solved]]:
        """Every two likely mistakes that do not touch the same, in the order of work."""
        if setting not in self._pairs:
            per_place = [_pairs(mistakes_of(steps, setting)) for steps in self.places]
            self._pairs[setting] = per_place[0], self._solved(setting, per_place)
        return self._pairs[setting]

    def _solved(self, setting: Setting, per_place: Iterable[Sequence[Rules]]) -> list[Solved]:
        places = zip(self.places, per_place, strict=True)
        return [_solved(steps, setting, rules) for steps, rules in places]

    def view(self, references: Sequence[Array], numbers: Mapping[str, Array]) -> View | None:
        """What a part with these references asks for, if it is a view of this arm."""
        with np.errstate(all="ignore"):
            return find_view(self.truth, references, numbers)

    @property
    def tells_pairs(self) -> bool:
        """Whether two mistakes can be told from others on this arm."""
        return self.places[0].n >= LEAST_JOINTS


def _in_turn(per_place: Iterable[Sequence[Mistake]]) -> list[list[Rules]]:
    return [[(mistake,) for mistake in mistakes] for mistakes in per_place]


def _pairs(mistakes: Sequence[Mistake]) -> list[Rules]:
    likely = [mistake for mistake in mistakes if mistake.prior < LIKELY]
    found: list[Rules] = []
    for one, other in combinations(likely, 2):
        if one.slots.isdisjoint(other.slots) and one.family != other.family:
            found.append((one, other))
    return found


def _solved(steps: Steps, setting: Setting, rules: Sequence[Rules]) -> Solved:
    """What comes out of each of some combinations of mistakes."""
    switches = as_it_is(steps, len(rules))
    axes, point = setting
    switches.axes[:] = axes
    switches.point[:] = point
    chosen: dict[Mistake, list[int]] = {}
    for row, mistakes in enumerate(rules):
        for mistake in mistakes:
            chosen.setdefault(mistake, []).append(row)
    for mistake in sorted(chosen, key=lambda mistake: STAGES.index(mistake.stage)):
        for one in mistake.edits:
            edit(switches, np.array(chosen[mistake]), one)
    return Solved(steps, switches)


def changed(
    steps: Steps, setting: Setting, count: int, change: Callable[[Switches], None]
) -> Solved:
    """So many hypotheses with other numbers, which `change` writes."""
    switches = as_it_is(steps, count)
    switches.axes[:], switches.point[:] = setting
    change(switches)
    return Solved(steps, switches)
