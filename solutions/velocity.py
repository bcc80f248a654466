"""Twists from joint rates, and joint rates from twists."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import Array, Chain, ChainError, configuration, reals
from .jacobian import Axes, Point, check_batch, jacobian

REGULAR = 1e-10  # a singular value below this share of the largest counts as zero


def twist(
    chain: Chain, q: ArrayLike, qdot: ArrayLike, frame: Axes = "base", *, point: Point | None = None
) -> Array:
    """Twists (..., 6) of the tool, [m/s] above [rad/s], at q (..., n).

    `qdot` (..., n) are the joint rates. `frame` and `point` are those of `jacobian`. Raises
    ChainError.
    """
    rates = configuration(chain.n, qdot, "qdot")
    J = jacobian(chain, q, frame, point=point)
    check_rows("qdot", rates, J)
    return (J @ rates[..., None])[..., 0]


def joint_rates(
    chain: Chain,
    q: ArrayLike,
    twist: ArrayLike,
    rows: slice | Sequence[int] = slice(None),
    frame: Axes = "base",
    *,
    point: Point | None = None,
    damping: ArrayLike = 0.0,
    preferred: ArrayLike | None = None,
) -> Array:
    """Joint rates (..., n) [rad/s, m/s] that reach the stated `rows` of the twists at q (..., n).

    `twist` holds whole twists (..., 6), or their m stated rows alone, (..., m). Where those rows of
    J are square and regular, the rates are unique; elsewhere they are the least-squares solution of
    minimum norm. A block is regular if its smallest singular value exceeds 1e-10 of its largest.
    `frame` and `point` are those of `jacobian`.

    With `damping` above 0, of shape (...), the rates are the damped least-squares ones, which stay
    bounded near singular configurations and miss the twist a little everywhere. Of `preferred`
    rates (..., n) as much is added as moves none of the stated rows. Raises ChainError.
    """
    chosen = chosen_rows(rows)
    J = jacobian(chain, q, frame, point=point)[..., chosen, :]
    wanted = reals("twist", twist)
    if len(chosen) == 6 or wanted.shape[-1:] != chosen.shape:
        wanted = configuration(6, wanted, "twist")[..., chosen]
    check_rows("twist", wanted, J)
    rates = _rates(J, wanted, reals("damping", damping))
    if preferred is None:
        return rates
    extra = configuration(chain.n, preferred, "preferred")
    check_rows("preferred", extra, J)
    return rates + (null_projector(J) @ extra[..., None])[..., 0]


def pseudoinverse(J: ArrayLike) -> Array:
    """Moore-Penrose inverses (..., n, m) of J (..., m, n).

    Singular values below 1e-10 of the largest count as zero. At full row rank it is the right
    inverse J^T (J J^T)^-1 (S3, section 5.2.1): J J+ = I, while J+ J is a projector. Raises
    ChainError.
    """
    return np.asarray(np.linalg.pinv(_matrix(J), rcond=REGULAR), dtype=np.float64)


def damped_inverse(J: ArrayLike, damping: ArrayLike) -> Array:
    """J^T (J J^T + damping^2 I)^-1, of shape (..., n, m), for J (..., m, n).

    `damping` (...) is above 0, in the units of J's singular values (Nakamura and Hanafusa, 1986).
    Its rates minimise |J qdot - xi|^2 + damping^2 |qdot|^2, and no gain is above 1 / (2 damping).
    Raises ChainError.
    """
    factor = reals("damping", damping)
    if (factor <= 0).any():
        raise ChainError(f"damping takes numbers above 0, got {factor.min()}")
    # by singular values: J J^T would square the condition number
    U, s, Vt = np.linalg.svd(_matrix(J), full_matrices=False)
    gains = s / (s**2 + factor[..., None] ** 2)
    return np.asarray((Vt.mT * gains[..., None, :]) @ U.mT, dtype=np.float64)


def null_projector(J: ArrayLike) -> Array:
    """I - J+ J, of shape (..., n, n), for J (..., m, n).

    What it leaves of joint rates moves nothing: J N = 0. Singular values below 1e-10 of the largest
    count as zero. Raises ChainError.
    """
    matrix = _matrix(J)
    return np.eye(matrix.shape[-1]) - pseudoinverse(matrix) @ matrix


def chosen_rows(rows: slice | Sequence[int]) -> NDArray[np.int_]:
    """Indices of the rows of a twist that `rows` names; ChainError if it names none or others."""
    try:
        index = rows if isinstance(rows, slice) else list(rows)
        chosen = np.arange(6)[index]
    except (IndexError, TypeError):
        chosen = np.arange(0)
    if not chosen.size:
        raise ChainError(f"rows takes some of the rows 0 to 5 of a twist, got {rows!r}")
    return chosen


def check_rows(name: str, values: Array, J: Array) -> None:
    """Raises ChainError for rows (..., k) that do not broadcast with Jacobians J (..., m, n)."""
    check_batch(name, values.shape[:-1], J, fits="as many rows as q,")


def _rates(J: Array, wanted: Array, damping: Array) -> Array:
    if damping.any():
        check_rows("damping", damping[..., None], J)
        return (damped_inverse(J, damping) @ wanted[..., None])[..., 0]
    least = (pseudoinverse(J) @ wanted[..., None])[..., 0]
    if J.shape[-2] != J.shape[-1]:
        return least

    values = np.linalg.svd(J, compute_uv=False)
    regular = values[..., -1] > REGULAR * values[..., 0]
    # a singular block is replaced before it is solved: one bad configuration spoils no batch
    solvable = np.where(regular[..., None, None], J, np.eye(J.shape[-1]))
    exact = np.linalg.solve(solvable, wanted[..., None])[..., 0]
    return np.where(regular[..., None], exact, least)


def _matrix(J: ArrayLike) -> Array:
    matrix = reals("J", J)
    if matrix.ndim < 2:
        raise ChainError(f"J takes shape (..., m, n), got {matrix.shape}")
    return matrix
