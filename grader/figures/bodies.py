"""What an arm is made of: the bodies of its joints, its base, its links and its gripper."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from .depth import outside, span_inside
from .pose import DrawnArm, DrawnJoint, last_step
from .scene import Scene
from .vectors import Array, norm, unit

LINK = "#7d8896"
ROD = "#c3ccd6"
BASE = "#4a5361"
GRIPPER = "#39404a"
JOINT = {"R": "#e9a23b", "P": "#4fa79d"}
END_ON = 0.95  # cosine of the angle at which a plate is seen from above
CLASS = {"R": "revolute", "P": "prismatic"}


def draw_body(scene: Scene, joint: DrawnJoint) -> Array:
    """Draws a joint's body; its half-spaces (k, 4) are returned."""
    css, group = f"joint {CLASS[joint.kind]}", f"joint {joint.index + 1}"
    colour = JOINT[joint.kind]
    if joint.kind == "P":
        half = np.array([0.95 * joint.radius, 0.95 * joint.radius, joint.half])
        return scene.box(joint.centre, joint.axes, half, colour=colour, css=css, group=group)
    reach = joint.half * joint.axis
    return scene.tube(
        joint.centre - reach,
        joint.centre + reach,
        joint.radius,
        colour=colour,
        css=css,
        group=group,
        facets=16,
        capped=True,
    )


def draw_base(scene: Scene, arm: DrawnArm, bodies: Sequence[Array], up: Array) -> None:
    """Draws the plate on which the arm stands, and the column on it, in the direction `up` (3,)."""
    r = arm.radius
    # Seen from above it would lie under the whole of a joint's arrow.
    wide = 1.7 * r if abs(float(up[2])) > END_ON else 3.1 * r
    top = arm.paths[0][0] + _drop(arm, up) * up
    plate = scene.tube(
        top - 0.6 * r * up,
        top,
        wide,
        colour=BASE,
        css="base",
        group="base",
        facets=20,
        capped=True,
    )
    column = [top, *arm.paths[0]]
    _pipe(scene, column, 0.5 * r, [*bodies, plate], colour=LINK, group="base link")


def _drop(arm: DrawnArm, up: Array) -> float:
    """How far along `up` the plate lies from the base frame [px]: below the joints there."""
    foot, r = arm.paths[0][0], arm.radius
    drop = 0.0
    for joint in arm.joints:
        height = float((joint.centre - foot) @ up)
        aside = norm(joint.centre - foot - height * up)
        if aside < 3 * r and abs(height) < 6 * r:
            lean = min(abs(float(joint.axis @ up)), 1.0)
            below = joint.half * lean + joint.radius * (1 - lean**2) ** 0.5
            drop = min(drop, height - below)
    return drop


def draw_link(scene: Scene, arm: DrawnArm, joint: DrawnJoint, bodies: Sequence[Array]) -> None:
    """Draws the link behind `joint`; a prismatic joint's slides out of its body."""
    path = arm.paths[joint.index + 1]
    if joint is arm.joints[-1]:
        following = joint
        points = _path_to_palm(arm, path)
    else:
        following = arm.joints[joint.index + 1]
        points = list(path)
    radius = 0.3 + 0.42 * (joint.radius + following.radius) / 2
    group = f"link {joint.index + 1}"
    if joint.kind == "R":
        _pipe(scene, [joint.centre, *points], radius, bodies, colour=LINK, group=group)
        return
    guide, guide_group = [path[0], joint.centre], f"guide {joint.index + 1}"
    _pipe(scene, guide, radius, bodies, colour=LINK, group=guide_group)
    _pipe(scene, [joint.centre, points[1]], 0.7 * radius, bodies, colour=ROD, group=group)
    _pipe(scene, points[1:], radius, bodies, colour=LINK, group=group)


def _path_to_palm(arm: DrawnArm, path: Array) -> list[Array]:
    """The points of the last link, which ends at the palm."""
    step = last_step(path)
    palm = path[2] - unit(step) * min(arm.grip, norm(step))
    if norm(path[2] - path[1]) <= 0.5:
        return [path[0], palm, palm]
    return [path[0], path[1], palm]


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
            start = a + max(0.0, first - inward) * (b - a)
            end = a + min(1.0, last + inward) * (b - a)
            rounded = (first == 0.0 and k > 0, last == 1.0 and k < len(knots) - 2)
            scene.tube(start, end, radius, colour=colour, css="link", group=group, rounded=rounded)


def draw_gripper(scene: Scene, arm: DrawnArm, bodies: Sequence[Array]) -> Array:
    """Draws a gripper along the last link, or along the tool's z axis if there is none.

    Its finger tips, whose middle (3,) is returned, are at the tool point, or before the last body
    if the tool point is inside that.
    """
    step = last_step(arm.paths[-1], 2.0)
    ahead = unit(step) if step.any() else arm.tool[:, 2]
    palm = arm.end - arm.grip * ahead
    reach = _reach_out(arm, palm, ahead, bodies)
    palm = palm + reach * ahead
    if reach:
        wrist = arm.joints[-1]
        _pipe(scene, [wrist.centre, palm], 0.38 * wrist.radius, bodies, colour=LINK, group="hand")

    across = 0.8 * arm.radius * _opening(arm, ahead)
    thick = max(0.15 * arm.radius, 1.6)
    _bar(scene, palm - across, palm + across, 1.25 * thick)
    for side in (-across, across):
        _bar(scene, palm + side, palm + side + arm.grip * ahead, thick)
    return palm + arm.grip * ahead


def _reach_out(arm: DrawnArm, palm: Array, ahead: Array, bodies: Sequence[Array]) -> float:
    """How far `ahead` (3,) the palm moves to stand before the bodies that it would be in [px]."""
    reach, far = 0.0, 20 * arm.radius
    for solid in bodies:
        span = span_inside(palm, palm + far * ahead, solid)
        if span is not None and span[0] * far < 1.5 * arm.grip + reach:
            reach = max(reach, span[1] * far + 0.9 * arm.radius)
    return reach


def _opening(arm: DrawnArm, ahead: Array) -> Array:
    """The unit vector (3,) along which the fingers open: the tool axis that shows them best."""
    sides: list[Array] = []
    for axis in arm.tool.T:
        along = axis @ ahead
        if abs(float(along)) < 0.9:
            sides.append(unit(axis - along * ahead))
    return max(sides, key=lambda side: abs(float(side[0] * ahead[1] - side[1] * ahead[0])))


def _bar(scene: Scene, a: Array, b: Array, radius: float) -> None:
    """Draws a part of the gripper."""
    both = (True, True)
    scene.tube(a, b, radius, colour=GRIPPER, css="gripper", group="gripper", rounded=both)
