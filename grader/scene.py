"""A painter: solids, strokes and labels in camera pixels, put in order of depth and written as SVG.

Camera coordinates are x to the right, y down, z towards the viewer, in pixels of the final drawing.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from hashlib import blake2s
from html import escape
from itertools import groupby
from math import atan2, degrees, hypot, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

CELL = 3.0  # [px] of the grid on which depths are compared and ink is counted
LIGHT = np.array([-0.42, -0.55, 0.72]) / np.linalg.norm([-0.42, -0.55, 0.72])
FONTS = "'Libertinus Serif','STIX Two Text','Times New Roman',serif"
SIZE, SUB = 16.0, 11.0  # [px] of a symbol and of its subscript
NARROW, WIDE = frozenset("fijlrtI'.,()[]-"), frozenset("mwMW@%")
ILLEGAL_IN_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


@dataclass(frozen=True, eq=False)
class Item:
    """Something painted in order of depth.

    `front` (rows, columns) is its depth on the cells it covers from `corner` (row, column) on, -inf where it
    does not. Neighbours of one `group` paint their outlines before their bodies, so that they look welded.
    """

    outline: str
    body: str
    corner: tuple[int, int]
    front: Array
    group: str
    planes: Array | None = None


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
        """The estimated width and height [px]."""
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


def camera(azimuth: float, elevation: float) -> Array:
    """The rotation (3, 3) from base to camera coordinates, for angles in degrees."""
    az, el = np.radians([azimuth, elevation])
    towards = np.array([np.cos(el) * np.cos(az), np.cos(el) * np.sin(az), np.sin(el)])
    right = np.array([-np.sin(az), np.cos(az), 0.0])
    return np.stack([right, -np.cross(towards, right), towards])


def text_width(text: str, size: float) -> float:
    """An estimate on the safe side of a text's width [px]."""
    em = sum(0.36 if c in NARROW else 0.92 if c in WIDE else 0.7 if c.isupper() else 0.53 for c in text)
    return em * size


def shade(colour: str, normal: ArrayLike) -> str:
    """`colour` (#rrggbb) as lit on a surface with that unit normal."""
    light = 0.6 + 0.55 * max(0.0, float(LIGHT @ np.asarray(normal, dtype=np.float64)))
    return tint(colour, light)


def tint(colour: str, factor: float) -> str:
    """`colour` (#rrggbb) darkened (factor below 1) or lightened towards white."""
    rgb = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)], dtype=np.float64)
    rgb = rgb * factor if factor < 1 else rgb + (255 - rgb) * (factor - 1)
    red, green, blue = (int(c) for c in np.clip(rgb, 0, 255).round())
    return f"#{red:02x}{green:02x}{blue:02x}"


def text_xml(text: str) -> str:
    """`text` escaped for XML, characters that XML cannot carry replaced."""
    return escape(ILLEGAL_IN_XML.sub("\ufffd", text))


def n(value: float) -> str:
    """A coordinate with one decimal and no needless zero."""
    text = f"{value:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


def pair(p: Array) -> str:
    return f"{n(float(p[0]))} {n(float(p[1]))}"


def unit(v: Array) -> Array:
    """`v` over its length; zero stays zero."""
    length = float(np.linalg.norm(v))
    return v / length if length > 1e-12 else np.zeros_like(v)


def square_to(d: Array) -> tuple[Array, Array]:
    """Two unit vectors square to the unit vector `d` and to each other."""
    helper = np.eye(3)[int(np.argmin(np.abs(d)))]
    u = unit(np.cross(d, helper))
    return u, np.cross(d, u)


def tube_planes(a: Array, b: Array, radius: float, facets: int) -> Array:
    """The half-spaces normal . p <= c, as rows (normal, c), of a cylinder from `a` to `b`."""
    d = unit(b - a)
    u, v = square_to(d)
    turn = np.arange(facets) * (2 * pi / facets)
    normals = np.vstack([np.outer(np.cos(turn), u) + np.outer(np.sin(turn), v), d, -d])
    c = np.concatenate([normals[:-2] @ a + radius, [d @ b, -d @ a]])
    return np.column_stack([normals, c])


