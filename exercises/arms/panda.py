"""The Franka Emika Panda, an arm with seven revolute joints."""

import numpy as np

from ...solutions.robots import ROBOTS
from ..arm import Arm
from ..drawing import Drawing

PANDA = ROBOTS["panda"]


def posture(rng: np.random.Generator) -> list[float]:
    """Joint angles (7,) [rad] away from the limits of the arm."""
    low, high = np.array(PANDA.limits).T
    q = low + (high - low) * rng.uniform(0.15, 0.85, 7)
    return [round(float(x), 3) for x in q]


def drawn(arm: Arm) -> Drawing:
    """The arm in the drawn posture."""
    return arm.drawing(
        "The arm in the posture that your J belongs to, with the base frame and the hand frame.",
        "Panda arm with seven revolute joints in the student's posture.",
        tool="hand",
        arrows=False,
    )
