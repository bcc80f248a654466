"""S0 4.3.1: the Jacobian of a 3-axis robot, from frames placed on the joint axes."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..solutions.expression import parse
from ..solutions.jacobian import jacobian
from ..solutions.robots import ROBOTS
from .drawing import Dimension, Drawing, Triad, point
from .draws import angles, length, until
from .exercise import Exercise, Given, Mistake, Numbers, Part, Step, Variant

ROBOT = ROBOTS["three_axis"]
Array = NDArray[np.float64]


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm away from its singular postures, and a displacement that first order meets to a few per cent."""
    v: dict[str, Any] = until(lambda: _arm(rng), _is_regular)
    v["dp"] = until(lambda: _displacement(rng), lambda dp: _is_telling({**v, "dp": dp}))
    return v


def _arm(rng: np.random.Generator) -> dict[str, Any]:
    return {"L": length(rng), "a2": length(rng), "a3": length(rng), "q": angles(rng, 3, [(1, 2)])}


def _is_regular(v: Variant) -> bool:
    _, q2, q3 = v["q"]
    radius = v["a3"] * np.cos(q2 + q3) - v["a2"] * np.sin(q2)
    return bool(abs(np.cos(q3)) > 0.3 and abs(radius) > 0.2)


def _displacement(rng: np.random.Generator) -> list[float]:
    """Three components [m] with three decimals, |dp| about 0.02."""
    sizes = rng.integers(6, 19, 3) * rng.choice([-1, 1], 3)
    return [round(float(x) / 1000, 3) for x in sizes]


def _is_telling(v: Variant) -> bool:
    """Whether dq is small, joint 1 and the sum of the others take part, and every component of the error shows."""
    A = jacobian(ROBOT.chain(lengths(v)), v["q"])[:3]
    dq: Array = np.asarray(np.linalg.solve(A, v["dp"]), dtype=np.float64)
    missed = np.abs(_missed(v, dq))
    turns = np.array([*dq, dq[1] + dq[2]])
    return bool(
        0.018 <= np.linalg.norm(v["dp"]) <= 0.024
        and np.abs(dq).max() <= 0.15
        and np.abs(turns).min() >= 0.002
        and missed.min() >= 2e-5
        and np.linalg.norm(missed) <= 0.004
    )


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


def wished(v: Variant) -> Array:
    """The displacement dp [m]; S0's own example, and sheets handed out before it was asked, have none of their own."""
    return np.array(v.get("dp", (0.01, 0.012, -0.013)))


def displacement(v: Variant, given: Given) -> Array:
    # a student's own block may be singular, which solve() would not always notice
    return np.asarray(np.linalg.lstsq(given["three_axis_A"], wished(v), rcond=1e-9)[0], dtype=np.float64)


def rotation(_: Variant, given: Given) -> Array:
    B: Array = given["three_axis_B"]
    dq: Array = given["three_axis_dq"]
    return B @ dq


def tool_point(v: Variant, q: Any) -> Array:
    return ROBOT.frames(lengths(v), q)[-1, :3, 3]


def error(v: Variant, given: Given) -> Array:
    return _missed(v, given["three_axis_dq"])


def _missed(v: Variant, dq: Array) -> Array:
    return tool_point(v, np.array(v["q"]) + dq) - tool_point(v, v["q"]) - wished(v)


def in_tool_axes(v: Variant, given: Given) -> Array:
    return frames(v)[-1, :3, :3].T @ rotation(v, given)


def with_no_rotation(v: Variant, given: Given) -> Array:
    """The least-squares answer to J dq = (dp, 0)."""
    J = np.concatenate([given["three_axis_A"], axes(v, given)])
    return np.asarray(np.linalg.lstsq(J, np.concatenate([wished(v), np.zeros(3)]))[0], dtype=np.float64)


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


def explain_displacement(v: Variant, given: Given) -> list[Step]:
    size = float(np.linalg.det(given["three_axis_A"]))
    return [
        Step(
            r"$\mathbf A$ is square, and regular at your $\mathbf q$: its determinant is the product below, for you "
            rf"{size:.3f}. So $d\mathbf q = \mathbf A^{{-1}} d\mathbf p$ is the only solution of "
            r"$\mathbf A\,d\mathbf q = d\mathbf p$.",
            r"\det \mathbf A",
            parse(ROBOT.determinant, ROBOT.names).sympy(),
        ),
        Step("With your numbers:", r"d\mathbf q", numbers=given["three_axis_dq"]),
    ]


