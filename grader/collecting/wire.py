"""What a student's process may say: checked, never trusted, turned into raw values."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Annotated, Any, Literal, Self, cast

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from .ask import MAX_CALLS

Kind = Literal["num", "text", "calls", "missing", "error", "unasked"]
MAX_ELEMENTS = 4096
MAX_ROWS = 64  # of text, and cells in each
MAX_TEXT = 400  # of one entry
MAX_ANSWER = (
    20_000  # of an answer that is one text: a matrix typed as a whole, an argument in words
)
Text = Annotated[str, Field(max_length=MAX_TEXT)]


@dataclass(frozen=True, eq=False)
class Raw:
    """A value as it came out, not yet read: an array, nested text, results of calls, or why there is none.

    The value of kind "calls" is a list with a Raw for every call. With `listed` it is a list of results of the
    published calls that was handed in as such; without, a function was called on what was asked. `note` says how the
    cell that set it ended, where it did not end well. Kind "unasked" never comes out of a submission: it says why we
    could not ask.
    """

    kind: Kind
    value: Any = None
    note: str = ""
    listed: bool = False


class _Checked(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid")


class _Noted(_Checked):
    note: Text = ""


class _Array(_Checked):
    shape: Annotated[list[Annotated[int, Field(ge=0, le=MAX_ELEMENTS)]], Field(max_length=4)]
    re: Annotated[list[float], Field(max_length=MAX_ELEMENTS)]
    im: Annotated[list[float], Field(max_length=MAX_ELEMENTS)]

    @model_validator(mode="after")
    def _sizes_agree(self) -> Self:
        size = math.prod(self.shape)
        if len(self.re) != size or len(self.im) not in (0, size):
            raise ValueError(f"{len(self.re)} numbers do not fill the shape {self.shape}")
        return self


class _Numeric(_Noted):
    k: Literal["num"]
    v: _Array


class _Text(_Noted):
    k: Literal["text"]
    v: (
        Annotated[str, Field(max_length=MAX_ANSWER)]
        | Annotated[
            list[Text | Annotated[list[Text], Field(max_length=MAX_ROWS)]],
            Field(max_length=MAX_ROWS),
        ]
    )


class _Nothing(_Checked):
    k: Literal["missing", "error"]
    v: Text


_Single = Annotated[_Numeric | _Text | _Nothing, Field(discriminator="k")]


class _Calls(_Noted):
    k: Literal["calls"]
    v: Annotated[list[_Single], Field(max_length=MAX_CALLS)]
    listed: bool = False


class _Value(_Checked):
    value: Annotated[_Numeric | _Text | _Nothing | _Calls, Field(discriminator="k")]


def read_frame(
    frame: bytes, names: Sequence[str], why: str, calls: Mapping[str, int] | None = None
) -> dict[str, Raw]:
    """Raw values by name from the last frame of a process; `why` it was stopped, or empty.

    `calls` says how many calls of each variable were asked for. One bad value blanks that variable; what is missing
    because the process did not finish is an error that says so.
    """
    asked = calls or {}
    try:
        content: Any = json.loads(frame) if frame else {}
    except (ValueError, RecursionError):
        content = {}
    fields: dict[str, Any] = content if isinstance(content, dict) else {}  # pyright: ignore[reportUnknownVariableType]
    values: dict[str, Any] = fields["values"] if isinstance(fields.get("values"), dict) else {}
    found = {name: _read_value(values.get(name), asked.get(name, 0)) for name in names}
    if fields.get("done") is True and not why:
        return found
    nothing = Raw("error", why or "the notebook ended its own process before it finished")
    return {name: _filled(raw, nothing) for name, raw in found.items()}


def _filled(raw: Raw, nothing: Raw) -> Raw:
    """With the reason in the place of what is missing, calls that were not made included."""
    if raw.kind == "calls":
        return replace(raw, value=[_filled(result, nothing) for result in raw.value])
    return nothing if raw.kind == "missing" else raw


def _items(value: Any, most: int, depth: int = 5) -> int:
    """How much is in a value, counted no further than it takes to know that it is too much."""
    if depth == 0 or not isinstance(value, list | dict):
        return 1
    parts: Any = value.values() if isinstance(value, dict) else value  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    count = len(parts)
    for part in islice(parts, most):
        count += _items(part, most, depth - 1)
        if count > most:
            break
    return count


def _read_value(data: Any, calls: int) -> Raw:
    if data is None:
        return Raw("missing", "")
    most = (12 if calls else 3) * MAX_ELEMENTS
    if isinstance(data, dict):  # sized before errors are listed one by one
        content = cast("dict[str, Any]", data).get("v")
        if _items(content, most) > most:
            return Raw("error", "the value is too large to be marked")
    try:
        value = _Value.model_validate({"value": data}).value
    except (ValidationError, RecursionError):
        return Raw("error", "the value is not one that can be marked")
    if not isinstance(value, _Calls):
        return _single(value)
    if not calls or not (value.listed or len(value.v) == calls):
        return Raw("error", "the value is not one that can be marked")
    return Raw("calls", [_single(result) for result in value.v], value.note, value.listed)


def _single(value: _Numeric | _Text | _Nothing) -> Raw:
    if not isinstance(value, _Numeric):
        return Raw(value.k, value.v, value.note if isinstance(value, _Text) else "")
    real = np.array(value.v.re, dtype=float)
    array = real + 1j * np.array(value.v.im) if any(value.v.im) else real
    return Raw("num", array.reshape(value.v.shape), value.note)
