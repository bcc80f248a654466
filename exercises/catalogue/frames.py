"""S0 4.3 and S1 5.10: one Jacobian in three frames, and the matrix from one of them to another.

Toolboxes call them by different words, so that the sheet names each by its axes and its point. The
twist that is to be recognized carries no mark of the frame it was computed in.
"""

from itertools import combinations
from typing import Any

import numpy as np

from .. import questions as ask
from ..answers import LETTERS
from ..arm import Arm, Array, arm_of
from ..arms.rrpr import (
    DEGREES,
    LENGTHS,
    LEVEL,
    SENSES,
    UNITS,
    described,
    drawn,
    in_degrees,
    level,
    posture,
    robot,
)
from ..calculations.columns import tool_axes
from ..calculations.conversions import (
    ANGULAR,
    COUPLING,
    ONLY_TURNED,
    ORDER,
    OTHER_WAY,
    SHIFT_SIGN,
    THIS_ARM,
    WRONG_WAY,
    shift,
    turn,
)
from ..draws import length, rates, until
from ..exercise import Choice, Numbers, Variant
from ..part import exercise, part

APART = 0.05  # between the largest components of the twists that are to be told apart
FRAMES = (
    "in base axes at the tool point",
    "in tool axes at the tool point",
    "in base axes at the base origin",
    "in tool axes at the base origin",
)
BLOCKS = r"\begin{bmatrix}\mathbf R & S(\mathbf p) \mathbf R\\ \mathbf 0 & \mathbf R\end{bmatrix}"


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 16 forms, a posture, rates, and their twist in one of four frames."""
    sizes: dict[str, Any] = {"form": int(rng.integers(len(SENSES)))}
    for name in LENGTHS:
        sizes[name] = length(rng)
    v = until(lambda: sizes | {"q": posture(rng), "qdot": rates(rng, 4)}, is_telling)
    xi = all_twists(v)[:, int(rng.integers(len(FRAMES)))]
    return v | {"xi": (np.round(xi, 3) + 0.0).tolist()}


def is_telling(v: Variant) -> bool:
    """Whether neither pose nor Jacobian is special, and the four twists are far apart."""
    arm = arm_of(robot(v["form"]), v)
    if np.abs(arm.p).min() < 0.1 or np.abs(arm.R).max() > 0.99:
        return False
    pairs = combinations(all_twists(v).T, 2)
    apart = [np.abs(one - other).max() for one, other in pairs]
    return min(apart) >= APART


def all_twists(v: Variant) -> Array:
    """The twist of the right Jacobians in the order of `FRAMES` (6, 4)."""
    arm = arm_of(robot(v["form"]), v)
    return twists(arm.T, arm.J, turn(arm.T).T @ arm.J, shift(arm.T) @ arm.J, v["qdot"])


def twists(T: Array, J: Array, tool: Array, origin: Array, qdot: Array) -> Array:
    """The twist in each frame as columns (6, 4) in the order of `FRAMES`."""
    fourth = turn(T).T @ origin
    return np.column_stack([J @ qdot, tool @ qdot, origin @ qdot, fourth @ qdot])


@part(
    3,
    Numbers((6, 6), [["1"] * 3 + ["m"] * 3] * 3 + [["1"] * 6] * 3),
    mistakes=(
        (OTHER_WAY, lambda T: turn(T).T @ shift(T, -1)),
        (ONLY_TURNED, turn),
        (SHIFT_SIGN, lambda T: shift(T, -1) @ turn(T)),
        (ORDER, lambda T: turn(T) @ shift(T)),
        (THIS_ARM, lambda arm, T: shift(T) @ arm.J @ np.linalg.pinv(turn(T).T @ arm.J)),
        (WRONG_WAY, lambda T: shift(T) @ turn(T).T),
        (WRONG_WAY, lambda T, X: X - turn(T) + turn(T).T),
        (COUPLING, lambda T: turn(T) + shift(T) - np.eye(6)),
        (ANGULAR, lambda X: np.roll(X, 3, axis=(0, 1))),
    ),
    shows={"blocks": lambda: BLOCKS},
)
def X(T: Array) -> Array:
    r"""The 6 × 6 matrix $\mathbf X$ that turns every twist of the tool body (linear above angular),
    given in tool axes at the tool point, into the same twist in base axes at the base origin; it
    holds for every twist, not only for those the joints can give

    - Two steps: turn the axes, then move the point.
    - A cross product with p is a skew-symmetric matrix S(p).

    First turn to base axes with
    $\begin{bmatrix}\mathbf R & \mathbf 0\\ \mathbf 0 & \mathbf R\end{bmatrix}$, then shift the
    point with $\begin{bmatrix}\mathbf 1 & S(\mathbf p)\\ \mathbf 0 & \mathbf 1\end{bmatrix}$: the
    second matrix stands on the left, and the product is
    $$\mathbf X = <blocks> = <X>$$
    """
    return shift(T) @ turn(T)


@part(
    1,
    Choice(FRAMES),
    shows={
        "frame": lambda which: FRAMES[LETTERS.index(which)],
        "names": lambda: (
            r"\boldsymbol\xi_a\; \boldsymbol\xi_b\; \boldsymbol\xi_c\; \boldsymbol\xi_d"
        ),
        "twists": twists,
    },
)
def which(T: Array, J: Array, tool: Array, origin: Array, qdot: Array, xi: Array) -> str:
    r"""In which frame is the printed twist $\boldsymbol\xi$ of the tool body?

    - Compare the angular velocities first.
    - A Jacobian times the rates is a twist in the same frame.

    Multiply each Jacobian with the rates and compare. The angular velocity tells base axes from
    tool axes; the linear velocity tells the points apart. Your twist is <frame>. The four twists,
    one in each column:
    $$\left[<names>\right] = <twists>$$
    """
    misses = np.linalg.norm(twists(T, J, tool, origin, qdot) - xi[:, None], axis=0)
    return LETTERS[int(np.argmin(misses))]


def statement(arm: Arm) -> str:
    """The arm, and how a frame is named."""
    return rf"""{described(arm)}

