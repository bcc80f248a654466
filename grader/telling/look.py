"""One draw of an exercise, looked at: which mistakes and which printed numbers it shows."""

import json
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from ...exercises.answers import Conditions, Formulas, Variant
from ...exercises.exercise import Exercise
from ..marking.answer_key import AnswerKey
from .numbers import blind_parts, moved_parts, printed_numbers
from .rules import known_rules, passing

IN_LETTERS = (Formulas, Conditions)  # the same in all draws of a structure: they hold no numbers


@dataclass(frozen=True)
class Sight:
    """Whether a draw tells something apart from the right answer of a part.

    Attributes:
        kind: A known mistake, or a printed number that is changed a little.
        part: The variable of the part.
        what: The sentence of the mistake, or the label of the number.
        shows: Whether another answer comes out.
    """

    kind: Literal["rule", "number"]
    part: str
    what: str
    shows: bool


@dataclass(frozen=True, eq=False)
class Look:
    """One draw; what costs time is computed when asked for, and kept."""

    exercise: Exercise
    v: Variant

    @cached_property
    def key(self) -> AnswerKey:
        """What answers are compared with. Raises what the exercise raises."""
        return AnswerKey(self.exercise, self.v)

    @cached_property
    def structure(self) -> str:
        """Its form as text: the choices under `structure`, drawn words, and which names there are.

        Draws of one structure differ in numbers alone.
        """
        named = self.exercise.structure
        form: dict[str, Any] = {}
        for name, value in self.v.items():
            is_form = name in named or isinstance(value, str)
            form[name] = value if is_form else None
        return json.dumps(form, sort_keys=True)

    @cached_property
    def uses(self) -> dict[str, frozenset[str]]:
        """Labels of printed numbers, each with the parts of numbers that use it."""
        numbers = printed_numbers(self.exercise, self.v)
        return {number.label: frozenset(moved_parts(self.key, number)) for number in numbers}

    def rules(self) -> Iterator[Sight]:
        """Whether known mistakes show, but in parts in letters."""
        for part in self.exercise.asked:
            if isinstance(part.answer, IN_LETTERS):
                continue
            rules = known_rules(self.key, part)
            passed = passing(self.key, part, rules)
            for sentence in dict.fromkeys(sentence for sentence, _ in rules):
                yield Sight("rule", part.variable, sentence, sentence not in passed)

    def numbers(self, used: Mapping[str, Collection[str]]) -> Iterator[Sight]:
        """Whether printed numbers show in the parts that use them, by their labels."""
        for number in printed_numbers(self.exercise, self.v):
            among = used.get(number.label, ())
            if not among:
                continue
            blind = blind_parts(self.key, number, among)
            for part in among:
                yield Sight("number", part, number.label, part not in blind)
