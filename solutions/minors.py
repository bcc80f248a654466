# pyright: basic
"""Where arms with one joint to spare are singular: the minors of J, and the self-motion they make.

The task block (m, m + 1) loses rank where all its minors vanish; det(J J^T) is the sum of their
squares (Cauchy and Binet). With alternating signs they are the rates at which the tool stands still
(Bedrossian, 1990).
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from .closed_forms.block import blocks_without_a_joint
from .closed_forms.length import TooLong
from .determinant import Determinant, DeterminantError, expanded, factored
from .singularity import SingularityError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .robot import Robot


def self_motion(block: ArrayLike) -> NDArray[np.float64]:
    """Joint rates (..., m + 1) at which the tool stands still, of a task block (..., m, m + 1).

    Rate i is (-1)^i det(J without column i), i from 0. Their squares add to det(J J^T), so that
    they are all zero in singular postures and nowhere else.

    Raises:
        SingularityError: The block has not one column more than it has rows.
    """
    J = np.asarray(block, dtype=np.float64)
    if J.ndim < 2 or J.shape[-1] != J.shape[-2] + 1:
        raise SingularityError(
            "Self-motion takes a block with one column more than rows, (..., m, m + 1), "
            f"got shape {J.shape}."
        )
    rates = np.empty((*J.shape[:-2], J.shape[-1]))
    for i in range(J.shape[-1]):
        rates[..., i] = (-1) ** i * np.linalg.det(np.delete(J, i, axis=-1))
    return rates


@lru_cache(maxsize=16)
def minors(robot: Robot) -> tuple[Determinant, ...]:
    """The determinants of the task block without joint 1, without joint 2, and so on, factored.

    The robot is singular where all of them are zero. Of the Panda's those are zero together where
    q2 = 0 or pi and the first is; where cos q5 = 0 and so is the factor of the sixth with q6; where
    sin q5 = 0 and a4 (a4 s4 - (d3 + d5) c4) = d3 d5 s4; and where q4 = 0 and (d3 + d5) s6 = -a7.
    All singular postures that searches from 3 000 places came to are of these four kinds.

    Raises:
        DeterminantError: It has not one joint more than task rows, or they would fill pages.
    """
    if robot.n != len(robot.task_rows) + 1:
        raise DeterminantError(
            "minors takes a robot with one joint more than task rows, "
            f"got {robot.name} with {len(robot.task_rows)} rows and {robot.n} joints"
        )
    try:
        products = [expanded(block).gathered() for block in blocks_without_a_joint(robot)]
    except TooLong:
        raise DeterminantError(
            f"minors takes a robot whose minors can be written down, got {robot.name}, whose "
            "oblique axes and offsets would fill pages; self_motion has their values"
        ) from None
    return tuple(factored(robot, [product]) for product in products)
