"""Rigid motions SE(3): their logarithms and exponentials, and how twists change with the frame.

Linear rows stand above angular ones; Lynch and Park, chapter 3, have them the other way round.
"""

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, ChainError, configuration, reals
from .rotation import rotation_vector, rotations, vector_rotation

SMALL = 1e-2  # rad: below, the quotients of sines and angles lose digits and a series does not


def pose_log(transform: ArrayLike) -> Array:
    """Twists (..., 6) [v; w] whose motion for one second is the transform (..., 4, 4).

    The angle is in [0, pi]. Raises ChainError.
    """
    T = _transforms(transform)
    w = rotation_vector(T[..., :3, :3])
    v = np.linalg.solve(_average_rotation(w), T[..., :3, 3:])[..., 0]
    return np.concatenate([np.asarray(v, dtype=np.float64), w], axis=-1)


def pose_exp(twist: ArrayLike) -> Array:
    """Transforms (..., 4, 4) that twists (..., 6) [v; w] come to in one second.

    Raises ChainError.
    """
    xi = configuration(6, twist, "twist")
    v, w = xi[..., :3], xi[..., 3:]
    T = np.zeros((*xi.shape[:-1], 4, 4))
    T[..., :3, :3] = vector_rotation(w)
    T[..., :3, 3] = (_average_rotation(w) @ v[..., None])[..., 0]
    T[..., 3, 3] = 1.0
    return T


def adjoint(transform: ArrayLike) -> Array:
    """Matrices (..., 6, 6) that take a twist in axes of, and at the origin of, a frame to the base.

    The frame stands at `transform` (..., 4, 4). The transposed takes wrenches the other way. Raises
    ChainError.
    """
    T = _transforms(transform)
    R, p = T[..., :3, :3], T[..., :3, 3]
    matrix = np.zeros((*T.shape[:-2], 6, 6))
    matrix[..., :3, :3] = matrix[..., 3:, 3:] = R
    matrix[..., :3, 3:] = _cross_matrix(p) @ R
    return matrix


def rotation_vector_map(vector: ArrayLike) -> Array:
    """Matrices E (..., 3, 3) with omega = E d(vector)/dt, in base axes, at vectors (..., 3) [rad].

    E is singular where the angle is a full turn. Raises ChainError.
    """
    w = reals("vector", vector)
    if w.shape[-1:] != (3,):
        raise ChainError(f"vector takes shape (..., 3), got {w.shape}")
    return _average_rotation(w)


def _average_rotation(w: Array) -> Array:
    """The rotations about s w for s from 0 to 1, averaged: the left Jacobian of SO(3)."""
    angle = np.linalg.norm(w, axis=-1)[..., None, None]
    W = _cross_matrix(w)
    square = angle**2
    small = angle < SMALL
    safe = np.where(small, 1.0, angle)

    # (1 - cos a) / a^2 and (a - sin a) / a^3
    first = 0.5 * np.sinc(angle / (2 * np.pi)) ** 2
    series = 1 / 6 - square / 120 + square**2 / 5040
    second = np.where(small, series, (safe - np.sin(safe)) / safe**3)
    return np.eye(3) + first * W + second * (W @ W)


def _cross_matrix(w: Array) -> Array:
    return np.cross(w[..., None, :], np.eye(3)).mT


def _transforms(values: ArrayLike) -> Array:
    T = reals("transform", values)
    if T.shape[-2:] != (4, 4):
        raise ChainError(f"transform takes shape (..., 4, 4), got {T.shape}")
    if (T[..., 3, :] != (0.0, 0.0, 0.0, 1.0)).any():
        raise ChainError("transform takes the last row [0 0 0 1], got another")
    _ = rotations("transform", T[..., :3, :3])
    return T
