"""S2, S4: the columns of a Jacobian as cross products of axes and lever arms.

The axes are skew to the base axes, with whole numbers as their lengths, so that everything can be done on paper and no
component of a cross product hides a wrong sign.
"""

import math
from collections.abc import Callable
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.chain import Chain
from ..drawing import Drawing, Triad
from ..draws import until
from ..exercise import Exercise, Given, Mistake, Numbers, Outcome, Part, Step, Variant

Array = NDArray[np.float64]
KINDS = ("RRP", "RPR", "PRR")
WHOLE = ((1, 2, 2), (2, 3, 6), (1, 4, 8), (4, 4, 7), (2, 6, 9), (6, 6, 7))  # of lengths 3, 7, 9, 9, 11, 11
TELLING = 0.05  # smallest size of a component that is asked, and smallest change by a known mistake
JOINTS = (1, 2, 3)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm with two revolute joints and a prismatic one, and a turning body; all components tell their signs."""
    kinds = KINDS[int(rng.integers(len(KINDS)))]

    def drawn() -> dict[str, Any]:
        v: dict[str, Any] = {"kinds": kinds, "omega": _numbers(rng, 3, 15, 10), "r": _numbers(rng, 15, 90, 100)}
        v |= {f"w{i}": _direction(rng) for i in JOINTS}
        octant = [*(int(sign) for sign in rng.choice([-1, 1], 2)), 1]
        steps = np.cumsum([rng.integers(10, 45, 3) for _ in range(4)], axis=0) * octant
        outward = [[round(float(x) / 100, 2) for x in row] for row in steps]
        return v | dict(zip(("p1", "p2", "p3", "p"), outward, strict=True))

    found: dict[str, Any] = until(drawn, _is_telling)
    return found


def _numbers(rng: np.random.Generator, low: int, high: int, parts: int) -> list[float]:
    """Three numbers of either sign and of sizes low/parts to high/parts, all sizes different."""
    sizes = rng.choice(np.arange(low, high + 1), 3, replace=False) * rng.choice([-1, 1], 3)
    return [round(float(size) / parts, 2) for size in sizes]


def _direction(rng: np.random.Generator) -> list[int]:
    whole = rng.permutation(WHOLE[int(rng.integers(len(WHOLE)))]) * rng.choice([-1, 1], 3)
    return [int(x) for x in whole]


def _is_telling(v: Variant) -> bool:
    z, right = axes(v), linear(v, {})
    skew = np.linalg.norm(np.cross(z, np.roll(z, 1, axis=1), axis=0), axis=0)
    wrong = [*(lever_columns(v, lever) for _, lever in LEVERS), *(linear_of(v, pair) for pair in wrong_pairs(v))]
    apart = all((np.abs(right - columns).max(axis=0) > TELLING).any() for columns in wrong)
    return apart and bool(skew.min() > 0.5) and float(np.abs(np.append(right, velocity(v, {}))).min()) > TELLING


def axes(v: Variant) -> Array:
    """Unit vectors along the axes of joints 1, 2, 3 as columns (3, 3)."""
    w = np.array([v[f"w{i}"] for i in JOINTS], dtype=float).T
    return w / np.linalg.norm(w, axis=0)


def points(v: Variant) -> Array:
    """The points on the axes as columns (3, 3)."""
    return np.array([v[f"p{i}"] for i in JOINTS]).T


def revolute(v: Variant) -> list[int]:
    """Places of the revolute joints, from 0."""
    return [i for i, kind in enumerate(v["kinds"]) if kind == "R"]


def prismatic(v: Variant) -> int:
    return str(v["kinds"]).index("P")


def wrong_pairs(v: Variant) -> list[tuple[int, int]]:
    """Places of two joints of which one slides."""
    return [pair for pair in combinations(range(3), 2) if prismatic(v) in pair]


def to_tool(v: Variant) -> Array:
    """Lever arms from each axis to the tool point, as columns."""
    return np.array(v["p"])[:, None] - points(v)


def neighbours(v: Variant) -> tuple[Array, Array]:
    """The points before each axis (base origin, p1, p2) and behind it (p2, p3, p), as columns."""
    along = np.column_stack([np.zeros(3), points(v), v["p"]])
    return along[:, :3], along[:, 2:]


OWN_LINK = "The lever arm seems to be the joint's own link; it goes from the joint to the tool point."
ONE_EARLY = "The lever arm seems to start at the point before; it starts at the joint itself."
ORIGIN = "The lever arm seems to start or to end at the base origin; it goes from the joint to the tool point."
LEVERS: tuple[tuple[str, Callable[[Variant], Array]], ...] = (
    (OWN_LINK, lambda v: neighbours(v)[1] - points(v)),
    (OWN_LINK, lambda v: points(v) - neighbours(v)[0]),
    (ONE_EARLY, lambda v: np.array(v["p"])[:, None] - neighbours(v)[0]),
    (ORIGIN, points),
    (ORIGIN, lambda v: np.tile(np.array(v["p"])[:, None], 3)),
)  # known wrong lever arms


def lever_columns(v: Variant, lever: Callable[[Variant], Array]) -> Array:
    """Linear parts (3, 2) of the revolute columns with these lever arms."""
    turning = revolute(v)
    return np.asarray(np.cross(axes(v)[:, turning], lever(v)[:, turning], axis=0), dtype=np.float64)


def linear_of(v: Variant, pair: tuple[int, int]) -> Array:
    """Linear parts (3, 2) of the columns of two joints, as if both were revolute."""
    places = list(pair)
    return np.asarray(np.cross(axes(v)[:, places], to_tool(v)[:, places], axis=0), dtype=np.float64)


def velocity(v: Variant, _: Given) -> Array:
    product: Array = np.cross(np.array(v["omega"]), np.array(v["r"]))
    return product


def linear(v: Variant, _: Given) -> Array:
    return lever_columns(v, to_tool)


def slide(v: Variant, _: Given) -> Array:
    return np.append(axes(v)[:, prismatic(v)], np.zeros(3))


def assembled(v: Variant, given: Given) -> Array:
    """The 6 x 3 Jacobian from the columns that were found."""
    turning = revolute(v)
    J = np.zeros((6, 3))
    J[:3, turning], J[3:, turning] = given["cross_products_linear"], axes(v)[:, turning]
    J[:, prismatic(v)] = given["cross_products_slide"]
    return J


def without_minus(product: Array) -> Array:
    """Cross products whose j component lacks its minus sign."""
    return (product.T * [1.0, -1.0, 1.0]).T


def not_divided(v: Variant, given: Given) -> Array:
    """Cross products with the directions as they are printed."""
    sizes = np.linalg.norm([v[f"w{i}"] for i in JOINTS], axis=1)
    return linear(v, given) * sizes[revolute(v)]


def slide_not_divided(v: Variant, _: Given) -> Array:
    return np.append(v[f"w{prismatic(v) + 1}"], np.zeros(3))


def slide_with_lever(v: Variant, given: Given) -> Array:
    """The cross product of axis and lever arm above zeros."""
    return np.append(slide_as_revolute(v, given)[:3], np.zeros(3))


def slide_of_another(v: Variant, which: int) -> Array:
    """The axis of the first or the second revolute joint above zeros."""
    return np.append(axes(v)[:, revolute(v)[which]], np.zeros(3))


def slide_as_revolute(v: Variant, _: Given) -> Array:
    z, i = axes(v), prismatic(v)
    return np.append(np.cross(z[:, i], to_tool(v)[:, i]), z[:, i])


def turning_slide(v: Variant, given: Given) -> Array:
    J: Array = np.tile(slide(v, given)[:3], 2)
    return J


def reversed_linear(v: Variant, given: Given) -> Array:
    return assembled(v, {**given, "cross_products_linear": -given["cross_products_linear"]})


def directions_as_printed(v: Variant, given: Given) -> Array:
    """The Jacobian in which no direction is divided by its length."""
    J = assembled(
        v, {"cross_products_linear": not_divided(v, given), "cross_products_slide": slide_not_divided(v, given)}
    )
    return _with_printed_axes(v, J)


def angular_as_printed(v: Variant, given: Given) -> Array:
    return _with_printed_axes(v, assembled(v, given))


def _with_printed_axes(v: Variant, J: Array) -> Array:
    """J with the printed directions in its angular rows."""
    for i in revolute(v):
        J[3:, i] = v[f"w{i + 1}"]
    return J


def slide_at_the_end(v: Variant, given: Given) -> Array:
    """The prismatic column last, or first where it is last."""
    i = prismatic(v)
    return assembled(v, given)[:, [*revolute(v), i] if i < 2 else [i, *revolute(v)]]


def named_order(solve: Callable[[Variant, Given], Array]) -> Callable[[Variant, Given, Any], Outcome]:
    """A check that names cross products in reversed order; right and wrong stay with the tolerance."""

    def check(v: Variant, given: Given, value: Any) -> Outcome:
        return Outcome(finding=REVERSED if np.abs(value + solve(v, given)).max() <= 2e-3 else "")

    return check


def explain_velocity(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"$\dot{\mathbf r} = \boldsymbol\omega \times \mathbf r = (\omega_y r_z - \omega_z r_y,\; "
            r"\omega_z r_x - \omega_x r_z,\; \omega_x r_y - \omega_y r_x)$. With your numbers:",
            r"\dot{\mathbf r}",
            numbers=given["cross_products_velocity"],
        )
    ]


def explain_linear(v: Variant, given: Given) -> list[Step]:
    turning = revolute(v)
    return [
        Step(
            r"A unit rate of joint $i$ turns everything behind it with $\boldsymbol\omega = \mathbf z_i$, so the tool point moves "
            r"with $\mathbf z_i \times (\mathbf p - \mathbf p_i)$. The axes $\mathbf z_i$ of the two revolute joints:",
            numbers=axes(v)[:, turning],
        ),
        Step(r"The lever arms $\mathbf p - \mathbf p_i$:", numbers=to_tool(v)[:, turning]),
        Step("The cross products, column by column:", numbers=given["cross_products_linear"]),
    ]


def explain_slide(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"A unit rate of a prismatic joint moves everything behind it along $\mathbf z_i$ and turns nothing, wherever the tool "
            r"point is: $\mathbf z_i$ above zeros. With your numbers:",
            rf"\mathbf J_{prismatic(v) + 1}",
            numbers=given["cross_products_slide"],
        )
    ]


def explain_assembled(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Columns in the order of the joints: $\mathbf z_i \times (\mathbf p - \mathbf p_i)$ above $\mathbf z_i$ for a revolute "
            r"joint, $\mathbf z_i$ above zeros for the prismatic one. With your numbers:",
            r"\mathbf J",
            numbers=given["cross_products_J"],
        )
    ]


def chain_of(v: Variant) -> Chain:
    """The arm as it stands, with any x axes across the joint axes."""
    poses = np.tile(np.eye(4), (5, 1, 1))
    for i in JOINTS:
        z = axes(v)[:, i - 1]
        x = np.cross(z, np.roll(z, 1)) / np.linalg.norm(np.cross(z, np.roll(z, 1)))
        poses[i, :3] = np.column_stack([x, np.cross(z, x), z, v[f"p{i}"]])
    poses[4, :3] = np.column_stack([poses[3, :3, :3], v["p"]])
    return Chain(np.linalg.inv(poses[:-1]) @ poses[1:], v["kinds"])


def drawings(v: Variant) -> tuple[Drawing, ...]:
    words = ", ".join("revolute" if kind == "R" else "prismatic" for kind in v["kinds"])
    alt = f"Arm with three joints ({words}) on axes that are skew to the base axes, drawn as it stands at this moment."
    caption = "The arm at this moment, with the base frame and the positive sense of each joint."
    across = math.degrees(math.atan2(v["p"][1], v["p"][0])) - 80
    return (Drawing(chain_of(v), (0.0, 0.0, 0.0), caption, alt, (Triad(np.eye(4), "0"),), view=(across, 22.0)),)


def statement(v: Variant) -> str:
    words = {"R": "revolute", "P": "prismatic"}
    kinds = ", ".join(f"joint {i} is **{words[kind]}**" for i, kind in zip(JOINTS, v["kinds"], strict=True))
    return rf"""All vectors are in base axes.

