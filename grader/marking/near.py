"""Rows of numbers that are close to a row in every entry, found without looking at all of them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray


class Near:
    """Rows of the same length, sorted by one number that close rows have close.

    That number is a weighted mean of a row's entries, which differs by no more than they do.
    """

    def __init__(self, rows: NDArray[np.float64], within: float) -> None:
        """Takes rows (n, k), and how far apart the entries of close rows may be."""
        self._rows = rows
        self._within = within
        columns = np.linspace(1.0, 2.0, rows.shape[1])  # the same numbers elsewhere weigh more
        self._weights = np.asarray(columns / np.sum(columns), dtype=np.float64)
        means = np.asarray(rows @ self._weights, dtype=np.float64)
        self._order = np.argsort(means, kind="stable")
        self._means = means[self._order]

    def to(self, row: NDArray[np.float64]) -> Sequence[int]:
        """Places of the rows that are close to a row, in their order."""
        mean = float(row @ self._weights)
        rounding = 1e-12 * float(np.abs(row).max())
        margin = self._within + rounding
        first, last = np.searchsorted(self._means, [mean - margin, mean + margin])
        candidates = self._order[first:last]
        with np.errstate(all="ignore"):  # some hand in numbers at the end of all floats
            close = (np.abs(self._rows[candidates] - row) <= self._within).all(axis=1)
        return np.sort(candidates[close]).tolist()
