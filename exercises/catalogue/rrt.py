"""S3 5.4.1: an RRT robot from its drawing: table, transforms, Jacobian, singular postures.

Structure and numbers are drawn: the sense of the axes, and which of the offsets a1, d2 and l3 the
arm has. The drawing gives base frame, tool frame, positive senses and home pose. Without joint
offsets the table is unique; every other table of the same arm is right, too.
"""

from typing import Any

import numpy as np

from ...solutions.expression import Expression, parse
from ...solutions.expression_array import ExpressionArray
from ...solutions.table import Table
from ..answers import Conditions, Formulas, Numbers, TableOf, Variant
from ..arm import Arm, Array, arm_of
from ..arms.rrt import FORMS, LENGTHS, NAMES, drawings, reach, robot
from ..calculations.columns import (
    LATE,
    OWN_LINK,
    TURNING_SLIDE,
    closed,
    late,
    own_link,
    right,
    turning_slide,
)
from ..calculations.own_formulas import (
    closed_determinant,
    closed_factors,
    determinant_of,
    factors_of,
    jacobian_of_table,
)
from ..draws import angles, length, until
from ..part import exercise, part
from ..properties import named_multiple

# Of the singular postures that are asked [rad, m].
LIMITS = {"q1": (-np.pi, np.pi), "q2": (-np.pi, np.pi), "q3": (-1.5, 1.5)}

STATEMENT = r"""The robot turns about the vertical axis 1 and the horizontal axis 2, and slides
along axis 3 (RRT). The first figure shows it in its home pose, $q_1 = q_2 = 0$, with frame 0, the
lengths, the tool frame and the positive sense of each joint; the second shows it at your
$\mathbf q$.

Use the **standard** Denavit–Hartenberg convention: $\mathbf z_{i-1}$ along the axis of joint $i$ in
its positive sense, joint $i$ between frames $i-1$ and $i$. Place the frames so that
$\theta_1 = q_1$, $\theta_2 = q_2$ and $\theta_3 = 0$, without joint offsets, and so that frame 3 is
the tool frame that is drawn. With that the table is unique. Another table of the same arm, with
base frame, tool frame, positive senses and home pose as drawn, is right, too."""

