"""S1 5.10, Example 2.25: the linear rows of a Jacobian, by differentiating the hand's position.

S1 prints the position and the first row for an arm on the floor. Here the mounting, the zeros of
joints 1 and 2 and the sense of joints 2 to 4 are drawn, and the shoulder stands beside axis 1, so
that none of those rows is the answer.
"""

from typing import Any

import numpy as np

from ...solutions.expression_array import ExpressionArray
from ..answers import Choice, Formulas, Numbers
from ..arm import Arm, Array
from ..arms.articulated import (
    LENGTHS,
    NAMES,
    S1,
    SLIPS,
    STRUCTURES,
    derivatives,
    described,
    drawn,
    factored,
    posture,
    robot,
)
from ..contract.question import Question, Wrong
from ..part import exercise, part
from ..properties import without_zeros


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one structure, and a point for the last question."""
    structure = int(rng.integers(len(STRUCTURES)))
    point = int(rng.integers(len(POINTS)))
    away = [int(rng.integers(11, 30)), int(rng.integers(3, 9))]
    return {"structure": structure, "point": point, "away": away, **posture(rng, structure)}


def statement(arm: Arm, structure: int, point: int, away: Array) -> str:
    """The arm and the position of its hand, and where the point of the last question lies."""
    far, near = away
    return rf"""{described(arm, structure)} The linear rows $\mathbf J_v$ of its Jacobian,
$\dot{{\mathbf p}} = \mathbf J_v \dot{{\mathbf q}}$, are its derivatives: the entry in row $x$ and
column $j$ is the derivative of $p_x$ with respect to $q_j$. Start from $\mathbf p$ as it is printed
here; how the arm is mounted and where its joints are zero is personal.

