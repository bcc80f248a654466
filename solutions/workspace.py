"""Where the tool gets: the section of its workspace, with exact curves that bound and cross it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import Chain
from .reach import reach
from .sections.approach import configurations, in_axis_frame, projected
from .sections.barriers import barriers, clearance
from .sections.cells import Extent, filled, raster
from .sections.sides import distance, on_boundary
from .singularity import Parameters, RegionalArm, Values, arm, sigma_min, task_block, zero_set
from .spread import spread

if TYPE_CHECKING:
    from .robots import Robot

__all__ = ["LIMITS", "SINGULAR", "Curve", "Section", "meridian", "reach", "section"]
SAMPLES = 181  # per joint of a section
FINER = 6  # bilinear points between two samples; their error is far below a cell
NARROW = 0.05  # of the clearance of curves, where both sides of one are tried first
LIMITS = "joint limits"
SINGULAR = "singular: no velocity across"  # curves of a section that three joints or more span


@dataclass(frozen=True, eq=False)
class Curve:
    """The image of a singular set or of joint-limit faces in a section.

    Attributes:
        name: The factor's name, "joint limits", or, in a section that three joints or more span,
            `SINGULAR`.
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
    """The workspace of an arm, cut by a half plane (r, z) from axis 1; of a planar arm, its plane.

    Attributes:
        axes: ("r", "z") or ("x", "y"), in the frame of axis 1 [m].
        cells: The largest sigma_min found in each cell (ny, nx), NaN where the tool cannot get.
        extent: left, right, bottom, top of the cells [m].
        curves: Images of the singular sets and of the joint-limit faces. Where three joints or
            more span the section, of the faces only what the tool cannot pass in that posture.
    """

    axes: tuple[str, str]
    cells: Values
    extent: Extent
    curves: tuple[Curve, ...]


def meridian(chain: Chain, q: ArrayLike) -> Values:
    """The tool's distance from axis 1 and its height along it, (..., 2) [m], at q (..., n)."""
    return projected(in_axis_frame(chain, q), ("r", "z"))


