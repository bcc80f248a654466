"""A list of configurations that a part's own check judges."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from .kind import ArrayKind, ValueKindError, Variant, finite
from .paper import Paper, counted

PAPER_ROWS = 8  # for postures of an arm with a spherical wrist there are no more


@dataclass(frozen=True)
class Configurations(ArrayKind):
    """A list of up to `most` configurations of `joints` numbers each, judged by the part's `check`.

    Its value is an array (m, joints); with one joint a plain list is read too. How many rows there
    are is not said on the sheet. `in_order` are rows that follow one another, such as the iterates
    of a method; without, a sheet says that a wrong one costs a right one.
    """

    joints: int
    units: str | Sequence[Any] = "rad"
    decimals: int = 4
    most: int = 32
    in_order: bool = False

    @property
    def form(self) -> str:
        """A list of numbers or of rows."""
        if self.joints == 1:
            return "a list of numbers"
        return f"a list of rows of {self.joints} numbers"

    @property
    def self_check(self) -> tuple[str, Any]:
        """With the numbers of a row."""
        return "list", self.joints

    @property
    def asked_beside(self) -> str:
        """The decimals of rows in order, or what a wrong one costs."""
        if self.in_order:
            return f"Give {self.decimals} decimals, row after row in their order."
        return "A wrong one costs a right one."

    @property
    def array_shape(self) -> tuple[int, ...]:
        """Of two rows."""
        return (2, self.joints)

    @property
    def paper(self) -> Paper:
        """A row for every configuration, as many on every sheet."""
        return Paper(counted(min(self.most, PAPER_ROWS)), counted(self.joints))

    def declared(self, value: Any, v: Variant) -> NDArray[np.float64]:
        """Finite rows (m, joints)."""
        rows = np.asarray(value, dtype=float).reshape(-1, self.joints)
        if not 1 <= len(rows) <= self.most:
            raise ValueKindError(f"takes 1 to {self.most} configurations, got {len(rows)}")
        return finite(rows, rows.shape)

    def with_decimals(self, decimals: int) -> Self:
        """The same with other decimals asked."""
        return replace(self, decimals=decimals)

    def matlab(self, stacked: str) -> tuple[str, str]:
        """A matrix."""
        numbers = "1 number"
        if self.joints != 1:
            numbers = f"{self.joints} numbers"
        each = "step, in their order" if self.in_order else "configuration"
        return "[]", f"a row of {numbers} for every {each}; {self.decimals} decimals"
