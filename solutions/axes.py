"""Chains assembled from constant transforms and joints about, or along, any axis."""

from collections.abc import Iterable

import numpy as np

from .chain import Array, Chain

PlacedJoint = tuple[str, Array]  # "R" or "P", and the frame (4, 4) whose z is the joint's axis
SHORT = 0.5  # what is left of x across an axis; below it the frame would lose digits


def assembled(moves: Iterable[Array | PlacedJoint]) -> Chain:
    """Chain of moves in order, each a constant transform (4, 4) or a joint A E(q) A^-1, given as its kind and A.

    Raises ChainError.
    """
    fixed, kinds = [np.eye(4)], ""
    for move in moves:
        if isinstance(move, tuple):
            kind, axis = move
            fixed[-1] = fixed[-1] @ axis
            fixed.append(inverse(axis))
            kinds += kind
        else:
            fixed[-1] = fixed[-1] @ move
    return Chain(np.array(fixed), kinds)


def along(z: Array, point: Array | None = None, near: Array | None = None) -> Array:
    """Frame (4, 4) with its z along the unit vector z (3,), its origin at `point` (3,) and its x close to another's.

    `near` (3, 3) is the rotation to stay close to, by default that of the base: axes that are parallel or normal to
    its own give a transform of zeros and ones, which costs the chain's program nothing.
    """
    columns = np.eye(3) if near is None else near
    x, y = (column - z * (z @ column) for column in (columns[:, 0], columns[:, 1]))
    if np.linalg.norm(x) < SHORT:
        x = np.cross(y, z)  # near x itself: keep the old y instead
    x = x / np.linalg.norm(x)
    frame = np.eye(4)
    frame[:3, :3] = np.stack([x, np.cross(z, x), z], axis=-1)
    if point is not None:
        frame[:3, 3] = point
    return frame


def inverse(frame: Array) -> Array:
    """Inverse of one rigid transform (4, 4)."""
    R = frame[:3, :3]
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = R.T, -R.T @ frame[:3, 3]
    return result
