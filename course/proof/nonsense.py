"""What nobody shall get a point for.

Zeros, ones, the identity, another shape, one result for all inputs.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import (
    Answer,
    Conditions,
    Function,
    Manual,
    Variant,
)
from ...grader.collecting.wire import Raw

Array = NDArray[np.float64]
Spoiled = Callable[[Answer, Any, Variant], Raw]
"""What is handed in for an answer kind, its reference and its variant."""


def _filled(fill: Callable[[tuple[int, ...]], Array]) -> Spoiled:
    """Numbers of the asked shape, whatever the kind.

    In place of a function, one that returns them for every input.
    """

    def raw(answer: Answer, value: Any, v: Variant) -> Raw:
        if not isinstance(answer, Function):
            return Raw("num", fill(answer.array_shape))
        results: list[Raw] = []
        for call in answer.calls(v):
            right = np.asarray(value(*call))
            results.append(Raw("num", fill(right.shape)))
        return Raw("calls", results)

    return raw


def _identity(shape: tuple[int, ...]) -> Array:
    """Ones on the diagonal of every matrix; of a vector, the first unit vector."""
    if not shape:
        return np.ones(())
    if len(shape) == 1:
        return np.eye(1, shape[0])[0]
    return np.broadcast_to(np.eye(shape[-2], shape[-1]), shape).copy()


def _commonest(answer: Answer, value: Any, v: Variant) -> Raw:
    """A function that returns for every input what is right for most of them.

    Where all results differ it is nothing.
    """
    if not isinstance(answer, Function):
        return Raw("missing")
    results = [np.asarray(value(*call), dtype=float) for call in answer.calls(v)]
    often = [_count(result, results) for result in results]
    if max(often, default=0) < 2:
        return Raw("missing")
    commonest = Raw("num", results[int(np.argmax(often))])
    return Raw("calls", [commonest] * len(results))


def _count(result: Array, results: Sequence[Array]) -> int:
    return sum(np.array_equal(result, other) for other in results)


def _always(raw: Raw) -> Spoiled:
    """The same, whatever is asked."""

    def same(_: Answer, __: Any, ___: Variant) -> Raw:
        return raw

    return same


def _as_empty(answer: Answer, _: Any, __: Variant) -> Raw:
    if isinstance(answer, Conditions):
        return Raw("text", [])
    return Raw("num", np.ones((0,)))


def _quoted_x(answer: Answer, _: Any, __: Variant) -> Raw:
    if isinstance(answer, Manual):  # a person reads it
        return Raw("missing")
    return Raw("text", "x")


NONSENSE: dict[str, Spoiled] = {
    "0.0": _always(Raw("num", np.array(0.0))),
    "zeros": _filled(np.zeros),
    "ones": _filled(np.ones),
    "minus ones": _filled(lambda shape: -np.ones(shape)),
    "identity": _filled(_identity),
    "None": _always(Raw("error", "not a matrix of numbers: None")),
    "'x'": _quoted_x,
    "NaN": _filled(lambda shape: np.full(shape, np.nan)),
    "one result for all inputs": _commonest,
    "another shape": _filled(lambda shape: np.ones((*shape, 2))),
    "ones((1, 1))": _always(Raw("num", np.ones((1, 1)))),
    "empty": _as_empty,
    "missing": _always(Raw("missing")),
}
"""What is handed in, by the name under which `validate` tells of it."""
