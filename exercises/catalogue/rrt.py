"""S3 5.4.1: an RRT robot from its drawing: Denavit-Hartenberg table, transforms, Jacobian, singular postures.

Structure and numbers are drawn: the sense of the axes, and which of the offsets a1, d2 and l3 the arm has. The drawing
gives base frame, positive senses and home pose, and the sheet asks for joint variables without offsets, so that the
table is unique.
"""

import numpy as np
from numpy.typing import NDArray

from ...solutions.expression import Expression, parse
from ...solutions.expression_array import ExpressionArray, same_formulas
from ...solutions.table import Table
from ..exercise import (
    Conditions,
    Exercise,
    Formulas,
    Given,
    Mistake,
    Numbers,
    Outcome,
    Part,
    Step,
    TableOf,
    Variant,
)
from ..properties import proportional
from .rrt_arm import FORMS, LENGTHS, draw, drawings, lengths, robot_of
from .rrt_formulas import (
    columns_of_frames,
    determinant_by_elevation,
    determinant_formula,
    determinant_of,
    jacobian_of_table,
    singular_conditions,
    turning_slide,
)

Array = NDArray[np.float64]
KINDS = "RRP"
NAMES = (*LENGTHS, "q1", "q2", "q3")
LIMITS = {  # of the singular postures asked [rad, m]
    "q1": (-np.pi, np.pi),
    "q2": (-np.pi, np.pi),
    "q3": (-1.5, 1.5),
}


def table(v: Variant, _: Given) -> Table:
    return robot_of(v).table


def transforms(v: Variant, given: Given) -> Array:
    return given["rrt_dh"].frames(lengths(v), v["q"])[1:]


def jacobian_of(_: Variant, given: Given) -> Array:
    """Columns from the frames alone: z and o of frame i - 1 for joint i."""
    poses = np.concatenate([np.eye(4)[None], given["rrt_T"]])
    J = np.zeros((6, 3))
    for i, kind in enumerate(given["rrt_dh"].kinds):
        z, o = poses[i, :3, 2], poses[i, :3, 3]
        if kind == "R":
            J[:3, i], J[3:, i] = np.cross(z, poses[-1, :3, 3] - o), z
        else:
            J[:3, i] = z
    return J


def one_frame_late(_: Variant, given: Given) -> Array:
    """Columns from frame i in place of frame i - 1."""
    poses: Array = given["rrt_T"]
    revolute = np.array([kind == "R" for kind in given["rrt_dh"].kinds])
    z, o = poses[:, :3, 2], poses[:, :3, 3]
    turned = np.concatenate([np.cross(z, o[-1] - o).T, z.T])
    return np.where(revolute, turned, np.concatenate([z.T, np.zeros((3, 3))]))


def link_transforms(v: Variant, given: Given) -> Array:
    """From each frame to the next, in place of from the fixed frame."""
    poses: Array = given["rrt_dh"].frames(lengths(v), v["q"])
    return np.linalg.inv(poses[:-1]) @ poses[1:]


def jacobian_in_formulas(v: Variant, given: Given) -> ExpressionArray:
    return jacobian_of_table(given["rrt_dh"], robot_of(v))


def determinant(v: Variant, given: Given) -> ExpressionArray:
    return determinant_of(given["rrt_J_symbolic"], robot_of(v))


def named_multiple(v: Variant, given: Given, value: ExpressionArray) -> Outcome:
    """Names a determinant that lacks a constant factor; right and wrong stay with the comparison."""
    arm, wanted = robot_of(v), determinant(v, given)
    if proportional(value, wanted, arm.names) and not same_formulas(value, wanted, arm.names).all():
        return Outcome(
            finding="It is the determinant times a constant: it is zero in the right postures, but the determinant "
            "itself is asked."
        )
    return Outcome()


def singular(v: Variant, given: Given) -> tuple[Expression, ...]:
    """The factors of the arm's own determinant; any other determinant as it is."""
    arm, own = robot_of(v), given["rrt_det"]
    if same_formulas(own, determinant_formula(arm), arm.names).all():
        return tuple(parse(text, arm.names) for text in singular_conditions(arm))
    return own.entries


def singular_by_elevation(v: Variant, _: Given) -> tuple[Expression, ...]:
    arm = robot_of(v)
    return tuple(parse(text, arm.names) for text in singular_conditions(arm, "cos(q2)"))


def explain_table(v: Variant, given: Given) -> list[Step]:
    import sympy  # pyright: ignore[reportMissingTypeStubs]

    cells = sympy.Matrix([[cell.sympy() for cell in row] for row in given["rrt_dh"].rows])
    sense = "left" if FORMS[v["form"]][0] < 0 else "right"
    return [
        Step(
            r"$\mathbf z_{i-1}$ lies along the axis of joint $i$, in its positive sense. $\mathbf x_i$ is perpendicular to "
            r"$\mathbf z_{i-1}$ and $\mathbf z_i$; without joint offsets it is parallel to $\mathbf x_{i-1}$ at the zero "
            r"of joint $i$. Then $d_i$ and $\theta_i$ are measured along and about $\mathbf z_{i-1}$, $a_i$ and "
            rf"$\alpha_i$ along and about $\mathbf x_i$. Seen along $\mathbf x_1$, axis 2 points to the {sense} of "
            r"$\mathbf z_0$, which gives the sign of $\alpha_1$; $\alpha_2$ turns back. The columns are "
            r"$\theta_i, d_i, a_i, \alpha_i$:",
            r"\mathrm{DH}",
            cells,
        )
    ]


