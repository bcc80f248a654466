"""How a kind of answer is marked: the functions that it gives, and what they are given.

To add a kind, declare it in exercises/kinds, write a file here that ends with
`MARKER = Marker(...)`, and enter it in markers.py. Good models are choice.py, for an answer that is
right or wrong as a whole, and table.py, for one that is right cell by cell.

Marking calls, in this order: `read`; `compared`; `checked`, where the part has a check of its own;
and what explains a wrong answer, `arrays` and `found`.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ...exercises.answers import Variant
from ...exercises.exercise import Fault
from ..collecting.wire import Raw
from .allowed import NOT_ALLOWED, Allowed, Array, Mask

Beside = tuple[Array, Array, Allowed]
"""Own and wanted numbers, and how far each may be off."""
TRIVIAL = (-1.0, 0.0, 1.0)
SURELY = 1e-6  # as near to one of those as a number can be said to be


@dataclass(frozen=True, eq=False)
class Wanted:
    """The right answer.

    Attributes:
        value: Of the declared kind: an array, a `Table`, an `ExpressionArray`, a letter, ...
        given: The earlier answers by name that it follows from: the reference's or the student's.
        allowed: How far each entry may be off; of numbers alone.
    """

    value: Any
    given: Mapping[str, Any]
    allowed: Allowed = NOT_ALLOWED


@dataclass(frozen=True)
class Comparison:
    """An answer beside the right one.

    Attributes:
        right: Which entries are right, in the shape in which the answer is shown.
        share: Share of the points, in [0, 1].
        findings: Sentences for the student on what was seen.
        reading: How the question was read, where the part's own check tells.
        settled: Whether the part's own check says the share, so that a name changes nothing.
    """

    right: Any
    share: float
    findings: tuple[str, ...] = ()
    reading: str = ""
    settled: bool = False

    @property
    def all_right(self) -> bool:
        """Whether nothing is wrong or missing."""
        return self.share == 1.0


@dataclass(frozen=True)
class Presentation:
    """The right matrix handed in another way, such as transposed or in degrees.

    Attributes:
        of: From the reference to what would be seen; None where it cannot be presented so.
        sentence: What the student is told.
        fault: What kind of mistake it is.
    """

    of: Callable[[Array], Array | None]
    sentence: str
    fault: Fault = "presentation"


@dataclass(frozen=True)
class Named:
    """What explains a wrong answer, all of it.

    Attributes:
        sentence: What the student is told.
        fault: What kind of mistake it is; None where such an answer earns nothing by itself.
        key: What is charged once though it is met again; the sentence, if empty.
        local: Whether the same sentence in another part is another mistake, as of one wrong entry.
        titles: The known mistakes of any arm that it may be (grader/diagnosis), if it is of those.
    """

    sentence: str
    fault: Fault | None = None
    key: str = ""
    local: bool = False
    titles: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Asked:
    """What a wrong answer is looked at with.

    Attributes:
        answer: The kind as the exercise declares it, such as `Numbers((6, 3), ...)`.
        v: The student's drawn numbers.
        wanted: The right answer.
        in_degrees: Returns the answer of somebody who takes every printed angle for degrees; None
            where there is none.
    """

    answer: Any
    v: Variant
    wanted: Wanted
    in_degrees: Callable[[], Any]


def _as_it_is(value: Any) -> Any:
    return value


def _no_sentence(*_: Any) -> str:
    return ""


def _everything_counts(*_: Any) -> Mask:
    return np.zeros((), dtype=bool)


def _no_arrays(*_: Any) -> Sequence[Beside]:
    return ()


def _no_blocks(_: Any) -> bool:
    return False


def _no_presentations(_: Any) -> Sequence[Presentation]:
    return ()


def _no_names(*_: Any) -> Sequence[Named]:
    return ()


def _never(*_: Any) -> bool:
    return False


Alone = Literal["in full", "not at all"]
"""What counts of an answer by itself."""


def _in_full(_: Any) -> Alone:
    return "in full"


def not_at_all(_: Any) -> Alone:
    """Of answers that may be right by chance."""
    return "not at all"


@dataclass(frozen=True)
class Marker:
    """A kind of answer as it is marked; all but the first three functions have defaults.

    `answer` is the kind as the exercise declares it, `v` the student's drawn numbers, `value` an
    answer that was read.
    """

    read: Callable[[Any, Raw, Variant], Any]
    """read(answer, raw, v): the value of the declared kind. Raises Unreadable where it is none."""

    compared: Callable[[Any, Variant, Wanted, Any], Mask | Comparison]
    """compared(answer, v, wanted, value): which entries are right.

    Points then follow from the entries; a Comparison says its share itself. Raises Unreadable where
    comparing would take too long.
    """

    handed_in: Callable[[Any, Any, Variant], Raw]
    """handed_in(answer, value, v): a value as a student would hand it in; `read` undoes it."""

    # What is shown to the student.

    shown: Callable[[Any], Any] = _as_it_is
    """shown(value): nested lists of numbers and text, in the shape of the right entries."""

    read_as: Callable[[Any, Raw, Any], str] = _no_sentence
    """read_as(answer, raw, value): how it was read, in a sentence, where that may surprise."""

    # Which entries carry points.

    trivial: Callable[[Any, Wanted, Variant], Mask] = _everything_counts
    """trivial(answer, wanted, v): entries that anybody would guess; they carry no points."""

    varies: bool = False
    """Whether entries that are the same for all students carry no points."""

    by_rows: bool = False
    """Whether a wrong entry that carries no points voids its row instead of its column."""

    checked: Callable[[Any, Variant, Wanted, Any, Any], Comparison] | None = None
    """checked(answer, v, wanted, value, right): what the `right` of a part's own check comes to.

    None where that is a mask of entries.
    """

    # What explains a wrong answer, the first that fits.

    arrays: Callable[[Asked, Any], Sequence[Beside]] = _no_arrays
    """arrays(asked, value): own, wanted and allowed numbers in which a Presentation would show.

    It has to agree with all of them; a kind without any is not looked at for presentations.
    """

    has_blocks: Callable[[Any], bool] = _no_blocks
    """has_blocks(answer): whether its linear and angular rows may be exchanged."""

    in_other_units: Callable[[Any], Sequence[Presentation]] = _no_presentations
    """in_other_units(answer): presentations in units that are not asked for."""

    found: Callable[[Asked, Any, Mask], Iterable[Named]] = _no_names
    """found(asked, value, right): what explains a wrong answer, from most to least telling."""

    alone: Callable[[Any], Alone] = _in_full
    """alone(answer): what counts of an answer where no number of the student's own was computed.

    All of it, or nothing, where it is right by chance.
    """

    priced: Callable[[Any, Any], bool] = _never
    """priced(answer, value): whether a named mistake leaves points: nobody guesses such a value."""


def is_trivial(numbers: Array, allowed: Allowed | None = None) -> Mask:
    """Entries that are -1, 0 or 1, within what is allowed of each, and no less than 1e-6."""
    away = np.min([np.abs(numbers - trivial) for trivial in TRIVIAL], axis=0)
    close = np.less_equal(away, SURELY, dtype=bool)
    if allowed is None:
        return close
    return np.logical_or(close, allowed.holds(away), dtype=bool)
