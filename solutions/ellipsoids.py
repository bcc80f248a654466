"""Velocity and force ellipsoids of a Jacobian block, and what a singular posture cannot do.

A block with linear and angular rows mixes [m] with [rad]: its lengths and ratios depend on the unit
of length.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .singularity import RANK_TOLERANCE, SingularityError, Values, rank, singular_values


@dataclass(frozen=True, eq=False)
class Ellipsoid:
    """Principal axes of an ellipsoid about the origin.

    Attributes:
        axes: Unit vectors (..., m, m), one per column.
        lengths: Half lengths (..., m) along them, largest first; infinite where nothing bounds it.
    """

    axes: Values
    lengths: Values

    @property
    def volume(self) -> Values:
        """Product (...) of the half lengths: the volume but for a constant factor."""
        return self.lengths.prod(axis=-1)

    def surface(self, directions: ArrayLike) -> Values:
        """Points (..., k, m) of the ellipsoid for unit vectors (k, m) in its own axes."""
        around = np.asarray(directions, dtype=np.float64) * self.lengths[..., None, :]
        return around @ np.swapaxes(self.axes, -1, -2)


def velocity_ellipsoid(block: ArrayLike) -> Ellipsoid:
    """Velocities J qdot with |qdot| <= 1, for a block (..., m, n).

    The half lengths are its singular values. A direction that is lost has length 0; a block with
    more rows than columns has m - n of them everywhere. Raises SingularityError.
    """
    U, lengths = _axes(block)
    return Ellipsoid(U, lengths)


def force_ellipsoid(block: ArrayLike) -> Ellipsoid:
    """Forces f with joint torques |J^T f| <= 1, for a block (..., m, n).

    The axes are those of the velocities, the lengths inverted. Along a lost direction the structure
    carries any force: its length is infinite from a singular value of 1e-9 of the largest down.
    Raises SingularityError.
    """
    U, lengths = _axes(block)
    held = lengths > RANK_TOLERANCE * lengths[..., :1]
    inverted = np.divide(1.0, lengths, out=np.full_like(lengths, np.inf), where=held)
    return Ellipsoid(U[..., ::-1], inverted[..., ::-1])


def lost_directions(block: ArrayLike, tolerance: float = RANK_TOLERANCE) -> Values:
    """Unit vectors (k, m) u with u^T J = 0 for one block (m, n); none, (0, m), where it is regular.

    They span the velocities no joint rates give, or the forces no torques answer. Singular values
    up to `tolerance` times the largest count as zero. Raises SingularityError for a stack of
    blocks, which may lose different numbers.
    """
    matrix = np.asarray(block, dtype=np.float64)
    if matrix.ndim != 2:
        raise SingularityError(
            f"lost_directions takes one block of shape (m, n), got shape {matrix.shape}"
        )
    U, _ = _axes(matrix)
    return U[:, int(rank(matrix, tolerance)) :].T


def inverse_condition(block: ArrayLike) -> Values:
    """Smallest over largest singular value (...) of a block (..., m, n).

    It is 1 where the block is isotropic and 0 where it is singular. Unlike manipulability it does
    not grow with the arm (Salisbury and Craig, 1982). Raises SingularityError for a block with more
    rows than columns, which is singular everywhere.
    """
    values = singular_values(block)
    rows, columns = np.shape(block)[-2:]
    if rows > columns:
        raise SingularityError(
            "inverse_condition takes a block with at most as many rows as columns, "
            f"got {rows} x {columns}: choose task rows"
        )
    largest = values[..., 0]
    return np.divide(values[..., -1], largest, out=np.zeros_like(largest), where=largest > 0)


def _axes(block: ArrayLike) -> tuple[Values, NDArray[np.float64]]:
    """Left singular vectors (..., m, m) and values (..., m), 0 for rows beyond the columns."""
    values = singular_values(block)
    matrix = np.asarray(block, dtype=np.float64)
    rows = matrix.shape[-2]
    U = np.linalg.svd(matrix, full_matrices=True)[0]
    lengths = np.zeros((*values.shape[:-1], rows))
    lengths[..., : values.shape[-1]] = values
    return np.asarray(U, dtype=np.float64), lengths
