"""S3 5.2.1: the pseudoinverse of a redundant arm, what it gives, and the motions that it leaves free.

S3 says that the pseudoinverse "gives the identity, just like the real inverse". That holds on one side only, and on
which one depends on the shape and the rank of the matrix, so that each sheet asks it of a matrix K of its own.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.jacobian import jacobian
from ...solutions.robots import ROBOTS
from ...solutions.velocity import pseudoinverse
from ..drawing import Drawing, Triad
from ..draws import until
from ..exercise import Choice, Exercise, Given, Manual, Mistake, Numbers, Outcome, Part, Step, Variant
from ..properties import is_pseudoinverse, is_right_inverse, meets, parallel

ROBOT = ROBOTS["panda"]
CHAIN = ROBOT.chain()
REGULAR = 0.1  # smallest singular value of J, of J without column k, and of K where K has full rank
SEEN = 0.1  # rate of joint k [rad/s] that the last question is about
SHARE = (0.3, 0.9)  # of joint k in the motion of length 1 that does not move the hand
PENROSE = 2e-3  # four decimals of X, multiplied by J twice
HUGE = 1e4
HALF = 0.5e-4
SIDES = (
    r"only $\mathbf K \mathbf K^{+} = \mathbf I$",
    r"only $\mathbf K^{+} \mathbf K = \mathbf I$",
    "both",
    "neither",
)
WHY = (
    r"All rates with the twist are $\mathbf J^{+}\boldsymbol\xi + \mathbf n$ with $\mathbf J \mathbf n = \mathbf 0$, and the two parts are "
    r"perpendicular: $(\mathbf J^{+}\boldsymbol\xi)^{T} \mathbf n = \boldsymbol\xi^{T} (\mathbf J \mathbf J^{T})^{-1} \mathbf J \mathbf n = 0$. So the "
    r"squared length is that of $\mathbf J^{+}\boldsymbol\xi$ plus that of $\mathbf n$, and it is smallest for $\mathbf n = \mathbf 0$."
)
KEY = (
    "Two solutions differ by an n with J n = 0. It is perpendicular to the shortest one: (J+ xi)^T n = "
    "xi^T (J J^T)^-1 J n = 0. By Pythagoras |J+ xi + n|^2 = |J+ xi|^2 + |n|^2, which is least for n = 0."
)
Array = NDArray[np.float64]


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A posture, its Jacobian as printed, a twist, the joint k that stands still at the end, and the columns of K."""
    while True:
        q = [round(float(low + (high - low) * rng.uniform(0.15, 0.85)), 3) for low, high in ROBOT.limits]
        J = np.round(jacobian(CHAIN, q), 4) + 0.0
        n = null_vector(J)
        fitting = [k for k in range(1, 8) if SHARE[0] <= abs(n[k - 1]) <= SHARE[1]]
        if not fitting or _smallest(J) < REGULAR:
            continue
        k = int(rng.choice(fitting))
        signs, sizes = rng.choice([-1, 1], 6), np.concatenate([rng.integers(5, 31, 3), rng.integers(20, 91, 3)])
        xi = [round(float(x) / 100, 2) for x in signs * sizes]
        still = abs((pseudoinverse(J) @ xi)[k - 1])
        if still >= SEEN and _smallest(np.delete(J, k - 1, axis=1)) >= REGULAR:
            return {"J": J.tolist(), "xi": xi, "k": k, "q": q, "columns": _columns(rng, J)}


def _columns(rng: np.random.Generator, J: Array) -> list[int]:
    """All seven columns, six or four of them, or five and one of these again."""
    count, again = ((7, 0), (7, 0), (6, 0), (4, 0), (5, 1))[int(rng.integers(5))]

    def chosen() -> list[int]:
        columns = sorted(int(i) for i in rng.choice(np.arange(1, 8), count, replace=False))
        return columns + columns[:1] * again

    return until(chosen, lambda columns: _smallest(J[:, [i - 1 for i in set(columns)]]) >= REGULAR)


def _smallest(J: Array) -> float:
    return float(np.linalg.svd(J, compute_uv=False)[-1])


def null_vector(J: Array) -> Array:
    """Joint rates (7,) of length 1 that do not move the hand; the largest is positive."""
    n = np.linalg.svd(J)[2][-1]
    return n * np.sign(n[np.abs(n).argmax()])


