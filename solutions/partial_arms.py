"""Parts of an arm: the Jacobian of a frame in between, of one seen from another, a held joint."""

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError, configuration, elementary
from .kinematics import frames

HELD = {"R": "Rz", "P": "Tz"}


def frame_jacobian(chain: Chain, q: ArrayLike, frame: int) -> Array:
    """Jacobians (..., 6, n) of frame `frame` of `frames`, 0 to n, in base axes, at q (..., n).

    Joint i turns about the z of frame i - 1, so it moves the frames from i on: the columns of those
    behind are zero. Raises ChainError.
    """
    place = _place(chain, "frame", frame)
    return _columns(frames(chain, configuration(chain.n, q)), chain.kinds, 0, place)


def relative_jacobian(chain: Chain, q: ArrayLike, frame: int, seen_from: int) -> Array:
    """Jacobians (..., 6, n) of one frame as seen from another, in axes of that other.

    Both are of `frames`, `seen_from` the one nearer to the base. Raises ChainError.
    """
    first, last = _place(chain, "seen_from", seen_from), _place(chain, "frame", frame)
    if first > last:
        raise ChainError(f"seen_from takes a frame up to {last}, got {first}")
    placed = frames(chain, configuration(chain.n, q))
    J = _columns(placed, chain.kinds, first, last)
    R = placed[..., first, :3, :3]
    # joint first + 1 moves what frame `first`, that before it, sees
    return np.concatenate([R.mT @ J[..., :3, :], R.mT @ J[..., 3:, :]], axis=-2)


def with_held_joint(chain: Chain, joint: int, value: float) -> Chain:
    """The chain with one joint, counted from 1, held at a value [rad, m].

    Raises ChainError.
    """
    if not 1 <= joint <= chain.n:
        raise ChainError(f"joint takes a number from 1 to {chain.n}, got {joint!r}")
    if chain.n == 1:
        raise ChainError("a chain takes one joint that moves, got its only one held")
    i = joint - 1
    moved = elementary(HELD[chain.kinds[i]], configuration(1, [value], "value")[0])
    merged = chain.fixed[i] @ moved @ chain.fixed[i + 1]
    fixed = [*chain.fixed[:i], merged, *chain.fixed[i + 2 :]]
    return Chain(np.array(fixed), chain.kinds[:i] + chain.kinds[i + 1 :])


def _columns(placed: Array, kinds: str, first: int, last: int) -> Array:
    """Columns of the joints between two frames (..., n + 1, 4, 4); those of the others are zero."""
    J = np.zeros((*placed.shape[:-3], 6, len(kinds)))
    p = placed[..., last, :3, 3]
    for i in range(first, last):
        z = placed[..., i, :3, 2]
        if kinds[i] == "P":
            J[..., :3, i] = z
        else:
            J[..., :3, i] = np.cross(z, p - placed[..., i, :3, 3])
            J[..., 3:, i] = z
    return J


def _place(chain: Chain, name: str, frame: int) -> int:
    if not 0 <= frame <= chain.n:
        raise ChainError(f"{name} takes a number from 0 to {chain.n}, got {frame!r}")
    return frame
