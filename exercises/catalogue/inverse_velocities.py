"""S3 5.2: inverse velocities of the Puma 560 where J has no inverse.

The wrist axes meet in the tool point: J has a linear block of joints 1 to 3 (the arm), zeros beside it, and an angular
block of joints 4 to 6 (the wrist). S3 says that near a singular configuration a joint's influence becomes almost zero;
in fact columns become linearly dependent. The elbow is singular at tan q3 = -d4/a3, not at -90 and 90 degrees.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.expression import parse
from ...solutions.jacobian import jacobian
from ...solutions.robots import ROBOTS
from ...solutions.singularity import factor_values, singular_values
from ..answers import LETTERS
from ..drawing import Drawing, Triad
from ..draws import angles, length, rates, until
from ..exercise import Choice, Configurations, Exercise, Given, Mistake, Numbers, Outcome, Part, Step, Variant
from ..printed_table import printed_table, table_rows
from ..properties import list_share, listed, parallel

ROBOT = ROBOTS["puma560"]
CHAIN = ROBOT.chain()
Array = NDArray[np.float64]
ZERO = 1e-3  # of the largest singular value; six decimals of q leave some 1e-6
REGULAR = 0.05  # what the other singular values are at least, of the largest
DIRECTION = 5e-3  # [rad]
ANGLE = 2e-3  # [rad]
REASONS = (
    "the wrist block: axes 4 and 6 lie in one line",
    "the arm block, elbow: the wrist centre lies in the plane of axes 2 and 3",
    "the arm block, shoulder: the wrist centre is as near to axis 1 as the offset d3 lets it come",
    "no block: det J is not zero",
    "none of these: J is not square",
)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A posture singular in one way, a twist that may be out of reach there, and another forearm."""
    make = (_wrist, _elbow, _shoulder)[int(rng.integers(3))]
    v: dict[str, Any] = until(lambda: {"q": make(angles(rng, 6, [(1, 2)]), rng)}, _is_telling)
    v["xi"] = until(lambda: _twist(v, rng), lambda xi: bool(np.abs(xi).min() >= 0.02))
    return v | {"a3": length(rng, 0.03, 0.12), "d4": length(rng, 0.36, 0.52)}


def _wrist(q: list[float], rng: np.random.Generator) -> list[float]:
    q[4] = float(rng.choice([0.0, 3.141593]))
    return q


def _elbow(q: list[float], rng: np.random.Generator) -> list[float]:
    a3, d4 = ROBOT.parameters["a3"], ROBOT.parameters["d4"]
    q[2] = round(float(elbow_angles(a3, d4)[rng.integers(2)]), 6)
    return q


def _shoulder(q: list[float], rng: np.random.Generator) -> list[float]:
    """With q2 from a2 cos q2 + a3 cos(q2 + q3) - d4 sin(q2 + q3) = 0."""
    a2, a3, d4 = (ROBOT.parameters[name] for name in ("a2", "a3", "d4"))
    s, c = np.sin(q[2]), np.cos(q[2])
    q2 = float(np.arctan2(a2 + a3 * c - d4 * s, a3 * s + d4 * c))
    q[1] = round(q2 - float(np.sign(q2)) * np.pi * int(rng.integers(2)), 6)
    return q


def _is_telling(v: Variant) -> bool:
    """Whether one singular value is zero and no other is small, and no plain vector is the lost direction."""
    J = jacobian_at_q(v, {})
    block = lost_block(J)
    sizes = [singular_values(M) / singular_values(M)[0] for M in (J, *blocks(J))]
    smallest = sorted(float(size[-1]) for size in sizes)
    u, n = _lost(block)
    plain = [*np.eye(3), np.ones(3), np.array([1, 1, 0]), n]
    return bool(
        smallest[1] < 1e-5
        and min(smallest[2], *(float(size[-2]) for size in sizes)) >= REGULAR
        and not any(parallel(direction, u, 0.1) for direction in plain)
    )


def _twist(v: Variant, rng: np.random.Generator) -> list[float]:
    """A twist within reach or, as often, out of reach; the two look alike."""
    J = jacobian_at_q(v, {})
    U, _, _ = np.linalg.svd(J)
    beside = float(rng.choice([0.0, 0.0, -0.4, 0.4]))
    return (np.round(J @ rates(rng, 6) + beside * U[:, -1], 4) + 0.0).tolist()


def jacobian_at_q(v: Variant, _: Given) -> Array:
    return jacobian(CHAIN, v["q"])


def blocks(J: Array) -> tuple[Array, Array]:
    """Linear rows of joints 1 to 3, angular rows of joints 4 to 6."""
    return J[:3, :3], J[3:, 3:]


