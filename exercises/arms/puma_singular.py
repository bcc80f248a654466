"""Postures in which the Puma's wrist, elbow or shoulder is singular, and nothing else.

The tool point is the wrist centre, so that J falls into blocks.
"""

import numpy as np

from ...solutions.singularity import singular_values
from ..arm import Arm, Array
from ..calculations.lost import lost_direction, still_rates, weakest
from ..draws import angles
from ..properties import parallel
from .puma import PUMA

REGULAR = 0.05  # what the other singular values are at least, of the largest
CLEAR = 0.04  # of a second factor from zero: a folded elbow brings the wrist centre near axis 2


def blocks(J: Array) -> tuple[Array, Array]:
    """The arm block A (linear rows, joints 1 to 3) and the wrist block W (angular, 4 to 6)."""
    return J[:3, :3], J[3:, 3:]


def posture(rng: np.random.Generator, way: int) -> list[float]:
    """Generic angles but for the one that makes wrist, elbow or shoulder singular (0, 1, 2)."""
    q = angles(rng, 6, [(1, 2)])
    if way == 0:
        q[4] = float(rng.choice([0.0, 3.141593]))
    elif way == 1:
        a3, d4 = PUMA.parameters["a3"], PUMA.parameters["d4"]
        q[2] = round(float(elbow_angles(a3, d4)[rng.integers(2)]), 6)
    else:
        q2 = shoulder_singular_q2(q[2])
        q[1] = round(q2 - float(np.sign(q2)) * np.pi * int(rng.integers(2)), 6)
    return q


def shoulder_singular_q2(q3: float) -> float:
    """A root q2 of a2 cos q2 + a3 cos(q2 + q3) - d4 sin(q2 + q3) = 0.

    There the shoulder is singular; the other root is half a turn away.
    """
    a2, a3, d4 = PUMA.parameters["a2"], PUMA.parameters["a3"], PUMA.parameters["d4"]
    s, c = np.sin(q3), np.cos(q3)
    return float(np.arctan2(a2 + a3 * c - d4 * s, a3 * s + d4 * c))


def elbow_angles(a3: float, d4: float) -> Array:
    """Both q3 (2,) [rad] at which the elbow is singular: a3 sin q3 + d4 cos q3 = 0."""
    stretched = -np.arctan2(d4, a3)
    return np.array([stretched, stretched + np.pi])


def loses_one_direction(arm: Arm) -> bool:
    """Whether one direction alone is lost, clearly so, and it is none that might be guessed."""
    if np.sort(np.abs(arm.factors))[1] < CLEAR:
        return False
    values = np.zeros((3, 2))  # the last two singular values of J, A and W, as shares of the first
    for i, block in enumerate((arm.J, *blocks(arm.J))):
        sizes = singular_values(block)
        values[i] = sizes[-2:] / sizes[0]
    _, second, third = np.sort(values[:, 1])
    if second >= 1e-5 or min(third, values[:, 0].min()) < REGULAR:
        return False

    block = weakest(blocks(arm.J))
    plain = [*np.eye(3), np.ones(3), np.array([1, 1, 0]), still_rates(block)]
    u = lost_direction(block)
    return not any(parallel(direction, u, 0.1) for direction in plain)
