"""The picture of an arm: joints, links, base, gripper, axes, frames and dimensions, as SVG."""

from collections.abc import Sequence
from itertools import pairwise
from math import hypot

import numpy as np

from ...exercises.drawing import Dimension, Drawing, Triad
from .depth import Array, every_pixel, norm, outside, spaced, span_inside, unit
from .labels import Label, symbol_of
from .pose import DrawnArm, DrawnJoint, last_step, pose
from .scene import Scene, n, pair

LINK, ROD, BASE, GRIPPER = "#7d8896", "#c3ccd6", "#4a5361", "#39404a"
JOINT = {"R": "#e9a23b", "P": "#4fa79d"}
SENSE = {"R": "#8a4b00", "P": "#0b5f56"}
CLASS = {"R": "revolute", "P": "prismatic"}
AXES = {"x": "#b3261e", "y": "#1c7433", "z": "#1d4fb8"}
INK, CENTRE_LINE = "#1b1f24", "#33383f"


def draw(drawing: Drawing, width: float = 420) -> str:
    """The SVG of an arm, `width` pixels wide: the same text for the same drawing.

    Raises:
        KinegradeError: `drawing.q` does not fit `drawing.chain`.
    """
    return compose(drawing, width).svg(drawing.caption, drawing.alt)


def compose(drawing: Drawing, width: float) -> Scene:
    """The arm as a scene that can be looked into before it is written."""
    arm, scene = pose(drawing, width), Scene(width)
    bodies = [_body(scene, joint) for joint in arm.joints]
    _base(scene, arm, bodies, arm.view.turn @ drawing.stands)
    for joint in arm.joints:
        _link(scene, arm, joint, bodies)
    tips = _hand(scene, arm, bodies)
    for joint in arm.joints:
        _axis(scene, joint, bodies)
    for joint in arm.joints:
        _sense(scene, joint, arrows=drawing.arrows)
    for triad in drawing.triads:
        _triad(scene, arm, triad, tips)
    for dimension in drawing.dimensions:
        _dimension(scene, arm, dimension)
    return scene


def _body(scene: Scene, joint: DrawnJoint) -> Array:
    """Draws the joint's body; its half-spaces are returned."""
    css, group = f"joint {CLASS[joint.kind]}", f"joint {joint.index + 1}"
    if joint.kind == "P":
        half = np.array([0.95 * joint.radius, 0.95 * joint.radius, joint.half])
        return scene.box(joint.centre, joint.axes, half, colour=JOINT["P"], css=css, group=group)
    ends = (joint.centre - joint.half * joint.axis, joint.centre + joint.half * joint.axis)
    return scene.tube(
        *ends, joint.radius, colour=JOINT["R"], css=css, group=group, facets=16, capped=True
    )


def _base(scene: Scene, arm: DrawnArm, bodies: Sequence[Array], up: Array) -> None:
    """Draws the base plate under the base frame and under the joints that sit there, and the column on it."""
    foot, r = arm.paths[0][0], arm.radius
    drop = 0.0
    for joint in arm.joints:
        height, lean = float((joint.centre - foot) @ up), min(abs(float(joint.axis @ up)), 1.0)
        aside = norm(joint.centre - foot - height * up)
        if aside < 3 * r and abs(height) < 6 * r:
            drop = min(drop, height - joint.half * lean - joint.radius * (1 - lean**2) ** 0.5)
    top = foot + drop * up
    plate = scene.tube(
        top - 0.6 * r * up,
        top,
        3.1 * r,
        colour=BASE,
        css="base",
        group="base",
        facets=20,
        capped=True,
    )
    _pipe(scene, [top, *arm.paths[0]], 0.5 * r, [*bodies, plate], colour=LINK, group="base link")


def _link(scene: Scene, arm: DrawnArm, joint: DrawnJoint, bodies: Sequence[Array]) -> None:
    """Draws the link behind `joint`; a prismatic joint's slides out of its body."""
    path, following = (
        arm.paths[joint.index + 1],
        arm.joints[joint.index + 1 : joint.index + 2] or [joint],
    )
    radius = 0.3 + 0.42 * (joint.radius + following[0].radius) / 2
    points = list(path)
    if following[0] is joint:
        # The last link ends at the palm.
        points = [*path[:2], path[2] - unit(last_step(path)) * min(arm.grip, norm(last_step(path)))]
        if norm(path[2] - path[1]) <= 0.5:
            points[1] = points[2]
    group = f"link {joint.index + 1}"
    if joint.kind == "R":
        _pipe(scene, [joint.centre, *points], radius, bodies, colour=LINK, group=group)
        return
    _pipe(
        scene,
        [path[0], joint.centre],
        radius,
        bodies,
        colour=LINK,
        group=f"guide {joint.index + 1}",
    )
    _pipe(scene, [joint.centre, points[1]], 0.7 * radius, bodies, colour=ROD, group=group)
    _pipe(scene, points[1:], radius, bodies, colour=LINK, group=group)


