"""S3 5.2: inverse velocities of the Puma 560 where J has no inverse.

The wrist axes meet in the tool point: J has a linear block of joints 1 to 3 (the arm), zeros beside
it, and an angular block of joints 4 to 6 (the wrist). S3 says that near a singular configuration a
joint's influence becomes almost zero; in fact columns become linearly dependent. The elbow is
singular at tan q3 = -d4/a3, not at -90 and 90 degrees.
"""

from typing import Any

import numpy as np

from ...solutions.ellipsoids import velocity_ellipsoid
from ...solutions.singularity import rank, singular_values
from ..answers import LETTERS, Choice, Configurations, Numbers
from ..arm import Arm, Array, arm_of
from ..arms.puma import PUMA, REACH, TABLE, drawn
from ..arms.puma_singular import blocks, elbow_angles, loses_one_direction, posture
from ..calculations.lost import (
    ANGLE,
    ZERO,
    judged_lost,
    left_over,
    lost_direction,
    weakest,
)
from ..draws import length, rates, until
from ..exercise import Outcome
from ..part import exercise, part
from ..properties import list_share, listed

ELBOW = 2e-3  # largest error of an angle of the elbow [rad]
REASONS = (
    "the wrist block: axes 4 and 6 lie in one line",
    "the arm block, elbow: the wrist centre lies in the plane of axes 2 and 3",
    "the arm block, shoulder: the wrist centre is as near to axis 1 as the offset d3 lets it come",
    "no block: det J is not zero",
    "none of these: J is not square",
)
SOLUTIONS = ("none", "exactly one", "infinitely many")
FULL_RANK = (
    "These are the numbers of joints; the rank depends on q. "
    "Did rounding of q pass for a singular value?"
)
WHOLE_J = "A block loses rank here; what does that do to the whole of J?"
RANKS = r"\left(\mathrm{rank}\,\mathbf J, \mathrm{rank}\,\mathbf A, \mathrm{rank}\,\mathbf W\right)"
ONE_BRANCH = "There is another branch: the tangent repeats after pi, the arm is straight or folded."
RIGHT_ANGLE = (
    "A right angle would be right without a3: the wrist centre lies beside the forearm's axis."
)
SIGN = "Look again at a sign: which sine and which cosine cancel each other?"
QUOTIENT = "Look again at the quotient: which of the two lengths stands with the sine?"

