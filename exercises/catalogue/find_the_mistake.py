"""S3 and S4: a Jacobian with one mistake, to be named and repaired. The mistakes are slips in the source texts.

Structure and numbers of the arm are drawn, and so is the mistake. Every matrix that a known mistake leads to differs
from every other one on the drawn arm, so that there is one right name.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.jacobian import in_axes, jacobian
from ...solutions.robot import Robot
from ..answers import LETTERS
from ..drawing import Drawing, Triad
from ..draws import angles, length
from ..exercise import Choice, Exercise, Given, Mistake, Numbers, Outcome, Part, Step, Variant

Array = NDArray[np.float64]
KINDS = "RRPR"
LENGTHS = ("d1", "a1", "d2", "a3", "d4", "a4")
FORMS = tuple(
    product(("pi/2", "-pi/2"), ("pi/2", "-pi/2"), ("pi/2", "-pi/2"), combinations(("a1", "d2", "a3", "d4"), 2))
)
DIFFERENT = 0.05  # between the matrices of two mistakes, in some entry
ROUNDING = 3e-3  # frames at three decimals, multiplied along the arm
UNITS = [["m/rad", "m/rad", "1", "m/rad"]] * 3 + [["1"] * 4] * 3


def columns(axes: Array, levers: Array, kinds: str) -> Array:
    """J (6, n) from joint axes and levers (n, 3): axis x lever above the axis, or the axis above zeros."""
    revolute = np.array([kind == "R" for kind in kinds])[:, None]
    linear = np.where(revolute, np.cross(axes, levers), axes)
    return np.concatenate([linear.T, np.where(revolute, axes, 0.0).T])


@dataclass(frozen=True)
class Slip:
    """A mistake: what it is, and the matrix (6, n) that it makes of the frames T_0^0 ... T_0^n and the joint types."""

    option: str
    of: Callable[[Array, str], Array]

    @property
    def plain(self) -> str:
        """The option without its LaTeX, for findings."""
        text = re.sub(r"\\mathbf\s*|\$", "", self.option).replace(r"\times", "x")
        return re.sub(r"_\{([^}]*)\}", r"_(\1)", text)


def _z(T: Array) -> Array:
    return T[:-1, :3, 2]


def _o(T: Array) -> Array:
    return T[:-1, :3, 3]


def _tip(T: Array) -> Array:
    return T[-1, :3, 3]


def right_columns(T: Array, kinds: str) -> Array:
    return columns(_z(T), _tip(T) - _o(T), kinds)


def _turning_slide(T: Array, kinds: str) -> Array:
    J = right_columns(T, kinds)
    return np.concatenate([J[:3], _z(T).T])


SLIPS = (
    Slip(
        r"the joint axes are taken from the wrong frames: $\mathbf z_i$ stands for $\mathbf z_{i-1}$ in every column, in the "
        "linear and in the angular rows",
        lambda T, kinds: columns(T[1:, :3, 2], _tip(T) - _o(T), kinds),
    ),
    Slip(
        r"the levers end at the joint's own link: $\mathbf o_i - \mathbf o_{i-1}$ stands for $\mathbf o_n - \mathbf o_{i-1}$",
        lambda T, kinds: columns(_z(T), T[1:, :3, 3] - _o(T), kinds),
    ),
    Slip(
        r"the levers begin at the base: $\mathbf o_n - \mathbf o_0$ stands for $\mathbf o_n - \mathbf o_{i-1}$",
        lambda T, kinds: columns(_z(T), _tip(T) - np.zeros_like(_o(T)), kinds),
    ),
    Slip(
        r"the cross products are taken in the reverse order, $(\mathbf o_n - \mathbf o_{i-1}) \times \mathbf z_{i-1}$",
        lambda T, kinds: columns(_z(T), _o(T) - _tip(T), kinds),
    ),
    Slip(
        "the prismatic joint is treated as a revolute one",
        lambda T, kinds: columns(_z(T), _tip(T) - _o(T), "R" * len(kinds)),
    ),
    Slip("the prismatic joint has its axis in the angular rows too", _turning_slide),
    Slip(
        "the angular rows stand above the linear ones",
        lambda T, kinds: np.roll(right_columns(T, kinds), 3, axis=0),
    ),
    Slip(
        "the columns are expressed in the axes of the tool frame",
        lambda T, kinds: in_axes(right_columns(T, kinds), T[-1, :3, :3]),
    ),
)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 48 forms, a posture in which no two mistakes look alike, and the matrix of one of them."""
    slip, form = int(rng.integers(len(SLIPS))), int(rng.integers(len(FORMS)))
    while True:
        v: dict[str, Any] = {name: length(rng, 0.2, 0.6) for name in LENGTHS if name in robot(form).parameters}
        v |= {"q": [*angles(rng, 2), length(rng, 0.3, 0.9), *angles(rng, 1)], "form": form}
        T = transforms(v)
        known = [right_columns(T, KINDS), as_modified(v, {}), *(slip.of(T, KINDS) for slip in SLIPS)]
        if all(np.abs(a - b).max() >= DIFFERENT for a, b in combinations(known, 2)):
            return v | {"W": (np.round(known[2 + slip], 3) + 0.0).tolist()}


