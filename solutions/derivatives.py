"""How the Jacobian changes: its derivatives by the joint values, and by time."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError, configuration, reals
from .jacobian import Axes, check_batch, check_frame, jacobian
from .kinematics import forward
from .rotation import rotations
from .velocity import check_rows, chosen_rows, pseudoinverse


def jacobian_dot(
    chain: Chain,
    q: ArrayLike,
    qdot: ArrayLike,
    frame: Axes = "base",
    *,
    point: ArrayLike | None = None,
) -> Array:
    """Time derivatives dJ/dt (..., 6, n) at q (..., n) with joint rates qdot (..., n).

    They are exact. J qddot + dJ/dt qdot is the rate of the twist's components in that frame; in the
    base frame its linear rows are the acceleration of the tool point [m/s^2]. `frame` may also be
    rotations (..., 3, 3), axes that stand still, and `point` (..., 3) another point [m] that moves
    with the tool, as of `jacobian`. Raises ChainError.
    """
    if point is not None or not isinstance(frame, str):
        rates = configuration(chain.n, qdot, "qdot")
        H = hessian(chain, q, frame, point=point)
        check_rows("qdot", rates, H[..., 0])
        return (H @ rates[..., None, :, None])[..., 0]

    check_frame(frame)
    J, rates = jacobian(chain, q), configuration(chain.n, qdot, "qdot")
    check_rows("qdot", rates, J)
    weighted = J * rates[..., None, :]

    # joints 1 ... i carry column i along with W, those beyond i move the tool alone, with V
    W = np.cumsum(weighted[..., 3:, :], axis=-1)
    V = weighted[..., :3, :].sum(axis=-1, keepdims=True) - np.cumsum(weighted[..., :3, :], axis=-1)
    v, w = J[..., :3, :], J[..., 3:, :]
    linear, angular = _cross(W, v) + _cross(w, V), _cross(W, w)
    if frame == "base":
        return np.concatenate([linear, angular], axis=-2)

    R, omega = forward(chain, q)[..., :3, :3], W[..., -1:]
    linear = R.mT @ (linear - _cross(omega, v))
    angular = R.mT @ (angular - _cross(omega, w))
    return np.concatenate([linear, angular], axis=-2)


def hessian(
    chain: Chain, q: ArrayLike, frame: Axes = "base", *, point: ArrayLike | None = None
) -> Array:
    """Derivatives dJ/dq (..., 6, n, n) at q (..., n): entry [..., i, k] is column i of J by q_k.

    They are exact. With w_i and v_i the blocks of column i in the base frame, the linear rows are
    w_i x v_k for i <= k, and symmetric, being second derivatives of p; the angular rows are
    w_k x w_i for k < i and 0 elsewhere. H qdot is dJ/dt. `frame` and `point` are those of
    `jacobian_dot`. Raises ChainError.
    """
    if isinstance(frame, str):
        check_frame(frame)
    # a point of the tool moves as the tool point does: with its own v the same holds for it
    J = jacobian(chain, q, point=None if point is None else _coordinates(point))
    v, w = J[..., :3, :], J[..., 3:, :]
    first, second = np.triu_indices(chain.n)
    H = np.zeros((*J.shape, chain.n))
    linear = _cross(w[..., first], v[..., second])
    H[..., :3, first, second] = linear
    H[..., :3, second, first] = linear
    H[..., 3:, second, first] = _cross(w[..., first], w[..., second])
    if not isinstance(frame, str):
        return _in_axes(H, rotations("frame", frame), J)
    if frame == "base":
        return H

    R = forward(chain, q)[..., :3, :3]
    for k in range(chain.n):  # the tool's axes turn with w_k
        turning = w[..., k : k + 1]
        H[..., :3, :, k] = R.mT @ (H[..., :3, :, k] - _cross(turning, v))
        H[..., 3:, :, k] = R.mT @ (H[..., 3:, :, k] - _cross(turning, w))
    return H


def _coordinates(point: ArrayLike) -> Array:
    """Points (..., 3); "origin", the spatial twist's, is none that moves with the tool."""
    if isinstance(point, str):
        raise ChainError(f"point takes coordinates (..., 3) of a point of the tool, got {point!r}")
    return reals("point", point)


def _in_axes(H: Array, R: Array, J: Array) -> Array:
    """Derivatives (..., 6, n, n) in axes that stand still, the columns of R (..., 3, 3)."""
    check_batch("frame", R.shape[:-2], J)
    turn = R.mT[..., None, :, :]
    blocks = [np.moveaxis(H[..., rows, :, :], -1, -3) for rows in (slice(0, 3), slice(3, 6))]
    turned = [np.moveaxis(turn @ block, -3, -1) for block in blocks]
    return np.concatenate(turned, axis=-3)


def _cross(a: Array, b: Array) -> Array:
    """Cross products of columns: (..., 3, n) each."""
    ax, ay, az = a[..., 0, :], a[..., 1, :], a[..., 2, :]
    bx, by, bz = b[..., 0, :], b[..., 1, :], b[..., 2, :]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-2)


def manipulability_gradient(
    chain: Chain, q: ArrayLike, rows: slice | Sequence[int] = slice(None)
) -> Array:
    """Derivatives (..., n) of `manipulability` of the stated rows by the joint values, q (..., n).

    With m = sqrt(det(J J^T)) they are m times the trace of J+ dJ/dq_k (Yoshikawa, 1985). Where m is
    zero it has no derivative, and zeros stand here. Raises ChainError.
    """
    chosen = chosen_rows(rows)
    J = jacobian(chain, q)[..., chosen, :]
    if len(chosen) > chain.n:
        raise ChainError(f"rows takes up to {chain.n} rows, one for each joint, got {len(chosen)}")
    H = hessian(chain, q)[..., chosen, :, :]
    measure = np.linalg.svd(J, compute_uv=False).prod(axis=-1)
    return measure[..., None] * np.einsum("...nm,...mnk->...k", pseudoinverse(J), H)
