"""S3 5.4.2: velocities of the Puma 560 and back.

S3's own numbers are q = (0.1, 0.5, 0.1, 0.8, 0.1, 0.2) and qdot = (1, 1.4, 1.7, 0.2, 0.3, 0.1), with the twist
(-1.2889, 0.0233, -0.1734, 0.3338, -3.2993, 1.3648). Its question c, "linear velocity along X of 2 m/s", has four
readings; here the wording fixes one, and a student who answers another is told which it was.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..solutions.jacobian import Frame, jacobian
from ..solutions.robots import ROBOTS
from ..solutions.velocity import joint_rates
from .drawing import Drawing, Triad
from .draws import angles, rates
from .exercise import Exercise, Given, Mistake, Numbers, Outcome, Part, Step, Variant

ROBOT = ROBOTS["puma560"]
CHAIN = ROBOT.chain()
REGULAR = 0.1  # smallest singular value of J in a drawn posture: rates stay moderate and rounding harmless
Array = NDArray[np.float64]


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A posture away from singular ones, joint rates, and a speed along base x."""
    while True:
        q = angles(rng, 6, [(1, 2)])
        if np.linalg.svd(jacobian(CHAIN, q), compute_uv=False)[-1] >= REGULAR:
            return {"q": q, "qdot_b": rates(rng, 6), "vx_c": round(float(rng.integers(20, 81)) / 100, 2)}


def target(v: Variant) -> Array:
    """The asked twist [m/s, rad/s]."""
    return np.array([v["vx_c"], 0.0, 0.0, 0.0, 0.0, 0.0])


def jacobian_at_q(v: Variant, _: Given) -> Array:
    return jacobian(CHAIN, v["q"])


def twist(v: Variant, given: Given) -> Array:
    J: Array = given["puma_velocities_J"]
    return J @ np.array(v["qdot_b"])


def rates_for_speed(v: Variant, given: Given) -> Array:
    J: Array = given["puma_velocities_J"]
    return np.asarray(np.linalg.solve(J, target(v)), dtype=np.float64)


READINGS: tuple[tuple[str, slice, Frame], ...] = (
    ("the linear velocity only, with least norm; the sheet asks for zero angular velocity too", slice(0, 3), "base"),
    ("the x component only, with least norm; the sheet asks for five components to be zero", slice(0, 1), "base"),
    ("a velocity along the x axis of the tool; the sheet asks for base x", slice(None), "tool"),
    ("the linear velocity only, along the x axis of the tool; the sheet asks for base x", slice(0, 3), "tool"),
)


def named_reading(v: Variant, _: Given, value: Array) -> Outcome:
    """Names the reading of the question that another answer meets; right and wrong stay with the tolerance."""
    for words, rows, frame in READINGS:
        other = joint_rates(CHAIN, v["q"], target(v)[rows], rows=rows, frame=frame)
        if np.abs(other - value).max() <= 1e-2:
            return Outcome(reading=f"This meets {words}.")
    return Outcome()


def one_frame_late(v: Variant, _: Given) -> Array:
    """Columns from frame i in place of frame i - 1."""
    poses = ROBOT.frames({}, v["q"])
    z, o = poses[1:, :3, 2], poses[1:, :3, 3]
    return np.concatenate([np.cross(z, o[-1] - o).T, z.T]).astype(np.float64)


MISTAKES = (
    Mistake(
        "This is the Jacobian in the axes of the tool frame; base axes are asked.",
        lambda v, _: jacobian(CHAIN, v["q"], frame="tool"),
    ),
    Mistake(
        "Column i seems to be taken from frame i; in the standard convention the axis of joint i is z of frame i - 1.",
        one_frame_late,
    ),
)


def explain_jacobian(v: Variant, given: Given) -> list[Step]:
    poses = ROBOT.frames({}, v["q"])
    return [
        Step(
            r"Multiply $\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$ along the table. All joints "
            r"are revolute, so column $i$ is $\mathbf z_{i-1} \times (\mathbf o_6 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$. "
            r"The axes $\mathbf z_0 \ldots \mathbf z_5$ as columns:",
            r"\left[\mathbf z_0 \cdots \mathbf z_5\right]",
            numbers=poses[:6, :3, 2].T,
        ),
        Step(
            r"The origins $\mathbf o_0 \ldots \mathbf o_6$ as columns (the wrist axes meet in one point):",
            r"\left[\mathbf o_0 \cdots \mathbf o_6\right]",
            numbers=poses[:, :3, 3].T,
        ),
        Step("The cross products give:", r"\mathbf J", numbers=given["puma_velocities_J"]),
    ]


