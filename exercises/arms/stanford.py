"""The Stanford arm, and the column of its slide in several readings."""

import numpy as np

from ...solutions.jacobian import last_frame_columns
from ...solutions.robots import ROBOTS
from ..arm import Arm, Array
from ..drawing import Drawing

ROBOT = ROBOTS["stanford_spong"]
KINDS = ROBOT.kinds
SLIDE = 2  # index of joint 3


def to_last_frame(frames: Array) -> Array:
    """The pose (4, 4) of frame 6 in frame 2."""
    return np.linalg.inv(frames[SLIDE]) @ frames[-1]


def in_last_frame(frames: Array, kind: str) -> Array:
    """Column 3 in the axes of frame 6 for a joint of this type."""
    return last_frame_columns(to_last_frame(frames)[None], kind)[:, 0]


def above_zeros(pose: Array) -> Array:
    """The z axis of a pose (4, 4) above zeros, (6,)."""
    return np.append(pose[:3, 2], np.zeros(3))


def with_column(J: Array, column: Array) -> Array:
    """J (6, 6) with another column 3."""
    return np.where(np.arange(len(KINDS)) == SLIDE, column[:, None], J)


def drawn(arm: Arm) -> Drawing:
    """The arm at the student's q."""
    alt = (
        "Stanford arm: two revolute joints, a slide and a wrist of three revolute joints, "
        "drawn at your q."
    )
    caption = "Your Stanford arm at your q, with frame 0 and frame 6."
    return arm.drawing(caption, alt, tool="6", arrows=False)
