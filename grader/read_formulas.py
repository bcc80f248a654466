"""Formulas and conditions out of raw values, in the names of the sheet."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..exercises.answers import Conditions, Formulas, Variant
from ..exercises.values import names_on_sheet
from ..solutions.condition import Condition, equations_of
from ..solutions.expression import Expression, ExpressionError, parse
from ..solutions.expression_array import ExpressionArray
from ..solutions.typed import typed
from ..solutions.typed_equations import typed_equations
from ..solutions.typed_matrix import typed_matrix
from .read_numbers import flat_texts, reshaped
from .unreadable import Unreadable, clip, entry_name, misread
from .wire import Raw

MOST_CONDITIONS, MOST_EQUATIONS = 32, 64


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
        reshaped(np.zeros(_shape_of(raw)), answer.shape)  # refuses another shape before entries are read
        entries = _entries(raw, names)
    return ExpressionArray(tuple(entries), answer.shape)


def read_conditions(answer: Conditions, raw: Raw, v: Variant) -> tuple[Condition, ...]:
    """Expressions that are zero where a condition holds, or several that are zero at once. Raises Unreadable."""
    names = names_on_sheet(answer.names, v)
    if raw.kind != "text":
        got = "numbers" if raw.kind != "num" or raw.value.size else "nothing"
        raise Unreadable(f"takes a list of conditions in {', '.join(names)}, such as ['sin(q1) = 0'], got {got}")
    texts, _ = flat_texts(raw.value)  # a file has them in a row or a column
    found: list[Condition] = []
    for text in texts:
        if len(found) <= MOST_CONDITIONS:
            found += _read(text, lambda text: typed_equations(text, names))
    if not 1 <= len(found) <= MOST_CONDITIONS:
        raise Unreadable(f"takes 1 to {MOST_CONDITIONS} conditions, got {len(found)}")
    if (count := sum(len(equations_of(condition)) for condition in found)) > MOST_EQUATIONS:
        raise Unreadable(f"takes up to {MOST_EQUATIONS} equations in all conditions, got {count}")
    return tuple(found)


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
