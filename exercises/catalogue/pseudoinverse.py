"""S3 5.2.1: the pseudoinverse of a redundant arm, what it gives, and the motions it leaves free.

S3 says that the pseudoinverse "gives the identity, just like the real inverse". That holds on one
side only, and on which one depends on the shape and the rank of the matrix, so that each sheet asks
it of a matrix K of its own.
"""

from typing import Any

import numpy as np

from ...solutions.jacobian import jacobian
from ...solutions.singularity import rank, sigma_min
from ...solutions.velocity import pseudoinverse
from ..answers import Choice, Manual, Numbers
from ..arm import Array
from ..arms.panda import PANDA, drawn, posture
from ..calculations.lost import still_rates
from ..calculations.readings import TRANSPOSED
from ..calculations.redundant import (
    HALF,
    gives_twist,
    judged_least,
    judged_null,
    judged_pseudoinverse,
)
from ..draws import until
from ..exercise import Outcome
from ..part import exercise, part

REGULAR = 0.1  # smallest singular value of J, of J without column k, and of K where K has full rank
SEEN = 0.1  # rate of joint k [rad/s] that the last question is about
SHARE = (0.3, 0.9)  # of joint k in the motion of length 1 that does not move the hand
SIDES = (
    r"only $\mathbf K \mathbf K^{+} = \mathbf I$",
    r"only $\mathbf K^{+} \mathbf K = \mathbf I$",
    "both",
    "neither",
)
OTHER_SIDE = {"a": "b", "b": "a", "c": "d", "d": "c"}  # rows and columns of K exchanged
J_TRANSPOSED = "This is J transposed; multiply it by J and see whether the identity comes out."
RANK = "Compare the rank of K with its number of rows and with its number of columns."
SET_TO_ZERO = (
    "One rate is set to zero and the others are left as they were; that changes the twist."
)
WRONG_AMOUNT = "The motion (d) is taken away in the wrong amount: joint k does not come to rest."
RUBRIC = (
    (1, "by what the solutions differ, and how that lies to the shortest one, with a reason"),
    (1, "what follows for the lengths"),
)


