"""What is missing between two poses: a translation and a rotation vector."""

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, ChainError, reals
from .jacobian import check_batch
from .rotation import rotation_vector


def displacement(reached: ArrayLike, desired: ArrayLike) -> Array:
    """Displacements du (..., 6) from reached to desired transforms (..., 4, 4).

    Translations dp [m] stand above rotation vectors dw [rad], both in base axes, with
    R_desired = R(dw) R_reached (S0, eq. 4.11 and 4.13). Raises ChainError.
    """
    a, b = _transforms("reached", reached), _transforms("desired", desired)
    check_batch("desired", b.shape[:-2], a)
    dw = rotation_vector(b[..., :3, :3] @ a[..., :3, :3].mT)
    dp = np.broadcast_to(b[..., :3, 3] - a[..., :3, 3], dw.shape)
    return np.concatenate([dp, dw], axis=-1)


def _transforms(name: str, values: ArrayLike) -> Array:
    T = reals(name, values)
    if T.shape[-2:] != (4, 4):
        raise ChainError(f"{name} takes shape (..., 4, 4), got {T.shape}")
    return T
