"""Nested lists of numbers and text out of a file, as the raw values that a notebook would give."""

import re
from typing import Any, cast

import numpy as np

from .ask import MAX_CALLS, Ask
from .wire import MAX_ELEMENTS, MAX_ROWS, MAX_TEXT, Raw

DEPTH = 4  # of lists in lists that can be an array
LONE_SURROGATE = re.compile("[\ud800-\udfff]")
KINDS = {"dict": "an object", "bool": "true or false", "NoneType": "null"}


def raw_value(value: Any, ask: Ask) -> Raw:
    """Nested lists of numbers and text as a notebook would give them.

    Where results of calls were asked, a list whose parts have different shapes is a list of
    results.
    """
    if _leaves(value, MAX_ELEMENTS) > MAX_ELEMENTS:
        return Raw("error", f"too large: it has more than {MAX_ELEMENTS} entries")
    if not ask.calls or not isinstance(value, list):
        return _raw(value)

    results = [_yes_or_no_as_number(result) for result in cast("list[Any]", value)]
    whole = _raw(results)
    if whole.kind != "error" or len(results) > MAX_CALLS:
        return whole
    return _listed(results, whole)


def _listed(results: list[Any], whole: Raw) -> Raw:
    """Results of calls one by one, or the error of the list as a whole where none can be read."""
    found = [_raw(result) for result in results]
    kinds = {raw.kind for raw in found}
    if kinds == {"missing"}:
        return Raw("missing")
    if kinds <= {"missing", "error"}:
        return whole
    return Raw("calls", found, listed=True)


def _yes_or_no_as_number(result: Any) -> Any:
    """A function may say yes or no."""
    return float(result) if isinstance(result, bool) else result


def _leaves(value: Any, most: int, depth: int = 6) -> int:
    """Numbers, texts and empty lists in a value.

    They are counted no further than it takes to know that they are too many.
    """
    if not isinstance(value, list) or not value or depth == 0:
        return 1
    count = 0
    for item in cast("list[Any]", value):
        count += _leaves(item, most - count, depth - 1)
        if count > most:
            break
    return count


def _raw(value: Any) -> Raw:
    if value is None:
        return Raw("missing")
    try:
        shape, flat = _flattened(value)
        if any(isinstance(leaf, str) for leaf in flat):
            return Raw("text", _text(value, shape))
    except ValueError as error:
        return Raw("error", str(error))
    return _numbers(shape, flat)


def _numbers(shape: list[int], flat: list[Any]) -> Raw:
    """An array of real or complex numbers; yes and no are numbers only among others."""
    types = set[type[Any]](map(type, flat))
    if types == {bool}:
        return _no_numbers(flat[0])
    for leaf in flat:
        if not isinstance(leaf, float | complex | bool):
            return _no_numbers(leaf)
    dtype = complex if complex in types else float
    return Raw("num", np.array(flat, dtype=dtype).reshape(shape))


def _no_numbers(leaf: Any) -> Raw:
    kind = KINDS.get(type(leaf).__name__, "something else")
    return Raw("error", f"not a matrix of numbers: it holds {kind}")


def _text(value: Any, shape: list[int]) -> Any:
    """Strings, and numbers as strings, with nothing cut off."""
    if len(shape) > 3:
        raise ValueError("not a matrix: its text is nested too deeply")
    longest = max(shape, default=0)
    if longest > MAX_ROWS:
        raise ValueError(f"too long: a list of {longest} entries; an answer may have {MAX_ROWS}")
    return _entries(value)


def _entries(value: Any) -> Any:
    if isinstance(value, list):
        return [_entries(item) for item in cast("list[Any]", value)]
    text = repr(float(value)) if isinstance(value, float | bool) else str(value)
    if len(text) > MAX_TEXT:
        raise ValueError(f"too long: a text of {len(text)} characters; {MAX_TEXT} can be read here")
    return LONE_SURROGATE.sub("\N{REPLACEMENT CHARACTER}", text)


def _flattened(value: Any, depth: int = DEPTH) -> tuple[list[int], list[Any]]:
    """Shape and entries of nested lists."""
    if not isinstance(value, list):
        return [], [value]
    if depth == 0:
        raise ValueError("not a matrix: it is nested too deeply")

    shapes = set[tuple[int, ...]]()
    leaves: list[Any] = []
    for item in cast("list[Any]", value):
        shape, flat = _flattened(item, depth - 1)
        shapes.add(tuple(shape))
        leaves += flat
    if len(shapes) > 1:
        reason = "not a matrix: its rows have different lengths"
        if any(isinstance(leaf, str) for leaf in leaves):
            reason += "; a text with commas takes quotes"
        raise ValueError(reason)

    inner = shapes.pop() if shapes else ()
    return [len(cast("list[Any]", value)), *inner], leaves
