"""The planar arm of S2 in all its forms, with those for which it may be mistaken.

Forms are those of planar_formulas.py. A sheet draws one of the first nine; the others are only
misread.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from ...solutions.chain import elementary
from ...solutions.robot import Robot
from ..answers import Variant
from ..arm import Arm, Array, arm_of
from ..calculations.columns import columns
from ..contract.question import Wrong
from ..drawing import Drawing
from ..draws import CLEARANCE, angles, length, until
from ..exercise import Outcome
from .planar_formulas import (  # noqa: F401 - all of them are known from here
    ANGLES,
    FORMS,
    NAMES,
    SOURCE,
    angle_formulas,
    bend_formula,
    pose,
    pose_formulas,
    slopes,
)

DRAWN = 9
BENT = 0.3  # smallest |sin| of q2 and of the angle between the links
FLIP = {1: ("Rx", "0"), -1: ("Rx", "pi")}  # of z of a joint, by its sense
UP = np.array([0.0, 0.0, 1.0])
NEAR = 2e-3  # how far rounded numbers may be from a known mistake that is followed or paid less
OMEGA = 0.2  # share of the points that a wrong angular entry costs where the linear rows are right


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of nine forms, bent, with no link near an axis of frame 0."""
    form = int(rng.integers(DRAWN))
    l1, l2 = until(lambda: (length(rng), length(rng)), are_different)

    def posture() -> dict[str, Any]:
        beta, *q = angles(rng, 3)
        return {"form": form, "l1": l1, "l2": l2, "beta": beta, "q": q}

    return until(posture, is_clear)


def are_different(lengths: tuple[float, float]) -> bool:
    """Whether one link cannot be taken for the other."""
    return abs(lengths[0] - lengths[1]) > 0.05


def is_clear(v: Variant) -> bool:
    """Whether the arm is bent, and no angle of a link near a right one."""
    first, second = link_angles(v)
    bends = np.sin([v["q"][1], second - first])
    past = np.degrees([first, second, sum(v["q"])]) % 90
    is_bent = (np.abs(bends) > BENT).all()
    is_oblique = (np.abs(past - 45) <= 45 - CLEARANCE).all()
    return bool(is_bent and is_oblique)


@lru_cache
def robot(form: int) -> Robot:
    """The arm, with z of each joint in its positive sense."""
    one, two, quarter = FORMS[form]
    flip1, flip2 = FLIP[one], FLIP[two]
    return Robot(
        name="planar_2r",
        title="Planar arm",
        parameters={"l1": 1.0, "l2": 0.7, "beta": 0.0},
        rows=(
            (flip1, ("Rz", "q1")),
            (flip1, ("Tx", "l1"), ("Rz", f"{quarter}*pi/2"), flip2, ("Rz", "q2")),
        ),
        limits=((-np.pi, np.pi), (-np.pi, np.pi)),
        source="S2",
        convention="frames",
        base=(("Rz", "beta"),),
        tool=(flip2, ("Tx", "l2")),
    )


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
    """The same with the factors of the second exchanged."""
    elbow, hand = links(v)
    return np.array([elbow, hand @ elbow])


def levers(T: Array) -> Array:
    """From each joint to the tool point, (2, 3)."""
    elbow, tip = T[:, :3, 3]
    return np.array([tip, tip - elbow])


def levers_to_elbow(T: Array) -> Array:
    """The same, but that of joint 1 ends at joint 2."""
    elbow, tip = T[:, :3, 3]
    return np.array([elbow, tip - elbow])


def jacobian(v: Variant) -> Array:
    """The Jacobian (6, 2) of an arm of any form."""
    arm = arm_of(robot(v["form"]), v)
    return columns(arm.axes.T, levers(transforms(v)), "RR")


ALONE = "Link 2 seems to be at the angle of joint 2 alone; joint 1 turns it too."
EXCHANGED = "Sine and cosine are exchanged: which of them belongs to x?"
MINUS = "The derivative of the cosine is the sine with a minus sign; look again at the row of x."
CHAIN_RULE = (
    "A factor of the chain rule seems to be missing: "
    "the derivative of each angle with respect to q1 or q2."
)
LINK_2 = "A term of column 1 is missing: joint 1 moves link 2 as well."
FROM_1 = "The second transform seems to start at frame 1; both shall start at frame 0."
ORDER = "The two transforms seem to be multiplied in the wrong order."
FROM_BASE = "The lever arm of column 2 seems to start at the base; it starts at joint 2."
TO_JOINT_2 = "The lever arm of column 1 seems to end at joint 2; it ends at the tool point."
OMEGA_SENSE = (
    "Both angular columns seem to turn counter-clockwise; look again at the positive senses."
)
MOUNTING = (
    "The angle beta of the mounting does not seem to be in it; where does link 1 point at q1 = 0?"
)
SENSE = "Each joint's angle seems to count counter-clockwise; look again at the positive senses."
SENSE_1 = (
    "The angle of joint 1 seems to be counted the other way; look again at its positive sense."
)
SENSE_2 = (
    "The angle of joint 2 seems to be counted the other way; look again at its positive sense."
)
AT_ZERO = "Look again at how link 2 stands to link 1 where q2 = 0."
PRINTED = (
    "This looks like an arm whose joints both count counter-clockwise and whose links are in line "
    "at q2 = 0; look again at the positive senses and at where q2 is zero."
)
OTHER_QUARTERS = {0: (1, -1), 1: (0, -1), -1: (0, 1)}  # how else link 2 may stand where q2 = 0
READINGS: tuple[tuple[str, Callable[[int, int, int], tuple[int, int, int]]], ...] = (
    (SENSE, lambda _, __, quarter: (1, 1, quarter)),
    (SENSE_1, lambda one, two, quarter: (-one, two, quarter)),
    (SENSE_2, lambda one, two, quarter: (one, -two, quarter)),
    (AT_ZERO, lambda one, two, quarter: (one, two, OTHER_QUARTERS[quarter][0])),
    (AT_ZERO, lambda one, two, quarter: (one, two, OTHER_QUARTERS[quarter][1])),
    (PRINTED, lambda _, __, ___: (1, 1, 0)),
)  # of the arm by somebody who overlooks what makes it another than the source's


