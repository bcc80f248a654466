"""What draws of an exercise can tell: which are refused, and what is left in the others."""

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any, Literal

import numpy as np

from ...exercises.answers import Variant
from ...exercises.exercise import Exercise
from ...grader.telling.look import Look
from ...grader.telling.numbers import idle_numbers
from ...grader.telling.objections import Objection, objections
from ...grader.telling.rules import alike, known_rules, passing
from ...grader.telling.work import work
from ..variants.drawn import drawn, prove_drawn
from ..variants.variant import REFUSED

Kind = Literal[
    "refused for a rule",
    "refused for a number",
    "refused for a factor",
    "rule hidden",
    "number hidden",
    "number idle",
    "alike",
]

REFUSED_FOR: dict[str, Kind] = {
    "rule": "refused for a rule",
    "number": "refused for a number",
    "factor": "refused for a factor",
}


@dataclass(frozen=True)
class Note:
    """What was seen in a draw.

    Attributes:
        kind: What it was refused for, or what is left in one that can be handed out: a known
            mistake that gives the right answer, a number that hardly matters for a part, one that
            matters for none, or two known mistakes that lead to one wrong answer.
        part: The variable of the part; empty for what is not about one.
        what: The sentence of the mistake, two of them, or the number.
    """

    kind: Kind
    part: str
    what: str


@dataclass(frozen=True)
class Form:
    """A choice of form in a draw, and a part whose work may depend on it."""

    name: str
    value: str
    part: str


@dataclass(frozen=True)
class Telling:
    """What draws can tell, counted.

    Attributes:
        refusals: For every draw that was refused, the kinds of what speaks against it.
        notes: What was seen, with the number of draws.
        work: Choices of form with how many draws had them, and how many numbers went into the part
            in all of them together.
    """

    refusals: tuple[tuple[str, ...], ...] = ()
    notes: tuple[tuple[Note, int], ...] = ()
    work: tuple[tuple[Form, int, int], ...] = ()


def accepted(exercise: Exercise, seed: int) -> tuple[dict[str, Any], list[tuple[Objection, ...]]]:
    """The first draw of a seed that can be handed out, and what spoke against those before it.

    Where many cannot, it is the one against which least speaks, as for a student.

    Raises:
        ExerciseError: draw fails, or gives other numbers when it is called again.
    """
    refused: list[tuple[Objection, ...]] = []
    draws: list[dict[str, Any]] = []
    for attempt in range(REFUSED):
        v = drawn(exercise, _generator(seed, attempt))
        prove_drawn(exercise, _generator(seed, attempt), v)
        against = tuple(objections(Look(exercise, v)))
        if not against:
            return v, refused
        refused.append(against)
        draws.append(v)
    least = min(range(REFUSED), key=lambda i: len(refused[i]))
    return draws[least], refused


def _generator(seed: int, attempt: int) -> np.random.Generator:
    return np.random.default_rng([seed, attempt] if attempt else seed)


def told(exercise: Exercise, v: Variant, refused: list[tuple[Objection, ...]]) -> Telling:
    """What one draw that can be handed out tells, and why those before it were refused."""
    notes: Counter[Note] = Counter()
    for one in chain.from_iterable(refused):
        notes[Note(REFUSED_FOR[one.kind], one.part, one.what)] += 1
    look = Look(exercise, v)
    notes.update(dict.fromkeys(_left(look), 1))
    kinds = (tuple(dict.fromkeys(one.kind for one in against)) for against in refused)
    return Telling(tuple(kinds), tuple(notes.items()), tuple(_work(look)))


def _left(look: Look) -> Iterator[Note]:
    """What a draw that can be handed out does not tell apart."""
    for part in look.exercise.asked:
        rules = known_rules(look.key, part)
        for sentence in passing(look.key, part, rules):
            yield Note("rule hidden", part.variable, sentence)
        for one, other in alike(look.key, part, rules):
            yield Note("alike", part.variable, f"{one} | {other}")
    for sight in look.numbers(look.uses):
        if not sight.shows:
            yield Note("number hidden", sight.part, sight.what)
    for label in idle_numbers(look.key):
        yield Note("number idle", "", label)


def _work(look: Look) -> Iterator[tuple[Form, int, int]]:
    """The work of every part under the drawn choices of form, but for lists.

    Draws that are known to be harder are left out: other choices may go with that one.
    """
    structure, harder = look.exercise.structure, look.exercise.harder
    forms = {name: look.v[name] for name in structure if isinstance(look.v.get(name), str | int)}
    if not forms or any(forms.get(name) in choices for name, choices in harder.items()):
        return
    for part, numbers in work(look).items():
        for name, value in forms.items():
            yield Form(name, _text(value), part), 1, numbers


def _text(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)


def all_told(found: list[Telling]) -> Telling:
    """What several draws tell, put together."""
    notes: Counter[Note] = Counter()
    draws: Counter[Form] = Counter()
    numbers: Counter[Form] = Counter()
    for one in found:
        notes.update(dict(one.notes))
        for form, times, size in one.work:
            draws[form] += times
            numbers[form] += size
    refusals = tuple(chain.from_iterable(one.refusals for one in found))
    work = tuple((form, draws[form], numbers[form]) for form in draws)
    return Telling(refusals, tuple(notes.most_common()), work)