def explain_transforms(v: Variant, given: Given) -> list[Step]:
    closed = robot_of(v).symbolic()
    general = (
        r"Each row gives $\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$, and "
        r"$\mathbf T_0^i = \mathbf T_0^1 \cdots \mathbf T_{i-1}^{i}$. In closed form:"
    )
    steps = [Step(general if i == 1 else "", rf"\mathbf T_0^{i}", closed.frames[i]) for i in (1, 2, 3)]
    return [
        *steps,
        *(
            Step("With your numbers:" if i == 1 else "", rf"\mathbf T_0^{i}", numbers=given["rrt_T"][i - 1])
            for i in (1, 2, 3)
        ),
    ]


def explain_jacobian(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Joints 1 and 2 are revolute: column $i$ is $\mathbf z_{i-1} \times (\mathbf o_3 - \mathbf o_{i-1})$ above "
            r"$\mathbf z_{i-1}$. Joint 3 is prismatic: its column is $\mathbf z_2$ above zeros. "
            r"(The index is $i-1$ in both places: in the standard convention $\mathbf z_{i-1}$ is the axis of joint $i$.)",
            r"\mathbf J",
            robot_of(v).symbolic().J,
        ),
        Step("With your numbers:", r"\mathbf J", numbers=given["rrt_J"]),
    ]


def explain_jacobian_formulas(v: Variant, _: Given) -> list[Step]:
    closed = robot_of(v).symbolic()
    return [
        Step(
            r"The tool point in closed form is the last column of $\mathbf T_0^3$:",
            r"\mathbf o_3",
            closed.T[:3, 3],
        ),
        Step(
            r"The linear rows are its derivatives with respect to $q_1, q_2, q_3$, which is the same as "
            r"$\mathbf z_{i-1} \times (\mathbf o_3 - \mathbf o_{i-1})$ and $\mathbf z_2$. The angular rows are $\mathbf z_0$, "
            r"$\mathbf z_1$ and zeros:",
            r"\mathbf J",
            closed.J,
        ),
    ]


def explain_determinant(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Expand $\det \mathbf J_v$ along its third row, whose first entry is zero, and use "
            r"$\sin^{2} q_1 + \cos^{2} q_1 = 1$ and $\sin^{2} q_2 + \cos^{2} q_2 = 1$. It does not depend on $q_1$, since turning the "
            r"whole arm about axis 1 changes no lengths:",
            r"\det \mathbf J_v",
            given["rrt_det"].sympy(),
        )
    ]


def explain_singular(v: Variant, given: Given) -> list[Step]:
    import sympy  # pyright: ignore[reportMissingTypeStubs]

    way, reach = (sympy.Eq(condition.sympy(), 0, evaluate=False) for condition in given["rrt_singular"])  # pyright: ignore[reportUnknownVariableType]
    return [
        Step(
            "A product is zero where one of its factors is. First, the hand lies on axis 2, which then cannot move it:",
            formula=way,
        ),
        Step(
            "Second, the hand lies in the plane through axis 1 that is parallel to axis 2: joint 1 moves it only in the plane "
            "of joints 2 and 3. An offset along axis 2 changes nothing about that.",
            formula=reach,
        ),
    ]


def statement(_: Variant) -> str:
    return r"""The robot turns about the vertical axis 1 and the horizontal axis 2, and slides along axis 3 (RRT). The first
figure shows it in its home pose, $q_1 = q_2 = 0$, with frame 0, the lengths, the tool frame and the positive sense of each
joint; the second shows it at your $\mathbf q$.

Use the **standard** Denavit–Hartenberg convention: $\mathbf z_{i-1}$ along the axis of joint $i$ in its positive sense,
joint $i$ between frames $i-1$ and $i$. Place the frames so that $\theta_1 = q_1$, $\theta_2 = q_2$ and $\theta_3 = 0$, without joint
offsets, and so that frame 3 is the tool frame that is drawn. With that the table is unique."""