A body turns with the angular velocity $\boldsymbol\omega$ about an axis through a fixed point, and $\mathbf r$ leads from that point to
a point of the body.

Apart from that, an arm has three joints, counted from the base: {kinds}. At this moment the axis of joint $i$ goes through
the point $\mathbf p_i$ in the direction of $\mathbf w_i$; its unit vector is $\mathbf z_i = \mathbf w_i / \sqrt{{\mathbf w_i \cdot \mathbf w_i}}$ (the
root is a whole number), and the joint turns about it, or slides along it, in its positive sense. The tool point is at
$\mathbf p$. Points are given by their coordinates in the base frame."""


REVERSED = "The order of the cross product is reversed, which changes its sign: first what turns, then the lever arm."
MINUS = "The second component of the cross product has the wrong sign; look again at its rule."

SLIDING = "One of these columns is that of the joint that slides; the two revolute joints are asked."
NOT_DIVIDED = "The directions seem to be used as printed; divide each by its length first."
SLIDES: tuple[tuple[str, Callable[[Variant, Given], Array]], ...] = (
    ("This is the column of a revolute joint; the joint slides.", slide_as_revolute),
    ("Look again at the angular part: does the tool turn when a prismatic joint moves?", turning_slide),
    ("A lever arm seems to be in it; does it matter for a slide where the tool point is?", slide_with_lever),
    (NOT_DIVIDED, slide_not_divided),
    ("This is the axis of another joint; which joint slides?", lambda v, _: slide_of_another(v, 0)),
    ("This is the axis of another joint; which joint slides?", lambda v, _: slide_of_another(v, 1)),
)  # known wrong columns of the prismatic joint


def assembled_with(sentence: str, wrong: Callable[[Variant, Given], Array]) -> Mistake:
    """A known wrong prismatic column as a mistake of the whole Jacobian."""
    return Mistake(
        f"The prismatic column: {sentence}",
        lambda v, given: assembled(v, {**given, "cross_products_slide": wrong(v, given)}),
    )


EXERCISE = Exercise(
    slug="cross_products",
    title="Columns of a Jacobian by cross products",
    source="S2, S4",
    draw=draw,
    statement=statement,
    units={"omega": ["rad/s"] * 3, "r": ["m"] * 3}
    | {f"w{i}": ["1"] * 3 for i in JOINTS}
    | {name: ["m"] * 3 for name in ("p1", "p2", "p3", "p")},
    scale=lambda v: float(np.linalg.norm(v["p"])),
    objectives=(
        "Compute the velocity of a point of a turning body.",
        "Build the columns of a Jacobian from axes and points, revolute and prismatic.",
    ),
    minutes=25,
    drawings=drawings,
    parts=(
        Part(
            "cross_products_velocity",
            r"The velocity $\dot{\mathbf r} = \boldsymbol\omega \times \mathbf r$ of the point of the turning body, in m/s",
            1,
            Numbers((3,), "m/s", decimals=3),
            velocity,
            credit="all",
            check=named_order(velocity),
            hints=("The result is perpendicular to both vectors: two dot products test it.",),
            mistakes=(Mistake(MINUS, lambda v, given: without_minus(velocity(v, given))),),
            explain=explain_velocity,
        ),
        Part(
            "cross_products_linear",
            "The linear parts (velocity of the tool point at a unit rate) of the Jacobian's columns of the two revolute joints, in the "
            "order of the joints, as the columns of a 3 × 2 matrix",
            4,
            Numbers((3, 2), "m/rad", decimals=3),
            linear,
            credit="column",
            check=named_order(linear),
            hints=(
                "Which vector leads from the joint to the point whose velocity is asked?",
                "An axis enters as a unit vector.",
            ),
            mistakes=(
                *(Mistake(sentence, lambda v, _, lever=lever: lever_columns(v, lever)) for sentence, lever in LEVERS),
                Mistake(MINUS, lambda v, given: without_minus(linear(v, given))),
                Mistake(NOT_DIVIDED, not_divided),
                Mistake(SLIDING, lambda v, _: linear_of(v, wrong_pairs(v)[0])),
                Mistake(SLIDING, lambda v, _: linear_of(v, wrong_pairs(v)[1])),
            ),
            explain=explain_linear,
        ),
        Part(
            "cross_products_slide",
            "The whole column (three linear entries, then three angular ones) of the prismatic joint",
            2,
            Numbers((6,), "1", decimals=3),
            slide,
            credit="all",
            hints=("How does the tool turn when the joint slides?", "Does it matter where the tool point is?"),
            mistakes=tuple(Mistake(sentence, wrong) for sentence, wrong in SLIDES),
            explain=explain_slide,
        ),
        Part(
            "cross_products_J",
            r"The 6 × 3 Jacobian $\mathbf J$ of the tool point in base axes, columns in the order of the joints, linear rows above "
            "angular rows",
            3,
            Numbers((6, 3), [["m/rad"] * 3] * 3 + [["1"] * 3] * 3, decimals=3),
            assembled,
            needs=("cross_products_linear", "cross_products_slide"),
            credit="column",
            hints=("What stands below the linear part of a revolute joint's column?",),
            mistakes=(
                *(assembled_with(sentence, wrong) for sentence, wrong in SLIDES),
                Mistake(NOT_DIVIDED, directions_as_printed),
                Mistake(f"The angular rows: {NOT_DIVIDED}", angular_as_printed),
                Mistake(f"The linear rows: {REVERSED}", reversed_linear),
                Mistake("The columns seem to be in another order than the joints.", slide_at_the_end),
            ),
            explain=explain_assembled,
        ),
    ),
)
