"""S2: from a Denavit-Hartenberg table to the transforms of the links and of the frames.

S2 prints its columns as theta, alpha, r, d, other texts in other orders; here the order is drawn,
so that labels have to be read. Its chain T_0^0 T_1^0 T_2^0 ... is a known mistake: taken literally
it stops a link short, or has link 1 twice.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ...solutions.chain import modified_transform, standard_transform
from ...solutions.expression_array import ExpressionArray
from ..answers import Formulas, Numbers, Variant
from ..arm import Array
from ..arms.degree_table import (
    DEGREES,
    LEFT_OUT,
    LENGTHS,
    RADIANS,
    Texts,
    closed,
    drawn,
    drawn_table,
    numbers,
    printed,
    rows,
)
from ..contract.introduction import joint_types
from ..contract.question import Wrong
from ..draws import until
from ..exercise import Outcome
from ..part import exercise, part

MOST_ZEROS = 0.2  # share of the entries that are zero only in a wrong pose
PLAIN = 0.08  # smallest entry of a rotation that is not zero, and how far the others stay from one


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A table of three rows with one negative length, whose frames hide no mistake."""
    return until(lambda: drawn_table(rng), is_telling)


def is_telling(v: Variant) -> bool:
    """Whether no entry hides a sign, a1 differs from d1, and wrong links can be followed."""
    if abs(abs(v["a1"]) - abs(v["d1"])) <= 0.05:
        return False
    poses = frames(links(v))
    if not is_plain(poses[:, :3, :3]).all():
        return False

    # Wrong poses can be followed where they are as full as the right ones.
    zero_or_one = np.isclose(np.abs(poses) * (1 - np.abs(poses)), 0)
    for wrong in (modified_transform(numbers(v)), standard_transform(numbers(v, LEFT_OUT))):
        is_zero = np.abs(frames(wrong)) < 1e-3
        if is_zero[~zero_or_one].mean() >= MOST_ZEROS:
            return False
    return True


def is_plain(rotations: Array) -> Array:
    """Which entries are zero, one, or far from both."""
    sizes = np.abs(rotations)
    is_between = (sizes > PLAIN) & (sizes < 1 - PLAIN / 4)
    return (sizes < 1e-9) | (sizes > 1 - 1e-9) | is_between


def statement(v: Variant) -> str:
    """The table with its columns in the drawn order, and what they mean."""
    heading = (
        f"The table of an arm with three joints ({joint_types(v['kinds'])}) in the **standard** "
        "Denavit–Hartenberg convention:"
    )
    return rf"""{heading}

{printed(v)}

Mind the order of the columns: it is not the same in every table. From frame $i-1$, turn by
$\theta_i$ about its $\mathbf z$ and go $d_i$ along it, then go $a_i$ along the new $\mathbf x$ and
turn by $\alpha_i$ about it: that is frame $i$. Angles of the table are in degrees, the joint angles
$q_i$ below in radians; $s_i$ is the stroke of a prismatic joint. A length may be negative.
$\mathbf T_j^i$ is the 4 × 4 pose of frame $i$ in the coordinates of frame $j$."""


MODIFIED = (
    "The steps of a row seem to be taken in the order of the modified convention; "
    "the table is in the standard convention."
)
EXCHANGED = "The columns a and d seem exchanged; read the labels of the columns."
OTHER_WAY = "The turn by alpha seems to go the other way."
FORGOTTEN = "The constant angles in the column of theta seem to be left out."
AS_THEY_ARE = (
    "The constant angles in the column of theta, printed in degrees, "
    "seem to be added to radians as they are."
)
ALPHA_DEGREES = "The angles alpha, printed in degrees, seem to be used as radians."
ALL_DEGREES = "The angles of the table, printed in degrees, seem to be used as radians."
FROM_0 = (
    "The factors seem to be poses in frame 0, so that link 1 comes twice; "
    "each factor shall start where the one before it ends."
)
WRONG_ORDER = "The transforms of the links seem to be multiplied in the wrong order."
BY_ENTRY = "The matrices seem to be multiplied entry by entry (*); their product takes @."
GENERAL = (
    r"\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i) = \begin{bmatrix} "
    r"\cos\theta_i & -\sin\theta_i \cos\alpha_i & \sin\theta_i \sin\alpha_i & a_i \cos\theta_i \\ "
    r"\sin\theta_i & \cos\theta_i \cos\alpha_i & -\cos\theta_i \sin\alpha_i & a_i \sin\theta_i \\ "
    r"0 & \sin\alpha_i & \cos\alpha_i & d_i \\ 0 & 0 & 0 & 1 \end{bmatrix}"
)
POSE = [["1", "1", "1", "m"]] * 3 + [["1"] * 4]


def misread_angles(solve: Callable[[Variant, Texts, Texts], Any]) -> list[Wrong]:
    """Mistakes in the constant angles of theta and alpha, for a part that `solve` answers."""
    return [
        (FORGOTTEN, lambda v: solve(v, LEFT_OUT, RADIANS)),
        (AS_THEY_ARE, lambda v: solve(v, DEGREES, RADIANS)),
        (ALPHA_DEGREES, lambda v: solve(v, RADIANS, DEGREES)),
        (ALL_DEGREES, lambda v: solve(v, DEGREES, DEGREES)),
    ]


def first_row(v: Variant, theta: Texts = RADIANS, alpha: Texts = RADIANS) -> ExpressionArray:
    """The transform of row 1 with these texts for its constant angles."""
    return closed(*rows(v, theta, alpha)[0])


