"""The picture of an arm: joints, links, base, gripper, axes, frames and dimensions, as SVG."""

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, hypot, pi, sin

import numpy as np

from ..exercises.drawing import Dimension, Drawing, Triad
from ..solutions.kinematics import frames
from .scene import Array, Label, Scene, camera, n, outside, pair, span_inside, square_to, unit

LINK, ROD, BASE, GRIPPER = "#7d8896", "#c3ccd6", "#4a5361", "#39404a"
JOINT = {"R": "#e9a23b", "P": "#4fa79d"}
SENSE = {"R": "#8a4b00", "P": "#0b5f56"}
AXES = {"x": "#b3261e", "y": "#1c7433", "z": "#1d4fb8"}
INK = "#1b1f24"
CLASS = {"R": "revolute", "P": "prismatic"}


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


def draw(drawing: Drawing, width: float = 420) -> str:
    """The SVG of an arm, `width` pixels wide: the same text for the same drawing.

    Raises:
        KinegradeError: `drawing.q` does not fit `drawing.chain`.
    """
    return compose(drawing, width).svg(drawing.caption, drawing.alt)


def compose(drawing: Drawing, width: float) -> Scene:
    """The arm as a scene that can be looked into before it is written."""
    arm = pose(drawing, width)
    scene = Scene(width)
    bodies = [_body(scene, joint) for joint in arm.joints]
    _base(scene, arm, bodies)
    for i in range(len(arm.paths) - 1):
        _link(scene, arm, i, bodies)
    tips = _hand(scene, arm, bodies)
    for joint in arm.joints:
        _axis(scene, joint, bodies)
    for joint in arm.joints:
        _sense(scene, joint, drawing.arrows)
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
    steps = np.diff(origins, axis=0)
    elbows = origins[:-1] + np.sum(steps * along, axis=1)[:, None] * along
    view = _fitted(drawing, np.vstack([origins, elbows]), width)
    paths = [view.points(np.stack(p)) for p in zip(origins[:-1], elbows, origins[1:], strict=True)]
    kinds = drawing.chain.kinds
    length = sum(float(np.linalg.norm(np.diff(p, axis=0), axis=1).sum()) for p in paths)
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
    spots += [(np.array(p), np.full(3, -34.0), np.full(3, 34.0)) for d in drawing.dimensions for p in (d.start, d.end)]
    at = np.array([turn @ p for p, _, _ in spots])
    low, high = np.array([s[1] for s in spots]) * size, np.array([s[2] for s in spots]) * size
    extent = float(np.linalg.norm(at.max(0) - at.min(0)))
    if extent == 0.0:
        return View(turn, 1.0, np.zeros(3))
    room = np.array([width - 24.0 * size, 1.05 * width])
    scale = 0.8 * width / extent
    for k in (0, 1):
        apart = at[:, None, k] - at[None, :, k]
        spare = room[k] - high[:, None, k] + low[None, :, k]
        # Never smaller than a tenth of the picture, whatever stands round the arm.
        allowed = np.maximum(spare, 0.1 * width)[apart > 1e-9 * extent] / apart[apart > 1e-9 * extent]
        scale = min(scale, float(allowed.min(initial=np.inf)))
    middle = ((at * scale + low).min(0) + (at * scale + high).max(0)) / 2
    return View(turn, scale, np.array([-middle[0], -middle[1], 0.0]))