The same motion has a different Jacobian in each frame, and toolboxes print different ones without
saying so. A frame is named here by its **axes**, along which the components are taken, and by its
**point**: the linear velocity is that of the point of the tool body which is at that place now,
where the body is imagined to be as large as needed.

- **base axes, tool point**: `jacob0` of roboticstoolbox, LOCAL_WORLD_ALIGNED of Pinocchio
- **tool axes, tool point**: `jacobe`, `jacobn` of roboticstoolbox, LOCAL of Pinocchio
- **base axes, base origin**: WORLD of Pinocchio

In the last question $\boldsymbol\xi$ (linear above angular) is the twist that some toolbox printed
for the joint rates $\dot{{\mathbf q}}$."""


EXERCISE = exercise(
    "frames",
    title="One Jacobian in three frames",
    source="S0 4.3, S1 5.10",
    minutes=50,
    objectives=(
        "Say of a Jacobian in which axes and at which point it is.",
        "Lead it from one frame to another by a rotation and a shift.",
    ),
    robot=robot,
    units={**UNITS, "qdot": ["rad/s", "rad/s", "m/s", "rad/s"], "xi": ["m/s"] * 3 + ["rad/s"] * 3},
    symbols={"qdot": r"\dot{\mathbf{q}}"},
    structure=("form",),
    draw=draw,
    statement=statement,
    drawings=drawn,
    scale=lambda d1, a2, a4: d1 + a2 + a4,
    parts=(
        ask.pose(
            mistakes=[
                (LEVEL, lambda form, arm: level(form, arm).T),
                (DEGREES, lambda form, arm: in_degrees(form, arm).T),
            ]
        ),
        ask.jacobian(
            points=3,
            decimals=4,
            mistakes=[
                (LEVEL, lambda form, arm: level(form, arm).J),
                (DEGREES, lambda form, arm: in_degrees(form, arm).J),
            ],
        ),
        ask.to_tool_axes(
            name="tool",
            decimals=4,
            mistakes=[(LEVEL, lambda form, arm: tool_axes(level(form, arm).frames, arm.kinds))],
        ),
        ask.to_base_origin(name="origin", decimals=4),
        X,
        which,
    ),
)
