"""Numbers: a real array with a unit for every entry."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from .kind import ArrayKind, Variant, finite, sized
from .paper import Paper, paper_of_shape


@dataclass(frozen=True)
class Numbers(ArrayKind):
    """A real array.

    `units` are nested strings that broadcast to `shape`; `decimals` are asked of the student. Its
    value is an array of that shape; of shape () it is one number.
    """

    shape: tuple[int, ...]
    units: str | Sequence[Any] = "1"
    decimals: int = 4

    def unit_of_entries(self) -> NDArray[np.str_]:
        """Units of shape `shape`: "m", "m/rad", "rad/s", "1" ..."""
        return np.broadcast_to(np.array(self.units), self.shape)

    @property
    def has_blocks(self) -> bool:
        """Whether there are six rows, three linear and three angular ones."""
        if self.shape[:1] != (6,):
            return False
        units = {str(unit) for unit in self.unit_of_entries().ravel()}
        # six entries of one unit, such as rates or torques [N m], belong to six joints
        return len(units) > 1 or units == {"1"}

    @property
    def form(self) -> str:
        """As "6 x 3 numbers"."""
        return sized(self.shape, "number")

    @property
    def self_check(self) -> tuple[str, Any]:
        """With the shape."""
        return "numbers", self.shape

    @property
    def asked_beside(self) -> str:
        """The decimals."""
        if not self.decimals:
            return ""
        return f"Give {self.decimals} decimals."

    @property
    def array_shape(self) -> tuple[int, ...]:
        """Its own."""
        return self.shape

    @property
    def paper(self) -> Paper:
        """A box for every entry."""
        return paper_of_shape(self.shape, wide=False)

    def declared(self, value: Any, v: Variant) -> NDArray[np.float64]:
        """A finite array of the shape."""
        return finite(value, self.shape)

    def with_decimals(self, decimals: int) -> Self:
        """The same with other decimals asked."""
        return replace(self, decimals=decimals)

    def matlab(self, stacked: str) -> tuple[str, str]:
        """A matrix; several matrices are a cell array."""
        decimals = f"{self.decimals} decimals"
        if len(self.shape) > 2:
            count, *inner = self.shape
            size = " x ".join(map(str, inner))
            matrices = f"{count} matrices of {size} numbers: {{first, second, ...}}"
            return "{}", f"{matrices}; {decimals}"
        rows = f", {stacked}" if self.has_blocks else ""
        return "[]", f"{self.form}{rows}; {decimals}"
