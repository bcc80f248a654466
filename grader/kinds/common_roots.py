"""Where several functions are zero at once: Gauss-Newton steps from many places."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

STEPS = 30
LONGEST = 0.5  # rad or m: of one step
SHIFT = 1e-5  # to both sides, for a slope
DAMPING = 1e-10  # of the squared slopes: directions in which nothing changes stay as they are
# Length of the last step of a start that has arrived: a double root is found to half the digits.
SETTLED = 1e-7
STILL = 1e-9  # length of a step behind which none is worth the time

Array = NDArray[np.float64]
Functions = Callable[[Array], Array]
"""From points (n, count) to values (m, count)."""


def common_roots(functions: Functions, starts: Array) -> Array:
    """Points (n, found) where Gauss-Newton from the starts (n, count) comes to rest.

    Some may be places where the functions are least, not zero. Where a point has freedom left, the
    step is the shortest one.
    """
    x, length = starts.copy(), np.full(starts.shape[1], np.inf)
    for _ in range(STEPS):
        going = np.flatnonzero(length > STILL)
        if not len(going):
            break
        with np.errstate(all="ignore"):  # at poles
            step = _step(functions, x[:, going])
        length[going] = np.linalg.norm(step, axis=0)
        x[:, going] += step
        lost = ~np.isfinite(length)
        x, length = x[:, ~lost], length[~lost]
    return x[:, length <= SETTLED]


def _step(functions: Functions, x: Array) -> Array:
    """The damped Gauss-Newton step (n, count) at each point; NaN where there is none.

    It is not longer than half a radian.
    """
    values, slopes = functions(x), _slopes(functions, x)  # (m, count), (m, n, count)
    # Near a double root a function is flat; it weighs the same as others.
    steep = np.linalg.norm(slopes, axis=1)
    steep = np.where(steep > 0, steep, 1.0)
    values, slopes = values / steep, slopes / steep[:, None]

    square = np.einsum("mic,mjc->cij", slopes, slopes)
    damping = DAMPING * np.trace(square, axis1=1, axis2=2) + np.finfo(float).tiny
    square += damping[:, None, None] * np.eye(len(x))
    sound = np.isfinite(square).all(axis=(1, 2)) & np.isfinite(values).all(axis=0)
    square[~sound] = np.eye(len(x))
    down = np.einsum("mic,mc->ci", slopes, values)
    downward = np.asarray(np.linalg.solve(square, down[..., None]), dtype=np.float64)[..., 0]
    step = np.where(sound, -downward.T, np.nan)
    length = np.linalg.norm(step, axis=0)
    return step * np.minimum(1.0, LONGEST / np.maximum(length, LONGEST))


def _slopes(functions: Functions, x: Array) -> Array:
    """Derivatives (m, n, count) by differences, all in one call."""
    n, count = x.shape
    shifts = SHIFT * np.concatenate([np.eye(n), -np.eye(n)])  # (2 n, n)
    moved = x[:, None, :] + shifts.T[:, :, None]
    values = functions(moved.reshape(n, -1)).reshape(-1, 2, n, count)
    return (values[:, 0] - values[:, 1]) / (2 * SHIFT)
