"""What a singular posture loses: directions out of reach, and joint rates that move nothing.

A block (m, n) of J may be rounded or a student's own: its smallest singular value counts as zero,
whatever it is.
"""

from collections.abc import Iterable

import numpy as np

from ...solutions.ellipsoids import inverse_condition, lost_directions, velocity_ellipsoid
from ..arm import Array
from ..exercise import Outcome
from ..properties import parallel

ZERO = 1e-3  # of the largest singular value: what is less counts as zero where q is rounded
ANGLE = 5e-3  # largest angle to a lost direction [rad]
STILL = (
    "These are joint rates that move nothing (block times rates is zero); asked is the direction "
    "that no rates reach."
)


def weakest(blocks: Iterable[Array]) -> Array:
    """The block that is nearest to losing rank."""
    return min(blocks, key=lambda block: float(inverse_condition(block)))


def lost_direction(block: Array) -> Array:
    """The unit vector u (m,) with u^T block = 0, its largest component positive."""
    u = velocity_ellipsoid(block).axes[:, -1]
    return u * np.sign(u[np.argmax(np.abs(u))])


def still_rates(block: Array) -> Array:
    """Joint rates n (n,) of length 1 with block n = 0, the largest positive."""
    return lost_direction(block.T)


def left_over(J: Array, xi: Array, *, zero: float = ZERO) -> Array:
    """What the best joint rates miss of a twist (m,): J J+ xi - xi, its part along what is lost.

    Singular values up to `zero` times the largest count as zero.
    """
    lost = lost_directions(J, zero)
    return -lost.T @ (lost @ xi)


def judged_lost(block: Array, value: Array, *, tolerance: float = ANGLE) -> Outcome:
    """Right along the lost direction, with either sign and at any length.

    Rates that move nothing are named. `tolerance` [rad] is the largest angle to the direction.
    """
    if parallel(value, lost_direction(block), tolerance):
        return Outcome(right=True)
    may_be_rates = len(value) == block.shape[1]
    if may_be_rates and parallel(value, still_rates(block), tolerance):
        return Outcome(right=False, finding=STILL)
    return Outcome(right=False)
