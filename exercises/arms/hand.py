"""S1's articulated arm with a hand on axis 6, and as its table is misread."""

from dataclasses import replace

import numpy as np

from ...solutions.robots import ROBOTS
from ..arm import Arm, Array
from ..calculations.degrees import DEGREES, arm_in_degrees
from ..calculations.last_frame import to_last
from ..contract.printed_table import table_rows
from ..drawing import Drawing

__all__ = ["ARM", "CONVENTION", "DEGREES", "ROBOT", "drawn", "in_degrees", "modified"]

ARM = ROBOTS["articulated_6r"]
ROBOT = replace(
    ARM,
    parameters={**ARM.parameters, "d6": 0.1},
    rows=[*table_rows(ARM)[:5], ["q6", "d6", "0", "0"]],
)
MODIFIED = replace(ROBOT, convention="modified")
RIGHT_ANGLES = {"pi/2": "90", "-pi/2": "-90", "0": "0"}
IN_DEGREES = replace(
    ROBOT, rows=[(theta, d, a, RIGHT_ANGLES[alpha]) for theta, d, a, alpha in table_rows(ROBOT)]
)
CONVENTION = (
    "The table seems to be read in the modified convention; "
    "look again at the order of the motions of a row."
)


def modified(arm: Arm) -> Array:
    """Transforms (7, 4, 4) to the last frame where the table is read in the modified convention."""
    frames = replace(arm, robot=MODIFIED).frames
    return np.linalg.inv([np.eye(4), *frames[:6]]) @ frames[-1]


def in_degrees(arm: Arm) -> Array:
    """Transforms (7, 4, 4) to the last frame, as `DEGREES` says."""
    return to_last(arm_in_degrees(arm, IN_DEGREES))


def drawn(arm: Arm) -> Drawing:
    """The arm at the student's q."""
    alt = (
        "Articulated arm with six revolute joints, drawn at your q with its base frame and its "
        "hand frame."
    )
    return arm.drawing("Your arm at your q, with frame 0 and frame 6.", alt, tool="6", arrows=False)
