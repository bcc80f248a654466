"""Postures of an arm from which its tool has no velocity to one side of a curve in a section.

The tool moves across a curve with normal n at the rate n . dp/dq_i of joint i. It is zero for every
free joint, and a joint that is held at a limit could only take the tool back.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..chain import Chain
from ..jacobian import jacobian
from ..kinematics import forward
from ..singularity import Values
from .approach import projected

Whole = NDArray[np.int_]
Mask = NDArray[np.bool_]

AXIS = 0.003  # so near to axis 1 the radial direction turns too quickly to be followed
ROUNDING = 1e-9  # rates and bends that are zero all along a curve come out as noise below this
LONGEST = 0.5  # of a step of Newton's method


@dataclass(frozen=True, eq=False)
class Plane:
    """The joints that move the tool in a section, seen from the frame of axis 1.

    Lengths are shares of the arm's. Joints that turn all the way round have infinite limits (k,).
    """

    chain: Chain
    axes: tuple[str, str]
    low: Values
    high: Values

    def points(self, q: Values) -> Values:
        """The tool (m, 2) in the section at q (m, k)."""
        return projected(forward(self.chain, q)[:, :3, 3], self.axes)


class Stand(NamedTuple):
    """Postures q (m, k), bearings (m,) of the normals [rad], and which joints (m, k) are held.

    A joint held at its lower limit has -1, at its upper limit 1, and a free one 0.
    """

    q: Values
    bearing: Values
    held: Whole

    def of(self, chosen: Mask | Whole) -> "Stand":
        """Some of the postures."""
        return Stand(self.q[chosen], self.bearing[chosen], self.held[chosen])

    def joined(self, other: "Stand") -> "Stand":
        """These postures and then the others."""
        return Stand(
            np.concatenate([self.q, other.q]),
            np.concatenate([self.bearing, other.bearing]),
            np.concatenate([self.held, other.held]),
        )

    def moved(self, by: Values) -> "Stand":
        """Postures and bearings that differ by (m, k + 1)."""
        return Stand(self.q + by[:, :-1], self.bearing + by[:, -1], self.held)


class Slopes(NamedTuple):
    """The tool, its rates across curves, and how they change.

    Attributes:
        at: The tool in the section (m, 2).
        rates: n . dp/dq (m, k).
        derivatives: Those of the rates by q and the bearing (m, k, k + 1).
    """

    at: Values
    rates: Values
    derivatives: Values


def slopes(plane: Plane, stand: Stand) -> Slopes:
    """Rates across the curves, and how they change, in closed form."""
    p = forward(plane.chain, stand.q)[:, :3, 3]
    J = jacobian(plane.chain, stand.q)
    v, w = J[:, :3], J[:, 3:]
    at = projected(p, plane.axes)
    r = np.maximum(at[:, :1], 1e-12)
    first, second = _directions(plane.axes, p, r)
    across = np.cos(stand.bearing)[:, None]
    along = np.sin(stand.bearing)[:, None]
    normal = across * first + along * second
    tangent = across * second - along * first  # derivative of the normal by the bearing

    # n . (w_i x v_k) is the second derivative of n . p by q_i and q_k for i <= k.
    bends = np.cross(normal[:, None], w.mT) @ v
    bends = np.triu(bends) + np.triu(bends, 1).mT
    if plane.axes == ("r", "z"):  # the radial direction turns
        beside = first[:, :1] * v[:, 1] - first[:, 1:2] * v[:, 0]
        bends += (across / r)[..., None] * beside[:, :, None] * beside[:, None]
    turning = (tangent[:, None] @ v).mT
    rates = (normal[:, None] @ v)[:, 0]
    return Slopes(at, rates, np.concatenate([bends, turning], axis=-1))


def _directions(axes: tuple[str, str], p: Values, r: Values) -> tuple[Values, Values]:
    """The directions in space of the section's first (m, 3) and second (3,) coordinate."""
    x, y, z = np.eye(3)
    if axes == ("x", "y"):
        return np.tile(x, (len(p), 1)), y
    radial = np.zeros_like(p)
    radial[:, :2] = p[:, :2] / r
    return radial, z


def settled(plane: Plane, stand: Stand, steps: int) -> tuple[Stand, Mask]:
    """The nearest postures at which no free joint has a rate, and whether they were found (m,).

    By Newton's method, in so many steps.
    """
    for _ in range(steps):
        wrong, rows = _system(slopes(plane, stand), stand.held)
        step = _shortest(rows, -wrong) * _movable(stand.held)
        size = np.linalg.norm(step, axis=1, keepdims=True)
        stand = stand.moved(step * (LONGEST / np.maximum(size, LONGEST)))
    wrong, _ = _system(slopes(plane, stand), stand.held)
    return stand, np.abs(wrong).max(axis=1) < ROUNDING


def onward(found: Slopes, held: Whole, before: Values) -> Values:
    """Unit steps (m, k + 1) that keep the rates zero, as near as can be to those before."""
    _, rows = _system(found, held)
    changing = (rows @ before[..., None])[..., 0]
    step = (before - _shortest(rows, changing)) * _movable(held)
    return step / np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-300)


def margins(plane: Plane, stand: Stand, found: Slopes) -> Values:
    """What may not fall below zero (m, 3 k + 2).

    In this order: room of the free joints to their lower and to their upper limits, rates of the
    held joints, how firmly the free ones bend back, and room to axis 1.
    """
    endless = np.tile((stand.held != 0) | ~np.isfinite(plane.low), 2)
    to_limits = np.concatenate([stand.q - plane.low, plane.high - stand.q], axis=1)
    room = np.where(endless, 1.0, to_limits)
    pressed = np.where(stand.held == 0, 1.0, found.rates * stand.held + ROUNDING)
    to_axis = np.ones(len(room))
    if plane.axes == ("r", "z"):
        to_axis = found.at[:, 0] - AXIS
    return np.column_stack([room, pressed, _bent_back(found, stand.held), to_axis])


def _bent_back(found: Slopes, held: Whole) -> Values:
    """Above zero (m,) where free joints cannot take the tool across by the second order.

    They are moved so that the tool stands still to the first order. Where no joint is held the
    tool may pass: the posture is singular all the same.
    """
    free = held == 0
    along = np.where(free, found.derivatives[:, :, -1], 0.0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    still = np.eye(held.shape[1]) * free[:, None] - along[:, :, None] * along[:, None]
    bends = np.linalg.eigvalsh(still @ found.derivatives[:, :, :-1] @ still)[:, -1]
    return np.where(free.all(axis=1), 1.0, ROUNDING - bends)


def _system(found: Slopes, held: Whole) -> tuple[Values, Values]:
    """What is wrong (m, k) with postures, and its derivatives (m, k, k + 1).

    Rates of the free joints are wrong; joints that are held stand still.
    """
    fixed = held != 0
    k = held.shape[1]
    rows = np.where(fixed[:, :, None], np.eye(k, k + 1), found.derivatives)
    return np.where(fixed, 0.0, found.rates), rows


def _movable(held: Whole) -> Mask:
    """Free joints and the bearing (m, k + 1): the damping would let the others drift."""
    return np.pad(held == 0, ((0, 0), (0, 1)), constant_values=True)


def _shortest(rows: Values, wanted: Values) -> Values:
    """Shortest solutions (m, k + 1) of rows x = wanted, damped where rows depend on each other."""
    square = rows @ rows.mT + 1e-12 * np.eye(rows.shape[1])
    return (rows.mT @ np.linalg.solve(square, wanted[..., None]))[..., 0]
