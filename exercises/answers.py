"""The kinds of answers, as data: what a part asks for and in which form."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Variant = Mapping[str, Any]
"""The drawn numbers of one student, as they come back from JSON."""
Calls = Mapping[str, Sequence[tuple[Any, ...]]]
"""Arguments of calls of a student's function, by the name of the group they are reported under."""
LETTERS = "abcdefghijklmnopqrstuvwxyz"


@dataclass(frozen=True)
class Numbers:
    """A real array. `units` are nested strings that broadcast to `shape`; `decimals` are asked of the student.

    Its value is an array of that shape; of shape () it is one number.
    """

    shape: tuple[int, ...]
    units: str | Sequence[Any] = "1"
    decimals: int = 4

    def unit_of_entries(self) -> NDArray[np.str_]:
        """Units of shape `shape`: "m", "m/rad", "rad/s", "1" ..."""
        return np.broadcast_to(np.array(self.units), self.shape)

    @property
    def has_blocks(self) -> bool:
        """Whether there are six rows, three linear and three angular ones; six rates or torques [N m] are of joints."""
        units = {str(unit) for unit in self.unit_of_entries().ravel()}
        return self.shape[:1] == (6,) and (len(units) > 1 or units == {"1"})


@dataclass(frozen=True)
class TableOf:
    """A Denavit-Hartenberg table with one row of theta, d, a, alpha per joint of `kinds`, such as "RRP".

    Cells are expressions in `names` and q1 ... qn, or numbers; names that a variant lacks are unknown on its sheet.
    Its value is a `Table`.
    """

    names: tuple[str, ...]
    kinds: str
    convention: Literal["standard", "modified"] = "standard"
    decimals: int = 3


@dataclass(frozen=True)
class Formulas:
    """Formulas of `shape` (), (n,) or (m, n) in `names`; names that a variant lacks are unknown on its sheet.

    Joints are called q1 ... qn and need no number of their own. Its value is an `ExpressionArray`.
    """

    shape: tuple[int, ...]
    names: tuple[str, ...]


@dataclass(frozen=True)
class Choice:
    """One of several `options`, lettered a, b, c ... in their order. Its value is the letter."""

    options: tuple[str, ...]

    @property
    def letters(self) -> str:
        """Valid answers."""
        return LETTERS[: len(self.options)]


@dataclass(frozen=True)
class Conditions:
    """Equations in `names`, such as sin(q2) = 0, all solutions of which are asked.

    `domain(v)` gives the range of every joint within which solutions count. Its value is a tuple of `Condition`s: an
    `Expression` that is zero where it holds, or `AllOf` several that hold at once. `solve` may return their texts,
    such as "sin(q2)" or "sin(q2) = 0 and sin(q3) = 0", and tuples of texts or Expressions that hold at once.
    """

    names: tuple[str, ...]
    domain: Callable[[Variant], Mapping[str, tuple[float, float]]]


@dataclass(frozen=True)
class Configurations:
    """A list of up to `most` configurations of `joints` numbers each, judged by the part's `check`.

    Its value is an array (m, joints); with one joint a plain list is read too. How many rows there are is not said on
    the sheet. `in_order` are rows that follow one another, such as the iterates of a method; without, a sheet says
    that a wrong one costs a right one.
    """

    joints: int
    units: str | Sequence[Any] = "rad"
    decimals: int = 4
    most: int = 32
    in_order: bool = False


@dataclass(frozen=True)
class Function:
    """A Python function, called on inputs that the student has not seen.

    `signature` is its head without the name of the variable, such as "(q)". `inputs(v)` are the arguments by group: a
    tuple for every call, of numbers, text, and lists and dicts of them. Numbers in equal rows arrive as float arrays,
    inside dicts and lists too; other lists stay lists. The reference, which is a function too, gets the same.

    An answer agrees within `tolerance` of the reference; a part's own `check` gets `Results` and judges instead. A
    group of calls is one item of the feedback and earns its share when all of it is right. Where all its results are
    alike, such as zeros, it does so only beside a right result of another kind: a constant function earns nothing.
    `published(v)` are the calls whose results a student without Python hands in.
    """

    signature: str
    inputs: Callable[[Variant], Calls]
    tolerance: float = 1e-6
    published: Callable[[Variant], Calls] | None = None


@dataclass(frozen=True)
class Manual:
    """A sketch, derivation or argument, marked by hand: points and what earns them, line by line.

    With `on_paper`, nothing is expected in the file. Its value is text: the marker's key as reference.
    """

    rubric: tuple[tuple[float, str], ...]
    on_paper: bool = False


Answer = Numbers | TableOf | Formulas | Choice | Conditions | Configurations | Function | Manual