EXERCISE = Exercise(
    slug="rrt",
    title="Jacobian of an RRT robot",
    source="S3 5.4.1",
    draw=draw,
    statement=statement,
    units={"d1": "m", "a1": "m", "d2": "m", "l3": "m", "q": ["rad", "rad", "m"]},
    scale=lambda v: sum(lengths(v).values()) + v["q"][2],
    objectives=(
        "Read a Denavit–Hartenberg table off a drawing.",
        "Build the Jacobian of an arm with a prismatic joint from its frames.",
        "Find the postures in which an arm is singular from a determinant.",
    ),
    minutes=75,
    robot="rrt_offset",
    drawings=drawings,
    parts=(
        Part(
            "rrt_dh",
            r"The DH table: one row $[\theta_i, d_i, a_i, \alpha_i]$ per joint, as text in the names of your lengths and "
            r"q1, q2, q3, for instance `['q1 + pi', 0.25, 'd1', 'pi/3']`, or as numbers at your $\mathbf q$ (radians, metres)",
            3,
            TableOf(LENGTHS, KINDS),
            table,
            hints=(
                "Which way does the positive arrow of joint 2 make its axis point?",
                "A prismatic joint's variable stands in the column d.",
            ),
            explain=explain_table,
        ),
        Part(
            "rrt_T",
            r"The transforms from the fixed frame to each frame, $\mathbf T_0^1, \mathbf T_0^2, \mathbf T_0^3$ at your "
            r"$\mathbf q$, stacked to an array 3 × 4 × 4",
            3,
            Numbers((3, 4, 4), [[["1", "1", "1", "m"]] * 3 + [["1"] * 4]], decimals=3),
            transforms,
            mistakes=(
                Mistake(
                    "These lead from each frame to the next; all three shall start at the fixed frame.", link_transforms
                ),
            ),
            needs=("rrt_dh",),
            hints=("Multiply from the left to the right: T01, then T01 @ T12, then the last.",),
            explain=explain_transforms,
        ),
        Part(
            "rrt_J",
            r"The 6 × 3 Jacobian $\mathbf J$ of the tool point in the base frame at your $\mathbf q$, linear rows above angular rows",
            4,
            Numbers((6, 3), [["m/rad", "m/rad", "1"]] * 3 + [["1", "1", "1"]] * 3, decimals=3),
            jacobian_of,
            mistakes=(
                Mistake(
                    "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z of "
                    "frame i - 1.",
                    one_frame_late,
                ),
            ),
            needs=("rrt_T", "rrt_dh"),
            hints=(
                "What does a prismatic joint contribute to the angular velocity?",
                "The axis of joint i is the z axis of frame i - 1.",
            ),
            explain=explain_jacobian,
        ),
        Part(
            "rrt_J_symbolic",
            r"The same 6 × 3 Jacobian $\mathbf J$ (tool point, base frame, linear rows above angular rows) for any $\mathbf q$: "
            r"formulas in the names of your lengths and q1, q2, q3, as six rows of three texts",
            4,
            Formulas((6, 3), NAMES),
            jacobian_in_formulas,
            mistakes=(
                Mistake(
                    "Column 3: look again at what a slide does to the orientation of the hand.",
                    lambda v, _: turning_slide(robot_of(v)),
                ),
                Mistake(
                    "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z of "
                    "frame i - 1.",
                    lambda v, _: columns_of_frames(robot_of(v), late=1),
                ),
                Mistake(
                    "The lever arm of a column seems to end at the next frame; where does the point lie whose velocity is "
                    "asked?",
                    lambda v, _: columns_of_frames(robot_of(v), to_hand=False),
                ),
            ),
            needs=("rrt_dh",),
            follow=0.5,  # formulas of one fixed form can be shared; numbers cannot
            hints=(
                "The linear rows are also the derivatives of the tool point's coordinates.",
                "Put in your numbers and compare with the Jacobian above.",
            ),
            explain=explain_jacobian_formulas,
        ),
        Part(
            "rrt_det",
            r"The determinant of the linear block $\mathbf J_v$ (rows 1 to 3 of $\mathbf J$), with its sign, as one formula in the names "
            r"of your lengths and q1, q2, q3",
            2,
            Formulas((), NAMES),
            determinant,
            mistakes=(
                Mistake(
                    "It would be right if q2 were measured from another zero; look at the home pose again.",
                    lambda v, _: determinant_by_elevation(robot_of(v)),
                ),
            ),
            needs=("rrt_J_symbolic",),
            follow=0.5,
            check=named_multiple,
            hints=(
                "Expand along the row that holds a zero.",
                "It does not depend on q1, so you may compute it for the q1 that makes it easy.",
            ),
            explain=explain_determinant,
        ),
        Part(
            "rrt_singular",
            r"All postures in which the linear block $\mathbf J_v$ is singular: a list of conditions in the names of your lengths and "
            r"q1, q2, q3, each as text such as `'cos(q1) = 0'` or `'d1 + q3*q2 = 0'`; a posture is singular when one of them holds. "
            r"Count postures with $q_1$ and $q_2$ from $-\pi$ to $\pi$ and $q_3$ from −1.5 m to 1.5 m, the slide running through "
            r"to the other side",
            3,
            Conditions(NAMES, lambda _: LIMITS),
            singular,
            mistakes=(
                Mistake(
                    "They would be right if q2 were measured from another zero; look at the home pose again.",
                    singular_by_elevation,
                ),
            ),
            needs=("rrt_det",),
            follow=0.5,
            hints=(
                "Where is the determinant zero? Take its factors one by one.",
                "In such a posture the hand cannot move in one direction: which one, for each of your conditions?",
            ),
            explain=explain_singular,
        ),
    ),
)
