"""The cells of a section that the tool reaches, each with the largest sigma_min found in it."""

from itertools import product

import numpy as np
from numpy.typing import NDArray

from ..singularity import RegionalArm, Values, sigma_min, task_block
from ..spread import spread
from .approach import approached, in_axis_frame, projected

Extent = tuple[float, float, float, float]  # left, right, bottom, top [m]

SAMPLES = 40_000
NEIGHBOURS = [way for way in product((-1, 0, 1), repeat=2) if way != (0, 0)]


def filled(part: RegionalArm, axes: tuple[str, str], cells: int) -> tuple[Values, Extent]:
    """Cells of a section that any number of joints span, `cells` of them along its longer side.

    They come from samples, then from postures for the empty cells beside those that are reached.
    """
    q = spread(part.limits, SAMPLES)
    points = projected(in_axis_frame(part.chain, q), axes)
    sigma = sigma_min(task_block(part, q))
    # Samples of many joints end short of the rim: there is room around them.
    image, extent = raster(points, sigma, cells, margin=cells // 8)
    size = (extent[1] - extent[0]) / image.shape[1]
    corner = np.array([extent[0], extent[2]])

    posture = np.full((*image.shape, part.chain.n), np.nan)
    column, row = ((points - corner) / size).astype(int).T
    posture[row, column] = q
    every_joint = tuple(range(part.chain.n))
    fresh = ~np.isnan(image)
    while fresh.any():
        empty, beside = _empty_beside(image, fresh)
        centres = (empty[:, ::-1] + 0.5) * size + corner
        at, gap = approached(part, every_joint, axes, posture[tuple(beside.T)], centres)
        found = (np.abs(gap) < 0.5 * size).all(axis=1)
        reached = tuple(empty[found].T)
        posture[reached] = at[found]
        image[reached] = sigma_min(task_block(part, at[found]))
        fresh = np.zeros_like(fresh)
        fresh[reached] = True
    return _cropped(image, corner, size)


def raster(points: Values, sigma: Values, cells: int, margin: int = 1) -> tuple[Values, Extent]:
    """The largest sigma (...) of the points (..., 2) in each cell, and the extent of all cells.

    Cells without a point are NaN; there are `margin` of them around.
    """
    flat = points.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    smallest = 1e-9 * float(np.abs(flat).max())
    side = max(float((high - low).max()), smallest)
    if side == 0.0:  # the tool stands still at the origin
        side = 1.0
    size = side / cells

    shape = np.ceil((high - low) / size).astype(int) + 1 + 2 * margin
    origin = (low + high - shape * size) / 2
    column, row = ((flat - origin) / size).astype(int).T
    image = np.full(shape[0] * shape[1], -np.inf)
    np.maximum.at(image, row * shape[0] + column, sigma.ravel())
    image[image == -np.inf] = np.nan
    left, bottom = origin.tolist()
    right, top = (origin + shape * size).tolist()
    return image.reshape(shape[1], shape[0]), (left, right, bottom, top)


def _cropped(image: Values, corner: Values, size: float) -> tuple[Values, Extent]:
    """The reached cells with one empty cell around, and their extent."""
    reached = ~np.isnan(image)
    rows = np.flatnonzero(reached.any(axis=1))
    columns = np.flatnonzero(reached.any(axis=0))
    left, bottom = max(columns[0] - 1, 0), max(rows[0] - 1, 0)
    kept = image[bottom : rows[-1] + 2, left : columns[-1] + 2]

    x, y = (corner + np.array([left, bottom]) * size).tolist()
    height, width = kept.shape
    return kept, (x, x + width * size, y, y + height * size)


def _empty_beside(
    image: Values, fresh: NDArray[np.bool_]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns (m, 2) of empty cells, and of the fresh cells that each of them touches."""
    cells = np.argwhere(fresh)
    beside = np.repeat(cells, len(NEIGHBOURS), axis=0)
    empty = (cells[:, None] + np.array(NEIGHBOURS)).reshape(-1, 2)
    inside = ((empty >= 0) & (empty < image.shape)).all(axis=1)
    empty, beside = empty[inside], beside[inside]
    unreached = np.isnan(image[tuple(empty.T)])
    return empty[unreached], beside[unreached]
