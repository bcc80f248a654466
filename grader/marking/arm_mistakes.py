"""Known mistakes of any arm (grader/diagnosis), for the parts that ask for what its arm does."""

import logging
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Formulas, Numbers, Variant
from ...exercises.exercise import Exercise, Part
from ...exercises.kinds.formulas import names_on_sheet
from ...solutions.expression_array import POINTS, sample, sampled
from ..diagnosis.bank import Bank
from ..diagnosis.explain import Alternatives, Seen, cheapest, explained, hinted
from ..diagnosis.steps import steps_of
from ..kinds.marker import Beside, Named

Array = NDArray[np.float64]
PLACES = 3  # postures at which formulas are looked at
log = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Answered:
    """An answer: its kind, and own, wanted and allowed numbers at each point of comparison."""

    answer: Any
    arrays: Sequence[Beside]

    @property
    def decimals(self) -> int | None:
        """Those that are asked; None of formulas."""
        return self.answer.decimals if isinstance(self.answer, Numbers) else None

    @property
    def seen(self) -> Seen:
        """Its numbers at the places of the bank."""
        arrays = self.arrays[:PLACES]
        return Seen([own for own, _, _ in arrays], [allowed.exact for _, _, allowed in arrays])


class ArmMistakes:
    """The banks of one exercise's arm for one student; nothing is computed before it is asked."""

    def __init__(self, exercise: Exercise, v: Variant, references: Mapping[str, Any]) -> None:
        """Takes the right answers by variable."""
        self.exercise, self.v, self.references = exercise, v, references
        self._alternatives: dict[str, Alternatives | None] = {}
        self._banks: dict[tuple[str, ...], Bank | None] = {}

    def alternatives(self, part: Part) -> Alternatives | None:
        """What known mistakes lead to; None where the answer is no view of the arm."""
        name = part.variable
        if name not in self._alternatives:
            try:
                self._alternatives[name] = self._of(part)
            except Exception:
                log.exception("known mistakes of any arm fail for %s", name)
                self._alternatives[name] = None
        return self._alternatives[name]

    def _of(self, part: Part) -> Alternatives | None:
        reference = self.references[part.variable]
        names: tuple[str, ...] = ()
        if isinstance(part.answer, Numbers):
            references = [np.asarray(reference, dtype=np.float64)]
        elif isinstance(part.answer, Formulas):
            names = tuple(names_on_sheet(part.answer.names, self.v))
            references = [*sampled(reference, names)[:PLACES]]
        else:
            return None
        bank = self._bank(names)
        view = bank.view(references, self._vectors) if bank else None
        return Alternatives(bank, view, references) if bank and view else None

    def _bank(self, names: tuple[str, ...]) -> Bank | None:
        """The bank at the student's numbers, or at the places where formulas of names are."""
        if self.exercise.arm is None:
            return None
        if names not in self._banks:
            variants = self._places(names) if names else [self.v]
            arms = [self.exercise.arm(v) for v in variants]
            self._banks[names] = Bank([steps_of(arm) for arm in arms])
        return self._banks[names]

    def _places(self, names: tuple[str, ...]) -> Iterator[Variant]:
        """The variant with other lengths and joints."""
        values = sample(names, POINTS)
        for place in range(PLACES):
            numbers = {name: float(values[name][place]) for name in names}
            joints = [numbers.get(f"q{i}", q) for i, q in enumerate(self.v["q"], 1)]
            yield {**self.v, **numbers, "q": joints}

    @cached_property
    def _vectors(self) -> dict[str, Array]:
        """Printed vectors, such as joint rates."""
        found: dict[str, Array] = {}
        for name in self.exercise.units:
            number = np.asarray(self.v.get(name))
            if name != "q" and number.ndim == 1 and number.dtype.kind in "if":
                found[name] = number.astype(np.float64)
        return found


def one_mistake(
    known: Alternatives,
    answered: Answered,
    found: Sequence[Named],
    suspected: Iterable[Collection[str]],
) -> Named | None:
    """The known mistake that explains an answer, at the price of what is found in its entries.

    A column with reversed signs is a slip, whatever else it may be.
    """
    told = explained(known, answered.seen, answered.decimals, suspected)
    if told is None:
        return None
    fault = cheapest([told.fault, *(one.fault for one in found)])
    return Named(told.sentence, fault, told.key, titles=told.titles)


def two_mistakes(known: Alternatives, answered: Answered) -> Iterator[Named]:
    """Two mistakes that explain an answer together: a hint that leaves no points."""
    told = hinted(known, answered.seen, answered.decimals)
    if told:
        yield Named(told.sentence)