def lost_block(J: Array) -> Array:
    """The block that is nearer to losing rank."""
    return min(blocks(J), key=lambda block: float(np.divide(*singular_values(block)[[-1, 0]])))


def _lost(block: Array) -> tuple[Array, Array]:
    """The unit vectors u with u^T block = 0, its largest component positive, and n with block n = 0."""
    U, _, V = np.linalg.svd(block)
    u = np.asarray(U[:, -1], dtype=np.float64)
    return u * np.sign(u[np.argmax(np.abs(u))]), np.asarray(V[-1], dtype=np.float64)


def ranks(_: Variant, given: Given) -> Array:
    """Ranks of J, of the arm block and of the wrist block."""
    J: Array = given["inverse_velocities_J"]
    return np.array([np.linalg.matrix_rank(block, rtol=ZERO) for block in (J, *blocks(J))], dtype=np.float64)


def reason(v: Variant, _: Given) -> str:
    values = list(factor_values(ROBOT, None, v["q"]).values())
    return LETTERS[int(np.argmin(np.abs(values)))]


def lost_direction(_: Variant, given: Given) -> Array:
    return _lost(lost_block(given["inverse_velocities_J"]))[0]


def judged_direction(_: Variant, given: Given, value: Array) -> Outcome:
    u, n = _lost(lost_block(given["inverse_velocities_J"]))
    if parallel(value, u, DIRECTION):
        return Outcome(right=True)
    if parallel(value, n, DIRECTION):
        return Outcome(
            right=False,
            finding="These are joint rates that move nothing (block times rates is zero); asked is the direction that no rates reach.",
        )
    return Outcome(right=False)


def solutions(v: Variant, given: Given) -> str:
    """Letter of none, exactly one or infinitely many, by what is left over at the best rates, and by the rank."""
    J: Array = given["inverse_velocities_J"]
    if np.linalg.norm(left_over(v, J)) > 0.01 * np.linalg.norm(v["xi"]):
        return "a"
    return "b" if np.linalg.matrix_rank(J, rtol=ZERO) == 6 else "c"


def left_over(v: Variant, J: Array) -> Array:
    """What the best joint rates miss of the twist."""
    qdot: Array = np.asarray(np.linalg.lstsq(J, v["xi"], rcond=ZERO)[0], dtype=np.float64)
    return J @ qdot - np.array(v["xi"])


def elbow_angles(a3: float, d4: float) -> Array:
    """Both q3 in (-pi, pi] with a3 sin(q3) + d4 cos(q3) = 0."""
    first = -np.arctan2(d4, a3)
    return np.array([first, first + np.pi])


def elbow(v: Variant, _: Given) -> Array:
    return elbow_angles(v["a3"], v["d4"])[:, None]


def _slips(a3: float, d4: float) -> tuple[tuple[float, str], ...]:
    """Angles that known slips lead to, up to sign and half a turn, with the sentence for each."""
    return (
        (np.pi / 2, "A right angle would be right without a3: the wrist centre lies beside the forearm's axis."),
        (float(np.arctan2(d4, a3)), "Look again at a sign: which sine and which cosine cancel each other?"),
        (float(np.arctan2(a3, d4)), "Look again at the quotient: which of the two lengths stands with the sine?"),
    )


def judged_elbow(v: Variant, _: Given, value: Array) -> Outcome:
    right, share = list_share(value, elbow(v, {}), ANGLE)
    if share == 1:
        return Outcome(right, share=share)
    if right.all():
        found = "There is another branch: the tangent repeats after pi, the arm is straight or folded."
        return Outcome(right, finding=found, share=share)
    for slip, sentence in _slips(v["a3"], v["d4"]):
        seen = [[slip], [-slip], [slip - np.pi], [np.pi - slip]]
        if listed(value[~right[:, 0]], seen, ANGLE)[0].any():
            return Outcome(right, finding=sentence, share=share)
    return Outcome(right, share=share)


def explain_jacobian(v: Variant, given: Given) -> list[Step]:
    poses = ROBOT.frames(None, v["q"])
    return [
        Step(
            r"Column $i$ is $\mathbf z_{i-1} \times (\mathbf o_6 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$. The axes $\mathbf z_0 \ldots \mathbf z_5$ as columns:",
            r"\left[\mathbf z_0 \cdots \mathbf z_5\right]",
            numbers=poses[:6, :3, 2].T,
        ),
        Step(
            r"The tool point is the wrist centre, $\mathbf o_6 = \mathbf o_5 = \mathbf o_4 = \mathbf o_3$: the wrist cannot move it, and "
            r"the upper right block is zero.",
            r"\mathbf J = \begin{bmatrix}\mathbf A & \mathbf 0\\ \mathbf C & \mathbf W\end{bmatrix}",
            numbers=given["inverse_velocities_J"],
        ),
    ]


