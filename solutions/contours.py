"""The zero curves of a scalar field in a rectangle, found on a grid and exact on its lines."""

from collections.abc import Callable
from typing import cast

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]
Lines = tuple[Values, ...]
ScalarField = Callable[[Values, Values], Values]

HALVINGS = 54  # of a grid's step, to the last bit
FLOOR = 1e-13  # of a field's median: it decides the sign of rounding noise


def trace(
    field: ScalarField, across: tuple[float, float], up: tuple[float, float], count: int = 361
) -> Lines:
    """The zero curves, each (m, 2), of a scalar field in a rectangle.

    It has to change its sign across them. `count` is the number of grid lines on each side.
    """
    x, y = _grid_lines(*across, count), _grid_lines(*up, count)
    with np.errstate(divide="ignore", invalid="ignore"):
        values = field(*np.meshgrid(x, y, indexing="ij"))
        # A zero along a whole grid line is rounding noise of either sign; this makes it one sign.
        shift = FLOOR * float(np.median(np.abs(values)))
        values = values + shift
        lines = _contours(values)
        if not lines:
            return ()

        def shifted(a: Values, b: Values) -> Values:
            return field(a, b) + shift

        points = _roots(shifted, x, y, values, np.concatenate(lines))

    ends = np.cumsum([len(line) for line in lines])
    low, high = np.array([across[0], up[0]]), np.array([across[1], up[1]])
    pieces = list[Values]()
    for line in np.split(points, ends[:-1]):
        pieces += _inside(line, low, high)
    return tuple(pieces)


def _grid_lines(low: float, high: float, count: int) -> Values:
    # One line outside on each side: a zero on the rim itself (q2 = pi) is then crossed, not
    # touched. The inner lines avoid round numbers, where curves like to meet.
    step = (high - low) / (count - 1)
    inner = low + step * (np.arange(1, count) - 0.382)
    return np.concatenate([[low - 0.4 * step, low], inner, [high, high + 0.4 * step]])


def _contours(values: Values) -> list[Values]:
    """Lines (m, 2) between the nodes of either sign, in numbers of grid lines along x and y.

    Their points are on the edges between nodes, in the middle third. A closed line repeats its
    first.
    """
    from contourpy import LineType, contour_generator

    # The sign keeps points off the nodes; the value decides which corners of a saddle are joined.
    heights = np.where(values >= 0, 1.0, -1.0) + values / np.abs(values).max()
    contours = contour_generator(z=heights.T, line_type=LineType.Separate)
    return cast("list[Values]", contours.lines(0.0))


def _roots(field: ScalarField, x: Values, y: Values, values: Values, places: Values) -> Values:
    """The roots (m, 2), by bisection, on the edges where `places` (m, 2) are; NaN for a pole."""
    first = np.floor(places + 1e-9).astype(int)  # an edge keeps to a grid line only to rounding
    last = np.ceil(places - 1e-9).astype(int)
    low = np.column_stack([x[first[:, 0]], y[first[:, 1]]])
    high = np.column_stack([x[last[:, 0]], y[last[:, 1]]])
    rising = values[tuple(last.T)] >= 0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        above = ((field(*middle.T) >= 0) == rising)[:, None]
        low = np.where(above, low, middle)
        high = np.where(above, middle, high)
    roots = (low + high) / 2

    # A pole changes sign too (tan), but its "root" is huge.
    size = np.abs(values)
    larger = np.maximum(size[tuple(first.T)], size[tuple(last.T)])
    true = np.abs(field(*roots.T)) <= larger
    return np.where(true[:, None], roots, np.nan)


def _inside(points: Values, low: Values, high: Values) -> list[Values]:
    """The pieces without NaN of a line in a rectangle, whose sides are grid lines with points."""
    slack = 1e-9 * (high - low)
    kept = ((points >= low - slack) & (points <= high + slack)).all(axis=1)
    cuts = np.flatnonzero(np.diff(kept)) + 1
    pieces = np.split(np.clip(points, low, high), cuts)
    inside = list[Values]()
    for piece, keep in zip(pieces, np.split(kept, cuts), strict=True):
        if keep[0] and len(piece) > 1:
            inside.append(piece)
    return inside
