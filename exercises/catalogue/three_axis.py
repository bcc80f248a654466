"""S0 4.3.1: the Jacobian of a 3-axis robot, from frames placed on the joint axes."""

from typing import Any

import numpy as np

from ...solutions.expression import parse
from ...solutions.robots import ROBOTS
from ..answers import Numbers
from ..arm import Arm, Array, arm_of
from ..drawing import Drawing
from ..draws import angles, length, until
from ..part import exercise, part

ROBOT = ROBOTS["three_axis"]
WISHED = np.array([0.01, 0.012, -0.013])  # S0's own dp, on sheets handed out before it was drawn
TRANSPOSED = "The transposed block is no inverse: a linear system is to be solved."
MULTIPLIED = (
    "The displacement of the tool point is multiplied by A; which side of A dq = dp is known?"
)
HELD = "This is a least-squares answer with all six rows and dw = 0; here the rotation is free."
ROWS_OF_B = "Rows and columns of B are exchanged: its columns are the joint axes."
IN_TOOL_AXES = "This is the rotation in the axes of the tool frame; base axes are asked."
TRUE_WAY = "This is the true displacement itself; how far is it from the wished one?"
SOLVED = "A dq - dp is zero because dq solves it; the true tool point at q + dq is asked."
MISSED = r"\mathbf p^{tool}(\mathbf q + d\mathbf q) - \mathbf p^{tool}(\mathbf q) - d\mathbf p"

