"""S1 5.27: the column of the Stanford arm's slide, in the last frame and in the base."""

from typing import Any

import numpy as np

from ..answers import LETTERS, Choice, Numbers
from ..arm import Arm, Array, arm_of
from ..arms.stanford import (
    KINDS,
    ROBOT,
    SLIDE,
    above_zeros,
    drawn,
    in_last_frame,
    to_last_frame,
    with_column,
)
from ..calculations.columns import LATE, TURNING, TURNING_SLIDE, all_turning, late, right, tool_axes
from ..contract.printed_table import printed_table, table_rows
from ..draws import angles, length, until
from ..exercise import Outcome
from ..part import exercise, part

SHOWS = 0.05  # by which a mistake changes a column
TOLERANCE = (
    2e-3  # of the entries of J: three decimals, from rounded transforms and a rounded column
)
WEIGHT = 0.4  # of column 3 in the points for J: what this exercise is about
COLUMN = Numbers((6,), "1", 3)
RIGHT_REASON = 2
REASONS = (
    "The slide passes through the origin of frame 2, so that its lever arm is zero",
    "The lengths cancel at the drawn posture; at other postures they appear",
    "A slide moves all points of the hand alike, so that it does not matter where the point lies",
    "Joint 3 stands in front of the wrist, and only lengths behind the wrist count",
)
REASON_OPTIONS = ("reason 1", "reason 2", "reason 3", "reason 4")  # in the drawn order
UNIT_OPTIONS = (
    "all entries of the linear rows are multiplied by 1000, the angular rows stay",
    (
        "the linear rows of the revolute columns are multiplied by 1000, "
        "column 3 and the angular rows stay"
    ),
    "column 3 is multiplied by 1000, all other columns stay",
    "column 3 is divided by 1000, all other columns stay",
    r"the revolute columns are multiplied by $\pi/180$ in all six rows, column 3 stays",
    r"the revolute columns are multiplied by $180/\pi$ in all six rows, column 3 stays",
)
MILLIMETRES = (
    "every length and linear velocity is given in millimetres, the stroke $q_3$ and its rate too"
)
SLIDE_RATE = "only the rate of joint 3 is given in millimetres per second, and nothing else changes"
DEGREE_RATES = (
    "only the rates of the revolute joints are given in degrees per second; "
    "twists stay in m/s and rad/s"
)
CHANGES = (  # of units, and the letter of what becomes of J
    (MILLIMETRES, "b"),
    (SLIDE_RATE, "d"),
    (DEGREE_RATES, "e"),
)
OTHER_TYPE = "Which formula belongs to a slide? Look again at the type of joint 3."
TURNS = "The angular rows: how fast does the hand turn while only joint 3 slides?"
THIRD = "n, o and a are the columns of the rotation; the formula takes one entry of each."
IN_LAST = "This is in the axes of frame 6; base axes are asked."
IN_BASE = "This is in base axes; the axes of frame 6 are asked."
OTHER_AXIS = "The axis of joint i is z of frame i - 1; this one belongs to another joint."
STROKE = "The stroke itself does not belong there: what moves the hand is the rate of joint 3."
STROKE_IN_3 = f"Column 3: t{STROKE[1:]}"


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A posture in which mistakes show, a change of units, and an order of the reasons."""
    change = int(rng.integers(len(CHANGES)))

    def arm() -> dict[str, Any]:
        v: dict[str, Any] = {"change": change}
        v["d2"] = length(rng, 0.5, 1.0)
        v["d6"] = length(rng, 0.5, 1.0)
        v["q"] = [*angles(rng, 2), length(rng), *angles(rng, 3)]
        return v

    v = until(arm, lambda v: shows_mistakes(arm_of(ROBOT, v)))
    return {**v, "reasons": rng.permutation(len(REASONS)).tolist()}


def shows_mistakes(arm: Arm) -> bool:
    """Whether every known mistake changes column 3."""
    T, stroke = arm.frames, arm.q[SLIDE]
    in_last, in_base = last(T), base(T)
    wrong_last = [in_last * stroke, in_last_frame(T, "R"), above_zeros(to_last_frame(T)), in_base]
    wrong_base = [in_base * stroke, all_turning(T, KINDS)[:, SLIDE], above_zeros(T[SLIDE - 1])]
    changes = np.concatenate([np.array(wrong_last) - in_last, np.array(wrong_base) - in_base])
    return bool((np.abs(changes).max(axis=1) > SHOWS).all())


@part(0, Numbers((7, 4, 4)), asked=False)
def frames(arm: Arm) -> Array:
    """Frames 0 to 6 in the base."""
    return arm.frames


@part(
    2,
    COLUMN,
    shows={"T26": to_last_frame},
    mistakes=(
        (OTHER_TYPE, lambda frames: in_last_frame(frames, "R")),
        (TURNS, lambda last: np.tile(last[:3], 2)),
        (THIRD, lambda frames: above_zeros(to_last_frame(frames))),
        (IN_BASE, lambda arm: arm.J[:, SLIDE]),
        (STROKE, lambda last, q: last * q[SLIDE]),
    ),
)
def last(frames: Array) -> Array:
    r"""Column 3 of $\mathbf J^{6}$ at your $\mathbf q$, in the axes of frame 6: six numbers, linear
    rows first

    - Column 3 takes the pose of frame 6 in frame 2.
    - A slide does not turn the hand.

    Joint 3 slides along $\mathbf z_2$. Its column in the axes of frame 6 comes from
    $\mathbf T_2^{6}$, the product of rows 3 to 6, with the columns
    $\mathbf n, \mathbf o, \mathbf a, \mathbf p$:
    $$\mathbf T_2^{6} = <T26>$$

    It is $(n_z, o_z, a_z, 0, 0, 0)$: the third row of the rotation, which is $\mathbf z_2$ in the
    axes of frame 6, above zeros, since a slide does not turn the hand:
    $$\mathbf J_3^{6} = <last>$$
    """
    return in_last_frame(frames, "P")


@part(
    2,
    COLUMN,
    shows={"closed": lambda arm: arm.closed.J[:, SLIDE]},
    mistakes=(
        (OTHER_TYPE, lambda frames: all_turning(frames, KINDS)[:, SLIDE]),
        (TURNS, lambda base: np.tile(base[:3], 2)),
        (OTHER_AXIS, lambda frames: above_zeros(frames[SLIDE - 1])),
        (IN_LAST, lambda arm: tool_axes(arm.frames, KINDS)[:, SLIDE]),
        (STROKE, lambda base, q: base * q[SLIDE]),
    ),
)
def base(frames: Array) -> Array:
    r"""Column 3 of $\mathbf J^{0}$ at your $\mathbf q$, in base axes: six numbers, linear rows
    first

    - Along which axis does joint 3 slide?

    In base axes the column is $\mathbf z_2$ above zeros, and $\mathbf z_2$ is the third column of
    the rotation in $\mathbf T_0^{2}$:
    $$\mathbf J_3^{0} = <closed>$$

    With your numbers:
    $$\mathbf J_3^{0} = <base>$$
    """
    return above_zeros(frames[SLIDE])


def weighed(value: Array, J: Array) -> Outcome:
    """Column 3 earns its weight as a whole, the others share the rest.

    Zeros and ones earn nothing, but a wrong one voids its column.
    """
    right = np.abs(value - J) <= TOLERANCE
    if right.all():
        return Outcome(right, share=1.0)

    is_zero = np.abs(J) <= TOLERANCE
    is_one = np.abs(np.abs(J) - 1.0) <= TOLERANCE
    earning = ~(is_zero | is_one)
    earned = right & earning & (right | earning).all(axis=0)

    others = [i for i in range(len(KINDS)) if i != SLIDE]
    rest = float(earned[:, others].sum() / earning[:, others].sum())
    column_3 = float(right[:, SLIDE].all())
    return Outcome(right, share=(1 - WEIGHT) * rest + WEIGHT * column_3)


@part(
    4,
    Numbers((6, 6), [["m/rad", "m/rad", "1", "m/rad", "m/rad", "m/rad"]] * 3 + [["1"] * 6] * 3, 3),
    check=weighed,
    tolerance=TOLERANCE,
    shows={"z": lambda frames: frames[:6, :3, 2].T, "o": lambda frames: frames[:, :3, 3].T},
    mistakes=(
        (TURNING, lambda frames: all_turning(frames, KINDS)),
        (TURNING_SLIDE, lambda J, base: with_column(J, np.tile(base[:3], 2))),
        (LATE, lambda frames: late(frames, KINDS)),
        (IN_LAST, lambda arm: tool_axes(arm.frames, KINDS)),
        (STROKE_IN_3, lambda J, base, q: with_column(J, base * q[SLIDE])),
    ),
)
def J(base: Array, frames: Array) -> Array:
    r"""The whole 6 × 6 Jacobian $\mathbf J^{0}$ at your $\mathbf q$, linear rows above angular rows

    - Frames 2 and 3 have the same axes, but not the same origin.
    - The lever arm of every revolute column ends at the origin of frame 6.

    The other joints are revolute: column $i$ is
    $\mathbf z_{i-1} \times (\mathbf o_6 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$. The axes
    $\mathbf z_0 \ldots \mathbf z_5$ as columns:
    $$\left[\mathbf z_0 \cdots \mathbf z_5\right] = <z>$$

    The origins $\mathbf o_0 \ldots \mathbf o_6$ as columns:
    $$\left[\mathbf o_0 \cdots \mathbf o_6\right] = <o>$$

    With column 3 from above:
    $$\mathbf J^{0} = <J>$$
    """
    return with_column(right(frames, KINDS), base)


@part(1, Choice(REASON_OPTIONS), shows={"reason": lambda why: REASON_OPTIONS[LETTERS.index(why)]})
def why(reasons: Array) -> str:
    r"""Which of the four reasons on the sheet says why no length, neither $d_2$ nor $d_6$ nor
    $q_3$, stands in column 3, though lengths stand in the linear rows of columns 1 and 2?

    - Let only joint 3 move, and compare the velocities of two points of the hand.

    It is <reason>. The column of a revolute joint holds $\mathbf z \times \mathbf r$ with the way
    $\mathbf r$ from its axis to the point, and so lengths. A slide gives every point of the hand
    the same velocity $\mathbf z_2$ per unit of its rate: no way $\mathbf r$ stands in it, at any
    posture.
    """
    return LETTERS[[*reasons].index(RIGHT_REASON)]


@part(2, Choice(UNIT_OPTIONS))
def units(change: int) -> str:
    r"""What becomes of $\mathbf J^{0}$ when units change as the sheet says, so that
    $\mathbf J^{0} \dot{\mathbf q}$ is the twist of the same motion in the new units?

    - The motion is the same: which rates and which twist components become other numbers?
    - An entry has the unit of its row over the unit of its rate.

    An entry has the unit of its twist component over that of its rate: m/rad and 1 in a revolute
    column, 1 and 1/m in a prismatic one. Millimetres make the linear rows of the revolute columns
    1000 times as large and leave column 3, mm/s per mm/s. A rate of joint 3 in mm/s is 1000 times
    the number for the same motion, so its column is a thousandth. Rates in degrees per second are
    $180/\pi$ times the numbers in radians, so the revolute columns are $\pi/180$ times as large in
    all rows. Yours is (<units>).
    """
    return CHANGES[change][1]


def statement(reasons: Array, change: int) -> str:
    """The table, the reasons in their drawn order, and the change of units."""
    listed = "\n".join(f"- **reason {i}**: {REASONS[k]}." for i, k in enumerate(reasons, 1))
    return rf"""In the Stanford arm joint 3 is a slide. Its table in the **standard**
Denavit–Hartenberg convention:

{printed_table(table_rows(ROBOT))}

The point whose velocity is meant is the origin of frame 6. $\mathbf J^{{0}}$ is its Jacobian in
base axes (frame 0), $\mathbf J^{{6}}$ that of the same point in the axes of frame 6. In both the
linear rows stand above the angular ones.

Why does column 3 hold no lengths? One of these reasons is right:

{listed}

For the question about units: **{CHANGES[change][0]}**."""


EXERCISE = exercise(
    "prismatic_columns",
    title="The column of a prismatic joint",
    source="S1 5.10, eq. 5.27",
    minutes=40,
    objectives=(
        "Write down the column of a prismatic joint in the last frame and in the base.",
        "Tell which entries of a Jacobian hold lengths, and in which units they are.",
    ),
    robot=ROBOT,
    hidden=("change", "reasons"),  # the statement has both in words
    draw=draw,
    statement=statement,
    drawings=drawn,
    parts=(frames, last, base, J, why, units),
)
