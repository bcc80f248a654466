"""S2, S4: the columns of a Jacobian as cross products of axes and lever arms.

The axes are skew and their lengths are whole: it can be done on paper, and no component hides a
wrong sign.
"""

from typing import Any

import numpy as np

from ...solutions.axes import along, assembled
from ..arm import Array
from ..calculations.columns import REVERSED, columns
from ..contract.introduction import WORDS
from ..contract.names import Function
from ..drawing import Drawing, Triad
from ..draws import until
from ..exercise import Numbers, Variant
from ..part import exercise, part

WHOLE = (
    (1, 2, 2),
    (2, 3, 6),
    (1, 4, 8),
    (4, 4, 7),
    (2, 6, 9),
    (6, 6, 7),
)  # of lengths 3, 7, 9, 9, 11, 11
VECTORS = {
    "omega": "rad/s",
    "r": "m",
    "w1": "1",
    "w2": "1",
    "w3": "1",
    "p1": "m",
    "p2": "m",
    "p3": "m",
    "p": "m",
}
TELLING = 0.05  # smallest size of a component that is asked, and smallest change by a known mistake


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm with two revolute joints and a prismatic one, and a turning body; all components tell their signs."""
    kinds = ("RRP", "RPR", "PRR")[int(rng.integers(3))]

    def drawn() -> dict[str, Any]:
        v: dict[str, Any] = {
            "kinds": kinds,
            "omega": numbers(rng, 3, 15, 10),
            "r": numbers(rng, 15, 90, 100),
        }
        v |= {name: direction(rng) for name in ("w1", "w2", "w3")}
        octant = [*rng.choice([-1, 1], 2), 1]
        outward = np.cumsum([rng.integers(10, 45, 3) for _ in range(4)], axis=0) * octant / 100
        return v | dict(zip(("p1", "p2", "p3", "p"), outward.round(2).tolist(), strict=True))

    return until(drawn, is_telling)


def numbers(rng: np.random.Generator, low: int, high: int, parts: int) -> list[float]:
    """Three numbers of either sign and of sizes low/parts to high/parts, all sizes different."""
    sizes = rng.choice(np.arange(low, high + 1), 3, replace=False) * rng.choice([-1, 1], 3)
    return [round(float(size) / parts, 2) for size in sizes]


def direction(rng: np.random.Generator) -> list[int]:
    """A vector of whole numbers whose length is whole."""
    return (rng.permutation(WHOLE[int(rng.integers(len(WHOLE)))]) * rng.choice([-1, 1], 3)).tolist()


def is_telling(v: Variant) -> bool:
    """Whether the axes are skew, no asked component is small, and every known mistake shows."""
    z, right = axes(v), linear(v)
    skew = np.linalg.norm(np.cross(z, np.roll(z, 1, axis=0)), axis=1)
    asked = np.abs([*right.ravel(), *velocity(v["omega"], v["r"])])
    shows = min(np.abs(right - wrong(v)).max() for _, wrong in WRONG_LINEAR)
    return bool(shows > TELLING and skew.min() > 0.5 and asked.min() > TELLING)


def directions(v: Variant) -> Array:
    """The directions of axes 1, 2, 3 as they are printed, one a row (3, 3)."""
    return np.array([v["w1"], v["w2"], v["w3"]], dtype=float)


def axes(v: Variant) -> Array:
    """The unit vectors along them, one a row (3, 3)."""
    return directions(v) / np.linalg.norm(directions(v), axis=1, keepdims=True)


def path(v: Variant) -> Array:
    """The base origin, the points on the axes and the tool point, one a row (5, 3)."""
    return np.array([np.zeros(3), v["p1"], v["p2"], v["p3"], v["p"]])


def levers(v: Variant) -> Array:
    """The lever arms from each axis to the tool point, one a row (3, 3)."""
    return path(v)[4] - path(v)[1:4]


def whole(v: Variant, kinds: str = "", z: Function = axes, lever: Function = levers) -> Array:
    """The Jacobian (6, 3) with these types of joints, axes and lever arms; without them, the right one."""
    return columns(z(v), lever(v), kinds or v["kinds"])


def revolute(v: Variant) -> list[int]:
    """Places of the revolute joints, from 0."""
    return [i for i, kind in enumerate(v["kinds"]) if kind == "R"]


def slides(v: Variant) -> int:
    """Place of the prismatic joint, from 0."""
    return v["kinds"].index("P")


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
ORIGIN = "The lever arm seems to start or to end at the base origin; it goes from the joint to the tool point."
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
    *(
        (said, lambda v, *, lever=lever: whole(v, lever=lever)[:3, revolute(v)])
        for said, lever in LEVERS
    ),
    (MINUS, lambda v: whole(v)[:3, revolute(v)] * [[1], [-1], [1]]),
    (NOT_DIVIDED, lambda v: whole(v, z=directions)[:3, revolute(v)]),
    (SLIDING, lambda v: np.delete(whole(v, "RRR")[:3], revolute(v)[1], axis=1)),
    (SLIDING, lambda v: np.delete(whole(v, "RRR")[:3], revolute(v)[0], axis=1)),
    (REVERSED, lambda v: -whole(v)[:3, revolute(v)]),
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
    return whole(v)[:3, revolute(v)]


TURNING = "This is the column of a revolute joint; the joint slides."
ANGULAR = "Look again at the angular part: does the tool turn when a prismatic joint moves?"
LEVER = "A lever arm seems to be in it; does it matter for a slide where the tool point is?"
ORDER = "The columns seem to be in another order than the joints."
OTHER_AXIS = "This is the axis of another joint; which joint slides?"
WRONG_SLIDE = (
    (TURNING, lambda v: whole(v, "RRR")[:, slides(v)]),
    (ANGULAR, lambda v: np.tile(axes(v)[slides(v)], 2)),
    (LEVER, lambda v: whole(v, "RRR")[:, slides(v)] * [1, 1, 1, 0, 0, 0]),
    (NOT_DIVIDED, lambda v: whole(v, z=directions)[:, slides(v)]),
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
    return whole(v)[:, slides(v)]


def stacked(v: Variant, linear: Array, slide: Array) -> Array:
    """Linear parts (3, 2) above the axes, and the prismatic column (6,) in its place."""
    return np.insert(np.concatenate([linear, axes(v)[revolute(v)].T]), slides(v), slide, axis=1)


@part(
    3,
    Numbers((6, 3), [["m/rad"] * 3] * 3 + [["1"] * 3] * 3, 3),
    credit="column",
    mistakes=(
        *(
            (
                f"The prismatic column: {said}",
                lambda v, linear, *, wrong=wrong: stacked(v, linear, wrong(v)),
            )
            for said, wrong in WRONG_SLIDE
        ),
        (NOT_DIVIDED, lambda v: whole(v, z=directions)),
        (f"The angular rows: {NOT_DIVIDED}", lambda v, J: [*J[:3], *whole(v, z=directions)[3:]]),
        (f"The linear rows: {REVERSED}", lambda v, linear, slide: stacked(v, -linear, slide)),
        (ORDER, lambda v, J: J[:, [*revolute(v), slides(v)] if slides(v) < 2 else [2, 0, 1]]),
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


def drawings(v: Variant) -> Drawing:
    """The arm as it stands, with any x axes across the joint axes."""
    joints = zip(v["kinds"], map(along, axes(v), path(v)[1:4]), strict=True)
    words = ", ".join(WORDS[kind] for kind in v["kinds"])
    return Drawing(
        assembled([*joints, along(axes(v)[2], path(v)[4])]),
        (0.0, 0.0, 0.0),
        "The arm at this moment, with the base frame and the positive sense of each joint.",
        f"Arm with three joints ({words}) on axes that are skew to the base axes, drawn as it stands at this moment.",
        (Triad(np.eye(4), "0"),),
        view=(float(np.degrees(np.arctan2(v["p"][1], v["p"][0]))) - 80, 22.0),
    )


def statement(kinds: str) -> str:
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
    units={name: [unit] * 3 for name, unit in VECTORS.items()},
    structure=("kinds",),
    draw=draw,
    statement=statement,
    drawings=drawings,
    scale=lambda v: np.linalg.norm(v["p"]),
    parts=(velocity, linear, slide, J),
)
