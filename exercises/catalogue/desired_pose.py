"""S0 4.3, eq. 4.13: from a desired tool frame to du, from du to dq, and then once more."""

from typing import Any

import numpy as np

from ...solutions.inverse import displacement
from ...solutions.robots import ROBOTS
from ...solutions.singularity import sigma_min
from ..answers import Numbers, Variant
from ..arm import Arm, Array, arm_of
from ..calculations.displacements import (
    AXES,
    FIRST_ORDER,
    TRANSPOSED,
    DisplacementSlip,
    frame_near,
    sizes,
    step,
)
from ..contract.introduction import introduction
from ..contract.names import Function
from ..draws import angles, until
from ..part import exercise, part

ROBOT = ROBOTS["ur5"]
SOLVED = "J dq - du is zero because dq solves it; look where the tool really is at q + dq."
BACKWARDS = "The step is taken backwards, to q - dq."
OLD_J = "This takes the Jacobian at q; where does the arm stand now?"
BOTH_STEPS = "This is both steps together; the second alone is asked."
FIRST_ALONE = "The first step alone leaves this."
FROM_Q = "The second step goes on from q + dq."
TASK = r"""The tool frame shall come to $\mathbf T_{desired}$, printed to seven decimals. What is
missing is $d\mathbf u = (d\mathbf p, d\mathbf w)$, six numbers in **base axes**: $d\mathbf p$ [m]
leads from the tool point to the desired one, and $d\mathbf w$ [rad] is the axis times the angle of
the rotation that turns the present tool axes $\mathbf R$ into the desired ones,
$\mathbf R_{desired} = \mathbf R(d\mathbf w)\,\mathbf R$. $\mathbf J$ is the Jacobian of the tool
point in base axes, linear rows first.

A **step** adds to $\mathbf q$ the $d\mathbf q$ with
$\mathbf J(\mathbf q)\,d\mathbf q = d\mathbf u$. That holds to first order only, so the tool does
not quite arrive; a second step goes on from there. Compute with all digits and round only what you
hand in."""


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A regular posture, and a frame that the first step misses clearly, the second by far less."""
    v = until(lambda: {"q": angles(rng, 6, [(1, 2), (1, 2, 3)])}, is_regular)
    arm = arm_of(ROBOT, v)
    goal = until(lambda: frame_near(rng, arm.T), lambda T: is_telling(arm, np.array(T)))
    return {**v, "goal": goal}


def is_regular(v: Variant) -> bool:
    """Whether rates stay moderate."""
    return bool(sigma_min(arm_of(ROBOT, v).J) >= 0.1)


def is_telling(arm: Arm, goal: Array) -> bool:
    """Whether steps are small, and what they miss is not; the second misses far less."""
    first = step(arm, displacement(arm.T, goal))
    missed = rest(arm, first, goal)
    again = second(arm, first, missed)
    end = left(arm, first, again, goal)

    is_small = np.abs(first).max() <= 0.4
    is_better = (end <= sizes(missed) / 10).all()
    shows = end.min() >= 1e-4 and np.abs([*first, *missed, *again]).min() >= 5e-4
    return bool(is_small and is_better and shows)


def from_q(slip: DisplacementSlip) -> Function:
    """The wrong displacement from the tool frame at q."""
    return lambda arm, goal: slip.way(arm.T, goal)


def from_next_q(slip: DisplacementSlip) -> Function:
    """The wrong displacement from the tool frame at q + dq."""
    return lambda arm, dq, goal: slip.way(arm.at(arm.q + dq).T, goal)


@part(
    3,
    Numbers((6,), ["m"] * 3 + ["rad"] * 3, 6),
    shows={"T": lambda arm: arm.T, "turn": lambda arm, goal: goal[:3, :3] @ arm.R.T},
    mistakes=[(slip.sentence, from_q(slip)) for slip in (*AXES, *FIRST_ORDER)],
)
def du(arm: Arm, goal: Array) -> Array:
    r"""$d\mathbf u = (d\mathbf p, d\mathbf w)$ from the tool frame at your $\mathbf q$ to
    $\mathbf T_{desired}$

    - Where is the tool now? Multiply the transforms of the table.
    - Solve the equation that defines $\mathbf R(d\mathbf w)$ for it; this matrix minus its
      transpose holds the axis and the sine.

    The transforms of the table, multiplied, give the tool frame; its rotation transposed stands
    behind the desired one:
    $$\mathbf T = <T>$$

    $$\mathbf R(d\mathbf w) = \mathbf R_{desired}\,\mathbf R^T = <turn>$$

    Half the differences of its entries (3,2) - (2,3), (1,3) - (3,1), (2,1) - (1,2) are the axis
    times the sine of the angle. Divide by their length, the sine, and multiply with the angle;
    above it stands $d\mathbf p = \mathbf p_{desired} - \mathbf p$:
    $$d\mathbf u = <du>$$
    """
    return displacement(arm.T, goal)


@part(
    2,
    Numbers((6,), "rad", 6),
    shows={"J": lambda arm: arm.J},
    mistakes=(
        (TRANSPOSED, lambda arm, du: arm.J.T @ du),
        ("J is in tool axes, but du in base axes.", lambda arm, du: step(arm, du, "tool")),
    ),
)
def dq(arm: Arm, du: Array) -> Array:
    r"""The first step: $d\mathbf q$ with $\mathbf J(\mathbf q)\,d\mathbf q = d\mathbf u$

    - Six equations for six unknowns: a numerical solver does it once $\mathbf J$ is there.

    $\mathbf J$ is square and regular at your $\mathbf q$, so there is one solution:
    $$\mathbf J = <J>$$

    $$d\mathbf q = \mathbf J^{-1} d\mathbf u = <dq>$$
    """
    return step(arm, du)


@part(
    3,
    Numbers((6,), ["m"] * 3 + ["rad"] * 3, 6),
    shows={"T": lambda arm, dq: arm.at(arm.q + dq).T},
    mistakes=(
        (SOLVED, lambda: np.zeros(6)),
        (BACKWARDS, lambda arm, dq, goal: displacement(arm.at(arm.q - dq).T, goal)),
        *[(slip.sentence, from_next_q(slip)) for slip in AXES],
    ),
)
def rest(arm: Arm, dq: Array, goal: Array) -> Array:
    r"""The $d\mathbf u'$ that is still missing at $\mathbf q + d\mathbf q$, from the true tool
    frame there to $\mathbf T_{desired}$

    - Nothing new: as in the first question, at the new angles.

    $\mathbf J\,d\mathbf q = d\mathbf u$ misses about the square of the step. The tool frame at
    $\mathbf q + d\mathbf q$, and $d\mathbf u'$ from there:
    $$\mathbf T' = <T>$$

    $$d\mathbf u' = <rest>$$
    """
    return displacement(arm.at(arm.q + dq).T, goal)


@part(
    2,
    Numbers((6,), "rad", 6),
    mistakes=(
        (OLD_J, lambda rest, arm: step(arm, rest)),
        (TRANSPOSED, lambda arm, dq, rest: arm.at(arm.q + dq).J.T @ rest),
        (BOTH_STEPS, lambda dq, second: dq + second),
    ),
)
def second(arm: Arm, dq: Array, rest: Array) -> Array:
    r"""The second step: $d\mathbf q'$ with
    $\mathbf J(\mathbf q + d\mathbf q)\,d\mathbf q' = d\mathbf u'$

    - The Jacobian belongs to the posture from which the step is taken.

    Compute $\mathbf J$ anew at $\mathbf q + d\mathbf q$ and solve again:
    $$d\mathbf q' = <second>$$
    """
    return step(arm.at(arm.q + dq), rest)


def times(rest: Array, left: Array) -> str:
    """How much smaller distance and angle are after the second step."""
    distance, angle = sizes(rest) / left
    return f"{distance:.0f} and {angle:.0f} times"


@part(
    2,
    Numbers((2,), ["m", "rad"], 6),
    shows={"times": times},
    mistakes=(
        (FIRST_ALONE, lambda arm, dq, goal: sizes(rest(arm, dq, goal))),
        (FROM_Q, lambda arm, second, goal: sizes(rest(arm, second, goal))),
    ),
)
def left(arm: Arm, dq: Array, second: Array, goal: Array) -> Array:
    r"""Distance $|d\mathbf p|$ [m] and angle $|d\mathbf w|$ [rad] still missing after the second
    step; how much smaller are they?

    - As before at $\mathbf q + d\mathbf q + d\mathbf q'$, and then the lengths of the two halves.

    They are <times> smaller than after the first step: a step leaves about the square of what was
    missing, times a constant.
    $$(|d\mathbf p|, |d\mathbf w|) = <left>$$
    """
    return sizes(rest(arm, dq + second, goal))


CAPTION = "Your arm at your q, and the desired frame."
ALT = (
    "UR5 with its six revolute joints, drawn at your q with base and tool frame and, close to it, "
    "the desired frame."
)
EXERCISE = exercise(
    "desired_pose",
    title="Two steps to a desired tool frame",
    source="S0 4.3, eq. 4.13",
    minutes=50,
    objectives=(
        (
            "Find the way to a desired tool frame, the joint displacement for it, "
            "and what first order misses."
        ),
    ),
    robot=ROBOT,
    scale=1.0,
    units={"goal": [["1", "1", "1", "m"]] * 3 + [["1"] * 4]},
    symbols={"goal": r"\mathbf{T}_{desired}"},
    draw=draw,
    statement=lambda arm: f"{introduction(arm)}\n\n{TASK}",
    drawings=lambda arm, goal: arm.drawing(CAPTION, ALT, more={"desired": goal}),
    parts=(du, dq, rest, second, left),
)
