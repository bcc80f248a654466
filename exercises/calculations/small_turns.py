"""The rotation vector between two close frames, and the ways in which it is misread.

R1 and R2 (3, 3) are rotations before and after in base axes, which may be rounded; dw (3,) [rad]
with R2 = R(dw) R1 has base axes, too.
"""

from collections.abc import Callable

import numpy as np

from ..arm import Array
from ..exercise import Outcome
from ..properties import turned

TOLERANCE = 5e-4  # rad; below it, first order and the rotation vector would be the same


def opposite(R: Array) -> Array:
    """Differences of opposite entries: twice the axis of a rotation times the sine of its angle."""
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])


def rotation_vector(R: Array) -> Array:
    """Axis times angle of a rotation of less than a quarter turn, also where R is rounded."""
    w = 0.5 * opposite(R)
    sine = float(np.linalg.norm(w))
    return w * (np.arcsin(min(sine, 1.0)) / sine)  # rounding may lead beyond 1


def between(R1: Array, R2: Array) -> Array:
    """The rotation vector from the first to the second."""
    return rotation_vector(R2 @ R1.T)


def roll_pitch_yaw(R: Array) -> Array:
    """Angles about fixed x, y, z, also where R is rounded."""
    pitch = np.arctan2(-R[2, 0], np.hypot(R[2, 1], R[2, 2]))
    return np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])


TOOL_AXES = (
    "This is the rotation vector in axes of the tool frame; on which side of R1 does R(dw) stand?"
)
BACK = (
    "This is the rotation vector of R2^T R1, the way back and in axes of the tool frame; which "
    "product is R(dw)?"
)
TWICE = "It is twice too long: each difference of opposite entries counts half."
DIFFERENCES = (
    "These are differences of roll, pitch and yaw angles; in space no three angles have dw as "
    "their changes."
)
ANGLES = (
    "These are roll, pitch and yaw of R2 R1^T: that is the rotation vector to first order only."
)
ENTRIES = (
    "Each component seems to be read off one entry of R2 R1^T; the opposite entry counts as well."
)
THE_WAY_BACK = "This is the rotation vector of R1 R2^T, which turns from frame 2 back to frame 1."
FIRST_ORDER = (
    "This is B dq, the rotation to first order; dw between the printed rotations is asked."
)
EXACT = "This is dw between the printed rotations; the first order B dq is asked."
MISREAD: tuple[tuple[str, Callable[[Array, Array], Array]], ...] = (
    (TOOL_AXES, lambda R1, R2: rotation_vector(R1.T @ R2)),
    (BACK, lambda R1, R2: rotation_vector(R2.T @ R1)),
    (TWICE, lambda R1, R2: opposite(R2 @ R1.T)),
    (TWICE, lambda R1, R2: 2 * between(R1, R2)),
    (DIFFERENCES, lambda R1, R2: turned(roll_pitch_yaw(R2) - roll_pitch_yaw(R1))),
    (ANGLES, lambda R1, R2: roll_pitch_yaw(R2 @ R1.T)),
    (ENTRIES, lambda R1, R2: (R2 @ R1.T)[[2, 0, 1], [1, 2, 0]]),
)


def the_way_back(dw: Array, value: Array) -> Outcome | None:
    """Says that an answer turns from frame 2 to frame 1; the tolerance says whether it is right."""
    if np.abs(value + dw).max() > TOLERANCE:
        return None
    return Outcome(reading=THE_WAY_BACK)