def span_inside(a: Array, b: Array, planes: Array) -> tuple[float, float] | None:
    """The part (from, to) in [0, 1] of the segment that lies inside the half-spaces, or None."""
    at_a, along = planes[:, 3] - planes[:, :3] @ a, planes[:, :3] @ (b - a)
    parallel = np.abs(along) < 1e-9
    if np.any(at_a[parallel] < 0):
        return None
    t = at_a[~parallel] / along[~parallel]
    leaving = along[~parallel] > 0
    last, first = float(np.min(t[leaving], initial=1.0)), float(np.max(t[~leaving], initial=0.0))
    return (first, last) if first < last else None


def outside(a: Array, b: Array, solids: Iterable[Array]) -> list[tuple[float, float]]:
    """The parts (from, to) in [0, 1] of the segment that lie outside every one of the `solids`' planes."""
    parts = [(0.0, 1.0)]
    for planes in solids:
        hidden = span_inside(a, b, planes)
        if hidden is not None:
            first, last = hidden
            parts = [cut for f, t in parts for cut in ((f, min(t, first)), (max(f, last), t))]
            parts = [(f, t) for f, t in parts if t - f > 1e-9]
    return parts


def _depths(planes: Array, low: Array, high: Array) -> tuple[tuple[int, int], Array]:
    first, last = np.floor(low[:2] / CELL).astype(int), np.floor(high[:2] / CELL).astype(int)
    x = (np.arange(first[0], last[0] + 1) + 0.5) * CELL
    y = (np.arange(first[1], last[1] + 1) + 0.5) * CELL
    room = planes[:, 3, None, None] - planes[:, 0, None, None] * x - planes[:, 1, None, None] * y[:, None]
    slope = planes[:, 2]
    near, far = slope > 1e-9, slope < -1e-9
    front = np.min(room[near] / slope[near, None, None], axis=0, initial=np.inf)
    back = np.max(room[far] / slope[far, None, None], axis=0, initial=-np.inf)
    covered = (front >= back) & np.all(room[~near & ~far] >= 0, axis=0) & np.isfinite(front)
    return (int(first[1]), int(first[0])), np.where(covered, front, -np.inf)


def _in_front(a: Item, b: Item) -> float:
    """How clearly `a` hides `b`: positive, `b` hides `a`: negative, no cell shared: 0."""
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
            if score > 0:
                behind[i][j] = score
            elif score < 0:
                behind[j][i] = -score
    middle = [float(np.mean(item.front[np.isfinite(item.front)])) for item in items]
    order: list[Item] = []
    left, group = set(range(len(items))), ""
    while left:
        free = [i for i in left if not behind[i]] or [min(left, key=lambda i: (sum(behind[i].values()), i))]
        i = min(free, key=lambda i: (items[i].group != group, middle[i], i))
        left.remove(i)
        for claims in behind:
            claims.pop(i, None)
        order.append(items[i])
        group = items[i].group
    return order