def _seated(kinds: str, paths: list[Array], axes: Array, radius: float) -> list[Joint]:
    """The joints with their bodies slid along their axes until they stand clear of one another.

    Joints that cannot move along a link of their own choose first; the rest make room.
    """
    count = len(kinds)
    origins = np.array([p[0] for p in paths[1:]])
    ranges: list[tuple[float, float]] = []
    for i in range(count):
        z = axes[i, :, 2]
        before = next((p for p in (paths[i][1], paths[i][0]) if np.linalg.norm(p - origins[i]) > 0.5), origins[i])
        back = before - origins[i]
        behind = float(back @ z) if abs(unit(back) @ z) > 0.999 else 0.0
        ahead = float((paths[i + 1][1] - origins[i]) @ z)
        ranges.append((min(0.0, behind, ahead), max(0.0, behind, ahead)))
    sizes: list[float] = []
    for i in range(count):
        taper = 1 - 0.28 * i / max(count - 1, 1)
        crowd = np.linalg.norm(origins - origins[i], axis=1) < 2.2 * radius
        tight = crowd.sum() > 1 and ranges[i][1] - ranges[i][0] < 3 * radius
        sizes.append(radius * taper * (0.86 if tight else 1.0))
    seated: dict[int, Joint] = {}
    for i in sorted(range(count), key=lambda i: (ranges[i][1] - ranges[i][0] > 5, i == 0, i)):
        seated[i] = _seat(Joint(i, kinds[i], origins[i], axes[i], origins[i], sizes[i]), ranges[i], seated, count)
    return [seated[i] for i in range(count)]


def _seat(joint: Joint, span: tuple[float, float], seated: dict[int, Joint], count: int) -> Joint:
    """`joint` moved to the cheapest place on its axis; `span` is where a link runs along it."""
    reach = 7 * joint.radius
    t = np.unique(np.concatenate([[0.0], np.linspace(span[0] - reach, span[1] + reach, 121), np.linspace(*span, 41)]))
    ahead = span[1] if span[1] > -span[0] else span[0]
    wished = 0.0 if joint.kind == "R" else float(np.clip(0.35 * ahead, -5 * joint.radius, 5 * joint.radius))
    price = 0.15 * np.abs(t - wished) + 1.0 * np.maximum(0, np.maximum(span[0] - t, t - span[1]))
    price += 0.4 * np.maximum(0, -t if joint.index > (count - 1) / 2 else t)
    for other in seated.values():
        knots = joint.origin + np.multiply.outer(t, joint.axis)
        tight = joint.radius + other.radius + 5 - _clearance(joint, other, knots)
        price += 6 * np.maximum(0, tight) + 0.5 * np.maximum(0, tight + 1.6 * joint.radius)
    return Joint(
        joint.index, joint.kind, joint.origin, joint.axes, joint.origin + t[np.argmin(price)] * joint.axis, joint.radius
    )


def _clearance(joint: Joint, other: Joint, knots: Array) -> Array:
    """Distance of the cores of two bodies, with that of `joint` at each of `knots` (k, 3)."""
    steps = np.array([-1.0, 0.0, 1.0])
    mine = knots[:, None] + np.multiply.outer(steps * (joint.half - 0.6 * joint.radius), joint.axis)
    theirs = other.centre + np.multiply.outer(steps * (other.half - 0.6 * other.radius), other.axis)
    return np.linalg.norm(mine[:, :, None] - theirs, axis=-1).min((1, 2))


def _body(scene: Scene, joint: Joint) -> Array:
    """Draws the joint's body; its half-spaces are returned."""
    css, group, reach = f"joint {CLASS[joint.kind]}", f"joint {joint.index + 1}", joint.half * joint.axis
    if joint.kind == "P":
        half = np.array([joint.radius * 0.95, joint.radius * 0.95, joint.half])
        item = scene.box(joint.centre, joint.axes, half, JOINT["P"], css, group)
    else:
        item = scene.tube(
            joint.centre - reach, joint.centre + reach, joint.radius, JOINT["R"], css, group, facets=16, capped=True
        )
    assert item.planes is not None  # noqa: S101 (bodies are solids)
    return item.planes


