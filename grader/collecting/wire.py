"""What a student's process may say: checked, never trusted, turned into raw values."""

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import Annotated, Any, Literal, Self, cast

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from .ask import MAX_CALLS
from .machine_paths import without_paths

Kind = Literal["num", "text", "calls", "missing", "error", "unasked", "interrupted"]
MAX_ELEMENTS = 4096
MAX_ROWS = 64  # of text, and cells in each
PACKAGE = re.compile(r"[A-Za-z_][A-Za-z0-9_.]{0,79}")  # by the name to import it by
MAX_SAID = 400  # of a sentence on how a cell or a call ended
MAX_TEXT = 20_000  # of one text: a formula, a matrix typed as a whole, an argument in words
Said = Annotated[str, Field(max_length=MAX_SAID)]
ENDED = "the notebook ended its own process before it finished"
UNMARKED = "the value is not one that can be marked"


@dataclass(frozen=True, eq=False)
class Raw:
    """A value as it came out, not yet read, or why there is none.

    The value is an array, nested text or, of kind "calls", a list with a Raw for every call. With
    `listed` it is a list of results of the published calls that was handed in as such; without, a
    function was called on what was asked. `note` says how the cell that set it ended, where it did
    not end well. `absent` names a package that it would have taken and that is not installed where
    sheets are marked. "missing" may say why. Two kinds never come out of a submission: "unasked"
    says why we could not ask, "interrupted" why we got no answer and will ask again. `beside` is
    what was declared beside the answer, by the end of its name.
    """

    kind: Kind
    value: Any = None
    note: str = ""
    listed: bool = False
    absent: str = ""
    beside: Mapping[str, "Raw"] = field(default_factory=dict[str, "Raw"])


class _Checked(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid")


class _Noted(_Checked):
    note: Said = ""


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


_Text = Annotated[str, Field(max_length=MAX_TEXT)]
_Row = Annotated[list[_Text], Field(max_length=MAX_ROWS)]
_Matrix = Annotated[list[_Row], Field(max_length=MAX_ROWS)]
_Rows = Annotated[list[_Text | _Row | _Matrix], Field(max_length=MAX_ROWS)]


class _Typed(_Noted):
    k: Literal["text"]
    v: _Text | _Rows


class _Nothing(_Checked):
    k: Literal["missing", "error"]
    v: Said
    absent: Said = ""


_Single = Annotated[_Numeric | _Typed | _Nothing, Field(discriminator="k")]


class _Calls(_Noted):
    k: Literal["calls"]
    v: Annotated[list[_Single], Field(max_length=MAX_CALLS)]
    listed: bool = False


class _Value(_Checked):
    value: Annotated[_Numeric | _Typed | _Nothing | _Calls, Field(discriminator="k")]


def read_frame(
    frame: bytes,
    names: Sequence[str],
    instead: Raw | None = None,
    calls: Mapping[str, int] | None = None,
) -> dict[str, Raw]:
    """Raw values by name from the last frame of a process.

    `instead` stands for what is missing where the process was stopped. `calls` says how many calls
    of each variable were asked for. One bad value blanks that variable; what is missing because the
    process did not finish is an error that says so.
    """
    asked = calls or {}
    content = _object(_content(frame))
    values = _object(content.get("values"))
    found = {name: _read_value(values.get(name), asked.get(name, 0)) for name in names}
    if content.get("done") is True and instead is None:
        return found
    nothing = instead or Raw("error", ENDED)
    return {name: _filled(raw, nothing) for name, raw in found.items()}


def _content(frame: bytes) -> Any:
    if not frame:
        return None
    try:
        return json.loads(frame)
    except (ValueError, RecursionError):
        return None


def _object(value: Any) -> dict[str, Any]:
    """A JSON object as it is, and an empty one for everything else."""
    return cast("dict[str, Any]", value) if isinstance(value, dict) else {}


def _filled(raw: Raw, nothing: Raw) -> Raw:
    """With the reason in the place of what is missing, calls that were not made included."""
    if raw.kind == "calls":
        results = [_filled(result, nothing) for result in raw.value]
        if nothing.kind == "interrupted" and nothing in results:
            return nothing
        return replace(raw, value=results)
    if raw.kind == "missing":
        return nothing
    return raw


def _read_value(data: Any, calls: int) -> Raw:
    if data is None:
        return Raw("missing", "")
    # It is sized before it is checked, for its errors are listed one by one.
    if isinstance(data, dict) and _is_too_large(cast("dict[str, Any]", data).get("v"), calls):
        return Raw("error", "the value is too large to be marked")
    try:
        value = _Value.model_validate({"value": data}).value
    except (ValidationError, RecursionError):
        return Raw("error", UNMARKED)

    if not isinstance(value, _Calls):
        return _single(value)
    if calls and (value.listed or len(value.v) == calls):
        note = without_paths(value.note)
        return Raw("calls", [_single(result) for result in value.v], note, value.listed)
    return Raw("error", UNMARKED)


def _is_too_large(content: Any, calls: int) -> bool:
    most = (12 if calls else 3) * MAX_ELEMENTS
    return _items(content, most) > most


def _items(value: Any, most: int, depth: int = 5) -> int:
    """How much is in a value, counted no further than it takes to know that it is too much."""
    if depth == 0 or not isinstance(value, list | dict):
        return 1
    parts = cast("dict[str, Any] | list[Any]", value)
    if isinstance(parts, dict):
        parts = list(parts.values())
    count = len(parts)
    for part in islice(parts, most):
        count += _items(part, most, depth - 1)
        if count > most:
            break
    return count


def _single(value: _Numeric | _Typed | _Nothing) -> Raw:
    if isinstance(value, _Numeric):
        return Raw("num", _array(value.v), without_paths(value.note))
    if isinstance(value, _Typed):
        return Raw("text", value.v, without_paths(value.note))
    absent = value.absent if PACKAGE.fullmatch(value.absent) else ""
    return Raw(value.k, without_paths(value.v), absent=absent)


def _array(parts: _Array) -> NDArray[Any]:
    """Real numbers, or complex ones where an imaginary part is not zero."""
    numbers = np.array(parts.re, dtype=float)
    if any(parts.im):
        numbers = numbers + 1j * np.array(parts.im)
    return numbers.reshape(parts.shape)
