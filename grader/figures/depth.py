"""What stands before what: the half-spaces of solids, their depth on a grid, and the order in which to paint them.

All in camera coordinates: x to the right, y down, z towards the viewer, in pixels of the final drawing.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CELL = 3.0  # [px] of the grid on which depths are compared and ink is counted


@dataclass(frozen=True, eq=False)
class Item:
    """Something painted in order of depth.

    `front` (rows, columns) is its depth on the cells it covers from `corner` (row, column) on, -inf where it does
    not. Neighbours of one `group` paint their outlines before their bodies, so that they look welded.
    """

    outline: str
    body: str
    corner: tuple[int, int]
    front: Array
    group: str


def norm(v: Array) -> float:
    """The length of a vector."""
    return sqrt(float(v @ v))


def unit(v: Array) -> Array:
    """`v` over its length; zero stays zero."""
    length = norm(v)
    return v / length if length > 1e-12 else np.zeros_like(v)


def cross(a: Array, b: Array) -> Array:
    """The vector product of two vectors (3,); many times faster than numpy's on so few."""
    (p, q, r), (x, y, z) = a.tolist(), b.tolist()
    return np.array([q * z - r * y, r * x - p * z, p * y - q * x])


def lifted(p: Array) -> Array:
    """`p` (2,) as a vector (3,) in the plane of the picture."""
    return np.array([p[0], p[1], 0.0])


def spaced(first: float, last: float, count: int) -> Array:
    """`count` numbers from `first` to `last`."""
    return np.asarray(np.linspace(first, last, count), dtype=np.float64)


def square_to(d: Array) -> tuple[Array, Array]:
    """Two unit vectors square to the unit vector `d` and to each other."""
    u = unit(cross(d, np.eye(3)[int(np.argmin(np.abs(d)))]))
    return u, cross(d, u)


def every_pixel(points: Array) -> Array:
    """Points about a pixel apart along the line through `points` (k, 2 or 3)."""
    reach = np.concatenate([[0.0], np.sqrt(((points[1:] - points[:-1]) ** 2).sum(1)).cumsum()])
    at = spaced(0.0, float(reach[-1]), int(reach[-1]) + 2)
    return np.column_stack([np.interp(at, reach, points[:, k]) for k in range(points.shape[1])])


def cells(points: Array, grid: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Row and column (...) of `points` (..., 2) in a square `grid` centred on the origin."""
    at = np.clip(np.floor(points / CELL).astype(np.int64) + len(grid) // 2, 0, len(grid) - 1)
    return at[..., 1], at[..., 0]


def tube_planes(a: Array, b: Array, radius: float, facets: int) -> Array:
    """The half-spaces normal . p <= c, as rows (normal, c), of a cylinder from `a` to `b`; its ends come last."""
    d = unit(b - a)
    u, v = square_to(d)
    turn = np.arange(float(facets)) * (2 * pi / facets)
    normals = np.vstack([np.outer(np.cos(turn), u) + np.outer(np.sin(turn), v), d, -d])
    return np.column_stack([normals, np.concatenate([normals[:-2] @ a + radius, [d @ b, -d @ a]])])


def span_inside(a: Array, b: Array, planes: Array) -> tuple[float, float] | None:
    """The part (from, to) in [0, 1] of the segment that lies inside the half-spaces, or None."""
    room, along = planes[:, 3] - planes[:, :3] @ a, planes[:, :3] @ (b - a)
    parallel = np.abs(along) < 1e-9
    if np.any(room[parallel] < 0):
        return None
    t, leaving = room[~parallel] / along[~parallel], along[~parallel] > 0
    last, first = float(np.min(t[leaving], initial=1.0)), float(np.max(t[~leaving], initial=0.0))
    return (first, last) if first < last else None


def outside(a: Array, b: Array, solids: Iterable[Array]) -> list[tuple[float, float]]:
    """The parts (from, to) in [0, 1] of the segment that lie outside all of the solids, given by their half-spaces."""
    parts = [(0.0, 1.0)]
    for planes in solids:
        hidden = span_inside(a, b, planes)
        if hidden is not None:
            first, last = hidden
            parts = [cut for f, t in parts for cut in ((f, min(t, first)), (max(f, last), t))]
            parts = [(f, t) for f, t in parts if t - f > 1e-9]
    return parts


def depths(planes: Array, low: Array, high: Array) -> tuple[tuple[int, int], Array]:
    """The first cell and the front depth on each cell of a convex solid between `low` and `high` (2,)."""
    first, last = np.floor(low / CELL).astype(np.int64), np.floor(high / CELL).astype(np.int64)
    x = (np.arange(float(first[0]), float(last[0]) + 1) + 0.5) * CELL
    y = (np.arange(float(first[1]), float(last[1]) + 1) + 0.5) * CELL
    across, down, slope, c = (planes[:, k, None, None] for k in range(4))
    room = c - across * x - down * y[:, None]
    near, far = planes[:, 2] > 1e-9, planes[:, 2] < -1e-9
    front = np.min(room[near] / slope[near], axis=0, initial=np.inf)
    back = np.max(room[far] / slope[far], axis=0, initial=-np.inf)
    covered = (front >= back) & np.all(room[~near & ~far] >= 0, axis=0)
    return (int(first[1]), int(first[0])), np.where(covered, front, -np.inf)


def _in_front(a: Item, b: Item) -> float:
    """How clearly `a` hides `b`: positive if it does, negative if `b` hides `a`, 0 if they share no cell."""
    top, left = max(a.corner[0], b.corner[0]), max(a.corner[1], b.corner[1])
    bottom = min(a.corner[0] + a.front.shape[0], b.corner[0] + b.front.shape[0])
    right = min(a.corner[1] + a.front.shape[1], b.corner[1] + b.front.shape[1])
    if top >= bottom or left >= right:
        return 0.0
    of_a = a.front[
        top - a.corner[0] : bottom - a.corner[0], left - a.corner[1] : right - a.corner[1]
    ]
    of_b = b.front[
        top - b.corner[0] : bottom - b.corner[0], left - b.corner[1] : right - b.corner[1]
    ]
    shared = np.isfinite(of_a) & np.isfinite(of_b)
    return float(np.clip(of_a[shared] - of_b[shared], -3, 3).sum())


def by_depth(items: Sequence[Item]) -> list[Item]:
    """The items from back to front; where they hide one another in a ring, the weakest claim gives way."""
    behind: list[dict[int, float]] = [{} for _ in items]
    for i, a in enumerate(items):
        for j in range(i):
            score = _in_front(a, items[j])
            if score:
                nearer, farther = (i, j) if score > 0 else (j, i)
                behind[nearer][farther] = abs(score)
    middle = [float(item.front.mean(where=np.isfinite(item.front))) for item in items]
    order: list[Item] = []
    left, group = set(range(len(items))), ""
    while left:
        free = [i for i in left if not behind[i]] or [
            min(left, key=lambda i: (sum(behind[i].values()), i))
        ]
        i = min((items[i].group != group, middle[i], i) for i in free)[2]
        left.remove(i)
        for claims in behind:
            claims.pop(i, None)
        order.append(items[i])
        group = items[i].group
    return order


def welded(items: Iterable[Item]) -> list[str]:
    out: list[str] = []
    for _, group in groupby(items, key=lambda item: item.group):
        members = list(group)
        out += [item.outline for item in members if item.outline] + [item.body for item in members]
    return out