STATEMENT = r"""All three joints of this robot are revolute. Frame $i$ sits on the axis of joint
$i$, with $\mathbf z^{i}$ along the axis:

$$\mathbf T_{base}^{1} = T_z(L)\,R_z(q_1), \quad \mathbf T_1^2 = R_x(90°)\,R_z(q_2), \quad
\mathbf T_2^3 = T_y(a_2)\,R_z(q_3), \quad \mathbf T_3^{tool} = T_x(a_3).$$

$T_x, T_y, T_z$ move along and $R_x, R_z$ turn about an axis of the current frame. Give all vectors
in the base frame.

For a small joint displacement $d\mathbf q$ the tool point moves, to first order, by
$d\mathbf p = \mathbf A\,d\mathbf q$ and the tool frame turns by
$d\mathbf w = \mathbf B\,d\mathbf q$; the Jacobian $\mathbf J$ stacks $\mathbf A$ above $\mathbf B$.

The wished displacement of the tool point is $d\mathbf p$. With it
$\mathbf J\,d\mathbf q = d\mathbf u$ would be six equations for three unknowns, which in general
contradict each other: only three of them can be prescribed."""


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A regular arm, and a displacement that first order meets to a few per cent."""

    def lengths_and_q() -> dict[str, Any]:
        lengths = {name: length(rng) for name in ("L", "a2", "a3")}
        return {**lengths, "q": angles(rng, 3, [(1, 2)])}

    v = until(lengths_and_q, is_regular)
    arm = arm_of(ROBOT, v)
    return v | {"dp": until(lambda: small(rng), lambda dp: is_telling(arm, np.array(dp)))}


def is_regular(v: dict[str, Any]) -> bool:
    """Whether the arm is neither stretched or folded, nor the tool near axis 1."""
    _, q2, q3 = v["q"]
    radius = v["a3"] * np.cos(q2 + q3) - v["a2"] * np.sin(q2)
    return bool(abs(np.cos(q3)) > 0.3 and abs(radius) > 0.2)


def small(rng: np.random.Generator) -> list[float]:
    """Three components [m] with three decimals, |dp| about 0.03."""
    millimetres = rng.integers(12, 26, 3) * rng.choice([-1, 1], 3)
    return np.round(millimetres / 1000, 3).tolist()


def is_telling(arm: Arm, dp: Array) -> bool:
    """Whether dq is small, every joint takes part, and every component of the error shows."""
    dq = np.linalg.solve(arm.J[:3], dp)
    missed = error(arm, dq, dp)
    if not 0.026 <= np.linalg.norm(dp) <= 0.036 or np.abs(dq).max() > 0.15:
        return False

    turns = np.abs([*dq, dq[1] + dq[2]])  # joints 2 and 3 turn about one axis
    takes_part = turns.min() >= 0.002
    shows = np.abs(missed).min() >= 2e-5 and np.linalg.norm(missed) <= 0.004
    return bool(takes_part and shows)


@part(3, Numbers((3, 4), "m", 3), shows={"tip": lambda arm: arm.closed.T[:3, 3]})
def p(arm: Arm) -> Array:
    r"""The origins $\mathbf p^1, \mathbf p^2, \mathbf p^3$ and the tool point $\mathbf p^{tool}$,
    as the four columns of a 3 × 4 matrix

    - The origin of a frame is the last column of its transform.
    - Which frames share an origin?

    Multiply the transforms up to frame $i$: $\mathbf T_{base}^{i} =
    \mathbf T_{base}^{1} \mathbf T_1^2 \cdots \mathbf T_{i-1}^{i}$. Its last column is
    $\mathbf p_{base}^{i}$. The tool point in closed form:
    $$\mathbf p_{base}^{tool} = <tip>$$

    With your numbers, the columns are $\mathbf p^1, \mathbf p^2, \mathbf p^3, \mathbf p^{tool}$.
    Frames 1 and 2 share their origin, because $\mathbf T_1^2$ only turns.
    $$\left[\mathbf p^1\; \mathbf p^2\; \mathbf p^3\; \mathbf p^{tool}\right] = <p>$$
    """
    return arm.frames[:, :3, 3].T


@part(2, Numbers((3, 3), "1", 3), shows={"z2": lambda arm: arm.closed.frames[1][:3, 2]})
def z(arm: Arm) -> Array:
    r"""The joint axes $\mathbf z^1, \mathbf z^2, \mathbf z^3$, as the columns of a 3 × 3 matrix

    - The axis is the third column of the rotation.
    - Axes 2 and 3 are parallel.

    $\mathbf z_{base}^{i}$ is the third column of the rotation in $\mathbf T_{base}^{i}$. Axes 2 and
    3 are parallel, since $\mathbf T_2^3$ turns about $\mathbf z$ only:
    $$\mathbf z^2 = \mathbf z^3 = <z2>$$

    With your numbers:
    $$\left[\mathbf z^1\; \mathbf z^2\; \mathbf z^3\right] = <z>$$
    """
    return arm.axes


@part(3, Numbers((3, 3), "m/rad", 4), shows={"closed": lambda arm: arm.closed.J[:3, :]})
def A(p: Array, z: Array) -> Array:
    r"""The 3 × 3 block $\mathbf A$ of the positional displacements at your $\mathbf q$

    - The lever arm goes from the joint to the tool point.
    - The order of a cross product decides its sign.

    All joints are revolute, $\xi_i = 1$, so column $i$ of $\mathbf A$ is
    $\mathbf z^{i} \times (\mathbf p^{tool} - \mathbf p^{i})$. In closed form:
    $$\mathbf A = <closed>$$

    With your numbers:
    $$\mathbf A = <A>$$
    """
    return np.cross(z, p[:, 3:] - p[:, :3], axis=0)


@part(1, Numbers((3, 3), "1", 3), follow=0)  # it repeats z; whoever has z wrong has this wrong
def B(z: Array) -> Array:
    r"""The 3 × 3 block $\mathbf B$ of the angular displacements at your $\mathbf q$

    - A revolute joint turns the tool about its own axis.

    Column $i$ of $\mathbf B$ is $\xi_i \mathbf z^{i} = \mathbf z^{i}$. With your numbers:
    $$\mathbf B = <B>$$
    """
    return z


@part(1, Numbers((6, 3), [["m/rad"]] * 3 + [["1"]] * 3, 3))
def J(A: Array, B: Array) -> Array:
    r"""The 6 × 3 Jacobian $\mathbf J$, linear rows above angular rows

    - Nothing is left to compute.

    The linear rows stand above the angular ones:
    $$\mathbf J = \begin{bmatrix}\mathbf A\\ \mathbf B\end{bmatrix} = <J>$$
    """
    return np.concatenate([A, B])


def held_rotation(arm: Arm, A: Array, dp: Array = WISHED) -> Array:
    """The least-squares answer to J dq = (dp, 0)."""
    return np.linalg.lstsq(np.concatenate([A, arm.J[3:]]), np.append(dp, np.zeros(3)))[0]


@part(
    2,
    Numbers((3,), "rad", 6),
    shows={
        "det": lambda: parse(ROBOT.determinant, ROBOT.names),
        "size": lambda A: f"{np.linalg.det(A):.3f}",
    },
    mistakes=(
        (TRANSPOSED, lambda A, dp=WISHED: A.T @ dp),
        (MULTIPLIED, lambda A, dp=WISHED: A @ dp),
        (HELD, held_rotation),
    ),
)
def dq(A: Array, dp: Array = WISHED) -> Array:
    r"""The joint displacement $d\mathbf q$ with $\mathbf A\,d\mathbf q = d\mathbf p$ for your
    $d\mathbf p$, whatever rotation comes along

    - Three equations for three unknowns.
    - The rotation of the tool is not prescribed.

    $\mathbf A$ is square, and regular at your $\mathbf q$: its determinant is the product below,
    for you <size>. So $d\mathbf q = \mathbf A^{-1} d\mathbf p$ is the only solution of
    $\mathbf A\,d\mathbf q = d\mathbf p$.
    $$\det \mathbf A = <det>$$

    With your numbers:
    $$d\mathbf q = <dq>$$
    """
    # A student's own block may be singular, which solve() would not notice.
    return np.linalg.lstsq(A, dp, rcond=1e-9)[0]


@part(
    1,
    Numbers((3,), "rad", 6),
    mistakes=(
        (ROWS_OF_B, lambda B, dq: B.T @ dq),
        (IN_TOOL_AXES, lambda arm, B, dq: arm.R.T @ B @ dq),
    ),
)
def dw(B: Array, dq: Array) -> Array:
    r"""The rotation $d\mathbf w = \mathbf B\,d\mathbf q$ that comes along with it

    - Every joint turns the tool about its own axis; small rotations add.

    $d\mathbf w = \mathbf B\,d\mathbf q = \mathbf z^1 dq_1 + \mathbf z^2 (dq_2 + dq_3)$. Nobody
    asked for it: $d\mathbf p$ alone fixes the three $dq_i$. That is why
    $\mathbf J\,d\mathbf q = d\mathbf u$, six equations for three unknowns, has in general no
    solution: it has one only if the wished $d\mathbf w$ is this one:
    $$d\mathbf w = <dw>$$
    """
    return B @ dq


@part(
    2,
    Numbers((3,), "m", 7),
    mistakes=(
        (TRUE_WAY, lambda arm, dq: arm.at(arm.q + dq).p - arm.p),
        (SOLVED, lambda: np.zeros(3)),
    ),
    shows={"missed": lambda: MISSED},
)
def error(arm: Arm, dq: Array, dp: Array = WISHED) -> Array:
    r"""How far first order misses:
    $\mathbf p^{tool}(\mathbf q + d\mathbf q) - \mathbf p^{tool}(\mathbf q) - d\mathbf p$ with the
    true tool point of both postures, in metres, from $d\mathbf q$ with all its digits

    - Compute the tool point a second time, at the new angles.
    - Expect well under a few millimetres.

    Multiply the transforms once more at $\mathbf q + d\mathbf q$.
    $d\mathbf p = \mathbf A\,d\mathbf q$ holds to first order: what is missed grows with the square
    of $d\mathbf q$. With your numbers:
    $$<missed> = <error>$$
    """
    return arm.at(arm.q + dq).p - arm.p - dp


def drawings(arm: Arm) -> Drawing:
    """The arm with its three lengths."""
    shoulder, elbow, hand = (pose[:3, 3] for pose in arm.frames[1:])
    return arm.drawing(
        "Your 3-axis robot at your q.",
        (
            "Arm with three revolute joints: axis 1 vertical, axes 2 and 3 horizontal and "
            "parallel, drawn at your q."
        ),
        base="base",
        lengths={"L": (np.zeros(3), shoulder), "a2": (shoulder, elbow), "a3": (elbow, hand)},
    )


EXERCISE = exercise(
    "three_axis",
    title="Jacobian of a 3-axis robot",
    source="S0 4.3.1",
    minutes=55,
    objectives=(
        "Find origins and joint axes of frames by multiplying transforms.",
        "Build the Jacobian column by column from axes and origins.",
        (
            "Find the joint displacement for a small displacement of the tool point, "
            "and see what comes along and what is missed."
        ),
    ),
    robot=ROBOT,
    units={"dp": ["m"] * 3},
    symbols={"dp": r"d\mathbf{p}"},
    draw=draw,
    statement=STATEMENT,
    drawings=drawings,
    parts=(p, z, A, B, J, dq, dw, error),
)
