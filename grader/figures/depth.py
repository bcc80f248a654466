"""What stands before what: half-spaces of solids, their depth on a grid, the order of painting.

All in camera coordinates: x to the right, y down, z towards the viewer, in pixels of the final
drawing.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from math import pi

import numpy as np
from numpy.typing import NDArray

from .vectors import Array, square_to, unit

CELL = 3.0  # [px] of the grid on which depths are compared and ink is counted
CLEAR = 3.0  # [px] of depth between two items; what is farther apart counts the same


@dataclass(frozen=True, eq=False)
class Item:
    """Something painted in order of depth.

    `front` (rows, columns) is its depth on the cells it covers from `corner` (row, column) on, -inf
    where it does not. Neighbours of one `group` paint their outlines before their bodies, so that
    they look welded.
    """

    outline: str
    body: str
    corner: tuple[int, int]
    front: Array
    group: str


def cells(points: Array, grid: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Row and column (...) of `points` (..., 2) in a square `grid` centred on the origin."""
    at = np.floor(points / CELL).astype(np.int64) + len(grid) // 2
    at = np.clip(at, 0, len(grid) - 1)
    return at[..., 1], at[..., 0]


def tube_planes(a: Array, b: Array, radius: float, facets: int) -> Array:
    """The half-spaces of a cylinder from `a` to `b`, as rows (normal, c) for normal . p <= c.

    The `facets` sides come first, then the end at `b`, then the end at `a`.
    """
    d = unit(b - a)
    u, v = square_to(d)
    turn = np.arange(float(facets)) * (2 * pi / facets)
    sides = np.outer(np.cos(turn), u) + np.outer(np.sin(turn), v)
    reach = np.concatenate([sides @ a + radius, [d @ b, -d @ a]])
    return np.column_stack([np.vstack([sides, d, -d]), reach])


def span_inside(a: Array, b: Array, planes: Array) -> tuple[float, float] | None:
    """The part (from, to) in [0, 1] of the segment that lies inside the half-spaces, or None."""
    room = planes[:, 3] - planes[:, :3] @ a
    along = planes[:, :3] @ (b - a)
    parallel = np.abs(along) < 1e-9
    if np.any(room[parallel] < 0):
        return None

    t = room[~parallel] / along[~parallel]
    leaving = along[~parallel] > 0
    last = float(np.min(t[leaving], initial=1.0))
    first = float(np.max(t[~leaving], initial=0.0))
    return (first, last) if first < last else None


def outside(a: Array, b: Array, solids: Iterable[Array]) -> list[tuple[float, float]]:
    """The parts (from, to) in [0, 1] of the segment that lie outside all of the solids.

    A solid is given by its half-spaces (k, 4).
    """
    parts = [(0.0, 1.0)]
    for planes in solids:
        hidden = span_inside(a, b, planes)
        if hidden is not None:
            parts = _cut(parts, *hidden)
    return parts


def _cut(
    parts: Iterable[tuple[float, float]], first: float, last: float
) -> list[tuple[float, float]]:
    """What is left of the parts without what lies between `first` and `last`."""
    left: list[tuple[float, float]] = []
    for start, end in parts:
        before = (start, min(end, first))
        behind = (max(start, last), end)
        left += [part for part in (before, behind) if part[1] - part[0] > 1e-9]
    return left


def depths(planes: Array, low: Array, high: Array) -> tuple[tuple[int, int], Array]:
    """The first cell and the front depth on each cell of a convex solid.

    The solid lies between `low` and `high` (2,); the depth is -inf where it does not cover a cell.
    """
    first, last = np.floor(low / CELL).astype(np.int64), np.floor(high / CELL).astype(np.int64)
    x = (np.arange(float(first[0]), float(last[0]) + 1) + 0.5) * CELL
    y = (np.arange(float(first[1]), float(last[1]) + 1) + 0.5) * CELL

    # Along the line of sight through a cell each plane leaves room before it, or behind it.
    across, down, slope, c = planes.T[:, :, None, None]
    room = c - across * x - down * y[:, None]
    near, far = planes[:, 2] > 1e-9, planes[:, 2] < -1e-9
    front = np.min(room[near] / slope[near], axis=0, initial=np.inf)
    back = np.max(room[far] / slope[far], axis=0, initial=-np.inf)
    covered = (front >= back) & np.all(room[~near & ~far] >= 0, axis=0)
    return (int(first[1]), int(first[0])), np.where(covered, front, -np.inf)


def by_depth(items: Sequence[Item]) -> list[Item]:
    """The items from back to front.

    Where they hide one another in a ring, the weakest claim gives way.
    """
    behind = _claims(items)
    middle = [float(item.front.mean(where=np.isfinite(item.front))) for item in items]
    order: list[Item] = []
    left, group = set(range(len(items))), ""
    while left:
        free = [i for i in left if not behind[i]]
        if not free:
            weights = [(sum(behind[i].values()), i) for i in left]
            free = [min(weights)[1]]

        # What is welded to the last one comes first, then what lies farthest back.
        ranks = [(items[i].group != group, middle[i], i) for i in free]
        i = min(ranks)[2]
        left.remove(i)
        for claims in behind:
            claims.pop(i, None)
        order.append(items[i])
        group = items[i].group
    return order


def _claims(items: Sequence[Item]) -> list[dict[int, float]]:
    """For each item those that it hides, and how clearly: they are to be painted before it."""
    behind: list[dict[int, float]] = [{} for _ in items]
    for i, a in enumerate(items):
        for j in range(i):
            score = _in_front(a, items[j])
            if score > 0:
                behind[i][j] = score
            elif score < 0:
                behind[j][i] = -score
    return behind


def _in_front(a: Item, b: Item) -> float:
    """How clearly `a` hides `b`: negative if `b` hides `a`, 0 if they share no cell."""
    top, left = max(a.corner[0], b.corner[0]), max(a.corner[1], b.corner[1])
    bottom = min(a.corner[0] + a.front.shape[0], b.corner[0] + b.front.shape[0])
    right = min(a.corner[1] + a.front.shape[1], b.corner[1] + b.front.shape[1])
    if top >= bottom or left >= right:
        return 0.0
    of_a = _front_between(a, top, bottom, left, right)
    of_b = _front_between(b, top, bottom, left, right)
    shared = np.isfinite(of_a) & np.isfinite(of_b)
    return float(np.clip(of_a[shared] - of_b[shared], -CLEAR, CLEAR).sum())


def _front_between(item: Item, top: int, bottom: int, left: int, right: int) -> Array:
    """The depth of an item on some of its cells, given by rows and columns of the picture."""
    row, column = item.corner
    return item.front[top - row : bottom - row, left - column : right - column]


def welded(items: Iterable[Item]) -> list[str]:
    """The SVG of the items in their order, the outlines of neighbours of one group together."""
    painted: list[str] = []
    for _, group in groupby(items, key=lambda item: item.group):
        members = list(group)
        painted += [item.outline for item in members if item.outline]
        painted += [item.body for item in members]
    return painted
