"""Displacements du = (dp, dw) of a tool frame, right and in wrong ways, each with its sentence.

`T` and `goal` are frames (4, 4) in base coordinates. The right displacement from one to the other
is the engine's `displacement(T, goal)` (6,), in base axes: dp [m] above the rotation vector dw
[rad] with R_goal = R(dw) R.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...solutions.analytic import angles_from_rotation
from ...solutions.inverse import displacement
from ...solutions.jacobian import Frame, in_axes
from ...solutions.rotation import vector_rotation
from ...solutions.velocity import joint_rates
from ..arm import Arm, Array

Way = Callable[[Any, Any], Any]
"""du (6,) of two frames."""
ANGULAR = np.arange(6) >= 3


@dataclass(frozen=True)
class DisplacementSlip:
    """A way to go wrong: the finding that names it, and the du it leads to."""

    sentence: str
    way: Way


def frame_near(
    rng: np.random.Generator,
    T: Array,
    along: tuple[float, float] = (0.03, 0.08),
    about: tuple[float, float] = (0.06, 0.16),
) -> list[list[float]]:
    """A frame (4, 4) that lies so far `along` [m] every base axis from T, in either sense.

    It is turned so far `about` [rad] each of them, and has seven decimals: to fewer it would not
    pass for a rotation.
    """
    move = rng.uniform(*along, 3) * rng.choice([-1, 1], 3)
    turn = rng.uniform(*about, 3) * rng.choice([-1, 1], 3)

    goal = np.eye(4)
    goal[:3, 3] = T[:3, 3] + move
    goal[:3, :3] = vector_rotation(turn) @ T[:3, :3]
    return (np.round(goal, 7) + 0.0).tolist()  # no -0.0


def step(arm: Arm, du: Array, frame: Frame = "base") -> Array:
    """The dq (n,) with J dq = du, J in axes of this frame.

    Where a student's own posture is singular, it is the least-squares solution.
    """
    return joint_rates(arm.chain, arm.q, du, frame=frame)


def sizes(du: Array) -> Array:
    """Distance [m] and angle [rad] of a displacement, (2,)."""
    return np.linalg.norm(du.reshape(2, 3), axis=1)


def turned_back(T: Array, goal: Array) -> Array:
    """The rotation from the goal to the tool."""
    return np.where(ANGULAR, -1, 1) * displacement(T, goal)


def tool_axes(T: Array, goal: Array) -> Array:
    """Both halves in axes of the tool frame T."""
    return in_axes(displacement(T, goal)[:, None], T[:3, :3])[:, 0]


def tool_axes_turn(T: Array, goal: Array) -> Array:
    """The rotation vector alone in axes of the tool frame."""
    return np.where(ANGULAR, tool_axes(T, goal), displacement(T, goal))


def tool_axes_move(T: Array, goal: Array) -> Array:
    """The translation alone in axes of the tool frame."""
    return np.where(ANGULAR, displacement(T, goal), tool_axes(T, goal))


def sine(T: Array, goal: Array) -> Array:
    """The axis times the sine of the angle in place of dw.

    That is half the differences of opposite entries of R(dw).
    """
    du = displacement(T, goal)
    # numpy's sinc(x) is sin(pi x) / (pi x)
    return np.where(ANGULAR, np.sinc(sizes(du)[1] / np.pi), 1) * du


def roll_pitch_yaw(T: Array, goal: Array) -> Array:
    """The angles of R(dw) about fixed x, y and z in place of dw."""
    return np.append(goal[:3, 3] - T[:3, 3], angles_from_rotation(goal[:3, :3] @ T[:3, :3].T))


AXES: tuple[DisplacementSlip, ...] = (
    DisplacementSlip(
        "dw is turned the other way round, from the desired axes back to the present ones.",
        turned_back,
    ),
    DisplacementSlip(
        "dw is in tool axes, as R^T R_desired gives it; on which side of R does R(dw) stand?",
        tool_axes_turn,
    ),
    DisplacementSlip(
        "dp is in tool axes; base axes are asked, in which both points are known.", tool_axes_move
    ),
    DisplacementSlip("dp and dw are in tool axes; base axes are asked.", tool_axes),
)
"""Of displacements of any size."""

FIRST_ORDER: tuple[DisplacementSlip, ...] = (
    DisplacementSlip(
        "This dw is the axis times the sine of its angle; the angle itself is asked.", sine
    ),
    DisplacementSlip(
        "These are roll, pitch and yaw between the two frames, which are dw to first order only.",
        roll_pitch_yaw,
    ),
)
"""Of displacements so large that first order shows."""

TRANSPOSED = "The transposed Jacobian is no inverse: a linear system is to be solved."
"""Of a step J^T du."""
