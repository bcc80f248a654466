"""The picture of an arm: joints, links, base, gripper, axes, frames and dimensions, as SVG."""

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import hypot

import numpy as np

from ..exercises.drawing import Dimension, Drawing, Triad
from ..solutions.expression import latex_name
from ..solutions.kinematics import frames
from .scene import Array, Label, Scene, camera, every_pixel, n, norm, outside, pair, spaced, span_inside, unit

LINK, ROD, BASE, GRIPPER = "#7d8896", "#c3ccd6", "#4a5361", "#39404a"
JOINT = {"R": "#e9a23b", "P": "#4fa79d"}
SENSE = {"R": "#8a4b00", "P": "#0b5f56"}
CLASS = {"R": "revolute", "P": "prismatic"}
AXES = {"x": "#b3261e", "y": "#1c7433", "z": "#1d4fb8"}
INK, CENTRE_LINE = "#1b1f24", "#33383f"
GAP = 5.0  # [px] between two joints' bodies


@dataclass(frozen=True, eq=False)
class View:
    """From base coordinates [m] to camera coordinates [px]."""

    turn: Array
    scale: float
    shift: Array

    def points(self, p: Array) -> Array:
        """Camera coordinates (..., 3) of points (..., 3)."""
        return p @ self.turn.T * self.scale + self.shift


@dataclass(frozen=True, eq=False)
class Joint:
    """Joint `index` (from 0) in camera coordinates: its frame, and where its body sits on its axis."""

    index: int
    kind: str
    origin: Array
    axes: Array
    centre: Array
    radius: float

    @property
    def axis(self) -> Array:
        """The unit vector (3,) about or along which it moves."""
        return self.axes[:, 2]

    @property
    def half(self) -> float:
        """Half the length of the body [px]."""
        return self.radius * (1.25 if self.kind == "R" else 1.7)


@dataclass(frozen=True, eq=False)
class Arm:
    """An arm in camera coordinates.

    `paths[0]` leads from the base to joint 1 and `paths[i]` from joint i to the next or the tool: along the z axis
    first, then straight; each is (3, 3), with points that may coincide. `radius` is that of a large joint.
    """

    view: View
    paths: list[Array]
    joints: list[Joint]
    tool: Array
    radius: float

    @property
    def end(self) -> Array:
        """The tool point (3,)."""
        return self.paths[-1][2]

    @property
    def grip(self) -> float:
        """How far the palm stands behind the finger tips [px]."""
        return 1.4 * self.radius


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
    _base(scene, arm, bodies)
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


def pose(drawing: Drawing, width: float) -> Arm:
    """The arm of `drawing` in camera coordinates, as large as the picture allows."""
    poses = frames(drawing.chain, np.asarray(drawing.q, dtype=np.float64))
    origins = np.vstack([np.zeros(3), poses[:, :3, 3]])
    along = np.vstack([[0.0, 0.0, 1.0], poses[:-1, :3, 2]])
    elbows = origins[:-1] + np.sum(np.diff(origins, axis=0) * along, axis=1)[:, None] * along
    view = _fitted(drawing, np.vstack([origins, elbows]), width)
    paths = [view.points(np.stack(p)) for p in zip(origins[:-1], elbows, origins[1:], strict=True)]
    kinds = drawing.chain.kinds
    length = sum(norm(b - a) for path in paths for a, b in pairwise(path))
    size = width / 420
    radius = float(np.clip(0.115 * length / len(kinds), 8.5 * size, 13 * size))
    joints = _seated(kinds, paths, view.turn @ poses[:-1, :3, :3], radius)
    return Arm(view, paths, joints, view.turn @ poses[-1, :3, :3], radius)