def _base(scene: Scene, arm: Arm, bodies: list[Array]) -> None:
    """Draws the base plate under the base frame and under the joints that sit there, and the column on it."""
    up, foot, r = arm.view.turn @ [0.0, 0.0, 1.0], arm.paths[0][0], arm.radius
    drop = 0.0
    for joint in arm.joints:
        lean = abs(float(joint.axis @ up))
        below = joint.half * lean + joint.radius * (1 - min(lean, 1.0) ** 2) ** 0.5
        offset = joint.centre - foot
        if np.linalg.norm(offset - (offset @ up) * up) < 3 * r and np.linalg.norm(offset) < 6 * r:
            drop = min(drop, float(offset @ up) - below)
    top = foot + drop * up
    plate = scene.tube(top - 0.6 * r * up, top, 3.1 * r, BASE, "base", "base", facets=20, capped=True)
    assert plate.planes is not None  # noqa: S101
    _pipe(scene, [top, *arm.paths[0]], 0.5 * r, LINK, "base", [*bodies, plate.planes])


def _link(scene: Scene, arm: Arm, i: int, bodies: list[Array]) -> None:
    """Draws the link behind joint i + 1; a prismatic joint's slides out of its body."""
    joint, path = arm.joints[i], arm.paths[i + 1]
    last = i == len(arm.joints) - 1
    radius = 0.42 * (joint.radius + arm.joints[i if last else i + 1].radius) / 2 + 0.3
    points = list(_shortened(path, _grip(arm)) if last else path)
    if joint.kind == "R":
        _pipe(scene, [joint.centre, *points], radius, LINK, f"link {i + 1}", bodies)
        return
    _pipe(scene, [path[0], joint.centre], radius, LINK, f"slide {i + 1}", bodies)
    _pipe(scene, [joint.centre, points[1]], 0.7 * radius, ROD, f"link {i + 1}", bodies)
    _pipe(scene, points[1:], radius, LINK, f"link {i + 1}", bodies)


def _pipe(
    scene: Scene, points: Sequence[Array], radius: float, colour: str, group: str, solids: Sequence[Array]
) -> None:
    """Draws a bent tube through `points` where it runs outside of the solids."""
    knots = [p for k, p in enumerate(points) if k == 0 or np.linalg.norm(p - points[k - 1]) > 0.3]
    for k, (a, b) in enumerate(zip(knots[:-1], knots[1:], strict=True)):
        for first, last in outside(a, b, solids):
            # A cut end reaches a little into the body that it comes out of.
            inward = min(0.5 * radius, 2.5) / float(np.linalg.norm(b - a))
            from_, to = max(0.0, first - inward), min(1.0, last + inward)
            ends = (first == 0.0 and k > 0, last == 1.0 and k < len(knots) - 2)
            scene.tube(a + from_ * (b - a), a + to * (b - a), radius, colour, "link", group, rounded=ends)


def _approach(arm: Arm) -> Array:
    """The direction in which the gripper points: along the last link, or the tool's z axis if there is none."""
    before = next((p for p in arm.paths[-1][1::-1] if np.linalg.norm(arm.paths[-1][2] - p) > 2), None)
    return arm.tool[:, 2] if before is None else unit(arm.paths[-1][2] - before)


def _grip(arm: Arm) -> float:
    """How far the palm stands behind the tool point [px]."""
    return 1.4 * arm.radius


def _shortened(path: Array, by: float) -> Array:
    """`path` without its last `by` pixels, as far as its last piece is long enough."""
    before = next((p for p in path[1::-1] if np.linalg.norm(path[2] - p) > 2), None)
    if before is None:
        return path
    length = float(np.linalg.norm(path[2] - before))
    end = path[2] - unit(path[2] - before) * min(by, length)
    return np.stack([path[0], path[1] if np.linalg.norm(path[2] - path[1]) > 2 else end, end])