STATEMENT = rf"""{TABLE}

The tool frame is frame 6; its origin is the point where axes 4, 5 and 6 meet, the **wrist centre**.
All velocities are those of this point, in the axes of frame 0. Two blocks of $\mathbf J$ have
names: the **arm block** $\mathbf A$, the linear rows of joints 1, 2, 3, and the **wrist block**
$\mathbf W$, the angular rows of joints 4, 5, 6 (both 3 × 3).

Your $\mathbf q$ is a singular posture or very near one: it is rounded to six decimals at most.
Count a singular value as zero when it is less than a thousandth of the largest one of its matrix,
and a velocity as reached when it is met to three decimals.

$\boldsymbol\xi$ (linear above angular, for the fifth question) is a prescribed twist. The lengths
$a_3$ and $d_4$ among your numbers are for the **last question only**: there the forearm of the Puma
is exchanged for another one."""


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A posture singular in one way, a twist that may be out of reach, and another forearm."""
    way = int(rng.integers(3))
    q = until(lambda: posture(rng, way), lambda q: loses_one_direction(arm_of(PUMA, {"q": q})))
    J = arm_of(PUMA, {"q": q}).J
    xi = until(lambda: drawn_twist(rng, J), lambda xi: np.abs(xi).min() >= 0.02)
    return {"q": q, "xi": xi, "a3": length(rng, 0.03, 0.12), "d4": length(rng, 0.36, 0.52)}


def drawn_twist(rng: np.random.Generator, J: Array) -> list[float]:
    """A twist within reach or, as often, out of reach; the two look alike."""
    beside = float(rng.choice([0.0, 0.0, -0.4, 0.4]))
    xi = J @ rates(rng, 6) + beside * velocity_ellipsoid(J).axes[:, -1]
    return (np.round(xi, 4) + 0.0).tolist()


@part(
    3,
    Numbers((6, 6), [["m/rad"]] * 3 + [["1"]] * 3),
    shows={"axes": lambda arm: arm.axes},
)
def J(arm: Arm) -> Array:
    r"""The 6 × 6 Jacobian $\mathbf J$ at your $\mathbf q$, linear rows above angular rows

    - Column i takes the z axis and the origin of frame i - 1.
    - Which joints cannot move the wrist centre?

    Column $i$ is $\mathbf z_{i-1} \times (\mathbf o_6 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$.
    The axes $\mathbf z_0 \ldots \mathbf z_5$ as columns:
    $$\left[\mathbf z_0 \cdots \mathbf z_5\right] = <axes>$$

    The tool point is the wrist centre, $\mathbf o_6 = \mathbf o_5 = \mathbf o_4 = \mathbf o_3$: the
    wrist cannot move it, and the upper right block is zero.
    $$\mathbf J = \begin{bmatrix}\mathbf A & \mathbf 0\\ \mathbf C & \mathbf W\end{bmatrix} = <J>$$
    """
    return arm.J


def sizes(J: Array) -> str:
    """Singular values of J, A and W."""
    A, W = blocks(J)
    return (
        rf"of $\mathbf J$: {in_words(J)}; of $\mathbf A$: {in_words(A)}; "
        rf"of $\mathbf W$: {in_words(W)}"
    )


def in_words(block: Array) -> str:
    """The singular values of a block, with four decimals."""
    return ", ".join(f"{size:.4f}" for size in singular_values(block))


@part(
    2,
    Numbers((3,), "1", decimals=0),
    credit="all",
    tolerance=1e-6,
    shows={"sizes": sizes, "symbols": lambda: RANKS},
    mistakes=[
        (FULL_RANK, lambda: np.array([6, 3, 3])),
        (WHOLE_J, lambda ranks: np.array([6, *ranks[1:]])),
    ],
)
def ranks(J: Array) -> Array:
    r"""The ranks of $\mathbf J$, of $\mathbf A$ and of $\mathbf W$ at your $\mathbf q$, in this
    order

    - A program counts singular values; what counts as zero is said above.
    - One posture, three ranks.

    The rank is the number of singular values that are not zero. It depends on $\mathbf q$: a Puma
    has six degrees of freedom, and rank 6 at most postures. Where $\mathbf A$ or $\mathbf W$ loses
    one, so does $\mathbf J$.

    Singular values <sizes>. The ranks:
    $$<symbols> = <ranks>$$
    """
    return np.array([rank(block, ZERO) for block in (J, *blocks(J))])


@part(
    1,
    Choice(REASONS),
    shows={"det": lambda arm: arm.determinant, "factors": lambda arm: arm.factors},
)
def reason(arm: Arm) -> str:
    r"""What keeps $\mathbf J$ from having an inverse at your $\mathbf q$

    - The determinant of J is that of A times that of W.
    - Which joints does each case depend on?

    $\mathbf J$ is 6 × 6. With the zero block,
    $\det \mathbf J = \det \mathbf A \cdot \det \mathbf W$; it is the product of a length and of one
    factor each for wrist, elbow and shoulder:
    $$\det \mathbf J = <det>$$

    Wrist, elbow and shoulder factor at your posture; the one that is zero names the reason:
    $$<factors>$$
    """
    return LETTERS[int(np.argmin(np.abs(arm.factors)))]


@part(
    3,
    Numbers((3,)),
    check=lambda J, value: judged_lost(weakest(blocks(J)), value),
    credit="all",
    tolerance=ANGLE,
)
def lost(J: Array) -> Array:
    r"""The unit vector $\mathbf u$ of the direction that is lost, in base axes, with either sign:
    along $\mathbf u$ joints 1, 2, 3 give the wrist centre no velocity if it is $\mathbf A$ that
    loses rank; about $\mathbf u$ joints 4, 5, 6 give the tool no angular velocity if it is
    $\mathbf W$

    - Which vector is normal to all three columns of the block?
    - Left or right: u^T A = 0 is not A u = 0.

    A velocity $\mathbf v$ is reached when it is a combination of the columns of the block. They are
    linearly dependent and span a plane; lost is its normal $\mathbf u$, with
    $\mathbf u^T \mathbf A = \mathbf 0$ or $\mathbf u^T \mathbf W = \mathbf 0$: the cross product of
    two columns that are not parallel, or the last left singular vector. Its sign is free:
    $$\mathbf u = <lost>$$
    """
    return lost_direction(weakest(blocks(J)))


@part(
    1,
    Choice(SOLUTIONS),
    shows={"left": left_over, "found": lambda solutions: SOLUTIONS[LETTERS.index(solutions)]},
)
def solutions(J: Array, xi: Array) -> str:
    r"""How many joint rates $\dot{\mathbf q}$ give your twist $\boldsymbol\xi$ at your $\mathbf q$:
    $\mathbf J \dot{\mathbf q} = \boldsymbol\xi$, all six components prescribed

    - Compare the twist with the range of J.
    - A posture without inverse may still allow a given velocity.

    $\mathbf J \dot{\mathbf q} = \boldsymbol\xi$ has a solution exactly when the best
    $\dot{\mathbf q} = \mathbf J^{+} \boldsymbol\xi$ leaves nothing over. Rates with
    $\mathbf J \dot{\mathbf q} = \mathbf 0$ may then be added at will, and at rank 5 there are such.
    What is left over:
    $$\mathbf J \mathbf J^{+} \boldsymbol\xi - \boldsymbol\xi = <left>$$

    So there are: <found>.
    """
    if np.linalg.norm(left_over(J, xi)) > 0.01 * np.linalg.norm(xi):
        return "a"
    if rank(J, ZERO) == 6:
        return "b"
    return "c"


def judged_elbow(a3: float, d4: float, elbow: Array, value: Array) -> Outcome:
    """Each wrong angle costs a right one, and the slip is named, up to sign and half a turn."""
    right, share = list_share(value, elbow, ELBOW)
    if right.all() and share < 1:
        return Outcome(right, finding=ONE_BRANCH, share=share)

    slips = (
        (np.pi / 2, RIGHT_ANGLE),
        (np.arctan2(d4, a3), SIGN),
        (np.arctan2(a3, d4), QUOTIENT),
    )
    wrong = value[~right[:, 0]]
    for slip, sentence in slips:
        is_slip, _ = listed(wrong, [[slip], [-slip], [slip - np.pi], [np.pi - slip]], ELBOW)
        if is_slip.any():
            return Outcome(right, finding=sentence, share=share)
    return Outcome(right, share=share)


@part(2, Configurations(1), check=judged_elbow, shows={"angles": lambda elbow: elbow[:, 0]})
def elbow(a3: float, d4: float) -> Array:
    r"""All $q_3$ in $(-\pi, \pi]$ at which the elbow is singular when the forearm has your $a_3$
    and $d_4$ in place of the numbers of rows 3 and 4 of the table (all other cells stay), in
    radians with 4 decimals

    - At which angles do axes 2 and 3 and the wrist centre lie in one plane?
    - There is more than one.

    The factor of the elbow holds $q_3$ alone: $a_3 \sin q_3 + d_4 \cos q_3 = 0$, so
    $\tan q_3 = -\frac{d_4}{a_3}$. The tangent repeats after $\pi$, which gives two angles in
    $(-\pi, \pi]$: the arm stretched and the arm folded.
    $$q_3 = <angles>$$
    """
    return elbow_angles(a3, d4)[:, None]


EXERCISE = exercise(
    "inverse_velocities",
    title="Inverse velocities at a singular posture",
    source="S3 5.2",
    minutes=60,
    objectives=(
        "Tell from rank and determinant whether a Jacobian can be inverted.",
        (
            "Find the direction that a singular posture loses, and whether a velocity can still "
            "be reached."
        ),
    ),
    robot=PUMA,
    sizes=(),  # the drawn a3 and d4 are for the last question
    units={"xi": ["m/s"] * 3 + ["rad/s"] * 3, "a3": "m", "d4": "m"},
    scale=REACH,
    draw=draw,
    statement=STATEMENT,
    drawings=drawn,
    parts=(J, ranks, reason, lost, solutions, elbow),
)
