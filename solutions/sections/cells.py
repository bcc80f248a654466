"""The cells of a section that the tool reaches, each with the largest sigma_min found in it."""

import numpy as np
from numpy.typing import NDArray

from ..singularity import RegionalArm, Values, sigma_min, task_block
from .approach import approached, in_axis_frame, projected

Extent = tuple[float, float, float, float]  # left, right, bottom, top [m]


def filled(part: RegionalArm, axes: tuple[str, str], cells: int) -> tuple[Values, Extent]:
    """Cells of a section that any number of joints span: samples, then postures for the empty cells beside them."""
    q = spread(part, 40_000)
    points, sigma = projected(in_axis_frame(part.chain, q), axes), sigma_min(task_block(part, q))
    image, extent = raster(
        points, sigma, cells, margin=cells // 8
    )  # samples of many joints end short of the rim
    size, corner = (extent[1] - extent[0]) / image.shape[1], np.array([extent[0], extent[2]])
    posture = np.full((*image.shape, part.chain.n), np.nan)
    posture[tuple(((points - corner) / size).astype(int).T[::-1])] = q
    free, fresh = tuple(range(part.chain.n)), ~np.isnan(image)
    while fresh.any():
        empty, beside = _empty_beside(image, fresh)
        at, gap = approached(
            part, free, axes, posture[tuple(beside.T)], (empty[:, ::-1] + 0.5) * size + corner
        )
        found = (np.abs(gap) < 0.5 * size).all(axis=1)
        fresh = np.zeros_like(fresh)
        reached = tuple(empty[found].T)
        posture[reached], fresh[reached] = at[found], True
        image[reached] = sigma_min(task_block(part, at[found]))
    return _cropped(image, corner, size)


def raster(points: Values, sigma: Values, cells: int, margin: int = 1) -> tuple[Values, Extent]:
    """The largest sigma (...) of the points (..., 2) in each cell, NaN where there are none, with a `margin` around."""
    flat = points.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = (max(float((high - low).max()), 1e-9 * float(np.abs(flat).max())) or 1.0) / cells
    shape = np.ceil((high - low) / size).astype(int) + 1 + 2 * margin  # empty cells around
    origin = (low + high - shape * size) / 2
    column, row = ((flat - origin) / size).astype(int).T
    image = np.full(shape[0] * shape[1], -np.inf)
    np.maximum.at(image, row * shape[0] + column, sigma.ravel())
    image[image == -np.inf] = np.nan
    left, bottom = (float(v) for v in origin)
    right, top = (float(v) for v in origin + shape * size)
    return image.reshape(shape[1], shape[0]), (left, right, bottom, top)


def spread(part: RegionalArm, count: int) -> Values:
    """Configurations (count, n) spread evenly over the joint limits: Roberts' additive recurrence."""
    n = part.chain.n
    ratio = 2.0
    for _ in range(40):
        ratio = (1 + ratio) ** (1 / (n + 1))
    low, high = np.transpose(part.limits)
    return low + (high - low) * (
        np.arange(1, count + 1)[:, None] * ratio ** -np.arange(1.0, n + 1) % 1
    )


def beside_empty(image: Values, extent: Extent, points: Values) -> NDArray[np.bool_]:
    """Whether the cell one and a half cells off a curve (m, 2) is empty on one side or the other, for each point."""
    size = (extent[1] - extent[0]) / image.shape[1]
    along = np.gradient(points, axis=0)
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    normal *= 1.5 * size / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    empty = np.pad(np.isnan(image), 2, constant_values=True)
    found = np.zeros(len(points), dtype=np.bool_)
    for side in (points + normal, points - normal):
        column, row = (np.floor((side - (extent[0], extent[2])) / size).astype(int) + 2).T
        found |= empty[np.clip(row, 0, empty.shape[0] - 1), np.clip(column, 0, empty.shape[1] - 1)]
    return found


def _cropped(image: Values, corner: Values, size: float) -> tuple[Values, Extent]:
    """The reached cells with one empty cell around, and their extent."""
    rows, columns = (np.flatnonzero((~np.isnan(image)).any(axis=axis)) for axis in (1, 0))
    top, bottom, left, right = rows[-1] + 2, rows[0] - 1, columns[0] - 1, columns[-1] + 2
    left, bottom = max(left, 0), max(bottom, 0)
    kept = image[bottom:top, left:right]
    x, y = corner + np.array([left, bottom]) * size
    return kept, (
        float(x),
        float(x + kept.shape[1] * size),
        float(y),
        float(y + kept.shape[0] * size),
    )


def _empty_beside(
    image: Values, fresh: NDArray[np.bool_]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and columns (m, 2) of empty cells, and of the cells reached last that each of them touches."""
    cells = np.argwhere(fresh)
    around = np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j])
    beside = np.repeat(cells, len(around), axis=0)
    empty = (cells[:, None] + around).reshape(-1, 2)
    inside = ((empty >= 0) & (empty < image.shape)).all(axis=1)
    empty, beside = empty[inside], beside[inside]
    unreached = np.isnan(image[tuple(empty.T)])
    return empty[unreached], beside[unreached]