def explain_rotation(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"$d\mathbf w = \mathbf B\,d\mathbf q = \mathbf z^1 dq_1 + \mathbf z^2 (dq_2 + dq_3)$ (S0, eq. 4.9). Nobody "
            r"asked for it: $d\mathbf p$ alone fixes the three $dq_i$. That is why $\mathbf J\,d\mathbf q = d\mathbf u$ (S0, eq. 4.13), "
            r"six equations for three unknowns, has in general no solution: it has one only if the wished $d\mathbf w$ is this one:",
            r"d\mathbf w",
            numbers=given["three_axis_dw"],
        )
    ]


def explain_error(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Multiply the transforms once more at $\mathbf q + d\mathbf q$. S0 prints eq. 4.7 with an equals sign, but it "
            r"holds to first order: what is missed grows with the square of $d\mathbf q$. With your numbers:",
            r"\mathbf p^{tool}(\mathbf q + d\mathbf q) - \mathbf p^{tool}(\mathbf q) - d\mathbf p",
            numbers=given["three_axis_error"],
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

For a small joint displacement $d\mathbf q$ the tool point moves, to first order, by $d\mathbf p = \mathbf A\,d\mathbf q$ and the tool frame
turns by $d\mathbf w = \mathbf B\,d\mathbf q$; the Jacobian $\mathbf J$ stacks $\mathbf A$ above $\mathbf B$.

The wished displacement of the tool point is $d\mathbf p$. With it $\mathbf J\,d\mathbf q = d\mathbf u$
would be six equations for three unknowns, which in general contradict each other: only three of them can be prescribed."""


EXERCISE = Exercise(
    slug="three_axis",
    title="Jacobian of a 3-axis robot",
    source="S0 4.3.1",
    draw=draw,
    statement=statement,
    units={"L": "m", "a2": "m", "a3": "m", "q": ["rad", "rad", "rad"], "dp": ["m", "m", "m"]},
    symbols={"dp": r"d\mathbf{p}"},
    scale=lambda v: v["L"] + v["a2"] + v["a3"],
    objectives=(
        "Find origins and joint axes of frames by multiplying transforms.",
        "Build the Jacobian column by column from axes and origins.",
        "Find the joint displacement for a small displacement of the tool point, and see what comes along and what is missed.",
    ),
    minutes=55,
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
        Part(
            "three_axis_dq",
            r"The joint displacement $d\mathbf q$ with $\mathbf A\,d\mathbf q = d\mathbf p$ for your $d\mathbf p$, whatever rotation comes along",
            2,
            Numbers((3,), "rad", decimals=5),
            displacement,
            needs=("three_axis_A",),
            mistakes=(
                Mistake(
                    "The transposed block is no inverse: a linear system is to be solved.",
                    lambda v, given: given["three_axis_A"].T @ wished(v),
                ),
                Mistake(
                    "The displacement of the tool point is multiplied by A; which side of A dq = dp is known?",
                    lambda v, given: given["three_axis_A"] @ wished(v),
                ),
                Mistake(
                    "This is a least-squares answer with all six rows and dw = 0; here the rotation is free.",
                    with_no_rotation,
                ),
            ),
            hints=("Three equations for three unknowns.", "The rotation of the tool is not prescribed."),
            explain=explain_displacement,
        ),
        Part(
            "three_axis_dw",
            r"The rotation $d\mathbf w = \mathbf B\,d\mathbf q$ that comes along with it",
            1,
            Numbers((3,), "rad", decimals=5),
            rotation,
            needs=("three_axis_B", "three_axis_dq"),
            mistakes=(
                Mistake(
                    "Rows and columns of B are exchanged: its columns are the joint axes.",
                    lambda _, given: given["three_axis_B"].T @ given["three_axis_dq"],
                ),
                Mistake("This is the rotation in the axes of the tool frame; base axes are asked.", in_tool_axes),
            ),
            hints=("Every joint turns the tool about its own axis; small rotations add.",),
            explain=explain_rotation,
        ),
        Part(
            "three_axis_error",
            r"How far first order misses: $\mathbf p^{tool}(\mathbf q + d\mathbf q) - \mathbf p^{tool}(\mathbf q) - d\mathbf p$ with the "
            r"true tool point of both postures, in metres, from $d\mathbf q$ with all its digits",
            2,
            Numbers((3,), "m", decimals=6),
            error,
            needs=("three_axis_dq",),
            mistakes=(
                Mistake(
                    "This is the true displacement itself; how far is it from the wished one?",
                    lambda v, given: error(v, given) + wished(v),
                ),
                Mistake(
                    "A dq - dp is zero because dq solves it; the true tool point at q + dq is asked.",
                    lambda _, __: np.zeros(3),
                ),
            ),
            hints=("Compute the tool point a second time, at the new angles.", "Expect well under a few millimetres."),
            explain=explain_error,
        ),
    ),
)
