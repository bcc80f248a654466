"""S3 5.4.2: velocities of the Puma 560 and back.

S3's own numbers are q = (0.1, 0.5, 0.1, 0.8, 0.1, 0.2) and qdot = (1, 1.4, 1.7, 0.2, 0.3, 0.1), with the twist
(-1.2889, 0.0233, -0.1734, 0.3338, -3.2993, 1.3648). Its question c, "linear velocity along X of 2 m/s", has several
readings; here every sheet has one of three wordings, and a student who answers another reading is told which it was.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.jacobian import jacobian
from ...solutions.robots import ROBOTS
from ...solutions.velocity import pseudoinverse
from ..drawing import Drawing, Triad
from ..draws import angles, rates, until
from ..exercise import Exercise, Given, Mistake, Numbers, Outcome, Part, Step, Variant
from ..properties import meets

ROBOT = ROBOTS["puma560"]
CHAIN = ROBOT.chain()
REGULAR = 0.1  # smallest singular value of J in a drawn posture: rates stay moderate and rounding harmless
NEAR_SINGULAR = (0.02, 0.06)  # the same where the wrist is nearly straight
LARGE = 3.0  # the largest rate there is at least [rad/s]
CLEAR = 0.1  # of the elbow from the straight line between shoulder and wrist centre [m]
HALF = 0.5e-4  # of the last decimal that is asked
SLACK = 0.01  # of the asked speed: a velocity this near is meant
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Wording:
    """One wording of question (c): how many leading rows of the twist are prescribed, and what the sheet says."""

    rows: int
    asked: str
    text: str
    solution: str


LEAST = (
    r"Of all joint rates that do this, find those of least norm, that is with the smallest "
    r"$\dot q_1^2 + \cdots + \dot q_6^2$."
)
PSEUDOINVERSE = (
    r"There are more joints than rows; the rates of least norm are $\dot{\mathbf q} = \mathbf J_v^{+} \mathbf v$ with "
    r"$\mathbf J_v^{+} = \mathbf J_v^{T} (\mathbf J_v \mathbf J_v^{T})^{-1}$ (S3 5.2.1). The tool point lies where the wrist "
    r"axes meet, so that the wrist cannot move it: columns 4 to 6 of $\mathbf J_v$ are zero, and so are these rates."
)
HELD, FREE, ALONE = "orientation held (omega = 0)", "orientation free, least norm", "only vx prescribed, least norm"
WORDINGS = {
    HELD: Wording(
        6,
        "the whole twist, with zero angular velocity",
        r"The tool moves along base $x$ with the speed $v_{x,c}$ and its orientation is **held**: the other five components "
        r"of the twist, $v_y, v_z, \omega_x, \omega_y, \omega_z$, are zero.",
        r"All six components are prescribed, $\boldsymbol\xi = (v_{x,c}, 0, 0, 0, 0, 0)$, and $\mathbf J$ is square with "
        r"full rank, so $\dot{\mathbf q} = \mathbf J^{-1} \boldsymbol\xi$.",
    ),
    FREE: Wording(
        3,
        "the linear velocity in base axes, with least norm",
        r"The tool point moves along base $x$ with the speed $v_{x,c}$, so that $v_y = v_z = 0$, and its orientation is "
        rf"**free**: $\omega_x, \omega_y, \omega_z$ are not prescribed. {LEAST}",
        r"Let $\mathbf J_v$ be the three linear rows of $\mathbf J$ and $\mathbf v = (v_{x,c}, 0, 0)$. "
        + PSEUDOINVERSE,
    ),
    ALONE: Wording(
        1,
        "the component vx in base axes, with least norm",
        rf"**Only** $v_x = v_{{x,c}}$ is prescribed; $v_y, v_z, \omega_x, \omega_y, \omega_z$ are free. {LEAST}",
        r"Let $\mathbf J_v$ be the first row of $\mathbf J$ alone and $\mathbf v = v_{x,c}$. " + PSEUDOINVERSE,
    ),
}
FAMILIES = {
    "generic": "",
    "elbow up": "In your posture the elbow lies above the straight line from the shoulder to the wrist centre.",
    "elbow down": "In your posture the elbow lies below the straight line from the shoulder to the wrist centre.",
    "near wrist-singular": "Your posture is close to a wrist singularity, $q_5 = 0$: in (c) large joint rates are right.",
}


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A wording, a posture of one of four families, joint rates, and a speed along base x."""
    family = str(rng.choice([*FAMILIES]))
    # Where only the linear velocity is prescribed the wrist stands still, and rates are never large.
    wording = HELD if family == "near wrist-singular" else str(rng.choice([*WORDINGS]))
    speed = round(float(rng.integers(20, 81)) / 100, 2)
    q = until(lambda: _posture(rng, family), lambda q: _belongs(q, family, speed))
    return {"q": q, "qdot_b": rates(rng, 6), "vx_c": speed, "wording": wording, "family": family}


