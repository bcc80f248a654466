"""What marking asks of a kind of answer, and what a comparison says."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Variant
from ..collecting.wire import Raw

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
TRIVIAL = (-1.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Wanted:
    """The answer that follows from `given`, and how far each entry of numbers may be off."""

    value: Any
    given: Mapping[str, Any]
    allowed: Array


@dataclass(frozen=True)
class Comparison:
    """Which entries are right, of the shape in which the answer is shown, the share of the points, what was seen.

    `reading` is how the question was read, where the part's own check tells.
    """

    right: Any
    share: float
    findings: tuple[str, ...] = ()
    reading: str = ""

    @property
    def all_right(self) -> bool:
        """Whether nothing is wrong or missing."""
        return self.share == 1.0


@dataclass(frozen=True)
class Presentation:
    """A finished matrix handed in another way: `of(reference)` is what would be seen, None where it cannot be."""

    of: Callable[[Array], Array | None]
    sentence: str
    worthless: bool = False  # entries that agree by chance earn nothing


@dataclass(frozen=True)
class Asked:
    """What a wrong answer is looked at with: the kind as declared, the variant, and what is wanted.

    `in_degrees` is the answer of somebody who takes every printed angle for degrees; None where there is none.
    """

    answer: Any
    v: Variant
    wanted: Wanted
    in_degrees: Callable[[], Any]


def _no_sentence(*_: Any) -> str:
    return ""


def _nothing(*_: Any) -> Sequence[Any]:
    return ()


def _as_it_is(value: Any) -> Any:
    return value


def _everything_counts(_: Any, wanted: Wanted, __: Variant) -> Mask:
    return np.zeros((), dtype=bool)


@dataclass(frozen=True)
class Marker:
    """A kind of answer as it is marked; each file of this folder has one.

    `read(answer, raw, v)` returns the declared value or raises Unreadable. `compared(answer, v, wanted, value)` returns
    the mask of right entries, or a Comparison where the points do not follow from entries.
    """

    read: Callable[[Any, Raw, Variant], Any]
    compared: Callable[[Any, Variant, Wanted, Any], Mask | Comparison]
    handed_in: Callable[[Any, Any, Variant], Raw]
    """A declared value as a student would hand it in: what reading undoes."""
    shown: Callable[[Any], Any] = _as_it_is
    """A value as nested lists of numbers and text, in the shape of its right entries."""
    read_as: Callable[[Any, Raw, Any], str] = _no_sentence
    """How an answer was read, in a sentence, where that may surprise."""
    trivial: Callable[[Any, Wanted, Variant], Mask] = _everything_counts
    """Entries of the reference that anybody would guess, so that they carry no points."""
    varies: bool = False
    """Whether entries that are the same for all students carry no points."""
    by_rows: bool = False
    """Whether a wrong entry that carries no points voids its row instead of its column."""
    checked: Callable[[Any, Variant, Wanted, Any, Any], Comparison] | None = None
    """What a part's own check found right, where that is not a mask of entries."""
    arrays: Callable[[Asked, Any], Sequence[tuple[Array, Array, Array]]] = _nothing
    """Own, wanted and allowed arrays in which another presentation of the right answer shows."""
    has_blocks: Callable[[Any], bool] = lambda _: False
    """Whether linear and angular rows may be exchanged."""
    in_other_units: Callable[[Any], Sequence[Presentation]] = _nothing
    found: Callable[[Asked, Any, Mask], Iterator[str] | Sequence[str]] = _nothing
    """Sentences on a wrong answer of any exercise, from most to least telling."""


def is_trivial(numbers: Array, allowed: Array | float) -> Mask:
    """Entries that are -1, 0 or 1."""
    close = np.maximum(allowed, 1e-6)
    away = np.abs(numbers[..., None] - TRIVIAL)
    return np.asarray((away <= np.asarray(close)[..., None]).any(axis=-1))
