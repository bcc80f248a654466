"""Rotation matrices, the vectors of the rotations between them, and inverses of transforms."""

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, ChainError, reals

ORTHOGONAL = 1e-6  # how far R^T R may be from the identity: an input of seven digits passes


def rotations(name: str, values: ArrayLike) -> Array:
    """Rotations as float64 of shape (..., 3, 3); ChainError says what is wrong with other input."""
    R = reals(name, values)
    if R.shape[-2:] != (3, 3):
        raise ChainError(f"{name} takes shape (..., 3, 3), got {R.shape}")
    if R.size and (np.abs(R.mT @ R - np.eye(3)).max() > ORTHOGONAL or np.linalg.det(R).min() < 0):
        raise ChainError(f"{name} takes right-handed rotations, got another matrix")
    return R


def rotation_vector(rotation: ArrayLike) -> Array:
    """Vectors dw (..., 3) [rad] with R = R(dw): axes of rotations (..., 3, 3) times their angles.

    Angles are in [0, pi]; at pi one of the two opposite vectors is returned. dw of
    R(q + dq) R(q)^T is the small rotation vector of S0, eq. 4.11. Raises ChainError.
    """
    e = _unit_quaternion(rotations("rotation", rotation))
    sine = np.linalg.norm(e[..., 1:], axis=-1)  # of half the angle
    angle = 2 * np.arctan2(sine, e[..., 0])

    # angle / sine tends to 2 where there is no rotation
    turns = sine > 0
    factor = np.where(turns, angle / np.where(turns, sine, 1.0), 2.0)
    return e[..., 1:] * factor[..., None]


def _unit_quaternion(R: Array) -> Array:
    """Unit quaternions e = (w, x, y, z), w >= 0, of shape (..., 4)."""
    # S = 4 e e^T: its row of largest diagonal loses no digits at any angle
    S = np.empty((*R.shape[:-2], 4, 4))
    diagonal = np.diagonal(R, axis1=-2, axis2=-1)
    S[..., 0, 0] = 1 + diagonal.sum(axis=-1)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        S[..., i + 1, i + 1] = 1 + diagonal[..., i] - diagonal[..., j] - diagonal[..., k]
        S[..., 0, i + 1] = S[..., i + 1, 0] = R[..., k, j] - R[..., j, k]
        S[..., j + 1, k + 1] = S[..., k + 1, j + 1] = R[..., k, j] + R[..., j, k]

    largest = np.argmax(np.diagonal(S, axis1=-2, axis2=-1), axis=-1)
    e = np.take_along_axis(S, largest[..., None, None], axis=-2)[..., 0, :]
    sign = np.where(e[..., :1] < 0, -1.0, 1.0)
    return e / np.linalg.norm(e, axis=-1, keepdims=True) * sign


def vector_rotation(vector: ArrayLike) -> Array:
    """Rotations (..., 3, 3) about vectors (..., 3) by their lengths [rad], after Rodrigues.

    Raises ChainError.
    """
    w = reals("vector", vector)
    if w.shape[-1:] != (3,):
        raise ChainError(f"vector takes shape (..., 3), got {w.shape}")
    angle = np.linalg.norm(w, axis=-1)[..., None, None]
    W = np.cross(w[..., None, :], np.eye(3)).mT

    # sinc(x) is sin(pi x) / (pi x); both quotients are right at angle 0
    linear = np.sinc(angle / np.pi)
    quadratic = 0.5 * np.sinc(angle / (2 * np.pi)) ** 2
    return np.eye(3) + linear * W + quadratic * (W @ W)


def inverse_transform(transform: Array) -> Array:
    """Inverses (..., 4, 4) of rigid transforms (..., 4, 4)."""
    inverse_rotation = transform[..., :3, :3].mT
    inverse = np.zeros(transform.shape)
    inverse[..., :3, :3] = inverse_rotation
    inverse[..., :3, 3:] = -inverse_rotation @ transform[..., :3, 3:]
    inverse[..., 3, 3] = 1.0
    return inverse
