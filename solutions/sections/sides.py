"""Whether the tool gets to both sides of a curve, in a section that two joints span."""

import numpy as np
from numpy.typing import NDArray

from ..singularity import RegionalArm, Values
from .approach import approached, configurations, in_axis_frame, inner_limits, projected

SEEDS = 48  # per joint, where the search for a posture starts; an even number
BESIDE = 5e-4  # of a curve's size: how far off it the two sides are tried
COARSE = 8  # points of a curve from one that is tried first to the next


def on_boundary(
    part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str], points: Values
) -> NDArray[np.bool_]:
    """Whether the tool misses one of the two points just beside a curve (m, 2), for each point."""
    size = float(np.ptp(points, axis=0).max())
    if size <= 1e-9 * float(np.abs(points).max()):
        return np.zeros(len(points), dtype=np.bool_)
    along = np.gradient(points, axis=0)
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    normal *= BESIDE * size / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)

    def missed(chosen: NDArray[np.intp]) -> NDArray[np.bool_]:
        probes = np.concatenate([points[chosen] + normal[chosen], points[chosen] - normal[chosen]])
        if axes == ("r", "z"):
            probes[:, 0] = np.abs(probes[:, 0])  # across axis 1 lies the same half plane
        beyond = distance(part, free, axes, probes) > 0.2 * BESIDE * size
        return beyond[: len(chosen)] | beyond[len(chosen) :]

    # Some points first; the points between two that differ are tried one by one.
    coarse = np.unique(np.append(np.arange(0, len(points), COARSE), len(points) - 1))
    found = missed(coarse)
    boundary = found[np.searchsorted(coarse, np.arange(len(points)))]
    for i in np.flatnonzero(found[1:] != found[:-1]):
        between = np.arange(int(coarse[i]) + 1, int(coarse[i + 1]))
        boundary[between] = missed(between)
    return boundary


def distance(
    part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str], targets: Values
) -> Values:
    """How near (m,) the tool gets to each target (m, 2) of the section within the limits [m].

    Gauss-Newton steps start at every local minimum of the distance over a grid of the two joints:
    one per posture.
    """
    low, high = inner_limits(part, free)
    centres = np.arange(SEEDS) + 0.5  # of the grid's cells
    lines = [low[i] + (high[i] - low[i]) * centres / SEEDS for i in range(len(free))]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    q = configurations(part.chain.n, free, grid)
    sampled = projected(in_axis_frame(part.chain, q), axes)
    squared = ((sampled - targets[:, None, None]) ** 2).sum(axis=-1)

    target, *node = np.nonzero(_local_minima(squared))
    start, wanted = grid[tuple(node)], targets[target]
    _, gap = approached(part, free, axes, start, wanted)
    nearest = np.full(len(targets), np.inf)
    np.minimum.at(nearest, target, np.linalg.norm(gap, axis=1))
    return nearest


def _local_minima(values: Values) -> NDArray[np.bool_]:
    """Where values on grids (m, a, b) are not above those of the eight nodes around."""
    _, rows, columns = values.shape
    around = np.pad(values, ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    lowest = np.ones(values.shape, dtype=np.bool_)
    for i in range(3):
        for j in range(3):
            lowest &= values <= around[:, i : i + rows, j : j + columns]
    return lowest
