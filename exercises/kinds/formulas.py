"""Formulas in the names of the sheet."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.expression_array import ExpressionArray, expression_array, sample
from ...solutions.table import JOINT
from .kind import Kind, ValueKindError, Variant, listed_rows, sized
from .paper import Paper, paper_of_shape

PICTURES = 3  # points at which formulas are recorded


@dataclass(frozen=True)
class Formulas(Kind):
    """Formulas of `shape` (), (n,) or (m, n) in `names`.

    Names that a variant lacks are unknown on its sheet. Joints are called q1 ... qn and need no
    number of their own. Its value is an `ExpressionArray`.
    """

    shape: tuple[int, ...]
    names: tuple[str, ...]

    @property
    def form(self) -> str:
        """As "6 x 3 formulas, as text or sympy"."""
        return f"{sized(self.shape, 'formula')}, as text or sympy"

    @property
    def self_check(self) -> tuple[str, Any]:
        """With the shape."""
        return "formulas", self.shape

    @property
    def array_shape(self) -> tuple[int, ...]:
        """Its own."""
        return self.shape

    @property
    def paper(self) -> Paper:
        """A box for every entry."""
        return paper_of_shape(self.shape, wide=True)

    def declared(self, value: Any, v: Variant) -> ExpressionArray:
        """An `ExpressionArray` of the shape, in names of the sheet."""
        array = expression_array(value, names_on_sheet(self.names, v))
        if array.shape != self.shape:
            raise ValueKindError(f"takes formulas of shape {self.shape}, got shape {array.shape}")
        return array

    def pictured(self, value: ExpressionArray, v: Variant) -> NDArray[np.float64]:
        """Values (3, *shape) at three fixed points."""
        numbers = value.at(sample(names_on_sheet(self.names, v), PICTURES))
        return np.broadcast_to(numbers, (PICTURES, *self.shape))

    def code(self, variable: str, value: ExpressionArray) -> str:
        """Text, a line for every row."""
        text: Any = value.text()
        if not self.shape:
            return f"{variable} = {text!r}"
        return f"{variable} = {listed_rows(text)}"

    def matlab(self, stacked: str) -> tuple[str, str]:
        """Text."""
        shape, whole = "a formula", "a symbolic one"
        if self.shape:
            shape, whole = sized(self.shape, "formula"), "a symbolic matrix"
        return "''", f"{shape} as text: '...', or char(...) of {whole}"


def names_on_sheet(names: Iterable[str], v: Variant) -> tuple[str, ...]:
    """Names that a student may use: joints, and parameters that this variant has."""
    return tuple(name for name in names if JOINT.fullmatch(name) or name in v)
