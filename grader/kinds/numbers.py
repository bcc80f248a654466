"""Numbers: arrays as they are, typed text with units, formulas without names."""

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Numbers, Variant
from ..collecting.wire import Raw
from ..reading.arrays import (
    flat_texts,
    quantity,
    real_numbers,
    refuse_infinite,
    reshaped,
    typed_block,
)
from ..reading.unreadable import Unreadable, clip, entry_name
from .allowed import Array, Mask
from .marker import Alone, Asked, Beside, Marker, Named, Presentation, Wanted, is_trivial
from .signs import said_of_exchanged, said_of_one_entry, said_of_signs

LENGTH = re.compile(r"m(/.*)?")  # what is 1000 times as large in millimetres: no area, and no mass
MOMENT = re.compile(r"N m(/.*)?")
MILLIMETRES = "Lengths are 1000 times too large: metres are asked, not millimetres."
CENTIMETRES = "Lengths are 100 times too large: metres are asked, not centimetres."
NEWTON_MILLIMETRES = "Moments are 1000 times too large: N m are asked, not N mm."
NEWTON_CENTIMETRES = "Moments are 100 times too large: N m are asked, not N cm."
DEGREES = "Angles are in degrees: radians are asked."
TAKEN_AS_DEGREES = (
    "It is what comes out when the angles of q, given in radians, are taken as degrees."
)


def read_numbers(answer: Numbers, raw: Raw, _: Variant) -> Array:
    """An array of the asked shape.

    Raises:
        Unreadable: it is of another kind or shape, or its numbers are not finite and real.
    """
    if raw.kind == "num":
        array = real_numbers(np.asarray(raw.value))
    else:
        array = _typed_array(raw, answer.shape, answer.unit_of_entries())
    array = reshaped(array, answer.shape)
    refuse_infinite(array)
    return array


def _typed_array(raw: Raw, shape: tuple[int, ...], units: NDArray[np.str_]) -> Array:
    """Numbers that were typed as text, each with or without its unit."""
    text = raw.value
    if raw.kind != "text":
        raise Unreadable(f"takes numbers of shape {shape}, got {clip(raw.kind)}")
    if isinstance(text, str) and shape:
        return typed_block(text, shape[-1], f"numbers of shape {shape}")
    entries, found = flat_texts(text)
    reshaped(np.zeros(found), shape)  # refuses another shape
    values: list[float] = []
    for entry, unit, where in zip(entries, units.ravel(), np.ndindex(shape), strict=True):
        values.append(quantity(entry, str(unit), entry_name(where)))
    return np.array(values, dtype=float).reshape(shape)


def _compared(_: Numbers, __: Variant, wanted: Wanted, value: Array) -> Mask:
    return wanted.allowed.holds(np.abs(value - wanted.value))


def _handed_in(_: Numbers, value: Any, __: Variant) -> Raw:
    return Raw("num", np.asarray(value, dtype=float))


def _shown(value: Any) -> Any:
    return np.asarray(value).tolist()


def _read_as(answer: Numbers, raw: Raw, value: Array) -> str:
    """How a number that was typed as text with a unit was read."""
    if answer.shape or raw.kind != "text":
        return ""
    number, unit = f"{float(value):.6g}", str(answer.unit_of_entries())
    return f"Read as {number}." if unit == "1" else f"Read as {number} {unit}."


def _trivial(_: Numbers, wanted: Wanted, __: Variant) -> Mask:
    return is_trivial(np.asarray(wanted.value), wanted.allowed)


def _arrays(asked: Asked, value: Array) -> list[Beside]:
    return [(value, asked.wanted.value, asked.wanted.allowed)]


def _has_blocks(answer: Numbers) -> bool:
    return answer.has_blocks


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
        _times(np.where(with_moments, 1000.0, 1.0), millimetres),
        _times(np.where(with_moments, 100.0, 1.0), centimetres),
        _times(np.where(angles, 180 / np.pi, 1.0), DEGREES),
    )


def _times(factors: Array, sentence: str) -> Presentation:
    """Entries that are too large by these factors."""
    return Presentation(lambda J: factors * J, sentence)


def _matching(pattern: re.Pattern[str], units: NDArray[np.str_]) -> Mask:
    """Which entries have a unit that fits the pattern as a whole."""
    found = [pattern.fullmatch(str(unit)) is not None for unit in units.ravel()]
    return np.array(found, dtype=bool).reshape(units.shape)


def _found(asked: Asked, value: Array, right: Mask) -> Iterator[Named]:
    wanted, decimals = asked.wanted, asked.answer.decimals

    def agrees(own: Array) -> bool:
        return wanted.allowed.holds_everywhere(np.abs(own - wanted.value))

    in_degrees = asked.in_degrees()
    if in_degrees is not None and wanted.allowed.holds_everywhere(np.abs(value - in_degrees)):
        yield Named(TAKEN_AS_DEGREES, "presentation")
    elif _too_few_decimals(asked.answer, wanted.value, value):
        sentence = f"It agrees after rounding to fewer decimals; {decimals} are asked."
        yield Named(sentence, "slip", key="decimals")
    else:
        reversed_sign = wanted.allowed.holds(np.abs(value + wanted.value))
        signs = [*said_of_signs(~right & reversed_sign, ~right)]
        yield from signs
        yield from said_of_exchanged(agrees, value)
        if not signs:
            yield from said_of_one_entry(right)


def _alone(answer: Numbers) -> Alone:
    """Whole numbers, such as ranks, are guessed."""
    return "in full" if answer.decimals > 0 else "not at all"


def _priced(answer: Numbers, value: Array) -> bool:
    """Whether there are decimals, and a number that is none of -1, 0 and 1."""
    return answer.decimals > 0 and not is_trivial(value).all()


def _too_few_decimals(answer: Numbers, reference: Array, value: Array) -> bool:
    """Whether an answer is the reference, rounded to fewer decimals than are asked."""
    for decimals in range(answer.decimals - 1, 0, -1):
        rounded = np.abs(value - np.round(value, decimals)).max() < 1e-9
        if rounded and np.abs(value - reference).max() <= 0.5001 * 10.0**-decimals:
            return True
    return False


MARKER = Marker(
    read_numbers,
    _compared,
    _handed_in,
    shown=_shown,
    read_as=_read_as,
    trivial=_trivial,
    varies=True,
    arrays=_arrays,
    has_blocks=_has_blocks,
    in_other_units=_in_other_units,
    found=_found,
    alone=_alone,
    priced=_priced,
)