LINKS = "These lead from each frame to the next; all three shall start at the fixed frame."
HOME_POSE = (
    "This would be right if q2 were measured from another zero; look at the home pose again."
)
ELEVATION = {"q2": parse("pi/2 - q2", ["q2"])}  # q2 measured from the horizontal
ON_AXIS_1 = "on axis 1, which then cannot move it"
BESIDE = (
    "beside axis 1, off it by $d_2$ along axis 2: even so, joint 1 moves it only in the plane of "
    "joints 2 and 3"
)
SIDES = {"-pi/2": "left", "pi/2": "right"}  # of z_0, to which axis 2 points, by alpha_1


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 14 forms, away from its singular postures."""
    form = int(rng.integers(len(FORMS)))

    def drawn() -> dict[str, Any]:
        v: dict[str, Any] = {"form": form, "d1": length(rng)}
        for name in FORMS[form][1]:
            v[name] = length(rng, 0.2, 0.5)
        v["q"] = [*angles(rng, 2), length(rng)]
        return v

    return until(drawn, lambda v: reach(arm_of(robot(form), v)) > 0.2)


@part(
    3,
    TableOf(LENGTHS, "RRP"),
    shows={"side": lambda form: SIDES[FORMS[form][0]]},
)
def dh(arm: Arm) -> Table:
    r"""The DH table: one row $[\theta_i, d_i, a_i, \alpha_i]$ per joint, as text in the names of
    your lengths and q1, q2, q3, for instance `['q1 + pi', 0.25, 'd1', 'pi/3']`, or as numbers at
    your $\mathbf q$ (radians, metres)

    - Which way does the positive arrow of joint 2 make its axis point?
    - A prismatic joint's variable stands in the column d.

    $\mathbf z_{i-1}$ lies along the axis of joint $i$, in its positive sense. $\mathbf x_i$ is
    perpendicular to $\mathbf z_{i-1}$ and $\mathbf z_i$; without joint offsets it is parallel to
    $\mathbf x_{i-1}$ at the zero of joint $i$. Then $d_i$ and $\theta_i$ are measured along and
    about $\mathbf z_{i-1}$, $a_i$ and $\alpha_i$ along and about $\mathbf x_i$. Seen along
    $\mathbf x_1$, axis 2 points to the <side> of $\mathbf z_0$, which gives the sign of $\alpha_1$;
    $\alpha_2$ turns back. The columns are $\theta_i, d_i, a_i, \alpha_i$:
    $$\mathrm{DH} = <dh>$$
    """
    return arm.robot.table


def with_base(T: Array) -> Array:
    """The frames with frame 0 in front of them, (n + 1, 4, 4)."""
    return np.insert(T, 0, np.eye(4), 0)


@part(
    3,
    Numbers((3, 4, 4), [[["1", "1", "1", "m"]] * 3 + [["1"] * 4]], 3),
    shows={
        "T1": lambda arm: arm.closed.frames[1],
        "T2": lambda arm: arm.closed.frames[2],
        "T3": lambda arm: arm.closed.frames[3],
    },
    mistakes=[(LINKS, lambda T: np.linalg.inv(with_base(T)[:3]) @ T)],
)
def T(arm: Arm, dh: Table) -> Array:
    r"""The transforms from the fixed frame to each frame,
    $\mathbf T_0^1, \mathbf T_0^2, \mathbf T_0^3$ at your $\mathbf q$, stacked to an array 3 × 4 × 4

    - Multiply from the left to the right: T01, then T01 @ T12, then the last.

    Each row gives $\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$, and
    $\mathbf T_0^i = \mathbf T_0^1 \cdots \mathbf T_{i-1}^{i}$. In closed form:
    $$\mathbf T_0^1 = <T1>$$

    $$\mathbf T_0^2 = <T2>$$

    $$\mathbf T_0^3 = <T3>$$

    With your numbers:
    $$\mathbf T_0^1,\; \mathbf T_0^2,\; \mathbf T_0^3 = <T>$$
    """
    return dh.frames(arm.lengths, arm.q)[1:]


@part(
    4,
    Numbers((6, 3), [["m/rad", "m/rad", "1"]] * 3 + [["1"] * 3] * 3, 3),
    shows={"closed": lambda arm: arm.closed.J},
    mistakes=[(LATE, lambda T, dh: late(with_base(T), dh.kinds))],
)
def J(T: Array, dh: Table) -> Array:
    r"""The 6 × 3 Jacobian $\mathbf J$ of the tool point in the base frame at your $\mathbf q$,
    linear rows above angular rows

    - What does a prismatic joint contribute to the angular velocity?
    - The axis of joint i is the z axis of frame i - 1.

    Joints 1 and 2 are revolute: column $i$ is
    $\mathbf z_{i-1} \times (\mathbf o_3 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$. Joint 3 is
    prismatic: its column is $\mathbf z_2$ above zeros. (The index is $i-1$ in both places: in the
    standard convention $\mathbf z_{i-1}$ is the axis of joint $i$.)
    $$\mathbf J = <closed>$$

    With your numbers:
    $$\mathbf J = <J>$$
    """
    return right(with_base(T), dh.kinds)


@part(
    4,
    Formulas((6, 3), NAMES),
    follow=0.5,  # formulas of one fixed form can be shared; numbers cannot
    shows={"hand": lambda arm: arm.closed.T[:3, 3], "closed": lambda arm: arm.closed.J},
    mistakes=[
        (TURNING_SLIDE, lambda arm: closed(arm.robot, turning_slide)),
        (LATE, lambda arm: closed(arm.robot, late)),
        (OWN_LINK, lambda arm: closed(arm.robot, own_link)),
    ],
)
def J_symbolic(arm: Arm, dh: Table) -> ExpressionArray:
    r"""The same 6 × 3 Jacobian $\mathbf J$ (tool point, base frame, linear rows above angular rows)
    for any $\mathbf q$: formulas in the names of your lengths and q1, q2, q3, as six rows of three
    texts

    - The linear rows are also the derivatives of the tool point's coordinates.
    - Put in your numbers and compare with the Jacobian above.

    The tool point in closed form is the last column of $\mathbf T_0^3$:
    $$\mathbf o_3 = <hand>$$

    The linear rows are its derivatives with respect to $q_1, q_2, q_3$, which is the same as
    $\mathbf z_{i-1} \times (\mathbf o_3 - \mathbf o_{i-1})$ and $\mathbf z_2$. The angular rows are
    $\mathbf z_0$, $\mathbf z_1$ and zeros:
    $$\mathbf J = <closed>$$
    """
    return jacobian_of_table(dh, arm.robot)


def from_horizontal(arm: Arm) -> Expression:
    """The determinant where q2 is measured from the horizontal, which turns column 2 about, too."""
    det = closed_determinant(arm.robot).entries[0].put(ELEVATION)
    return parse("-det", ["det"]).put({"det": det})


def factors_from_horizontal(arm: Arm) -> list[Expression]:
    """The factors of the determinant there."""
    return [factor.put(ELEVATION) for factor in closed_factors(arm.robot)]


def second_case(v: Variant) -> str:
    """Where the hand lies in the second singular posture."""
    if "d2" in v:
        return BESIDE
    return ON_AXIS_1


@part(
    2,
    Formulas((), NAMES),
    follow=0.5,
    check=lambda arm, det, value: named_multiple(value, det, arm.robot.names),
    mistakes=[(HOME_POSE, from_horizontal)],
)
def det(arm: Arm, J_symbolic: ExpressionArray) -> ExpressionArray:
    r"""The determinant of the linear block $\mathbf J_v$ (rows 1 to 3 of $\mathbf J$), with its
    sign, as one formula in the names of your lengths and q1, q2, q3

    - Expand along the row that holds a zero.
    - It does not depend on q1, so you may compute it for the q1 that makes it easy.

    Expand $\det \mathbf J_v$ along its third row, whose first entry is zero, and use
    $\sin^{2} q_1 + \cos^{2} q_1 = 1$ and $\sin^{2} q_2 + \cos^{2} q_2 = 1$. It does not depend on
    $q_1$, since turning the whole arm about axis 1 changes no lengths:
    $$\det \mathbf J_v = <det>$$
    """
    return determinant_of(J_symbolic, arm.robot)


@part(
    3,
    Conditions(NAMES, lambda _: LIMITS),
    follow=0.5,
    shows={"second": second_case},
    mistakes=[(HOME_POSE, factors_from_horizontal)],
)
def singular(arm: Arm, det: ExpressionArray) -> tuple[Expression, ...]:
    r"""All postures in which the linear block $\mathbf J_v$ is singular: a list of conditions in
    the names of your lengths and q1, q2, q3, each as text such as `'cos(q1) = 0'` or
    `'d1 + q3*q2 = 0'`; a posture is singular when one of them holds. Count postures with $q_1$ and
    $q_2$ from $-\pi$ to $\pi$ and $q_3$ from −1.5 m to 1.5 m, the slide running through to the
    other side

    - Where is the determinant zero? Take its factors one by one.
    - In such a posture the hand cannot move in one direction: which one, for each of your
      conditions?

    A product is zero where one of its factors is:
    $$<singular>$$

    In the first case the hand lies on axis 2, which then cannot move it; in the second it lies
    <second>.
    """
    return factors_of(det, arm.robot)


EXERCISE = exercise(
    "rrt",
    title="Jacobian of an RRT robot",
    source="S3 5.4.1",
    minutes=75,
    objectives=(
        "Read a Denavit–Hartenberg table off a drawing.",
        "Build the Jacobian of an arm with a prismatic joint from its frames.",
        "Find the postures in which an arm is singular from a determinant.",
    ),
    robot=robot,
    robot_map="rrt_offset",
    units={**dict.fromkeys(LENGTHS, "m"), "q": ["rad", "rad", "m"]},
    structure=("form",),
    draw=draw,
    statement=STATEMENT,
    drawings=drawings,
    parts=(dh, T, J, J_symbolic, det, singular),
)
