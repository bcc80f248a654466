"""A painter: solids, strokes and labels in camera pixels, put in order of depth and written as SVG."""

import re
from hashlib import blake2s
from html import escape
from math import atan2, degrees, hypot, sqrt

import numpy as np

from .depth import (
    CELL,
    Array,
    Item,
    by_depth,
    cells,
    cross,
    depths,
    every_pixel,
    lifted,
    norm,
    tube_planes,
    unit,
    welded,
)
from .labels import SIZE, SUB, Label, Placed, place

LIGHT = np.array([-0.42, -0.55, 0.72])  # near enough a unit vector: from above, from the left
FONTS = "'Libertinus Serif','STIX Two Text','Times New Roman',serif"
ILLEGAL_IN_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


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
        svg = self._cylinder(a, b, radius, colour=colour, css=css, rounded=rounded, capped=capped)
        planes = tube_planes(a, b, radius, facets)
        planes[-2:, 3] += [radius * rounded[1], radius * rounded[0]]
        corners = np.stack([np.minimum(a, b)[:2] - radius, np.maximum(a, b)[:2] + radius])
        # Thinner than a cell it could slip between the middles of the cells, and out of the order.
        seen = planes + np.array([0.0, 0.0, 0.0, max(0.75 * CELL - radius, 0.0)])
        self._solid(svg, seen, corners, middle=(a + b) / 2, group=group)
        return planes

    def box(
        self, centre: Array, axes: Array, half: Array, *, colour: str, css: str, group: str
    ) -> Array:
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
        at = np.floor(fine[:, :2] / CELL).astype(np.int64)
        corner, last = at.min(0), at.max(0)
        front = np.full((last[1] - corner[1] + 1, last[0] - corner[0] + 1), -np.inf)
        np.maximum.at(front, (at[:, 1] - corner[1], at[:, 0] - corner[0]), fine[:, 2] + lift)
        path = f'd="M{"L".join(pair(p) for p in points)}" fill="none"'
        pattern = f' stroke-dasharray="{dashes}"' if dashes else ""
        line = f'<path class="{css}" {path} stroke="{colour}" stroke-width="{n(thick)}"{pattern}/>'
        wide = f'<path {path} stroke="#fff" stroke-width="{n(thick + 2 * halo)}" stroke-linecap="butt"/>'
        self.items.append(
            Item(wide if halo else "", line, (int(corner[1]), int(corner[0])), front, group)
        )
        self.mark(points[:, :2], 1.5)

    def overlay(self, svg: str, points: Array, weight: float = 3.0) -> None:
        """Adds `svg` above everything but the labels; `points` (k, 2) is the line that labels keep clear of."""
        self.overlays.append(svg)
        self.mark(points, weight)

    def mark(self, points: Array, weight: float) -> None:
        """Counts ink along the line through `points` (k, 2)."""
        row, column = cells(every_pixel(points), self.ink)
        self.ink[row, column] = np.maximum(self.ink[row, column], weight)
        self._stretch(points)

    def ink_at(self, points: Array) -> Array:
        """The ink (...) at `points` (..., 2)."""
        return self.ink[cells(points, self.ink)]

    def emerging(self, a: Array, b: Array) -> Array:
        """The first point between `a` and `b` (2,) without ink; `b` if there is none."""
        fine = every_pixel(np.stack([a, b]))
        free = np.flatnonzero(self.ink_at(fine) == 0)
        return fine[free[0]] if len(free) else b

    def svg(self, title: str, description: str) -> str:
        """The picture, cut to what is in it, with `title` and `description` for those who cannot see it."""
        placed = place(self.labels, self.ink, self.width)
        boxes = np.array([label.box for label in placed]).reshape(-1, 2, 2)
        top = min(float(self.low[1]), float(boxes[:, 0, 1].min(initial=np.inf))) - 6
        height = max(float(self.high[1]), float(boxes[:, 1, 1].max(initial=-np.inf))) + 6 - top
        painted = "\n".join([*welded(by_depth(self.items)), *self.overlays])
        shades = "\n".join(f'<linearGradient id="\0{i}"{g}' for i, g in enumerate(self.gradients))
        # Several drawings can stand on one page: the names of their gradients come from what they show.
        name = "k" + blake2s((shades + painted).encode(), digest_size=4).hexdigest() + "-"
        drawing = f"<defs>{shades}</defs>\n{painted}".replace("\0", name)
        words = "\n".join(
            [leader for leader in map(_leader, placed) if leader]
            + [_text(label) for label in placed]
        )
        frame = f"{n(-self.width / 2)} {n(top)} {n(self.width)} {n(height)}"
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{frame}" width="{n(self.width)}" height="{n(height)}" '
            f'role="img"><title>{text_xml(title)}</title><desc>{text_xml(description)}</desc>\n'
            f'<g stroke-linejoin="round" stroke-linecap="round" font-family="{FONTS}">\n{drawing}\n{words}\n'
            "</g></svg>\n"
        )

    def _stretch(self, points: Array) -> None:
        self.low, self.high = (
            np.minimum(self.low, points.min(0)),
            np.maximum(self.high, points.max(0)),
        )

    def _cylinder(
        self,
        a: Array,
        b: Array,
        radius: float,
        *,
        colour: str,
        css: str,
        rounded: tuple[bool, bool],
        capped: bool,
    ) -> tuple[str, str]:
        """The outline and the body of a tube from `a` to `b`."""
        d = unit(b - a)
        u = unit(d[:2]) if hypot(d[0], d[1]) > 1e-9 else np.array([1.0, 0.0])
        side = radius * np.array([-u[1], u[0]])
        tilt, turn = abs(float(d[2])), degrees(atan2(u[1], u[0]))
        arc = [
            f"A{n(radius if r else max(radius * tilt, 0.05))} {n(radius)} {n(turn)} 0 0 "
            for r in rounded
        ]
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
        return outline, f'<g class="{css}">{body}</g>'

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

    def _solid(
        self, svg: tuple[str, str], planes: Array, corners: Array, *, middle: Array, group: str
    ) -> None:
        corner, front = depths(planes, corners.min(0), corners.max(0))
        if not np.isfinite(front).any():
            corner, front = (
                (int(middle[1] // CELL), int(middle[0] // CELL)),
                np.array([[middle[2]]]),
            )
        self.items.append(Item(*svg, corner, front, group))
        rows, columns = np.nonzero(np.isfinite(front))
        row, column = rows + (corner[0] + self._half), columns + (corner[1] + self._half)
        inside = (np.minimum(row, column) >= 0) & (np.maximum(row, column) < 2 * self._half)
        row, column = row[inside], column[inside]
        # What moves and what grips is worth more than a link: labels and arrows keep clear of it.
        weight = 2.0 if group.startswith(("joint", "gripper")) else 1.0
        self.ink[row, column] = np.maximum(self.ink[row, column], weight)
        self._stretch(corners)


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


def shade(colour: str, normal: Array) -> str:
    """`colour` (#rrggbb) as lit on a surface with that unit normal."""
    return tint(colour, 0.6 + 0.55 * max(0.0, float(LIGHT @ normal)))


def tint(colour: str, factor: float) -> str:
    """`colour` (#rrggbb) darkened by a factor below 1, or lightened towards white by one between 1 and 2."""
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(
        f"{round(c * factor if factor < 1 else c + (255 - c) * (factor - 1)):02x}" for c in rgb
    )


def _leader(placed: Placed) -> str:
    """A thin line to the anchor of a label that had to stand far from it."""
    left, top, right, bottom = placed.box
    near = np.array(
        [np.clip(placed.anchor[0], left, right), np.clip(placed.anchor[1], top, bottom)]
    )
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