def _hand(scene: Scene, arm: Arm, bodies: list[Array]) -> Array:
    """Draws a gripper with its finger tips at the tool point, or before the last body if the tool
    point is inside it; the middle of the finger tips is returned."""
    a, grip, point = _approach(arm), _grip(arm), arm.paths[-1][2]
    wrist = arm.joints[-1].centre
    reach = 0.0
    palm = point - a * grip
    for solid in bodies:
        span = span_inside(palm, palm + a * 200.0, solid)
        if span is not None and span[0] * 200.0 < 1.5 * grip + reach:
            reach = max(reach, span[1] * 200.0 + 0.35 * arm.radius)
    palm = palm + a * reach
    # The fingers open along the tool axis that shows them best.
    across = max(
        (unit(axis - (axis @ a) * a) for axis in arm.tool.T), key=lambda v: abs(float(v[0] * a[1] - v[1] * a[0]))
    )
    if not across.any():
        across = square_to(a)[0]
    if reach > 0:
        _pipe(scene, [wrist, palm], 0.38 * arm.joints[-1].radius, LINK, "hand", bodies)
    thick = max(0.15 * arm.radius, 1.6)
    wide = 0.8 * arm.radius
    scene.tube(
        palm - across * wide, palm + across * wide, thick * 1.25, GRIPPER, "gripper", "hand", rounded=(True, True)
    )
    for side in (-wide, wide):
        root = palm + across * side
        scene.tube(root, root + a * grip, thick, GRIPPER, "gripper", "hand", rounded=(True, True))
    return palm + a * grip


def _axis(scene: Scene, joint: Joint, bodies: list[Array]) -> None:
    """Draws the joint's axis on both sides of its body, dash-dotted."""
    for sign in (-1.0, 1.0):
        cap = joint.centre + sign * joint.half * joint.axis
        tip = cap + sign * 2.6 * joint.radius * joint.axis
        for first, last in outside(cap, tip, bodies):
            ends = np.stack([cap + first * (tip - cap), cap + last * (tip - cap)])
            scene.stroke(
                ends, "#33383f", 0.9, "axis", f"axis {joint.index + 1}", dashes="6 2.2 1 2.2", lift=joint.radius
            )


def _sense(scene: Scene, joint: Joint, arrows: bool) -> None:
    """Draws the arrow of the joint's positive sense, and its label there; without arrows the label is at the axis."""
    tips = joint.centre + np.multiply.outer([1.0, -1.0], (joint.half + 2.2 * joint.radius) * joint.axis)
    spots, away = tips[:, :2], np.stack([unit(joint.axis[:2]), -unit(joint.axis[:2])])
    if arrows:
        spots = _turning(scene, joint) if joint.kind == "R" else _sliding(scene, joint)
        away = np.stack([unit(p - joint.centre[:2]) for p in spots])
    css = f"joint-label {CLASS[joint.kind]}"
    owner = np.vstack([spots, joint.centre[:2]])
    scene.labels.append(Label("q", str(joint.index + 1), spots, away, SENSE[joint.kind], css, owner))


def _turning(scene: Scene, joint: Joint) -> Array:
    """Draws a curved arrow round a revolute axis where there is room; points on it are returned."""
    x, y, z = joint.axes.T
    # The gap is behind, the head comes round to the front.
    front = float(np.arctan2(y[2], x[2])) if hypot(x[2], y[2]) > 0.1 else float(np.arctan2(y[1], x[1]))
    angles = front + np.linspace(-2.6, 1.2, 40)
    choices: list[tuple[float, Array]] = []
    for sign in (1.0, -1.0):
        for gap, wide in ((0.55, 1.5), (1.1, 1.5), (0.55, 1.9), (1.7, 1.5)):
            middle = joint.centre + sign * (joint.half + gap * joint.radius) * z
            ring = middle + wide * joint.radius * (np.outer(np.cos(angles), x) + np.outer(np.sin(angles), y))
            hidden = -sign * float(z[2]) * 2.0 * joint.radius
            price = scene.ink_along(ring[:, :2]) / len(angles) * joint.radius * 2 + hidden + 3 * gap + 3 * wide
            choices.append((price, ring))
    ring = min(choices, key=lambda choice: choice[0])[1]
    colour, group = SENSE[joint.kind], f"sense {joint.index + 1}"
    for part in np.array_split(np.arange(len(ring) - 4), 4):
        scene.stroke(ring[part[0] : part[-1] + 2], colour, 1.5, "sense", group, halo=1.1)
    head = _head(ring[-1, :2], ring[-1, :2] - ring[-7, :2], 7.0)
    scene.overlay(f'<polygon class="head" points="{head}" fill="{colour}"/>', ring[-6:, :2], 4.0)
    scene.mark(ring[:, :2], 3.0)
    return ring[[38, 26, 18, 10, 0], :2]


