"""S2, S4: the columns of a Jacobian as cross products of axes and lever arms.

The axes are skew and their lengths are whole: it can be done on paper, and no component hides a
wrong sign.
"""

from typing import Any

import numpy as np

from ..arm import Array
from ..arms.skew import (
    DIRECTIONS,
    POINTS,
    axes,
    direction,
    directions,
    drawn,
    levers,
    outward,
    path,
    revolute,
    slides,
    sliding_column,
    turning_parts,
    whole,
)
from ..calculations.columns import REVERSED
from ..contract.introduction import WORDS
from ..contract.names import Function
from ..draws import until
from ..exercise import Numbers, Variant
from ..part import exercise, part

UNITS = {"omega": "rad/s", "r": "m", **dict.fromkeys(DIRECTIONS, "1"), **dict.fromkeys(POINTS, "m")}
TELLING = 0.05  # smallest size of a component that is asked, and smallest change by a known mistake


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """A turning body, and an arm with two revolute joints and a slide; no sign is hidden."""
    kinds = ("RRP", "RPR", "PRR")[int(rng.integers(3))]

    def arm_and_body() -> dict[str, Any]:
        v: dict[str, Any] = {"kinds": kinds}
        v["omega"] = numbers(rng, 3, 15, 10)
        v["r"] = numbers(rng, 15, 90, 100)
        for name in DIRECTIONS:
            v[name] = direction(rng)
        return v | outward(rng)

    return until(arm_and_body, is_telling)


def numbers(rng: np.random.Generator, low: int, high: int, parts: int) -> list[float]:
    """Three numbers of either sign and of sizes low/parts to high/parts, all sizes different."""
    sizes = rng.choice(np.arange(low, high + 1), 3, replace=False) * rng.choice([-1, 1], 3)
    return [round(float(size) / parts, 2) for size in sizes]


def is_telling(v: Variant) -> bool:
    """Whether the axes are skew, no asked component is small, and every known mistake shows."""
    z, right = axes(v), linear(v)
    skew = np.linalg.norm(np.cross(z, np.roll(z, 1, axis=0)), axis=1)
    asked = np.abs([*right.ravel(), *velocity(v["omega"], v["r"])])
    if skew.min() <= 0.5 or asked.min() <= TELLING:
        return False
    changes = [np.abs(right - wrong(v)).max() for _, wrong in WRONG_LINEAR]
    return min(changes) > TELLING


MINUS = "The second component of the cross product has the wrong sign; look again at its rule."
WRONG_VELOCITY = (
    (MINUS, lambda velocity: velocity * [1, -1, 1]),
    (REVERSED, lambda velocity: -velocity),
)


@part(1, Numbers((3,), "m/s", 3), credit="all", mistakes=WRONG_VELOCITY)
def velocity(omega: Array, r: Array) -> Array:
    r"""The velocity $\dot{\mathbf r} = \boldsymbol\omega \times \mathbf r$ of the point of the
    turning body, in m/s

    - The result is perpendicular to both vectors: two dot products test it.

    $\dot{\mathbf r} = \boldsymbol\omega \times \mathbf r = (\omega_y r_z - \omega_z r_y,\;
    \omega_z r_x - \omega_x r_z,\; \omega_x r_y - \omega_y r_x)$. With your numbers:
    $$\dot{\mathbf r} = <velocity>$$
    """
    return np.cross(omega, r)


NOT_DIVIDED = "The directions seem to be used as printed; divide each by its length first."
OWN_LINK = (
    "The lever arm seems to be the joint's own link; it goes from the joint to the tool point."
)
ONE_EARLY = "The lever arm seems to start at the point before; it starts at the joint itself."
ORIGIN = (
    "The lever arm seems to start or to end at the base origin; "
    "it goes from the joint to the tool point."
)
SLIDING = (
    "One of these columns is that of the joint that slides; the two revolute joints are asked."
)
LEVERS = (
    (OWN_LINK, lambda v: np.diff(path(v), axis=0)[1:]),
    (OWN_LINK, lambda v: np.diff(path(v), axis=0)[:3]),
    (ONE_EARLY, lambda v: path(v)[4] - path(v)[:3]),
    (ORIGIN, lambda v: path(v)[1:4]),
    (ORIGIN, lambda v: path(v)[4]),
)
WRONG_LINEAR = (
    *[(said, lambda v, *, lever=lever: turning_parts(v, lever=lever)) for said, lever in LEVERS],
    (MINUS, lambda v: turning_parts(v) * [[1], [-1], [1]]),
    (NOT_DIVIDED, lambda v: turning_parts(v, z=directions)),
    (SLIDING, lambda v: np.delete(whole(v, "RRR")[:3], revolute(v)[1], axis=1)),
    (SLIDING, lambda v: np.delete(whole(v, "RRR")[:3], revolute(v)[0], axis=1)),
    (REVERSED, lambda v: -turning_parts(v)),
)
SHOWN = {"z": lambda v: axes(v)[revolute(v)].T, "lever": lambda v: levers(v)[revolute(v)].T}


@part(4, Numbers((3, 2), "m/rad", 3), credit="column", shows=SHOWN, mistakes=WRONG_LINEAR)
def linear(v: Variant) -> Array:
    r"""The linear parts (velocity of the tool point at a unit rate) of the Jacobian's columns of
    the two revolute joints, in the order of the joints, as the columns of a 3 × 2 matrix

    - Which vector leads from the joint to the point whose velocity is asked?
    - An axis enters as a unit vector.

    A unit rate of joint $i$ turns everything behind it with $\boldsymbol\omega = \mathbf z_i$, so
    the tool point moves with $\mathbf z_i \times (\mathbf p - \mathbf p_i)$. The axes $\mathbf z_i$
    of the two revolute joints:
    $$<z>$$

    The lever arms $\mathbf p - \mathbf p_i$:
    $$<lever>$$

    The cross products, column by column:
    $$<linear>$$
    """
    return turning_parts(v)


