"""S2: the planar arm with two revolute joints, by trigonometry and by transforms.

S2 prints the answers for an arm whose angles all count counter-clockwise from x. Here the arm is
mounted at an angle beta, at least one joint counts clockwise, and link 2 may stand at a right angle
to link 1 where q2 = 0.
"""

from typing import Any

import numpy as np

from ...solutions.expression_array import ExpressionArray, same_formulas
from ..answers import Formulas, Numbers, Variant
from ..arm import Arm, Array
from ..arms import planar as arms
from ..arms import planar_formulas as formulas
from ..arms.planar import FORMS, NAMES, UP, misread
from ..calculations.columns import columns
from ..calculations.own_formulas import jacobian_of_position
from ..part import exercise, part
from ..properties import up_to_full_turns


@part(
    3,
    Formulas((3,), NAMES),
    check=lambda value, pose: formulas.less_source(
        up_to_full_turns(value, pose, NAMES, [2]), value
    ),
    mistakes=(
        (arms.ALONE, formulas.link_2_alone),
        (arms.MOUNTING, lambda form: formulas.pose(form, "0")),
        (arms.EXCHANGED, formulas.exchanged),
        *misread(lambda v: formulas.pose(v["form"])),
        (arms.PRINTED, lambda: formulas.SOURCE),
    ),
    shows=formulas.ANGLES,
)
def pose(form: int) -> list[str]:
    r"""The pose $(x, y, \theta)$ of frame 2 in frame 0, as three formulas in `l1`, `l2`, `beta`,
    `q1`, `q2`, with a `*` in every product and angles in radians (`pi/2` for 90°), such as
    `l1*cos(q1)`

    - Which angle does each link make with $\mathbf x_0$?
    - A joint that counts clockwise lowers the angle of everything behind it.

    Add the angles from $\mathbf x_0$ on: the mounting angle, each joint with its sense, and what
    stands between the links where $q_2 = 0$. Link 1 has the angle $<angle1>$, link 2 the angle
    $<angle2>$. A link of length $l$ at an angle $\psi$ leads on by $(l \cos\psi,\; l \sin\psi)$;
    the tool has the angle of link 2:
    $$\begin{bmatrix} x \\ y \\ \theta \end{bmatrix} = <pose>$$
    """
    return formulas.pose(form)


@part(
    4,
    Formulas((3, 2), NAMES),
    check=lambda value, J_symbolic: arms.less_omega(same_formulas(value, J_symbolic, NAMES)),
    mistakes=(
        (arms.MINUS, lambda form: formulas.slopes(form, minus=1)),
        (arms.CHAIN_RULE, lambda form: formulas.slopes(form, (1, 1))),
        (arms.LINK_2, formulas.without_link_2),
        *misread(lambda v: formulas.slopes(v["form"])),
    ),
)
def J_symbolic(pose: ExpressionArray) -> Any:
    r"""The 3 × 2 Jacobian of $(x, y, \theta)$ with respect to $(q_1, q_2)$, rows in the order
    $x, y, \theta$, as formulas in `l1`, `l2`, `beta`, `q1`, `q2`

    - The derivative of an angle sum with respect to one joint may be negative.
    - Which links move when only $q_2$ changes?

    Differentiate row by row: $d \cos\psi = -\sin\psi \, d\psi$ and
    $d \sin\psi = \cos\psi \, d\psi$, where $\psi$ may fall as $q_i$ grows. Both links turn with
    $q_1$, link 2 alone with $q_2$:
    $$\mathbf J = <J_symbolic>$$
    """
    return jacobian_of_position(pose, formulas.SOURCE, NAMES, rows=2)


@part(
    3,
    Numbers((2, 4, 4), [[["1", "1", "1", "m"]] * 3 + [["1"] * 4]]),
    check=arms.judged_transforms,
    mistakes=(
        (arms.FROM_1, arms.links),
        (arms.ORDER, arms.wrong_order),
        (arms.MOUNTING, lambda v: arms.transforms({**v, "beta": 0.0})),
        *misread(arms.transforms),
    ),
    shows=formulas.ANGLES,
)
def T(v: Variant) -> Array:
    r"""The transforms $\mathbf T_0^1$ and $\mathbf T_0^2$ (poses of frames 1 and 2 in frame 0) at
    your $\mathbf q$, stacked to an array 2 × 4 × 4

    - Turn first, then go along the link.
    - $\mathbf T_0^2 = \mathbf T_0^1\,\mathbf T_1^2$

    $\mathbf T_0^1 = R_z(<angle1>)\,T_x(l_1)$ and
    $\mathbf T_0^2 = \mathbf T_0^1\,R_z(<bend>)\,T_x(l_2)$. With your numbers:
    $$\mathbf T_0^1,\; \mathbf T_0^2 = <T>$$
    """
    return arms.transforms(v)


@part(
    3,
    Numbers((6, 2), [["m/rad"]] * 3 + [["1"]] * 3),
    check=arms.same_reading,
    mistakes=(
        (arms.SENSE, lambda T: columns(np.array([UP, UP]), arms.levers(T), "RR")),
        (arms.FROM_BASE, lambda arm, T: columns(arm.axes.T, T[[1, 1], :3, 3], "RR")),
        (arms.TO_JOINT_2, lambda arm, T: columns(arm.axes.T, arms.levers_to_elbow(T), "RR")),
        (arms.OMEGA_SENSE, lambda J: np.concatenate([J[:5], [[1.0, 1.0]]])),
        *misread(arms.jacobian),
    ),
    shows={
        "sense1": lambda form: f"{FORMS[form][0]:+d}",  # +1 or -1
        "sense2": lambda form: f"{FORMS[form][1]:+d}",
    },
)
def J(arm: Arm, T: Array) -> Array:
    r"""The 6 × 2 Jacobian $\mathbf J$ of the tool point in the axes of frame 0 at your $\mathbf q$,
    rows $v_x, v_y, v_z, \omega_x, \omega_y, \omega_z$, from the transforms

    - The axis of a joint that counts clockwise points the other way.
    - Compare with your formulas at your numbers.

    Column $i$ is $\mathbf z \times (\mathbf o_2 - \mathbf o_{i-1})$ above $\mathbf z$, where
    $\mathbf z$ is the axis of joint $i$ in its positive sense and $\mathbf o_{i-1}$ the origin of
    frame $i-1$, which lies on it. Here $\mathbf z = (0, 0, <sense1>)$ for joint 1 and
    $(0, 0, <sense2>)$ for joint 2:
    $$\mathbf J = <J>$$

    Rows 1, 2 and 6 are the formulas of the 3 × 2 Jacobian at your numbers; the others are zero in
    the plane.
    """
    return columns(arm.axes.T, arms.levers(T), "RR")


EXERCISE = exercise(
    "planar_2r",
    title="Planar arm with two joints",
    source="S2",
    minutes=40,
    objectives=(
        "Write the pose of a planar arm by trigonometry and differentiate it.",
        "Reach the same Jacobian from transforms.",
    ),
    robot=arms.robot,
    robot_map="planar_2r",
    units={"l1": "m", "l2": "m", "beta": "rad", "q": ["rad", "rad"]},
    structure=("form",),
    scale=lambda l1, l2: l1 + l2,
    draw=arms.draw,
    statement=arms.described,
    drawings=arms.drawn,
    parts=(pose, J_symbolic, T, J),
)
