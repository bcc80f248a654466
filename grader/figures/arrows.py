"""What is told of an arm beside its bodies: axes, senses of its joints, frames."""

from collections.abc import Sequence
from math import hypot

import numpy as np

from ...exercises.drawing import Triad
from .angles import draw_angle
from .bodies import CLASS
from .depth import outside
from .labels import Label
from .markup import arrow_corners, pair, px
from .pose import DrawnArm, DrawnJoint
from .scene import Scene
from .vectors import Array, along_line, every_pixel, norm, quarter_turned, spaced, unit

SENSE = {"R": "#8a4b00", "P": "#0b5f56"}
AXES = {"x": "#b3261e", "y": "#1c7433", "z": "#1d4fb8"}
CENTRE_LINE = "#33383f"
# How far before its body a curved arrow may stand, and how wide it may be, in radii of the joint.
RINGS = ((0.55, 1.5), (1.1, 1.5), (0.55, 1.9), (1.7, 1.5))
# How far beside its body a straight arrow may stand [px].
GAPS = (6.0, 9.0, 14.0)
LABELLED = [38, 26, 18, 10, 0]  # points of a curved arrow at which its label may stand


def draw_axis(scene: Scene, joint: DrawnJoint, bodies: Sequence[Array]) -> None:
    """Draws a joint's axis on both sides of its body, dash-dotted, over links that run along it."""
    group = f"axis {joint.index + 1}"
    for outward in (-joint.axis, joint.axis):
        cap = joint.centre + joint.half * outward
        step = 2.6 * joint.radius * outward
        for first, last in outside(cap, cap + step, bodies):
            scene.stroke(
                np.stack([cap + first * step, cap + last * step]),
                0.9,
                colour=CENTRE_LINE,
                css="axis",
                group=group,
                dashes="6 2.2 1 2.2",
                lift=joint.radius,
            )


def draw_sense(scene: Scene, arm: DrawnArm, joint: DrawnJoint, *, arrows: bool) -> None:
    """Draws the arrow of a joint's positive sense and puts its label there.

    Without `arrows` the label stands at the axis or beside the body.
    """
    centre = joint.centre[:2]
    if not arrows:
        spots = _beside_body(joint)
    elif joint.kind == "R" and arm.flat:
        spots = draw_angle(scene, arm, joint, SENSE["R"])
    elif joint.kind == "R":
        spots = _turning(scene, joint)
    else:
        spots = _sliding(scene, joint)
    away = np.stack([unit(spot - centre) for spot in spots])
    label = Label(
        "q",
        str(joint.index + 1),
        spots,
        away,
        SENSE[joint.kind],
        f"joint-label {CLASS[joint.kind]}",
        owner=np.vstack([spots, centre]),
    )
    scene.labels.append(label)


def _beside_body(joint: DrawnJoint) -> Array:
    """Points (4, 2) at the ends of a joint's axis and beside its body."""
    flat = joint.axis[:2]
    tip = (joint.half + 2.6 * joint.radius) * flat
    side = joint.radius * quarter_turned(flat)
    return joint.centre[:2] + np.stack([tip, side, -side, -tip])


def _turning(scene: Scene, joint: DrawnJoint) -> Array:
    """Draws a curved arrow round a revolute axis; points (k, 2) on it are returned."""
    ring = _best_ring(scene, joint)
    colour, group = SENSE[joint.kind], f"sense {joint.index + 1}"
    # In parts, since some of it passes behind what it goes round.
    for part in np.array_split(np.arange(len(ring) - 4), 4):
        points = ring[part[0] : part[-1] + 2]
        scene.stroke(points, 1.5, colour=colour, css="sense", group=group, halo=1.1)

    tip, before = ring[-1, :2], ring[-7, :2]
    head = f'points="{arrow_corners(tip, tip - before, 7.0)}"'
    scene.overlay(f'<polygon class="head" {head} fill="{colour}"/>', ring[-6:, :2], 4.0)
    scene.mark(ring[:, :2], 3.0)
    return ring[LABELLED, :2]


def _best_ring(scene: Scene, joint: DrawnJoint) -> Array:
    """The points (40, 3) of a curved arrow round a revolute axis, where there is room for it."""
    x, y, z = joint.axes.T
    # The gap is behind; the head comes round to the front.
    k = 2 if hypot(x[2], y[2]) > 0.1 else 1
    angles = float(np.arctan2(y[k], x[k])) + spaced(-2.6, 1.2, 40)
    circle = np.outer(np.cos(angles), x) + np.outer(np.sin(angles), y)

    choices: list[tuple[float, Array]] = []
    for outward in (z, -z):
        for gap, wide in RINGS:
            centre = joint.centre + (joint.half + gap * joint.radius) * outward
            ring = centre + wide * joint.radius * circle
            ink = scene.ink_at(every_pixel(ring[:, :2])).mean()
            price = 2 * joint.radius * float(ink - outward[2])
            choices.append((price + 3 * gap + 3 * wide, ring))
    return min(choices, key=lambda choice: choice[0])[1]