def _pipe(
    scene: Scene,
    points: Sequence[Array],
    radius: float,
    solids: Sequence[Array],
    *,
    colour: str,
    group: str,
) -> None:
    """Draws a bent tube through `points` where it runs outside of the solids."""
    knots = [points[0]]
    for p in points[1:]:
        if norm(p - knots[-1]) > 0.3:
            knots.append(p)
    for k, (a, b) in enumerate(pairwise(knots)):
        # A cut end reaches a little into the body that it comes out of.
        inward = min(0.5 * radius, 2.5) / norm(b - a)
        for first, last in outside(a, b, solids):
            start, end = (
                a + max(0.0, first - inward) * (b - a),
                a + min(1.0, last + inward) * (b - a),
            )
            rounded = (first == 0.0 and k > 0, last == 1.0 and k < len(knots) - 2)
            scene.tube(start, end, radius, colour=colour, css="link", group=group, rounded=rounded)


def _hand(scene: Scene, arm: DrawnArm, bodies: Sequence[Array]) -> Array:
    """Draws a gripper along the last link, or along the tool's z axis if there is none.

    Its finger tips, whose middle (3,) is returned, are at the tool point, or before the last body if the tool point
    is inside that.
    """
    step, r = last_step(arm.paths[-1], 2.0), arm.radius
    ahead = unit(step) if step.any() else arm.tool[:, 2]
    palm, reach, far = arm.end - arm.grip * ahead, 0.0, 20 * r
    for solid in bodies:
        span = span_inside(palm, palm + far * ahead, solid)
        if span is not None and span[0] * far < 1.5 * arm.grip + reach:
            reach = max(reach, span[1] * far + 0.9 * r)
    palm = palm + reach * ahead
    if reach:
        wrist = arm.joints[-1]
        _pipe(scene, [wrist.centre, palm], 0.38 * wrist.radius, bodies, colour=LINK, group="hand")
    # The fingers open along the tool axis that shows them best.
    sides = [
        unit(axis - (axis @ ahead) * ahead) for axis in arm.tool.T if abs(float(axis @ ahead)) < 0.9
    ]
    across = 0.8 * r * max(sides, key=lambda v: abs(float(v[0] * ahead[1] - v[1] * ahead[0])))
    thick = max(0.15 * r, 1.6)
    fingers = [(palm + side, palm + side + arm.grip * ahead, thick) for side in (-across, across)]
    for a, b, radius in [(palm - across, palm + across, 1.25 * thick), *fingers]:
        scene.tube(
            a, b, radius, colour=GRIPPER, css="gripper", group="gripper", rounded=(True, True)
        )
    return palm + arm.grip * ahead


def _axis(scene: Scene, joint: DrawnJoint, bodies: Sequence[Array]) -> None:
    """Draws the joint's axis on both sides of its body, dash-dotted, and over the links that run along it."""
    for outward in (-joint.axis, joint.axis):
        cap = joint.centre + joint.half * outward
        step = 2.6 * joint.radius * outward
        for first, last in outside(cap, cap + step, bodies):
            ends, group = (
                np.stack([cap + first * step, cap + last * step]),
                f"axis {joint.index + 1}",
            )
            scene.stroke(
                ends,
                0.9,
                colour=CENTRE_LINE,
                css="axis",
                group=group,
                dashes="6 2.2 1 2.2",
                lift=joint.radius,
            )


def _sense(scene: Scene, joint: DrawnJoint, *, arrows: bool) -> None:
    """Draws the arrow of the joint's positive sense and puts its label there, or else at the axis or the body."""
    centre, flat = joint.centre[:2], joint.axis[:2]
    if arrows:
        spots = _turning(scene, joint) if joint.kind == "R" else _sliding(scene, joint)
    else:
        tip, side = (
            (joint.half + 2.6 * joint.radius) * flat,
            joint.radius * np.array([-flat[1], flat[0]]),
        )
        spots = centre + np.stack([tip, side, -side, -tip])
    away = np.stack([unit(spot - centre) for spot in spots])
    owner, css = np.vstack([spots, centre]), f"joint-label {CLASS[joint.kind]}"
    scene.labels.append(
        Label("q", str(joint.index + 1), spots, away, SENSE[joint.kind], css, owner)
    )


