"""Wrenches [f; m] at the tool, [N] above [N m], and the joint torques that hold them."""

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError, configuration, reals
from .jacobian import Axes, Point, check_batch, jacobian
from .rotation import rotations
from .velocity import check_rows


def joint_torques(
    chain: Chain,
    q: ArrayLike,
    wrench: ArrayLike,
    frame: Axes = "base",
    *,
    point: Point | None = None,
) -> Array:
    """Torques and forces (..., n) [N m, N] of the joints, tau = J^T F, at q (..., n).

    `wrench` (..., 6) is what the tool exerts on its surroundings, force above moment, at the tool
    point or at `point`, in axes of `frame`: those of `jacobian`. Raises ChainError.
    """
    F = _wrenches(wrench)
    J = jacobian(chain, q, frame, point=point)
    check_rows("wrench", F, J)
    return (J.mT @ F[..., None])[..., 0]


def wrench_at(wrench: ArrayLike, offset: ArrayLike) -> Array:
    """The same wrenches (..., 6) about other points, `offset` (..., 3) [m] from theirs.

    The force stays, and its lever is taken off the moment: m - r x f. Raises ChainError.
    """
    F, r = _wrenches(wrench), reals("offset", offset)
    if r.shape[-1:] != (3,):
        raise ChainError(f"offset takes shape (..., 3), got {r.shape}")
    check_batch("offset", r.shape[:-1], F[..., None])
    moment = F[..., 3:] - np.cross(r, F[..., :3])
    return np.concatenate([np.broadcast_to(F[..., :3], moment.shape), moment], axis=-1)


def wrench_in(wrench: ArrayLike, rotation: ArrayLike) -> Array:
    """The same wrenches (..., 6) in other axes, the columns of `rotation` (..., 3, 3).

    The columns are given in the axes that the wrench is in. Raises ChainError.
    """
    F, R = _wrenches(wrench), rotations("rotation", rotation)
    check_batch("rotation", R.shape[:-2], F[..., None])
    force, moment = R.mT @ F[..., :3, None], R.mT @ F[..., 3:, None]
    return np.concatenate([force, moment], axis=-2)[..., 0]


def _wrenches(wrench: ArrayLike) -> Array:
    return configuration(6, wrench, "wrench")
