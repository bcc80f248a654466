"""Tables of the same arm: frames may be placed in many ways."""

from dataclasses import dataclass

import numpy as np

from ...exercises.answers import TableOf, Variant
from ...exercises.kinds.table import table_rows
from ...solutions.chain import Array, Chain, ChainError, from_modified, from_standard
from ...solutions.equivalence import Equivalence, equivalence
from ...solutions.table import Table


@dataclass(frozen=True, eq=False)
class Drawn:
    """The arm of the reference, and how far a table may be off it.

    Attributes:
        answer: What is asked.
        rows: The reference's numbers (n, 4) with all joints at zero.
        convention: That of the reference.
        chain: The arm.
    """

    answer: TableOf
    rows: Array
    convention: str
    chain: Chain

    @property
    def angle(self) -> float:
        """How far an angle may be off [rad]."""
        return 2 * 10.0**-self.answer.decimals

    @property
    def length(self) -> float:
        """How far a distance may be off [m]."""
        return 3 * 10.0**-self.answer.decimals

    def is_described(self, rows: Array, convention: str) -> bool:
        """Whether rows (n, 4) describe the arm, as far as the sheet gives its frames."""
        try:
            chain = chain_of(rows, self.answer.kinds, convention)
        except ChainError:
            return False
        found = equivalence(
            self.chain, chain, self.answer.given, angle=self.angle, length=self.length
        )
        return isinstance(found, Equivalence)


def drawn_arm(answer: TableOf, v: Variant, reference: Table) -> Drawn:
    """The arm that the reference table describes."""
    rows = table_rows(reference, v)
    chain = chain_of(rows, answer.kinds, reference.convention)
    return Drawn(answer, rows, reference.convention, chain)


def describes_same_arm(answer: TableOf, v: Variant, reference: Table, own: Table) -> bool:
    """Whether a table describes the arm of the reference, as far as the sheet gives its frames."""
    if own.kinds != answer.kinds:
        return False
    return drawn_arm(answer, v, reference).is_described(table_rows(own, v), own.convention)


def chain_of(rows: Array, kinds: str, convention: str) -> Chain:
    """The chain of a table's numbers. Raises ChainError."""
    build = from_modified if convention == "modified" else from_standard
    return build(rows, kinds)


def between_axes(rows: Array, convention: str) -> Array:
    """Twists and distances (n - 1, 2) between neighbouring axes: |cos(alpha)| and |a|.

    No placing of frames changes them, but that a slide has no place.
    """
    inner = rows[:-1] if convention == "standard" else rows[1:]
    return np.abs(np.stack([np.cos(inner[:, 3]), inner[:, 2]], axis=1))