def _posture(rng: np.random.Generator, family: str) -> list[float]:
    q = angles(rng, 6, [(1, 2)])
    if family == "near wrist-singular":
        q[4] = round(float(rng.choice([-1, 1]) * rng.uniform(0.08, 0.18)), 3)
    return q


def _belongs(q: list[float], family: str, speed: float) -> bool:
    J = jacobian(CHAIN, q)
    smallest = np.linalg.svd(J, compute_uv=False)[-1]
    if family == "near wrist-singular":
        arm = np.linalg.svd(J[:3, :3], compute_uv=False)[-1]
        largest = np.abs(np.linalg.solve(J, [speed, 0, 0, 0, 0, 0])).max()
        return bool(arm >= REGULAR and NEAR_SINGULAR[0] <= smallest <= NEAR_SINGULAR[1] and largest >= LARGE)
    height = elbow_height(q)
    side = {"elbow up": height >= CLEAR, "elbow down": height <= -CLEAR}.get(family, True)
    return bool(smallest >= REGULAR and side)


def elbow_height(q: list[float]) -> float:
    """How far the elbow lies above the line from shoulder to wrist centre [m], in the plane normal to axis 2."""
    poses = ROBOT.frames({}, q)
    axis, shoulder, elbow, wrist = poses[1, :3, 2], poses[1, :3, 3], poses[2, :3, 3], poses[4, :3, 3]
    across = np.eye(3) - np.outer(axis, axis)
    link, line = across @ (elbow - shoulder), across @ (wrist - shoulder)
    return float((link - line * (link @ line) / (line @ line))[2])


def target(v: Variant) -> Array:
    """The twist with the asked speed and zeros [m/s, rad/s]; the wording says which rows of it are prescribed."""
    return np.array([v["vx_c"], 0.0, 0.0, 0.0, 0.0, 0.0])


def jacobian_at_q(v: Variant, _: Given) -> Array:
    return jacobian(CHAIN, v["q"])


def twist(v: Variant, given: Given) -> Array:
    J: Array = given["puma_velocities_J"]
    return J @ np.array(v["qdot_b"])


def rates_for_speed(v: Variant, given: Given) -> Array:
    return _rates(*_prescribed(v, given))


def transposed_for_inverse(v: Variant, given: Given) -> Array:
    J, velocity = _prescribed(v, given)
    return J.T @ velocity


def _prescribed(v: Variant, given: Given) -> tuple[Array, Array]:
    """The rows of J and of the twist that the wording prescribes."""
    rows = WORDINGS[v["wording"]].rows
    return given["puma_velocities_J"][:rows], target(v)[:rows]


def _rates(J: Array, velocity: Array) -> Array:
    """The rates that are unique, or those of least norm."""
    if len(J) == 6:
        return np.asarray(np.linalg.solve(J, velocity), dtype=np.float64)
    return pseudoinverse(J) @ velocity


READINGS = (  # the strictest first: each is met by whoever meets one above it in the same axes
    ("the whole twist, with zero angular velocity", 6, "base"),
    ("the whole twist along the x axis of the tool", 6, "tool"),
    ("the linear velocity only", 3, "base"),
    ("the linear velocity only, along the x axis of the tool", 3, "tool"),
    ("the x component only", 1, "base"),
    ("the x component only, along the x axis of the tool", 1, "tool"),
)


