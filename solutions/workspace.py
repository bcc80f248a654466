"""Where the tool gets: its reach, and the section of its workspace with the exact curves that bound and cross it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import Chain
from .kinematics import forward
from .sections.approach import approached, configurations, in_axis_frame, projected
from .sections.barriers import barriers
from .sections.cells import Extent, beside_empty, filled, raster, spread
from .singularity import Parameters, RegionalArm, Values, arm, sigma_min, task_block, zero_set

if TYPE_CHECKING:
    from .robots import Robot

SAMPLES = 181  # per joint of a section
SEEDS = 48  # per joint, where the search for a posture starts
BESIDE = 5e-4  # of a curve's size: how far off it the two sides are tried
FINER = 6  # bilinear points between two samples; their error is far below a cell
LIMITS = "joint limits"
SINGULAR = "singular: no velocity across"  # curves of a section that three joints or more span


@dataclass(frozen=True, eq=False)
class Curve:
    """The image of a singular set or of joint-limit faces in a section.

    Attributes:
        name: The factor's name, "joint limits", or, in a section that three joints or more span, `SINGULAR`.
        points: Shape (m, 2) [m].
        q: The configurations of the arm (m, n) that lead there.
        boundary: For each point (m,), whether the tool cannot get to one side of it.
    """

    name: str
    points: Values
    q: Values
    boundary: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Section:
    """The workspace of an arm that turns about axis 1, cut by a half plane (r, z); of a planar arm, its plane.

    Attributes:
        axes: ("r", "z") or ("x", "y"), in the frame of axis 1 [m].
        cells: The largest sigma_min found in each cell (ny, nx), NaN where the tool cannot get.
        extent: left, right, bottom, top of the cells [m].
        curves: Images of the singular sets and of the joint-limit faces. Where three joints or more span the section,
            of the faces only what the tool cannot pass in that posture.
    """

    axes: tuple[str, str]
    cells: Values
    extent: Extent
    curves: tuple[Curve, ...]


def meridian(chain: Chain, q: ArrayLike) -> Values:
    """The tool's distance from axis 1 and its height along it, (..., 2) [m], at q (..., n)."""
    p = in_axis_frame(chain, q)
    return np.stack([np.hypot(p[..., 0], p[..., 1]), p[..., 2]], axis=-1)


def reach(
    robot: "Robot", parameters: Parameters = None, *, of: Literal["axis 1", "base"] = "axis 1"
) -> tuple[float, float]:
    """The smallest and largest distance [m] of the tool from axis 1 or from the base origin within the joint limits.

    For an arm with a wrist it is the wrist centre's.
    """
    part = arm(robot, parameters)

    def distance(q: Values) -> Values:
        return (
            meridian(part.chain, q)[..., 0]
            if of == "axis 1"
            else np.linalg.norm(forward(part.chain, q)[..., :3, 3], axis=-1)
        )

    return _least(distance, part), -_least(lambda q: -distance(q), part)


