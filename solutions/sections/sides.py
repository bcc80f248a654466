"""Whether the tool gets to both sides of a curve in a section."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..singularity import RegionalArm, Values
from ..spread import spread
from .approach import approached, configurations, in_axis_frame, inner_limits, projected

SEEDS = 48  # per joint, where the search for a posture starts; an even number
SAMPLES = 12_000  # postures of more than two joints
WIDER = (SAMPLES // 16, SAMPLES // 64)  # of them, among which the search goes on
NEAREST = 8  # of these, where it starts
MET = 1e-7  # of the section's size: so near is there
BESIDE = 5e-4  # of a curve's size: how far off it the two sides are tried
COARSE = 8  # points of a curve from one that is tried first to the next


class Distance(Protocol):
    """How near (m,) the tool gets to targets (m, 2) of a section within the limits [m]."""

    def __call__(self, targets: Values) -> Values:
        """The distances."""
        ...


def on_boundary(
    distance: Distance, axes: tuple[str, str], points: Values, beside: float | None = None
) -> NDArray[np.bool_]:
    """Whether the tool misses one of the two points just beside a curve (m, 2), for each point.

    They are `beside` it [m], by default a small part of its size.
    """
    size = float(np.ptp(points, axis=0).max())
    if beside is None:
        beside = BESIDE * size
    if size <= 1e-9 * float(np.abs(points).max()):
        return np.zeros(len(points), dtype=np.bool_)
    along = np.gradient(points, axis=0)
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    normal *= beside / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)

    def missed(chosen: NDArray[np.intp]) -> NDArray[np.bool_]:
        probes = np.concatenate([points[chosen] + normal[chosen], points[chosen] - normal[chosen]])
        if axes == ("r", "z"):
            probes[:, 0] = np.abs(probes[:, 0])  # across axis 1 lies the same half plane
        beyond = distance(probes) > 0.2 * beside
        return beyond[: len(chosen)] | beyond[len(chosen) :]

    # Some points first; the points between two that differ are tried one by one.
    coarse = np.unique(np.append(np.arange(0, len(points), COARSE), len(points) - 1))
    found = missed(coarse)
    boundary = found[np.searchsorted(coarse, np.arange(len(points)))]
    differing = np.flatnonzero(found[1:] != found[:-1])
    between = np.setdiff1d(_ranges(coarse, differing), coarse)
    if between.size:
        boundary[between] = missed(between)
    return boundary


def _ranges(coarse: NDArray[np.intp], chosen: NDArray[np.intp]) -> NDArray[np.intp]:
    """The numbers from each chosen one of the coarse points to the next."""
    ranges = [np.arange(int(coarse[i]), int(coarse[i + 1])) for i in chosen]
    return np.concatenate([*ranges, coarse[:0]])


def distance(part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str]) -> Distance:
    """How near the tool of an arm gets to targets of a section that its `free` joints span."""
    if len(free) == 2:
        return _from_grid(part, free, axes)
    return _from_samples(part, free, axes)


def _from_grid(part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str]) -> Distance:
    """Gauss-Newton steps start at every local minimum of the distance over a grid of two joints.

    There is one per posture.
    """
    low, high = inner_limits(part, free)
    centres = np.arange(SEEDS) + 0.5  # of the grid's cells
    lines = [low[i] + (high[i] - low[i]) * centres / SEEDS for i in range(len(free))]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    q = configurations(part.chain.n, free, grid)
    sampled = projected(in_axis_frame(part.chain, q), axes)

    def nearest(targets: Values) -> Values:
        squared = ((sampled - targets[:, None, None]) ** 2).sum(axis=-1)
        target, *node = np.nonzero(_local_minima(squared))
        start, wanted = grid[tuple(node)], targets[target]
        _, gap = approached(part, free, axes, start, wanted)
        found = np.full(len(targets), np.inf)
        np.minimum.at(found, target, np.linalg.norm(gap, axis=1))
        return found

    return nearest


def _from_samples(part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str]) -> Distance:
    """They start at the nearest samples, then, where that was in vain, at some that lie wider."""
    low, high = inner_limits(part, free)
    q = spread(np.column_stack([low, high]), SAMPLES)
    sampled = projected(in_axis_frame(part.chain, configurations(part.chain.n, free, q)), axes)

    def from_nearest(targets: Values, count: int) -> Values:
        starts = np.stack([_nearest(sampled[:count], target) for target in targets])
        wanted = np.repeat(targets, starts.shape[1], axis=0)
        _, gap = approached(part, free, axes, q[starts.ravel()], wanted)
        return np.linalg.norm(gap, axis=1).reshape(starts.shape).min(axis=1)

    def nearest(targets: Values) -> Values:
        found = from_nearest(targets, SAMPLES)
        for count in WIDER:
            left = np.flatnonzero(found > MET * float(np.ptp(sampled, axis=0).max()))
            if left.size:
                found[left] = np.minimum(found[left], from_nearest(targets[left], count))
        return found

    return nearest


def _nearest(points: Values, target: Values) -> NDArray[np.intp]:
    squared = ((points - target) ** 2).sum(axis=1)
    return np.argpartition(squared, NEAREST)[:NEAREST]


def _local_minima(values: Values) -> NDArray[np.bool_]:
    """Where values on grids (m, a, b) are not above those of the eight nodes around."""
    _, rows, columns = values.shape
    around = np.pad(values, ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    lowest = np.ones(values.shape, dtype=np.bool_)
    for i in range(3):
        for j in range(3):
            lowest &= values <= around[:, i : i + rows, j : j + columns]
    return lowest
