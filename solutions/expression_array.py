"""Arrays of formulas: symbolic vectors and matrices, and when two of them are the same."""

import hashlib
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib import import_module
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import KinegradeError
from .expression import Expression, parse

ANGLE = re.compile(r"(q|theta|alpha|beta|gamma|phi|psi)[0-9]*")
POINTS = 8  # where two formulas are compared, twice
SAME = 1e-9  # of a value's size: what two spellings of one formula may differ by
ANGLES = (-2.6, 5.2)  # where samples of angles begin, and how far they reach [rad]
OTHERS = (0.4, 1.2)  # the same for everything else: positive, as lengths are


class ExpressionArrayError(KinegradeError):
    """Nested formulas that are no array."""


@dataclass(frozen=True, eq=False)
class ExpressionArray:
    """Formulas of shape (), (n,) or (m, n); `entries` are all of them, row after row."""

    entries: tuple[Expression, ...]
    shape: tuple[int, ...]

    @cached_property
    def names(self) -> frozenset[str]:
        """Names that occur in any entry."""
        return frozenset[str]().union(*(entry.names for entry in self.entries))

    def at(self, values: Mapping[str, ArrayLike]) -> NDArray[np.float64]:
        """Numbers (..., *shape) where each name has its value; ExpressionError if one has none."""
        numbers = [np.asarray(entry.at(values)) for entry in self.entries]
        stacked = np.stack(np.broadcast_arrays(*numbers), axis=-1)
        return stacked.reshape((*stacked.shape[:-1], *self.shape))

    def sympy(self) -> Any:
        """The sympy expression of shape (), else a Matrix; a vector is a column."""
        sympy: Any = import_module("sympy")
        found = [entry.sympy() for entry in self.entries]
        if not self.shape:
            return found[0]
        return sympy.Matrix(self.shape[0], len(found) // self.shape[0], found)

    def text(self) -> Any:
        """Nested lists of strings that parse back; a single string for shape ()."""
        found: Any = [str(entry) for entry in self.entries]
        if not self.shape:
            return found[0]
        if len(self.shape) == 1:
            return found
        width = self.shape[1]
        return [found[start : start + width] for start in range(0, len(found), width)]


def expression_array(nested: Any, names: Iterable[str]) -> ExpressionArray:
    """Array of formulas in `names`, of what may be nested.

    Entries are text, numbers or `Expression`s; a sympy expression or Matrix is taken, too.

    Raises:
        ExpressionError: a text is not a formula in these names.
        ExpressionArrayError: the nesting is no array.
    """
    if isinstance(nested, ExpressionArray):
        return nested
    if hasattr(nested, "tolist"):
        nested = nested.tolist()

    known = tuple(names)
    shape = _shape(nested)
    flat: list[Any] = [nested]
    for _ in shape:
        flat = list(chain.from_iterable(flat))
    return ExpressionArray(tuple(_formula(entry, known) for entry in flat), shape)


def _formula(entry: Any, names: tuple[str, ...]) -> Expression:
    if isinstance(entry, Expression):
        return entry
    return parse(str(entry), names)


def _shape(nested: Any, depth: int = 2) -> tuple[int, ...]:
    if not isinstance(nested, list | tuple):
        return ()
    rows: list[Any] = [*nested]  # pyright: ignore[reportUnknownArgumentType]
    if not rows or depth == 0:
        raise ExpressionArrayError(f"formulas take a vector or a matrix, got {str(rows)[:60]}")

    shapes = {_shape(row, depth - 1) for row in rows}
    if len(shapes) > 1:
        raise ExpressionArrayError(
            "formulas take rows of one length, got rows of different lengths"
        )
    return (len(rows), *shapes.pop())


def same_formulas(
    a: ExpressionArray, b: ExpressionArray, names: Sequence[str]
) -> NDArray[np.bool_]:
    """Which entries of two arrays of one shape agree at sixteen points, to 1e-9 of their size.

    The first eight are the same for everybody; the others follow from what was typed, so that no
    formula can be made to agree at just these. Points where the second is infinite or has no value
    are left out; where the first alone has none, they differ.
    """
    known = tuple(names)
    same = _agree(sampled(a, known), sampled(b, known))
    if not same.any():
        return same

    typed = hashlib.sha256("\n".join(map(str, a.entries)).encode()).digest()
    start = int.from_bytes(typed[:6], "big") / 2**48
    values = sample(names, POINTS, start)
    return same & _agree(_at_points(a, values), _at_points(b, values))


def _agree(ours: NDArray[np.float64], theirs: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether entries (...) agree at all points (points, ...) where they have a value."""
    defined = np.isfinite(theirs)
    with np.errstate(invalid="ignore"):
        close = np.abs(ours - theirs) <= SAME * np.maximum(1.0, np.abs(theirs))
    return np.asarray((close | ~defined).all(axis=0) & defined.any(axis=0))


@lru_cache(maxsize=512)
def sampled(array: ExpressionArray, names: tuple[str, ...]) -> NDArray[np.float64]:
    """Numbers (8, *shape) of an array at the points where formulas are compared.

    They are kept, since references come again.
    """
    return _at_points(array, sample(names, POINTS))


def _at_points(
    array: ExpressionArray, values: Mapping[str, NDArray[np.float64]]
) -> NDArray[np.float64]:
    """Numbers (8, *shape) at points; constants are the same at all of them."""
    return np.broadcast_to(array.at(values), (POINTS, *array.shape))


def sample(names: Sequence[str], count: int, start: float = 0.0) -> dict[str, NDArray[np.float64]]:
    """Values (count,) for every name, angles in (-2.6, 2.6), all others in (0.4, 1.6).

    The multiples of square roots of primes are spread like random numbers and are the same
    everywhere, always; `start` moves them on.
    """
    steps = np.arange(1, count + 1)
    values: dict[str, NDArray[np.float64]] = {}
    for name, prime in zip(sorted(names), _primes(), strict=False):
        fraction = np.asarray(((steps + start) * math.sqrt(prime)) % 1.0, dtype=np.float64)
        least, width = OTHERS
        if ANGLE.fullmatch(name):
            least, width = ANGLES
        values[name] = least + width * fraction
    return values


def _primes() -> Iterator[int]:
    """The primes in order: more than there are names in a formula."""
    for number in range(2, 10_000):
        if all(number % divisor for divisor in range(2, math.isqrt(number) + 1)):
            yield number
