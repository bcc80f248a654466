"""A light sketch of an arm with vectors on it, own beside reference, as SVG in the page's colours.

Lines and rings instead of bodies: it is drawn for every wrong answer of a class. Its ends are
rounded to whole pixels, so that nobody reads the reference off the file.
"""

import numpy as np

from ...solutions.kinematics import frames
from .markup import text_xml
from .motion import Motion, Vector
from .scene import FONTS
from .vectors import Array, norm, quarter_turned, unit
from .view import looked_at

WIDTH, HEIGHT = 320.0, 300.0
MARGIN = 34.0  # [px] round the arm and the tips of its vectors
LONGEST = 84.0  # [px] of the longest vector of a kind
MOST = 8  # vectors of one sketch
SHRUNK = 30  # times at most, to make room for the tips
GROUND = "h32m-30 0l-5 6m13 -6l-5 6m13 -6l-5 6m13 -6l-5 6"
ROTATING = ("ω", "z")


def sketch(motion: Motion, title: str) -> str:
    """The arm of a motion with its vectors: broad and pale its own, thin what was handed in."""
    drawing = motion.drawing
    poses = frames(drawing.chain, np.asarray(drawing.q))
    turn = looked_at(drawing)
    vectors = motion.vectors[:MOST]
    shafts = _shafts(vectors, turn)

    joints = np.vstack([np.zeros(3), poses[:, :3, 3]]) @ turn[:2].T
    starts = np.array([[vector.at, vector.own_at] for vector in vectors]) @ turn[:2].T
    # An own frame may stand a kilometre away: no farther than the arm is large.
    away = starts[:, 1] - starts[:, 0]
    far = np.ptp(joints, axis=0).max() / np.maximum(np.linalg.norm(away, axis=1), 1e-9)
    starts[:, 1] = starts[:, 0] + away * np.minimum(far, 1.0)[:, None]
    scale, shift, high = _fitted(joints, starts, shafts)
    joints, starts = joints * scale + shift, starts * scale + shift

    drawn = _arm(joints, drawing.chain.kinds)
    drawn += [_arrow(starts[i, 0], shafts[i, 0], "reference") for i in range(len(vectors))]
    drawn += [_arrow(starts[i, 1], shafts[i, 1], "own") for i in range(len(vectors))]
    drawn += [_name(vector, starts[i], shafts[i]) for i, vector in enumerate(vectors)]
    body = "\n".join(drawn)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="sketch" viewBox="0 0 {WIDTH:.0f}'
        f' {high:.0f}" width="{WIDTH:.0f}" role="img"><title>{text_xml(title)}</title>'
        f'<g font-family="{FONTS}" font-size="15">\n{body}\n</g></svg>'
    )


def _shafts(vectors: tuple[Vector, ...], turn: Array) -> Array:
    """Each vector (k, 2, 2), reference and own, in pixels; those of one kind at one scale."""
    # The reference sets the scale; what is far longer is cut, and the others are not made small.
    longest = {True: 1e-9, False: 1e-9}
    for vector in vectors:
        turns = vector.symbol in ROTATING
        longest[turns] = max(longest[turns], norm(vector.reference))
    shafts: list[Array] = []
    for vector in vectors:
        scale = LONGEST / longest[vector.symbol in ROTATING]
        pair = np.stack([vector.reference, vector.own]) @ turn[:2].T * scale
        lengths = np.maximum(np.linalg.norm(pair, axis=1, keepdims=True), 1e-9)
        shafts.append(pair * np.minimum(1.0, 1.6 * LONGEST / lengths))
    return np.array(shafts)


def _fitted(joints: Array, starts: Array, shafts: Array) -> tuple[float, Array, float]:
    """Scale and shift that put the arm and all tips into the picture, and its height [px]."""
    room = np.array([WIDTH, HEIGHT]) - 2 * MARGIN
    places = np.vstack([joints, starts.reshape(-1, 2)])
    pads = np.vstack([np.zeros_like(joints), shafts.reshape(-1, 2)])
    low, high = np.minimum(pads, 0), np.maximum(pads, 0)
    scale = 0.95 * float(room.min()) / max(float(np.ptp(joints, axis=0).max()), 1e-6)
    corners = _corners(places * scale, low, high)
    for _ in range(SHRUNK):
        if (corners[1] - corners[0] <= room).all():
            break
        scale *= 0.9
        corners = _corners(places * scale, low, high)
    height = float(corners[1, 1] - corners[0, 1]) + 2 * MARGIN
    return scale, np.array([WIDTH, height]) / 2 - corners.sum(0) / 2, height


def _corners(places: Array, low: Array, high: Array) -> Array:
    """The corners (2, 2) of what stands round places."""
    return np.stack([(places + low).min(0), (places + high).max(0)])


def _arm(points: Array, kinds: str) -> list[str]:
    """Base, links and joints: a ring turns, a square slides."""
    path = "L".join(_pair(point) for point in points)
    base = points[0]
    drawn = [
        f'<path class="ground" d="M{_pair(base - [16, 0])}{GROUND}"/>',
        f'<path class="link" d="M{path}"/>',
    ]
    for point, kind in zip(points[1:], kinds, strict=False):
        x, y = point.tolist()
        if kind == "R":
            drawn.append(f'<circle class="joint" cx="{x:.0f}" cy="{y:.0f}" r="5"/>')
        else:
            drawn.append(
                f'<rect class="joint" x="{x - 5:.0f}" y="{y - 5:.0f}" width="10" height="10"/>'
            )
    return drawn


def _arrow(start: Array, shaft: Array, css: str) -> str:
    """An arrow, or a ring where it is too short to be one: it is zero, or points at the viewer."""
    start, end = np.round(start), np.round(start + shaft)
    length = norm(end - start)
    broad = css == "reference"
    if length < 4:
        x, y = start
        radius = 7 if broad else 3
        return f'<circle class="{css} point" cx="{x:.0f}" cy="{y:.0f}" r="{radius}"/>'
    size = min(13.0 if broad else 9.0, 0.7 * length)
    along = unit(end - start)
    foot, side = end - size * along, (0.5 if broad else 0.38) * size * quarter_turned(along)
    head = " ".join(_pair(point) for point in (end, foot + side, foot - side))
    return (
        f'<g class="{css}"><path d="M{_pair(start)}L{_pair(foot)}"/><polygon points="{head}"/></g>'
    )


def _name(vector: Vector, starts: Array, shafts: Array) -> str:
    """The name of a vector beside the tip of its own arrow."""
    tip = starts[1] + shafts[1]
    away = unit(shafts[1]) * 12
    if norm(shafts[1]) < 4:
        away = np.array([10.0, -10.0])
    x = float(np.clip(tip[0] + away[0], 10, WIDTH - 10))
    y = float(tip[1] + away[1] + 5)
    words = f'<tspan font-style="italic">{vector.symbol}</tspan>'
    if vector.index:
        words += f'<tspan dy="4" font-size="11">{vector.index}</tspan>'
    text = f'x="{x:.0f}" y="{y:.0f}" text-anchor="middle"'
    return f'<text class="halo" {text}>{words}</text><text class="name" {text}>{words}</text>'


def _pair(point: Array) -> str:
    x, y = np.round(point)
    return f"{x:.0f} {y:.0f}"
