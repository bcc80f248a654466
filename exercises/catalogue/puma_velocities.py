"""S3 5.4.2: velocities of the Puma 560 and back.

S3's own numbers are q = (0.1, 0.5, 0.1, 0.8, 0.1, 0.2) and qdot = (1, 1.4, 1.7, 0.2, 0.3, 0.1),
with the twist (-1.2889, 0.0233, -0.1734, 0.3338, -3.2993, 1.3648). Its question c, "linear velocity
along X of 2 m/s", has several readings; here every sheet has one of three wordings, and a student
who answers another reading is told which it was.
"""

from typing import Any

import numpy as np

from ...solutions.singularity import sigma_min
from ..answers import Numbers
from ..arm import Arm, Array
from ..arms.puma import FAMILIES, NEAR_SINGULAR, PUMA, REACH, REGULAR, TABLE, drawn, posture
from ..calculations.readings import LINEAR, TRANSPOSED, WHOLE, Speed, judged_rates, rates_for
from ..draws import rates
from ..exercise import Outcome
from ..part import exercise, part

HELD = "orientation held (omega = 0)"
FREE = "orientation free, least norm"
ALONE = "only vx prescribed, least norm"
WORDINGS = {
    HELD: Speed(6, WHOLE, "v_{x,c}"),
    FREE: Speed(6, LINEAR, "v_{x,c}"),
    ALONE: Speed(6, (0,), "v_{x,c}"),
}
STILL_WRIST = (
    "The tool point lies where the wrist axes meet, so that the wrist cannot move it: "
    "the linear rows of columns 4 to 6 are zero, and so are these rates."
)
TRANSPOSED_TWIST = (
    "This is J transposed times the joint rates; joint rates are weights of the columns of J."
)


def statement(wording: str, family: str) -> str:
    """The table, where the posture is special, and the motion of the last question."""
    return f"""{TABLE}

The tool frame is frame 6. All velocities are those of its origin and are expressed in the base
frame 0. {FAMILIES[family]}

For (c): {WORDINGS[wording].text}"""


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A wording, a posture of one of four families, joint rates, and a speed along base x."""
    family = str(rng.choice([*FAMILIES]))
    wording = HELD
    # Where only the linear velocity is prescribed the wrist stands still: rates are never large.
    if family != NEAR_SINGULAR:
        wording = str(rng.choice([*WORDINGS]))
    speed = round(float(rng.integers(20, 81)) / 100, 2)
    q = posture(rng, family, speed)
    return {"q": q, "qdot_b": rates(rng, 6), "vx_c": speed, "wording": wording, "family": family}


@part(
    4,
    Numbers((6, 6), [["m/rad"]] * 3 + [["1"]] * 3, 5),
    shows={"axes": lambda arm: arm.axes, "origins": lambda arm: arm.frames[:, :3, 3].T},
)
def J(arm: Arm) -> Array:
    r"""(a) The 6 × 6 Jacobian $\mathbf J$ at your $\mathbf q$, linear rows above angular rows

    - Column i takes the z axis and the origin of frame i - 1.
    - Toolboxes also print a Jacobian in the tool frame; base axes are asked here.

    Multiply $\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$ along the
    table. All joints are revolute, so column $i$ is
    $\mathbf z_{i-1} \times (\mathbf o_6 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$. The axes
    $\mathbf z_0 \ldots \mathbf z_5$ as columns:
    $$\left[\mathbf z_0 \cdots \mathbf z_5\right] = <axes>$$

    The origins $\mathbf o_0 \ldots \mathbf o_6$ as columns (the wrist axes meet in one point):
    $$\left[\mathbf o_0 \cdots \mathbf o_6\right] = <origins>$$

    The cross products give:
    $$\mathbf J = <J>$$
    """
    return arm.J


@part(
    2,
    Numbers((6,), ["m/s"] * 3 + ["rad/s"] * 3, 5),
    mistakes=[(TRANSPOSED_TWIST, lambda J, qdot_b: J.T @ qdot_b)],
)
def twist(J: Array, qdot_b: Array) -> Array:
    r"""(b) The twist $\boldsymbol\xi = (v_x, v_y, v_z, \omega_x, \omega_y, \omega_z)$ for the joint
    rates $\dot{\mathbf q}_b$

    - One matrix times one vector.

    The twist is $\boldsymbol\xi = \mathbf J \dot{\mathbf q}$, linear velocity above angular
    velocity:
    $$\boldsymbol\xi = <twist>$$
    """
    return J @ qdot_b


def judged(J: Array, arm: Arm, vx_c: float, wording: str, value: Array) -> Outcome:
    """Right by the velocity that the rates reach; the answer to another wording is named."""
    wish = WORDINGS[wording]
    return judged_rates(J, arm.R, wish.twist(vx_c), value, wish.rows)


def way(wording: str) -> str:
    """How the rates are found."""
    solution = WORDINGS[wording].solution
    if wording == HELD:
        return solution
    return f"{solution} {STILL_WRIST}"


def nearness(J: Array) -> str:
    """The smallest singular value, and what follows from a small one."""
    smallest = sigma_min(J)
    if smallest < REGULAR:
        return f"{smallest:.3f}: the wrist is nearly straight, and large rates are right"
    return f"{smallest:.3f}"


@part(
    3,
    Numbers((6,), "rad/s"),
    check=judged,
    shows={"way": way, "nearness": nearness},
    mistakes=[(TRANSPOSED, lambda J, vx_c: J[0] * vx_c)],  # whatever else is prescribed is zero
)
def qdot(J: Array, vx_c: float, wording: str) -> Array:
    r"""(c) The joint rates $\dot{\mathbf q}$ for the motion that is described under (c) above, with
    the speed $v_{x,c}$

    - Which rows of the twist are prescribed? Only these rows of J take part.
    - Are there as many prescribed rows as joints, or fewer?

    <way> The smallest singular value of $\mathbf J$ is <nearness>.

    With your numbers:
    $$\dot{\mathbf q} = <qdot>$$
    """
    wish = WORDINGS[wording]
    return rates_for(J, wish.twist(vx_c), wish.rows)


EXERCISE = exercise(
    "puma_velocities",
    title="Velocities of the Puma 560",
    source="S3 5.4.2",
    minutes=50,
    objectives=(
        "Compute the Jacobian of a six-axis robot from its table.",
        "Turn joint rates into a twist, and a prescribed twist into joint rates.",
    ),
    robot=PUMA,
    sizes=(),
    units={"qdot_b": ["rad/s"] * 6, "vx_c": "m/s"},
    symbols={"qdot_b": r"\dot{\mathbf{q}}_b", "vx_c": "v_{x,c}"},
    structure=("wording", "family"),
    harder={"wording": (HELD, FREE)},  # six rows are prescribed, or three, in place of one
    scale=REACH,
    draw=draw,
    statement=statement,
    drawings=drawn,
    parts=(J, twist, qdot),
)
