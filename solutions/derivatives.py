"""How the Jacobian changes: its derivatives by the joint values, and by time."""

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, configuration
from .jacobian import Frame, check_frame, jacobian
from .kinematics import forward
from .velocity import check_rows


def jacobian_dot(chain: Chain, q: ArrayLike, qdot: ArrayLike, frame: Frame = "base") -> Array:
    """Time derivatives dJ/dt (..., 6, n) at q (..., n) with joint rates qdot (..., n).

    They are exact. J qddot + dJ/dt qdot is the rate of the twist's components in that frame; in the
    base frame its linear rows are the acceleration of the tool point [m/s^2]. Raises ChainError.
    """
    check_frame(frame)  # for axes that stand still: `in_axes`
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


def hessian(chain: Chain, q: ArrayLike, frame: Frame = "base") -> Array:
    """Derivatives dJ/dq (..., 6, n, n) at q (..., n): entry [..., i, k] is column i of J by q_k.

    They are exact. With w_i and v_i the blocks of column i in the base frame, the linear rows are
    w_i x v_k for i <= k, and symmetric, being second derivatives of p; the angular rows are
    w_k x w_i for k < i and 0 elsewhere. H qdot is dJ/dt. Raises ChainError.
    """
    check_frame(frame)
    J = jacobian(chain, q)
    v, w = J[..., :3, :], J[..., 3:, :]
    first, second = np.triu_indices(chain.n)
    H = np.zeros((*J.shape, chain.n))
    linear = _cross(w[..., first], v[..., second])
    H[..., :3, first, second] = linear
    H[..., :3, second, first] = linear
    H[..., 3:, second, first] = _cross(w[..., first], w[..., second])
    if frame == "base":
        return H

    R = forward(chain, q)[..., :3, :3]
    for k in range(chain.n):  # the tool's axes turn with w_k
        turning = w[..., k : k + 1]
        H[..., :3, :, k] = R.mT @ (H[..., :3, :, k] - _cross(turning, v))
        H[..., 3:, :, k] = R.mT @ (H[..., 3:, :, k] - _cross(turning, w))
    return H


def _cross(a: Array, b: Array) -> Array:
    """Cross products of columns: (..., 3, n) each."""
    ax, ay, az = a[..., 0, :], a[..., 1, :], a[..., 2, :]
    bx, by, bz = b[..., 0, :], b[..., 1, :], b[..., 2, :]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-2)
