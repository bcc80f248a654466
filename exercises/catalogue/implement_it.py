"""S2, "one code to rule them all": the Jacobian of any arm from its table, as a function.

The function is called with robots that the student has not seen. Who works without Python hands in
what it would return for the published robots.
"""

from typing import Any

import numpy as np

from ..answers import Calls, Function, Manual, Variant
from ..arm import UNIT, Array
from ..arms.any_table import MISREAD, TableFunction, any_table
from ..part import exercise, part

GROUPS = {
    "planar": ("RR", "RRR", "RRRR"),
    "prismatic": ("RRP", "RPP", "PRRP", "RPRRPR"),
    "6R": ("RRRRRR",) * 3,
    "7R": ("RRRRRRR",) * 3,
}
PUBLISHED = ("RRR", "RRP", "RPRRRR")
STATEMENT = r"""Write a Python function `implement_it_jacobian(dh, kinds, q)` that returns the
Jacobian of **any** serial arm.

- `dh` is an $n$ × 4 array, one row $\theta_i, d_i, a_i, \alpha_i$ per joint, in this order, in the
  **standard** Denavit–Hartenberg convention (joint $i$ moves about or along $\mathbf z_{i-1}$).
  Angles are in radians, lengths in metres.
- `kinds` is a string of $n$ letters, such as `"RRP"`: R for a revolute joint, P for a prismatic
  one.
- `q` is an array of the $n$ joint variables, in radians or metres. $q_i$ is **added** to $\theta_i$
  of a revolute joint and to $d_i$ of a prismatic one; what stands in the table is its offset.
- The result is a 6 × $n$ array: $\mathbf J$ of the origin of frame $n$, in the axes of base frame
  0, linear rows above angular rows.

It is called for arms that you do not see: planar ones, arms with prismatic joints, arms with six
and with seven revolute joints; each of these four groups is worth the same. Numpy is there as `np`;
results are compared to six digits.

The tables `dh_1, dh_2, dh_3` and the joint variables `joints_1, joints_2, joints_3` of your numbers
are three arms to try it with: robot 1 `RRR`, robot 2 `RRP`, robot 3 `RPRRRR`. If you work **without
Python** and hand in a file of numbers (.json, .csv, .mat), it holds the three Jacobians of these
arms, in this order, in place of the function."""


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """Hidden robots by group, as lists [dh, kinds, q], and three published ones."""
    v: dict[str, Any] = {}
    for group, patterns in GROUPS.items():
        v[group] = [any_table(rng, kinds, planar=group == "planar") for kinds in patterns]
    for i, kinds in enumerate(PUBLISHED, 1):
        v[f"dh_{i}"], _, v[f"joints_{i}"] = any_table(rng, kinds)
    return v


def hidden(v: Variant) -> Calls:
    """The calls that are marked."""
    calls: Calls = {}
    for group in GROUPS:
        calls[group] = [tuple(arm) for arm in v[group]]
    return calls


def published(v: Variant) -> Calls:
    """The calls whose results may be handed in instead."""
    calls: Calls = {}
    for i, kinds in enumerate(PUBLISHED, 1):
        calls[f"robot {i}"] = [(v[f"dh_{i}"], kinds, v[f"joints_{i}"])]
    return calls


def published_units() -> dict[str, Any]:
    """Units of the tables and joint variables of the published robots."""
    units: dict[str, Any] = {}
    for i, kinds in enumerate(PUBLISHED, 1):
        units[f"dh_{i}"] = [["rad", "m", "m", "rad"]] * len(kinds)
    for i, kinds in enumerate(PUBLISHED, 1):
        units[f"joints_{i}"] = [UNIT[kind] for kind in kinds]
    return units


# It is printed as the worked solution, where nothing but np is known: its annotations stay text.
def reference(dh: "Array", kinds: str, q: "Array") -> "Array":
    """J (6, n) of the last frame's origin in base axes, linear rows above angular ones."""
    T = [np.eye(4)]
    for (theta, d, a, alpha), kind, x in zip(dh, kinds, q, strict=True):
        angle, shift = theta, d
        if kind == "R":
            angle = theta + x
        else:
            shift = d + x
        c, s = np.cos(angle), np.sin(angle)
        ca, sa = np.cos(alpha), np.sin(alpha)
        A = np.array(
            [
                [c, -s * ca, s * sa, a * c],
                [s, c * ca, -c * sa, a * s],
                [0, sa, ca, shift],
                [0, 0, 0, 1],
            ]
        )
        T.append(T[-1] @ A)
    J = np.zeros((6, len(kinds)))
    for i, kind in enumerate(kinds):
        z = T[i][:3, 2]
        lever = T[-1][:3, 3] - T[i][:3, 3]
        if kind == "R":
            J[:3, i] = np.cross(z, lever)
            J[3:, i] = z
        else:
            J[:3, i] = z
    return J


@part(
    8,
    Function("(dh, kinds, q)", inputs=hidden, published=published),
    shows={"J_2": lambda v: reference(*published(v)["robot 2"][0])},
    mistakes=[(sentence, lambda *, wrong=wrong: wrong) for sentence, wrong in MISREAD],
)
def jacobian() -> TableFunction:
    r"""The function, under this name

    - Write a function for one row of the table first.
    - Keep all the transforms from the base, that of frame 0 too.
    - Test it: move one joint by 1e-6 and divide the way of the origin by that.

    Row $i$ gives $\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$, with
    $q_i$ added to $\theta_i$ of a revolute and to $d_i$ of a prismatic joint, and
    $\mathbf T_0^{i} = \mathbf T_0^{i-1} \mathbf T_{i-1}^{i}$, beginning with
    $\mathbf T_0^{0} = \mathbf I$: each factor leads from one frame to the next.

    $\mathbf z_{i-1}$ and $\mathbf o_{i-1}$ are the third and the fourth column of
    $\mathbf T_0^{i-1}$. Column $i$ is $\mathbf z_{i-1} \times (\mathbf o_n - \mathbf o_{i-1})$
    above $\mathbf z_{i-1}$ (revolute), or $\mathbf z_{i-1}$ above zeros (prismatic).

    For robot 2 it returns:
    $$\mathbf J = <J_2>$$
    """
    return reference


RUBRIC = (
    (1, "the steps by hand, what they take and give, and why they are done anew for every arm"),
    (1, "the automated steps in their order, each with what it takes and gives"),
)


@part(2, Manual(RUBRIC))
def steps() -> str:
    """Which steps from an arm on the table to its Jacobian are done by hand, and which are
    automated by your function? Say in your own words what each step takes and gives, and why those
    by hand cannot be automated in the same way

    - Which steps are the same for every arm?

    <steps>
    """
    return (
        "By hand: the frames are placed on the drawing of the arm and the table is read off them; "
        "that takes a look at every arm and a choice of base, directions and zeros. Automated: "
        "each row becomes a transform, the transforms are multiplied to those from the base, and "
        "the columns follow from their third and fourth columns by the type of the joint; these "
        "steps are the same for every arm."
    )


EXERCISE = exercise(
    "implement_it",
    title="One function for every arm",
    source="S2",
    minutes=60,
    objectives=(
        "Write the computation of a Jacobian once, for all arms.",
        "Test a function with cases whose answer is known.",
    ),
    draw=draw,
    statement=STATEMENT,
    units=published_units(),
    hidden=tuple(GROUPS),
    scale=1.0,
    parts=(jacobian, steps),
)
