"""A painter: solids, strokes and labels in camera pixels, put in order of depth and written as SVG.

Camera coordinates are x to the right, y down, z towards the viewer, in pixels of the final drawing.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from hashlib import blake2s
from html import escape
from itertools import groupby
from math import atan2, degrees, hypot, pi, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CELL = 3.0  # [px] of the grid on which depths are compared and ink is counted
LIGHT = np.array([-0.42, -0.55, 0.72])  # near enough a unit vector: from above, from the left
FONTS = "'Libertinus Serif','STIX Two Text','Times New Roman',serif"
SIZE, SUB = 16.0, 11.0  # [px] of a symbol and of its subscript
NARROW, WIDE = frozenset("fijlrtI'.,()[]-"), frozenset("mwMW@%")
ILLEGAL_IN_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
RINGS = np.array([3.0, 6, 9, 14, 20, 28, 38, 50, 65])  # [px] from an anchor to the label's near side
DIRECTIONS = np.column_stack([np.cos(np.arange(24.0) * (pi / 12)), np.sin(np.arange(24.0) * (pi / 12))])


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


class Scene:
    """What is painted so far, `width` pixels wide and centred on the origin."""

    def __init__(self, width: float) -> None:
        """An empty picture."""
        self.width = width
        self.items: list[Item] = []
        self.overlays: list[str] = []
        self.labels: list[Label] = []
        self.gradients: list[str] = []
        self._half = int(1.2 * width / CELL) + 2
        self.ink: Array = np.zeros((2 * self._half, 2 * self._half))
        self.low, self.high = np.array([np.inf, np.inf]), np.array([-np.inf, -np.inf])

    def tube(
        self,
        a: Array,
        b: Array,
        radius: float,
        *,
        colour: str,
        css: str,
        group: str,
        rounded: tuple[bool, bool] = (False, False),
        facets: int = 10,
        capped: bool = False,
    ) -> Array:
        """Adds a cylinder from `a` to `b` and returns its half-spaces (k, 4), normal . p <= c.

        Its ends are flat or rounded; `capped` shows the face of a flat end.
        """
        d = unit(b - a)
        u = unit(d[:2]) if hypot(d[0], d[1]) > 1e-9 else np.array([1.0, 0.0])
        side = radius * np.array([-u[1], u[0]])
        tilt, turn = abs(float(d[2])), degrees(atan2(u[1], u[0]))
        arc = [f"A{n(radius if r else max(radius * tilt, 0.05))} {n(radius)} {n(turn)} 0 0 " for r in rounded]
        path = (
            f"M{pair(a + lifted(side))}L{pair(b + lifted(side))}{arc[1]}{pair(b - lifted(side))}"
            f"L{pair(a - lifted(side))}{arc[0]}{pair(a + lifted(side))}Z"
        )
        dark = tint(colour, 0.45)
        body = f'<path d="{path}" fill="{self._gradient(a[:2], side, d, colour)}"/>'
        if capped and tilt > 0.02:
            end, face = (b, d) if d[2] > 0 else (a, -d)
            body += (
                f'<ellipse rx="{n(radius * tilt)}" ry="{n(radius)}" fill="{shade(colour, face)}" stroke="{dark}" '
                f'stroke-width=".7" transform="translate({pair(end)}) rotate({n(turn)})"/>'
            )
        outline = f'<path d="{path}" fill="{dark}" stroke="{dark}" stroke-width="1.4"/>'
        planes = tube_planes(a, b, radius, facets)
        planes[-2:, 3] += [radius * rounded[1], radius * rounded[0]]
        corners = np.stack([np.minimum(a, b)[:2] - radius, np.maximum(a, b)[:2] + radius])
        # Thinner than a cell it could slip between the middles of the cells, and out of the order.
        seen = planes + np.array([0.0, 0.0, 0.0, max(0.75 * CELL - radius, 0.0)])
        svg = (outline, f'<g class="{css}">{body}</g>')
        self._solid(svg, seen, corners, middle=(a + b) / 2, group=group)
        return planes

    def box(self, centre: Array, axes: Array, half: Array, *, colour: str, css: str, group: str) -> Array:
        """Adds a box with the columns of `axes` (3, 3) as its directions; returns its half-spaces (6, 4)."""
        normals = np.hstack([axes, -axes]).T
        dark, body = tint(colour, 0.45), ""
        corners: list[Array] = []
        for k in np.flatnonzero(normals[:, 2] > 1e-6):
            middle = centre + normals[k] * half[k % 3]
            u, v = (axes[:, j] * half[j] for j in range(3) if j != k % 3)
            face = [middle + u + v, middle + u - v, middle - u - v, middle - u + v]
            corners += [p[:2] for p in face]
            points, fill = " ".join(pair(p) for p in face), shade(colour, normals[k])
            body += f'<polygon points="{points}" fill="{fill}" stroke="{dark}" stroke-width=".8"/>'
        planes = np.column_stack([normals, normals @ centre + np.tile(half, 2)])
        svg = ("", f'<g class="{css}">{body}</g>')
        self._solid(svg, planes, np.array(corners), middle=centre, group=group)
        return planes

    def stroke(
        self,
        points: Array,
        thick: float,
        *,
        colour: str,
        css: str,
        group: str,
        dashes: str = "",
        halo: float = 0.0,
        lift: float = 0.0,
    ) -> None:
        """Adds a line through `points` (k, 3), hidden by what stands more than `lift` before it."""
        fine = every_pixel(points)
        cells = np.floor(fine[:, :2] / CELL).astype(np.int64)
        corner, last = cells.min(0), cells.max(0)
        front = np.full((last[1] - corner[1] + 1, last[0] - corner[0] + 1), -np.inf)
        np.maximum.at(front, (cells[:, 1] - corner[1], cells[:, 0] - corner[0]), fine[:, 2] + lift)
        path = f'd="M{"L".join(pair(p) for p in points)}" fill="none"'
        pattern = f' stroke-dasharray="{dashes}"' if dashes else ""
        line = f'<path class="{css}" {path} stroke="{colour}" stroke-width="{n(thick)}"{pattern}/>'
        wide = f'<path {path} stroke="#fff" stroke-width="{n(thick + 2 * halo)}" stroke-linecap="butt"/>'
        self.items.append(Item(wide if halo else "", line, (int(corner[1]), int(corner[0])), front, group))
        self.mark(points[:, :2], 1.5)

    def overlay(self, svg: str, points: Array, weight: float = 3.0) -> None:
        """Adds `svg` above everything but the labels; `points` (k, 2) is the line that labels keep clear of."""
        self.overlays.append(svg)
        self.mark(points, weight)

    def mark(self, points: Array, weight: float) -> None:
        """Counts ink along the line through `points` (k, 2)."""
        row, column = self.cells(every_pixel(points))
        self.ink[row, column] = np.maximum(self.ink[row, column], weight)
        self._stretch(points)

    def ink_at(self, points: Array) -> Array:
        """The ink (...) at `points` (..., 2)."""
        return self.ink[self.cells(points)]

    def emerging(self, a: Array, b: Array) -> Array:
        """The first point between `a` and `b` (2,) without ink; `b` if there is none."""
        fine = every_pixel(np.stack([a, b]))
        free = np.flatnonzero(self.ink_at(fine) == 0)
        return fine[free[0]] if len(free) else b

    def cells(self, points: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Row and column (...) of `points` (..., 2) in `ink`."""
        cells = np.clip(np.floor(points / CELL).astype(np.int64) + self._half, 0, 2 * self._half - 1)
        return cells[..., 1], cells[..., 0]

    def svg(self, title: str, description: str) -> str:
        """The picture, cut to what is in it, with `title` and `description` for those who cannot see it."""
        placed = place(self)
        boxes = np.array([label.box for label in placed]).reshape(-1, 2, 2)
        top = min(float(self.low[1]), float(boxes[:, 0, 1].min(initial=np.inf))) - 6
        height = max(float(self.high[1]), float(boxes[:, 1, 1].max(initial=-np.inf))) + 6 - top
        painted = "\n".join([*_welded(by_depth(self.items)), *self.overlays])
        shades = "\n".join(f'<linearGradient id="\0{i}"{g}' for i, g in enumerate(self.gradients))
        # Several drawings can stand on one page: the names of their gradients come from what they show.
        name = "k" + blake2s((shades + painted).encode(), digest_size=4).hexdigest() + "-"
        drawing = f"<defs>{shades}</defs>\n{painted}".replace("\0", name)
        words = "\n".join([leader for leader in map(_leader, placed) if leader] + [_text(label) for label in placed])
        frame = f"{n(-self.width / 2)} {n(top)} {n(self.width)} {n(height)}"
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{frame}" width="{n(self.width)}" height="{n(height)}" '
            f'role="img"><title>{text_xml(title)}</title><desc>{text_xml(description)}</desc>\n'
            f'<g stroke-linejoin="round" stroke-linecap="round" font-family="{FONTS}">\n{drawing}\n{words}\n'
            "</g></svg>\n"
        )

    def _stretch(self, points: Array) -> None:
        self.low, self.high = np.minimum(self.low, points.min(0)), np.maximum(self.high, points.max(0))

    def _gradient(self, foot: Array, side: Array, d: Array, colour: str) -> str:
        """The paint of a tube along `d` whose silhouette reaches `side` (2,) to either side of `foot`."""
        across = unit(lifted(side))
        up = cross(d, across)
        up = -up if up[2] < 0 else up
        stops = "".join(
            f'<stop offset="{n((x + 1) / 2)}" stop-color="{shade(colour, x * across + sqrt(1 - x * x) * up)}"/>'
            for x in (-1.0, -0.6, -0.2, 0.2, 0.6, 1.0)
        )
        (x1, y1), (x2, y2) = foot - side, foot + side
        ends = f'x1="{n(x1)}" y1="{n(y1)}" x2="{n(x2)}" y2="{n(y2)}"'
        self.gradients.append(f' gradientUnits="userSpaceOnUse" {ends}>{stops}</linearGradient>')
        return f"url(#\0{len(self.gradients) - 1})"

    def _solid(self, svg: tuple[str, str], planes: Array, corners: Array, *, middle: Array, group: str) -> None:
        corner, front = _depths(planes, corners.min(0), corners.max(0))
        if not np.isfinite(front).any():
            corner, front = (int(middle[1] // CELL), int(middle[0] // CELL)), np.array([[middle[2]]])
        self.items.append(Item(*svg, corner, front, group))
        rows, columns = np.nonzero(np.isfinite(front))
        row, column = rows + (corner[0] + self._half), columns + (corner[1] + self._half)
        inside = (np.minimum(row, column) >= 0) & (np.maximum(row, column) < 2 * self._half)
        row, column = row[inside], column[inside]
        # What moves and what grips is worth more than a link: labels and arrows keep clear of it.
        weight = 2.0 if group.startswith(("joint", "gripper")) else 1.0
        self.ink[row, column] = np.maximum(self.ink[row, column], weight)
        self._stretch(corners)


def camera(azimuth: float, elevation: float) -> Array:
    """The rotation (3, 3) from base to camera coordinates, for angles in degrees."""
    az, el = np.radians([azimuth, elevation])
    towards = np.array([np.cos(el) * np.cos(az), np.cos(el) * np.sin(az), np.sin(el)])
    right = np.array([-np.sin(az), np.cos(az), 0.0])
    return np.stack([right, -cross(towards, right), towards])


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


def n(value: float) -> str:
    """A coordinate with one decimal and no needless zero."""
    text = f"{value:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


def pair(p: Array) -> str:
    """The first two coordinates of `p`."""
    return f"{n(p[0])} {n(p[1])}"


def text_xml(text: str) -> str:
    """`text` escaped for XML, characters that XML cannot carry replaced."""
    return escape(ILLEGAL_IN_XML.sub("\ufffd", text))


def text_width(text: str, size: float) -> float:
    """An estimate on the safe side of a text's width [px]."""
    return size * sum(0.36 if c in NARROW else 0.92 if c in WIDE else 0.7 if c.isupper() else 0.53 for c in text)


def shade(colour: str, normal: Array) -> str:
    """`colour` (#rrggbb) as lit on a surface with that unit normal."""
    return tint(colour, 0.6 + 0.55 * max(0.0, float(LIGHT @ normal)))


def tint(colour: str, factor: float) -> str:
    """`colour` (#rrggbb) darkened by a factor below 1, or lightened towards white by one between 1 and 2."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(c * factor if factor < 1 else c + (255 - c) * (factor - 1)):02x}" for c in rgb)


def every_pixel(points: Array) -> Array:
    """Points about a pixel apart along the line through `points` (k, 2 or 3)."""
    reach = np.concatenate([[0.0], np.sqrt(((points[1:] - points[:-1]) ** 2).sum(1)).cumsum()])
    at = spaced(0.0, float(reach[-1]), int(reach[-1]) + 2)
    return np.column_stack([np.interp(at, reach, points[:, k]) for k in range(points.shape[1])])


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


def _depths(planes: Array, low: Array, high: Array) -> tuple[tuple[int, int], Array]:
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
    of_a = a.front[top - a.corner[0] : bottom - a.corner[0], left - a.corner[1] : right - a.corner[1]]
    of_b = b.front[top - b.corner[0] : bottom - b.corner[0], left - b.corner[1] : right - b.corner[1]]
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
        free = [i for i in left if not behind[i]] or [min(left, key=lambda i: (sum(behind[i].values()), i))]
        i = min((items[i].group != group, middle[i], i) for i in free)[2]
        left.remove(i)
        for claims in behind:
            claims.pop(i, None)
        order.append(items[i])
        group = items[i].group
    return order


def _welded(items: Iterable[Item]) -> list[str]:
    out: list[str] = []
    for _, group in groupby(items, key=lambda item: item.group):
        members = list(group)
        out += [item.outline for item in members if item.outline] + [item.body for item in members]
    return out


@dataclass(frozen=True, eq=False)
class _Offers:
    """Where a label may stand: `centres` (k, 2), the anchors they belong to, and the price but for other labels."""

    centres: Array
    anchors: Array
    price: Array


def place(scene: Scene) -> list[Placed]:
    """Where each label stands: clear of the others and of the margins, near its anchor, on as little ink as can be.

    Each is placed given the others, then twice more, now that all have a place.
    """
    total = np.zeros((scene.ink.shape[0] + 1, scene.ink.shape[1] + 1))
    total[1:, 1:] = scene.ink.cumsum(0).cumsum(1)
    offers = [_offers(scene, k, RINGS, total) for k in range(len(scene.labels))]
    placed: dict[int, Placed] = {}
    for _ in range(3):
        for k, label in enumerate(scene.labels):
            placed.pop(k, None)
            boxes = np.array([other.box for other in placed.values()]).reshape(-1, 4)
            offer, rings = offers[k], RINGS
            while not (free := _free(offer, label.size / 2, boxes)).any():
                # There is always room farther up or down: the picture grows with its labels.
                rings = rings * 1.5
                offer = _offers(scene, k, rings, total)
            best = int(np.argmin(np.where(free, offer.price, np.inf)))
            placed[k] = Placed(label, offer.centres[best], offer.anchors[best])
    return [placed[k] for k in range(len(scene.labels))]


def _offers(scene: Scene, k: int, rings: Array, total: Array) -> _Offers:
    label = scene.labels[k]
    half = label.size / 2
    box = np.sign(DIRECTIONS.round(6)) * np.minimum(half, np.abs(DIRECTIONS) * half.sum())
    centres = label.anchors[:, None, None] + (rings[:, None, None] * DIRECTIONS + box)
    towards = (label.away @ DIRECTIONS.T)[:, None]
    rank = 1.5 * np.arange(float(len(label.anchors)))[:, None, None]
    price = (rings[:, None] - 5 * towards + rank).reshape(-1)
    anchors = np.broadcast_to(label.anchors[:, None, None], centres.shape).reshape(-1, 2)
    centres = centres.reshape(-1, 2)
    rivals = np.vstack([np.zeros((0, 2)), *(other.owner for other in scene.labels if other is not label)])
    if len(label.owner) and len(rivals):
        price = price + 1.6 * np.maximum(0, _nearest(centres, label.owner) + 5 - _nearest(centres, rivals))
    (top, left), (bottom, right) = scene.cells(centres - half - 1), scene.cells(centres + half + 1)
    under = total[bottom + 1, right + 1] - total[top, right + 1] - total[bottom + 1, left] + total[top, left]
    price = price + 0.8 * under
    # A label too wide for the picture keeps to its middle.
    edge = max(scene.width / 2 - 2 - float(half[0]), 0.0)
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


def _leader(placed: Placed) -> str:
    """A thin line to the anchor of a label that had to stand far from it."""
    left, top, right, bottom = placed.box
    near = np.array([np.clip(placed.anchor[0], left, right), np.clip(placed.anchor[1], top, bottom)])
    if norm(near - placed.anchor) < 13:
        return ""
    line = f'd="M{pair(near)}L{pair(placed.anchor)}"'
    return f'<path class="leader" {line} stroke="{placed.label.colour}" stroke-width=".6"/>'


def _text(placed: Placed) -> str:
    label, (x, y) = placed.label, placed.centre
    words = f'<tspan font-style="italic">{text_xml(label.symbol)}</tspan>'
    if label.subscript:
        words += f'<tspan dy="3.6" font-size="{n(SUB)}">{text_xml(label.subscript)}</tspan>'
    text = f'<text x="{n(x)}" y="{n(y + 0.24 * SIZE)}" font-size="{n(SIZE)}" text-anchor="middle"'
    # The halo is a text of its own: paint-order is not understood everywhere.
    return (
        f'<g class="label {label.css}">{text} fill="#fff" stroke="#fff" stroke-width="3.4">{words}</text>'
        f'{text} fill="{label.colour}">{words}</text></g>'
    )
