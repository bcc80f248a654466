# pyright: basic
"""A small singularity map of one student's arm, with the student's own q on it, as SVG.

Dark is singular, as on the large maps (maps.py). The joints that do not vary are
held at the student's q, so that the map passes through it.
"""

from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np
from contourpy import contour_generator

from ...solutions.singularity import (
    Parameters,
    RegionalArm,
    arm,
    factor_values,
    task_block,
)
from .joint_map import short
from .markup import px, text_xml
from .scene import FONTS
from .vectors import Array, spaced

if TYPE_CHECKING:
    from ...solutions.robots import Robot

SAMPLES = 49  # per axis
SIDE = 220.0  # [px] of the map
FRAME = "-56 -10 296"  # all of the view box but its height
TALL, LINE = 276, 18  # [px] of the map with its axes, and of a curve named below it
# Bounds of the bands, as shares of the largest singular value, and their colours.
BOUNDS = (-1.0, 0.04, 0.12, 0.25, 0.42, 0.65, 2.0)
BANDS = ("#00224e", "#3c5580", "#7388a9", "#a7b5ca", "#d0d9e4", "#eef2f6")
SHORT = 0.5  # [px] of a step along a line
STRAIGHT = 1e-3  # [px^2] between two steps
DASHES = ("none", "7 3", "2 2.5", "9 3 2 3")
RIGHT_ANGLES = {-180: "−180°", -90: "−90°", 0: "0", 90: "90°", 180: "180°"}


@dataclass(frozen=True, eq=False)
class _Axis:
    """A joint along an edge: its index, what is shown of it, and the ends of the edge [px]."""

    joint: int
    span: tuple[float, float]
    ends: tuple[float, float]

    def pixels(self, values: Array) -> Array:
        """Where values of the joint stand on the map."""
        return np.interp(values, self.span, self.ends)


def own_map(robot: "Robot", parameters: Parameters, q: Array, title: str, here: str) -> str:
    """The map over q2 and q3 (of a two-joint arm: q1 and q2) through `q` (n,), with a mark at it.

    In a dark band the arm all but loses a direction of motion; curves are the factors of its
    determinant. The drawing is called `title`, and the mark `here`.
    """
    part = arm(robot, parameters)
    first, second = (0, 1) if part.chain.n == 2 else (1, 2)
    across = _Axis(first, _span(part, first, q), (0.0, SIDE))
    up = _Axis(second, _span(part, second, q), (SIDE, 0.0))
    grid = np.broadcast_to(q, (SAMPLES, SAMPLES, robot.n)).copy()
    grid[..., first], grid[..., second] = np.meshgrid(_samples(across), _samples(up))

    drawn = _bands(across, up, _smallest_gain(task_block(part, grid[..., : part.chain.n])))
    curves: list[str] = []
    if part.factors:
        values = factor_values(robot, parameters, grid)
        curves = _curves(across, up, {f.name: values[f.name] for f in part.factors})
    drawn += curves
    drawn += [*_edge(part, across), *_edge(part, up), *_mark(part, across, up, q, here)]
    body = "\n".join(drawn)
    frame = f"{FRAME} {TALL + LINE * len(curves)}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="own-map" viewBox="{frame}" width="296"'
        f' role="img"><title>{text_xml(title)}</title>'
        f'<g font-family="{FONTS}" font-size="13">\n{body}\n</g></svg>'
    )


def _span(part: RegionalArm, joint: int, q: Array) -> tuple[float, float]:
    """A full turn, or the stroke with zero, the own value and a margin."""
    if part.chain.kinds[joint] == "R":
        return -np.pi, np.pi
    low, high = part.limits[joint]
    low, high = min(low, 0.0, float(q[joint])), max(high, float(q[joint]))
    margin = 0.08 * (high - low)
    return low - margin, high + margin


def _samples(axis: _Axis) -> Array:
    return spaced(*axis.span, SAMPLES)


def _smallest_gain(blocks: Array) -> Array:
    """The smallest singular values (...) of blocks (..., m, n), to the digits that a map shows.

    Eigenvalues of a symmetric product take half the time of a singular value decomposition.
    """
    product = blocks @ np.swapaxes(blocks, -1, -2)
    if blocks.shape[-2] > blocks.shape[-1]:
        product = np.swapaxes(blocks, -1, -2) @ blocks
    find = EIGENVALUE.get(product.shape[-1], _smallest_of_many)
    return np.sqrt(np.maximum(find(product), 0.0))


def _smallest_of_many(A: Array) -> Array:
    eigenvalues: Any = np.linalg.eigvalsh(A)
    return eigenvalues[..., 0]


def _smallest_of_two(A: Array) -> Array:
    a, b, d = A[..., 0, 0], A[..., 0, 1], A[..., 1, 1]
    return 0.5 * (a + d) - np.hypot(0.5 * (a - d), b)


def _smallest_of_three(A: Array) -> Array:
    """By the cosine formula, good to 1e-8 of the largest in a tenth of the time."""
    mean = np.trace(A, axis1=-2, axis2=-1) / 3.0
    a, b, c = A[..., 0, 0] - mean, A[..., 1, 1] - mean, A[..., 2, 2] - mean
    d, e, f = A[..., 0, 1], A[..., 1, 2], A[..., 0, 2]
    spread = np.sqrt((a * a + b * b + c * c + 2.0 * (d * d + e * e + f * f)) / 6.0)
    determinant = a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f)
    cosine = determinant / np.maximum(2.0 * spread**3, np.finfo(float).tiny)
    angle = np.arccos(np.clip(cosine, -1.0, 1.0)) / 3.0
    return mean + 2.0 * spread * np.cos(angle + 2.0 * np.pi / 3.0)