For the last question: {POINTS[point].format(far=far, near=near)}."""


ON_SLIDES = (
    "This is the row of the arm on the slides, which stands otherwise; "
    "start from p as your sheet prints it."
)
WRITTEN = (
    "with a * in every product and angles in radians, such as `a2*C2 + a3*C23`; "
    "C23 and S234 are read as on the sheet"
)
HOW_WRITTEN = (WRITTEN, "written as in row 1", "written as in row 1")


def row(i: int) -> Question:
    """The question for row i."""
    x = "xyz"[i]

    def solve(arm: Arm) -> ExpressionArray:
        return derivatives(arm.robot, i)

    solve.__doc__ = rf"""Row {i + 1} of $\mathbf J_v$: the derivatives of $p_{x}$ with respect to
    $q_1, \ldots, q_6$, a list of six formulas as texts in d1, a1, a2, a3, a4 and q1 to q6,
    {HOW_WRITTEN[i]}

    - All other joint variables are constants while you differentiate by one of them.
    - Write down first which terms of the coordinate hold that joint variable.

    Row {i + 1} holds the derivatives of $p_{x}$. An angle such as $q_2 + q_3 + q_4$ changes with
    each of its joints, so $q_2$ moves the links $a_2, a_3, a_4$, $q_3$ the links $a_3, a_4$ and
    $q_4$ the link $a_4$; the derivative of a cosine is minus the sine, that of a sine the cosine.
    $$p_{x} = <p>$$

    The columns are the derivatives by $q_1 \ldots q_6$. Where $q_j$ does not stand in the formula,
    the entry is zero:
    $$\mathbf J_{{{i + 1}}} = <row>$$
    """
    return part(
        2,
        Formulas((6,), NAMES),
        check=lambda value, arm: without_zeros(value, derivatives(arm.robot, i), NAMES),
        shows={
            "p": lambda arm: factored(arm.closed.T[i, 3]),
            "row": lambda arm: arm.closed.J[i, :].applyfunc(factored),
        },
        mistakes=(*slips(i), (ON_SLIDES, lambda: derivatives(S1, i))),
    )(solve).called(x)


def slips(i: int) -> list[Wrong]:
    """Row i in each of the wrong ways."""
    return [(said, lambda arm, *, way=way: derivatives(arm.robot, i, way)) for said, way in SLIPS]


SUMS = (
    "Which angle does the index 234 stand for? Look again at the letters that the sheet explains."
)


def with_single_angles(
    arm: Arm, x: ExpressionArray, y: ExpressionArray, z: ExpressionArray
) -> Array:
    """q3 taken for q2 + q3, and q4 for q2 + q3 + q4."""
    q1, q2, q3, q4, q5, q6 = arm.q
    return J(arm.at([q1, q2, q3 - q2, q4 - q3, q5, q6]), x, y, z)


@part(
    3,
    Numbers((3, 6), "m/rad", 3),
    mistakes=((SUMS, with_single_angles),),
)
def J(arm: Arm, x: ExpressionArray, y: ExpressionArray, z: ExpressionArray) -> Array:
    r"""The linear block $\mathbf J_v$ at your $\mathbf q$ and with your lengths, a 3 × 6 matrix
    with the rows $x, y, z$ of the base frame

    - C23 takes the sum of two of your angles, in radians.

    The three rows with your numbers, the angles added before a sine or cosine is taken:
    $$\mathbf J_v = <J>$$
    """
    values = {**arm.lengths, **dict(zip(arm.robot.joints, arm.q, strict=True))}
    return np.stack([x.at(values), y.at(values), z.at(values)])


POINTS = (
    r"$Q$ is a point of the gripper. Seen from $\mathbf p$ it lies 0.{far} m along axis 6",
    (
        r"$Q$ is a point of the gripper. Seen from $\mathbf p$ it lies 0.{far} m along axis 6 "
        r"and 0.0{near} m beside that axis"
    ),
    "$Q$ is a point of the link between joints 4 and 5, 0.{far} m away from axis 5",
)
REASONS = (
    (
        "Turning about axis 6 leaves a point on axis 6 where it is, but axis 5 crosses axis 6 in p "
        "and not in Q: joint 5 moves Q. Only column 6 is zero."
    ),
    "Q lies on neither axis and belongs to the gripper, so both joints move it.",
    (
        "Joints 5 and 6 come behind that link: whatever they do, it stays where it is. "
        "Both columns are zero."
    ),
)
OPTIONS = (
    "both are zero: joints of the wrist turn the hand and move no point of it",
    "both are zero: neither joint moves the link that Q belongs to",
    "column 5 is not zero, column 6 is zero: Q lies on axis 6, but not on axis 5",
    "column 5 is zero, column 6 is not zero: Q lies on axis 5, but not on axis 6",
    "neither is zero: Q lies on neither axis, and both joints carry it along",
)


@part(2, Choice(OPTIONS), shows={"reason": lambda v: REASONS[v["point"]]})
def point(point: int) -> str:
    r"""For $\mathbf p$ the columns 5 and 6 of $\mathbf J_v$ are zero. Which statement about columns
    5 and 6 of the linear rows is right for the point $Q$, in a general posture?

    - A point on a joint's axis does not move when that joint turns.
    - Which links does a joint carry along?

    Column $i$ of the linear rows is $\mathbf z_{i-1} \times (\mathbf p - \mathbf o_{i-1})$: it is
    zero for a point on the axis of joint $i$, and for every point of the links in front of that
    joint. $\mathbf p$ lies on axes 5 and 6, which cross there, so both its columns are zero.
    <reason>
    """
    return "ceb"[point]


EXERCISE = exercise(
    "articulated_derivatives",
    title="The Jacobian of an articulated arm by differentiation",
    source="S1 5.10",
    minutes=40,
    objectives=(
        "Differentiate the position of the hand with respect to every joint variable.",
        "Tell from the axes of an arm which entries of its Jacobian are zero.",
    ),
    robot=robot,
    robot_map="articulated_6r",
    units={**dict.fromkeys(LENGTHS, "m"), "q": ["rad"] * 6},
    structure=("structure",),
    hidden=("point", "away"),  # the statement says in words where the point lies
    draw=draw,
    statement=statement,
    drawings=drawn,
    parts=(row(0), row(1), row(2), J, point),
)
