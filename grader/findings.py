"""Known ways to present or compute a right answer wrongly, as a table: what it does, and the sentence that names it."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..exercises.answers import Formulas, Numbers, Variant
from ..exercises.exercise import Part, Rows
from ..exercises.values import names_on_sheet
from ..solutions.expression import Expression
from ..solutions.expression_array import SAME, ExpressionArray, same_formulas, sampled
from .answer_key import AnswerKey, Mask, Wanted
from .compare import compare
from .unreadable import entries_named
from .verdict import Finding

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Presentation:
    """A finished matrix handed in another way: `of(reference)` is what would be seen, None where it cannot be."""

    of: Callable[[Array], Array | None]
    sentence: str
    worthless: bool = False  # entries that agree by chance earn nothing


def _swapped_blocks(J: Array) -> Array | None:
    return np.concatenate([J[3:], J[:3]]) if J.shape[:1] == (6,) else None


def _transposed(J: Array) -> Array | None:
    return J.T if J.ndim == 2 and J.shape[0] == J.shape[1] else np.swapaxes(J, -1, -2) if J.ndim == 3 else None


TRANSPOSED = Presentation(_transposed, "It looks transposed: rows and columns are exchanged.", worthless=True)
SWAPPED: dict[Rows, Presentation] = {
    "linear, angular": Presentation(
        _swapped_blocks, "The angular rows seem to stand above the linear ones; linear rows come first.", worthless=True
    ),
    "angular, linear": Presentation(
        _swapped_blocks,
        "The linear rows seem to stand above the angular ones; angular rows come first.",
        worthless=True,
    ),
}
REVERSED = (
    Presentation(np.negative, "Every sign is reversed.", worthless=True),
    Presentation(lambda J: J[:, ::-1] if J.ndim == 2 else None, "The columns stand in reverse order.", worthless=True),
)


LENGTH = re.compile(r"m(/.*)?")  # what is 1000 times as large in millimetres: no area, and no mass
MOMENT = re.compile(r"N m(/.*)?")
MILLIMETRES = "Lengths are 1000 times too large: metres are asked, not millimetres."
CENTIMETRES = "Lengths are 100 times too large: metres are asked, not centimetres."
NEWTON_MILLIMETRES = "Moments are 1000 times too large: N m are asked, not N mm."
NEWTON_CENTIMETRES = "Moments are 100 times too large: N m are asked, not N cm."
DEGREES = "Angles are in degrees: radians are asked."
MOST_PLACES = 3  # of entries with a wrong sign that are named
NUMBERS_PUT_IN = 5e-3  # numbers of a sheet have two or three decimals


def presentation(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> Presentation | None:
    """The first known presentation of the reference that an answer of numbers or formulas agrees with."""
    answer = part.answer
    if isinstance(answer, Numbers):
        scaled = _in_other_units(answer)
        pairs = [(value, wanted.value, wanted.allowed)]
    elif isinstance(answer, Formulas):
        names = names_on_sheet(answer.names, key.v)
        own, reference = (sampled(x, names) for x in (value, wanted.value))
        scaled = ()
        pairs = [(a, b, SAME * np.maximum(1.0, np.abs(b))) for a, b in zip(own, reference, strict=True)]
    else:
        return None
    blocks = (SWAPPED[key.exercise.rows],) if _has_blocks(answer) else ()
    for known in (TRANSPOSED, *blocks, *REVERSED, *scaled):
        if all(_agree(own, known.of(reference), allowed) for own, reference, allowed in pairs):
            return known
    return None


def _has_blocks(answer: Numbers | Formulas) -> bool:
    return isinstance(answer, Formulas) or answer.has_blocks


def _in_other_units(answer: Numbers) -> tuple[Presentation, ...]:
    """Lengths in millimetres or centimetres, moments with them, and angles in degrees."""
    units = answer.unit_of_entries()
    lengths = _matching(LENGTH, units)
    with_moments = lengths | _matching(MOMENT, units)
    angles = np.char.startswith(units, "rad")
    millimetres, centimetres = MILLIMETRES, CENTIMETRES
    if not lengths.any():
        millimetres, centimetres = NEWTON_MILLIMETRES, NEWTON_CENTIMETRES
    return (
        Presentation(lambda J: np.where(with_moments, 1000.0, 1.0) * J, millimetres, worthless=True),
        Presentation(lambda J: np.where(with_moments, 100.0, 1.0) * J, centimetres, worthless=True),
        Presentation(lambda J: np.where(angles, 180 / np.pi, 1.0) * J, DEGREES, worthless=True),
    )


def _matching(pattern: re.Pattern[str], units: NDArray[np.str_]) -> Mask:
    found = [pattern.fullmatch(str(unit)) is not None for unit in units.ravel()]
    return np.array(found, dtype=bool).reshape(units.shape)


def _agree(value: Array, seen: Array | None, allowed: Array) -> bool:
    return seen is not None and seen.shape == value.shape and bool((np.abs(value - seen) <= allowed).all())


def findings(key: AnswerKey, part: Part, wanted: Wanted, value: Any, right: Any) -> Iterator[Finding]:
    """Sentences for a readable but wrong answer: what the exercise knows, then what may happen to any answer."""
    for sentence, mistaken in key.mistaken(part, wanted):
        if compare(key, part, mistaken, value).all_right:
            yield Finding(sentence)
            return
    known = presentation(key, part, wanted, value)
    if known:
        yield Finding(known.sentence)
        return
    if type(part.answer) in _FINDINGS:
        yield from _FINDINGS[type(part.answer)](key, part, wanted, value, np.asarray(right, dtype=bool))


def _of_numbers(key: AnswerKey, part: Part, wanted: Wanted, value: Array, right: Mask) -> Iterator[Finding]:
    assert isinstance(part.answer, Numbers)  # noqa: S101 - chosen by this type
    if part.variable in key.in_degrees and _agree(value, key.in_degrees[part.variable], wanted.allowed):
        yield Finding("It is what comes out when the angles of q, given in radians, are taken as degrees.")
    elif _too_few_decimals(part.answer, wanted.value, value):
        yield Finding(f"It agrees after rounding to fewer decimals; {part.answer.decimals} are asked.")
    else:
        yield from _signs(wanted.value, value, wanted.allowed, right)


def _of_formulas(key: AnswerKey, part: Part, wanted: Wanted, value: ExpressionArray, right: Mask) -> Iterator[Finding]:
    assert isinstance(part.answer, Formulas)  # noqa: S101 - chosen by this type
    own = own_numbers(key.v)
    if set(own) >= wanted.value.names | value.names and not value.names >= wanted.value.names:
        difference = np.abs(value.at(own) - wanted.value.at(own))
        if (difference <= NUMBERS_PUT_IN).all():
            missing = ", ".join(sorted(wanted.value.names - value.names))
            yield Finding(f"With your numbers put in it is right, but formulas are asked: they take {missing}.")
            return
    names = names_on_sheet(part.answer.names, key.v)
    flipped = same_formulas(_negated(value), wanted.value, names) & ~right
    yield from _flipped(flipped, ~right)


def own_numbers(v: Variant) -> dict[str, float]:
    """Values of all names of a sheet, joints included."""
    joints = {f"q{i}": float(x) for i, x in enumerate(v.get("q", ()), 1)}
    return {**{name: float(x) for name, x in v.items() if isinstance(x, int | float)}, **joints}


def _negated(value: ExpressionArray) -> ExpressionArray:
    negated = (Expression((*entry.nodes, ("neg", len(entry.nodes) - 1))) for entry in value.entries)
    return ExpressionArray(tuple(negated), value.shape)


def _too_few_decimals(answer: Numbers, reference: Array, value: Array) -> bool:
    for decimals in range(answer.decimals - 1, 0, -1):
        rounded = np.abs(value - np.round(value, decimals)).max() < 1e-9
        if rounded and np.abs(value - reference).max() <= 0.5001 * 10.0**-decimals:
            return True
    return False


def _signs(reference: Array, value: Array, allowed: Array, right: NDArray[np.bool_]) -> Iterator[Finding]:
    yield from _flipped(~right & (np.abs(value + reference) <= allowed), ~right)


def _flipped(flipped: NDArray[np.bool_], wrong: NDArray[np.bool_]) -> Iterator[Finding]:
    if flipped.any() and (flipped == wrong).all() and wrong.sum() <= max(3, wrong.size // 4):
        yield Finding(f"Only a sign is wrong{f': {_places(flipped)}' if flipped.ndim else ''}.")


def _places(flipped: NDArray[np.bool_]) -> str:
    """Entries in words, a whole column as one."""
    columns = sorted({int(where[-1]) for where in np.argwhere(flipped)})
    if flipped.ndim == 2 and len(columns) == 1 and flipped.sum() > 1:
        return f"column {columns[0] + 1}"
    return entries_named(flipped, MOST_PLACES)


_FINDINGS: dict[type, Callable[..., Iterator[Finding]]] = {Numbers: _of_numbers, Formulas: _of_formulas}
