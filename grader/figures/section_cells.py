"""How many cells a section is drawn with, and how those are evened that samples filled."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...solutions.workspace import Section, section
from .vectors import Array

if TYPE_CHECKING:
    from ...solutions.robots import Robot
    from ...solutions.singularity import Parameters

Empty = NDArray[np.bool_]
CELLS = 320  # along a section that two joints span
FINER = 480  # asked for where more span it: a quarter of them are there
REACH = 2  # cells to each side that vouch for one
ROUNDS = 3  # of averages over neighbours


def section_of(robot: "Robot", parameters: "Parameters") -> Section:
    """The section of a robot's workspace with as many cells as a figure can do with."""
    cut = section(robot, parameters, cells=CELLS)
    if not _sampled(cut):
        return cut
    return section(robot, parameters, cells=FINER)


def shown_cells(cut: Section) -> Array:
    """The cells of a section as they are drawn: those of two joints are exact, others evened."""
    if _sampled(cut):
        return evened(cut.cells)
    return cut.cells


def _sampled(cut: Section) -> bool:
    """Whether three joints or more span a section, which has fewer cells then."""
    return max(cut.cells.shape) < CELLS / 2


def evened(cells: Array) -> Array:
    """Cells (ny, nx) without speckles, NaN where the tool cannot get.

    Each holds the best that samples found in it, hence never too much: a cell that is darker than
    what lies all round it was sampled badly. It is lifted to its neighbours, then all are averaged.
    Cells alone on a side of the rim are emptied or filled.
    """
    empty: Empty = np.isnan(cells)
    lifted = _over(np.where(empty, -np.inf, cells), np.maximum, -np.inf)
    for _ in range(ROUNDS):
        empty = _settled(empty)
    lowered = _over(np.where(empty, np.inf, lifted), np.minimum, np.inf)
    for _ in range(ROUNDS):
        lowered = _averaged(lowered, empty)
    return np.where(empty, np.nan, lowered)


def _settled(empty: Empty) -> Empty:
    """Which cells are empty once each follows its neighbours.

    A cell of a straight rim has five neighbours on its own side, one that sticks out has three.
    """
    padded = np.pad(empty.astype(np.int64), 1, mode="edge")
    rows, columns = empty.shape
    around = np.zeros_like(empty, dtype=np.int64)
    for down in range(3):
        for across in range(3):
            around += padded[down : down + rows, across : across + columns]
    beside = around - empty
    return (beside >= 5) | (empty & (beside == 4))


def _over(cells: Array, choose: Callable[[Array, Array], Array], beyond: float) -> Array:
    """The largest or smallest of each cell and its neighbours up to REACH away."""
    found = cells
    for axis in (0, 1):
        margins = [(0, 0), (0, 0)]
        margins[axis] = (REACH, REACH)
        padded = np.pad(found, margins, constant_values=beyond)
        count = cells.shape[axis]
        for shift in range(2 * REACH + 1):
            found = choose(found, _slice(padded, shift, shift + count, axis))
    return found


def _averaged(cells: Array, empty: Empty) -> Array:
    """Each cell's mean with those beside it that are not empty, itself twice."""
    weights = np.where(empty, 0.0, 1.0)
    sums = np.where(empty, 0.0, cells)
    for axis in (0, 1):
        weights = _blurred(weights, axis)
        sums = _blurred(sums, axis)
    return np.divide(sums, weights, out=np.zeros_like(sums), where=weights > 0)


def _blurred(cells: Array, axis: int) -> Array:
    margins = [(0, 0), (0, 0)]
    margins[axis] = (1, 1)
    padded = np.pad(cells, margins)
    count = cells.shape[axis]
    return _slice(padded, 0, count, axis) + 2 * cells + _slice(padded, 2, count + 2, axis)


def _slice(cells: Array, first: int, last: int, axis: int) -> Array:
    """Rows, or with axis 1 columns, from `first` up to `last`."""
    return cells[first:last] if axis == 0 else cells[:, first:last]