def _turning(scene: Scene, joint: DrawnJoint) -> Array:
    """Draws a curved arrow round a revolute axis where there is room; points (k, 2) on it are returned."""
    x, y, z = joint.axes.T
    # The gap is behind; the head comes round to the front.
    k = 2 if hypot(x[2], y[2]) > 0.1 else 1
    angles = float(np.arctan2(y[k], x[k])) + spaced(-2.6, 1.2, 40)
    circle = np.outer(np.cos(angles), x) + np.outer(np.sin(angles), y)
    choices: list[tuple[float, Array]] = []
    for outward in (z, -z):
        for gap, wide in ((0.55, 1.5), (1.1, 1.5), (0.55, 1.9), (1.7, 1.5)):
            ring = (
                joint.centre
                + (joint.half + gap * joint.radius) * outward
                + wide * joint.radius * circle
            )
            price = (
                2 * joint.radius * float(scene.ink_at(every_pixel(ring[:, :2])).mean() - outward[2])
            )
            choices.append((price + 3 * gap + 3 * wide, ring))
    ring = min(choices, key=lambda choice: choice[0])[1]
    colour, group = SENSE[joint.kind], f"sense {joint.index + 1}"
    # In parts, since some of it passes behind what it goes round.
    for part in np.array_split(np.arange(len(ring) - 4), 4):
        scene.stroke(
            ring[part[0] : part[-1] + 2], 1.5, colour=colour, css="sense", group=group, halo=1.1
        )
    head = _head(ring[-1, :2], ring[-1, :2] - ring[-7, :2], 7.0)
    scene.overlay(f'<polygon class="head" points="{head}" fill="{colour}"/>', ring[-6:, :2], 4.0)
    scene.mark(ring[:, :2], 3.0)
    return ring[[38, 26, 18, 10, 0], :2]


def _sliding(scene: Scene, joint: DrawnJoint) -> Array:
    """Draws a straight arrow along a prismatic axis beside its body; points (k, 2) on it are returned."""
    flat = (
        unit(joint.axis[:2]) if hypot(joint.axis[0], joint.axis[1]) > 0.05 else np.array([1.0, 0.0])
    )
    side, reach = np.array([-flat[1], flat[0], 0.0]), max(1.15 * joint.half, 18.0) * joint.axis
    choices: list[tuple[float, Array]] = []
    for gap in (6.0, 9.0, 14.0):
        for sign in (1.0, -1.0):
            middle = joint.centre + sign * (1.35 * joint.radius + gap) * side
            ends = np.stack([middle - reach, middle + reach])
            choices.append((float(scene.ink_at(every_pixel(ends[:, :2])).sum()) + gap, ends))
    start, end = min(choices, key=lambda choice: choice[0])[1]
    _arrow(scene, start, end, 1.5, colour=SENSE[joint.kind], css="sense")
    return np.stack([start + t * (end - start) for t in (0.5, 0.75, 0.25, 1.0, 0.0)])[:, :2]


def _head(tip: Array, along: Array, size: float) -> str:
    """The corners of an arrowhead."""
    u = unit(along)
    foot, side = tip - size * u, 0.36 * size * np.array([-u[1], u[0]])
    return " ".join(pair(p) for p in (tip, foot + side, foot - side))


def _arrow(scene: Scene, start: Array, end: Array, thick: float, *, colour: str, css: str) -> None:
    """Draws an arrow above the arm; one that points at the viewer, or away, is a ring with a dot or a cross."""
    a, b = start[:2], end[:2]
    length = norm(b - a)
    if length < 6:
        dot = f'<circle cx="{n(b[0])}" cy="{n(b[1])}" r="1.5" fill="{colour}"/>'
        crossed = f'<path d="M{pair(b - 3)}l6 6m0 -6l-6 6" stroke="{colour}" stroke-width="1.2"/>'
        ring = f'<circle cx="{n(b[0])}" cy="{n(b[1])}" r="4.2" fill="#fff" stroke="{colour}" stroke-width="1.3"/>'
        mark = dot if end[2] > start[2] else crossed
        scene.overlay(f'<g class="{css}">{ring}{mark}</g>', np.stack([b - 4, b + 4]))
        return
    size = min(8.0, 0.6 * length)
    shaft, head = (
        f'd="M{pair(a)}L{pair(b - 0.7 * size * unit(b - a))}"',
        f'points="{_head(b, b - a, size)}"',
    )
    scene.overlay(
        f'<g class="{css}"><path {shaft} stroke="#fff" stroke-width="{n(thick + 2)}"/>'
        f'<polygon {head} fill="#fff" stroke="#fff" stroke-width="2"/>'
        f'<path {shaft} stroke="{colour}" stroke-width="{n(thick)}"/><polygon {head} fill="{colour}"/></g>',
        np.stack([a, b]),
    )


