"""What a student's process may say: checked, never trusted, turned into raw values."""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

Kind = Literal["num", "text", "calls", "results", "missing", "error"]
MAX_ELEMENTS = 4096
Text = Annotated[str, Field(max_length=400)]


@dataclass(frozen=True, eq=False)
class Raw:
    """A value as it came out, not yet read: an array, nested text, or why there is none.

    `note` says how the cell that set it ended, where it did not end well.
    """

    kind: Kind
    value: Any = None
    note: str = ""


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
    v: Text | Annotated[list[Text | Annotated[list[Text], Field(max_length=64)]], Field(max_length=64)]


class _Nothing(_Checked):
    k: Literal["missing", "error"]
    v: Text


class _Value(_Checked):
    value: Annotated[_Numeric | _Text | _Nothing, Field(discriminator="k")]


def read_frame(frame: bytes, names: Sequence[str], why: str) -> dict[str, Raw]:
    """Raw values by name from the last frame of a process; `why` it was stopped, or empty.

    One bad value blanks that variable; what is missing because the process did not finish is an error that says so.
    """
    try:
        content: Any = json.loads(frame) if frame else {}
    except (ValueError, RecursionError):
        content = {}
    fields: dict[str, Any] = content if isinstance(content, dict) else {}  # pyright: ignore[reportUnknownVariableType]
    values: dict[str, Any] = fields["values"] if isinstance(fields.get("values"), dict) else {}
    found = {name: _read_value(values.get(name)) for name in names}
    if fields.get("done") is True and not why:
        return found
    nothing = Raw("error", why or "the notebook ended its own process before it finished")
    return {name: nothing if raw.kind == "missing" else raw for name, raw in found.items()}


def _items(value: Any, depth: int = 4) -> int:
    """How much is in a value, counted no further than it takes to know that it is too much."""
    if depth == 0 or not isinstance(value, list | dict):
        return 1
    parts: Any = value.values() if isinstance(value, dict) else value  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    count = len(parts)
    for part in islice(parts, 3 * MAX_ELEMENTS):
        count += _items(part, depth - 1)
        if count > 3 * MAX_ELEMENTS:
            break
    return count


def _read_value(data: Any) -> Raw:
    if data is None:
        return Raw("missing", "")
    if isinstance(data, dict) and _items(data.get("v")) > 3 * MAX_ELEMENTS:  # before errors are listed one by one  # pyright: ignore[reportUnknownMemberType]
        return Raw("error", "the value is too large to be marked")
    try:
        value = _Value.model_validate({"value": data}).value
    except (ValidationError, RecursionError):
        return Raw("error", "the value is not one that can be marked")
    if not isinstance(value, _Numeric):
        return Raw(value.k, value.v, value.note if isinstance(value, _Text) else "")
    real = np.array(value.v.re, dtype=float)
    array = real + 1j * np.array(value.v.im) if any(value.v.im) else real
    return Raw("num", array.reshape(value.v.shape), value.note)
