"""The RRT arm of S3 5.4.1 in its forms: the sense of axis 2, and which of three offsets it has."""

from functools import lru_cache
from itertools import pairwise, product

import numpy as np

from ...solutions.robot import Factor, Robot
from ...solutions.robots import ROBOTS
from ..arm import Arm
from ..drawing import Drawing

LENGTHS = ("d1", "a1", "d2", "l3")
NAMES = (*LENGTHS, "q1", "q2", "q3")
OFFSETS = ((), ("a1",), ("d2",), ("l3",), ("a1", "d2"), ("a1", "l3"), ("d2", "l3"))
FORMS = tuple((alpha1, offsets) for offsets, alpha1 in product(OFFSETS, ("-pi/2", "pi/2")))


def reach(arm: Arm) -> float:
    """How far the hand is from axis 1, seen along axis 2 [m]."""
    return float(abs(arm.p @ arm.frames[1, :3, 0]))


@lru_cache
def robot(form: int) -> Robot:
    """The arm of one form, with every length 1 m by default."""
    alpha1, offsets = FORMS[form]
    # Axis 2 points to the left of axis 1 or to the right, and alpha2 turns back.
    alpha2, sense = "pi/2", "+"
    if alpha1 == "pi/2":
        alpha2, sense = "-pi/2", "-"

    a1, d2, stroke, across = "0", "0", "q3", "sin(q2)"
    if "a1" in offsets:
        a1 = "a1"
    if "d2" in offsets:
        d2 = "d2"
    if "l3" in offsets:
        stroke = "q3 + l3"
    if "a1" in offsets:
        across = f"({stroke})*sin(q2) {sense} a1"

    return Robot(
        name="rrt",
        title="RRT robot",
        parameters=dict.fromkeys(("d1", *offsets), 1.0),
        rows=(("q1", "d1", a1, alpha1), ("q2", d2, "0", alpha2), ("0", stroke, "0", "0")),
        limits=ROBOTS["rrt_spherical"].limits,
        source="S3 5.4.1; drawn for each student",
        factors=(
            Factor("hand on axis 2", stroke),
            Factor("hand on axis 1, or beside it along axis 2", across),
        ),
    )


def drawings(arm: Arm) -> tuple[Drawing, Drawing]:
    """The arm at home with all lengths and the stroke q3, and at the student's q."""
    alt = "RRT arm: a vertical revolute joint, a horizontal revolute joint, a slide."
    at_home = "Home pose, q1 = q2 = 0, with the positive sense of each joint."
    at_q = "The same robot at your q."
    home = arm.at([0.0, 0.0, arm.q[2]])

    # Lengths and stroke lead from the base to the hand, one after the other.
    base, shoulder, hand = (frame[:3, :3].T for frame in home.frames[:3])
    ways = {"d1": base[2], "a1": shoulder[0], "d2": shoulder[2], "l3": hand[2], "q3": hand[2]}
    sizes = {**arm.lengths, "q3": arm.q[2]}
    steps = [size * ways[name] for name, size in sizes.items()]
    corners = np.cumsum([np.zeros(3), *steps], axis=0)
    lines = dict(zip(sizes, pairwise(corners), strict=True))
    return (
        home.drawing(at_home, f"{alt} {at_home}", lengths=lines),
        arm.drawing(at_q, f"{alt} {at_q}", tool=""),
    )