def explain_ranks(v: Variant, given: Given) -> list[Step]:
    J: Array = given["inverse_velocities_J"]
    named = zip((r"\mathbf J", r"\mathbf A", r"\mathbf W"), (J, *blocks(J)), strict=True)
    listed = [(name, ", ".join(f"{size:.4f}" for size in singular_values(block))) for name, block in named]
    return [
        Step(
            r"The rank is the number of singular values that are not zero. It depends on $\mathbf q$: a Puma has six degrees of freedom, "
            r"and rank 6 at most postures. Where $\mathbf A$ or $\mathbf W$ loses one, so does $\mathbf J$."
        ),
        *(Step(f"Singular values of ${name}$: {sizes}.") for name, sizes in listed),
        Step(
            "The ranks:",
            r"\left(\mathrm{rank}\,\mathbf J, \mathrm{rank}\,\mathbf A, \mathrm{rank}\,\mathbf W\right)",
            numbers=given["inverse_velocities_ranks"],
        ),
    ]


def explain_reason(v: Variant, given: Given) -> list[Step]:
    values = np.array(list(factor_values(ROBOT, None, v["q"]).values()))
    return [
        Step(
            r"$\mathbf J$ is 6 × 6. With the zero block, $\det \mathbf J = \det \mathbf A \cdot \det \mathbf W$; it is the product of a length "
            "and of one factor each for wrist, elbow and shoulder:",
            r"\det \mathbf J",
            parse(ROBOT.determinant, ROBOT.names).sympy(),
        ),
        Step(
            "Wrist, elbow and shoulder factor at your posture; the one that is zero names the reason:", numbers=values
        ),
    ]


def explain_direction(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"A velocity $\mathbf v$ is reached when it is a combination of the columns of the block. They are linearly dependent and span "
            r"a plane; lost is its normal $\mathbf u$, with $\mathbf u^T \mathbf A = \mathbf 0$ or $\mathbf u^T \mathbf W = \mathbf 0$: the cross product of "
            "two columns that are not parallel, or the last left singular vector. Its sign is free:",
            r"\mathbf u",
            numbers=given["inverse_velocities_lost"],
        )
    ]


def explain_solutions(v: Variant, given: Given) -> list[Step]:
    found = {"a": "none", "b": "exactly one", "c": "infinitely many"}[solutions(v, given)]
    return [
        Step(
            r"$\mathbf J \dot{\mathbf q} = \boldsymbol\xi$ has a solution exactly when the best $\dot{\mathbf q} = \mathbf J^{+} \boldsymbol\xi$ leaves nothing over. "
            r"Rates with $\mathbf J \dot{\mathbf q} = \mathbf 0$ may then be added at will, and at rank 5 there are such. What is left over:",
            r"\mathbf J \mathbf J^{+} \boldsymbol\xi - \boldsymbol\xi",
            numbers=left_over(v, given["inverse_velocities_J"]),
        ),
        Step(f"So there are: {found}."),
    ]


