"""S3 and S4: a Jacobian with one mistake, a slip in the source texts, to be named and repaired.

Structure and numbers of the arm are drawn, and so is the mistake. Every matrix that a known mistake
leads to differs from every other one on the drawn arm, so that there is one right name.
"""

from itertools import combinations
from typing import Any

import numpy as np

from ..answers import LETTERS, Choice, Numbers
from ..arm import Arm, Array, arm_of
from ..arms.twisted import FORMS, KINDS, LENGTHS, MODIFIED, UNITS, drawn, modified, robot
from ..calculations import columns
from ..calculations.columns import Slip
from ..contract.printed_table import printed_table, table_rows
from ..draws import angles, length, until
from ..exercise import Outcome
from ..part import exercise, part

DIFFERENT = 0.05  # between the matrices of two mistakes, in some entry
ROUNDING = 3e-3  # frames at three decimals, multiplied along the arm
SLIPS = (
    Slip(columns.LATE_AXES, columns.late_axes),
    Slip(columns.OWN_LINK, columns.own_link),
    Slip(columns.FROM_BASE, columns.from_base),
    Slip(columns.REVERSED, columns.reversed_product),
    Slip(columns.TURNING, columns.all_turning),
    Slip(columns.TURNING_SLIDE, columns.turning_slide),
    Slip(columns.ANGULAR_FIRST, columns.angular_first),
    Slip(columns.TOOL_AXES, columns.tool_axes),
)
OPTIONS = (  # one for each, in their order
    (
        r"the joint axes are taken from the wrong frames: $\mathbf z_i$ stands for "
        r"$\mathbf z_{i-1}$ in every column, in the linear and in the angular rows"
    ),
    (
        r"the levers end at the joint's own link: $\mathbf o_i - \mathbf o_{i-1}$ stands for "
        r"$\mathbf o_n - \mathbf o_{i-1}$"
    ),
    (
        r"the levers begin at the base: $\mathbf o_n - \mathbf o_0$ stands for "
        r"$\mathbf o_n - \mathbf o_{i-1}$"
    ),
    (
        r"the cross products are taken in the reverse order, "
        r"$(\mathbf o_n - \mathbf o_{i-1}) \times \mathbf z_{i-1}$"
    ),
    "the prismatic joint is treated as a revolute one",
    "the prismatic joint has its axis in the angular rows too",
    "the angular rows stand above the linear ones",
    "the columns are expressed in the axes of the tool frame",
)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm of one of 48 forms, a posture that tells mistakes apart, and the matrix of one."""
    slip = int(rng.integers(len(SLIPS)))
    form = int(rng.integers(len(FORMS)))

    def arm() -> dict[str, Any]:
        v: dict[str, Any] = {name: length(rng, 0.5, 1.2) for name in robot(form).parameters}
        v["q"] = [*angles(rng, 2), length(rng, 0.5, 1.2), *angles(rng, 1)]
        v["form"] = form
        return v

    v = until(arm, lambda v: all_differ(arm_of(robot(form), v), form))
    W = SLIPS[slip].columns(arm_of(robot(form), v).frames, KINDS)
    return v | {"W": (np.round(W, 3) + 0.0).tolist()}


def all_differ(arm: Arm, form: int) -> bool:
    """Whether no two of the matrices that may be handed in look alike."""
    known = [columns.right(arm.frames, KINDS), modified(arm, form), *wrong_matrices(arm)]
    return all(np.abs(a - b).max() >= DIFFERENT for a, b in combinations(known, 2))


def wrong_matrices(arm: Arm) -> Array:
    """What each of the mistakes leads to, (8, 6, 4)."""
    return np.array([slip.columns(arm.frames, KINDS) for slip in SLIPS])


def slip_of(arm: Arm, W: Array) -> int:
    """Index of the mistake that leads to W."""
    # The mistake is not among the drawn numbers: these are in the student's file.
    return int(np.argmin(np.abs(wrong_matrices(arm) - W).max(axis=(1, 2))))


@part(
    3,
    Choice(OPTIONS),
    shows={
        "axes": lambda arm: arm.frames[:, :3, 2].T,
        "origins": lambda arm: arm.frames[:, :3, 3].T,
        "option": lambda name: OPTIONS[LETTERS.index(name)],
    },
)
def name(arm: Arm, W: Array) -> str:
    r"""Which mistake leads to $\mathbf W$? Here $\mathbf z_i$ and $\mathbf o_i$ are the axis
    $\mathbf z$ and the origin of frame $i$, and $n = 4$

    - Which columns are wrong, and which of their rows?
    - Compute one revolute column and the prismatic one; that rules out most of the list.

    Compute one revolute column, $\mathbf z_{i-1} \times (\mathbf o_4 - \mathbf o_{i-1})$ above
    $\mathbf z_{i-1}$, and the prismatic one, $\mathbf z_2$ above zeros, and hold them beside
    $\mathbf W$. The axes $\mathbf z_0 \ldots \mathbf z_4$ as columns:
    $$\left[\mathbf z_0 \cdots \mathbf z_4\right] = <axes>$$

    The origins $\mathbf o_0 \ldots \mathbf o_4$ as columns:
    $$\left[\mathbf o_0 \cdots \mathbf o_4\right] = <origins>$$

    Of all the options only <name>) leads to your matrix: <option>.
    """
    return LETTERS[slip_of(arm, W)]


def judged_repair(arm: Arm, J: Array, W: Array, value: Array) -> Outcome:
    """Spoiled columns that are made right carry the points; each sound one that is broken costs.

    A slip in a new matrix is one like anywhere; what was left of the printed one is not new.
    """
    is_right = np.abs(value - J) <= ROUNDING
    whole = is_right.all(axis=0)
    spoiled = (np.abs(W - J) > ROUNDING).any(axis=0)

    repaired = (whole & spoiled).sum() / spoiled.sum()
    broken = (~whole & ~spoiled).mean()  # of all columns, so that one costs the same on every arm
    share = max(0.0, float(repaired - broken))
    told = reading(arm, W, value)
    return Outcome(is_right, reading=told, share=share, final=bool(told) or is_left(J, W, value))


def is_left(J: Array, W: Array, value: Array) -> bool:
    """Whether more than a quarter of what is wrong in W stands in a repair as it was."""
    wrong = np.abs(W - J) > ROUNDING
    left = wrong & (np.abs(value - W) <= ROUNDING)
    return bool(left.sum() > wrong.sum() / 4)


def reading(arm: Arm, W: Array, value: Array) -> str:
    """What a repair is, where it is the printed matrix or has another known mistake in it."""
    if np.abs(value - W).max() <= ROUNDING:
        return "This is the printed matrix as it was."
    for slip, wrong in zip(SLIPS, wrong_matrices(arm), strict=True):
        if np.abs(value - wrong).max() <= ROUNDING:
            return f"This matrix has another mistake in it. {slip.sentence}"
    return ""


@part(
    7,
    Numbers((6, 4), UNITS, 3),
    credit="column",
    tolerance=ROUNDING,
    check=judged_repair,
    mistakes=[(MODIFIED, modified)],
)
def J(arm: Arm) -> Array:
    r"""The right 6 × 4 Jacobian $\mathbf J$ of the origin of frame 4 in base axes, linear rows
    above angular rows; the columns that are wrong in $\mathbf W$ carry the points, and the others
    shall stay right

    - The mistake you have named says which step of the computation to do again.
    - Check the result: move one joint a little and see where the tool point goes.

    Revolute columns are $\mathbf z_{i-1} \times (\mathbf o_4 - \mathbf o_{i-1})$ above
    $\mathbf z_{i-1}$, the prismatic one is $\mathbf z_2$ above zeros, all in base axes:
    $$\mathbf J = <J>$$
    """
    return arm.J


def statement(arm: Arm) -> str:
    """The arm's table, and what was asked of whoever made the mistake."""
    table = printed_table(table_rows(arm.robot))
    return rf"""This arm has two revolute joints, a prismatic joint and a third revolute joint
(RRPR). Its table in the **standard** Denavit–Hartenberg convention, $\mathbf z_{{i-1}}$ along the
axis of joint $i$:

{table}

Asked for the 6 × 4 Jacobian $\mathbf J$ of the origin of frame 4, the tool frame, in base axes,
linear rows above angular rows, at your $\mathbf q$, somebody handed in your matrix $\mathbf W$. It
is rounded to three decimals and right but for **one** mistake, which was made wherever it can be
made."""


EXERCISE = exercise(
    "find_the_mistake",
    title="Find the mistake in a Jacobian",
    source="S3 5.1, S4",
    minutes=35,
    objectives=(
        "Check a Jacobian column by column.",
        "Tell the usual mistakes in a Jacobian from each other.",
    ),
    robot=robot,
    units={**dict.fromkeys(LENGTHS, "m"), "q": ["rad", "rad", "m", "rad"], "W": UNITS},
    symbols={"W": r"\mathbf W"},
    structure=("form",),
    draw=draw,
    statement=statement,
    drawings=drawn,
    parts=(name, J),
)
