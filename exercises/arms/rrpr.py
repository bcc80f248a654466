"""An arm of joints RRPR whose axes point in drawn senses, and as its table is misread."""

from dataclasses import replace
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from ...solutions.robot import Robot
from ..arm import Arm, Array, units_of
from ..calculations.degrees import DEGREES, arm_in_degrees
from ..contract.printed_table import printed_table, table_rows
from ..drawing import Drawing
from ..draws import angles, length

__all__ = [
    "DEGREES",
    "LENGTHS",
    "LEVEL",
    "SENSES",
    "UNITS",
    "described",
    "drawn",
    "in_degrees",
    "level",
    "posture",
    "robot",
    "rotation_at",
]

SENSES = tuple(product(("", "-"), repeat=4))  # of alpha1, alpha2, theta3, alpha3
LENGTHS = ("d1", "a2", "a4")
LEVEL = "Row 3 of the table: joint 3 slides, but its theta is a right angle and not zero."


@lru_cache
def robot(form: int, *, right_angle: str = "pi/2", level: bool = False) -> Robot:
    """The arm with the senses of `SENSES[form]`, with every length 1 m by default.

    It is misread with another `right_angle`, and when it is `level`: with zero for the one in theta
    of row 3.
    """
    alpha1, alpha2, theta3, alpha3 = (sense + right_angle for sense in SENSES[form])
    if level:
        theta3 = "0"
    return Robot(
        name="rrpr",
        title="RRPR robot",
        parameters=dict.fromkeys(LENGTHS, 1.0),
        rows=(
            ("q1", "d1", "0", alpha1),
            ("q2", "0", "a2", alpha2),
            (theta3, "q3", "0", alpha3),
            ("q4", "0", "a4", "0"),
        ),
        limits=((-np.pi, np.pi), (-np.pi, np.pi), (0.0, 1.0), (-np.pi, np.pi)),
        source="drawn for each student",
    )


UNITS = units_of(robot(0))


def posture(rng: np.random.Generator) -> list[float]:
    """A generic q (4,) [rad, m] of the arm."""
    q1, q2, q4 = angles(rng, 3)
    return [q1, q2, length(rng, 0.3, 0.8), q4]


def rotation_at(form: int, q: ArrayLike) -> Array:
    """Rotation (3, 3) of the tool frame; lengths do not matter for it."""
    return robot(form).frames(None, q)[-1, :3, :3]


def level(form: int, arm: Arm) -> Arm:
    """The student's arm without the right angle in row 3, as `LEVEL` says."""
    return replace(arm, robot=robot(form, level=True))


def in_degrees(form: int, arm: Arm) -> Arm:
    """The student's arm with its angles in degrees where radians are taken, as `DEGREES` says."""
    return arm_in_degrees(arm, robot(form, right_angle="90"))


def described(arm: Arm) -> str:
    """What a sheet says of the arm: joints, table and frames."""
    return rf"""An arm with revolute joints 1, 2 and 4 and a prismatic joint 3 (RRPR) has this table
in the **standard** Denavit–Hartenberg convention,
$\mathbf T_{{i-1}}^i = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$;
the base frame is frame 0, the tool frame is frame 4:

{printed_table(table_rows(arm.robot))}"""


def drawn(arm: Arm) -> Drawing:
    """The arm as it stands."""
    return arm.drawing(
        "Your arm at q, with the base frame and the tool frame.",
        "Arm with two revolute joints, a slide and another revolute joint, drawn at your q.",
    )