def section(robot: "Robot", parameters: Parameters = None, *, cells: int = 320) -> Section:
    """The section of the workspace within the joint limits.

    It has `cells` cells along its longer side; a quarter where three joints or more span it.
    """
    part = arm(robot, parameters)
    axes, free = _plane(part)
    if len(free) != 2:
        image, extent = filled(part, axes, cells // 4)
        return Section(axes, image, extent, _barrier_curves(part, axes, free))

    image, extent = _sampled(part, axes, free, cells)
    curves = list[Curve]()
    away = distance(part, free, axes)
    for name, q in _singular_curves(robot, parameters, part, free) + _limit_curves(part, free):
        points = projected(in_axis_frame(part.chain, q), axes)
        boundary = on_boundary(away, axes, points)
        curves.append(Curve(name, points, q, boundary))
    return Section(axes, image, extent, tuple(curves))


def _plane(part: RegionalArm) -> tuple[tuple[str, str], tuple[int, ...]]:
    """The coordinates of the section and the joints that change something in it."""
    q = spread(part.limits, 64)
    reached = in_axis_frame(part.chain, q)
    if part.chain.kinds[0] == "P" or np.ptp(reached[:, 2]) <= 1e-9 * np.abs(reached).max():
        axes, first = ("x", "y"), 0
    else:
        axes, first = ("r", "z"), 1  # joint 1 turns the section and changes nothing in it
    free = [i for i in range(first, part.chain.n) if _matters(part, i, axes, q)]
    return axes, tuple(free)


def _matters(part: RegionalArm, joint: int, axes: tuple[str, str], q: Values) -> bool:
    """Whether a joint moves the tool in the section or changes sigma_min.

    The last of a SCARA does neither.
    """
    turned = q.copy()
    turned[:, joint] = q[::-1, joint]
    at = projected(in_axis_frame(part.chain, q), axes)
    other = projected(in_axis_frame(part.chain, turned), axes)
    if np.abs(other - at).max() > 1e-12 * np.abs(at).max():
        return True
    sigma = sigma_min(task_block(part, q))
    changed = np.abs(sigma_min(task_block(part, turned)) - sigma).max()
    return bool(changed > 1e-12 * sigma.max())


def _sampled(
    part: RegionalArm, axes: tuple[str, str], free: tuple[int, ...], cells: int
) -> tuple[Values, Extent]:
    """The cells of a section that two joints span, from a grid of both, and their extent."""
    lines = [np.linspace(*part.limits[i], SAMPLES) for i in free]
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    q = configurations(part.chain.n, free, grid)
    p = np.moveaxis(in_axis_frame(part.chain, q), -1, 0)
    sigma = sigma_min(task_block(part, q))
    # Points in space are interpolated, not their r: it has a kink on axis 1.
    finer = _interpolation(SAMPLES, FINER)
    p = finer @ p @ finer.T
    sigma = finer @ sigma @ finer.T
    return raster(projected(np.moveaxis(p, 0, -1), axes), sigma, cells)


def _interpolation(count: int, finer: int) -> Values:
    """The matrix that puts `finer - 1` points between each two of `count` samples.

    They are on straight lines.
    """
    position = np.arange((count - 1) * finer + 1) / finer
    return np.maximum(0.0, 1 - np.abs(position[:, None] - np.arange(count)))


def _singular_curves(
    robot: "Robot", parameters: Parameters, part: RegionalArm, free: tuple[int, ...]
) -> list[tuple[str, Values]]:
    first, second = free
    ranges = [part.limits[first], part.limits[second]]
    curves = list[tuple[str, Values]]()
    for factor in part.factors:
        lines = zero_set(robot, factor.name, parameters, free=(first, second), ranges=ranges)
        for line in lines:
            q = configurations(part.chain.n, free, line)
            curves.append((factor.name, q))
    return curves


def _barrier_curves(
    part: RegionalArm, axes: tuple[str, str], free: tuple[int, ...]
) -> tuple[Curve, ...]:
    lines = barriers(part, axes, free)
    images = [projected(in_axis_frame(part.chain, q), axes) for _, q in lines]
    away, width = distance(part, free, axes), clearance(part, free)
    exact = [on_boundary(away, axes, points, NARROW * width) for points in images]
    bounding = [points[found] for points, found in zip(images, exact, strict=True)]
    walls = np.concatenate([*bounding, np.empty((0, 2))])

    curves = list[Curve]()
    for (held, q), points, found in zip(lines, images, exact, strict=True):
        # One line may stand for several; where the outermost is not found, it is the boundary.
        alone = _far_from(walls, points, width)
        boundary = found
        if alone.any():
            boundary = found | (alone & on_boundary(away, axes, points, width))
        curves.append(Curve(LIMITS if held else SINGULAR, points, q, boundary))
    return tuple(curves)


def _far_from(walls: Values, points: Values, width: float) -> NDArray[np.bool_]:
    """Whether no wall (k, 2) is within a width of points (m, 2) [m]."""
    if not len(walls):
        return np.ones(len(points), dtype=np.bool_)
    gaps = np.linalg.norm(points[:, None] - walls, axis=-1).min(axis=1)
    return np.asarray(gaps > width, dtype=np.bool_)


def _limit_curves(part: RegionalArm, free: tuple[int, ...]) -> list[tuple[str, Values]]:
    curves: list[tuple[str, Values]] = []
    for held, swept in (free, free[::-1]):
        low, high = part.limits[held]
        if part.chain.kinds[held] == "R" and high - low > 2 * np.pi - 1e-9:
            continue  # a full turn has no end
        for value in (low, high):
            q = np.zeros((2 * SAMPLES, part.chain.n))
            q[:, held] = value
            q[:, swept] = np.linspace(*part.limits[swept], 2 * SAMPLES)
            curves.append((LIMITS, q))
    return curves