def supplied(v: Variant) -> Array:
    return np.array(v["J"], dtype=np.float64)


def right_inverse(v: Variant, _: Given) -> Array:
    return pseudoinverse(supplied(v))


def sides(v: Variant, _: Given) -> str:
    """The letter: K K+ = I at full row rank, K+ K = I at full column rank."""
    columns = v["columns"]
    if len(set(columns)) < len(columns):
        return "d"
    return {7: "a", 6: "c", 4: "b"}[len(columns)]


def least_rates(v: Variant, given: Given) -> Array:
    X: Array = given["pseudoinverse_pinv"]
    return X @ np.array(v["xi"])


def null_motion(v: Variant, _: Given) -> Array:
    return null_vector(supplied(v))


def rates_with_k_still(v: Variant, given: Given) -> Array:
    least, n = given["pseudoinverse_least"], given["pseudoinverse_null"]
    k = v["k"] - 1
    return least - least[k] / n[k] * n


def judged_inverse(v: Variant, _: Given, value: Array) -> Outcome:
    """By the four Penrose conditions; any other X with J X = I is a right inverse and earns a third."""
    J = supplied(v)
    if is_pseudoinverse(J, value, PENROSE):
        return Outcome(right=np.ones((7, 6), dtype=bool))
    if is_right_inverse(J, value, PENROSE):
        said = "J X = I holds, so this is a right inverse; but X J is not symmetric, so it is not the pseudoinverse."
        return Outcome(right=np.zeros((7, 6), dtype=bool), finding=said, share=1 / 3)
    if np.abs(value).max() > HUGE:
        said = "Such large numbers come from the inverse of a singular matrix: which of J J^T and J^T J has full rank?"
        return Outcome(finding=said)
    return Outcome()


def judged_least(v: Variant, _: Given, value: Array) -> Outcome:
    """Half of the points go to rates that give the twist and are not the shortest."""
    J = supplied(v)
    shortest = pseudoinverse(J) @ v["xi"]
    if meets(J, value, v["xi"], _rounding(J)) and np.linalg.norm(value - shortest) > SEEN / 10:
        return Outcome(reading="These rates give the twist, but there are shorter ones that do.", share=0.5)
    return Outcome()


def judged_null(v: Variant, _: Given, value: Array) -> Outcome:
    J, size = supplied(v), float(np.linalg.norm(value))
    if parallel(value, null_vector(J), min(1e-2, 1e-3 + 4 * HALF / max(size, HALF))):
        return Outcome(right=np.ones(7, dtype=bool))
    wrong, finding = np.zeros(7, dtype=bool), ""
    if size > SEEN and np.abs(pseudoinverse(J) @ (J @ value) - value).max() < 1e-3 * size:
        finding = "J+ J keeps the part of the rates that moves the hand; the rest of them does not move it."
    return Outcome(right=wrong, finding=finding)


def judged_still(v: Variant, _: Given, value: Array) -> Outcome:
    """By what is asked: the twist, and joint k at rest."""
    J = supplied(v)
    if meets(J, value, v["xi"], _rounding(J)) and abs(value[v["k"] - 1]) <= HALF:
        return Outcome(right=np.ones(7, dtype=bool))
    return Outcome()


def _rounding(J: Array) -> Array:
    """What rounding rates to four decimals may change in each row of the twist."""
    return 1.5 * HALF * np.abs(J).sum(axis=1)


def transposed(v: Variant, _: Given) -> Array:
    return supplied(v).T


def from_transposed(v: Variant, _: Given) -> Array:
    return supplied(v).T @ v["xi"]


def only_k_set_to_zero(v: Variant, given: Given) -> Array:
    return np.where(np.arange(1, 8) == v["k"], 0.0, given["pseudoinverse_least"])


def weighted_by_k(v: Variant, given: Given) -> Array:
    """The motion taken away without its share of joint k."""
    return given["pseudoinverse_least"] - given["pseudoinverse_least"][v["k"] - 1] * given["pseudoinverse_null"]


def other_side(v: Variant, given: Given) -> str:
    return {"a": "b", "b": "a", "c": "d", "d": "c"}[sides(v, given)]