def _triad(scene: Scene, arm: DrawnArm, triad: Triad, tips: Array) -> None:
    """Draws a frame as three arrows named x, y and z; at the tool they reach past the finger `tips`."""
    origin, axes = arm.view.points(triad.pose[:3, 3]), arm.view.turn @ triad.pose[:3, :3]
    length = max(3.6 * arm.radius, 34.0)
    if norm(origin - arm.end) < 1:
        length = max(length, min(norm(tips - origin) + 12, 1.4 * length))
    for k in np.argsort(axes[2], kind="stable"):  # the one nearest to the viewer last
        name, tip, away = "xyz"[k], origin + length * axes[:, k], unit(axes[:2, k])
        _arrow(scene, origin, tip, 1.7, colour=AXES[name], css=f"triad {name}")
        scene.labels.append(
            Label(name, triad.label, tip[None, :2], away[None], AXES[name], "triad-label")
        )


def _dimension(scene: Scene, arm: DrawnArm, dimension: Dimension) -> None:
    """Draws a dimension line beside what it measures; between points too close for it the arrows stand outside."""
    a, b = (
        arm.view.points(np.array(p, dtype=np.float64))[:2] for p in (dimension.start, dimension.end)
    )
    along = unit(b - a) if norm(b - a) > 0.5 else np.array([1.0, 0.0])
    offset = _beside(scene, a, b, np.array([-along[1], along[0]]))
    start, end = a + offset, b + offset
    reach = 0.0 * along if norm(b - a) >= 18 else 10.0 * along
    line = np.stack([start - reach, end + reach])
    over = 4 * unit(offset)
    feet = [
        np.stack([scene.emerging(p + 0.12 * offset, p + offset), p + offset + over]) for p in (a, b)
    ]
    lines = "".join(f"M{pair(p)}L{pair(q)}" for p, q in (*feet, line))
    outwards = -along if reach.any() else along
    heads = "".join(
        f'<polygon points="{_head(p, way, 6.5)}" fill="{INK}"/>'
        for p, way in ((start, -outwards), (end, outwards))
    )
    scene.overlay(
        f'<g class="dimension"><path d="{lines}" fill="none" stroke="#fff" stroke-width="2.8"/>'
        f'<path d="{lines}" fill="none" stroke="{INK}" stroke-width=".8"/>{heads}</g>',
        line,
    )
    for foot in feet:
        scene.mark(foot, 2.0)
    spots = np.stack([line[0] + t * (line[1] - line[0]) for t in (0.5, 0.33, 0.67, 0.17, 0.83)])
    away = np.tile(unit(offset), (len(spots), 1))
    scene.labels.append(Label(*symbol_of(dimension.name), spots, away, INK, "dimension-label"))


def _beside(scene: Scene, a: Array, b: Array, side: Array) -> Array:
    """How far to move the dimension line of `a` and `b`: the side and the distance at which it crosses least."""
    gaps = np.arange(16.0, 78.0, 4.0)
    offsets = np.column_stack([gaps, -gaps]).reshape(-1)
    ends = np.stack([a, b]) + offsets[:, None, None] * side
    lines = ends[:, :1] + spaced(0, 1, int(norm(b - a)) + 2)[:, None] * (ends[:, 1:] - ends[:, :1])
    price = np.abs(offsets) + 3 * norm(b - a) * scene.ink_at(lines).mean(1)
    price += 20 * np.maximum(np.abs(ends[:, :, 0]) - scene.width / 2 + 10, 0).sum(1)
    feet = (
        np.stack([a, b])[:, None]
        + spaced(0.12, 1, 24)[:, None] * offsets[:, None, None, None] * side
    )
    ink = scene.ink_at(feet)
    # The extension lines begin where they come out of the arm; one that never does has no room to stand.
    within = np.cumprod(ink > 0, axis=-1)
    price += 4 * np.abs(offsets) * np.where(within, 0.0, ink).mean(-1).sum(-1) + 15 * within[
        ..., -1
    ].sum(-1)
    return float(offsets[np.argmin(price)]) * side