EIGENVALUE = {2: _smallest_of_two, 3: _smallest_of_three}
"""The smallest eigenvalues (...) of symmetric matrices (..., n, n), by n."""


def _bands(across: _Axis, up: _Axis, sigma: Array) -> list[str]:
    """Filled bands of the smallest singular value."""
    largest = float(sigma.max()) or 1.0
    places = (across.pixels(_samples(across)), up.pixels(_samples(up)))
    # All polygons of a band in one array: which of them are holes, the fill rule says.
    contours = contour_generator(*places, sigma / largest, fill_type="ChunkCombinedOffset")
    drawn = []
    for low, high, colour in zip(BOUNDS, BOUNDS[1:], BANDS, strict=False):
        path = _path(contours.filled(low, high), closed=True)
        if path:
            # Its own stroke closes the seams between bands.
            stroke = f'stroke="{colour}" stroke-width=".6"'
            drawn.append(f'<path d="{path}" fill="{colour}" {stroke} fill-rule="evenodd"/>')
    return drawn


def _curves(across: _Axis, up: _Axis, values: dict[str, Array]) -> list[str]:
    """The zero line of each factor that has one there, in its own pattern, and its name below."""
    places = (across.pixels(_samples(across)), up.pixels(_samples(up)))
    drawn: list[str] = []
    for (name, value), dashes in zip(values.items(), DASHES, strict=False):
        contours = contour_generator(*places, value, line_type="ChunkCombinedOffset")
        path = _path(contours.lines(0.0), closed=False)
        if not path:
            continue
        line = f'<path d="{path}" fill="none" stroke-dasharray="{dashes}"'
        at = TALL + LINE * len(drawn)
        drawn.append(
            f'{line} stroke="#fff" stroke-width="3.6"/>'
            f'{line} stroke="#b3261e" stroke-width="1.7"/>'
            f'<path d="M0 {at}h26" stroke="#b3261e" stroke-width="1.7"'
            f' stroke-dasharray="{dashes}"/>'
            f'<text class="tick" x="31" y="{at + 4}">{text_xml(short(name))}</text>'
        )
    return drawn


def _edge(part: RegionalArm, axis: _Axis) -> list[str]:
    """The name and the ticks of a joint below the map, or to the left of it."""
    if part.chain.kinds[axis.joint] == "R":
        ticks = {np.radians(angle): text for angle, text in RIGHT_ANGLES.items()}
    else:
        ticks = {value: f"{value:.3g} m" for value in _round_values(axis.span)}
    drawn = [_tick(axis, value, text) for value, text in ticks.items()]
    place = f'x="{px(SIDE / 2)}" y="252"'
    if axis.ends[0]:
        place = f'x="-40" y="{px(SIDE / 2)}" dy="-14"'
    symbol = '<tspan font-style="italic">q</tspan>'
    name = f'{symbol}<tspan dy="3" font-size="10">{axis.joint + 1}</tspan>'
    return [*drawn, f'<text class="tick" text-anchor="middle" {place}>{name}</text>']


def _tick(axis: _Axis, value: float, text: str) -> str:
    at = px(float(axis.pixels(np.array(value))))
    place = f'x="{at}" y="236" text-anchor="middle"'
    if axis.ends[0]:
        place = f'x="-6" y="{at}" dy="4" text-anchor="end"'
    return f'<text class="tick" font-size="11" {place}>{text}</text>'


def _round_values(span: tuple[float, float]) -> list[float]:
    """Zero and a round value near the end of a stroke."""
    step = 10 ** np.floor(np.log10(span[1]))
    return [0.0, float(np.floor(span[1] / step) * step)]


def _mark(part: RegionalArm, across: _Axis, up: _Axis, q: Array, name: str) -> list[str]:
    """A ring at the own q, with its name beside it."""
    x, y = (float(axis.pixels(_turned(part, axis, q))) for axis in (across, up))
    beside = f'x="{px(x + 10)}" text-anchor="start"'
    if x > 0.6 * SIDE:
        beside = f'x="{px(x - 10)}" text-anchor="end"'
    words = f'{beside} y="{px(np.clip(y - 8, 12, SIDE - 4))}" font-weight="bold"'
    ring = f'<circle cx="{px(x)}" cy="{px(y)}" r="6" fill="none"'
    return [
        f'{ring} stroke="#fff" stroke-width="5"/>',
        f'{ring} stroke="#1d2733" stroke-width="2.4"/>',
        f'<text {words} stroke="#fff" stroke-width="4" fill="#fff">{text_xml(name)}</text>',
        f'<text {words} fill="#1d2733">{text_xml(name)}</text>',
    ]


def _turned(part: RegionalArm, axis: _Axis, q: Array) -> Array:
    """The own value of a joint, less whole turns."""
    value = q[axis.joint]
    if part.chain.kinds[axis.joint] == "R":
        return np.angle(np.exp(1j * value))
    return value


def _path(lines: Any, *, closed: bool) -> str:
    """A path through whole pixels, without those on a straight line between others.

    `lines` are points (m, 2) and the offsets at which lines begin, and the last ends.
    """
    (points,), (offsets,) = lines
    if points is None:
        return ""
    steps = np.diff(points, axis=0)
    turned = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
    short = np.abs(steps).max(axis=1) < SHORT  # these have no direction
    kept = np.ones(len(points), dtype=bool)
    kept[1:-1] = (np.abs(turned) > STRAIGHT) | short[:-1] | short[1:]
    starts = offsets[:-1]
    kept[starts] = kept[offsets[1:] - 1] = True

    lengths = np.add.reduceat(kept, starts, dtype=int)
    numbers = map(str, np.rint(points[kept]).astype(int).ravel().tolist())
    end = "Z" if closed else ""
    return "".join(f"M{' '.join(islice(numbers, 2 * length))}{end}" for length in lengths)
