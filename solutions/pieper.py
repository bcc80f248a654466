"""Joint values for a pose in closed form, of six axes that fall apart into smaller problems.

After Pieper (1968). All of it is written in base axes at q = 0: z_i is the direction of axis i, o_i
a point on it, and P the displacement that takes the tool from where it is at q = 0 to the pose.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from .chain import Array, Chain
from .circles import across, angle_onto, angles_at_distance, angles_to_height, turn, turned
from .kinematics import frames
from .rotation import inverse_transform

NEAR = 1e-9  # of the arm's length, or in radians: axes that near are parallel, or meet

Values = tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Axes:
    """Directions z (6, 3) and points o (6, 3) of the axes at q = 0, joint types, and a length."""

    z: Array
    o: Array
    kinds: str
    length: float

    def parallel(self, i: int, j: int) -> bool:
        """Whether two axes, counted from 1, have one direction or opposite ones."""
        return bool(np.linalg.norm(across(self.z[i - 1], self.z[j - 1])) < NEAR)

    def meeting(self, i: int, j: int) -> Array | None:
        """The point (3,) where two axes meet; None if they are parallel or apart."""
        z, w = self.z[i - 1], self.z[j - 1]
        gap = self.o[j - 1] - self.o[i - 1]
        normal = across(z, w)
        square = float(normal @ normal)
        if square < NEAR**2 or abs(gap @ normal) > NEAR * self.length * math.sqrt(square):
            return None
        return self.o[i - 1] + z * float(across(gap, w) @ normal) / square

    def motion(self, i: int, angle: float) -> Array:
        """The displacement (4, 4) of joint i alone, a revolute one."""
        o = self.o[i - 1]
        T = np.eye(4)
        T[:3, :3] = turn(self.z[i - 1], angle)
        T[:3, 3] = o - T[:3, :3] @ o
        return T


Solver = Callable[[Array], Iterator[Values]]


def axes_of(chain: Chain) -> Axes:
    """The axes of a chain of six joints."""
    F = frames(chain, np.zeros(chain.n))[:-1]
    length = float(np.linalg.norm(chain.fixed[:, :3, 3], axis=-1).sum()) or 1.0
    return Axes(F[:, :3, 2], F[:, :3, 3], chain.kinds, length)


def solver_of(axes: Axes) -> Solver | None:
    """What solves for displacements of the tool; None if the axes are of no such kind."""
    centre = _wrist_centre(axes)
    if centre is not None:
        positions = _positions_of(axes, centre)
        if positions is not None:
            return lambda P: _with_wrist(axes, centre, positions, P)
    parallel = axes.kinds == "R" * 6 and axes.parallel(2, 3) and axes.parallel(3, 4)
    meeting = axes.meeting(5, 6)
    if parallel and meeting is not None and not axes.parallel(1, 2):
        return lambda P: _with_three_parallel(axes, meeting, P)
    return None


def _wrist_centre(axes: Axes) -> Array | None:
    if axes.kinds[3:] != "RRR":
        return None
    first, second = axes.meeting(4, 5), axes.meeting(5, 6)
    if first is None or second is None:
        return None
    if np.linalg.norm(first - second) > NEAR * axes.length:
        return None
    return first


def _positions_of(axes: Axes, centre: Array) -> Solver | None:
    """What brings the wrist centre to a point (3,): values of the first three joints."""
    if axes.kinds[:3] == "RRR" and axes.parallel(2, 3) and not axes.parallel(1, 2):
        return lambda w: _elbow(axes, centre, w)
    shoulder = axes.meeting(1, 2)
    if axes.kinds[:2] == "RR" and shoulder is not None:
        return lambda w: _meeting_shoulder(axes, centre, shoulder, w)
    return None


def _elbow(axes: Axes, centre: Array, wanted: Array) -> Iterator[Values]:
    """Axes 2 and 3 are parallel: they keep the height along them, which q1 then sets."""
    (z1, z2, z3), (o1, o2, o3) = axes.z[:3], axes.o[:3]
    height = float(z2 @ (centre - o1))
    for q1 in angles_to_height(z1, wanted - o1, z2, height):
        there = o1 + turned(z1, q1, wanted - o1)  # seen before joint 1 turns: -q1 of the arm
        for q3, q2 in _planar(z2, z3, (o2, o3), centre, there):
            yield -q1, q2, q3


def _planar(
    z2: Array, z3: Array, o: tuple[Array, Array], point: Array, wanted: Array
) -> Iterator[tuple[float, float]]:
    """q3 and q2 of parallel axes that bring a point (3,) to another at the same height."""
    plane = np.eye(3) - np.outer(z2, z2)
    o2, o3 = o
    u, gap, there = plane @ (point - o3), plane @ (o3 - o2), plane @ (wanted - o2)
    for q3 in angles_at_distance(z3, u, gap, float(np.linalg.norm(there))):
        yield q3, angle_onto(z2, gap + turned(z3, q3, u), there)


def _meeting_shoulder(
    axes: Axes, centre: Array, shoulder: Array, wanted: Array
) -> Iterator[Values]:
    """Axes 1 and 2 meet: joint 3 alone sets how far the wrist centre is from there."""
    z1, z2, z3 = axes.z[:3]
    distance = float(np.linalg.norm(wanted - shoulder))
    o3 = axes.o[2]
    if axes.kinds[2] == "R":
        found = angles_at_distance(z3, centre - o3, o3 - shoulder, distance)
        reached = [o3 + turned(z3, q3, centre - o3) - shoulder for q3 in found]
    else:
        found = _strokes(centre - shoulder, z3, distance)
        reached = [centre - shoulder + q3 * z3 for q3 in found]

    for q3, arm in zip(found, reached, strict=True):
        for q2 in angles_to_height(z2, arm, z1, float(z1 @ (wanted - shoulder))):
            yield angle_onto(z1, turned(z2, q2, arm), wanted - shoulder), q2, q3


def _strokes(start: Array, z: Array, distance: float) -> list[float]:
    """The strokes [m] along z after which a point is that far from the origin."""
    middle = -float(start @ z)
    square = distance**2 - float(start @ start) + middle**2
    if square < 0:
        return []
    return [middle + math.sqrt(square), middle - math.sqrt(square)]


def _with_wrist(axes: Axes, centre: Array, positions: Solver, P: Array) -> Iterator[Values]:
    wanted = P[:3, :3] @ centre + P[:3, 3]
    for arm in positions(wanted):
        rest = P[:3, :3]
        for z, kind, value in zip(axes.z, axes.kinds, arm, strict=False):
            if kind == "R":
                rest = turn(z, -value) @ rest
        for wrist in _wrist(axes.z[3:], rest):
            yield (*arm, *wrist)


def _wrist(z: Array, R: Array) -> Iterator[Values]:
    """Angles about three axes whose turns multiply to R; in line, the first of them is 0."""
    z4, z5, z6 = z
    for q5 in angles_to_height(z5, z6, z4, float(z4 @ R @ z6)):
        q4 = angle_onto(z4, turned(z5, q5, z6), R @ z6)
        rest = turn(z5, -q5) @ turn(z4, -q4) @ R
        beside = across(z6, z5)  # any direction across axis 6
        yield q4, q5, angle_onto(z6, beside, rest @ beside)


def _with_three_parallel(axes: Axes, meeting: Array, P: Array) -> Iterator[Values]:
    """Axes 2, 3 and 4 are parallel to h: they keep heights along it, which q1 and q5 set."""
    z1, h, _, _, z5, z6 = axes.z
    o1 = axes.o[0]
    wanted = P[:3, :3] @ meeting + P[:3, 3]
    for back in angles_to_height(z1, wanted - o1, h, float(h @ (meeting - o1))):
        height = float(h @ turned(z1, back, P[:3, :3] @ z6))
        for q5 in angles_to_height(z5, z6, h, height):
            yield from _rest(axes, P, -back, q5)


def _rest(axes: Axes, P: Array, q1: float, q5: float) -> Iterator[Values]:
    z1, h, z3, z4, z5, z6 = axes.z
    o2, o3, o4 = axes.o[1:4]
    seen = turn(z1, -q1) @ P[:3, :3]
    q6 = -angle_onto(z6, turned(z5, -q5, h), seen.T @ h)
    D = axes.motion(1, -q1) @ P @ axes.motion(6, -q6) @ axes.motion(5, -q5)
    beside = across(h, z1)  # any direction across h
    whole = angle_onto(h, beside, D[:3, :3] @ beside)
    wanted = D[:3, :3] @ o4 + D[:3, 3]
    for q3, q2 in _planar(h, z3, (o2, o3), o4, wanted):
        q4 = whole - q2 - q3 * float(h @ z3)
        yield q1, q2, q3, q4 * float(h @ z4), q5, q6


def displacement_to(chain: Chain, pose: Array) -> Array:
    """The displacement P (4, 4) from the tool at q = 0 to the pose."""
    home = frames(chain, np.zeros(chain.n))[-1]
    return pose @ inverse_transform(home)
