"""S0 4.9 to 4.11: the rotation vector between two close frames, and the rows of the Jacobian that give it to first order.

The senses of the axes are drawn. The rotations are printed to six decimals; the angles are such that the
second order, which S0's eq. 4.11 leaves out, is larger than the tolerance.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..answers import LETTERS
from ..arm import Arm, Array, arm_of
from ..arms.rrpr import LENGTHS, SENSES, UNITS, described, drawn, posture, robot
from ..columns import LATE, late, right
from ..draws import length, until
from ..exercise import Choice, Numbers, Outcome, Variant
from ..part import exercise, part
from ..properties import turned

DIVISORS = (2, 4, 10)
FACTORS = (2, 4, 8, 10, 16, 64, 100, 1000)  # the divisors, their squares and cubes
TOLERANCE = 5e-4  # rad; below it, first order and the rotation vector would be the same
APART = 1e-3


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 16 forms, a posture and a displacement whose second order shows."""
    form = int(rng.integers(len(SENSES)))
    v: dict[str, Any] = {"form": form, "k": DIVISORS[int(rng.integers(len(DIVISORS)))]}
    v |= {name: length(rng, 0.2, 0.6) for name in LENGTHS}
    return until(lambda: v | motion(rng, form), is_telling)


def motion(rng: np.random.Generator, form: int) -> dict[str, Any]:
    """Posture, displacement, and the rotations before and after it, to six decimals."""
    q = posture(rng)
    dq = [round(float(x) / 1000, 3) for x in rng.integers(35, 71, 4) * rng.choice([-1, 1], 4)]
    first, second = (np.round(rotation_at(form, at), 6) + 0.0 for at in (q, np.add(q, dq)))
    return {"q": q, "dq": dq, "R1": first.tolist(), "R2": second.tolist()}


def rotation_at(form: int, q: ArrayLike) -> Array:
    """Rotation (3, 3) of the tool frame; lengths do not matter for it."""
    return robot(form).frames(None, q)[-1, :3, :3]


def is_telling(v: Variant) -> bool:
    """Whether all components matter, what first order misses is nearly all second order, and mistakes show."""
    arm, R1, R2, k = arm_of(robot(v["form"]), v), np.array(v["R1"]), np.array(v["R2"]), v["k"]
    exact, first_order = rotation_vector(R2 @ R1.T), B(arm) @ v["dq"]
    after = rotation_at(v["form"], arm.q + np.array(v["dq"]) / k)
    ratio = np.linalg.norm(exact - first_order) / np.linalg.norm(rotation_vector(after @ arm.R.T) - first_order / k)
    others = [first_order, *(wrong(R1, R2) for _, wrong in MISREAD)]
    matters = np.abs([exact, first_order]).min() >= 0.008 and np.linalg.norm(exact) <= 0.14
    shows = min(np.abs(other - exact).max() for other in others) >= APART
    return bool(matters and shows and abs(ratio / k**2 - 1) <= 0.12)


def opposite(R: Array) -> Array:
    """Differences of opposite entries: twice the axis of a rotation times the sine of its angle."""
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])


def rotation_vector(R: Array) -> Array:
    """Axis times angle of a rotation of less than a quarter turn, also where R is rounded."""
    w = 0.5 * opposite(R)
    sine = float(np.linalg.norm(w))
    return w * (np.arcsin(min(sine, 1.0)) / sine)


def roll_pitch_yaw(R: Array) -> Array:
    """Angles about fixed x, y, z, also where R is rounded."""
    pitch = np.arctan2(-R[2, 0], np.hypot(R[2, 1], R[2, 2]))
    return np.array([np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])])


TOOL_AXES = "This is the rotation vector in axes of the tool frame; on which side of R1 does R(dw) stand?"
BACK = "This is the rotation vector of R2^T R1, the way back and in axes of the tool frame; which product is R(dw)?"
TWICE = "It is twice too long: each difference of opposite entries counts half."
DIFFERENCES = "These are differences of roll, pitch and yaw angles; in space no three angles have dw as their changes."
ANGLES = "These are roll, pitch and yaw of R2 R1^T: that is the rotation vector to first order only."
ENTRIES = "Each component seems to be read off one entry of R2 R1^T; the opposite entry counts as well."
FIRST_ORDER = "This is B dq, the rotation to first order; dw between the printed rotations is asked."
MISREAD = (
    (TOOL_AXES, lambda R1, R2: rotation_vector(R1.T @ R2)),
    (BACK, lambda R1, R2: rotation_vector(R2.T @ R1)),
    (TWICE, lambda R1, R2: opposite(R2 @ R1.T)),
    (TWICE, lambda R1, R2: 2 * rotation_vector(R2 @ R1.T)),
    (DIFFERENCES, lambda R1, R2: turned(roll_pitch_yaw(R2) - roll_pitch_yaw(R1))),
    (ANGLES, lambda R1, R2: roll_pitch_yaw(R2 @ R1.T)),
    (ENTRIES, lambda R1, R2: (R2 @ R1.T)[[2, 0, 1], [1, 2, 0]]),
)


def the_way_back(dw: Array, value: Array) -> Outcome | None:
    """Says that an answer turns from frame 2 to frame 1; right and wrong stay with the tolerance."""
    said = "This is the rotation vector of R1 R2^T, which turns from frame 2 back to frame 1."
    return Outcome(reading=said) if np.abs(value + dw).max() <= TOLERANCE else None


