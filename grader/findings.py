"""Known ways to present or compute a right answer wrongly, as a table: what it does, and the sentence that names it."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..exercises.exercise import Exercise, Numbers, Part, Variant, references
from .tolerance import tolerance
from .verdict import Finding

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Presentation:
    """A finished matrix handed in another way: `of(reference)` is what would be seen, None where it cannot be."""

    of: Callable[[Array], Array | None]
    sentence: str
    worthless: bool = False  # entries that agree by chance earn nothing


def _swapped_blocks(J: Array) -> Array | None:
    return np.concatenate([J[3:], J[:3]]) if J.shape[0] == 6 else None


def _transposed(J: Array) -> Array | None:
    return J.T if J.ndim == 2 and J.shape[0] == J.shape[1] else np.swapaxes(J, -1, -2) if J.ndim == 3 else None


PRESENTATIONS = (
    Presentation(_transposed, "It looks transposed: rows and columns are exchanged.", worthless=True),
    Presentation(
        _swapped_blocks, "The angular rows seem to stand above the linear ones; linear rows come first.", worthless=True
    ),
    Presentation(np.negative, "Every sign is reversed.", worthless=True),
    Presentation(lambda J: J[:, ::-1] if J.ndim == 2 else None, "The columns stand in reverse order.", worthless=True),
)


MILLIMETRES = "Lengths are 1000 times too large: metres are asked, not millimetres."


def presentation(answer: Numbers, value: Array, reference: Array, allowed: Array) -> Presentation | None:
    """The first known presentation of `reference` that a value agrees with."""
    lengths = np.char.startswith(answer.unit_of_entries(), "m")
    in_millimetres = Presentation(lambda J: np.where(lengths, 1000.0, 1.0) * J, MILLIMETRES, worthless=True)
    for known in (*PRESENTATIONS, in_millimetres):
        seen = known.of(reference)
        if seen is not None and _agree(value, seen, allowed):
            return known
    return None


def _agree(value: Array, seen: Array, allowed: Array) -> bool:
    return seen.shape == value.shape and bool((np.abs(value - seen) <= allowed).all())


def findings(
    exercise: Exercise, part: Part, v: Variant, given: Mapping[str, Any], value: Any, right: Any
) -> Iterator[Finding]:
    """Sentences for a readable but wrong answer of numbers, the surest first."""
    if not isinstance(part.answer, Numbers):
        return
    reference = np.asarray(part.solve(v, given), dtype=float)
    allowed = tolerance(exercise.slug, part, v, given, exercise.scale(v))
    known = presentation(part.answer, value, reference, allowed)
    if known:
        yield Finding(known.sentence)
        return
    for mistake in part.mistakes:
        if _agree(value, np.asarray(mistake.solve(v, given), dtype=float), allowed):
            yield Finding(mistake.sentence)
            return
    if _in_degrees(exercise, part, v, value, allowed):
        yield Finding("It is what comes out when the angles of q, given in radians, are taken as degrees.")
        return
    if _too_few_decimals(part.answer, reference, value):
        yield Finding(f"It agrees after rounding to fewer decimals; {part.answer.decimals} are asked.")
        return
    yield from _signs(reference, value, allowed, np.asarray(right, dtype=bool))


def _in_degrees(exercise: Exercise, part: Part, v: Variant, value: Array, allowed: Array) -> bool:
    converted = dict(v)
    for name, unit in exercise.units.items():
        units = np.array(unit)
        if (units == "rad").any():
            numbers = np.asarray(v[name], dtype=float)
            converted[name] = np.where(units == "rad", np.radians(numbers), numbers).tolist()
    try:
        seen = references(exercise, converted)[part.variable]
    except Exception:  # noqa: BLE001 - an exercise may refuse such angles in any way; then it is no explanation
        return False
    return _agree(value, seen, allowed)


def _too_few_decimals(answer: Numbers, reference: Array, value: Array) -> bool:
    for decimals in range(answer.decimals - 1, 0, -1):
        rounded = np.abs(value - np.round(value, decimals)).max() < 1e-9
        if rounded and np.abs(value - reference).max() <= 0.5001 * 10.0**-decimals:
            return True
    return False


def _signs(reference: Array, value: Array, allowed: Array, right: NDArray[np.bool_]) -> Iterator[Finding]:
    wrong = ~right
    flipped = wrong & (np.abs(value + reference) <= allowed)
    if flipped.any() and (flipped == wrong).all() and wrong.sum() <= max(3, wrong.size // 4):
        places = ", ".join(_place(where) for where in np.argwhere(flipped)[:3])
        yield Finding(f"Only a sign is wrong: {places}.")


def _place(where: NDArray[np.intp]) -> str:
    numbers = [int(i) + 1 for i in where]
    if len(numbers) == 1:
        return f"entry {numbers[0]}"
    matrix = f"matrix {numbers[0]}, " if len(numbers) == 3 else ""
    return f"{matrix}row {numbers[-2]}, column {numbers[-1]}"
