"""S0 4.3.1: the Jacobian of a 3-axis robot, from frames placed on the joint axes."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..solutions.robots import ROBOTS
from .drawing import Dimension, Drawing, Triad, point
from .draws import angles, length
from .exercise import Exercise, Given, Numbers, Part, Step, Variant

ROBOT = ROBOTS["three_axis"]
Array = NDArray[np.float64]


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """Lengths and a posture away from the stretched arm and from the axis of joint 1."""
    while True:
        v: dict[str, Any] = {"L": length(rng), "a2": length(rng), "a3": length(rng), "q": angles(rng, 3, [(1, 2)])}
        _, q2, q3 = v["q"]
        radius = v["a3"] * np.cos(q2 + q3) - v["a2"] * np.sin(q2)
        if abs(np.cos(q3)) > 0.3 and abs(radius) > 0.2:
            return v


def lengths(v: Variant) -> dict[str, float]:
    return {name: v[name] for name in ROBOT.parameters}


def frames(v: Variant) -> Array:
    """Frames 1, 2, 3 and the tool, (4, 4, 4)."""
    return ROBOT.frames(lengths(v), v["q"])


def origins(v: Variant, _: Given) -> Array:
    return frames(v)[:, :3, 3].T


def axes(v: Variant, _: Given) -> Array:
    return frames(v)[:3, :3, 2].T


def positional(_: Variant, given: Given) -> Array:
    p: Array = given["three_axis_p"]
    z: Array = given["three_axis_z"]
    return np.cross(z, p[:, 3:] - p[:, :3], axis=0)


def angular(_: Variant, given: Given) -> Array:
    z: Array = given["three_axis_z"]
    return z


def stacked(_: Variant, given: Given) -> Array:
    return np.concatenate([given["three_axis_A"], given["three_axis_B"]])


def explain_origins(v: Variant, given: Given) -> list[Step]:
    closed = ROBOT.symbolic()
    return [
        Step(
            r"Multiply the transforms up to frame $i$: $\mathbf T_{base}^{i} = \mathbf T_{base}^{1} \mathbf T_1^2 \cdots "
            r"\mathbf T_{i-1}^{i}$. Its last column is $\mathbf p_{base}^{i}$. The tool point in closed form:",
            r"\mathbf p_{base}^{tool}",
            closed.T[:3, 3],
        ),
        Step(
            r"With your numbers, the columns are $\mathbf p^1, \mathbf p^2, \mathbf p^3, \mathbf p^{tool}$. Frames 1 and 2 "
            r"share their origin, because $\mathbf T_1^2$ only turns.",
            r"\left[\mathbf p^1\; \mathbf p^2\; \mathbf p^3\; \mathbf p^{tool}\right]",
            numbers=given["three_axis_p"],
        ),
    ]


def explain_axes(v: Variant, given: Given) -> list[Step]:
    closed = ROBOT.symbolic()
    return [
        Step(
            r"$\mathbf z_{base}^{i}$ is the third column of the rotation in $\mathbf T_{base}^{i}$. Axes 2 and 3 are "
            r"parallel, since $\mathbf T_2^3$ turns about $\mathbf z$ only:",
            r"\mathbf z^2 = \mathbf z^3",
            closed.frames[1][:3, 2],
        ),
        Step(
            "With your numbers:", r"\left[\mathbf z^1\; \mathbf z^2\; \mathbf z^3\right]", numbers=given["three_axis_z"]
        ),
    ]


def explain_positional(v: Variant, given: Given) -> list[Step]:
    closed = ROBOT.symbolic()
    return [
        Step(
            r"All joints are revolute, $\xi_i = 1$, so column $i$ of $\mathbf A$ is "
            r"$\mathbf z^{i} \times (\mathbf p^{tool} - \mathbf p^{i})$ (S0, eq. 4.8). In closed form:",
            r"\mathbf A",
            closed.J[:3, :],
        ),
        Step("With your numbers:", r"\mathbf A", numbers=given["three_axis_A"]),
    ]


def explain_angular(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Column $i$ of $\mathbf B$ is $\xi_i \mathbf z^{i} = \mathbf z^{i}$ (S0, eq. 4.10). With your numbers:",
            r"\mathbf B",
            numbers=given["three_axis_B"],
        )
    ]


def explain_stacked(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"The linear rows stand above the angular ones (S0, eq. 4.12):",
            r"\mathbf J = \begin{bmatrix}\mathbf A\\ \mathbf B\end{bmatrix}",
            numbers=given["three_axis_J"],
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    poses = frames(v)
    foot, shoulder, elbow, hand = np.zeros(3), *(pose[:3, 3] for pose in poses[1:])
    return (
        Drawing(
            ROBOT.chain(lengths(v)),
            tuple(v["q"]),
            "Your 3-axis robot at your q.",
            "Arm with three revolute joints: axis 1 vertical, axes 2 and 3 horizontal and parallel, drawn at your q.",
            (Triad(np.eye(4), "base"), Triad(poses[-1], "tool")),
            (
                Dimension(point(foot), point(shoulder), "L"),
                Dimension(point(shoulder), point(elbow), "a2"),
                Dimension(point(elbow), point(hand), "a3"),
            ),
        ),
    )


def statement(_: Variant) -> str:
    return r"""All three joints of this robot are revolute. Frame $i$ sits on the axis of joint $i$, with