@part(
    3,
    Numbers((3,), "rad"),
    credit="all",
    tolerance=TOLERANCE,
    check=the_way_back,
    shows={"R": lambda R1, R2: R2 @ R1.T},
    mistakes=[*MISREAD, (FIRST_ORDER, lambda arm, dq: B(arm) @ dq)],
)
def dw(R1: Array, R2: Array) -> Array:
    r"""The rotation vector $d\mathbf w$ in base axes with $\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$, from the printed rotations

    - Which product of the two matrices is R(dw)?
    - A rotation minus its transpose holds the axis times the sine of the angle, twice.

    $\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$ gives $\mathbf R(d\mathbf w) = \mathbf R_2 \mathbf R_1^T$ with $d\mathbf w$
    in base axes; $\mathbf R_1^T \mathbf R_2$ would have it in tool axes.
    $$\mathbf R_2 \mathbf R_1^T = <R>$$

    Half the differences of opposite entries, $\frac{1}{2}(R_{32} - R_{23},\; R_{13} - R_{31},\; R_{21} - R_{12})$, are the
    axis times the sine of the angle; dividing by the sine and multiplying with the angle changes so little here that both
    pass:
    $$d\mathbf w = <dw>$$
    """
    return rotation_vector(R2 @ R1.T)


@part(
    2,
    Numbers((3, 4), "1", 3),
    shows={"closed": lambda arm: arm.closed.J[3:, :]},
    mistakes=(
        ("The prismatic joint has its axis as an angular column; does a slide turn the tool?", lambda arm: arm.axes),
        (LATE, lambda arm: late(arm.frames, arm.kinds)[3:]),
        ("This is the block in axes of the tool frame; base axes are asked.", lambda arm, B: arm.R.T @ B),
    ),
)
def B(arm: Arm) -> Array:
    r"""The 3 × 4 block $\mathbf B$ of the angular rows of the Jacobian at your $\mathbf q$, in base axes

    - Only directions matter, no lengths.
    - What does a slide contribute to the rotation?

    Column $i$ of $\mathbf B$ is $\xi_i \mathbf z_{i-1}$ in the standard convention: the axis of a revolute joint, and zero
    for the prismatic one. In closed form:
    $$\mathbf B = <closed>$$

    With your numbers:
    $$\mathbf B = <B>$$
    """
    return right(arm.frames, arm.kinds)[3:]


EXACT = "This is dw between the printed rotations; the first order B dq is asked."


@part(
    1,
    Numbers((3,), "rad"),
    credit="all",
    tolerance=TOLERANCE,
    mistakes=[(EXACT, lambda R1, R2: rotation_vector(R2 @ R1.T))],
)
def Bdq(B: Array, dq: Array) -> Array:
    r"""The rotation $\mathbf B\,d\mathbf q$ in base axes, which is $d\mathbf w$ to first order

    - One matrix times one vector, signs included.

    One matrix times one vector; the metres of the slide meet a column of zeros:
    $$\mathbf B\,d\mathbf q = <Bdq>$$
    """
    return B @ dq


@part(1, Choice(tuple(map(str, FACTORS))), shows={"square": lambda k: k**2, "missed": lambda dw, Bdq: dw - Bdq})
def factor(k: int) -> str:
    r"""By which factor, about, does the length of $d\mathbf w - \mathbf B\,d\mathbf q$ shrink when every entry of
    $d\mathbf q$ is divided by your $k$ and $\mathbf R_2$ is computed anew?

    - Is the difference of first, second or third order in the joint displacements?
    - Try it.

    Rotations do not add. To second order $d\mathbf w = \mathbf B\,d\mathbf q + \frac{1}{2} \cdot$ the sum of
    $dq_i\,dq_j\,\mathbf z_{i-1} \times \mathbf z_{j-1}$ over all pairs of revolute joints $i < j$. An equals sign between
    $d\mathbf w$ and $\mathbf B\,d\mathbf q$ holds to first order only.

    The difference has products of two $dq$: divided by $k = <k>$ each, it shrinks by $k^2 = <square>$. Yours is now
    $$d\mathbf w - \mathbf B\,d\mathbf q = <missed>$$
    """
    return LETTERS[FACTORS.index(k**2)]


def statement(arm: Arm) -> str:
    """The table, and what the two rotations are."""
    return rf"""{described(arm)}

At $\mathbf q$ the rotation of the tool frame in base axes (those of frame 0) is $\mathbf R_1$, at $\mathbf q + d\mathbf q$ it is
$\mathbf R_2$. Both are printed rounded to six decimals. The rotation vector $d\mathbf w$ between
them is the axis of the rotation in base axes times its angle, so that $\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$. The angular rows of
the Jacobian in base axes are $\mathbf B$, and $\mathbf B\,d\mathbf q$ is nearly $d\mathbf w$."""


ROTATION = [["1"] * 3] * 3
EXERCISE = exercise(
    "small_rotations",
    title="Small rotations and the angular rows of the Jacobian",
    source="S0 4.3, eq. 4.9 to 4.11",
    minutes=35,
    objectives=(
        "Read the rotation vector off two rotation matrices.",
        "Compare it with the angular rows of the Jacobian times the joint displacements.",
    ),
    robot=robot,
    units={**UNITS, "dq": ["rad", "rad", "m", "rad"], "R1": ROTATION, "R2": ROTATION, "k": "1"},
    symbols={"dq": r"d\mathbf{q}"},
    structure=("form",),
    draw=draw,
    statement=statement,
    drawings=drawn,
    scale=lambda d1, a2, a4: d1 + a2 + a4,
    parts=(dw, B, Bdq, factor),
)
