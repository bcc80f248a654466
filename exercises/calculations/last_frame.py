"""The Jacobian of a six-joint arm in the axes of its last frame, right and in wrong ways.

S1, eq. 5.26: column i takes n, o, a and p, the columns of the transform from frame i - 1 to the
last.
"""

import numpy as np

from ...solutions.jacobian import last_frame_columns
from ..arm import Arm, Array
from ..contract.question import Wrong

SHOWS = 0.05  # by which a mistake changes a column, and the size of its linear rows


def to_last(arm: Arm) -> Array:
    """Transforms (7, 4, 4) from each frame to the last."""
    return np.linalg.inv(arm.frames) @ arm.T


def columns_of(T: Array) -> Array:
    """J (6, 6) in the axes of the last frame from the first six transforms (k, 4, 4) to it."""
    return last_frame_columns(T[:6], "R" * 6)


def rows_for_columns(arm: Arm) -> Array:
    """n, o and a taken from the rows of the rotation."""
    T = to_last(arm)
    T[:, :3, :3] = T[:, :3, :3].mT
    return columns_of(T)


def sums_for_differences(arm: Arm) -> Array:
    """Both products of a linear row added, which p_y with the other sign does, too."""
    T = to_last(arm)
    T[:, 1, 3] *= -1
    return columns_of(T)


def one_late(arm: Arm) -> Array:
    """Column i from the transform behind its own."""
    return columns_of(to_last(arm)[1:])


def in_base_axes(arm: Arm) -> Array:
    """The same columns in the axes of the base."""
    return arm.J


def signs_reversed(arm: Arm) -> Array:
    """The other of the two products subtracted."""
    return columns_of(to_last(arm)) * np.repeat([[-1], [1]], 3, axis=0)


def turned(R: Array, J: Array) -> Array:
    """J (6, 6) with both blocks turned by R; a rounded R is no rotation for `in_axes`."""
    return np.concatenate([R @ J[:3], R @ J[3:]])


ROWS = (
    "Rows and columns of the rotation seem exchanged: n, o and a are its columns, and n_z is the "
    "last entry of n."
)
NEXT = "This comes out of the transform of another frame: column i takes the one from frame i - 1."
SIGNS = "Every sign of the linear rows is reversed: which of the two products is subtracted?"
WAY_BACK = "The rotation seems to be turned the other way round: whose axes are its columns?"
HALF = "Which of the two blocks change when only the axes change?"
WRONG: tuple[Wrong, ...] = (
    (
        "Look again at the signs of the linear rows: one of the two products is subtracted.",
        sums_for_differences,
    ),
    (ROWS, rows_for_columns),
    (NEXT, one_late),
    ("This is in base axes; the axes of frame 6 are asked.", in_base_axes),
    (SIGNS, signs_reversed),
)


def shows_mistakes(arm: Arm, columns: list[int]) -> bool:
    """Whether every known mistake changes the columns on paper, and no column is small.

    `columns` are the indices of those on paper, from 0.
    """
    J = columns_of(to_last(arm))
    for _, wrong in WRONG:
        changes = np.abs(wrong(arm) - J)[:, columns].max(axis=0)
        if not changes.min() > SHOWS:
            return False

    sizes = np.linalg.norm(J[:3, :5], axis=0)  # that of joint 6 is zero: the hand lies on its axis
    return bool((sizes > SHOWS).all())