def explain_twist(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"The twist is $\boldsymbol\xi = \mathbf J \dot{\mathbf q}$, linear velocity above angular velocity:",
            r"\boldsymbol\xi",
            numbers=given["puma_velocities_twist"],
        )
    ]


def explain_rates(v: Variant, given: Given) -> list[Step]:
    smallest = float(np.linalg.svd(given["puma_velocities_J"], compute_uv=False)[-1])
    return [
        Step(
            r"All six components are prescribed, $\boldsymbol\xi = (v_x, 0, 0, 0, 0, 0)$, and $\mathbf J$ is square with full "
            rf"rank (its smallest singular value is {smallest:.3f}), so $\dot{{\mathbf q}} = \mathbf J^{{-1}} \boldsymbol\xi$:",
            r"\dot{\mathbf q}",
            numbers=given["puma_velocities_qdot"],
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    poses = ROBOT.frames({}, v["q"])
    return (
        Drawing(
            CHAIN,
            tuple(v["q"]),
            "Puma 560 at your q, with frame 0 and the tool frame.",
            "Puma 560 arm with six revolute joints, drawn at your q.",
            (Triad(np.eye(4), "0"), Triad(poses[-1], "tool")),
            arrows=False,
        ),
    )


def statement(_: Variant) -> str:
    rows = "\n".join(
        f"| {i} | " + " | ".join(f"${cell}$" for cell in row) + " |" for i, row in enumerate(_latex_rows(), 1)
    )
    return rf"""The Puma 560 has six revolute joints. Its table in the **standard** Denavit–Hartenberg convention (metres):

| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |
|:-:|:-:|:-:|:-:|:-:|
{rows}

The tool frame is frame 6. All velocities are those of its origin and are expressed in the base frame 0."""


def _latex_rows() -> list[list[str]]:
    """Rows with numbers for the lengths, angles as fractions of pi."""
    values = ROBOT.parameters
    turns = {"pi/2": r"\pi/2", "-pi/2": r"-\pi/2", "0": "0"}
    return [
        [str(theta).replace("q", "q_"), *(f"{values.get(str(x), 0):g}" for x in (d, a)), turns[str(alpha)]]
        for theta, d, a, alpha in ROBOT.rows
    ]


EXERCISE = Exercise(
    slug="puma_velocities",
    title="Velocities of the Puma 560",
    source="S3 5.4.2",
    draw=draw,
    statement=statement,
    units={"q": ["rad"] * 6, "qdot_b": ["rad/s"] * 6, "vx_c": "m/s"},
    scale=lambda _: ROBOT.parameters["a2"] + ROBOT.parameters["d4"],
    objectives=(
        "Compute the Jacobian of a six-axis robot from its table.",
        "Turn joint rates into a twist, and a prescribed twist into joint rates.",
    ),
    minutes=50,
    robot="puma560",
    drawings=drawings,
    parts=(
        Part(
            "puma_velocities_J",
            r"(a) The 6 × 6 Jacobian $\mathbf J$ at your $\mathbf q$, linear rows above angular rows",
            4,
            Numbers((6, 6), [["m/rad"]] * 3 + [["1"]] * 3),
            jacobian_at_q,
            mistakes=MISTAKES,
            hints=(
                "Column i takes the z axis and the origin of frame i - 1.",
                "Toolboxes also print a Jacobian in the tool frame; base axes are asked here.",
            ),
            explain=explain_jacobian,
        ),
        Part(
            "puma_velocities_twist",
            r"(b) The twist $\boldsymbol\xi = (v_x, v_y, v_z, \omega_x, \omega_y, \omega_z)$ for the joint rates "
            r"$\dot{\mathbf q}_b$",
            2,
            Numbers((6,), ["m/s"] * 3 + ["rad/s"] * 3),
            twist,
            needs=("puma_velocities_J",),
            hints=("One matrix times one vector.",),
            explain=explain_twist,
        ),
        Part(
            "puma_velocities_qdot",
            r"(c) The joint rates $\dot{\mathbf q}$ for which the tool moves along base $x$ with the speed $v_{x,c}$ while the other "
            r"five components of the twist, $v_y, v_z, \omega_x, \omega_y, \omega_z$, are zero",
            3,
            Numbers((6,), "rad/s"),
            rates_for_speed,
            needs=("puma_velocities_J",),
            check=named_reading,
            hints=(
                "The whole twist is prescribed, not only its linear part.",
                "Is the Jacobian square and regular here?",
            ),
            explain=explain_rates,
        ),
    ),
)
