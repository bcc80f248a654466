"""A robot of the catalogue at one posture: the arm alone, or with its ellipsoids."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ...exercises.drawing import Drawing, Triad
from ...solutions.chain import one_configuration
from ...solutions.kinematics import forward
from .amounts import said_amounts
from .arm import draw
from .ellipsoid_figure import draw_ellipsoids, ellipsoid_words
from .vectors import Array

if TYPE_CHECKING:
    from ...solutions.robot import Robot
    from ...solutions.singularity import Parameters

WIDTH = 480.0  # [px]
SHARES = (0.66, 0.34)  # of a joint's range: bent, and off what is singular in the middle


@dataclass(frozen=True)
class PostureFigure:
    """An arm at a posture as SVG, and what it shows in words."""

    svg: str
    words: str


def posture(robot: "Robot", parameters: "Parameters", q: ArrayLike) -> PostureFigure:
    """The arm at `q` (n,) [rad, m] with its joints, its base frame and its tool frame.

    Raises:
        KinegradeError: q is no configuration of the robot, or a length is none of its own.
    """
    chain = robot.chain(parameters)
    at = one_configuration(robot.n, q, f"q of {robot.name}")
    words = _words(robot, parameters, at)
    triads = (Triad(np.eye(4), "0"), Triad(forward(chain, at), "tool"))
    drawing = Drawing(chain, tuple(at.tolist()), robot.title, words, triads)
    return PostureFigure(draw(drawing, WIDTH), words)


def ellipsoids(robot: "Robot", parameters: "Parameters", q: ArrayLike) -> PostureFigure:
    """The arm at `q` (n,) [rad, m] with the ellipsoids of its tool's velocity and force.

    Raises:
        KinegradeError: q is no configuration of the robot, or a length is none of its own.
    """
    chain = robot.chain(parameters)
    at = one_configuration(robot.n, q, f"q of {robot.name}")
    words = f"{_words(robot, parameters, at)} {ellipsoid_words(chain, at)}"
    triads = (Triad(np.eye(4), "0"),)
    drawing = Drawing(chain, tuple(at.tolist()), robot.title, words, triads, arrows=False)
    return PostureFigure(draw_ellipsoids(drawing, WIDTH), words)


def usual_posture(robot: "Robot") -> Array:
    """A bent configuration (n,) within the limits, the hand up where there is a choice."""
    limits: Array = np.array(robot.limits, dtype=np.float64)
    low, high = limits[:, 0], limits[:, 1]
    turning = np.array([kind == "R" for kind in robot.kinds])
    low = np.where(turning, np.maximum(low, -np.pi), low)
    high = np.where(turning, np.minimum(high, np.pi), high)
    choices = np.array([low + share * (high - low) for share in SHARES])
    heights = forward(robot.chain(), choices)[:, 2, 3]
    chosen: Array = choices[int(np.argmax(heights))]
    return chosen.round(2)


def _words(robot: "Robot", parameters: "Parameters", q: Array) -> str:
    """Which robot it is, with which lengths, at which posture, and where its tool is."""
    amounts = said_amounts(robot.values(parameters))
    joints: list[str] = []
    for i, (value, kind) in enumerate(zip(q.tolist(), robot.kinds, strict=True)):
        joints.append(f"q{i + 1} = {value:.4g} {'rad' if kind == 'R' else 'm'}")
    x, y, z = (forward(robot.chain(parameters), q)[:3, 3] + 0.0).tolist()
    return (
        f"{robot.title} ({amounts}) at {', '.join(joints)}: "
        f"the tool is at x = {x:.4g} m, y = {y:.4g} m, z = {z:.4g} m."
    )
