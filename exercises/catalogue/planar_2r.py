"""S2: the planar arm with two revolute joints, by trigonometry and by transforms.

S2 prints the answers for an arm whose angles all count counter-clockwise from x. Here the arm is mounted at an angle beta,
at least one joint counts clockwise, and link 2 may stand at a right angle to link 1 where q2 = 0.
"""

from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np

from ...solutions.expression_array import ExpressionArray, expression_array, same_formulas, sampled
from ..answers import Formulas, Numbers, Variant
from ..arm import Arm, Array
from ..arms import planar as arms
from ..arms.planar import FORMS, NAMES, misread
from ..columns import columns
from ..drawing import Drawing
from ..exercise import ExerciseError, Outcome
from ..part import exercise, part
from ..printed_table import cell_latex

UP = np.array([0.0, 0.0, 1.0])
NEAR = 2e-3  # how far rounded numbers may be from a known mistake that is followed or paid less
OMEGA = 0.2  # share of the points that a wrong angular entry costs where the linear rows are right


def statement(form: int) -> str:
    one, two, quarter = FORMS[form]
    way = {1: "counter-clockwise", -1: "clockwise"}
    at_zero = "link 2 points the way link 1 points"
    if quarter:
        at_zero = f"link 2 stands at a right angle to link 1, 90° {way[quarter]} from the way link 1 points"
    return rf"""Two links of lengths $l_1$ and $l_2$ move in the plane of $\mathbf x_0$ and $\mathbf y_0$. Frame 0 is fixed, its origin is on the
axis of joint 1, and $\mathbf z_0$ points towards you. All turns are named as you see them from there.

- The arm is mounted at an angle: where $q_1 = 0$, link 1 points in the direction that $\mathbf x_0$ takes when it is turned by
  $\beta$ counter-clockwise (clockwise if $\beta$ is negative).
- Positive $q_1$ turns link 1 **{way[one]}**.
- Positive $q_2$ turns link 2 **{way[two]}** against link 1; where $q_2 = 0$, {at_zero}.

Frame 1 has its origin on the axis of joint 2, frame 2 at the tool point at the end of link 2. $\mathbf x_1$ points along link 1 and
$\mathbf x_2$ along link 2, away from the base; $\mathbf z_1$ and $\mathbf z_2$ are parallel to $\mathbf z_0$. $x$ and $y$ are the
coordinates of the tool point in frame 0, and $\theta$ is the angle from $\mathbf x_0$ to $\mathbf x_2$, counter-clockwise positive."""


SOURCE = arms.pose_formulas("q1", "q1 + q2")
SHOWN = {
    "angle1": lambda form: cell_latex(arms.angle_formulas(form)[0]),
    "angle2": lambda form: cell_latex(arms.angle_formulas(form)[1]),
    "bend": lambda form: cell_latex(arms.bend_formula(form).strip("+")),
}


def full_turns(value: ExpressionArray, pose: ExpressionArray) -> Outcome:
    """Theta may be reduced by full turns."""
    turns = (sampled(value, NAMES) - sampled(pose, NAMES))[:, 2] / (2 * np.pi)
    right = same_formulas(value, pose, NAMES)
    right[2] = np.isfinite(turns).all() and np.abs(turns - np.round(turns)).max() < 1e-9
    return Outcome(right=right)


