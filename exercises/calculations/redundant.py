"""Checks of answers about an arm with more joints than prescribed rows.

J (m, n) has full row rank m < n; a twist xi (m,) is prescribed. Answers are rounded to four
decimals.
"""

import numpy as np

from ...solutions.velocity import pseudoinverse
from ..arm import Array
from ..exercise import Outcome
from ..properties import is_pseudoinverse, is_right_inverse, meets, parallel
from .lost import still_rates

HALF = 0.5e-4
PENROSE = 2e-3  # four decimals of X, multiplied by J twice
HUGE = 1e4
LONGER = 0.01  # than the shortest rates [rad/s]
SEEN = 0.1  # size of rates of which something can be said [rad/s]


def gives_twist(J: Array, xi: Array, value: Array) -> bool:
    """Whether joint rates give the twist, but for their rounding."""
    return meets(J, value, xi, 1.5 * HALF * np.abs(J).sum(axis=1))


def judged_pseudoinverse(J: Array, value: Array) -> Outcome:
    """By the four Penrose conditions; any other right inverse, J X = I, earns a third."""
    if is_pseudoinverse(J, value, PENROSE):
        return Outcome(right=np.ones(value.shape, dtype=bool))

    if is_right_inverse(J, value, PENROSE):
        said = (
            "J X = I holds, so this is a right inverse; but X J is not symmetric, so it is not "
            "the pseudoinverse."
        )
        return Outcome(right=np.zeros(value.shape, dtype=bool), finding=said, share=1 / 3)

    if np.abs(value).max() > HUGE:
        said = (
            "Such large numbers come from the inverse of a singular matrix: which of J J^T and "
            "J^T J has full rank?"
        )
        return Outcome(finding=said)
    return Outcome()


def judged_least(J: Array, xi: Array, value: Array) -> Outcome:
    """Half of the points go to rates that give the twist and are not the shortest."""
    if not gives_twist(J, xi, value):
        return Outcome()
    longer = np.linalg.norm(value - pseudoinverse(J) @ xi)
    if longer > LONGER:
        return Outcome(
            reading="These rates give the twist, but there are shorter ones that do.", share=0.5
        )
    return Outcome()


def judged_null(J: Array, value: Array) -> Outcome:
    """Right is any multiple of the rates that move nothing.

    There is one direction of them, as there is one joint more than rows (n = m + 1).
    """
    size = float(np.linalg.norm(value))
    angle = min(1e-2, 1e-3 + 4 * HALF / max(size, HALF))  # short rates are rounded the most
    if parallel(value, still_rates(J), angle):
        return Outcome(right=np.ones(value.shape, dtype=bool))

    finding = ""
    moving = pseudoinverse(J) @ (J @ value)
    if size > SEEN and np.abs(moving - value).max() < 1e-3 * size:
        finding = (
            "J+ J keeps the part of the rates that moves the hand; the rest of them does not move "
            "it."
        )
    return Outcome(right=np.zeros(value.shape, dtype=bool), finding=finding)
