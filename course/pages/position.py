"""Where a student's q stands among the singular postures of the student's own arm."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from ...exercises.exercise import Exercise
from ...solutions.kinematics import multiplied
from ...solutions.robot import Robot
from ...solutions.robots import robot
from ..language.speech import later, phrase

Array = NDArray[np.float64]
TITLE = later("Where your arm is singular, and where you are")
HERE = later("your q")
SAME = 1e-6  # [m]: of one tool point that is computed in two ways


def position(exercise: Exercise, v: dict[str, Any] | None) -> Markup | None:
    """A singularity map with the student's q; None where the exercise has no robot's map."""
    if v is None or exercise.robot is None:
        return None
    for arm, lengths, q in _candidates(exercise, robot(exercise.robot), v):
        if arm.n >= 2 and _is_drawn(exercise, v, arm.frames(lengths, q)[-1]):
            from ...grader.figures.own_map import own_map

            svg = own_map(arm, lengths, q, phrase(TITLE), phrase(HERE))
            return Markup(svg)  # noqa: S704 - its words and numbers are ours
    return None


def _candidates(
    exercise: Exercise, catalogued: Robot, v: dict[str, Any]
) -> Iterator[tuple[Robot, Mapping[str, float], Array]]:
    """Robots with lengths and q (n,) that a student may have, those of the catalogue first.

    Their factors have names. A length may be drawn for another arm than that at q, and an exercise
    may draw a form of the robot.
    """
    q = np.asarray(v.get("q", ()), dtype=float)
    if q.shape == (catalogued.n,):
        own = {name: float(v[name]) for name in catalogued.parameters if name in v}
        yield catalogued, own, q
        yield catalogued, {}, q
    if exercise.arm is not None:
        arm = exercise.arm(v)
        drawn: Robot = arm.robot
        if drawn.kinds == catalogued.kinds:
            yield replace(drawn, task_rows=catalogued.task_rows), arm.lengths, arm.q


def _is_drawn(exercise: Exercise, v: dict[str, Any], tool: Array) -> bool:
    """Whether a tool frame is one that the student sees; a form of the robot may be drawn."""
    for drawing in exercise.drawings(v):
        seen = multiplied(drawing.chain, drawing.q)
        if np.abs(seen[:3, 3] - tool[:3, 3]).max() < SAME:
            return True
    return False