class Scene:
    """What is painted so far, `width` pixels wide and centred on the origin."""

    def __init__(self, width: float) -> None:
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
        colour: str,
        css: str,
        group: str,
        *,
        rounded: tuple[bool, bool] = (False, False),
        facets: int = 10,
        capped: bool = False,
    ) -> Item:
        """Adds a cylinder from `a` to `b`, its ends flat or rounded; `capped` shows the face of a flat end."""
        d = unit(b - a)
        u = unit(d[:2]) if hypot(d[0], d[1]) > 1e-9 else np.array([1.0, 0.0])
        side = np.array([-u[1], u[0]])
        tilt, turn = abs(float(d[2])), degrees(atan2(u[1], u[0]))
        fill = self._gradient(a[:2], side, radius, d, colour)
        bulge = [radius if end else max(radius * tilt, 0.05) for end in rounded]
        arc = [f"A{n(r)} {n(radius)} {n(turn)} 0 0 " for r in bulge]
        left, right = radius * side, -radius * side
        path = (
            f"M{pair(a[:2] + left)}L{pair(b[:2] + left)}{arc[1]}{pair(b[:2] + right)}"
            f"L{pair(a[:2] + right)}{arc[0]}{pair(a[:2] + left)}Z"
        )
        dark = tint(colour, 0.45)
        body = f'<path class="{css}" d="{path}" fill="{fill}"/>'
        if capped and tilt > 0.02:
            end, face = (b, d) if d[2] > 0 else (a, -d)
            body += (
                f'<ellipse rx="{n(radius * tilt)}" ry="{n(radius)}" fill="{shade(colour, face)}" stroke="{dark}" '
                f'stroke-width=".7" transform="translate({pair(end[:2])}) rotate({n(turn)})"/>'
            )
        outline = f'<path d="{path}" fill="{dark}" stroke="{dark}" stroke-width="1.4"/>'
        planes = tube_planes(a, b, radius, facets)
        planes[-2:, 3] += [radius * rounded[1], radius * rounded[0]]
        low, high = np.minimum(a, b)[:2] - radius, np.maximum(a, b)[:2] + radius
        return self._add_solid(outline, body, planes, low, high, group)

    def box(self, centre: Array, axes: Array, half: Array, colour: str, css: str, group: str) -> Item:
        """Adds a box with the columns of `axes` (3, 3) as its directions and `half` (3,) as its half sizes."""
        normals = np.hstack([axes, -axes]).T
        c = normals @ centre + np.tile(half, 2)
        dark, faces = tint(colour, 0.45), ""
        corners: list[Array] = []
        for k, normal in enumerate(normals):
            if normal[2] <= 1e-6:
                continue
            middle = centre + normal * half[k % 3]
            u, v = (axes[:, j] * half[j] for j in range(3) if j != k % 3)
            face = [middle + u + v, middle + u - v, middle - u - v, middle - u + v]
            corners += face
            points = " ".join(pair(p[:2]) for p in face)
            faces += f'<polygon points="{points}" fill="{shade(colour, normal)}" stroke="{dark}" stroke-width=".8"/>'
        flat = np.array(corners)[:, :2]
        planes = np.column_stack([normals, c])
        return self._add_solid("", f'<g class="{css}">{faces}</g>', planes, flat.min(0), flat.max(0), group)

    def stroke(
        self,
        points: Array,
        colour: str,
        thick: float,
        css: str,
        group: str,
        dashes: str = "",
        halo: float = 0,
        lift: float = 0,
    ) -> None:
        """Adds a line through `points` (k, 3), hidden by what stands more than `lift` before it."""
        fine = _every_pixel(points)
        low, high = np.floor(fine[:, :2].min(0) / CELL).astype(int), np.floor(fine[:, :2].max(0) / CELL).astype(int)
        front = np.full((high[1] - low[1] + 1, high[0] - low[0] + 1), -np.inf)
        column, row = (np.floor(fine[:, :2] / CELL).astype(int) - low).T
        np.maximum.at(front, (row, column), fine[:, 2] + lift)
        path = "M" + "L".join(pair(p[:2]) for p in points)
        pattern = f' stroke-dasharray="{dashes}"' if dashes else ""
        line = f'<path class="{css}" d="{path}" fill="none" stroke="{colour}" stroke-width="{n(thick)}"{pattern}/>'
        under = (
            f'<path d="{path}" fill="none" stroke="#fff" stroke-width="{n(thick + 2 * halo)}" stroke-linecap="butt"/>'
            if halo
            else ""
        )
        self.items.append(Item(under, line, (int(low[1]), int(low[0])), front, group))
        self.mark(points[:, :2], 1.5)

    def overlay(self, svg: str, points: Array, weight: float = 3.0) -> None:
        """Adds `svg` above everything but the labels; `points` (k, 2) is the line that labels keep clear of."""
        self.overlays.append(svg)
        self.mark(points, weight)

    def mark(self, points: Array, weight: float) -> None:
        """Counts ink along the line through `points` (k, 2)."""
        fine = _every_pixel(points)
        row, column = self._cells(fine)
        self.ink[row, column] = np.maximum(self.ink[row, column], weight)
        self._stretch(points)

    def ink_along(self, points: Array) -> float:
        """The ink under the line through `points` (k, 2) [px]."""
        return float(self.ink[self._cells(_every_pixel(points))].sum())

    def emerging(self, a: Array, b: Array) -> Array:
        """The first point between `a` and `b` (2,) without ink; `b` if there is none."""
        fine = _every_pixel(np.stack([a, b]))
        free = np.flatnonzero(self.ink[self._cells(fine)] == 0)
        return fine[free[0]] if len(free) else b

    def _cells(self, points: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        cells = np.clip(np.floor(points / CELL).astype(np.int64) + self._half, 0, 2 * self._half - 1)
        return cells[:, 1], cells[:, 0]

    def _stretch(self, points: Array) -> None:
        self.low, self.high = np.minimum(self.low, points.min(0)), np.maximum(self.high, points.max(0))

    def _gradient(self, foot: Array, side: Array, radius: float, d: Array, colour: str) -> str:
        up = np.cross(d, [side[0], side[1], 0.0])
        up = -up if up[2] < 0 else up
        across = np.array([side[0], side[1], 0.0])
        stops = "".join(
            f'<stop offset="{n((x + 1) / 2)}" stop-color="{shade(colour, x * across + (1 - x * x) ** 0.5 * up)}"/>'
            for x in (-1.0, -0.6, -0.2, 0.2, 0.6, 1.0)
        )
        start, end = foot - radius * side, foot + radius * side
        ends = f'x1="{n(start[0])}" y1="{n(start[1])}" x2="{n(end[0])}" y2="{n(end[1])}"'
        self.gradients.append(f' gradientUnits="userSpaceOnUse" {ends}>{stops}</linearGradient>')
        return f"url(#\0{len(self.gradients) - 1})"

    def _add_solid(self, outline: str, body: str, planes: Array, low: Array, high: Array, group: str) -> Item:
        corner, front = _depths(planes, low, high)
        item = Item(outline, body, corner, front, group, planes)
        self.items.append(item)
        rows, columns = np.nonzero(np.isfinite(front))
        middles = np.column_stack([columns + corner[1] + 0.5, rows + corner[0] + 0.5]) * CELL
        row, column = self._cells(middles)
        # A joint's body is worth more than a link: labels and arrows keep clear of it.
        self.ink[row, column] = np.maximum(self.ink[row, column], 2.0 if group.startswith("joint") else 1.0)
        self._stretch(np.array([low, high]))
        return item

    def svg(self, title: str, description: str) -> str:
        """The picture, cut to what is in it, with `title` and `description` for those who cannot see it."""
        placed = place(self)
        boxes = np.array([label.box for label in placed]).reshape(-1, 2, 2)
        top = min(float(self.low[1]), float(boxes[:, 0, 1].min(initial=np.inf))) - 6
        bottom = max(float(self.high[1]), float(boxes[:, 1, 1].max(initial=-np.inf))) + 6
        painted = "\n".join([*_welded(by_depth(self.items)), *self.overlays])
        shades = "\n".join(f'<linearGradient id="\0{i}"{g}' for i, g in enumerate(self.gradients))
        # Several drawings can stand on one page: the names of their gradients come from what they show.
        name = "k" + blake2s((shades + painted).encode(), digest_size=4).hexdigest() + "-"
        drawing = f"<defs>{shades}</defs>\n{painted}".replace("\0", name)
        words = "\n".join([_leader(label) for label in placed] + [_text(label) for label in placed])
        frame = f"{n(-self.width / 2)} {n(top)} {n(self.width)} {n(bottom - top)}"
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{frame}" width="{n(self.width)}" '
            f'height="{n(bottom - top)}" role="img"><title>{text_xml(title)}</title><desc>{text_xml(description)}</desc>\n'
            f'<g stroke-linejoin="round" stroke-linecap="round" font-family="{FONTS}">\n{drawing}\n{words}\n</g></svg>\n'
        )


