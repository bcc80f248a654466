"""Functions: results of the calls of a notebook, or those handed in for published inputs."""

import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Function, Results, Variant
from ...exercises.kinds.results import Result
from ..collecting.wire import Raw
from ..reading.arrays import real_numbers
from ..reading.unreadable import UNANSWERED, Unreadable
from .calls import accepted, agreeing, failed_calls, groups_of, said_of_groups, share_of_groups
from .marker import Comparison, Marker, Wanted, is_trivial

CALLED = re.compile(r"\Acall [0-9]+(?: stopped with|:)? ")  # groups number their calls anew
NOTHING = "not a matrix of numbers: None"  # what the collector says of a call that returned None


def read_results(answer: Function, raw: Raw, v: Variant) -> Results:
    """What came out of every call, in the order of the inputs.

    Raises:
        Unreadable: it is no function, or one that never returns anything.
    """
    if raw.kind == "calls":
        if _return_nothing(raw.value):
            raise Unreadable(f"{UNANSWERED}: the function returns nothing")
        return Results(tuple(map(_result, raw.value)), raw.listed)
    if raw.kind == "num" and answer.published and _are_results(raw.value, answer, v):
        return Results(tuple(np.asarray(x, dtype=float) for x in raw.value), published=True)
    got = "numbers" if raw.kind == "num" else "text"
    raise Unreadable(f"takes a function, def NAME{answer.signature}, got {got}")


def _return_nothing(calls: Sequence[Raw]) -> bool:
    """Whether all calls returned None: the body of the function is still to be written."""
    return all(call.kind == "error" and NOTHING in str(call.value) for call in calls)


def _are_results(value: NDArray[np.float64], answer: Function, v: Variant) -> bool:
    """Whether an array is a list of results of one shape.

    Numbers alone are, where there are as many as calls.
    """
    return value.ndim > 1 or value.shape == (len(answer.published_calls(v)),)


def _result(raw: Raw) -> Result:
    """The array that a call returned, or why there is none."""
    if raw.kind == "error":
        return CALLED.sub("", str(raw.value), count=1)
    if raw.kind != "num":
        return "no matrix of numbers"
    try:
        result = real_numbers(raw.value)
    except Unreadable:
        return "complex numbers"
    if not np.isfinite(result).all():
        return "NaN or infinity"
    return np.asarray(result, dtype=float)


def _compared(answer: Function, v: Variant, wanted: Wanted, value: Results) -> Comparison:
    """Call by call; a group counts when all of its calls are right."""
    groups = groups_of(answer, v, wanted.value, value)
    right = agreeing(groups, answer.tolerance)
    findings = said_of_groups(groups, right, answer.tolerance)
    return Comparison(right, share_of_groups(groups, right), tuple(findings))


def _checked(
    answer: Function, v: Variant, wanted: Wanted, value: Results, right: Any
) -> Comparison:
    """By the flags of a part's own check, with why calls gave nothing to judge."""
    groups = groups_of(answer, v, wanted.value, value)
    flags = accepted(groups, right)
    return Comparison(flags, share_of_groups(groups, flags), tuple(failed_calls(groups)))


def _handed_in(answer: Function, value: Callable[..., Any], v: Variant) -> Raw:
    results = [np.asarray(value(*call), dtype=float) for call in answer.calls(v)]
    return Raw("calls", [Raw("num", result) for result in results])


def _shown(_: Results) -> None:
    """Nothing: what is right of it is said group by group."""


def _priced(_: Function, value: Results) -> bool:
    """Whether a call gave numbers that are none of -1, 0 and 1."""
    arrays = [result for result in value.values if not isinstance(result, str)]
    return any(not is_trivial(array).all() for array in arrays)


MARKER = Marker(
    read_results,
    _compared,
    _handed_in,
    shown=_shown,
    checked=_checked,
    priced=_priced,
)