@lru_cache
def robot(form: int, convention: Any = "standard") -> Robot:
    """The arm of one form, with every length 1 m by default."""
    *turns, offsets = FORMS[form]
    has = {name: name if name in ("d1", "a4", *offsets) else "0" for name in LENGTHS}
    return Robot(
        name="find_the_mistake",
        title="RRPR arm",
        parameters=dict.fromkeys((name for name in LENGTHS if has[name] != "0"), 1.0),
        rows=(
            ("q1", has["d1"], has["a1"], turns[0]),
            ("q2", has["d2"], "0", turns[1]),
            ("0", "q3", has["a3"], turns[2]),
            ("q4", has["d4"], has["a4"], "0"),
        ),
        convention=convention,
        limits=((-np.pi, np.pi), (-np.pi, np.pi), (0.3, 0.9), (-np.pi, np.pi)),
        source="made for this exercise",
    )


def lengths(v: Variant) -> dict[str, float]:
    return {name: v[name] for name in LENGTHS if name in v}


def transforms(v: Variant) -> Array:
    """T_0^0 ... T_0^4."""
    return robot(v["form"]).frames(lengths(v), v["q"])


def slip_of(v: Variant) -> int:
    """Index of the mistake that leads to W; it is not drawn, because drawn numbers are in the student's file."""
    T, W = transforms(v), np.array(v["W"])
    return int(np.argmin([np.abs(slip.of(T, KINDS) - W).max() for slip in SLIPS]))


def name_of_mistake(v: Variant, _: Given) -> str:
    return LETTERS[slip_of(v)]


def repaired(v: Variant, _: Given) -> Array:
    return right_columns(transforms(v), KINDS)


def as_modified(v: Variant, _: Given) -> Array:
    """The table read in the modified convention."""
    return jacobian(robot(v["form"], "modified").chain(lengths(v)), v["q"])


def judged_repair(v: Variant, given: Given, value: Array) -> Outcome:
    """Spoiled columns that are made right carry the points; each sound one that is broken costs its share of all."""
    T, J, W = transforms(v), repaired(v, given), np.array(v["W"])
    right = np.abs(value - J) <= ROUNDING
    spoiled = (np.abs(W - J) > ROUNDING).any(axis=0)
    whole = right.all(axis=0)
    share = max(0.0, float((whole & spoiled).sum() / spoiled.sum() - (~whole & ~spoiled).mean()))
    if np.abs(value - W).max() <= ROUNDING:
        return Outcome(right, reading="This is the printed matrix as it was.", share=share)
    for slip in SLIPS:
        if np.abs(value - slip.of(T, KINDS)).max() <= ROUNDING:
            return Outcome(right, reading=f"This matrix has another mistake in it: {slip.plain}.", share=share)
    return Outcome(right, share=share)


