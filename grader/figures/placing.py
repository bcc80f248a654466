"""Where labels stand: clear of one another, of the joints' bodies and of the margins."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from .depth import cells
from .labels import Label, Placed
from .vectors import Array

ANGLES = np.arange(24.0) * (pi / 12)
DIRECTIONS = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
# [px] from an anchor to the label's near side.
RINGS = np.array([3.0, 6, 9, 14, 20, 28, 38, 50, 65])
# Offers looked at together: the first are the cheapest, and mostly one of them is free.
AT_ONCE = 32

# What a place costs, in pixels of distance from the anchor.
TOWARDS = 5.0  # the discount for the direction in which it is wished
LATER = 1.5  # for each anchor that is better
UNCLEAR = 1.6  # for each pixel by which it is nearer to another's than to its own
INKED = 0.8  # for each cell of ink under it
ASIDE = 25.0  # for what would reach out of the picture


@dataclass(frozen=True, eq=False)
class _Offers:
    """Where a label may stand: `centres` (k, 2) and `anchors` (k, 2) they belong to.

    The one with the lowest price of everything but other labels comes first.
    """

    centres: Array
    anchors: Array


@dataclass(frozen=True, eq=False)
class _Ground:
    """What labels are put upon: ink and bodies, as `_summed`, and the picture's width [px]."""

    ink: Array
    bodies: Array
    width: float


def place(labels: Sequence[Label], ink: Array, bodies: Array, width: float) -> list[Placed]:
    """Where each label stands, clear of the others, of bodies and of the margins, near its anchor.

    It stands on as little ink as can be, and on no cell of `bodies`. Both are counted on cells
    centred on the origin, in a picture `width` pixels wide. Each label is placed given the others,
    then twice more, now that all have a place.
    """
    ground = _Ground(_summed(ink), _summed(bodies), width)
    offers = [_offers(labels, k, RINGS, ground) for k in range(len(labels))]
    placed: dict[int, Placed] = {}
    for _ in range(3):
        before = dict(placed)
        for k, label in enumerate(labels):
            placed.pop(k, None)
            offer, rings = offers[k], RINGS
            best = _first_free(offer, label, placed.values())
            while best is None:
                # There is always room farther up or down: the picture grows with its labels.
                rings = rings * 1.5
                offer = _offers(labels, k, rings, ground)
                best = _first_free(offer, label, placed.values())
            placed[k] = _kept(
                before.get(k), Placed(label, offer.centres[best], offer.anchors[best])
            )
        if placed == before:
            break
    return [placed[k] for k in range(len(labels))]


def _kept(before: Placed | None, now: Placed) -> Placed:
    """The earlier place where the label did not move."""
    if before is not None and np.array_equal(before.centre, now.centre):
        return before
    return now


def _summed(grid: Array) -> Array:
    """What stands above and to the left of each cell, (rows + 1, columns + 1)."""
    total = np.zeros((grid.shape[0] + 1, grid.shape[1] + 1))
    total[1:, 1:] = grid.cumsum(0).cumsum(1)
    return total


def _offers(labels: Sequence[Label], k: int, rings: Array, ground: _Ground) -> _Offers:
    """What label `k` is offered, at the distances `rings` from each of its anchors."""
    label = labels[k]
    half = label.size / 2
    # From the middle of the label to the point of its edge that is nearest to the anchor.
    box = np.sign(DIRECTIONS.round(6)) * np.minimum(half, np.abs(DIRECTIONS) * half.sum())
    centres = label.anchors[:, None, None] + (rings[:, None, None] * DIRECTIONS + box)
    anchors = np.broadcast_to(label.anchors[:, None, None], centres.shape).reshape(-1, 2)
    centres = centres.reshape(-1, 2)

    towards = (label.away @ DIRECTIONS.T)[:, None]
    rank = LATER * np.arange(float(len(label.anchors)))[:, None, None]
    price = (rings[:, None] - TOWARDS * towards + rank).reshape(-1)
    rivals = [other.owner for other in labels if other is not label]
    price = price + _mistaken(centres, label.owner, np.vstack([np.zeros((0, 2)), *rivals]))

    # A label too wide for the picture keeps to its middle.
    edge = max(ground.width / 2 - 2 - float(half[0]), 0.0)
    inside = np.clip(centres[:, 0], -edge, edge)
    price = price + np.where(inside == centres[:, 0], 0.0, ASIDE)
    centres = np.column_stack([inside, centres[:, 1]])
    price = price + INKED * _under(centres, half, ground.ink)

    order = np.argsort(price, kind="stable")
    free = _under(centres[order], half, ground.bodies) == 0
    return _Offers(centres[order][free], anchors[order][free])


def _mistaken(centres: Array, owner: Array, rivals: Array) -> Array | float:
    """The price of standing nearer to what another label belongs to, at each centre."""
    if not len(owner) or not len(rivals):
        return 0.0
    nearer = _nearest(centres, owner) + 5 - _nearest(centres, rivals)
    return UNCLEAR * np.maximum(0, nearer)


def _nearest(points: Array, others: Array) -> Array:
    """The distance of each of `points` (k, 2) from the nearest of `others` (m, 2)."""
    return np.sqrt(((points[:, None] - others) ** 2).sum(-1).min(1))


def _under(centres: Array, half: Array, total: Array) -> Array:
    """What (k,) stands under a label of half size `half` at each of `centres` (k, 2)."""
    grid = total[1:, 1:]
    top, left = cells(centres - half - 1, grid)
    bottom, right = cells(centres + half + 1, grid)
    return (
        total[bottom + 1, right + 1]
        - total[top, right + 1]
        - total[bottom + 1, left]
        + total[top, left]
    )


def _first_free(offer: _Offers, label: Label, others: Iterable[Placed]) -> int | None:
    """The first of the offers that lies a pixel or more from the other labels."""
    boxes = np.array([other.box for other in others]).reshape(-1, 4)
    half = label.size / 2
    for start in range(0, len(offer.centres), AT_ONCE):
        centres = offer.centres[start : start + AT_ONCE]
        low, high = centres - half - 1, centres + half + 1
        beside = (low[:, None, 0] >= boxes[:, 2]) | (high[:, None, 0] <= boxes[:, 0])
        above = (low[:, None, 1] >= boxes[:, 3]) | (high[:, None, 1] <= boxes[:, 1])
        free = np.flatnonzero(np.all(beside | above, axis=1))
        if len(free):
            return start + int(free[0])
    return None
