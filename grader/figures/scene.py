"""A painter: solids, strokes and labels in camera pixels, put in order of depth, written as SVG."""

from hashlib import blake2s

import numpy as np

from .depth import CELL, Item, by_depth, cells, depths, tube_planes, welded
from .labels import Label, Placed
from .markup import label_svg, leader_svg, pairs, px, shade, text_xml, tint
from .placing import place
from .tube import face, paint, silhouette, tube_between
from .vectors import Array, every_pixel

FONTS = "'Libertinus Serif','STIX Two Text','Times New Roman',serif"
OTHERS = ((1, 2), (0, 2), (0, 1))  # axes of a box along the faces square to each
DARK = 0.45  # of a body's colour: its outline


class Scene:
    """What is painted so far, `width` pixels wide and centred on the origin.

    `ink` counts what stands on each cell of a grid, for labels and arrows that keep clear of it;
    `bodies` is 1 on the cells that a joint's body touches, where no label stands at all. `low` and
    `high` (2,) are the corners of what is painted.
    """

    def __init__(self, width: float) -> None:
        """An empty picture."""
        self.width = width
        self.items: list[Item] = []
        self.overlays: list[str] = []
        self.labels: list[Label] = []
        self.gradients: list[str] = []
        self._half = int(1.2 * width / CELL) + 2
        self.ink: Array = np.zeros((2 * self._half, 2 * self._half))
        self.bodies = np.zeros_like(self.ink)
        self.low = np.array([np.inf, np.inf])
        self.high = np.array([-np.inf, -np.inf])

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
        """Adds a cylinder from `a` to `b` (3,) and returns its half-spaces (k, 4), normal . p <= c.

        Its ends are flat or rounded; `capped` shows the face of a flat end.
        """
        tube = tube_between(a, b, radius, colour)
        path, dark = silhouette(tube, rounded), tint(colour, DARK)
        outline = f'<path d="{path}" fill="{dark}" stroke="{dark}" stroke-width="1.4"/>'
        body = f'<path d="{path}" fill="{self._fill(paint(tube))}"/>'
        if capped:
            body += face(tube)

        planes = tube_planes(a, b, radius, facets)
        if rounded[0]:
            planes[-1, 3] += radius
        if rounded[1]:
            planes[-2, 3] += radius
        corners = np.stack([np.minimum(a, b)[:2] - radius, np.maximum(a, b)[:2] + radius])
        # Thinner than a cell it could slip between the middles of the cells, and out of the order.
        seen = planes + np.array([0.0, 0.0, 0.0, max(0.75 * CELL - radius, 0.0)])
        svg = (outline, f'<g class="{css}">{body}</g>')
        self._solid(svg, seen, corners, middle=(a + b) / 2, group=group)
        return planes

    def box(
        self, centre: Array, axes: Array, half: Array, *, colour: str, css: str, group: str
    ) -> Array:
        """Adds a box with the columns of `axes` (3, 3) as its directions.

        `half` (3,) is half its size along each. Returns its half-spaces (6, 4), normal . p <= c.
        """
        normals = np.hstack([axes, -axes]).T
        dark, body = tint(colour, DARK), ""
        corners: list[Array] = []
        for k in np.flatnonzero(normals[:, 2] > 1e-6):
            middle = centre + normals[k] * half[k % 3]
            i, j = OTHERS[k % 3]
            u, v = axes[:, i] * half[i], axes[:, j] * half[j]
            corner = np.stack([middle + u + v, middle + u - v, middle - u - v, middle - u + v])
            corners.append(corner[:, :2])
            fill = shade(colour, normals[k])
            points = f'points="{pairs(corner, " ")}"'
            body += f'<polygon {points} fill="{fill}" stroke="{dark}" stroke-width=".8"/>'

        planes = np.column_stack([normals, normals @ centre + np.tile(half, 2)])
        svg = ("", f'<g class="{css}">{body}</g>')
        self._solid(svg, planes, np.concatenate(corners), middle=centre, group=group)
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
        path = f'd="M{pairs(points, "L")}" fill="none"'
        width = f'stroke-width="{px(thick)}"'
        if dashes:
            width += f' stroke-dasharray="{dashes}"'
        line = f'<path class="{css}" {path} stroke="{colour}" {width}/>'
        outline = ""
        if halo:
            wide = f'stroke-width="{px(thick + 2 * halo)}"'
            outline = f'<path {path} stroke="#fff" {wide} stroke-linecap="butt"/>'

        fine = every_pixel(points)
        at = np.floor(fine[:, :2] / CELL).astype(np.int64)
        corner, last = at.min(0), at.max(0)
        front = np.full((last[1] - corner[1] + 1, last[0] - corner[0] + 1), -np.inf)
        np.maximum.at(front, (at[:, 1] - corner[1], at[:, 0] - corner[0]), fine[:, 2] + lift)
        self.items.append(Item(outline, line, (int(corner[1]), int(corner[0])), front, group))
        self.mark(points[:, :2], 1.5)

    def overlay(self, svg: str, points: Array, weight: float = 3.0) -> None:
        """Adds `svg` above everything but the labels.

        `points` (k, 2) is the line that labels keep clear of, `weight` its ink.
        """
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

    def placed(self) -> list[Placed]:
        """The labels, each in its place."""
        return place(self.labels, self.ink, self.bodies, self.width)

    def svg(self, title: str, description: str) -> str:
        """The picture, cut to what is in it.

        `title` and `description` are for those who cannot see it.
        """
        placed = self.placed()
        boxes = np.array([label.box for label in placed]).reshape(-1, 2, 2)
        top = min(float(self.low[1]), float(boxes[:, 0, 1].min(initial=np.inf))) - 6
        bottom = max(float(self.high[1]), float(boxes[:, 1, 1].max(initial=-np.inf))) + 6
        wide, high = px(self.width), px(bottom - top)
        frame = f"{px(-self.width / 2)} {px(top)} {wide} {high}"

        leaders = [leader_svg(label) for label in placed]
        words = [leader for leader in leaders if leader]
        words += [label_svg(label) for label in placed]
        text = "\n".join(words)
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{frame}"'
            f' width="{wide}" height="{high}" role="img">'
            f"<title>{text_xml(title)}</title><desc>{text_xml(description)}</desc>\n"
            f'<g stroke-linejoin="round" stroke-linecap="round" font-family="{FONTS}">\n'
            f"{self._painted()}\n{text}\n</g></svg>\n"
        )

    def _painted(self) -> str:
        """All but the labels, with names for the gradients."""
        painted = "\n".join([*welded(by_depth(self.items)), *self.overlays])
        gradients: list[str] = []
        for i, gradient in enumerate(self.gradients):
            gradients.append(f'<linearGradient id="\0{i}"{gradient}')
        shades = "\n".join(gradients)
        # Several drawings can stand on one page: the names come from what they show.
        name = "k" + blake2s((shades + painted).encode(), digest_size=4).hexdigest() + "-"
        return f"<defs>{shades}</defs>\n{painted}".replace("\0", name)

    def _fill(self, gradient: str) -> str:
        """The colour that refers to a gradient; a zero stands for the name that it gets at last."""
        self.gradients.append(gradient)
        return f"url(#\0{len(self.gradients) - 1})"

    def _stretch(self, points: Array) -> None:
        self.low = np.minimum(self.low, points.min(0))
        self.high = np.maximum(self.high, points.max(0))

    def _solid(
        self, svg: tuple[str, str], planes: Array, corners: Array, *, middle: Array, group: str
    ) -> None:
        """Adds the outline and the body of a convex solid to what is put in order, and its ink."""
        corner, front = depths(planes, corners.min(0), corners.max(0))
        if not np.isfinite(front).any():  # smaller than a cell
            corner = (int(middle[1] // CELL), int(middle[0] // CELL))
            front = np.array([[middle[2]]])
        self.items.append(Item(*svg, corner, front, group))

        # What moves and what grips is worth more than a link: labels and arrows keep clear of it.
        weight = 2.0 if group.startswith(("joint", "gripper")) else 1.0
        self._count(self.ink, corner, front, weight)
        if group.startswith("joint"):
            # Larger by what the middle of a cell is away from its corner: every cell it touches.
            touched = planes + np.array([0.0, 0.0, 0.0, 0.75 * CELL])
            low, high = corners.min(0) - CELL, corners.max(0) + CELL
            self._count(self.bodies, *depths(touched, low, high), 1.0)
        self._stretch(corners)

    def _count(self, grid: Array, corner: tuple[int, int], front: Array, weight: float) -> None:
        """Raises the cells of `grid` that a solid of depth `front` covers to a weight."""
        rows, columns = np.nonzero(np.isfinite(front))
        row, column = rows + (corner[0] + self._half), columns + (corner[1] + self._half)
        inside = (np.minimum(row, column) >= 0) & (np.maximum(row, column) < 2 * self._half)
        row, column = row[inside], column[inside]
        grid[row, column] = np.maximum(grid[row, column], weight)
