"""Arguments of a student's function: how they arrive there, and so at the reference."""

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np

Calls = Mapping[str, Sequence[tuple[Any, ...]]]
"""Arguments of calls of a student's function, by the name of the group they are reported under."""


def arrived(argument: Any) -> Any:
    """An argument as a function gets it: its own copy, so that it may be changed.

    A list of numbers, or of equal rows of them, becomes a float array, also inside dicts and lists;
    a list that holds text or dicts, or rows of different lengths, stays a list. Numbers and text
    stay as they are.
    """
    if isinstance(argument, Mapping):
        fields = cast("Mapping[str, Any]", argument)
        return {name: arrived(value) for name, value in fields.items()}

    if isinstance(argument, np.ndarray | np.generic):
        argument = cast("Any", argument).tolist()
    if not isinstance(argument, list | tuple):
        return argument

    items = cast("list[Any] | tuple[Any, ...]", argument)
    if _shape(items) is not None:
        return np.array(items, dtype=float)
    return [arrived(item) for item in items]


def _shape(value: Any) -> tuple[int, ...] | None:
    """Shape of nested numbers; None where they are no array."""
    if isinstance(value, np.ndarray):
        return _shape(cast("Any", value).tolist())
    if isinstance(value, int | float | np.number | np.bool_):
        return ()
    if not isinstance(value, list | tuple):
        return None

    items = cast("list[Any] | tuple[Any, ...]", value)
    if not items:
        return (0,)
    first = _shape(items[0])
    if first is None or any(_shape(item) != first for item in items[1:]):
        return None
    return (len(items), *first)