def misread(solve: Callable[[Variant], Any]) -> list[Wrong]:
    """The readings as mistakes of a part that `solve` answers for an arm of any form."""
    found: list[Wrong] = []
    for i, (sentence, _) in enumerate(READINGS):
        found.append((sentence, lambda v, *, i=i: solve(misreadings(v)[i])))
    return found


def misreadings(v: Variant) -> list[Variant]:
    """The student's numbers with the form of each reading."""
    form = FORMS[v["form"]]
    return [{**v, "form": FORMS.index(read(*form))} for _, read in READINGS]


def judged_transforms(value: Array, v: Variant) -> Outcome:
    """A product in the wrong order, whose rotation is right by chance, earns nothing for it."""
    if is_near(value, wrong_order(v)):
        return Outcome(share=0.5)
    return Outcome()


def less_omega(right: Array) -> Outcome:
    """Wrong angular entries, a sign each, cost a share, but not the linear rows above them.

    `right` (3, 2) says which entries of the rows x, y, theta are right.
    """
    wrong = int((~right[2]).sum())
    if wrong and right[:2].all():
        return Outcome(share=1 - OMEGA * wrong)
    return Outcome()


def same_reading(value: Array, v: Variant, T: Array, J: Array) -> Outcome:
    """A misread arm is followed from its transforms on; linear rows over wrong angles are paid."""
    for other in misreadings(v):
        if is_near(T, transforms(other)) and is_near(value, jacobian(other)):
            return Outcome(right=np.ones((6, 2), dtype=bool))
    right = np.abs(value - J) <= NEAR
    if not right[2:5].all():
        return Outcome()
    return less_omega(right[[0, 1, 5]])


def is_near(value: Array, other: Array) -> bool:
    """Whether rounded numbers may be these."""
    return bool(np.abs(value - other).max() <= NEAR)


def described(form: int) -> str:
    """What a sheet says of the arm, of its frames and of its pose."""
    one, two, quarter = FORMS[form]
    way = {1: "counter-clockwise", -1: "clockwise"}
    at_zero = "link 2 points the way link 1 points"
    if quarter:
        at_zero = (
            f"link 2 stands at a right angle to link 1, 90° {way[quarter]} "
            "from the way link 1 points"
        )
    return rf"""Two links of lengths $l_1$ and $l_2$ move in the plane of $\mathbf x_0$ and
$\mathbf y_0$. Frame 0 is fixed, its origin is on the axis of joint 1, and $\mathbf z_0$ points
towards you. All turns are named as you see them from there.

- The arm is mounted at an angle: where $q_1 = 0$, link 1 points in the direction that $\mathbf x_0$
  takes when it is turned by $\beta$ counter-clockwise (clockwise if $\beta$ is negative).
- Positive $q_1$ turns link 1 **{way[one]}**.
- Positive $q_2$ turns link 2 **{way[two]}** against link 1; where $q_2 = 0$, {at_zero}.

Frame 1 has its origin on the axis of joint 2, frame 2 at the tool point at the end of link 2.
$\mathbf x_1$ points along link 1 and $\mathbf x_2$ along link 2, away from the base; $\mathbf z_1$
and $\mathbf z_2$ are parallel to $\mathbf z_0$. $x$ and $y$ are the coordinates of the tool point
in frame 0, and $\theta$ is the angle from $\mathbf x_0$ to $\mathbf x_2$, counter-clockwise
positive."""


def drawn(arm: Arm) -> list[Drawing]:
    """The arm at home with its lengths, and at the student's q."""
    home = arm.at([0.0, 0.0])
    foot, knee = home.origins.T
    lines = {"l1": (foot, knee), "l2": (knee, home.p)}
    said = (
        "Home pose, q1 = q2 = 0, mounted at the angle beta, with the positive sense of each joint."
    )
    alt = (
        "Planar arm with two links and two revolute joints, seen along their axes; "
        "a dashed line shows where each angle is zero. "
    )
    now = "The same arm at your q."
    return [
        home.drawing(said, alt + said, tool="", lengths=lines),
        arm.drawing(now, alt + now, tool=""),
    ]
