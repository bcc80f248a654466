"""Angles of an arm that is seen flat: from where each is zero to the link that it turns."""

import numpy as np

from .labels import Label
from .markup import arrow_corners, pairs
from .pose import DrawnArm, DrawnJoint
from .scene import Scene
from .vectors import Array, norm, spaced, unit

ARC = 2.7  # radius of the arc, in radii of the joint
ZERO = (1.15, 4.4)  # from where to where the line of zero runs, in radii of the joint
LEAST = 0.9  # [rad] from zero on that an arrow turns at least, so that its sense is seen
SHORTEST = 1.0  # [px] of a link whose direction can be seen
LABELLED = (0.5, 0.65, 0.35, 0.8, 0.2, 1.0)  # of the way along the arc


def draw_angle(scene: Scene, arm: DrawnArm, joint: DrawnJoint, colour: str) -> Array:
    """Draws a dashed line where the angle is zero, and an arc from there to the link.

    The arc has its arrowhead at the end to which the joint turns when its angle grows: a negative
    angle runs from the link back to zero and a little on. Points (k, 2) on it are returned, those
    on the angle itself first.
    """
    q = float(np.fmod(joint.value, 2 * np.pi))
    # y runs down the page: about an axis that points at the viewer, bearings shrink as q grows.
    sense = -1.0 if joint.axis[2] > 0 else 1.0
    at_zero = _bearing(arm, joint) - sense * q
    _draw_zero(scene, joint, at_zero, colour)

    first, last = min(q, 0.0), max(q, LEAST)
    turns = spaced(first, last, 40)
    arc = _around(joint, at_zero + sense * turns)
    _draw_arc(scene, arc, colour)

    end = q if abs(q) > 0.5 * LEAST else LEAST
    places = at_zero + sense * end * np.array(LABELLED)
    return _around(joint, places)


def _bearing(arm: DrawnArm, joint: DrawnJoint) -> float:
    """Where the link behind a joint points on the page [rad]."""
    link = arm.paths[joint.index + 1][2] - joint.origin
    if norm(link[:2]) < SHORTEST:
        link = arm.tool[:, 0]
    return float(np.arctan2(link[1], link[0]))


def _around(joint: DrawnJoint, bearings: Array) -> Array:
    """Points (k, 2) of the arc round a joint."""
    circle = np.column_stack([np.cos(bearings), np.sin(bearings)])
    return joint.centre[:2] + ARC * joint.radius * circle


def _draw_zero(scene: Scene, joint: DrawnJoint, bearing: float, colour: str) -> None:
    """Draws the dashed line of zero with a 0 at its end."""
    along = np.array([np.cos(bearing), np.sin(bearing)])
    reach = joint.radius * np.array(ZERO)[:, None]
    line = joint.centre[:2] + reach * along
    path = f'<path d="M{pairs(line, "L")}" fill="none"'
    svg = (
        f'<g class="zero">{path} stroke="#fff" stroke-width="3"/>'
        f'{path} stroke="{colour}" stroke-width="1" stroke-dasharray="4 2.5"/></g>'
    )
    scene.overlay(svg, line, 2.0)
    label = Label("", "0", line[1:], along[None], colour, "zero-label", owner=line)
    scene.labels.append(label)


def _draw_arc(scene: Scene, arc: Array, colour: str) -> None:
    """Draws the arc with its arrowhead."""
    tip, along = arc[-1], unit(arc[-1] - arc[-4])
    path = f'd="M{pairs(arc[:-2], "L")}" fill="none"'
    head = f'points="{arrow_corners(tip, along, 7.0)}"'
    svg = (
        f'<path {path} stroke="#fff" stroke-width="3.7"/>'
        f'<path class="sense" {path} stroke="{colour}" stroke-width="1.5"/>'
        f'<polygon class="head" {head} fill="{colour}"/>'
    )
    scene.overlay(svg, arc)
