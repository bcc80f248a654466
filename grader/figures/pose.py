"""How an arm stands in the picture: fitted to the page, its joints' bodies clear of one another."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...exercises.drawing import Drawing
from ...solutions.kinematics import frames
from .plane import normal
from .vectors import Array, norm, spaced, unit
from .view import USUAL_WIDTH, View, fitted, looked_at

GAP = 5.0  # [px] between two joints' bodies
SQUARE = 0.9999  # cosine of the angle at which a plane still counts as seen square
ALONG = np.array([-1.0, 0.0, 1.0])  # three points of a body on its axis, which stand for it


@dataclass(frozen=True, eq=False)
class DrawnJoint:
    """A joint in camera coordinates: its frame, and where its body sits on its axis.

    Attributes:
        index: From 0.
        kind: "R" or "P".
        value: How far it is turned or out [rad or m].
        origin: The origin (3,) of its frame [px].
        axes: The axes of its frame, the columns of (3, 3); it moves about or along the last.
        centre: The middle (3,) of its body, on that axis [px].
        radius: Of its body [px].
    """

    index: int
    kind: str
    value: float
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
        slenderness = 1.25 if self.kind == "R" else 1.7
        return self.radius * slenderness


@dataclass(frozen=True, eq=False)
class DrawnArm:
    """An arm in camera coordinates.

    Attributes:
        view: From base to camera coordinates.
        paths: The first leads from the base to joint 1, `paths[i]` from joint i to the next or the
            tool: along the z axis first, then straight. Each is (3, 3), with points that may
            coincide.
        joints: In the order of the chain.
        tool: The axes of the tool frame, the columns of (3, 3).
        radius: That of a large joint [px].
        flat: Whether it lies in a plane that is seen square.
    """

    view: View
    paths: list[Array]
    joints: list[DrawnJoint]
    tool: Array
    radius: float
    flat: bool

    @property
    def end(self) -> Array:
        """The tool point (3,)."""
        return self.paths[-1][2]

    @property
    def grip(self) -> float:
        """How far the palm stands behind the finger tips [px]."""
        return 1.4 * self.radius


def pose(drawing: Drawing, width: float, around: float = 0.0) -> DrawnArm:
    """The arm of `drawing` in camera coordinates, as large as a picture `width` pixels wide allows.

    There is room for `around` pixels to every side of the tool point.

    Raises:
        KinegradeError: `drawing.q` does not fit `drawing.chain`.
    """
    q = np.asarray(drawing.q, dtype=np.float64)
    poses = frames(drawing.chain, q)
    origins = np.vstack([np.zeros(3), poses[:, :3, 3]])
    along = np.vstack([[0.0, 0.0, 1.0], poses[:-1, :3, 2]])
    ahead = np.sum(np.diff(origins, axis=0) * along, axis=1)[:, None]
    elbows = origins[:-1] + ahead * along

    turn = looked_at(drawing)
    view = fitted(drawing, np.vstack([origins, elbows]), turn, width, around)
    corners = np.stack([origins[:-1], elbows, origins[1:]], axis=1)
    paths = [view.points(points) for points in corners]

    kinds = drawing.chain.kinds
    radius = _radius(paths, len(kinds), width / USUAL_WIDTH)
    joints = _seated(drawing, paths, view.turn @ poses[:-1, :3, :3], radius)
    square = normal(drawing.chain, q)
    flat = square is not None and abs(float(turn[2] @ square)) > SQUARE
    return DrawnArm(view, paths, joints, view.turn @ poses[-1, :3, :3], radius, flat)


def _radius(paths: Iterable[Array], joints: int, size: float) -> float:
    """The radius of a large joint [px]: finer where many joints share a short arm."""
    length = 0.0
    for path in paths:
        for start, end in pairwise(path):
            length += norm(end - start)
    return float(np.clip(0.115 * length / joints, 8.5 * size, 13 * size))


def _seated(drawing: Drawing, paths: list[Array], axes: Array, radius: float) -> list[DrawnJoint]:
    """The joints with their bodies slid along their axes until they stand clear of one another.

    Joints that cannot move along a link of their own choose first; the rest make room.
    """
    kinds = drawing.chain.kinds
    count = len(kinds)
    spans = [_span(paths[i], paths[i + 1], axes[i, :, 2]) for i in range(count)]
    room = [last - first for first, last in spans]
    origins = np.array([path[0] for path in paths[1:]])
    joints: list[DrawnJoint] = []
    for i, kind in enumerate(kinds):
        # The hand of an arm is finer than its shoulder, and a wrist finer still.
        size = radius * (1 - 0.28 * i / max(count - 1, 1))
        crowd = int(np.sum(np.linalg.norm(origins - origins[i], axis=1) < 2.2 * radius))
        if crowd > 1 and room[i] < 3 * radius:
            size *= 0.86
        place = origins[i]
        joints.append(DrawnJoint(i, kind, drawing.q[i], place, axes[i], place, size))

    seated: dict[int, DrawnJoint] = {}
    for i in sorted(range(count), key=lambda i: (room[i] > GAP, i == 0, i)):
        late = i > (count - 1) / 2
        seated[i] = _seat(joints[i], spans[i], list(seated.values()), late=late)
    return [seated[i] for i in range(count)]


def _span(before: Array, after: Array, axis: Array) -> tuple[float, float]:
    """From where to where [px] links run along a joint's axis, with its origin at 0."""
    back = last_step(before)
    behind = 0.0
    if abs(float(unit(back) @ axis)) > 0.999:
        behind = -float(back @ axis)
    ahead = float((after[1] - after[0]) @ axis)
    return min(0.0, behind, ahead), max(0.0, behind, ahead)