def explain_sides(v: Variant, given: Given) -> list[Step]:
    K = supplied(v)[:, [i - 1 for i in v["columns"]]]
    rank = int(np.linalg.matrix_rank(K, 1e-6))
    return [
        Step(
            r"$\mathbf K \mathbf K^{+}$ and $\mathbf K^{+} \mathbf K$ have the rank of $\mathbf K$. The first is 6 × 6 and is "
            r"$\mathbf I$ only if the rank is 6; the second has as many rows as $\mathbf K$ has columns and is $\mathbf I$ only if the "
            r"rank is that number."
        ),
        Step(
            rf"Your $\mathbf K$ is 6 × {K.shape[1]} with rank {rank}: the answer is "
            rf"{given['pseudoinverse_sides']}). For the 6 × 7 matrix $\mathbf J$ it is a): "
            r"$\mathbf J \mathbf J^{+} = \mathbf I$, but $\mathbf J^{+} \mathbf J$ is a projection of rank 6."
        ),
    ]


def worked(text: str, symbol: str, name: str) -> Callable[[Variant, Given], list[Step]]:
    """The general formula, then the numbers of that part."""
    return lambda _, given: [Step(text, symbol, numbers=given[name])]


def key(_: Variant, __: Given) -> str:
    return KEY


def drawings(v: Variant) -> tuple[Drawing, ...]:
    tool = ROBOT.frames({}, v["q"])[-1]
    return (
        Drawing(
            CHAIN,
            tuple(v["q"]),
            "The arm in the posture that your J belongs to, with the base frame and the hand frame.",
            "Panda arm with seven revolute joints in the student's posture.",
            (Triad(np.eye(4), "0"), Triad(tool, "hand")),
            arrows=False,
        ),
    )


def statement(v: Variant) -> str:
    columns = ", ".join(map(str, v["columns"]))
    again = ", the last of them a second time," if len(set(v["columns"])) < len(v["columns"]) else ""
    return rf"""The Franka Emika Panda has seven revolute joints. You are given its 6 × 7 Jacobian $\mathbf J$ in one posture, in
base axes at the hand point, linear rows above angular rows, and a twist $\boldsymbol\xi$ of the hand (linear velocity above angular
velocity). Take the printed numbers as exact. $\mathbf J$ has rank 6.

The joint rates $\dot{{\mathbf q}} = (\dot q_1, \ldots, \dot q_7)$ have the length
$|\dot{{\mathbf q}}| = \sqrt{{\dot q_1^2 + \cdots + \dot q_7^2}}$.

For (b): $\mathbf K$ is the 6 × {len(v["columns"])} matrix of the columns {columns} of your $\mathbf J${again} and $\mathbf K^{{+}}$ is its
pseudoinverse.

For (e): your joint $k$ is joint {v["k"]}."""


