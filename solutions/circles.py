"""Angles about one axis at which a point or a direction comes where it is wanted.

The subproblems that inverse kinematics in closed form is made of (Paden, 1986; Kahan, 1983).
"""

import math

import numpy as np

from .chain import Array

NOTHING = 1e-10  # of the lengths at hand: below, an axis moves nothing
BEYOND = 1e-9  # by so much a cosine may exceed 1 in rounding, where the arm is stretched


def turned(z: Array, angle: float, u: Array) -> Array:
    """A vector u (3,) turned about the unit vector z (3,) by an angle [rad], after Rodrigues."""
    along = z * (z @ u)
    return along + math.cos(angle) * (u - along) + math.sin(angle) * across(z, u)


def across(a: Array, b: Array) -> Array:
    """The cross product a x b of vectors (3,): numpy's takes ten times as long for one."""
    (x, y, z), (u, v, w) = a.tolist(), b.tolist()
    return np.array([y * w - z * v, z * u - x * w, x * v - y * u])


def turn(z: Array, angle: float) -> Array:
    """The rotation (3, 3) about the unit vector z (3,) by an angle [rad]."""
    x, y, w = z.tolist()
    skew = np.array([[0.0, -w, y], [w, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * (skew @ skew)


def angle_onto(z: Array, u: Array, wanted: Array) -> float:
    """The angle [rad] about z that turns u (3,) towards the wanted vector (3,); 0 if any does."""
    sine = float(z @ across(u, wanted))
    cosine = float(u @ wanted - (u @ z) * (wanted @ z))
    size = float(np.linalg.norm(u) * np.linalg.norm(wanted))
    if math.hypot(sine, cosine) <= NOTHING * size:
        return 0.0
    return math.atan2(sine, cosine)


def angles_to_height(z: Array, u: Array, n: Array, height: float) -> list[float]:
    """The angles [rad] about z at which u (3,) has a component along n (3,), n . R u = height.

    There are two, one where it is just reached, or none; where all angles do it is 0.
    """
    fixed = float((n @ z) * (z @ u))
    cosine = float(n @ u) - fixed
    sine = float(n @ across(z, u))
    size = math.hypot(cosine, sine)
    rest = height - fixed
    scale = float(np.linalg.norm(n) * np.linalg.norm(u))
    if size <= NOTHING * scale:
        return [0.0] if abs(rest) <= BEYOND * scale else []
    if abs(rest) > size * (1 + BEYOND):
        return []

    middle = math.atan2(sine, cosine)
    half = math.acos(max(-1.0, min(1.0, rest / size)))
    if half == 0.0:
        return [middle]
    return [middle + half, middle - half]


def angles_at_distance(z: Array, u: Array, gap: Array, distance: float) -> list[float]:
    """The angles [rad] about z at which R u + gap (3,) has a length [m]."""
    height = (distance**2 - float(u @ u) - float(gap @ gap)) / 2
    return angles_to_height(z, u, gap, height)