def _every_pixel(points: Array) -> Array:
    """Points about a pixel apart along the line through `points` (k, 2 or 3)."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    reach = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, reach[-1], int(reach[-1]) + 2)
    return np.column_stack([np.interp(at, reach, column) for column in points.T])


def _welded(items: Iterable[Item]) -> list[str]:
    out: list[str] = []
    for _, group in groupby(items, key=lambda item: item.group):
        members = list(group)
        out += [item.outline for item in members if item.outline] + [item.body for item in members]
    return out


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
            offer = offers[k]
            free = _free(offer, label.size / 2, boxes)
            while not free.any():
                offer = _offers(scene, k, offer.rings * 1.5, total)
                free = _free(offer, label.size / 2, boxes)
            best = int(np.argmin(np.where(free, offer.price, np.inf)))
            placed[k] = Placed(label, offer.centres[best], offer.anchors[best])
    return [placed[k] for k in range(len(scene.labels))]


RINGS = np.array([3.0, 6, 9, 14, 20, 28, 38, 50, 65])
DIRECTIONS = np.column_stack([np.cos(np.arange(24) * (pi / 12)), np.sin(np.arange(24) * (pi / 12))])


@dataclass(frozen=True, eq=False)
class _Offers:
    """Where a label may stand: `centres` (k, 2), the anchors they belong to, what they cost but for the other labels."""

    centres: Array
    anchors: Array
    price: Array
    rings: Array


def _offers(scene: Scene, k: int, rings: Array, total: Array) -> _Offers:
    label = scene.labels[k]
    half = label.size / 2
    # The box stands `ring` beyond the anchor: its near side touches the ring.
    box = np.sign(DIRECTIONS.round(6)) * np.minimum(half, np.abs(DIRECTIONS) * half.sum())
    reach = rings[:, None, None] * DIRECTIONS + box
    centres = label.anchors[:, None, None] + reach
    towards = np.einsum("ki,di->kd", label.away, DIRECTIONS)[:, None]
    rank = 1.5 * np.arange(len(label.anchors))[:, None, None]
    price = (rings[:, None] - 5 * towards + rank).reshape(-1)
    anchors = np.broadcast_to(label.anchors[:, None, None], centres.shape).reshape(-1, 2)
    centres = centres.reshape(-1, 2)
    rivals = np.vstack([np.zeros((0, 2)), *(other.owner for other in scene.labels if other is not label)])
    if len(label.owner) and len(rivals):
        price = price + 1.6 * np.maximum(0, _nearest(centres, label.owner) + 5 - _nearest(centres, rivals))
    price = price + 0.8 * _ink_under(scene, centres, half, total)
    price[np.abs(centres[:, 0]) + half[0] > scene.width / 2 - 2] = np.inf
    return _Offers(centres, anchors, price, rings)


def _nearest(points: Array, others: Array) -> Array:
    """The distance of each of `points` (k, 2) from the nearest of `others` (m, 2)."""
    return np.sqrt(((points[:, None] - others) ** 2).sum(-1).min(1))


def _free(offer: _Offers, half: Array, boxes: Array) -> NDArray[np.bool_]:
    """Which of the offers lie inside the picture and a pixel or more from the `boxes` (m, 4)."""
    low, high = offer.centres - half - 1, offer.centres + half + 1
    apart = (
        (low[:, None, 0] >= boxes[:, 2]) | (high[:, None, 0] <= boxes[:, 0])
        | (low[:, None, 1] >= boxes[:, 3]) | (high[:, None, 1] <= boxes[:, 1])
    )  # fmt: skip
    return np.isfinite(offer.price) & apart.all(1)


def _ink_under(scene: Scene, centres: Array, half: Array, total: Array) -> Array:
    top, left = scene._cells(centres - half - 1)
    bottom, right = scene._cells(centres + half + 1)
    return total[bottom + 1, right + 1] - total[top, right + 1] - total[bottom + 1, left] + total[top, left]


def _leader(placed: Placed) -> str:
    """A thin line to the anchor of a label that had to stand far from it."""
    left, top, right, bottom = placed.box
    near = np.clip(placed.anchor, [left, top], [right, bottom])
    if np.linalg.norm(near - placed.anchor) < 13:
        return ""
    return f'<path class="leader" d="M{pair(near)}L{pair(placed.anchor)}" stroke="{placed.label.colour}" stroke-width=".6"/>'


def _text(placed: Placed) -> str:
    label, (x, y) = placed.label, placed.centre
    words = f'<tspan font-style="italic">{text_xml(label.symbol)}</tspan>'
    if label.subscript:
        words += f'<tspan dy="3.6" font-size="{n(SUB)}">{text_xml(label.subscript)}</tspan>'
    text = f'<text x="{n(x)}" y="{n(y + 0.24 * SIZE)}" font-size="{n(SIZE)}" text-anchor="middle"'
    return (
        f'<g class="label {label.css}">{text} fill="#fff" stroke="#fff" stroke-width="3.4" aria-hidden="true">{words}</text>'
        f'{text} fill="{label.colour}">{words}</text></g>'
    )