TURNING = "This is the column of a revolute joint; the joint slides."
ANGULAR = "Look again at the angular part: does the tool turn when a prismatic joint moves?"
LEVER = "A lever arm seems to be in it; does it matter for a slide where the tool point is?"
ORDER = "The columns seem to be in another order than the joints."
OTHER_AXIS = "This is the axis of another joint; which joint slides?"
WRONG_SLIDE = (
    (TURNING, lambda v: sliding_column(v, "RRR")),
    (ANGULAR, lambda v: np.tile(axes(v)[slides(v)], 2)),
    (LEVER, lambda v: sliding_column(v, "RRR") * [1, 1, 1, 0, 0, 0]),
    (NOT_DIVIDED, lambda v: sliding_column(v, z=directions)),
    (OTHER_AXIS, lambda v: whole(v, "PPP")[:, revolute(v)[0]]),
    (OTHER_AXIS, lambda v: whole(v, "PPP")[:, revolute(v)[1]]),
)


@part(
    2,
    Numbers((6,), "1", 3),
    credit="all",
    shows={"joint": lambda v: slides(v) + 1},
    mistakes=WRONG_SLIDE,
)
def slide(v: Variant) -> Array:
    r"""The whole column (three linear entries, then three angular ones) of the prismatic joint

    - How does the tool turn when the joint slides?
    - Does it matter where the tool point is?

    A unit rate of a prismatic joint moves everything behind it along $\mathbf z_i$ and turns
    nothing, wherever the tool point is: $\mathbf z_i$ above zeros. With your numbers,
    $i = <joint>$:
    $$\mathbf J_i = <slide>$$
    """
    return sliding_column(v)


def stacked(v: Variant, linear: Array, slide: Array) -> Array:
    """Linear parts (3, 2) above the axes, and the prismatic column (6,) in its place."""
    turning = np.concatenate([linear, axes(v)[revolute(v)].T])
    return np.insert(turning, slides(v), slide, axis=1)


def with_slide(column: Function) -> Function:
    """The Jacobian with this column of the prismatic joint."""
    return lambda v, linear: stacked(v, linear, column(v))


def slide_moved(v: Variant, J: Array) -> Array:
    """The prismatic column behind the others; in front of them, where it is the last."""
    if slides(v) == 2:
        return J[:, [2, 0, 1]]
    return J[:, [*revolute(v), slides(v)]]


@part(
    3,
    Numbers((6, 3), [["m/rad"] * 3] * 3 + [["1"] * 3] * 3, 3),
    credit="column",
    mistakes=(
        *[(f"The prismatic column: {said}", with_slide(wrong)) for said, wrong in WRONG_SLIDE],
        (NOT_DIVIDED, lambda v: whole(v, z=directions)),
        (f"The angular rows: {NOT_DIVIDED}", lambda v, J: [*J[:3], *whole(v, z=directions)[3:]]),
        (f"The linear rows: {REVERSED}", lambda v, linear, slide: stacked(v, -linear, slide)),
        (ORDER, slide_moved),
    ),
)
def J(v: Variant, linear: Array, slide: Array) -> Array:
    r"""The 6 × 3 Jacobian $\mathbf J$ of the tool point in base axes, columns in the order of the
    joints, linear rows above angular rows

    - What stands below the linear part of a revolute joint's column?

    Columns in the order of the joints: $\mathbf z_i \times (\mathbf p - \mathbf p_i)$ above
    $\mathbf z_i$ for a revolute joint, $\mathbf z_i$ above zeros for the prismatic one. With your
    numbers:
    $$\mathbf J = <J>$$
    """
    return stacked(v, linear, slide)


def statement(kinds: str) -> str:
    """The turning body, and the arm with its types of joints."""
    types = ", ".join(f"joint {i} is **{WORDS[kind]}**" for i, kind in enumerate(kinds, 1))
    return rf"""All vectors are in base axes.

A body turns with the angular velocity $\boldsymbol\omega$ about an axis through a fixed point, and
$\mathbf r$ leads from that point to a point of the body.

Apart from that, an arm has three joints, counted from the base: {types}. At this moment the axis of
joint $i$ goes through the point $\mathbf p_i$ in the direction of $\mathbf w_i$; its unit vector is
$\mathbf z_i = \mathbf w_i / \sqrt{{\mathbf w_i \cdot \mathbf w_i}}$ (the root is a whole number),
and the joint turns about it, or slides along it, in its positive sense. The tool point is at
$\mathbf p$. Points are given by their coordinates in the base frame."""


EXERCISE = exercise(
    "cross_products",
    title="Columns of a Jacobian by cross products",
    source="S2, S4",
    minutes=25,
    objectives=(
        "Compute the velocity of a point of a turning body.",
        "Build the columns of a Jacobian from axes and points, revolute and prismatic.",
    ),
    units={name: [unit] * 3 for name, unit in UNITS.items()},
    structure=("kinds",),
    draw=draw,
    statement=statement,
    drawings=drawn,
    scale=lambda v: np.linalg.norm(v["p"]),
    parts=(velocity, linear, slide, J),
)