$\mathbf z^{i}$ along the axis:

$$\mathbf T_{base}^{1} = T_z(L)\,R_z(q_1), \quad \mathbf T_1^2 = R_x(90°)\,R_z(q_2), \quad
\mathbf T_2^3 = T_y(a_2)\,R_z(q_3), \quad \mathbf T_3^{tool} = T_x(a_3).$$

$T_x, T_y, T_z$ move along and $R_x, R_z$ turn about an axis of the current frame. Give all vectors in the base frame.

For a small joint displacement $d\mathbf q$ the tool point moves by $d\mathbf p = \mathbf A\,d\mathbf q$ and the tool frame turns by
$d\mathbf w = \mathbf B\,d\mathbf q$; the Jacobian $\mathbf J$ stacks $\mathbf A$ above $\mathbf B$."""


EXERCISE = Exercise(
    slug="three_axis",
    title="Jacobian of a 3-axis robot",
    source="S0 4.3.1",
    draw=draw,
    statement=statement,
    units={"L": "m", "a2": "m", "a3": "m", "q": ["rad", "rad", "rad"]},
    scale=lambda v: v["L"] + v["a2"] + v["a3"],
    objectives=(
        "Find origins and joint axes of frames by multiplying transforms.",
        "Build the Jacobian column by column from axes and origins.",
    ),
    minutes=35,
    robot="three_axis",
    drawings=drawings,
    parts=(
        Part(
            "three_axis_p",
            r"The origins $\mathbf p^1, \mathbf p^2, \mathbf p^3$ and the tool point $\mathbf p^{tool}$, as the four columns of a 3 × 4 matrix",
            3,
            Numbers((3, 4), "m", decimals=3),
            origins,
            hints=("The origin of a frame is the last column of its transform.", "Which frames share an origin?"),
            explain=explain_origins,
        ),
        Part(
            "three_axis_z",
            r"The joint axes $\mathbf z^1, \mathbf z^2, \mathbf z^3$, as the columns of a 3 × 3 matrix",
            2,
            Numbers((3, 3), "1", decimals=3),
            axes,
            hints=("The axis is the third column of the rotation.", "Axes 2 and 3 are parallel."),
            explain=explain_axes,
        ),
        Part(
            "three_axis_A",
            r"The 3 × 3 block $\mathbf A$ of the positional displacements at your $\mathbf q$",
            3,
            Numbers((3, 3), "m/rad", decimals=3),
            positional,
            needs=("three_axis_p", "three_axis_z"),
            hints=(
                "The lever arm goes from the joint to the tool point.",
                "The order of a cross product decides its sign.",
            ),
            explain=explain_positional,
        ),
        Part(
            "three_axis_B",
            r"The 3 × 3 block $\mathbf B$ of the angular displacements at your $\mathbf q$",
            1,
            Numbers((3, 3), "1", decimals=3),
            angular,
            needs=("three_axis_z",),
            follow=0,  # it repeats z; whoever has z wrong has this wrong
            hints=("A revolute joint turns the tool about its own axis.",),
            explain=explain_angular,
        ),
        Part(
            "three_axis_J",
            r"The 6 × 3 Jacobian $\mathbf J$, linear rows above angular rows",
            1,
            Numbers((6, 3), [["m/rad"]] * 3 + [["1"]] * 3, decimals=3),
            stacked,
            needs=("three_axis_A", "three_axis_B"),
            hints=("Nothing is left to compute.",),
            explain=explain_stacked,
        ),
    ),
)
