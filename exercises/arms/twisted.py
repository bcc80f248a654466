"""An RRPR arm with drawn twists and two of four offsets, and its table as it is misread."""

from functools import lru_cache
from itertools import combinations, product
from typing import Any

import numpy as np

from ...solutions.robot import Robot
from ..arm import Arm, Array
from ..drawing import Drawing

KINDS = "RRPR"
UNITS = [["m/rad", "m/rad", "1", "m/rad"]] * 3 + [["1"] * 4] * 3
MODIFIED = (
    "This is what comes out when the table is read in the modified convention; "
    "it is a standard one."
)
LENGTHS = ("d1", "a1", "d2", "a3", "d4", "a4")
TWISTS = ("pi/2", "-pi/2")
FORMS = tuple(product(TWISTS, TWISTS, TWISTS, combinations(("a1", "d2", "a3", "d4"), 2)))


@lru_cache
def robot(form: int, *, convention: Any = "standard") -> Robot:
    """The arm of one form, with every length 1 m by default."""
    alpha1, alpha2, alpha3, offsets = FORMS[form]
    cells = dict.fromkeys(LENGTHS, "0")
    for name in ("d1", "a4", *offsets):
        cells[name] = name
    sizes = {name: 1.0 for name, cell in cells.items() if cell == name}

    return Robot(
        name="find_the_mistake",
        title="RRPR arm",
        parameters=sizes,
        rows=(
            ("q1", cells["d1"], cells["a1"], alpha1),
            ("q2", cells["d2"], "0", alpha2),
            ("0", "q3", cells["a3"], alpha3),
            ("q4", cells["d4"], cells["a4"], "0"),
        ),
        limits=((-np.pi, np.pi), (-np.pi, np.pi), (0.3, 0.9), (-np.pi, np.pi)),
        source="made for this exercise",
        convention=convention,
    )


def modified(arm: Arm, form: int) -> Array:
    """The Jacobian of the table, read in the modified convention."""
    return Arm(robot(form, convention="modified"), arm.lengths, arm.q).J


def drawn(arm: Arm) -> Drawing:
    """The arm at the student's q."""
    return arm.drawing(
        "The arm at your q, with frame 0 and the tool frame.",
        "Arm with two revolute joints, a slide and a third revolute joint, "
        "drawn at the student's q.",
    )