def explain_name(v: Variant, given: Given) -> list[Step]:
    letter = given["find_the_mistake_name"]
    return [
        Step(
            r"Compute one revolute column, $\mathbf z_{i-1} \times (\mathbf o_4 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$, and the "
            r"prismatic one, $\mathbf z_2$ above zeros, and hold them beside $\mathbf W$. The axes $\mathbf z_0 \ldots \mathbf z_4$ as columns:",
            r"\left[\mathbf z_0 \cdots \mathbf z_4\right]",
            numbers=transforms(v)[:, :3, 2].T,
        ),
        Step(
            r"The origins $\mathbf o_0 \ldots \mathbf o_4$ as columns:",
            r"\left[\mathbf o_0 \cdots \mathbf o_4\right]",
            numbers=transforms(v)[:, :3, 3].T,
        ),
        Step(f"Of all the options only {letter}) leads to your matrix: {SLIPS[slip_of(v)].option}."),
    ]


def explain_repair(v: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Revolute columns are $\mathbf z_{i-1} \times (\mathbf o_4 - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$, the prismatic one is "
            r"$\mathbf z_2$ above zeros, all in base axes:",
            r"\mathbf J",
            numbers=given["find_the_mistake_J"],
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    T = transforms(v)
    return (
        Drawing(
            robot(v["form"]).chain(lengths(v)),
            tuple(v["q"]),
            "The arm at your q, with frame 0 and the tool frame.",
            "Arm with two revolute joints, a slide and a third revolute joint, drawn at the student's q.",
            (Triad(T[0], "0"), Triad(T[-1], "tool")),
        ),
    )


def statement(v: Variant) -> str:
    rows = "\n".join(f"| {i} | {' | '.join(map(_cell, row))} |" for i, row in enumerate(robot(v["form"]).rows, 1))
    return rf"""This arm has two revolute joints, a prismatic joint and a third revolute joint (RRPR). Its table in the **standard**
Denavit–Hartenberg convention, $\mathbf z_{{i-1}}$ along the axis of joint $i$:

| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |
|:-:|:-:|:-:|:-:|:-:|
{rows}

Asked for the 6 × 4 Jacobian $\mathbf J$ of the origin of frame 4, the tool frame, in base axes, linear rows above angular rows, at your
$\mathbf q$, somebody handed in your matrix $\mathbf W$. It is rounded to three decimals and right but for **one** mistake, which
was made wherever it can be made."""


def _cell(cell: Any) -> str:
    """LaTeX of a cell: q1 is q_1, pi/2 is a fraction of pi."""
    text = str(cell)
    return f"${text.replace('pi', chr(92) + 'pi') if 'pi' in text or text == '0' else f'{text[0]}_{text[1:]}'}$"


EXERCISE = Exercise(
    slug="find_the_mistake",
    title="Find the mistake in a Jacobian",
    source="S3 5.1, S4",
    draw=draw,
    statement=statement,
    units={**dict.fromkeys(LENGTHS, "m"), "q": ["rad", "rad", "m", "rad"], "W": UNITS},
    symbols={"W": r"\mathbf W"},
    scale=lambda v: sum(lengths(v).values()) + v["q"][2],
    objectives=(
        "Check a Jacobian column by column.",
        "Tell the usual mistakes in a Jacobian from each other.",
    ),
    minutes=35,
    drawings=drawings,
    parts=(
        Part(
            "find_the_mistake_name",
            r"Which mistake leads to $\mathbf W$? Here $\mathbf z_i$ and $\mathbf o_i$ are the axis $\mathbf z$ and the origin of frame $i$, "
            r"and $n = 4$",
            3,
            Choice(tuple(slip.option for slip in SLIPS)),
            name_of_mistake,
            hints=(
                "Which columns are wrong, and which of their rows?",
                "Compute one revolute column and the prismatic one; that rules out most of the list.",
            ),
            explain=explain_name,
        ),
        Part(
            "find_the_mistake_J",
            r"The right 6 × 4 Jacobian $\mathbf J$ of the origin of frame 4 in base axes, linear rows above angular rows; the columns "
            r"that are wrong in $\mathbf W$ carry the points, and the others shall stay right",
            7,
            Numbers((6, 4), UNITS, decimals=3),
            repaired,
            check=judged_repair,
            credit="column",
            tolerance=ROUNDING,
            mistakes=(
                Mistake(
                    "This is what comes out when the table is read in the modified convention; it is a standard one.",
                    as_modified,
                ),
            ),
            hints=(
                "The mistake you have named says which step of the computation to do again.",
                "Check the result: move one joint a little and see where the tool point goes.",
            ),
            explain=explain_repair,
        ),
    ),
)
