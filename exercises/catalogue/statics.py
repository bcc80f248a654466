"""S4, force control: the torques that hold a force at the hand, and the force that costs none."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...solutions.ellipsoids import lost_directions
from ...solutions.robots import ROBOTS
from .. import questions as ask
from ..answers import Choice, Numbers
from ..arm import Arm, Array, arm_of
from ..calculations.lost import ANGLE, judged_lost
from ..draws import posture, until
from ..exercise import Outcome
from ..part import exercise, part
from ..properties import is_guessable, parallel

ROBOT = ROBOTS["three_axis"]
SINGULAR = 1e-5  # of the largest singular value; six decimals of q_s leave some 1e-6
RATES = "These are joint rates that move nothing; a force is asked."
AXES_2_AND_3 = "This is the direction of axes 2 and 3; such a force turns joint 1."
CARRIED = (
    "the drives have to give very large torques",
    "the links and bearings carry the whole force; the drives give nothing",
    "the hand gives way along the force",
    "the arm leaves the posture at once, whatever the drives do",
)

STATEMENT = r"""All three joints of this robot are revolute. Frame $i$ sits on the axis of joint
$i$, with $\mathbf z^{i}$ along the axis:

$$\mathbf T_{base}^{1} = T_z(L)\,R_z(q_1), \quad \mathbf T_1^2 = R_x(90°)\,R_z(q_2), \quad
\mathbf T_2^3 = T_y(a_2)\,R_z(q_3), \quad \mathbf T_3^{tool} = T_x(a_3).$$

The hand presses against its surroundings with a force at the tool point; a joint torque counts as
positive in the positive sense of its joint. The weight of the arm is left out. $\mathbf F$ is a
force in the axes of the base frame, $\mathbf F^{tool}$ another one in the axes of the tool frame.
The posture $\mathbf q_s$ is for the **last two questions only**: it is singular, but for its
rounding."""


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm, a force in each of two frames, and a posture in which it is stretched or folded."""
    v = posture(ROBOT, rng)
    v["F"] = force(rng)
    v["F_tool"] = force(rng)
    arm = arm_of(ROBOT, v)
    v["q_s"] = until(lambda: singular_posture(rng), lambda q_s: is_telling(arm.at(q_s)))
    return v


def force(rng: np.random.Generator) -> list[float]:
    """Three components [N] with one decimal, none of them small."""
    sizes = rng.integers(20, 90, 3) * rng.choice([-1, 1], 3)
    return [round(float(size) / 10, 1) for size in sizes]


def singular_posture(rng: np.random.Generator) -> list[float]:
    """q3 is a right angle, where the two links lie in one line."""
    q1, q2 = (round(float(x), 3) for x in rng.uniform(-2, 2, 2))
    return [q1, q2, float(rng.choice([-1.570796, 1.570796]))]


def is_telling(arm: Arm) -> bool:
    """Whether one direction alone is lost, and it is none that might be guessed."""
    lost = lost_directions(arm.J[:3], SINGULAR)
    return len(lost) == 1 and not is_guessable(lost[0])


def named_opposite(arm: Arm, q_s: Array, value: Array) -> Outcome:
    """Right along the lost direction, at any length; other directions of interest are named."""
    at_s = arm.at(q_s)
    judged = judged_lost(at_s.J[:3], value)
    if judged.finding:
        return replace(judged, finding=RATES)
    if not judged.right and parallel(value, at_s.axes[:, 1], ANGLE):
        return replace(judged, finding=AXES_2_AND_3)
    return judged


@part(
    3,
    Numbers((3,), "1"),
    check=named_opposite,
    credit="all",
    shows={"places": lambda arm, q_s: arm.at(q_s).frames[1:, :3, 3].T},
)
def costless(arm: Arm, q_s: Array) -> Array:
    r"""At $\mathbf q_s$: a unit vector $\mathbf u$ in base axes along which a force at the tool
    point costs no joint torque, with either sign

    - Which forces have no moment about any of the three axes?
    - Where do the links lie at this posture?

    $\boldsymbol\tau = \mathbf J_v^T \mathbf u = \mathbf 0$ asks for the direction that is lost in
    $\mathbf J_v$: no joint rates move the hand along it. Here shoulder, elbow and tool point lie in
    one line, which crosses all three axes, so that a force along it has no moment about any of
    them. The three points, as columns:
    $$\left[\mathbf p^2\; \mathbf p^3\; \mathbf p^{tool}\right] = <places>$$

    The direction of that line:
    $$\mathbf u = <costless>$$
    """
    return lost_directions(arm.at(q_s).J[:3], SINGULAR)[0]


@part(1, Choice(CARRIED))
def carried() -> str:
    r"""What happens at $\mathbf q_s$ while a force along $\mathbf u$ acts on the hand?

    - Which motion of the hand would this force do work on?

    The hand cannot move along $\mathbf u$, to first order, so the force does no work and no torque
    is called for: the structure carries it. Across $\mathbf u$ things are as usual. (A velocity
    along $\mathbf u$ would take unbounded joint rates, a force along it takes none.)
    """
    return "b"


def drawings(arm: Arm, q_s: Array) -> tuple[Any, Any]:
    """The arm at both postures."""
    alt = "Arm with three revolute joints: axis 1 vertical, axes 2 and 3 horizontal and parallel"
    now = arm.drawing("The arm at your q.", f"{alt}, drawn at your q.", base="base")
    singular = arm.at(q_s).drawing(
        "The arm at the singular posture.", f"{alt}, its links in one line.", base="base"
    )
    return now, singular


EXERCISE = exercise(
    "statics",
    title="Joint torques that hold a force",
    source="S4",
    minutes=40,
    objectives=(
        (
            "Turn a force at the hand into joint torques with the transposed Jacobian, "
            "in the axes in which it is given."
        ),
        "Find the force that a singular posture carries without any torque.",
    ),
    robot=ROBOT,
    units={"F": ["N"] * 3, "F_tool": ["N"] * 3, "q_s": ["rad"] * 3},
    symbols={"F": r"\mathbf F", "F_tool": r"\mathbf F^{tool}", "q_s": r"\mathbf q_s"},
    draw=draw,
    statement=STATEMENT,
    drawings=drawings,
    parts=(
        ask.jacobian(rows="linear", name="J", points=3),
        ask.torques(rows="linear", wrench="F", points=2),
        ask.torques(
            rows="linear", axes="tool", wrench="F_tool", symbol=r"\mathbf F^{tool}", name="tau_tool"
        ),
        costless,
        carried,
    ),
)