def section(robot: "Robot", parameters: Parameters = None, *, cells: int = 320) -> Section:
    """The section of the workspace within the joint limits, with `cells` cells along its longer side."""
    part = arm(robot, parameters)
    axes, free = _plane(part)
    if len(free) != 2:
        image, extent = filled(part, axes, cells // 4)
        return Section(axes, image, extent, _barrier_curves(part, axes, free, image, extent))
    grid = [np.linspace(*part.limits[i], SAMPLES) for i in free]
    q = configurations(part.chain.n, free, np.stack(np.meshgrid(*grid, indexing="ij"), axis=-1))
    sigma = sigma_min(task_block(part, q))
    finer = _interpolation(SAMPLES, FINER)
    p = np.moveaxis(in_axis_frame(part.chain, q), -1, 0)
    p, sigma = finer @ p @ finer.T, finer @ sigma @ finer.T
    image, extent = raster(projected(np.moveaxis(p, 0, -1), axes), sigma, cells)
    curves = _singular_curves(robot, parameters, part, free) + _limit_curves(part, free)
    points = [projected(in_axis_frame(part.chain, line), axes) for _, line in curves]
    return Section(
        axes,
        image,
        extent,
        tuple(
            Curve(name, at, line, _on_boundary(part, free, axes, at))
            for (name, line), at in zip(curves, points, strict=True)
        ),
    )


def _plane(part: RegionalArm) -> tuple[tuple[str, str], tuple[int, ...]]:
    """The coordinates of the section and the joints that change something in it."""
    q = spread(part, 64)
    reached = in_axis_frame(part.chain, q)
    if part.chain.kinds[0] == "P" or np.ptp(reached[:, 2]) <= 1e-9 * np.abs(reached).max():
        axes, first = ("x", "y"), 0
    else:
        axes, first = ("r", "z"), 1
    return axes, tuple(i for i in range(first, part.chain.n) if _matters(part, i, axes, q))


def _matters(part: RegionalArm, joint: int, axes: tuple[str, str], q: Values) -> bool:
    """Whether a joint moves the tool in the section or changes sigma_min: the last of a SCARA does neither."""
    turned = q.copy()
    turned[:, joint] = q[::-1, joint]
    at, sigma = projected(in_axis_frame(part.chain, q), axes), sigma_min(task_block(part, q))
    moved = (
        np.abs(projected(in_axis_frame(part.chain, turned), axes) - at).max()
        > 1e-12 * np.abs(at).max()
    )
    changed = np.abs(sigma_min(task_block(part, turned)) - sigma).max() > 1e-12 * sigma.max()
    return bool(moved or changed)


def _interpolation(count: int, finer: int) -> Values:
    """The matrix that puts `finer - 1` points between each two of `count` samples, on straight lines."""
    position = np.arange((count - 1) * finer + 1) / finer
    return np.maximum(0.0, 1 - np.abs(position[:, None] - np.arange(count)))


def _singular_curves(
    robot: "Robot", parameters: Parameters, part: RegionalArm, free: tuple[int, ...]
) -> list[tuple[str, Values]]:
    ranges = [part.limits[i] for i in free]
    return [
        (factor.name, configurations(part.chain.n, free, line))
        for factor in part.factors
        for line in zero_set(robot, factor.name, parameters, free=(free[0], free[1]), ranges=ranges)
    ]


def _barrier_curves(
    part: RegionalArm, axes: tuple[str, str], free: tuple[int, ...], image: Values, extent: Extent
) -> tuple[Curve, ...]:
    lines = [(LIMITS if held else SINGULAR, q) for held, q in barriers(part, axes, free)]
    points = [projected(in_axis_frame(part.chain, q), axes) for _, q in lines]
    flags = [beside_empty(image, extent, at) for at in points]
    return tuple(
        Curve(name, at, q, flag) for (name, q), at, flag in zip(lines, points, flags, strict=True)
    )


def _limit_curves(part: RegionalArm, free: tuple[int, ...]) -> list[tuple[str, Values]]:
    curves: list[tuple[str, Values]] = []
    for held, swept in (free, free[::-1]):
        low, high = part.limits[held]
        if part.chain.kinds[held] == "R" and high - low > 2 * np.pi - 1e-9:
            continue  # a full turn has no end
        for value in (low, high):
            q = np.zeros((2 * SAMPLES, part.chain.n))
            q[:, held], q[:, swept] = value, np.linspace(*part.limits[swept], 2 * SAMPLES)
            curves.append((LIMITS, q))
    return curves


def _on_boundary(
    part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str], points: Values
) -> NDArray[np.bool_]:
    """Whether the tool misses one of the two points just beside a curve, for each of its points."""
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
        beyond = _distance(part, free, axes, probes) > 0.2 * BESIDE * size
        return beyond[: len(chosen)] | beyond[len(chosen) :]

    # Every eighth point first; the points between two that differ are tried one by one.
    coarse = np.unique(np.append(np.arange(0, len(points), 8), len(points) - 1))
    found = missed(coarse)
    boundary = found[np.searchsorted(coarse, np.arange(len(points)))]
    differ = np.flatnonzero(found[1:] != found[:-1])
    for i in differ:
        between = np.arange(int(coarse[i]) + 1, int(coarse[i + 1]))
        boundary[between] = missed(between)
    return boundary


def _distance(
    part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str], targets: Values
) -> Values:
    """How near the tool gets to each target (m, 2) of the section within the joint limits [m].

    Gauss-Newton steps start at every local minimum of the distance over a grid of the two joints: one per posture.
    """
    low, high = np.transpose([part.limits[i] for i in free])
    low, high = low + 1e-6 * (high - low), high - 1e-6 * (high - low)
    # Cell centres, an even number, in a box a hair smaller: on axis 1 itself r has no derivative.
    lines = [a + (b - a) * (np.arange(SEEDS) + 0.5) / SEEDS for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    sampled = projected(in_axis_frame(part.chain, configurations(part.chain.n, free, grid)), axes)
    far = ((sampled - targets[:, None, None]) ** 2).sum(axis=-1)
    rim = np.pad(far, ((0, 0), (1, 1), (1, 1)), constant_values=np.inf)
    lowest = np.ones(far.shape, dtype=np.bool_)
    for i in range(3):
        for j in range(3):
            lowest &= far <= rim[:, i : i + SEEDS, j : j + SEEDS]
    target, *node = np.nonzero(lowest)
    q, wanted = grid[tuple(node)], targets[target]
    _, gap = approached(part, free, axes, q, wanted)
    nearest = np.full(len(targets), np.inf)
    np.minimum.at(nearest, target, np.linalg.norm(gap, axis=1))
    return nearest


def _least(value: Callable[[Values], Values], part: RegionalArm) -> float:
    """The minimum of a function over the joint limits: a grid that closes in on its best point."""
    low, high = (np.asarray(side, dtype=np.float64) for side in np.transpose(part.limits))
    count = max(5, int(60_000 ** (1 / part.chain.n)))
    centre, half, best = (low + high) / 2, (high - low) / 2, np.inf
    while half.max() > 1e-14:
        lines = np.linspace(
            np.maximum(low, centre - half), np.minimum(high, centre + half), count
        ).T
        q = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, part.chain.n)
        found = value(q)
        best, centre = min(best, float(found.min())), q[found.argmin()]
        half = half * max(3 / count, 0.0) if count > 7 else half * 0.6
        count = min(count, 7)
    return best
