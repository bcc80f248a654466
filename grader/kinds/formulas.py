"""Formulas in the names of the sheet."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ...exercises.answers import Formulas, Variant
from ...exercises.kinds.formulas import names_on_sheet
from ...solutions.expression import Expression, ExpressionError, parse
from ...solutions.expression_array import SAME, ExpressionArray, same_formulas, sampled
from ..collecting.wire import Raw
from ..reading.arrays import flat_texts, reshaped
from ..reading.typed import typed
from ..reading.typed_matrix import typed_matrix
from ..reading.unreadable import Unreadable, clip, entry_name, misread
from .marker import Array, Asked, Marker, Mask, Wanted
from .signs import said_of_signs

NUMBERS_PUT_IN = 5e-3  # numbers of a sheet have two or three decimals


def read_formulas(answer: Formulas, raw: Raw, v: Variant) -> ExpressionArray:
    """Formulas of the asked shape: nested text, one text with all of them, or constants. Raises Unreadable."""
    names = names_on_sheet(answer.names, v)
    if raw.kind not in ("text", "num"):
        raise Unreadable(f"takes formulas of shape {answer.shape}, got {clip(raw.kind)}")
    if isinstance(raw.value, str) and answer.shape:
        rows = _read(raw.value, lambda text: typed_matrix(text, names))
        reshaped(np.zeros((len(rows), len(rows[0]))), answer.shape)  # refuses another shape
        entries = [entry for row in rows for entry in row]
    else:
        reshaped(
            np.zeros(_shape_of(raw)), answer.shape
        )  # refuses another shape before entries are read
        entries = _entries(raw, names)
    return ExpressionArray(tuple(entries), answer.shape)


def _read(text: str, read: Callable[[str], Any], where: str = "") -> Any:
    try:
        return read(text)
    except ExpressionError as error:
        raise misread(error, where) from error


def _shape_of(raw: Raw) -> tuple[int, ...]:
    return raw.value.shape if raw.kind == "num" else flat_texts(raw.value)[1]


def _entries(raw: Raw, names: tuple[str, ...]) -> list[Expression]:
    if raw.kind == "num":
        array = raw.value
        if np.iscomplexobj(array) or not np.isfinite(array).all():
            raise Unreadable("takes formulas, got numbers that are not finite and real")
        return [_read(_constant(float(x)), lambda text: parse(text, ())) for x in array.ravel()]
    flat, shape = flat_texts(raw.value)
    places = np.ndindex(shape)
    return [
        _read(text, lambda text: typed(text, names), entry_name(where))
        for text, where in zip(flat, places, strict=True)
    ]


def _constant(number: float) -> str:
    return "0" if abs(number) < 1e-12 else repr(number)


def _compared(answer: Formulas, v: Variant, wanted: Wanted, value: ExpressionArray) -> Mask:
    return same_formulas(value, wanted.value, names_on_sheet(answer.names, v))


def _handed_in(_: Formulas, value: ExpressionArray, __: Variant) -> Raw:
    return Raw("text", value.text())


def _trivial(_: Formulas, wanted: Wanted, __: Variant) -> Mask:
    """Entries without names."""
    constant = [not entry.names for entry in wanted.value.entries]
    return np.array(constant).reshape(wanted.value.shape)


def _arrays(asked: Asked, value: ExpressionArray) -> list[tuple[Array, Array, Array]]:
    """Numbers of both at a few points."""
    names = names_on_sheet(asked.answer.names, asked.v)
    found: list[tuple[Array, Array, Array]] = []
    for own, reference in zip(
        sampled(value, names), sampled(asked.wanted.value, names), strict=True
    ):
        found.append((own, reference, SAME * np.maximum(1.0, np.abs(reference))))
    return found


def _found(asked: Asked, value: ExpressionArray, right: Mask) -> Iterator[str]:
    reference: ExpressionArray = asked.wanted.value
    own = own_numbers(asked.v)
    if set(own) >= reference.names | value.names and not value.names >= reference.names:
        difference = np.abs(value.at(own) - reference.at(own))
        if (difference <= NUMBERS_PUT_IN).all():
            missing = ", ".join(sorted(reference.names - value.names))
            yield f"With your numbers put in it is right, but formulas are asked: they take {missing}."
            return
    negated = same_formulas(_negated(value), reference, names_on_sheet(asked.answer.names, asked.v))
    yield from said_of_signs(negated & ~right, ~right)


def own_numbers(v: Variant) -> dict[str, float]:
    """Values of all names of a sheet, joints included."""
    joints = {f"q{i}": float(x) for i, x in enumerate(v.get("q", ()), 1)}
    return {**{name: float(x) for name, x in v.items() if isinstance(x, int | float)}, **joints}


def _negated(value: ExpressionArray) -> ExpressionArray:
    negated = (Expression((*entry.nodes, ("neg", len(entry.nodes) - 1))) for entry in value.entries)
    return ExpressionArray(tuple(negated), value.shape)


MARKER = Marker(
    read_formulas,
    _compared,
    _handed_in,
    shown=ExpressionArray.text,
    trivial=_trivial,
    arrays=_arrays,
    has_blocks=lambda _: True,
    found=_found,
)
