"""Every kind of answer and how it is marked."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, cast

from ...exercises.answers import (
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
from ...exercises.exercise import Part
from ..collecting.wire import Raw
from ..reading.unreadable import UNANSWERED, Unreadable
from . import choice, conditions, configurations, formulas, function, manual, numbers, table
from .marker import Marker

MARKERS: Mapping[type[Answer], Marker] = MappingProxyType(
    {
        Numbers: numbers.MARKER,
        TableOf: table.MARKER,
        Formulas: formulas.MARKER,
        Choice: choice.MARKER,
        Conditions: conditions.MARKER,
        Configurations: configurations.MARKER,
        Function: function.MARKER,
        Manual: manual.MARKER,
    }
)


def marker_of(answer: Answer) -> Marker:
    """How this kind is marked."""
    return MARKERS[type(answer)]


def raw_of(part: Part, raws: Mapping[str, Raw]) -> Raw:
    """What was handed in for a part, and what was declared beside it."""
    raw = raws.get(part.variable, Raw("missing"))
    declared: dict[str, Raw] = {}
    for name, variable in part.beside.items():
        if variable in raws:
            declared[name] = raws[variable]
    return replace(raw, beside=declared) if declared else raw


def read(answer: Answer, raw: Raw, v: Variant) -> Any:
    """The student's answer as the declared kind: first its shape, then finite, then its values.

    Raises:
        Unreadable: nothing was handed in, or it is of another kind or shape; the sentence says
            what was expected.
    """
    if raw.kind == "missing" or (raw.kind == "text" and _is_blank(raw.value)):
        raise Unreadable(UNANSWERED)
    if raw.kind == "error":
        raise Unreadable(str(raw.value))
    return marker_of(answer).read(answer, raw, v)


def _is_blank(typed: Any) -> bool:
    """Whether text, or all text of a list, is nothing but space: no answer, whatever is asked."""
    if isinstance(typed, list):
        entries = cast("list[Any]", typed)
        return bool(entries) and all(map(_is_blank, entries))
    return not str(typed).strip()


def handed_in(answer: Answer, value: Any, v: Variant) -> Raw:
    """The raw value that is read as this value; functions have been called on their inputs."""
    return marker_of(answer).handed_in(answer, value, v)
