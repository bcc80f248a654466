"""Twists from joint rates, and joint rates from twists."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import Array, Chain, ChainError, configuration, reals
from .jacobian import Frame, jacobian

REGULAR = 1e-10  # a singular value below this share of the largest counts as zero


def twist(chain: Chain, q: ArrayLike, qdot: ArrayLike, frame: Frame = "base") -> Array:
    """Twists (..., 6) of the tool, [m/s] above [rad/s], at q (..., n) with joint rates qdot (..., n).

    Raises ChainError.
    """
    rates = configuration(chain.n, qdot, "qdot")
    J = jacobian(chain, q, frame)
    _check_batch("qdot", rates, J)
    return (J @ rates[..., None])[..., 0]


def joint_rates(
    chain: Chain, q: ArrayLike, twist: ArrayLike, rows: slice | Sequence[int] = slice(None), frame: Frame = "base"
) -> Array:
    """Joint rates (..., n) [rad/s, m/s] that reach the stated `rows` of the twists at q (..., n).

    `twist` holds whole twists (..., 6), or their m stated rows alone, (..., m). Where those rows of J are square and
    regular, the rates are unique; elsewhere they are the least-squares solution of minimum norm. A block is regular if
    its smallest singular value exceeds 1e-10 of its largest. Raises ChainError.
    """
    chosen = _chosen(rows)
    J = jacobian(chain, q, frame)[..., chosen, :]
    wanted = reals("twist", twist)
    if len(chosen) == 6 or wanted.shape[-1:] != chosen.shape:
        wanted = configuration(6, wanted, "twist")[..., chosen]
    _check_batch("twist", wanted, J)
    least = (pseudoinverse(J) @ wanted[..., None])[..., 0]
    if len(chosen) != chain.n:
        return least
    values = np.linalg.svd(J, compute_uv=False)
    regular = values[..., -1] > REGULAR * values[..., 0]
    # a singular block is replaced before it is solved, so that one bad configuration spoils no batch
    solved = np.linalg.solve(np.where(regular[..., None, None], J, np.eye(chain.n)), wanted[..., None])[..., 0]
    return np.where(regular[..., None], solved, least)


def pseudoinverse(J: ArrayLike) -> Array:
    """Moore-Penrose inverses (..., n, m) of J (..., m, n); singular values below 1e-10 of the largest count as zero.

    At full row rank it is the right inverse J^T (J J^T)^-1 (S3, section 5.2.1): J J+ = I, while J+ J is a projector.
    """
    return np.asarray(np.linalg.pinv(np.asarray(J, dtype=np.float64), rcond=REGULAR), dtype=np.float64)


def _chosen(rows: slice | Sequence[int]) -> NDArray[np.int_]:
    try:
        chosen = np.arange(6)[rows if isinstance(rows, slice) else list(rows)]
    except (IndexError, TypeError):
        chosen = np.arange(0)
    if not chosen.size:
        raise ChainError(f"rows takes some of the rows 0 to 5 of a twist, got {rows!r}")
    return chosen


def _check_batch(name: str, values: Array, J: Array) -> None:
    try:
        np.broadcast_shapes(values.shape[:-1], J.shape[:-2])
    except ValueError:
        raise ChainError(f"{name} takes as many rows as q, {J.shape[:-2]}, got {values.shape[:-1]}") from None
