"""A declared value as a student would hand it in: what reading undoes."""

from collections.abc import Callable
from typing import Any

import numpy as np

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
from ..solutions.condition import condition_text
from .wire import Raw


def handed_in(answer: Answer, value: Any, v: Variant) -> Raw:
    """The raw value that is read as this value; functions have been called on their inputs."""
    return _HANDED_IN[type(answer)](answer, value, v)


def rounded(answer: Answer, value: Any) -> Any:
    """The value to the decimals that are asked; what is not numbers stays as it is."""
    return np.round(np.asarray(value), answer.decimals) if isinstance(answer, Numbers | Configurations) else value


def _numbers(_: Answer, value: Any, __: Variant) -> Raw:
    return Raw("num", np.asarray(value, dtype=float))


def _text(_: Answer, value: str, __: Variant) -> Raw:
    return Raw("text", value)


def _calls(answer: Function, value: Callable[..., Any], v: Variant) -> Raw:
    calls = [call for group in answer.inputs(v).values() for call in group]
    return Raw("calls", [Raw("num", np.asarray(value(*call), dtype=float)) for call in calls])


_HANDED_IN: dict[type, Callable[[Any, Any, Variant], Raw]] = {
    Numbers: _numbers,
    Configurations: _numbers,
    TableOf: lambda _, value, __: Raw("text", [[str(cell) for cell in row] for row in value.rows]),
    Formulas: lambda _, value, __: Raw("text", value.text()),
    Conditions: lambda _, value, __: Raw("text", [condition_text(condition) for condition in value]),
    Choice: _text,
    Manual: _text,
    Function: _calls,
}