def _sliding(scene: Scene, joint: Joint) -> Array:
    """Draws a straight arrow along a prismatic axis beside its body; points beside it are returned."""
    z, colour = joint.axis, SENSE[joint.kind]
    flat = unit(z[:2]) if hypot(z[0], z[1]) > 0.05 else np.array([1.0, 0.0])
    side = np.array([-flat[1], flat[0], 0.0])
    reach = max(joint.half * 1.15, 18.0)
    choices: list[tuple[float, Array]] = []
    for sign in (1.0, -1.0):
        for gap in (6.0, 9.0, 14.0):
            middle = joint.centre + sign * side * (1.35 * joint.radius + gap)
            ends = np.stack([middle - reach * z, middle + reach * z])
            choices.append((scene.ink_along(ends[:, :2]) + gap, ends))
    start, end = min(choices, key=lambda choice: choice[0])[1]
    _arrow(scene, start, end, colour, "sense", 1.5)
    return np.linspace(start[:2], end[:2], 5)[[2, 3, 1, 4, 0]]


def _head(tip: Array, along: Array, size: float) -> str:
    """The corners of an arrowhead."""
    u = unit(along)
    foot, side = tip - size * u, 0.36 * size * np.array([-u[1], u[0]])
    return f"{pair(tip)} {pair(foot + side)} {pair(foot - side)}".replace(" ", ",")


def _arrow(scene: Scene, start: Array, end: Array, colour: str, css: str, thick: float) -> None:
    """Draws an arrow above the arm; one that points at the viewer, or away, is a ring with a dot or a cross."""
    a, b = start[:2], end[:2]
    if hypot(*(b - a)) < 6:
        x, y = b
        mark = (
            f'<circle cx="{n(x)}" cy="{n(y)}" r="1.5" fill="{colour}"/>'
            if end[2] > start[2]
            else f'<path d="M{n(x - 3)} {n(y - 3)}l6 6m0 -6l-6 6" stroke="{colour}" stroke-width="1.2"/>'
        )
        ring = f'<circle cx="{n(x)}" cy="{n(y)}" r="4.2" fill="#fff" stroke="{colour}" stroke-width="1.3"/>'
        scene.overlay(f'<g class="{css}">{ring}{mark}</g>', np.stack([b - 4, b + 4]))
        return
    size = min(8.0, 0.6 * hypot(*(b - a)))
    shaft = f'd="M{pair(a)}L{pair(b - 0.7 * size * unit(b - a))}"'
    head = f'points="{_head(b, b - a, size)}"'
    scene.overlay(
        f'<g class="{css}"><path {shaft} stroke="#fff" stroke-width="{n(thick + 2)}"/><polygon {head} fill="#fff" '
        f'stroke="#fff" stroke-width="2"/><path {shaft} stroke="{colour}" stroke-width="{n(thick)}"/>'
        f'<polygon {head} fill="{colour}"/></g>',
        np.stack([a, b]),
    )


def _triad(scene: Scene, arm: Arm, triad: Triad, tips: Array) -> None:
    """Draws a frame as three arrows named x, y and z; at the tool they reach past the finger `tips`."""
    origin = arm.view.points(triad.pose[:3, 3])
    axes = arm.view.turn @ triad.pose[:3, :3]
    length = max(3.6 * arm.radius, 34.0)
    if np.linalg.norm(origin - arm.paths[-1][2]) < 1:
        length = max(length, min(float(np.linalg.norm(tips - origin)) + 12, 1.4 * length))
    order = np.argsort(axes[2], kind="stable")  # the one nearest to the viewer last
    for k in order:
        name = "xyz"[k]
        tip = origin + length * axes[:, k]
        _arrow(scene, origin, tip, AXES[name], f"triad {name}", 1.7)
        away = unit(axes[:2, k])
        scene.labels.append(Label(name, triad.label, tip[None, :2], away[None], AXES[name], "triad-label"))


