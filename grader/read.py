"""From raw values to answers of the declared kind: shape before anything else, then finite, then values."""

import re
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..exercises.answers import (
    Answer,
    Choice,
    Conditions,
    Configurations,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
    Variant,
)
from ..exercises.results import Result, Results
from .read_formulas import read_conditions, read_formulas
from .read_numbers import flat_texts, read_configurations, read_numbers
from .read_table import read_table
from .unreadable import Unreadable, clip
from .wire import Raw

UNANSWERED = "not answered"
MOST_TEXT = 20_000  # characters of an argument in words
CALLED = re.compile(r"\Acall [0-9]+(?: stopped with|:)? ")  # groups number their calls anew
NOTHING = "not a matrix of numbers: None"  # what the collector says of a call that returned None


def read(answer: Answer, raw: Raw, v: Variant) -> Any:
    """The student's answer as the declared kind.

    Raises:
        Unreadable: nothing was handed in, or it is of another kind or shape; the sentence says what was expected.
    """
    if raw.kind == "missing":
        raise Unreadable(UNANSWERED)
    if raw.kind == "error":
        raise Unreadable(str(raw.value))
    return _READERS[type(answer)](answer, raw, v)


def _choice(answer: Choice, raw: Raw, _: Variant) -> str:
    text = f"{raw.value.item():g}" if raw.kind == "num" and raw.value.size == 1 else str(raw.value).strip()
    for letter, option in zip(answer.letters, answer.options, strict=True):
        ways = {letter, option.lower(), f"{letter}) {option.lower()}"}
        if {text.lower(), text.lower().strip("().: ")} & ways:
            return letter
    got = "a number" if raw.kind == "num" else repr(clip(raw.value))
    raise Unreadable(f"takes one of the letters {', '.join(answer.letters)} in quotes, got {got}")


def _results(answer: Function, raw: Raw, v: Variant) -> Results:
    if raw.kind == "calls":
        if all(result.kind == "error" and NOTHING in str(result.value) for result in raw.value):
            raise Unreadable(f"{UNANSWERED}: the function returns nothing")
        return Results(tuple(map(_result, raw.value)), raw.listed)
    if raw.kind == "num" and answer.published and _are_results(raw.value, answer, v):
        return Results(tuple(np.asarray(x, dtype=float) for x in raw.value), published=True)
    raise Unreadable(f"takes a function, def NAME{answer.signature}, got {'numbers' if raw.kind == 'num' else 'text'}")


def _are_results(value: NDArray[np.float64], answer: Function, v: Variant) -> bool:
    """Whether an array is a list of results of one shape; numbers alone are, where there are as many as calls."""
    assert answer.published  # noqa: S101 - asked by the caller
    calls = sum(len(group) for group in answer.published(v).values())
    return value.ndim > 1 or value.shape == (calls,)


def _result(raw: Raw) -> Result:
    if raw.kind != "num":
        return CALLED.sub("", str(raw.value), count=1) if raw.kind == "error" else "no matrix of numbers"
    if np.iscomplexobj(raw.value):
        return "complex numbers"
    return np.asarray(raw.value, dtype=float) if np.isfinite(raw.value).all() else "NaN or infinity"


def _text(_: Manual, raw: Raw, __: Variant) -> str:
    if raw.kind != "text":
        raise Unreadable("takes text in quotes")
    text = raw.value if isinstance(raw.value, str) else "\n".join(flat_texts(raw.value)[0])
    if len(text) > MOST_TEXT:
        raise Unreadable(f"takes up to {MOST_TEXT} characters, got {len(text)}")
    return text


_READERS: dict[type, Callable[[Any, Raw, Variant], Any]] = {
    Numbers: read_numbers,
    TableOf: read_table,
    Formulas: read_formulas,
    Choice: _choice,
    Conditions: read_conditions,
    Configurations: read_configurations,
    Function: _results,
    Manual: _text,
}
