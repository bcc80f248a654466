"""How far each entry of numbers may be off: bounds that are at hand, and what lies between them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Allowed:
    """The allowed absolute error of every entry, which is computed where the bounds leave it open.

    A right answer is off by less than `least`, and most wrong ones by more than `most`; what lies
    between them takes the work of `computed`.

    Attributes:
        least: What is allowed in any case.
        most: What is never exceeded.
        computed: Returns what is allowed, between the two.
    """

    least: Array
    most: Array
    computed: Callable[[], Array]

    @cached_property
    def exact(self) -> Array:
        """What is allowed, computed once."""
        return self.computed()

    def holds(self, off: Array) -> Mask:
        """Which of some errors (..., *shape) are allowed; NaN is not."""
        small = np.less_equal(off, self.least, dtype=bool)
        small_or_open = np.less_equal(off, self.most, dtype=bool)
        if np.array_equal(small, small_or_open):
            return small
        return np.less_equal(off, self.exact, dtype=bool)

    def holds_everywhere(self, off: Array) -> bool:
        """Whether all of them are allowed."""
        if not np.less_equal(off, self.most, dtype=bool).all():
            return False
        return bool(self.holds(off).all())


def exactly(allowed: Array) -> Allowed:
    """What is known from the start."""
    return Allowed(allowed, allowed, lambda: allowed)


NOT_ALLOWED = exactly(np.zeros(0))
"""Of any other kind than numbers."""