def last_step(path: Array, least: float = 0.5) -> Array:
    """The last piece of `path` that is longer than `least` pixels, as a vector; zero if none is."""
    for start in (path[1], path[0]):
        step = path[2] - start
        if norm(step) > least:
            return step
    return np.zeros(3)


def _seat(
    joint: DrawnJoint, span: tuple[float, float], seated: Sequence[DrawnJoint], *, late: bool
) -> DrawnJoint:
    """`joint` moved to the best place on its axis.

    Off its `span`, a `late` joint gives way forwards, any other backwards.
    """
    first, last = span
    reach = 7 * joint.radius
    t = np.concatenate([[0.0], spaced(first - reach, last + reach, 121), spaced(first, last, 41)])

    # What it costs to leave the place that is wished for, and the links along the axis.
    price = 0.15 * np.abs(t - _wished(joint, span))
    price += np.maximum(0, np.maximum(first - t, t - last))
    price += 0.4 * np.maximum(0, -t if late else t)

    # What it costs to come close to bodies that have their places.
    mine = joint.origin + (t[:, None, None] + _points_along(joint)) * joint.axis
    for other in seated:
        theirs = other.centre + _points_along(other) * other.axis
        apart = np.sqrt(((mine[:, :, None] - theirs) ** 2).sum(-1)).min((1, 2))
        tight = joint.radius + other.radius + GAP - apart
        price += 6 * np.maximum(0, tight) + 0.5 * np.maximum(0, tight + 1.6 * joint.radius)
    return replace(joint, centre=joint.origin + t[np.argmin(price)] * joint.axis)


def _wished(joint: DrawnJoint, span: tuple[float, float]) -> float:
    """Where on its axis a body stands best [px]: a prismatic one a way along the longer link."""
    if joint.kind == "R":
        return 0.0
    first, last = span
    ahead = last if last > -first else first
    return float(np.clip(0.35 * ahead, -5 * joint.radius, 5 * joint.radius))


def _points_along(joint: DrawnJoint) -> Array:
    """How far from its middle (3, 1) the points lie that stand for a body [px]."""
    return ALONG[:, None] * (joint.half - 0.6 * joint.radius)
