"""Angles in degrees, handed to functions that take radians."""

from dataclasses import replace

import numpy as np

from ...solutions.robot import Robot
from ..arm import Arm

DEGREES = "Angles in degrees seem to have gone into a sine or cosine that takes radians."


def arm_in_degrees(arm: Arm, robot: Robot) -> Arm:
    """The arm with its joint angles in degrees; `robot` is its own with degrees in the table."""
    turns = np.array([kind == "R" for kind in arm.kinds])
    return replace(arm, robot=robot, q=np.where(turns, np.degrees(arm.q), arm.q))
