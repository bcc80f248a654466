"""S0 4.9 to 4.11: the rotation vector between two close frames, and the angular rows of J.

The senses of the axes are drawn. The rotations are printed to six decimals; the angles are such
that the second order, which S0's eq. 4.11 leaves out, is larger than the tolerance.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..answers import LETTERS
from ..arm import Arm, Array, arm_of
from ..arms.rrpr import LENGTHS, SENSES, UNITS, described, drawn, posture, robot, rotation_at
from ..calculations.columns import LATE, TURNING_SLIDE, late, right
from ..calculations.small_turns import EXACT, FIRST_ORDER, MISREAD, TOLERANCE, between, the_way_back
from ..draws import length, until
from ..exercise import Choice, Numbers, Variant
from ..part import exercise, part

IN_TOOL_AXES = "This is the block in axes of the tool frame; base axes are asked."
DIVISORS = (2, 4, 10)
FACTORS = (2, 4, 8, 10, 16, 64, 100, 1000)  # the divisors, their squares and cubes


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 16 forms, a posture and a displacement whose second order shows."""
    form = int(rng.integers(len(SENSES)))
    v: dict[str, Any] = {"form": form, "k": DIVISORS[int(rng.integers(len(DIVISORS)))]}
    for name in LENGTHS:
        v[name] = length(rng, 0.2, 0.6)
    return until(lambda: v | motion(rng, form), is_telling)


def motion(rng: np.random.Generator, form: int) -> dict[str, Any]:
    """Posture, displacement, and the rotations before and after it, to six decimals."""
    q = posture(rng)
    sizes = rng.integers(35, 71, 4) * rng.choice([-1, 1], 4)
    dq = [round(float(size) / 1000, 3) for size in sizes]
    return {"q": q, "dq": dq, "R1": printed(form, q), "R2": printed(form, np.add(q, dq))}


def printed(form: int, q: ArrayLike) -> list[list[float]]:
    """The rotation at q, to six decimals."""
    return (np.round(rotation_at(form, q), 6) + 0.0).tolist()


def is_telling(v: Variant) -> bool:
    """Whether all components matter, mistakes show, and what first order misses is second order."""
    R1, R2 = np.array(v["R1"]), np.array(v["R2"])
    exact = between(R1, R2)
    first_order = B(arm_of(robot(v["form"]), v)) @ v["dq"]
    if np.abs([exact, first_order]).min() < 0.008 or np.linalg.norm(exact) > 0.14:
        return False

    others = [first_order, *[wrong(R1, R2) for _, wrong in MISREAD]]
    changes = np.abs(np.array(others) - exact).max(axis=1)
    return bool(changes.min() >= 1e-3 and is_second_order(v, exact, first_order))


def is_second_order(v: Variant, exact: Array, first_order: Array) -> bool:
    """Whether what first order misses shrinks by about k^2 where dq is divided by k."""
    arm, k = arm_of(robot(v["form"]), v), v["k"]
    after = rotation_at(v["form"], arm.q + np.array(v["dq"]) / k)
    missed = np.linalg.norm(exact - first_order)
    missed_then = np.linalg.norm(between(arm.R, after) - first_order / k)
    return bool(abs(missed / missed_then / k**2 - 1) <= 0.12)


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
    r"""The rotation vector $d\mathbf w$ in base axes with
    $\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$, from the printed rotations

    - Which product of the two matrices is R(dw)?
    - A rotation minus its transpose holds the axis times the sine of the angle, twice.

    $\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$ gives
    $\mathbf R(d\mathbf w) = \mathbf R_2 \mathbf R_1^T$ with $d\mathbf w$ in base axes;
    $\mathbf R_1^T \mathbf R_2$ would have it in tool axes.
    $$\mathbf R_2 \mathbf R_1^T = <R>$$

    Half the differences of opposite entries,
    $\frac{1}{2}(R_{32} - R_{23},\; R_{13} - R_{31},\; R_{21} - R_{12})$, are the axis times the
    sine of the angle; dividing by the sine and multiplying with the angle changes so little here
    that both pass:
    $$d\mathbf w = <dw>$$
    """
    return between(R1, R2)


@part(
    2,
    Numbers((3, 4), "1", 3),
    shows={"closed": lambda arm: arm.closed.J[3:, :]},
    mistakes=(
        (TURNING_SLIDE, lambda arm: arm.axes),
        (LATE, lambda arm: late(arm.frames, arm.kinds)[3:]),
        (IN_TOOL_AXES, lambda arm, B: arm.R.T @ B),
    ),
)
def B(arm: Arm) -> Array:
    r"""The 3 × 4 block $\mathbf B$ of the angular rows of the Jacobian at your $\mathbf q$, in base
    axes

    - Only directions matter, no lengths.
    - What does a slide contribute to the rotation?

    Column $i$ of $\mathbf B$ is $\xi_i \mathbf z_{i-1}$ in the standard convention: the axis of a
    revolute joint, and zero for the prismatic one. In closed form:
    $$\mathbf B = <closed>$$

    With your numbers:
    $$\mathbf B = <B>$$
    """
    return right(arm.frames, arm.kinds)[3:]


@part(
    1,
    Numbers((3,), "rad"),
    credit="all",
    tolerance=TOLERANCE,
    mistakes=[(EXACT, between)],
)
def Bdq(B: Array, dq: Array) -> Array:
    r"""The rotation $\mathbf B\,d\mathbf q$ in base axes, which is $d\mathbf w$ to first order

    - One matrix times one vector, signs included.

    One matrix times one vector; the metres of the slide meet a column of zeros:
    $$\mathbf B\,d\mathbf q = <Bdq>$$
    """
    return B @ dq


@part(
    1,
    Choice(tuple(map(str, FACTORS))),
    shows={"square": lambda k: k**2, "missed": lambda dw, Bdq: dw - Bdq},
)
def factor(k: int) -> str:
    r"""By which factor, about, does the length of $d\mathbf w - \mathbf B\,d\mathbf q$ shrink when
    every entry of $d\mathbf q$ is divided by your $k$ and $\mathbf R_2$ is computed anew?

    - Is the difference of first, second or third order in the joint displacements?
    - Try it.

    Rotations do not add. To second order $d\mathbf w = \mathbf B\,d\mathbf q + \frac{1}{2} \cdot$
    the sum of $dq_i\,dq_j\,\mathbf z_{i-1} \times \mathbf z_{j-1}$ over all pairs of revolute
    joints $i < j$. An equals sign between $d\mathbf w$ and $\mathbf B\,d\mathbf q$ holds to first
    order only.

    The difference has products of two $dq$: divided by $k = <k>$ each, it shrinks by
    $k^2 = <square>$. Yours is now
    $$d\mathbf w - \mathbf B\,d\mathbf q = <missed>$$
    """
    return LETTERS[FACTORS.index(k**2)]


def statement(arm: Arm) -> str:
    """The arm, and what is meant by the rotation between two of its postures."""
    return rf"""{described(arm)}

At $\mathbf q$ the rotation of the tool frame in base axes (those of frame 0) is $\mathbf R_1$, at
$\mathbf q + d\mathbf q$ it is $\mathbf R_2$. Both are printed rounded to six decimals. The rotation
vector $d\mathbf w$ between them is the axis of the rotation in base axes times its angle, so that
$\mathbf R_2 = \mathbf R(d\mathbf w)\,\mathbf R_1$. The angular rows of the Jacobian in base axes
are $\mathbf B$, and $\mathbf B\,d\mathbf q$ is nearly $d\mathbf w$."""


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