def _fitted(drawing: Drawing, points: Array, width: float) -> View:
    """The view in which `points`, the triads, the dimensions and what is drawn round them fill the picture."""
    turn, size = camera(*drawing.view), width / 420
    spots = [(p, np.full(3, -30.0), np.full(3, 30.0)) for p in points]
    spots.append((np.zeros(3), np.array([-44.0, -18.0, 0.0]), np.array([44.0, 34.0, 0.0])))
    for triad in drawing.triads:
        tips = 54.0 * (turn @ triad.pose[:3, :3]).T
        spots.append((triad.pose[:3, 3], tips.min(0) - 6, tips.max(0) + 6))
    ends = [np.array(end) for dimension in drawing.dimensions for end in (dimension.start, dimension.end)]
    spots += [(end, np.full(3, -34.0), np.full(3, 34.0)) for end in ends]
    at = np.array([turn @ p for p, _, _ in spots])
    low, high = np.array([s[1] for s in spots]) * size, np.array([s[2] for s in spots]) * size
    extent = norm(at.max(0) - at.min(0))
    scale = 0.8 * width / extent if extent else 1.0
    for k, room in ((0, width - 24.0 * size), (1, 1.05 * width)):
        apart = at[:, None, k] - at[None, :, k]
        # Never smaller than a tenth of the picture, whatever stands round the arm.
        spare = np.maximum(room - high[:, None, k] + low[None, :, k], 0.1 * width)
        far = apart > 1e-9 * extent
        scale = min(scale, float(np.min(spare[far] / apart[far], initial=np.inf)))
    middle = ((at * scale + low).min(0) + (at * scale + high).max(0)) / 2
    return View(turn, scale, np.array([-middle[0], -middle[1], 0.0]))


def _seated(kinds: str, paths: list[Array], axes: Array, radius: float) -> list[Joint]:
    """The joints with their bodies slid along their axes until they stand clear of one another.

    Joints that cannot move along a link of their own choose first; the rest make room.
    """
    spans = [_span(paths[i], paths[i + 1], axes[i, :, 2]) for i in range(len(kinds))]
    origins = np.array([path[0] for path in paths[1:]])
    joints: list[Joint] = []
    for i, kind in enumerate(kinds):
        # The hand of an arm is finer than its shoulder, and a wrist finer still.
        crowd = int(np.sum(np.linalg.norm(origins - origins[i], axis=1) < 2.2 * radius))
        tight = crowd > 1 and spans[i][1] - spans[i][0] < 3 * radius
        size = radius * (1 - 0.28 * i / max(len(kinds) - 1, 1)) * (0.86 if tight else 1.0)
        joints.append(Joint(i, kind, origins[i], axes[i], origins[i], size))
    seated: dict[int, Joint] = {}
    for i in sorted(range(len(kinds)), key=lambda i: (spans[i][1] - spans[i][0] > GAP, i == 0, i)):
        seated[i] = _seat(joints[i], spans[i], list(seated.values()), late=i > (len(kinds) - 1) / 2)
    return [seated[i] for i in range(len(kinds))]


def _span(before: Array, after: Array, axis: Array) -> tuple[float, float]:
    """From where to where [px] links run along a joint's axis, with its origin at 0."""
    origin = after[0]
    back = _last_step(before)
    behind = -float(back @ axis) if abs(float(unit(back) @ axis)) > 0.999 else 0.0
    ahead = float((after[1] - origin) @ axis)
    return min(0.0, behind, ahead), max(0.0, behind, ahead)


def _last_step(path: Array, least: float = 0.5) -> Array:
    """The last piece of `path` that is longer than `least` pixels, as a vector; zero if there is none."""
    steps = (path[2] - start for start in (path[1], path[0]))
    return next((step for step in steps if norm(step) > least), np.zeros(3))


