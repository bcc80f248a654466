"""Arrays of formulas: symbolic vectors and matrices, and when two of them are the same."""

import hashlib
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import KinegradeError
from .expression import Expression, parse

ANGLE = re.compile(r"(q|theta|alpha|beta|gamma|phi|psi)[0-9]*")
POINTS = 8
SAME = 1e-9


class ExpressionArrayError(KinegradeError):
    """Nested formulas that are no array."""


@dataclass(frozen=True, eq=False)
class ExpressionArray:
    """Formulas of shape (), (n,) or (m, n); `entries` are all of them, row after row."""

    entries: tuple[Expression, ...]
    shape: tuple[int, ...]

    @property
    def names(self) -> frozenset[str]:
        """Names that occur in any entry."""
        return frozenset(name for entry in self.entries for name in entry.names)

    def at(self, values: Mapping[str, ArrayLike]) -> NDArray[np.float64]:
        """Numbers (..., *shape) where each name has its value. Raises ExpressionError if one has none."""
        numbers = np.broadcast_arrays(*(np.asarray(entry.at(values)) for entry in self.entries))
        stacked = np.stack(numbers, axis=-1)
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
        if len(self.shape) == 2:
            width = self.shape[1]
            return [found[start : start + width] for start in range(0, len(found), width)]
        return found if self.shape else found[0]


def expression_array(nested: Any, names: Iterable[str]) -> ExpressionArray:
    """Array of formulas from nested text, numbers, `Expression`s, or a sympy expression or Matrix, in `names`.

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
        flat = [entry for row in flat for entry in row]
    return ExpressionArray(
        tuple(e if isinstance(e, Expression) else parse(str(e), known) for e in flat), shape
    )


def same_formulas(
    a: ExpressionArray, b: ExpressionArray, names: Sequence[str]
) -> NDArray[np.bool_]:
    """Which entries of two arrays of one shape agree at sixteen points, to 1e-9 of their size.

    The first eight are the same for everybody; the others follow from what was typed, so that no formula can be made
    to agree at just these. Points where the second is infinite or has no value are left out; where the first alone has
    none, they differ.
    """
    same = _agree(*(sampled(x, tuple(names)) for x in (a, b)))
    if not same.any():
        return same
    typed = hashlib.sha256("\n".join(map(str, a.entries)).encode()).digest()
    values = sample(names, POINTS, int.from_bytes(typed[:6], "big") / 2**48)
    shape = (POINTS, *b.shape)
    return same & _agree(*(np.broadcast_to(x.at(values), shape) for x in (a, b)))


def _agree(ours: NDArray[np.float64], theirs: NDArray[np.float64]) -> NDArray[np.bool_]:
    defined = np.isfinite(theirs)
    with np.errstate(invalid="ignore"):
        close = np.abs(ours - theirs) <= SAME * np.maximum(1.0, np.abs(theirs))
    return np.asarray((close | ~defined).all(axis=0) & defined.any(axis=0))


@lru_cache(maxsize=512)
def sampled(array: ExpressionArray, names: tuple[str, ...]) -> NDArray[np.float64]:
    """Numbers (8, *shape) of an array at the points where formulas are compared; kept, since references come again."""
    return np.broadcast_to(array.at(sample(names, POINTS)), (POINTS, *array.shape))


def sample(names: Sequence[str], count: int, start: float = 0.0) -> dict[str, NDArray[np.float64]]:
    """Values (count,) for every name, angles in (-2.6, 2.6), all others in (0.4, 1.6).

    The multiples of square roots of primes are spread like random numbers and are the same everywhere, always;
    `start` moves them on.
    """
    steps = np.arange(1, count + 1)
    roots = (
        math.sqrt(p) for p in range(2, 10_000) if all(p % d for d in range(2, math.isqrt(p) + 1))
    )
    values: dict[str, NDArray[np.float64]] = {}
    for name, root in zip(sorted(names), roots, strict=False):
        fraction = np.asarray(((steps + start) * root) % 1.0, dtype=np.float64)
        values[name] = 5.2 * fraction - 2.6 if ANGLE.fullmatch(name) else 0.4 + 1.2 * fraction
    return values


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
