"""A Jacobian or twist led to other axes and another point, and the ways in which it goes wrong.

T (4, 4) is the pose of the tool frame in the base frame; its rotation R leads from tool axes to
base axes, and p is the tool point in base axes. Matrices (6, 6) are for twists with the linear
velocity on top.
"""

import numpy as np

from ...solutions.jacobian import at_point
from ..arm import Array


def turn(T: Array) -> Array:
    """The matrix (6, 6) from tool axes to base axes at the same point.

    Where the pose is right, its transpose leads back.
    """
    return np.kron(np.eye(2), T[:3, :3])


def shift(T: Array, sign: int = 1) -> Array:
    """The matrix (6, 6) from the tool point to the base origin in base axes.

    With the sign -1 it leads as far the other way.
    """
    return at_point(np.eye(6), -sign * T[:3, 3])


WRONG_WAY = "The rotation is applied the wrong way round: R leads from tool axes to base axes."
LINEAR_ONLY = "Only the linear rows are turned; the angular ones have axes too."
TOOL_MOVED = (
    "The axes are those of the tool, but the point has been moved as well; it stays the tool point."
)
MOVED = "The point has been moved as well; it stays the tool point."
STILL_BASE = "This is in base axes; tool axes are asked."
WRONG_SIGN = "The shift has the wrong sign: how does one get from the tool point to the origin?"
STILL_AT_TOOL = "This is at the tool point; the base origin is asked."
NEITHER = "This is in tool axes at the tool point; base axes at the base origin are asked."
STILL_IN_TOOL = "This is in tool axes; base axes are asked."
NOT_BASE = (
    "The shift p is known in base axes; start from the Jacobian in base axes, not from the one in "
    "tool axes."
)
OTHER_WAY = "This leads the other way, from the base origin to the tool."
ONLY_TURNED = "This turns the axes but does not move the point."
SHIFT_SIGN = "The shift has the wrong sign."
ORDER = (
    "The shift is multiplied in the wrong order: p is known in base axes, so turn first, then "
    "shift."
)
THIS_ARM = (
    "This holds for the twists that your joints can give, but not for every twist; build it from "
    "R and p alone."
)
COUPLING = (
    "The upper right block: the angular velocity comes in tool axes, too, before the shift meets "
    "it."
)
ANGULAR = (
    "The blocks are in the order of twists with the angular velocity first; here the linear one "
    "comes first."
)