def _seat(joint: Joint, span: tuple[float, float], seated: Sequence[Joint], *, late: bool) -> Joint:
    """`joint` moved to the best place on its axis; off its `span`, a `late` joint gives way forwards."""
    reach = 7 * joint.radius
    t = np.concatenate([[0.0], spaced(span[0] - reach, span[1] + reach, 121), spaced(*span, 41)])
    ahead = span[1] if span[1] > -span[0] else span[0]
    wished = 0.0 if joint.kind == "R" else float(np.clip(0.35 * ahead, -5 * joint.radius, 5 * joint.radius))
    price = 0.15 * np.abs(t - wished) + np.maximum(0, np.maximum(span[0] - t, t - span[1]))
    price += 0.4 * np.maximum(0, -t if late else t)
    steps = np.array([-1.0, 0.0, 1.0])
    mine = joint.origin + (t[:, None, None] + steps[:, None] * (joint.half - 0.6 * joint.radius)) * joint.axis
    for other in seated:
        theirs = other.centre + steps[:, None] * (other.half - 0.6 * other.radius) * other.axis
        apart = np.sqrt(((mine[:, :, None] - theirs) ** 2).sum(-1)).min((1, 2))
        tight = joint.radius + other.radius + GAP - apart
        price += 6 * np.maximum(0, tight) + 0.5 * np.maximum(0, tight + 1.6 * joint.radius)
    return replace(joint, centre=joint.origin + t[np.argmin(price)] * joint.axis)


def _body(scene: Scene, joint: Joint) -> Array:
    """Draws the joint's body; its half-spaces are returned."""
    css, group = f"joint {CLASS[joint.kind]}", f"joint {joint.index + 1}"
    if joint.kind == "P":
        half = np.array([0.95 * joint.radius, 0.95 * joint.radius, joint.half])
        return scene.box(joint.centre, joint.axes, half, colour=JOINT["P"], css=css, group=group)
    ends = (joint.centre - joint.half * joint.axis, joint.centre + joint.half * joint.axis)
    return scene.tube(*ends, joint.radius, colour=JOINT["R"], css=css, group=group, facets=16, capped=True)


def _base(scene: Scene, arm: Arm, bodies: Sequence[Array]) -> None:
    """Draws the base plate under the base frame and under the joints that sit there, and the column on it."""
    up, foot, r = arm.view.turn[:, 2], arm.paths[0][0], arm.radius
    drop = 0.0
    for joint in arm.joints:
        height, lean = float((joint.centre - foot) @ up), min(abs(float(joint.axis @ up)), 1.0)
        aside = norm(joint.centre - foot - height * up)
        if aside < 3 * r and abs(height) < 6 * r:
            drop = min(drop, height - joint.half * lean - joint.radius * (1 - lean**2) ** 0.5)
    top = foot + drop * up
    plate = scene.tube(top - 0.6 * r * up, top, 3.1 * r, colour=BASE, css="base", group="base", facets=20, capped=True)
    _pipe(scene, [top, *arm.paths[0]], 0.5 * r, [*bodies, plate], colour=LINK, group="base link")


def _link(scene: Scene, arm: Arm, joint: Joint, bodies: Sequence[Array]) -> None:
    """Draws the link behind `joint`; a prismatic joint's slides out of its body."""
    path, following = arm.paths[joint.index + 1], arm.joints[joint.index + 1 : joint.index + 2] or [joint]
    radius = 0.3 + 0.42 * (joint.radius + following[0].radius) / 2
    points = list(path)
    if following[0] is joint:
        # The last link ends at the palm.
        points = [*path[:2], path[2] - unit(_last_step(path)) * min(arm.grip, norm(_last_step(path)))]
        if norm(path[2] - path[1]) <= 0.5:
            points[1] = points[2]
    group = f"link {joint.index + 1}"
    if joint.kind == "R":
        _pipe(scene, [joint.centre, *points], radius, bodies, colour=LINK, group=group)
        return
    _pipe(scene, [path[0], joint.centre], radius, bodies, colour=LINK, group=f"guide {joint.index + 1}")
    _pipe(scene, [joint.centre, points[1]], 0.7 * radius, bodies, colour=ROD, group=group)
    _pipe(scene, points[1:], radius, bodies, colour=LINK, group=group)