EXERCISE = Exercise(
    slug="pseudoinverse",
    title="The pseudoinverse of a seven-joint arm",
    source="S3 5.2.1",
    draw=draw,
    statement=statement,
    units={"J": [["m/rad"] * 7] * 3 + [["1"] * 7] * 3, "xi": ["m/s"] * 3 + ["rad/s"] * 3, "k": "1"},
    symbols={"J": r"\mathbf J", "xi": r"\boldsymbol\xi"},
    scale=lambda _: 1.0,
    objectives=(
        "Compute the pseudoinverse of a Jacobian and know on which side it is an inverse.",
        "Use the freedom of a redundant arm.",
    ),
    minutes=40,
    robot="panda",
    drawings=drawings,
    parts=(
        Part(
            "pseudoinverse_pinv",
            r"(a) The pseudoinverse $\mathbf J^{+}$, a 7 × 6 matrix",
            3,
            Numbers((7, 6), [["rad/m"] * 3 + ["1"] * 3] * 7),
            right_inverse,
            check=judged_inverse,
            credit="column",
            mistakes=(
                Mistake("This is J transposed; multiply it by J and see whether the identity comes out.", transposed),
            ),
            hints=("One of the two products of J and its transpose has an inverse.", "Multiply J by your result."),
            explain=worked(
                r"$\mathbf J$ has more columns than rows and full row rank, so $\mathbf J \mathbf J^{T}$ is 6 × 6 and has an inverse: "
                r"$\mathbf J^{+} = \mathbf J^{T} (\mathbf J \mathbf J^{T})^{-1}$ (S3 5.2.1). $\mathbf J^{T} \mathbf J$ is 7 × 7 with rank 6 and "
                "has none. With your numbers:",
                r"\mathbf J^{+}",
                "pseudoinverse_pinv",
            ),
        ),
        Part(
            "pseudoinverse_sides",
            r"(b) Which of $\mathbf K \mathbf K^{+} = \mathbf I$ and $\mathbf K^{+} \mathbf K = \mathbf I$ holds for your $\mathbf K$? $\mathbf I$ is the "
            r"identity of the size that fits",
            1,
            Choice(SIDES),
            sides,
            mistakes=(
                Mistake("Compare the rank of K with its number of rows and with its number of columns.", other_side),
            ),
            hints=("Which size and which rank has each product?", "Compute both products for your numbers."),
            explain=explain_sides,
        ),
        Part(
            "pseudoinverse_least",
            r"(c) The joint rates of least length $|\dot{\mathbf q}|$ for which the hand has the twist $\boldsymbol\xi$",
            2,
            Numbers((7,), "rad/s"),
            least_rates,
            needs=("pseudoinverse_pinv",),
            follow=0.5,  # from a transposed or left inverse it is one product
            check=judged_least,
            mistakes=(
                Mistake(
                    "These are J transposed times the twist; put them into J and look at the twist they give.",
                    from_transposed,
                ),
            ),
            hints=("The matrix of (a) was made for this.",),
            explain=worked(
                r"Of all solutions of $\mathbf J \dot{\mathbf q} = \boldsymbol\xi$ the shortest is $\mathbf J^{+} \boldsymbol\xi$:",
                r"\dot{\mathbf q}",
                "pseudoinverse_least",
            ),
        ),
        Part(
            "pseudoinverse_null",
            r"(d) Joint rates $\mathbf n$ other than zero that do not move the hand at all, $\mathbf J \mathbf n = \mathbf 0$; any multiple "
            r"of them is right, but one entry shall be at least 0.1 in size",
            2,
            Numbers((7,), "rad/s"),
            null_motion,
            check=judged_null,
            credit="all",
            hints=(r"What do $\mathbf J^{+}\mathbf J$ and what is left of $\mathbf I$ without it do to joint rates?",),
            explain=worked(
                r"$\mathbf J (\mathbf I - \mathbf J^{+} \mathbf J) = \mathbf 0$, because $\mathbf J \mathbf J^{+} = \mathbf I$. So each column of "
                r"$\mathbf I - \mathbf J^{+} \mathbf J$ that is not zero is such a motion; seven joints less rank 6 leave one direction, and "
                "all of them are its multiples. Scaled to length 1:",
                r"\mathbf n",
                "pseudoinverse_null",
            ),
        ),
        Part(
            "pseudoinverse_still",
            r"(e) The joint rates for which the hand has the same twist $\boldsymbol\xi$ and your joint $k$ stands still, $\dot q_k = 0$",
            3,
            Numbers((7,), "rad/s"),
            rates_with_k_still,
            needs=("pseudoinverse_least", "pseudoinverse_null"),
            check=judged_still,
            credit="all",
            mistakes=(
                Mistake(
                    "One rate is set to zero and the others are left as they were; that changes the twist.",
                    only_k_set_to_zero,
                ),
                Mistake(
                    "The motion (d) is taken away in the wrong amount: joint k does not come to rest.", weighted_by_k
                ),
            ),
            hints=("Which rates may be added without a change of the twist?", "How much of them stops joint k?"),
            explain=worked(
                r"All rates with this twist are $\mathbf J^{+} \boldsymbol\xi + c \mathbf n$. Joint $k$ stands still for "
                r"$c = -\frac{(\mathbf J^{+} \boldsymbol\xi)_k}{n_k}$. The same comes out when column $k$ of $\mathbf J$ is left out and "
                "the 6 × 6 system is solved:",
                r"\dot{\mathbf q}",
                "pseudoinverse_still",
            ),
        ),
        Part(
            "pseudoinverse_why",
            r"(f) Show in two or three lines that every other solution of $\mathbf J \dot{\mathbf q} = \boldsymbol\xi$ is longer than "
            r"$\mathbf J^{+} \boldsymbol\xi$",
            2,
            Manual(
                (
                    (1, "by what the solutions differ, and how that lies to the shortest one, with a reason"),
                    (1, "what follows for the lengths"),
                )
            ),
            key,
            hints=("By which motions do two solutions differ?",),
            explain=lambda _, __: [Step(WHY)],
        ),
    ),
)