def judged_rates(v: Variant, given: Given, value: Array) -> Outcome:
    """Right by the velocity that is reached where the rates are unique; else the reading of the question is named.

    Half of the points go to rates that have the asked linear velocity and not the least norm.
    """
    J: Array = given["puma_velocities_J"]
    asked, allowed = WORDINGS[v["wording"]], SLACK * v["vx_c"]
    rounding = 1.5 * HALF * (np.abs(J).sum(axis=1) + np.abs(value).sum())
    if asked.rows == 6 and meets(J, value, target(v), np.minimum(rounding, allowed)):
        return Outcome(right=np.ones(6, dtype=bool))
    R = ROBOT.frames({}, v["q"])[-1, :3, :3]
    in_axes = {"base": J, "tool": np.concatenate([R.T @ J[:3], R.T @ J[3:]])}
    for words, rows, axes in READINGS:
        reached, wanted = in_axes[axes][:rows], target(v)[:rows]
        if not meets(reached, value, wanted, allowed):
            continue
        least = _rates(reached, wanted)
        is_least = bool(np.abs(value - least).max() <= SLACK * max(1.0, np.abs(least).max()))
        as_asked = axes == "base" and rows == asked.rows
        if as_asked and (is_least or rows == 6):
            return Outcome()  # how near the rates are is left to the tolerance
        norm = ", with least norm" if is_least and rows < 6 else ""
        asks = "the rates of least norm" if as_asked else asked.asked
        share = 0.5 if axes == "base" and rows >= max(asked.rows, 3) else None  # one component is met by chance
        return Outcome(reading=f"This meets {words}{norm}; the sheet asks for {asks}.", share=share)
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
    size = rf" The smallest singular value of $\mathbf J$ is {smallest:.3f}"
    size += ": the wrist is nearly straight, and large rates are right." if smallest < REGULAR else "."
    return [
        Step(WORDINGS[v["wording"]].solution + size),
        Step("With your numbers:", r"\dot{\mathbf q}", numbers=given["puma_velocities_qdot"]),
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


def statement(v: Variant) -> str:
    rows = "\n".join(
        f"| {i} | " + " | ".join(f"${cell}$" for cell in row) + " |" for i, row in enumerate(_latex_rows(), 1)
    )
    return rf"""The Puma 560 has six revolute joints. Its table in the **standard** Denavit–Hartenberg convention (metres):

| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |
|:-:|:-:|:-:|:-:|:-:|
{rows}

The tool frame is frame 6. All velocities are those of its origin and are expressed in the base frame 0.
{FAMILIES[v["family"]]}

For (c): {WORDINGS[v["wording"]].text}"""


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
    symbols={"qdot_b": r"\dot{\mathbf{q}}_b", "vx_c": "v_{x,c}"},
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
            mistakes=(
                Mistake(
                    "This is J transposed times the joint rates; joint rates are weights of the columns of J.",
                    lambda v, given: given["puma_velocities_J"].T @ np.array(v["qdot_b"]),
                ),
            ),
            hints=("One matrix times one vector.",),
            explain=explain_twist,
        ),
        Part(
            "puma_velocities_qdot",
            r"(c) The joint rates $\dot{\mathbf q}$ for the motion that is described under (c) above, with the speed $v_{x,c}$",
            3,
            Numbers((6,), "rad/s"),
            rates_for_speed,
            needs=("puma_velocities_J",),
            check=judged_rates,
            mistakes=(
                Mistake(
                    "These come from J transposed in place of its inverse or pseudoinverse; put them into J and look at "
                    "the velocity they give.",
                    transposed_for_inverse,
                ),
            ),
            hints=(
                "Which rows of the twist are prescribed? Only these rows of J take part.",
                "Are there as many prescribed rows as joints, or fewer?",
            ),
            explain=explain_rates,
        ),
    ),
)
