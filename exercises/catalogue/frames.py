"""S0 4.3 and S1 5.10: one Jacobian in three frames, and the 6 x 6 matrix that leads from one to another.

Toolboxes call them by different words, so that the sheet names each by its axes and its point. The twist that is to be
recognized carries no mark of the frame it was computed in.
"""

from itertools import combinations
from typing import Any

import numpy as np

from ...solutions.jacobian import at_point
from ..answers import LETTERS
from ..arm import Arm, Array, arm_of
from ..arms.rrpr import DEGREES, LENGTHS, LEVEL, SENSES, UNITS, described, drawn, in_degrees, level, posture, robot
from ..columns import LATE, TOOL_AXES, TURNING_SLIDE, all_turning, late, tool_axes, turning_slide
from ..draws import length, rates, until
from ..exercise import Choice, Numbers, Variant
from ..part import exercise, part

APART = 0.05  # between the largest components of the twists that are to be told apart
JACOBIAN = Numbers((6, 4), [["m/rad", "m/rad", "1", "m/rad"]] * 3 + [["1"] * 4] * 3)
FRAMES = tuple(f"in {axes} axes at the {point}" for point in ("tool point", "base origin") for axes in ("base", "tool"))


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 16 forms, a posture, rates, and the twist that comes of them in one of four frames."""
    sizes: dict[str, Any] = {"form": int(rng.integers(len(SENSES)))} | {name: length(rng) for name in LENGTHS}
    v = until(lambda: sizes | {"q": posture(rng), "qdot": rates(rng, 4)}, is_telling)
    xi = all_twists(v)[:, int(rng.integers(len(FRAMES)))]
    return v | {"xi": (np.round(xi, 3) + 0.0).tolist()}


def is_telling(v: Variant) -> bool:
    """Whether neither pose nor Jacobian is special, and the four twists are far apart."""
    arm = arm_of(robot(v["form"]), v)
    pairs = combinations(all_twists(v).T, 2)
    apart = min(np.abs(one - other).max() for one, other in pairs)
    return bool(np.abs(arm.p).min() >= 0.1 and np.abs(arm.R).max() <= 0.99 and apart >= APART)


def all_twists(v: Variant) -> Array:
    """The twist of the right Jacobians in the order of `FRAMES` (6, 4)."""
    arm = arm_of(robot(v["form"]), v)
    return twists(arm.T, arm.J, tool(arm.T, arm.J), origin(arm.T, arm.J), v["qdot"])


def twists(T: Array, J: Array, tool: Array, origin: Array, qdot: Array) -> Array:
    """The twist in each frame as columns (6, 4) in the order of `FRAMES`."""
    fourth = turn(T).T @ origin
    return np.column_stack([M @ qdot for M in (J, tool, origin, fourth)])


def turn(T: Array) -> Array:
    """The matrix (6, 6) from tool axes to base axes at the same point; its transpose leads back from a right pose."""
    return np.kron(np.eye(2), T[:3, :3])


def shift(T: Array, sign: int = 1) -> Array:
    """The matrix (6, 6) from the tool point to the base origin in base axes; with -1, as far the other way."""
    return at_point(np.eye(6), -sign * T[:3, 3])


TURNING = "Column 3 looks as if joint 3 were revolute; look again at its type."
WRONG_WAY = "The rotation is applied the wrong way round: R leads from tool axes to base axes."
LINEAR_ONLY = "Only the linear rows are turned; the angular ones have axes too."
TOOL_MOVED = "The axes are those of the tool, but the point has been moved as well; it stays the tool point."
MOVED = "The point has been moved as well; it stays the tool point."
WRONG_SIGN = "The shift has the wrong sign: how does one get from the tool point to the origin?"
NEITHER = "This is in tool axes at the tool point; base axes at the base origin are asked."
NOT_BASE = "The shift p is known in base axes; start from the Jacobian in base axes, not from the one in tool axes."
ORDER = "The shift is multiplied in the wrong order: p is known in base axes, so turn first, then shift."
THIS_ARM = "This holds for the twists that your joints can give, but not for every twist; build it from R and p alone."
COUPLING = "The upper right block: the angular velocity comes in tool axes, too, before the shift meets it."
ANGULAR = "The blocks are in the order of twists with the angular velocity first; here the linear one comes first."


@part(
    2,
    Numbers((4, 4), [["1", "1", "1", "m"]] * 3 + [["1"] * 4]),
    shows={"tip": lambda arm: arm.closed.T[:3, 3]},
    mistakes=(
        ("This is the base frame seen from the tool, the inverse of the asked pose.", lambda arm: np.linalg.inv(arm.T)),
        (LEVEL, lambda form, arm: level(form, arm).T),
        (DEGREES, lambda form, arm: in_degrees(form, arm).T),
    ),
)
def T(arm: Arm) -> Array:
    r"""The pose $\mathbf T_0^4$ of the tool frame in the base frame at your $\mathbf q$

    - Multiply the four transforms of the table from left to right.

    $\mathbf T_0^4 = \mathbf T_0^1 \mathbf T_1^2 \mathbf T_2^3 \mathbf T_3^4$, one row of the table after the other; its
    columns are the axes of the tool frame ($\mathbf R$) and the tool point ($\mathbf p$), in base coordinates. The tool
    point in closed form:
    $$\mathbf p = <tip>$$

    With your numbers:
    $$\mathbf T_0^4 = <T>$$
    """
    return arm.T


@part(
    3,
    JACOBIAN,
    mistakes=(
        (LATE, lambda arm: late(arm.frames, arm.kinds)),
        (TOOL_AXES, lambda arm: tool_axes(arm.frames, arm.kinds)),
        ("This is at the base origin; the tool point is asked.", lambda arm: shift(arm.T) @ arm.J),
        (TURNING, lambda arm: all_turning(arm.frames, arm.kinds)),
        (TURNING_SLIDE, lambda arm: turning_slide(arm.frames, arm.kinds)),
        (LEVEL, lambda form, arm: level(form, arm).J),
        (DEGREES, lambda form, arm: in_degrees(form, arm).J),
    ),
)
def J(arm: Arm) -> Array:
    r"""The 6 × 4 Jacobian in base axes at the tool point, linear rows above angular rows

    - The lever arm of a revolute joint ends at the tool point.
    - Joint 3 slides.

    A revolute column is $\mathbf z_{i-1} \times (\mathbf p - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$, the prismatic one
    $\mathbf z_2$ above zeros. Axes and lever arms are those of base coordinates:
    $$\mathbf J = <J>$$
    """
    return arm.J


@part(
    2,
    JACOBIAN,
    mistakes=(
        ("This is in base axes; tool axes are asked.", lambda J: J),
        (WRONG_WAY, lambda T, J: turn(T) @ J),
        (LINEAR_ONLY, lambda J, tool: np.concatenate([tool[:3], J[3:]])),
        (TOOL_MOVED, lambda T, J: turn(T).T @ shift(T) @ J),
        (MOVED, lambda T, J: turn(T).T @ shift(T, -1) @ J),
        (MOVED, lambda T, tool: shift(T) @ tool),
        (LEVEL, lambda form, arm: tool_axes(level(form, arm).frames, arm.kinds)),
    ),
)
def tool(T: Array, J: Array) -> Array:
    r"""The 6 × 4 Jacobian in tool axes at the tool point, linear rows above angular rows

    - Which way does R lead, and which way do you go?
    - The point does not change.

    The point stays, the axes change: $\mathbf v_{tool} = \mathbf R^T \mathbf v$ and
    $\boldsymbol\omega_{tool} = \mathbf R^T \boldsymbol\omega$, because $\mathbf R$ leads from tool axes to base axes. Both
    blocks turn alike:
    $$\begin{bmatrix}\mathbf R^T & \mathbf 0\\ \mathbf 0 & \mathbf R^T\end{bmatrix} \mathbf J = <tool>$$
    """
    return turn(T).T @ J


@part(
    2,
    JACOBIAN,
    mistakes=(
        (WRONG_SIGN, lambda T, J: shift(T, -1) @ J),
        ("This is at the tool point; the base origin is asked.", lambda J: J),
        (NEITHER, lambda T, J: turn(T).T @ J),
        ("This is in tool axes; base axes are asked.", lambda T, origin: turn(T).T @ origin),
        (NOT_BASE, lambda T, J: shift(T) @ turn(T).T @ J),
    ),
)
def origin(T: Array, J: Array) -> Array:
    r"""The 6 × 4 Jacobian in base axes at the base origin, linear rows above angular rows

    - How do the velocities of two points of one body differ?
    - The angular rows are those of every point.

    The axes stay, the point changes. The point of the body at the base origin lies $-\mathbf p$ from the tool point, so its
    velocity is $\mathbf v + \boldsymbol\omega \times (-\mathbf p) = \mathbf v + \mathbf p \times \boldsymbol\omega$;
    $\boldsymbol\omega$ is the same for every point:
    $$\begin{bmatrix}\mathbf 1 & S(\mathbf p)\\ \mathbf 0 & \mathbf 1\end{bmatrix} \mathbf J = <origin>$$
    """
    return shift(T) @ J


@part(
    3,
    Numbers((6, 6), [["1"] * 3 + ["m"] * 3] * 3 + [["1"] * 6] * 3),
    mistakes=(
        ("This leads the other way, from the base origin to the tool.", lambda T: turn(T).T @ shift(T, -1)),
        ("This turns the axes but does not move the point.", turn),
        ("The shift has the wrong sign.", lambda T: shift(T, -1) @ turn(T)),
        (ORDER, lambda T: turn(T) @ shift(T)),
        (THIS_ARM, lambda arm, T: shift(T) @ arm.J @ np.linalg.pinv(turn(T).T @ arm.J)),
        (WRONG_WAY, lambda T: shift(T) @ turn(T).T),
        (WRONG_WAY, lambda T, X: X - turn(T) + turn(T).T),
        (COUPLING, lambda T: turn(T) + shift(T) - np.eye(6)),
        (ANGULAR, lambda X: np.roll(X, 3, axis=(0, 1))),
    ),
)
def X(T: Array) -> Array:
    r"""The 6 × 6 matrix $\mathbf X$ that turns every twist of the tool body (linear above angular), given in tool axes at the
    tool point, into the same twist in base axes at the base origin; it holds for every twist, not only for those the joints
    can give

    - Two steps: turn the axes, then move the point.
    - A cross product with p is a skew-symmetric matrix S(p).

    First turn to base axes with $\begin{bmatrix}\mathbf R & \mathbf 0\\ \mathbf 0 & \mathbf R\end{bmatrix}$, then shift the
    point with $\begin{bmatrix}\mathbf 1 & S(\mathbf p)\\ \mathbf 0 & \mathbf 1\end{bmatrix}$: the second matrix stands on
    the left, and the product is
    $$\mathbf X = \begin{bmatrix}\mathbf R & S(\mathbf p) \mathbf R\\ \mathbf 0 & \mathbf R\end{bmatrix} = <X>$$
    """
    return shift(T) @ turn(T)


@part(1, Choice(FRAMES), shows={"frame": lambda which: FRAMES[LETTERS.index(which)], "twists": twists})
def which(T: Array, J: Array, tool: Array, origin: Array, qdot: Array, xi: Array) -> str:
    r"""In which frame is the printed twist $\boldsymbol\xi$ of the tool body?

    - Compare the angular velocities first.
    - A Jacobian times the rates is a twist in the same frame.

    Multiply each Jacobian with the rates and compare. The angular velocity tells base axes from tool axes; the linear
    velocity tells the points apart. Your twist is <frame>. The four twists, one in each column:
    $$\left[\boldsymbol\xi_a\; \boldsymbol\xi_b\; \boldsymbol\xi_c\; \boldsymbol\xi_d\right] = <twists>$$
    """
    misses = np.linalg.norm(twists(T, J, tool, origin, qdot) - xi[:, None], axis=0)
    return LETTERS[int(np.argmin(misses))]


def statement(arm: Arm) -> str:
    return rf"""{described(arm)}

The same motion has a different Jacobian in each frame, and toolboxes print different ones without saying so. A frame is
named here by its **axes**, along which the components are taken, and by its **point**: the linear velocity is that of the point
of the tool body which is at that place now, where the body is imagined to be as large as needed.

- **base axes, tool point**: `jacob0` of roboticstoolbox, LOCAL_WORLD_ALIGNED of Pinocchio
- **tool axes, tool point**: `jacobe`, `jacobn` of roboticstoolbox, LOCAL of Pinocchio
- **base axes, base origin**: WORLD of Pinocchio

In the last question $\boldsymbol\xi$ (linear above angular) is the twist that some toolbox printed for the joint rates $\dot{{\mathbf q}}$."""


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
    parts=(T, J, tool, origin, X, which),
)
