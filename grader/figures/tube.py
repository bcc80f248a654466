"""A cylinder as it is seen: its silhouette, its paint and the face of its end, as SVG."""

from dataclasses import dataclass
from math import atan2, degrees, hypot, sqrt

import numpy as np

from .markup import pair, px, shade, tint
from .vectors import Array, cross, lifted, quarter_turned, unit

ACROSS = (-1.0, -0.6, -0.2, 0.2, 0.6, 1.0)  # of the radius, where the paint is given


@dataclass(frozen=True, eq=False)
class Tube:
    """A cylinder from `a` to `b` (3,) in camera coordinates, and how it is seen.

    Attributes:
        a: The middle of its first end (3,) [px].
        b: The middle of its last end (3,) [px].
        radius: [px].
        colour: As #rrggbb.
        direction: The unit vector (3,) from `a` to `b`.
        side: From its axis to its silhouette on the page (2,) [px].
        tilt: How much of an end is seen: 0 from the side, 1 end on.
        bearing: The angle at which it lies on the page, in degrees.
    """

    a: Array
    b: Array
    radius: float
    colour: str
    direction: Array
    side: Array
    tilt: float
    bearing: float


def tube_between(a: Array, b: Array, radius: float, colour: str) -> Tube:
    """The cylinder from `a` to `b` (3,) as it is seen."""
    direction = unit(b - a)
    heading = np.array([1.0, 0.0])
    if hypot(direction[0], direction[1]) > 1e-9:  # else it is seen end on
        heading = unit(direction[:2])
    side = radius * quarter_turned(heading)
    tilt = abs(float(direction[2]))
    bearing = degrees(atan2(heading[1], heading[0]))
    return Tube(a, b, radius, colour, direction, side, tilt, bearing)


def silhouette(tube: Tube, rounded: tuple[bool, bool]) -> str:
    """The path round a tube whose ends at `a` and at `b` are flat or rounded."""
    side = lifted(tube.side)
    arcs: list[str] = []
    for is_round in rounded:
        depth = tube.radius if is_round else max(tube.radius * tube.tilt, 0.05)
        arcs.append(f"A{px(depth)} {px(tube.radius)} {px(tube.bearing)} 0 0 ")
    there = f"M{pair(tube.a + side)}L{pair(tube.b + side)}"
    back = f"{arcs[1]}{pair(tube.b - side)}L{pair(tube.a - side)}"
    return f"{there}{back}{arcs[0]}{pair(tube.a + side)}Z"


def paint(tube: Tube) -> str:
    """The inside of a linear gradient that shades a tube from side to side."""
    across = unit(lifted(tube.side))
    up = cross(tube.direction, across)
    if up[2] < 0:
        up = -up
    stops = ""
    for x in ACROSS:
        normal = x * across + sqrt(1 - x * x) * up
        stops += f'<stop offset="{px((x + 1) / 2)}" stop-color="{shade(tube.colour, normal)}"/>'
    (x1, y1), (x2, y2) = tube.a[:2] - tube.side, tube.a[:2] + tube.side
    ends = f'x1="{px(x1)}" y1="{px(y1)}" x2="{px(x2)}" y2="{px(y2)}"'
    return f' gradientUnits="userSpaceOnUse" {ends}>{stops}</linearGradient>'


def face(tube: Tube) -> str:
    """The flat end that shows; empty where a tube is seen from the side."""
    if tube.tilt <= 0.02:
        return ""
    end, normal = tube.b, tube.direction
    if normal[2] <= 0:
        end, normal = tube.a, -normal
    radii = f'rx="{px(tube.radius * tube.tilt)}" ry="{px(tube.radius)}"'
    fill = f'fill="{shade(tube.colour, normal)}" stroke="{tint(tube.colour, 0.45)}"'
    place = f'transform="translate({pair(end)}) rotate({px(tube.bearing)})"'
    return f'<ellipse {radii} {fill} stroke-width=".7" {place}/>'
