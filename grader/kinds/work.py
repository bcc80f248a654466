"""A budget of work for answers that are judged by evaluating what a student typed."""

from collections.abc import Generator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import numpy as np

from ...solutions.expression import Expression

CALL = 50  # numbers in the time that it takes to call numpy once
_left: ContextVar[list[float] | None] = ContextVar("left", default=None)


class TooMuchWork(Exception):
    """The budget is spent."""


@contextmanager
def budget(numbers: float) -> Generator[None]:
    """What is evaluated inside may compute that many numbers.

    Raises:
        TooMuchWork: from inside, when they are spent.
    """
    token = _left.set([numbers])
    try:
        yield
    finally:
        _left.reset(token)


def evaluated(expression: Expression, values: Mapping[str, Any]) -> Any:
    """The value of an expression, paid for by the budget around it, if there is one.

    Raises:
        TooMuchWork: the budget is spent.
    """
    left = _left.get()
    if left is not None:
        left[0] -= len(expression.nodes) * (CALL + _count(expression, values))
        if left[0] < 0:
            raise TooMuchWork
    return expression.at(values)


def _count(expression: Expression, values: Mapping[str, Any]) -> int:
    """At how many points an expression is evaluated."""
    counts = [np.size(values[name]) for name in expression.names if name in values]
    return max(counts, default=1)