@part(
    3,
    Formulas((3,), NAMES),
    check=full_turns,
    mistakes=(
        (
            "Link 2 seems to be at the angle of joint 2 alone; joint 1 turns it too.",
            lambda form: arms.pose_formulas(arms.angle_formulas(form)[0], f"0{arms.bend_formula(form)}"),
        ),
        (arms.MOUNTING, lambda form: arms.pose(form, "0")),
        (
            "Sine and cosine are exchanged: which of them belongs to x?",
            lambda form: [arms.pose(form)[i] for i in (1, 0, 2)],
        ),
        *misread(lambda v: arms.pose(v["form"])),
        (arms.PRINTED, lambda: SOURCE),
    ),
    shows=SHOWN,
)
def pose(form: int) -> list[str]:
    r"""The pose $(x, y, \theta)$ of frame 2 in frame 0, as three formulas in `l1`, `l2`, `beta`, `q1`, `q2`, with a `*` in
    every product and angles in radians (`pi/2` for 90°), such as `l1*cos(q1)`

    - Which angle does each link make with $\mathbf x_0$?
    - A joint that counts clockwise lowers the angle of everything behind it.

    Add the angles from $\mathbf x_0$ on: the mounting angle, each joint with its sense, and what stands between the links
    where $q_2 = 0$. Link 1 has the angle $<angle1>$, link 2 the angle $<angle2>$. A link of length $l$ at an
    angle $\psi$ leads on by $(l \cos\psi,\; l \sin\psi)$; the tool has the angle of link 2:
    $$\begin{bmatrix} x \\ y \\ \theta \end{bmatrix} = <pose>$$
    """
    return arms.pose(form)


def less_omega(right: Array) -> Outcome:
    """Angular entries alone are a sign each: wrong ones cost a share, but not the linear rows above them."""
    wrong = int((~right[2]).sum())
    return Outcome(share=1 - OMEGA * wrong if right[:2].all() and wrong else None)


@part(
    4,
    Formulas((3, 2), NAMES),
    check=lambda value, J_symbolic: less_omega(same_formulas(value, J_symbolic, NAMES)),
    mistakes=(
        (
            "The derivative of the cosine is the sine with a minus sign; look again at the row of x.",
            lambda form: arms.slopes(form, minus=1),
        ),
        (
            "A factor of the chain rule seems to be missing: the derivative of each angle with respect to q1 or q2.",
            lambda form: arms.slopes(form, (1, 1)),
        ),
        (
            "A term of column 1 is missing: joint 1 moves link 2 as well.",
            lambda form: [[one.replace("l2", "0"), two] for one, two in arms.slopes(form)],
        ),
        *misread(lambda v: arms.slopes(v["form"])),
    ),
)
def J_symbolic(pose: ExpressionArray) -> Any:
    r"""The 3 × 2 Jacobian of $(x, y, \theta)$ with respect to $(q_1, q_2)$, rows in the order $x, y, \theta$, as formulas in
    `l1`, `l2`, `beta`, `q1`, `q2`

    - The derivative of an angle sum with respect to one joint may be negative.
    - Which links move when only $q_2$ changes?

    Differentiate row by row: $d \cos\psi = -\sin\psi \, d\psi$ and $d \sin\psi = \cos\psi \, d\psi$, where $\psi$
    may fall as $q_i$ grows. Both links turn with $q_1$, link 2 alone with $q_2$:
    $$\mathbf J = <J_symbolic>$$
    """
    if same_formulas(pose, expression_array(SOURCE, NAMES), NAMES).all():
        raise ExerciseError("nothing follows from the pose of another arm, whose Jacobian is printed in the source")
    sympy: Any = import_module("sympy")
    q = sympy.symbols("q1 q2", real=True)
    J = pose.sympy().jacobian(q)
    if any(entry.free_symbols.isdisjoint(q) for entry in J[:2, :]):  # nothing follows from a pose that is made easy
        raise ExerciseError("x and y take formulas whose derivatives depend on q1 or q2")
    return J


@part(
    3,
    Numbers((2, 4, 4), [[["1", "1", "1", "m"]] * 3 + [["1"] * 4]]),
    # A product in the wrong order, whose rotation is right by chance, earns nothing for it.
    check=lambda value, v: Outcome(share=0.5 if np.abs(value - arms.wrong_order(v)).max() <= NEAR else None),
    mistakes=(
        ("The second transform seems to start at frame 1; both shall start at frame 0.", arms.links),
        ("The two transforms seem to be multiplied in the wrong order.", arms.wrong_order),
        (arms.MOUNTING, lambda v: arms.transforms({**v, "beta": 0.0})),
        *misread(arms.transforms),
    ),
    shows=SHOWN,
)
def T(v: Variant) -> Array:
    r"""The transforms $\mathbf T_0^1$ and $\mathbf T_0^2$ (poses of frames 1 and 2 in frame 0) at your $\mathbf q$, stacked to an
    array 2 × 4 × 4

    - Turn first, then go along the link.
    - $\mathbf T_0^2 = \mathbf T_0^1\,\mathbf T_1^2$

    $\mathbf T_0^1 = R_z(<angle1>)\,T_x(l_1)$ and $\mathbf T_0^2 = \mathbf T_0^1\,R_z(<bend>)\,T_x(l_2)$. With your numbers:
    $$\mathbf T_0^1,\; \mathbf T_0^2 = <T>$$
    """
    return arms.transforms(v)


