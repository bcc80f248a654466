"""Configurations spread evenly over joint limits, the same on every machine."""

import numpy as np
from numpy.typing import ArrayLike, NDArray


def spread(limits: ArrayLike, count: int) -> NDArray[np.float64]:
    """Configurations (count, n) spread evenly over the limits (n, 2): Roberts' additive recurrence.

    Its ratio is the root of x^(n + 1) = x + 1, the golden ratio for one joint.
    """
    low, high = np.transpose(np.asarray(limits, dtype=np.float64))
    n = len(low)
    ratio = 2.0
    for _ in range(40):
        ratio = (1 + ratio) ** (1 / (n + 1))
    shares = np.arange(1, count + 1)[:, None] * ratio ** -np.arange(1.0, n + 1) % 1
    return low + (high - low) * shares
