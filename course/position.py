"""Where a student's q stands among the singular postures of the student's own arm."""

from typing import Any

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from ..exercises.exercise import Exercise
from ..solutions.kinematics import forward
from ..solutions.robot import Robot
from ..solutions.robots import robot

Array = NDArray[np.float64]
SAME = 1e-6  # [m]: of one tool point that is computed in two ways


def position(exercise: Exercise, v: dict[str, Any] | None) -> Markup | None:
    """A singularity map with the student's q; None where the exercise has no robot's map."""
    if v is None or exercise.robot is None:
        return None
    arm = robot(exercise.robot)
    q = _posture(arm, v)
    if q is None:
        return None
    own = {name: float(v[name]) for name in arm.parameters if name in v}
    for lengths in (own, {}):  # a length may be drawn for another arm than that at q
        if _is_drawn(exercise, v, forward(arm.chain(lengths), q)):
            from ..grader.figures.own_map import own_map

            return Markup(own_map(arm, lengths, q))  # noqa: S704 - its words and numbers are ours
    return None


def _posture(arm: Robot, v: dict[str, Any]) -> Array | None:
    """The drawn q (n,) of an arm with a map; None where there is none."""
    q = np.asarray(v.get("q", ()), dtype=float)
    if arm.n < 2 or q.shape != (arm.n,):
        return None
    return q


def _is_drawn(exercise: Exercise, v: dict[str, Any], tool: Array) -> bool:
    """Whether a tool frame is one that the student sees; a form of the robot may be drawn."""
    for drawing in exercise.drawings(v):
        seen = forward(drawing.chain, np.asarray(drawing.q))
        if np.abs(seen[:3, 3] - tool[:3, 3]).max() < SAME:
            return True
    return False