def _sliding(scene: Scene, joint: DrawnJoint) -> Array:
    """Draws a straight arrow along a prismatic axis; points (k, 2) on it are returned."""
    flat = np.array([1.0, 0.0])
    if hypot(joint.axis[0], joint.axis[1]) > 0.05:
        flat = unit(joint.axis[:2])
    side = np.array([-flat[1], flat[0], 0.0])
    reach = max(1.15 * joint.half, 18.0) * joint.axis

    choices: list[tuple[float, Array]] = []
    for gap in GAPS:
        for sign in (1.0, -1.0):
            middle = joint.centre + sign * (1.35 * joint.radius + gap) * side
            ends = np.stack([middle - reach, middle + reach])
            ink = scene.ink_at(every_pixel(ends[:, :2])).sum()
            choices.append((float(ink) + gap, ends))
    start, end = min(choices, key=lambda choice: choice[0])[1]
    _arrow(scene, start, end, 1.5, colour=SENSE[joint.kind], css="sense")
    return along_line(start, end, (0.5, 0.75, 0.25, 1.0, 0.0))[:, :2]


def draw_triad(scene: Scene, arm: DrawnArm, triad: Triad, tips: Array) -> None:
    """Draws a frame as arrows named x, y and z; at the tool they reach past the `tips` (3,)."""
    origin = arm.view.points(triad.pose[:3, 3])
    axes = arm.view.turn @ triad.pose[:3, :3]
    length = max(3.6 * arm.radius, 34.0)
    if norm(origin - arm.end) < 1:
        length = max(length, min(norm(tips - origin) + 12, 1.4 * length))

    for k in np.argsort(axes[2], kind="stable"):  # the one nearest to the viewer last
        name, colour = "xyz"[k], AXES["xyz"[k]]
        tip = origin + length * axes[:, k]
        _arrow(scene, origin, tip, 1.7, colour=colour, css=f"triad {name}")
        away = unit(axes[:2, k])
        scene.labels.append(
            Label(name, triad.label, tip[None, :2], away[None], colour, "triad-label")
        )


def arrowhead(tip: Array, along: Array, size: float, fill: str) -> str:
    """An arrowhead as SVG, with its point at `tip` (2,), along `along` (2,), `size` pixels long."""
    return f'<polygon points="{arrow_corners(tip, along, size)}" fill="{fill}"/>'


def _arrow(scene: Scene, start: Array, end: Array, thick: float, *, colour: str, css: str) -> None:
    """Draws an arrow above the arm."""
    a, b = start[:2], end[:2]
    length = norm(b - a)
    if length < 6:
        mark = _end_on(b, colour, towards_viewer=end[2] > start[2])
        scene.overlay(f'<g class="{css}">{mark}</g>', np.stack([b - 4, b + 4]))
        return
    size = min(8.0, 0.6 * length)
    shaft = f'd="M{pair(a)}L{pair(b - 0.7 * size * unit(b - a))}"'
    head = f'points="{arrow_corners(b, b - a, size)}"'
    svg = (
        f'<g class="{css}"><path {shaft} stroke="#fff" stroke-width="{px(thick + 2)}"/>'
        f'<polygon {head} fill="#fff" stroke="#fff" stroke-width="2"/>'
        f'<path {shaft} stroke="{colour}" stroke-width="{px(thick)}"/>'
        f'<polygon {head} fill="{colour}"/></g>'
    )
    scene.overlay(svg, np.stack([a, b]))


def _end_on(at: Array, colour: str, *, towards_viewer: bool) -> str:
    """An arrow that points at the viewer, a ring with a dot, or away, a ring with a cross."""
    centre = f'cx="{px(at[0])}" cy="{px(at[1])}"'
    ring = f'<circle {centre} r="4.2" fill="#fff" stroke="{colour}" stroke-width="1.3"/>'
    if towards_viewer:
        return f'{ring}<circle {centre} r="1.5" fill="{colour}"/>'
    cross = f'd="M{pair(at - 3)}l6 6m0 -6l-6 6"'
    return f'{ring}<path {cross} stroke="{colour}" stroke-width="1.2"/>'
