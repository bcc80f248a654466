"""A Denavit-Hartenberg table."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, Self

import numpy as np
from numpy.typing import NDArray

from ...solutions.equivalence import ALL_GIVEN, Given
from ...solutions.expression_array import sample
from ...solutions.table import Table
from .kind import Kind, ValueKindError, Variant, listed_rows
from .paper import Paper, counted

COLUMNS = (r"\theta_i", "d_i", "a_i", r"\alpha_i")
CONVENTIONS = ("standard", "modified")
FREE = {
    "base": "the base frame",
    "tool": "the last frame",
    "senses": "the positive senses of the joints",
    "zero": "the zeros of the joint variables",
}
"""What a student may choose where the sheet does not give it."""
DECLARED = "Say beside it whether your table is a standard or a modified one."
MATLAB_EXAMPLE = "{'q1 + pi', 0.25, 'd1', 'pi/3'; ...}"


@dataclass(frozen=True)
class TableOf(Kind):
    """A Denavit-Hartenberg table: a row of theta, d, a, alpha per joint of `kinds`, such as "RRP".

    Cells are expressions in `names` and q1 ... qn, or numbers; names that a variant lacks are
    unknown on its sheet. Its value is a `Table`. A table that describes the same arm with frames
    placed otherwise is right, as far as `given` leaves that open: the sheet says which of base
    frame, tool frame, positive senses and home pose it gives. With the convention "either", the
    student says beside the table which it has.
    """

    names: tuple[str, ...]
    kinds: str
    convention: Literal["standard", "modified", "either"] = "standard"
    decimals: int = 3
    given: Given = ALL_GIVEN

    @property
    def form(self) -> str:
        """The rows and their columns."""
        return f"{len(self.kinds)} rows [theta, d, a, alpha]"

    @property
    def self_check(self) -> tuple[str, Any]:
        """With the number of rows."""
        return "table", len(self.kinds)

    @property
    def asked_beside(self) -> str:
        """What the student may choose, and what is declared."""
        free = [words for name, words in FREE.items() if not getattr(self.given, name)]
        sentences: list[str] = []
        if free:
            sentences.append(f"You may choose {' and '.join(free)} yourself.")
        if self.convention == "either":
            sentences.append(DECLARED)
        return " ".join(sentences)

    @property
    def declared_beside(self) -> Mapping[str, tuple[str, ...]]:
        """The convention, where it is the student's choice."""
        return {"convention": CONVENTIONS} if self.convention == "either" else {}

    @property
    def array_shape(self) -> tuple[int, ...]:
        """A row for every joint."""
        return (len(self.kinds), 4)

    @property
    def paper(self) -> Paper:
        """A row for every joint."""
        return Paper(counted(len(self.kinds)), COLUMNS)

    def with_decimals(self, decimals: int) -> Self:
        """The same with other decimals asked."""
        return replace(self, decimals=decimals)

    def declared(self, value: Any, v: Variant) -> Table:
        """A `Table`."""
        if not isinstance(value, Table):
            raise ValueKindError(f"takes a Table, got {type(value).__name__}")
        return value

    def pictured(self, value: Table, v: Variant) -> NDArray[np.float64]:
        """The cells at the variant's q, or at fixed joint values where none is drawn."""
        return table_numbers(value, v, posture(value.joints, v))

    def code(self, variable: str, value: Table) -> str:
        """Rows of text, and the convention where it is declared."""
        rows = f"{variable} = {listed_rows(table_text(value))}"
        if self.convention == "either":
            return f"{variable}_convention = {value.convention!r}\n{rows}"
        return rows

    def matlab(self, stacked: str) -> tuple[str, str]:
        """A cell array of text and numbers."""
        return "{}", f"{len(self.kinds)} rows theta, d, a, alpha, such as {MATLAB_EXAMPLE}"


def table_text(table: Table) -> list[list[str]]:
    """The cells of a table as text that is read back."""
    return [list(map(str, row)) for row in table.rows]


def table_numbers(table: Table, v: Variant, q: Any) -> NDArray[np.float64]:
    """Cells (..., n, 4) of a table with the variant's lengths at q (..., n)."""
    joints = np.asarray(q, dtype=float)
    values: dict[str, Any] = {name: x for name, x in v.items() if isinstance(x, int | float)}
    for i, name in enumerate(table.joints):
        values[name] = joints[..., i]
    return table.numbers(values)


def table_rows(table: Table, v: Variant) -> NDArray[np.float64]:
    """Cells (n, 4) of a table with the variant's lengths and all joints at zero.

    Chains are built of these.
    """
    return table_numbers(table, v, np.zeros(len(table.joints)))


def posture(joints: Sequence[str], v: Variant) -> NDArray[np.float64]:
    """The variant's q (n,); where none is drawn, values that are the same for everybody."""
    if "q" in v:
        return np.asarray(v["q"], dtype=float)
    values = sample(joints, 1)
    return np.array([values[joint][0] for joint in joints])
