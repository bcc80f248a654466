"""The geometric Jacobian of a chain."""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError, configuration
from .emit import evaluate

Frame = Literal["base", "tool"]


def jacobian(chain: Chain, q: ArrayLike, frame: Frame = "base", out: Array | None = None) -> Array:
    """Jacobians (..., 6, n) at q (..., n): xi = J qdot, linear rows above angular.

    Column i is [z x (p - o); z] for a revolute and [z; 0] for a prismatic joint (S0, eq. 4.8 and 4.10). The twist is
    that of the tool point, in axes of the base or of the tool `frame`. Entries are in m/rad and 1 (revolute),
    1 and 0 (prismatic). With `out`, a C-contiguous float64 array of that shape, the result is written there.
    Raises ChainError.
    """
    values = configuration(chain.n, q)
    if frame not in ("base", "tool"):
        raise ChainError(f"frame takes 'base' or 'tool', got {frame!r}")
    shape = (*values.shape[:-1], 6, chain.n)
    if out is not None and not (out.shape == shape and out.dtype == np.float64 and out.flags.c_contiguous):
        raise ChainError(f"out takes C-contiguous float64 of shape {shape}, got {out.dtype} of shape {out.shape}")
    return evaluate(chain, frame, values, out)


def last_frame_columns(transforms: ArrayLike, kinds: str) -> Array:
    """Jacobian (6, n) in axes of the last frame, from the transforms (n, 4, 4) of ^(i-1)T_n (S1, eq. 5.26, 5.27).

    With n, o, a the columns of the rotation and p the position of ^(i-1)T_n, a revolute column is
    [-n_x p_y + n_y p_x, -o_x p_y + o_y p_x, -a_x p_y + a_y p_x, n_z, o_z, a_z] and a prismatic one
    [n_z, o_z, a_z, 0, 0, 0]. Raises ChainError if there is not one transform for each joint.
    """
    T = np.asarray(transforms, dtype=np.float64)
    if T.shape != (len(kinds), 4, 4) or set(kinds) - {"R", "P"}:
        raise ChainError(f"transforms takes shape {(len(kinds), 4, 4)} for kinds {kinds!r}, got {T.shape}")
    x, y, z = T[:, 0, :3], T[:, 1, :3], T[:, 2, :3]  # rows of the rotation: (n_x, o_x, a_x) and so on
    p = T[:, :3, 3, None]
    revolute = np.concatenate([-x * p[:, 1] + y * p[:, 0], z], axis=1)
    prismatic = np.concatenate([z, np.zeros_like(z)], axis=1)
    turns = np.array([kind == "R" for kind in kinds])[:, None]
    return np.ascontiguousarray(np.where(turns, revolute, prismatic).T)
