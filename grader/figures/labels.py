"""Labels: what they say, how wide they are, and where each stands."""

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, field
from math import pi

import numpy as np
from numpy.typing import NDArray

from ...solutions.expression import latex_name
from .depth import Array, cells

SIZE, SUB = 16.0, 11.0  # [px] of a symbol and of its subscript
NARROW, WIDE = frozenset("fijlrtI'.,()[]-"), frozenset("mwMW@%")
RINGS = np.array(
    [3.0, 6, 9, 14, 20, 28, 38, 50, 65]
)  # [px] from an anchor to the label's near side
DIRECTIONS = np.column_stack(
    [np.cos(np.arange(24.0) * (pi / 12)), np.sin(np.arange(24.0) * (pi / 12))]
)


@dataclass(frozen=True, eq=False)
class Label:
    """A symbol that stands near one of its `anchors` (k, 2), best first, if possible in the direction `away` (k, 2).

    `owner` (m, 2) is what a reader could take a label to belong to: it stands nearer to its own than to another's.
    """

    symbol: str
    subscript: str
    anchors: Array
    away: Array
    colour: str
    css: str
    owner: Array = field(default_factory=lambda: np.zeros((0, 2)))

    @property
    def size(self) -> Array:
        """Estimated width and height [px]."""
        return np.array([text_width(self.symbol, SIZE) + text_width(self.subscript, SUB), SIZE])


@dataclass(frozen=True, eq=False)
class Placed:
    """A label with its `centre` (2,) and the anchor it belongs to [px]."""

    label: Label
    centre: Array
    anchor: Array

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom [px]."""
        low, high = self.centre - self.label.size / 2, self.centre + self.label.size / 2
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def symbol_of(name: str) -> tuple[str, str]:
    r"""A parameter's letter and its subscript: "a1" is a with 1, "alpha2" the Greek letter with 2, "L" just L."""
    match = re.fullmatch(r"(?:\\mathrm\{(\w+)\}|(\\?)(\w+?))(?:_\{?(\d+)\}?)?", latex_name(name))
    if match is None:
        return name, ""
    word, greek, letter, subscript = match.groups(default="")
    return unicodedata.lookup(
        f"GREEK SMALL LETTER {letter.upper()}"
    ) if greek else word or letter, subscript


def text_width(text: str, size: float) -> float:
    """An estimate on the safe side of a text's width [px]."""
    return size * sum(
        0.36 if c in NARROW else 0.92 if c in WIDE else 0.7 if c.isupper() else 0.53 for c in text
    )


@dataclass(frozen=True, eq=False)
class _Offers:
    """Where a label may stand: `centres` (k, 2), the anchors they belong to, and the price but for other labels."""

    centres: Array
    anchors: Array
    price: Array


def place(labels: Sequence[Label], ink: Array, width: float) -> list[Placed]:
    """Where each label stands: clear of the others and of the margins, near its anchor, on as little ink as can be.

    `ink` is counted on cells centred on the origin, in a picture `width` pixels wide. Each label is placed given the
    others, then twice more, now that all have a place.
    """
    total = np.zeros((ink.shape[0] + 1, ink.shape[1] + 1))
    total[1:, 1:] = ink.cumsum(0).cumsum(1)
    offers = [_offers(labels, k, RINGS, total, width) for k in range(len(labels))]
    placed: dict[int, Placed] = {}
    for _ in range(3):
        for k, label in enumerate(labels):
            placed.pop(k, None)
            boxes = np.array([other.box for other in placed.values()]).reshape(-1, 4)
            offer, rings = offers[k], RINGS
            while not (free := _free(offer, label.size / 2, boxes)).any():
                # There is always room farther up or down: the picture grows with its labels.
                rings = rings * 1.5
                offer = _offers(labels, k, rings, total, width)
            best = int(np.argmin(np.where(free, offer.price, np.inf)))
            placed[k] = Placed(label, offer.centres[best], offer.anchors[best])
    return [placed[k] for k in range(len(labels))]


def _offers(labels: Sequence[Label], k: int, rings: Array, total: Array, width: float) -> _Offers:
    """What label `k` is offered; `total` (rows + 1, columns + 1) is the ink above and to the left of each cell."""
    label, grid = labels[k], total[1:, 1:]
    half = label.size / 2
    box = np.sign(DIRECTIONS.round(6)) * np.minimum(half, np.abs(DIRECTIONS) * half.sum())
    centres = label.anchors[:, None, None] + (rings[:, None, None] * DIRECTIONS + box)
    towards = (label.away @ DIRECTIONS.T)[:, None]
    rank = 1.5 * np.arange(float(len(label.anchors)))[:, None, None]
    price = (rings[:, None] - 5 * towards + rank).reshape(-1)
    anchors = np.broadcast_to(label.anchors[:, None, None], centres.shape).reshape(-1, 2)
    centres = centres.reshape(-1, 2)
    rivals = np.vstack([np.zeros((0, 2)), *(other.owner for other in labels if other is not label)])
    if len(label.owner) and len(rivals):
        price = price + 1.6 * np.maximum(
            0, _nearest(centres, label.owner) + 5 - _nearest(centres, rivals)
        )
    (top, left), (bottom, right) = cells(centres - half - 1, grid), cells(centres + half + 1, grid)
    under = (
        total[bottom + 1, right + 1]
        - total[top, right + 1]
        - total[bottom + 1, left]
        + total[top, left]
    )
    price = price + 0.8 * under
    # A label too wide for the picture keeps to its middle.
    edge = max(width / 2 - 2 - float(half[0]), 0.0)
    inside = np.clip(centres[:, 0], -edge, edge)
    price = price + np.where(inside == centres[:, 0], 0.0, 25.0)
    return _Offers(np.column_stack([inside, centres[:, 1]]), anchors, price)


def _nearest(points: Array, others: Array) -> Array:
    """The distance of each of `points` (k, 2) from the nearest of `others` (m, 2)."""
    return np.sqrt(((points[:, None] - others) ** 2).sum(-1).min(1))


def _free(offer: _Offers, half: Array, boxes: Array) -> NDArray[np.bool_]:
    """Which of the offers lie a pixel or more from the `boxes` (m, 4)."""
    low, high = offer.centres - half - 1, offer.centres + half + 1
    beside = (low[:, None, 0] >= boxes[:, 2]) | (high[:, None, 0] <= boxes[:, 0])
    above = (low[:, None, 1] >= boxes[:, 3]) | (high[:, None, 1] <= boxes[:, 1])
    return np.all(beside | above, axis=1)
