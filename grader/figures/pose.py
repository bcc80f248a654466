"""How an arm stands in the picture: fitted to the page, its joints slid along their axes until they stand clear."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from ...exercises.drawing import Drawing
from ...solutions.kinematics import frames
from .depth import Array, cross, norm, spaced, unit

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
class DrawnJoint:
    """DrawnJoint `index` (from 0) in camera coordinates: its frame, and where its body sits on its axis."""

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
class DrawnArm:
    """An arm in camera coordinates.

    `paths[0]` leads from the base to joint 1 and `paths[i]` from joint i to the next or the tool: along the z axis
    first, then straight; each is (3, 3), with points that may coincide. `radius` is that of a large joint.
    """

    view: View
    paths: list[Array]
    joints: list[DrawnJoint]
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


def pose(drawing: Drawing, width: float) -> DrawnArm:
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
    return DrawnArm(view, paths, joints, view.turn @ poses[-1, :3, :3], radius)


def camera(azimuth: float, elevation: float) -> Array:
    """The rotation (3, 3) from base to camera coordinates, for angles in degrees."""
    az, el = np.radians([azimuth, elevation])
    towards = np.array([np.cos(el) * np.cos(az), np.cos(el) * np.sin(az), np.sin(el)])
    right = np.array([-np.sin(az), np.cos(az), 0.0])
    return np.stack([right, -cross(towards, right), towards])


def _fitted(drawing: Drawing, points: Array, width: float) -> View:
    """The view in which `points`, the triads, the dimensions and what is drawn round them fill the picture."""
    turn, size = camera(*drawing.view), width / 420
    spots = [(p, np.full(3, -30.0), np.full(3, 30.0)) for p in points]
    if drawing.stands == (0.0, 0.0, 1.0):
        spots.append((np.zeros(3), np.array([-44.0, -18.0, 0.0]), np.array([44.0, 34.0, 0.0])))
    else:
        spots.append((np.zeros(3), np.array([-44.0, -44.0, 0.0]), np.array([44.0, 44.0, 0.0])))
    for triad in drawing.triads:
        tips = 54.0 * (turn @ triad.pose[:3, :3]).T
        spots.append((triad.pose[:3, 3], tips.min(0) - 6, tips.max(0) + 6))
    ends = [
        np.array(end)
        for dimension in drawing.dimensions
        for end in (dimension.start, dimension.end)
    ]
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


def _seated(kinds: str, paths: list[Array], axes: Array, radius: float) -> list[DrawnJoint]:
    """The joints with their bodies slid along their axes until they stand clear of one another.

    Joints that cannot move along a link of their own choose first; the rest make room.
    """
    spans = [_span(paths[i], paths[i + 1], axes[i, :, 2]) for i in range(len(kinds))]
    origins = np.array([path[0] for path in paths[1:]])
    joints: list[DrawnJoint] = []
    for i, kind in enumerate(kinds):
        # The hand of an arm is finer than its shoulder, and a wrist finer still.
        crowd = int(np.sum(np.linalg.norm(origins - origins[i], axis=1) < 2.2 * radius))
        tight = crowd > 1 and spans[i][1] - spans[i][0] < 3 * radius
        size = radius * (1 - 0.28 * i / max(len(kinds) - 1, 1)) * (0.86 if tight else 1.0)
        joints.append(DrawnJoint(i, kind, origins[i], axes[i], origins[i], size))
    seated: dict[int, DrawnJoint] = {}
    for i in sorted(range(len(kinds)), key=lambda i: (spans[i][1] - spans[i][0] > GAP, i == 0, i)):
        seated[i] = _seat(joints[i], spans[i], list(seated.values()), late=i > (len(kinds) - 1) / 2)
    return [seated[i] for i in range(len(kinds))]


def _span(before: Array, after: Array, axis: Array) -> tuple[float, float]:
    """From where to where [px] links run along a joint's axis, with its origin at 0."""
    origin = after[0]
    back = last_step(before)
    behind = -float(back @ axis) if abs(float(unit(back) @ axis)) > 0.999 else 0.0
    ahead = float((after[1] - origin) @ axis)
    return min(0.0, behind, ahead), max(0.0, behind, ahead)


def last_step(path: Array, least: float = 0.5) -> Array:
    """The last piece of `path` that is longer than `least` pixels, as a vector; zero if there is none."""
    steps = (path[2] - start for start in (path[1], path[0]))
    return next((step for step in steps if norm(step) > least), np.zeros(3))


def _seat(
    joint: DrawnJoint, span: tuple[float, float], seated: Sequence[DrawnJoint], *, late: bool
) -> DrawnJoint:
    """`joint` moved to the best place on its axis; off its `span`, a `late` joint gives way forwards."""
    reach = 7 * joint.radius
    t = np.concatenate([[0.0], spaced(span[0] - reach, span[1] + reach, 121), spaced(*span, 41)])
    ahead = span[1] if span[1] > -span[0] else span[0]
    wished = (
        0.0
        if joint.kind == "R"
        else float(np.clip(0.35 * ahead, -5 * joint.radius, 5 * joint.radius))
    )
    price = 0.15 * np.abs(t - wished) + np.maximum(0, np.maximum(span[0] - t, t - span[1]))
    price += 0.4 * np.maximum(0, -t if late else t)
    steps = np.array([-1.0, 0.0, 1.0])
    mine = (
        joint.origin
        + (t[:, None, None] + steps[:, None] * (joint.half - 0.6 * joint.radius)) * joint.axis
    )
    for other in seated:
        theirs = other.centre + steps[:, None] * (other.half - 0.6 * other.radius) * other.axis
        apart = np.sqrt(((mine[:, :, None] - theirs) ** 2).sum(-1)).min((1, 2))
        tight = joint.radius + other.radius + GAP - apart
        price += 6 * np.maximum(0, tight) + 0.5 * np.maximum(0, tight + 1.6 * joint.radius)
    return replace(joint, centre=joint.origin + t[np.argmin(price)] * joint.axis)