def _pipe(
    scene: Scene, points: Sequence[Array], radius: float, solids: Sequence[Array], *, colour: str, group: str
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
            start, end = a + max(0.0, first - inward) * (b - a), a + min(1.0, last + inward) * (b - a)
            rounded = (first == 0.0 and k > 0, last == 1.0 and k < len(knots) - 2)
            scene.tube(start, end, radius, colour=colour, css="link", group=group, rounded=rounded)


def _hand(scene: Scene, arm: Arm, bodies: Sequence[Array]) -> Array:
    """Draws a gripper along the last link, or along the tool's z axis if there is none.

    Its finger tips, whose middle (3,) is returned, are at the tool point, or before the last body if the tool point
    is inside that.
    """
    step, r = _last_step(arm.paths[-1], 2.0), arm.radius
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
    sides = [unit(axis - (axis @ ahead) * ahead) for axis in arm.tool.T if abs(float(axis @ ahead)) < 0.9]
    across = 0.8 * r * max(sides, key=lambda v: abs(float(v[0] * ahead[1] - v[1] * ahead[0])))
    thick = max(0.15 * r, 1.6)
    fingers = [(palm + side, palm + side + arm.grip * ahead, thick) for side in (-across, across)]
    for a, b, radius in [(palm - across, palm + across, 1.25 * thick), *fingers]:
        scene.tube(a, b, radius, colour=GRIPPER, css="gripper", group="gripper", rounded=(True, True))
    return palm + arm.grip * ahead


def _axis(scene: Scene, joint: Joint, bodies: Sequence[Array]) -> None:
    """Draws the joint's axis on both sides of its body, dash-dotted, and over the links that run along it."""
    for outward in (-joint.axis, joint.axis):
        cap = joint.centre + joint.half * outward
        step = 2.6 * joint.radius * outward
        for first, last in outside(cap, cap + step, bodies):
            ends, group = np.stack([cap + first * step, cap + last * step]), f"axis {joint.index + 1}"
            scene.stroke(
                ends, 0.9, colour=CENTRE_LINE, css="axis", group=group, dashes="6 2.2 1 2.2", lift=joint.radius
            )


def _sense(scene: Scene, joint: Joint, *, arrows: bool) -> None:
    """Draws the arrow of the joint's positive sense and puts its label there, or else at the axis or the body."""
    centre, flat = joint.centre[:2], joint.axis[:2]
    if arrows:
        spots = _turning(scene, joint) if joint.kind == "R" else _sliding(scene, joint)
    else:
        tip, side = (joint.half + 2.6 * joint.radius) * flat, joint.radius * np.array([-flat[1], flat[0]])
        spots = centre + np.stack([tip, side, -side, -tip])
    away = np.stack([unit(spot - centre) for spot in spots])
    owner, css = np.vstack([spots, centre]), f"joint-label {CLASS[joint.kind]}"
    scene.labels.append(Label("q", str(joint.index + 1), spots, away, SENSE[joint.kind], css, owner))


def _turning(scene: Scene, joint: Joint) -> Array:
    """Draws a curved arrow round a revolute axis where there is room; points (k, 2) on it are returned."""
    x, y, z = joint.axes.T
    # The gap is behind; the head comes round to the front.
    k = 2 if hypot(x[2], y[2]) > 0.1 else 1
    angles = float(np.arctan2(y[k], x[k])) + spaced(-2.6, 1.2, 40)
    circle = np.outer(np.cos(angles), x) + np.outer(np.sin(angles), y)
    choices: list[tuple[float, Array]] = []
    for outward in (z, -z):
        for gap, wide in ((0.55, 1.5), (1.1, 1.5), (0.55, 1.9), (1.7, 1.5)):
            ring = joint.centre + (joint.half + gap * joint.radius) * outward + wide * joint.radius * circle
            price = 2 * joint.radius * float(scene.ink_at(every_pixel(ring[:, :2])).mean() - outward[2])
            choices.append((price + 3 * gap + 3 * wide, ring))
    ring = min(choices, key=lambda choice: choice[0])[1]
    colour, group = SENSE[joint.kind], f"sense {joint.index + 1}"
    # In parts, since some of it passes behind what it goes round.
    for part in np.array_split(np.arange(len(ring) - 4), 4):
        scene.stroke(ring[part[0] : part[-1] + 2], 1.5, colour=colour, css="sense", group=group, halo=1.1)
    head = _head(ring[-1, :2], ring[-1, :2] - ring[-7, :2], 7.0)
    scene.overlay(f'<polygon class="head" points="{head}" fill="{colour}"/>', ring[-6:, :2], 4.0)
    scene.mark(ring[:, :2], 3.0)
    return ring[[38, 26, 18, 10, 0], :2]


def _sliding(scene: Scene, joint: Joint) -> Array:
    """Draws a straight arrow along a prismatic axis beside its body; points (k, 2) on it are returned."""
    flat = unit(joint.axis[:2]) if hypot(joint.axis[0], joint.axis[1]) > 0.05 else np.array([1.0, 0.0])
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
    shaft, head = f'd="M{pair(a)}L{pair(b - 0.7 * size * unit(b - a))}"', f'points="{_head(b, b - a, size)}"'
    scene.overlay(
        f'<g class="{css}"><path {shaft} stroke="#fff" stroke-width="{n(thick + 2)}"/>'
        f'<polygon {head} fill="#fff" stroke="#fff" stroke-width="2"/>'
        f'<path {shaft} stroke="{colour}" stroke-width="{n(thick)}"/><polygon {head} fill="{colour}"/></g>',
        np.stack([a, b]),
    )


def _triad(scene: Scene, arm: Arm, triad: Triad, tips: Array) -> None:
    """Draws a frame as three arrows named x, y and z; at the tool they reach past the finger `tips`."""
    origin, axes = arm.view.points(triad.pose[:3, 3]), arm.view.turn @ triad.pose[:3, :3]
    length = max(3.6 * arm.radius, 34.0)
    if norm(origin - arm.end) < 1:
        length = max(length, min(norm(tips - origin) + 12, 1.4 * length))
    for k in np.argsort(axes[2], kind="stable"):  # the one nearest to the viewer last
        name, tip, away = "xyz"[k], origin + length * axes[:, k], unit(axes[:2, k])
        _arrow(scene, origin, tip, 1.7, colour=AXES[name], css=f"triad {name}")
        scene.labels.append(Label(name, triad.label, tip[None, :2], away[None], AXES[name], "triad-label"))


def _dimension(scene: Scene, arm: Arm, dimension: Dimension) -> None:
    """Draws a dimension line beside what it measures; between points too close for it the arrows stand outside."""
    a, b = (arm.view.points(np.array(p, dtype=np.float64))[:2] for p in (dimension.start, dimension.end))
    along = unit(b - a) if norm(b - a) > 0.5 else np.array([1.0, 0.0])
    offset = _beside(scene, a, b, np.array([-along[1], along[0]]))
    start, end = a + offset, b + offset
    reach = 0.0 * along if norm(b - a) >= 18 else 10.0 * along
    line = np.stack([start - reach, end + reach])
    over = 4 * unit(offset)
    feet = [np.stack([scene.emerging(p + 0.12 * offset, p + offset), p + offset + over]) for p in (a, b)]
    lines = "".join(f"M{pair(p)}L{pair(q)}" for p, q in (*feet, line))
    outwards = -along if reach.any() else along
    heads = "".join(
        f'<polygon points="{_head(p, way, 6.5)}" fill="{INK}"/>' for p, way in ((start, -outwards), (end, outwards))
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
    feet = np.stack([a, b])[:, None] + spaced(0.12, 1, 24)[:, None] * offsets[:, None, None, None] * side
    ink = scene.ink_at(feet)
    # The extension lines begin where they come out of the arm; one that never does has no room to stand.
    within = np.cumprod(ink > 0, axis=-1)
    price += 4 * np.abs(offsets) * np.where(within, 0.0, ink).mean(-1).sum(-1) + 15 * within[..., -1].sum(-1)
    return float(offsets[np.argmin(price)]) * side


def symbol_of(name: str) -> tuple[str, str]:
    r"""A parameter's letter and its subscript: "a1" is a with 1, "alpha2" the Greek letter with 2, "L" just L."""
    match = re.fullmatch(r"(?:\\mathrm\{(\w+)\}|(\\?)(\w+?))(?:_\{?(\d+)\}?)?", latex_name(name))
    if match is None:
        return name, ""
    word, greek, letter, subscript = match.groups(default="")
    return unicodedata.lookup(f"GREEK SMALL LETTER {letter.upper()}") if greek else word or letter, subscript