def _dimension(scene: Scene, arm: Arm, dimension: Dimension) -> None:
    """Draws a dimension line beside what it measures, on the side and at the distance where it crosses least."""
    a, b = (arm.view.points(np.array(p, dtype=np.float64))[:2] for p in (dimension.start, dimension.end))
    symbol, subscript = symbol_of(dimension.name)
    length = hypot(*(b - a))
    along = unit(b - a) if length > 0.5 else np.array([1.0, 0.0])
    side = np.array([-along[1], along[0]])
    offset = _beside(scene, a, b, side)
    start, end = a + offset, b + offset
    over = 4 * unit(offset)
    feet = [scene.emerging(p + 0.12 * offset, p + offset) for p in (a, b)]
    lines = "".join(f"M{pair(foot)}L{pair(end + over)}" for foot, end in zip(feet, (start, end), strict=True))
    inside = length >= 18
    reach = 0.0 if inside else 10.0
    lines += f"M{pair(start - reach * along)}L{pair(end + reach * along)}"
    turn = 1.0 if inside else -1.0
    heads = "".join(
        f'<polygon points="{_head(p, sign * turn * along, 6.5)}" fill="{INK}"/>'
        for p, sign in ((start, -1.0), (end, 1.0))
    )
    drawn = (
        f'<g class="dimension"><path d="{lines}" fill="none" stroke="#fff" stroke-width="2.8"/>'
        f'<path d="{lines}" fill="none" stroke="{INK}" stroke-width=".8"/>{heads}</g>'
    )
    scene.overlay(drawn, np.stack([start - reach * along, end + reach * along]), 3.0)
    for foot, tip in zip(feet, (start, end), strict=True):
        scene.mark(np.stack([foot, tip + over]), 2.0)
    spots = (
        np.linspace(start, end, 7)[[3, 2, 4, 1, 5]]
        if inside
        else np.stack([start - reach * along, (start + end) / 2, end + reach * along])
    )
    away = np.tile(unit(offset), (len(spots), 1))
    scene.labels.append(Label(symbol, subscript, spots, away, INK, "dimension-label"))


def _beside(scene: Scene, a: Array, b: Array, side: Array) -> Array:
    """How far to move the dimension line of `a` and `b`: the side and the distance at which it crosses least."""
    choices: list[tuple[float, float]] = []
    for offset in (sign * gap for gap in np.arange(16.0, 78.0, 4.0) for sign in (1.0, -1.0)):
        ends = np.stack([a, b]) + offset * side
        price = abs(offset) + 3 * scene.ink_along(ends)
        price += 20 * float(np.maximum(np.abs(ends[:, 0]) - scene.width / 2 + 10, 0).sum())
        for point, end in zip((a, b), ends, strict=True):
            foot = scene.emerging(point + 0.12 * offset * side, end)
            price += 4 * scene.ink_along(np.stack([foot, end])) + (15 if foot is end else 0)
        choices.append((price, float(offset)))
    return min(choices)[1] * side


def symbol_of(name: str) -> tuple[str, str]:
    """A parameter's letter and its subscript: "a1" is a with 1, "alpha2" the Greek letter with 2, "L" just L."""
    match = re.fullmatch(r"([A-Za-z]+)_?(\w*)", name)
    if match is None:
        return name, ""
    letters, subscript = match.groups()
    trailing = re.fullmatch(r"([A-Za-z]+?)(\d*)", letters + subscript) if "_" not in name else None
    letters, subscript = trailing.groups() if trailing else (letters, subscript)
    try:
        case = "SMALL" if letters.islower() else "CAPITAL"
        return unicodedata.lookup(f"GREEK {case} LETTER {letters.upper()}"), subscript
    except KeyError:
        return letters, subscript