def same_reading(value: Array, v: Variant, T: Array, J: Array) -> Outcome:
    """A misread arm is followed from its transforms on, and linear rows under wrong angular ones are paid."""
    for other in arms.misreadings(v):
        if np.abs(T - arms.transforms(other)).max() <= NEAR and np.abs(value - arms.jacobian(other)).max() <= NEAR:
            return Outcome(right=np.ones((6, 2), dtype=bool))
    right = np.abs(value - J) <= NEAR
    return less_omega(right[[0, 1, 5]]) if right[2:5].all() else Outcome()


@part(
    3,
    Numbers((6, 2), [["m/rad"]] * 3 + [["1"]] * 3),
    check=same_reading,
    mistakes=(
        (arms.SENSE, lambda T: columns(np.array([UP, UP]), arms.levers(T), "RR")),
        (
            "The lever arm of column 2 seems to start at the base; it starts at joint 2.",
            lambda arm, T: columns(arm.axes.T, T[[1, 1], :3, 3], "RR"),
        ),
        (
            "The lever arm of column 1 seems to end at joint 2; it ends at the tool point.",
            lambda arm, T: columns(arm.axes.T, np.array([T[0, :3, 3], arms.levers(T)[1]]), "RR"),
        ),
        (
            "Both angular columns seem to turn counter-clockwise; look again at the positive senses.",
            lambda J: np.concatenate([J[:5], [[1.0, 1.0]]]),
        ),
        *misread(arms.jacobian),
    ),
    shows={"sense1": lambda form: f"{FORMS[form][0]:+d}", "sense2": lambda form: f"{FORMS[form][1]:+d}"},
)
def J(arm: Arm, T: Array) -> Array:
    r"""The 6 × 2 Jacobian $\mathbf J$ of the tool point in the axes of frame 0 at your $\mathbf q$, rows
    $v_x, v_y, v_z, \omega_x, \omega_y, \omega_z$, from the transforms

    - The axis of a joint that counts clockwise points the other way.
    - Compare with your formulas at your numbers.

    Column $i$ is $\mathbf z \times (\mathbf o_2 - \mathbf o_{i-1})$ above $\mathbf z$, where $\mathbf z$ is the axis of
    joint $i$ in its positive sense and $\mathbf o_{i-1}$ the origin of frame $i-1$, which lies on it. Here
    $\mathbf z = (0, 0, <sense1>)$ for joint 1 and $(0, 0, <sense2>)$ for joint 2:
    $$\mathbf J = <J>$$

    Rows 1, 2 and 6 are the formulas of the 3 × 2 Jacobian at your numbers; the others are zero in the plane.
    """
    return columns(arm.axes.T, arms.levers(T), "RR")


def drawings(arm: Arm) -> list[Drawing]:
    """The arm at home with its lengths, and at the student's q."""
    home = arm.at([0.0, 0.0])
    foot, knee = home.origins.T
    lines = {"l1": (foot, knee), "l2": (knee, home.p)}
    said = "Home pose, q1 = q2 = 0, mounted at the angle beta, with the positive sense of each joint."
    alt = "Planar arm with two links and two revolute joints, seen from obliquely above. "
    drawn = [(home, said, lines), (arm, "The same arm at your q.", None)]
    found = [one.drawing(caption, alt + caption, tool="", lengths=ends) for one, caption, ends in drawn]
    return [replace(drawing, view=(-75.0, 52.0)) for drawing in found]


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
    statement=statement,
    drawings=drawings,
    parts=(pose, J_symbolic, T, J),
)
