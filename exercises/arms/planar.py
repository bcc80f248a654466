"""The planar arm of S2 in all its forms, with those for which it may be mistaken.

A form is the sense of each joint, +1 counter-clockwise, seen against z of frame 0, and the angle from link 1 to link 2
where q2 = 0 [quarter turns]. A sheet draws one of the first nine; the others are only misread.
"""

from collections.abc import Callable
from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np

from ...solutions.chain import elementary
from ...solutions.robot import Robot
from ..answers import Variant
from ..arm import Array, arm_of
from ..columns import columns
from ..draws import CLEARANCE, angles, length, until

NAMES = ("l1", "l2", "beta", "q1", "q2")
DRAWN = 9
BENT = 0.3  # smallest |sin| of q2 and of the angle between the links
FORMS = tuple((*senses, quarter) for senses, quarter in product(((1, -1), (-1, 1), (-1, -1), (1, 1)), (0, 1, -1)))
SIGN = {1: "+", -1: "-"}
QUARTER = {0: "", 1: " + pi/2", -1: " - pi/2"}


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of nine forms, bent, with no link near an axis of frame 0."""
    form = int(rng.integers(DRAWN))
    l1, l2 = until(lambda: (length(rng), length(rng)), lambda pair: abs(pair[0] - pair[1]) > 0.05)

    def posture() -> dict[str, Any]:
        beta, *q = angles(rng, 3)
        return {"form": form, "l1": l1, "l2": l2, "beta": beta, "q": q}

    return until(posture, is_clear)


def is_clear(v: Variant) -> bool:
    first, second = link_angles(v)
    bends = np.sin([v["q"][1], second - first])
    past = np.degrees([first, second, sum(v["q"])]) % 90
    return bool((np.abs(bends) > BENT).all() and (np.abs(past - 45) <= 45 - CLEARANCE).all())


@lru_cache
def robot(form: int) -> Robot:
    """The arm, with z of each joint in its positive sense."""
    one, two, quarter = FORMS[form]
    flip1, flip2 = (("Rx", "0" if sense > 0 else "pi") for sense in (one, two))
    rows = ((flip1, ("Rz", "q1")), (flip1, ("Tx", "l1"), ("Rz", f"{quarter}*pi/2"), flip2, ("Rz", "q2")))
    lengths, limits = {"l1": 1.0, "l2": 0.7, "beta": 0.0}, ((-np.pi, np.pi),) * 2
    base, tool = (("Rz", "beta"),), (flip2, ("Tx", "l2"))
    return Robot("planar_2r", "Planar arm", lengths, rows, limits, "S2", "frames", base, tool)


def angle_formulas(form: int, mounting: str = "beta") -> tuple[str, str]:
    """Angles of both links from x of frame 0."""
    one, two, quarter = FORMS[form]
    first = f"{mounting} {SIGN[one]} q1"
    return first, f"{first} {SIGN[two]} q2{QUARTER[quarter]}"


def bend_formula(form: int) -> str:
    """What link 2 turns from link 1, with its sign in front, such as -q2 + pi/2."""
    first, second = angle_formulas(form)
    return second.removeprefix(first).replace(" ", "", 2)


def pose(form: int, mounting: str = "beta") -> list[str]:
    return pose_formulas(*angle_formulas(form, mounting))


def pose_formulas(first: str, second: str) -> list[str]:
    """x, y, theta of frame 2 for the angles of both links."""
    return [f"l1*cos({first}) + l2*cos({second})", f"l1*sin({first}) + l2*sin({second})", second]


def slopes(form: int, inner: tuple[int, ...] = (), minus: int = -1) -> list[list[str]]:
    """The 3 x 2 Jacobian of the pose, with other inner derivatives of the angles or another derivative of a cosine."""
    x, y, second = pose(form)
    one, two = inner or FORMS[form][:2]
    return [
        [f"{minus * one}*({y})", f"{minus * two}*l2*sin({second})"],
        [f"{one}*({x})", f"{two}*l2*cos({second})"],
        [str(one), str(two)],
    ]


def link_angles(v: Variant) -> Array:
    """The angles of both links from x of frame 0 [rad]."""
    one, two, quarter = FORMS[v["form"]]
    return np.cumsum([v["beta"] + one * v["q"][0], two * v["q"][1] + quarter * np.pi / 2])


def links(v: Variant) -> Array:
    """Frame 1 in frame 0 and frame 2 in frame 1, (2, 4, 4)."""
    first, second = link_angles(v)
    return elementary("Rz", [first, second - first]) @ elementary("Tx", [v["l1"], v["l2"]])


def transforms(v: Variant) -> Array:
    """Frames 1 and 2 in frame 0, (2, 4, 4)."""
    elbow, hand = links(v)
    return np.array([elbow, elbow @ hand])


def wrong_order(v: Variant) -> Array:
    elbow, hand = links(v)
    return np.array([elbow, hand @ elbow])


def levers(T: Array) -> Array:
    """From each joint to the tool point, (2, 3)."""
    elbow, tip = T[:, :3, 3]
    return np.array([tip, tip - elbow])


def jacobian(v: Variant) -> Array:
    """The Jacobian (6, 2) of an arm of any form."""
    arm = arm_of(robot(v["form"]), v)
    return columns(arm.axes.T, levers(transforms(v)), "RR")


MOUNTING = "The angle beta of the mounting does not seem to be in it; where does link 1 point at q1 = 0?"
SENSE = "Each joint's angle seems to count counter-clockwise; look again at the positive senses."
SENSE_1 = "The angle of joint 1 seems to be counted the other way; look again at its positive sense."
SENSE_2 = "The angle of joint 2 seems to be counted the other way; look again at its positive sense."
AT_ZERO = "Look again at how link 2 stands to link 1 where q2 = 0."
PRINTED = (
    "This looks like an arm whose joints both count counter-clockwise and whose links are in line at q2 = 0; "
    "look again at the positive senses and at where q2 is zero."
)
READINGS: tuple[tuple[str, Callable[[int, int, int], tuple[int, int, int]]], ...] = (
    (SENSE, lambda _, __, quarter: (1, 1, quarter)),
    (SENSE_1, lambda one, two, quarter: (-one, two, quarter)),
    (SENSE_2, lambda one, two, quarter: (one, -two, quarter)),
    (AT_ZERO, lambda one, two, quarter: (one, two, 0 if quarter else 1)),
    (AT_ZERO, lambda one, two, quarter: (one, two, -quarter or -1)),
    (PRINTED, lambda _, __, ___: (1, 1, 0)),
)  # of the arm by somebody who overlooks what makes it another than the source's


def misread(solve: Callable[[Variant], Any]) -> list[tuple[str, Callable[[Variant], Any]]]:
    """The readings as mistakes of a part that `solve` answers for an arm of any form."""
    return [(sentence, lambda v, *, i=i: solve(misreadings(v)[i])) for i, (sentence, _) in enumerate(READINGS)]


def misreadings(v: Variant) -> list[Variant]:
    """The student's numbers with the form of each reading."""
    return [{**v, "form": FORMS.index(read(*FORMS[v["form"]]))} for _, read in READINGS]
