"""The columns of a Jacobian, right and in wrong ways, each with the sentence that names it.

`T` (n + 1, 4, 4) holds the frames T_0^0 ... T_0^n of the standard convention, in numbers or in
sympy's closed form, so that z and o of frame i - 1 are the axis of joint i and a point on it. J
(6, n) has the linear rows on top.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from typing import Any

import numpy as np

from ...solutions.expression_array import ExpressionArray, expression_array
from ...solutions.jacobian import in_axes
from ...solutions.robot import Robot

Columns = Callable[[Any, str], Any]
"""J (6, n) of frames (n + 1, 4, 4) and joint types."""


@dataclass(frozen=True)
class Slip:
    """A way to go wrong: the finding that names it, and the columns it leads to."""

    sentence: str
    columns: Columns


def columns(z: Any, lever: Any, kinds: str) -> Any:
    """J (6, n) of joint axes and lever arms (n, 3): z x lever over z; of a slide, z over zeros."""
    turns = np.array([kind == "R" for kind in kinds])[:, None]
    linear = np.where(turns, np.cross(z, lever), z)
    angular = np.where(turns, z, 0)
    return np.concatenate([linear.T, angular.T])


def right(T: Any, kinds: str) -> Any:
    """Axis and origin of frame i - 1 for column i, the lever arm to the tool point."""
    return columns(_z(T), _tip(T) - _o(T), kinds)


def closed(robot: Robot, way: Columns = right) -> ExpressionArray:
    """The closed columns (6, n) of a robot with a standard table, right or in a wrong way.

    It is made once.

    Raises:
        ExpressionError: an entry is too long to be read, as in wrong columns of six joints.
    """
    return _closed(robot, way)  # the same entry whether `right` is stated or not


@lru_cache(maxsize=256)
def _closed(robot: Robot, way: Columns) -> ExpressionArray:
    sympy: Any = import_module("sympy")
    form: Any = robot.symbolic()
    frames = np.array([frame.tolist() for frame in form.frames])
    J = sympy.Matrix(way(frames, robot.kinds))
    return expression_array(J.expand(), robot.names)


def _z(T: Any) -> Any:
    """The joint axes (n, 3)."""
    return T[:-1, :3, 2]


def _o(T: Any) -> Any:
    """A point (n, 3) on each of them."""
    return T[:-1, :3, 3]


def _tip(T: Any) -> Any:
    return T[-1, :3, 3]


def late(T: Any, kinds: str) -> Any:
    """Column i from frame i."""
    return columns(T[1:, :3, 2], _tip(T) - T[1:, :3, 3], kinds)


def late_axes(T: Any, kinds: str) -> Any:
    """The axis of frame i with the right lever arm."""
    return columns(T[1:, :3, 2], _tip(T) - _o(T), kinds)


def own_link(T: Any, kinds: str) -> Any:
    """Lever arms that end at the next frame."""
    return columns(_z(T), T[1:, :3, 3] - _o(T), kinds)


def from_base(T: Any, kinds: str) -> Any:
    """Lever arms that begin at the base."""
    return columns(_z(T), _tip(T) - T[:1, :3, 3] + 0 * _o(T), kinds)


def reversed_product(T: Any, kinds: str) -> Any:
    """Lever arm x axis."""
    return columns(_z(T), _o(T) - _tip(T), kinds)


def all_turning(T: Any, kinds: str) -> Any:
    """A slide taken for a revolute joint."""
    return right(T, "R" * len(kinds))


def turning_slide(T: Any, kinds: str) -> Any:
    """The axis of a slide in its angular rows, too."""
    return np.concatenate([right(T, kinds)[:3], _z(T).T])


def angular_first(T: Any, kinds: str) -> Any:
    """Angular rows above linear ones."""
    return np.roll(right(T, kinds), 3, axis=0)


def tool_axes(T: Any, kinds: str) -> Any:
    """The same point in the axes of the tool, in numbers."""
    return in_axes(right(T, kinds), T[-1, :3, :3])


LATE = (
    "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z "
    "of frame i - 1."
)
LATE_AXES = (
    "The axes seem to be those of frame i in column i; the axis of joint i is z of frame i - 1."
)
OWN_LINK = (
    "The lever arm of a column seems to end at the next frame; where does the point lie whose "
    "velocity is asked?"
)
FROM_BASE = "The lever arms seem to begin at the base; each begins on its joint's own axis."
REVERSED = (
    "The order of the cross product is reversed, which changes its sign: first what turns, then "
    "the lever arm."
)
TURNING = (
    "A prismatic column looks as if its joint were revolute; look again at the types of the joints."
)
TURNING_SLIDE = (
    "Angular rows of a prismatic column: how fast does the tool turn while that joint slides?"
)
TOOL_AXES = "This is the Jacobian in the axes of the tool frame; base axes are asked."
ANGULAR_FIRST = "The angular rows stand above the linear ones; the linear rows are asked on top."

SLIPS: tuple[Slip, ...] = (
    Slip(LATE, late),
    Slip(LATE_AXES, late_axes),
    Slip(OWN_LINK, own_link),
    Slip(FROM_BASE, from_base),
    Slip(REVERSED, reversed_product),
    Slip(TURNING, all_turning),
    Slip(TURNING_SLIDE, turning_slide),
    Slip(TOOL_AXES, tool_axes),
)
"""All of them but a change in the order of the rows, which is found in any answer."""


def different(T: Any, kinds: str, slips: Sequence[Slip] = SLIPS, least: float = 1e-6) -> list[Slip]:
    """Those whose columns differ from the right ones by more than `least` in some entry."""
    J = right(T, kinds)
    found: list[Slip] = []
    for slip in slips:
        wrong = slip.columns(T, kinds)
        if np.abs(wrong - J).max() > least:
            found.append(slip)
    return found
