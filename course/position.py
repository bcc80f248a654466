"""Where a student's q stands among the singular postures of the student's own arm."""

from typing import Any

import numpy as np
from markupsafe import Markup

from ..exercises.exercise import Exercise
from ..solutions.kinematics import forward
from ..solutions.robot import Robot
from ..solutions.robots import robot

SAME = 1e-6  # [m]: of one tool point that is computed in two ways


def position(exercise: Exercise, v: dict[str, Any] | None) -> Markup | None:
    """A singularity map with the student's q; None where the exercise has no robot's map."""
    if v is None or exercise.robot is None or "q" not in v:
        return None
    arm = robot(exercise.robot)
    q = np.asarray(v["q"], dtype=float)
    if q.shape != (arm.n,) or arm.n < 2:
        return None
    lengths = {name: float(v[name]) for name in arm.parameters if name in v}
    if not _is_drawn(exercise, v, arm, lengths):
        return None
    from ..grader.figures.own_map import own_map

    return Markup(own_map(arm, lengths, q))  # noqa: S704 - text and numbers of the map are ours


def _is_drawn(exercise: Exercise, v: dict[str, Any], arm: Robot, lengths: dict[str, float]) -> bool:
    """Whether the robot is the arm that the student sees: a form of it may have been drawn."""
    tool = forward(arm.chain(lengths), np.asarray(v["q"], dtype=float))
    for drawing in exercise.drawings(v):
        if len(drawing.q) != arm.n:
            continue
        seen = forward(drawing.chain, np.asarray(v["q"], dtype=float))
        if np.abs(seen[:3, 3] - tool[:3, 3]).max() < SAME:
            return True
    return False
