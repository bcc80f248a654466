"""Which single cell of a table leads to given poses, and what would have to stand in it."""

from collections.abc import Iterator
from itertools import accumulate

import numpy as np

from ...solutions.chain import Array, elementary
from ...solutions.rotation import inverse_transform

THETA, D, A, ALPHA = range(4)
JOINT_COLUMN = {"R": THETA, "P": D}
MOTIONS = {THETA: "Rz", D: "Tz", A: "Tx", ALPHA: "Rx"}
ORDER = {"standard": (THETA, D, A, ALPHA), "modified": (ALPHA, A, THETA, D)}
"""In which order the cells of a row move one frame to the next."""


def poses(rows: Array, kinds: str, convention: str, q: Array) -> Array:
    """Poses (k, 4, 4) of the last frame of a table (n, 4) at q (k, n)."""
    *_, last = accumulate(_moves(rows, kinds, convention, q), np.matmul)
    return last


def single_cells(
    rows: Array, kinds: str, convention: str, q: Array, wanted: Array, slack: float
) -> Iterator[tuple[int, int, float]]:
    """Row, column and value of every cell that alone leads to the wanted poses (k, 4, 4) at q.

    `slack` is how far the transforms may be off, which rounded cells need.
    """
    moves = _moves(rows, kinds, convention, q)
    still = np.broadcast_to(np.eye(4), moves[0].shape)
    before = np.array([*accumulate(moves[:-1], np.matmul, initial=still)])
    behind = np.array([*accumulate(moves[:0:-1], lambda T, move: move @ T, initial=still)])[::-1]
    # Between what stands before the cell and what stands behind it, one motion has to be left.
    needed = inverse_transform(before) @ wanted @ inverse_transform(behind)

    for place, left in enumerate(needed):
        row, inner = divmod(place, 4)
        column = ORDER[convention][inner]
        joint = np.zeros(len(q))
        if column == JOINT_COLUMN[kinds[row]]:
            joint = q[:, row]
        value = _amount(left, MOTIONS[column], joint)
        off = np.abs(left - elementary(MOTIONS[column], value + joint))
        if off.max() <= slack:
            yield row, column, value


def _moves(rows: Array, kinds: str, convention: str, q: Array) -> list[Array]:
    """The motion (k, 4, 4) of every cell, from the base to the tool."""
    moves: list[Array] = []
    for i, kind in enumerate(kinds):
        amounts = np.repeat(rows[i][None], len(q), axis=0)
        amounts[:, JOINT_COLUMN[kind]] += q[:, i]
        moves += [elementary(MOTIONS[column], amounts[:, column]) for column in ORDER[convention]]
    return moves


def _amount(transforms: Array, motion: str, joint: Array) -> float:
    """The constant part of a turn or shift (k, 4, 4) to which joint values (k,) are added."""
    axis = "xyz".index(motion[1])
    if motion[0] == "T":
        return float(np.mean(transforms[:, axis, 3] - joint))
    one, other = (axis + 1) % 3, (axis + 2) % 3
    angles = np.arctan2(transforms[:, other, one], transforms[:, one, one]) - joint
    return float(np.angle(np.exp(1j * angles).mean()))