def explain_elbow(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"The factor of the elbow holds $q_3$ alone: $a_3 \sin q_3 + d_4 \cos q_3 = 0$, so $\tan q_3 = -\frac{d_4}{a_3}$. The tangent repeats "
            r"after $\pi$, which gives two angles in $(-\pi, \pi]$: the arm stretched and the arm folded.",
            r"q_3",
            numbers=np.ravel(given["inverse_velocities_elbow"]),
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    poses = ROBOT.frames(None, v["q"])
    return (
        Drawing(
            CHAIN,
            tuple(v["q"]),
            "Puma 560 at your q, with frame 0 and the tool frame.",
            "Puma 560 arm with six revolute joints, drawn at your q.",
            (Triad(np.eye(4), "0"), Triad(poses[-1], "tool")),
            arrows=False,
        ),
    )


def statement(_: Variant) -> str:
    numbers = {name: f"{value:g}" for name, value in ROBOT.parameters.items()}
    rows = [[numbers.get(cell, cell) for cell in row] for row in table_rows(ROBOT)]
    return rf"""The Puma 560 has six revolute joints. Its table in the **standard** Denavit–Hartenberg convention (metres):

{printed_table(rows)}

The tool frame is frame 6; its origin is the point where axes 4, 5 and 6 meet, the **wrist centre**. All velocities are those of
this point, in the axes of frame 0. Two blocks of $\mathbf J$ have names: the **arm block** $\mathbf A$, the linear rows of joints 1, 2, 3, and
the **wrist block** $\mathbf W$, the angular rows of joints 4, 5, 6 (both 3 × 3).

Your $\mathbf q$ is a singular posture or very near one: it is rounded to six decimals at most. Count a singular value as zero when it is
less than a thousandth of the largest one of its matrix, and a velocity as reached when it is met to three decimals.

$\boldsymbol\xi$ (linear above angular, for the fifth question) is a prescribed twist. The lengths $a_3$ and $d_4$ among your numbers are for
the **last question only**: there the forearm of the Puma is exchanged for another one."""


EXERCISE = Exercise(
    slug="inverse_velocities",
    title="Inverse velocities at a singular posture",
    source="S3 5.2",
    draw=draw,
    statement=statement,
    units={"q": ["rad"] * 6, "xi": ["m/s"] * 3 + ["rad/s"] * 3, "a3": "m", "d4": "m"},
    scale=lambda _: ROBOT.parameters["a2"] + ROBOT.parameters["d4"],
    objectives=(
        "Tell from rank and determinant whether a Jacobian can be inverted.",
        "Find the direction that a singular posture loses, and whether a velocity can still be reached.",
    ),
    minutes=60,
    robot="puma560",
    drawings=drawings,
    parts=(
        Part(
            "inverse_velocities_J",
            r"The 6 × 6 Jacobian $\mathbf J$ at your $\mathbf q$, linear rows above angular rows",
            3,
            Numbers((6, 6), [["m/rad"]] * 3 + [["1"]] * 3),
            jacobian_at_q,
            mistakes=(
                Mistake(
                    "This is the Jacobian in the axes of the tool frame; base axes are asked.",
                    lambda v, _: jacobian(CHAIN, v["q"], frame="tool"),
                ),
            ),
            hints=(
                "Column i takes the z axis and the origin of frame i - 1.",
                "Which joints cannot move the wrist centre?",
            ),
            explain=explain_jacobian,
        ),
        Part(
            "inverse_velocities_ranks",
            r"The ranks of $\mathbf J$, of $\mathbf A$ and of $\mathbf W$ at your $\mathbf q$, in this order",
            2,
            Numbers((3,), "1", decimals=0),
            ranks,
            needs=("inverse_velocities_J",),
            credit="all",
            tolerance=1e-6,
            mistakes=(
                Mistake(
                    "These are the numbers of joints; the rank depends on q. Did rounding of q pass for a singular value?",
                    lambda _, __: np.array([6.0, 3.0, 3.0]),
                ),
                Mistake(
                    "A block loses rank here; what does that do to the whole of J?",
                    lambda v, given: np.array([6.0, *ranks(v, given)[1:]]),
                ),
            ),
            hints=("A program counts singular values; what counts as zero is said above.", "One posture, three ranks."),
            explain=explain_ranks,
        ),
        Part(
            "inverse_velocities_reason",
            r"What keeps $\mathbf J$ from having an inverse at your $\mathbf q$",
            1,
            Choice(REASONS),
            reason,
            hints=("The determinant of J is that of A times that of W.", "Which joints does each case depend on?"),
            explain=explain_reason,
        ),
        Part(
            "inverse_velocities_lost",
            r"The unit vector $\mathbf u$ of the direction that is lost, in base axes, with either sign: along $\mathbf u$ joints 1, 2, 3 give the "
            r"wrist centre no velocity if it is $\mathbf A$ that loses rank; about $\mathbf u$ joints 4, 5, 6 give the tool no angular velocity if it is $\mathbf W$",
            3,
            Numbers((3,), "1"),
            lost_direction,
            needs=("inverse_velocities_J",),
            check=judged_direction,
            credit="all",
            tolerance=DIRECTION,
            hints=(
                "Which vector is normal to all three columns of the block?",
                "Left or right: u^T A = 0 is not A u = 0.",
            ),
            explain=explain_direction,
        ),
        Part(
            "inverse_velocities_solutions",
            r"How many joint rates $\dot{\mathbf q}$ give your twist $\boldsymbol\xi$ at your $\mathbf q$: $\mathbf J \dot{\mathbf q} = \boldsymbol\xi$, all six components prescribed",
            1,
            Choice(("none", "exactly one", "infinitely many")),
            solutions,
            needs=("inverse_velocities_J",),
            hints=(
                "Compare the twist with the range of J.",
                "A posture without inverse may still allow a given velocity.",
            ),
            explain=explain_solutions,
        ),
        Part(
            "inverse_velocities_elbow",
            r"All $q_3$ in $(-\pi, \pi]$ at which the elbow is singular when the forearm has your $a_3$ and $d_4$ in place of the numbers of rows 3 and 4 of the table "
            r"(all other cells stay), in radians with 4 decimals",
            2,
            Configurations(1),
            elbow,
            check=judged_elbow,
            hints=("At which angles do axes 2 and 3 and the wrist centre lie in one plane?", "There is more than one."),
            explain=explain_elbow,
        ),
    ),
)
