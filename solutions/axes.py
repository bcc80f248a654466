"""Chains assembled from constant transforms and joints about, or along, any axis."""

from collections.abc import Iterable

import numpy as np

from .chain import Array, Chain
from .rotation import inverse_transform

PlacedJoint = tuple[str, Array]  # "R" or "P", and the frame (4, 4) whose z is the joint's axis
SHORT = 0.5  # what is left of x across an axis; below it the frame would lose digits


def assembled(moves: Iterable[Array | PlacedJoint]) -> Chain:
    """Chain of moves in order, each a constant transform (4, 4) or a joint A E(q) A^-1.

    A joint is given as its kind and A. Raises ChainError.
    """
    fixed = [np.eye(4)]
    kinds = ""
    for move in moves:
        if isinstance(move, tuple):
            kind, axis = move
            fixed[-1] = fixed[-1] @ axis
            fixed.append(inverse_transform(axis))
            kinds += kind
        else:
            fixed[-1] = fixed[-1] @ move
    return Chain(np.array(fixed), kinds)


def along(z: Array, point: Array | None = None, near: Array | None = None) -> Array:
    """Frame (4, 4) with its z along the unit vector z (3,) and its origin at `point` (3,).

    `near` (3, 3) is the rotation whose x it stays close to, by default that of the base: axes that
    are parallel or normal to its own give a transform of zeros and ones, which costs the chain's
    program nothing.
    """
    columns = np.eye(3)
    if near is not None:
        columns = near

    # what is left of the old x and y across the new z
    x = columns[:, 0] - z * (z @ columns[:, 0])
    y = columns[:, 1] - z * (z @ columns[:, 1])
    if np.linalg.norm(x) < SHORT:
        x = np.cross(y, z)  # near x itself: keep the old y instead
    x = x / np.linalg.norm(x)

    frame = np.eye(4)
    frame[:3, :3] = np.stack([x, np.cross(z, x), z], axis=-1)
    if point is not None:
        frame[:3, 3] = point
    return frame