def first_turned_back(v: Variant) -> ExpressionArray:
    """The transform of row 1 with the other sense of alpha."""
    theta, d, a, alpha = rows(v)[0]
    return closed(theta, d, a, f"-({alpha})")


def first_exchanged(v: Variant) -> ExpressionArray:
    """The transform of row 1 with a for d."""
    theta, d, a, alpha = rows(v)[0]
    return closed(theta, a, d, alpha)


@part(
    3,
    Formulas((4, 4), ("q1", "a1", "d1")),
    shows={
        "general": lambda: GENERAL,
        "theta": lambda offset: f"{offset[0]:+d}°",
        "twist": lambda alpha: f"{alpha[0]}°",
        "sine": lambda alpha: f"{alpha[0] // 90}",
    },
    mistakes=(
        (MODIFIED, lambda v: closed(*rows(v)[0], "modified")),
        (EXCHANGED, first_exchanged),
        (OTHER_WAY, first_turned_back),
        *misread_angles(first_row),
    ),
)
def first(v: Variant) -> ExpressionArray:
    r"""The transform $\mathbf T_0^1$ of row 1, as 4 × 4 formulas in `q1`, `a1`, `d1`, with a `*` in
    every product and angles in radians (`pi/2` for 90°), such as `2*d1*cos(q1)`; sines and cosines
    of the right angles may be evaluated

    - Which two motions of a row are about or along z, which about or along x?
    - What are sine and cosine of an angle that is shifted by a right angle?

    In the standard convention $<general>$. Row 1 has $\theta_1 = q_1 <theta>$ and
    $\alpha_1 = <twist>$, so $\cos\alpha_1 = 0$ and $\sin\alpha_1 = <sine>$:
    $$\mathbf T_0^1 = <first>$$
    """
    return first_row(v)


@part(
    3,
    Numbers((3, 4, 4), [POSE]),
    shows={"general": lambda: GENERAL},
    mistakes=(
        (MODIFIED, lambda v: modified_transform(numbers(v))),
        (EXCHANGED, lambda v: standard_transform(numbers(v)[:, [0, 2, 1, 3]])),
        *misread_angles(lambda v, theta, alpha: standard_transform(numbers(v, theta, alpha))),
    ),
)
def links(v: Variant) -> Array:
    r"""The transforms $\mathbf T_0^1, \mathbf T_1^2, \mathbf T_2^3$ of the three rows at your joint
    values, stacked to an array 3 × 4 × 4

    - Write one function of theta, d, a, alpha and call it for each row.
    - sin and cos take radians.

    Put each row into $<general>$. In a revolute row the joint variable is in $\theta_i$, in a
    prismatic row it is $d_i$. With your numbers:
    $$\mathbf T_0^1,\; \mathbf T_1^2,\; \mathbf T_2^3 = <links>$$
    """
    return standard_transform(numbers(v))


def literal_chain(links: Array) -> Array:
    """S2's T_0^0 T_1^0 T_2^0 as it stands: poses in frame 0 multiplied with each other."""
    return np.array([links[0], links[0] @ links[0] @ links[1]])


def reversed_chain(links: Array) -> Array:
    """The last link as the first factor."""
    return np.array([links[1] @ links[0], links[2] @ links[1] @ links[0]])


def refuse_literal(value: Array, links: Array) -> Outcome:
    """The literal chain, which meets some columns by chance, earns nothing for them."""
    if np.abs(value - literal_chain(links)).max() <= 2e-3:
        return Outcome(share=0.0)
    return Outcome()


@part(
    4,
    Numbers((2, 4, 4), [POSE]),
    check=refuse_literal,
    mistakes=(
        (FROM_0, literal_chain),
        (WRONG_ORDER, reversed_chain),
        (BY_ENTRY, lambda links: np.array([links[0] * links[1], links[0] * links[1] * links[2]])),
    ),
)
def frames(links: Array) -> Array:
    r"""The poses $\mathbf T_0^2$ and $\mathbf T_0^3$ of frames 2 and 3 in frame 0, stacked to an
    array 2 × 4 × 4

    - Neighbouring indices have to fit: where one factor ends, the next one starts.
    - Matrix products take @.

    Each factor starts where the one before it ends: $\mathbf T_0^2 = \mathbf T_0^1\,\mathbf T_1^2$
    and $\mathbf T_0^3 = \mathbf T_0^2\,\mathbf T_2^3$. With your numbers:
    $$\mathbf T_0^2,\; \mathbf T_0^3 = <frames>$$
    """
    return np.array([links[0] @ links[1], links[0] @ links[1] @ links[2]])


EXERCISE = exercise(
    "dh_transforms",
    title="From a Denavit–Hartenberg table to transforms",
    source="S2",
    minutes=35,
    objectives=(
        "Turn each row of a Denavit–Hartenberg table into a transform.",
        "Chain the transforms of the links to the poses of all frames.",
    ),
    units={
        **dict.fromkeys(("q1", "q2", "q3"), "rad"),
        **dict.fromkeys(("s2", "s3"), "m"),
        **dict.fromkeys(LENGTHS, "m"),
    },
    structure=("kinds", "order", "alpha", "offset"),
    scale=lambda v: float(np.abs(numbers(v)[:, 1:3]).sum()),
    draw=draw,
    statement=statement,
    drawings=lambda v: drawn(v, frames(links(v))[-1]),
    parts=(first, links, frames),
)