def statement(columns: Array, k: int) -> str:
    """What is given, and which columns of J make K."""
    chosen = ", ".join(map(str, columns))
    again = ""
    if has_a_column_twice(columns):
        again = ", the last of them a second time,"
    return rf"""The Franka Emika Panda has seven revolute joints. You are given its 6 × 7 Jacobian
$\mathbf J$ in one posture, in base axes at the hand point, linear rows above angular rows, and a
twist $\boldsymbol\xi$ of the hand (linear velocity above angular velocity). Take the printed
numbers as exact. $\mathbf J$ has rank 6.

The joint rates $\dot{{\mathbf q}} = (\dot q_1, \ldots, \dot q_7)$ have the length
$|\dot{{\mathbf q}}| = \sqrt{{\dot q_1^2 + \cdots + \dot q_7^2}}$.

For (b): $\mathbf K$ is the 6 × {len(columns)} matrix of the columns {chosen} of your
$\mathbf J${again} and $\mathbf K^{{+}}$ is its pseudoinverse.

For (e): your joint $k$ is joint {k}."""


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A posture, its J as printed, a twist, the joint k that is to stand still, and K."""
    while True:
        q = posture(rng)
        J = np.round(jacobian(PANDA.chain(), q), 4) + 0.0
        shares = np.abs(still_rates(J))
        fitting = np.flatnonzero((shares >= SHARE[0]) & (shares <= SHARE[1])) + 1
        if not fitting.size or sigma_min(J) < REGULAR:
            continue

        k = int(rng.choice(fitting))
        xi = drawn_twist(rng)
        turns = abs((pseudoinverse(J) @ xi)[k - 1]) >= SEEN
        if turns and sigma_min(np.delete(J, k - 1, axis=1)) >= REGULAR:
            return {"J": J.tolist(), "xi": xi, "k": k, "q": q, "columns": columns_of_K(rng, J)}


def drawn_twist(rng: np.random.Generator) -> list[float]:
    """A twist (6,) [m/s, rad/s] with two decimals."""
    signs = rng.choice([-1, 1], 6)
    sizes = np.concatenate([rng.integers(5, 31, 3), rng.integers(20, 91, 3)])
    return np.round(signs * sizes / 100, 2).tolist()


def columns_of_K(rng: np.random.Generator, J: Array) -> list[int]:
    """All seven columns, six or four of them, or five and one of these again."""
    count, again = ((7, 0), (7, 0), (6, 0), (4, 0), (5, 1))[int(rng.integers(5))]

    def chosen() -> list[int]:
        columns = np.sort(rng.choice(np.arange(1, 8), count, replace=False)).tolist()
        return columns + columns[:1] * again

    return until(chosen, lambda columns: bool(sigma_min(J[:, np.unique(columns) - 1]) >= REGULAR))


def has_a_column_twice(columns: Array) -> bool:
    """Whether K has lower rank than the number of its rows and of its columns."""
    return len(set(columns)) < len(columns)


@part(
    3,
    Numbers((7, 6), [["rad/m"] * 3 + ["1"] * 3] * 7),
    check=judged_pseudoinverse,
    credit="column",
    mistakes=[(J_TRANSPOSED, lambda J: J.T)],
)
def pinv(J: Array) -> Array:
    r"""(a) The pseudoinverse $\mathbf J^{+}$, a 7 × 6 matrix

    - One of the two products of J and its transpose has an inverse.
    - Multiply J by your result.

    $\mathbf J$ has more columns than rows and full row rank, so $\mathbf J \mathbf J^{T}$ is 6 × 6
    and has an inverse: $\mathbf J^{+} = \mathbf J^{T} (\mathbf J \mathbf J^{T})^{-1}$.
    $\mathbf J^{T} \mathbf J$ is 7 × 7 with rank 6 and has none. With your numbers:
    $$\mathbf J^{+} = <pinv>$$
    """
    return pseudoinverse(J)


def comparison(J: Array, columns: Array, sides: str) -> str:
    """The ranks, for K and beside it for J, where K is another matrix."""
    K = J[:, columns - 1]
    size = f"6 × {K.shape[1]} with rank {rank(K, 1e-6)}"
    of_J = (
        r"$\mathbf J \mathbf J^{+} = \mathbf I$, but $\mathbf J^{+} \mathbf J$ is a projection "
        "of rank 6."
    )
    if K.shape == J.shape:
        return rf"Your $\mathbf K$ is $\mathbf J$ itself, {size}: the answer is {sides}). {of_J}"
    return (
        rf"Your $\mathbf K$ is {size}: the answer is {sides}). "
        rf"For the 6 × 7 matrix $\mathbf J$ it is a): {of_J}"
    )


@part(
    1,
    Choice(SIDES),
    shows={"comparison": comparison},
    mistakes=[(RANK, lambda sides: OTHER_SIDE[sides])],
)
def sides(columns: Array) -> str:
    r"""(b) Which of $\mathbf K \mathbf K^{+} = \mathbf I$ and $\mathbf K^{+} \mathbf K = \mathbf I$
    holds for your $\mathbf K$? $\mathbf I$ is the identity of the size that fits

    - Which size and which rank has each product?
    - Compute both products for your numbers.

    $\mathbf K \mathbf K^{+}$ and $\mathbf K^{+} \mathbf K$ have the rank of $\mathbf K$. The first
    is 6 × 6 and is $\mathbf I$ only if the rank is 6; the second has as many rows as $\mathbf K$
    has columns and is $\mathbf I$ only if the rank is that number.

    <comparison>
    """
    if has_a_column_twice(columns):
        return "d"
    return {7: "a", 6: "c", 4: "b"}[len(columns)]


@part(
    2,
    Numbers((7,), "rad/s"),
    follow=0.5,  # from a transposed or left inverse it is one product
    check=judged_least,
    mistakes=[(TRANSPOSED, lambda J, xi: J.T @ xi)],
)
def least(pinv: Array, xi: Array) -> Array:
    r"""(c) The joint rates of least length $|\dot{\mathbf q}|$ for which the hand has the twist
    $\boldsymbol\xi$

    - The matrix of (a) was made for this.

    Of all solutions of $\mathbf J \dot{\mathbf q} = \boldsymbol\xi$ the shortest is
    $\mathbf J^{+} \boldsymbol\xi$:
    $$\dot{\mathbf q} = <least>$$
    """
    return pinv @ xi


@part(2, Numbers((7,), "rad/s"), check=judged_null, credit="all")
def null(J: Array) -> Array:
    r"""(d) Joint rates $\mathbf n$ other than zero that do not move the hand at all,
    $\mathbf J \mathbf n = \mathbf 0$; any multiple of them is right, but one entry shall be at
    least 0.1 in size

    - What do $\mathbf J^{+}\mathbf J$ and what is left of $\mathbf I$ without it do to joint rates?

    $\mathbf J (\mathbf I - \mathbf J^{+} \mathbf J) = \mathbf 0$, because
    $\mathbf J \mathbf J^{+} = \mathbf I$. So each column of $\mathbf I - \mathbf J^{+} \mathbf J$
    that is not zero is such a motion; seven joints less rank 6 leave one direction, and all of them
    are its multiples. Scaled to length 1:
    $$\mathbf n = <null>$$
    """
    return still_rates(J)


def judged_still(J: Array, xi: Array, k: int, value: Array) -> Outcome:
    """By what is asked: the twist, and joint k at rest."""
    if gives_twist(J, xi, value) and abs(value[k - 1]) <= HALF:
        return Outcome(right=np.ones(7, dtype=bool))
    return Outcome()


@part(
    3,
    Numbers((7,), "rad/s"),
    check=judged_still,
    credit="all",
    mistakes=[
        (SET_TO_ZERO, lambda least, k: np.where(np.arange(1, 8) == k, 0.0, least)),
        (WRONG_AMOUNT, lambda least, null, k: least - least[k - 1] * null),
    ],
)
def still(least: Array, null: Array, k: int) -> Array:
    r"""(e) The joint rates for which the hand has the same twist $\boldsymbol\xi$ and your joint
    $k$ stands still, $\dot q_k = 0$

    - Which rates may be added without a change of the twist?
    - How much of them stops joint k?

    All rates with this twist are $\mathbf J^{+} \boldsymbol\xi + c \mathbf n$. Joint $k$ stands
    still for $c = -\frac{(\mathbf J^{+} \boldsymbol\xi)_k}{n_k}$. The same comes out when column
    $k$ of $\mathbf J$ is left out and the 6 × 6 system is solved:
    $$\dot{\mathbf q} = <still>$$
    """
    return least - least[k - 1] / null[k - 1] * null


@part(2, Manual(RUBRIC))
def why() -> str:
    r"""(f) Show in two or three lines that every other solution of
    $\mathbf J \dot{\mathbf q} = \boldsymbol\xi$ is longer than $\mathbf J^{+} \boldsymbol\xi$

    - By which motions do two solutions differ?

    All rates with the twist are $\mathbf J^{+}\boldsymbol\xi + \mathbf n$ with
    $\mathbf J \mathbf n = \mathbf 0$, and the two parts are perpendicular:
    $(\mathbf J^{+}\boldsymbol\xi)^{T} \mathbf n =
    \boldsymbol\xi^{T} (\mathbf J \mathbf J^{T})^{-1} \mathbf J \mathbf n = 0$. So the squared
    length is that of $\mathbf J^{+}\boldsymbol\xi$ plus that of $\mathbf n$, and it is smallest for
    $\mathbf n = \mathbf 0$.
    """
    return (
        "Two solutions differ by an n with J n = 0. It is perpendicular to the shortest one: "
        "(J+ xi)^T n = xi^T (J J^T)^-1 J n = 0. "
        "By Pythagoras |J+ xi + n|^2 = |J+ xi|^2 + |n|^2, which is least for n = 0."
    )


EXERCISE = exercise(
    "pseudoinverse",
    title="The pseudoinverse of a seven-joint arm",
    source="S3 5.2.1",
    minutes=40,
    objectives=(
        "Compute the pseudoinverse of a Jacobian and know on which side it is an inverse.",
        "Use the freedom of a redundant arm.",
    ),
    robot=PANDA,
    sizes=(),
    units={"J": [["m/rad"] * 7] * 3 + [["1"] * 7] * 3, "xi": ["m/s"] * 3 + ["rad/s"] * 3, "k": "1"},
    symbols={"J": r"\mathbf J", "xi": r"\boldsymbol\xi"},
    structure=("columns",),
    hidden=("q",),  # for the drawing
    scale=1.0,
    draw=draw,
    statement=statement,
    drawings=drawn,
    parts=(pinv, sides, least, null, still, why),
)
