"""S2, "one code to rule them all": the Jacobian of any arm from its Denavit-Hartenberg table, as a function.

The function is called with robots that the student has not seen. Who works without Python hands in what it would return
for the published robots.
"""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.chain import from_modified, standard_transform
from ...solutions.jacobian import jacobian as jacobian_of_chain
from ..answers import Calls
from ..exercise import Exercise, Function, Given, Manual, Mistake, Part, Step, Variant
from .find_the_mistake import SLIPS

Array = NDArray[np.float64]
Answer = Callable[[Any, str, Any], Array]
GROUPS = {
    "planar": ("RR", "RRR", "RRRR"),
    "prismatic": ("RRP", "RPP", "PRRP", "RPRRPR"),
    "6R": ("RRRRRR",) * 3,
    "7R": ("RRRRRRR",) * 3,
}
PUBLISHED = ("RRR", "RRP", "RPRRRR")
UNITS = {"R": "rad", "P": "m"}
KEY = (
    "By hand: the frames are placed on the drawing of the arm and the table is read off them; that takes a look at every arm "
    "and a choice of base, directions and zeros. Automated: each row becomes a transform, the transforms are multiplied to "
    "those from the base, and the columns follow from their third and fourth columns by the type of the joint; these "
    "steps are the same for every arm."
)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """Hidden robots by group, as lists [dh, kinds, q], and three published ones."""
    v: dict[str, Any] = {name: [_robot(rng, kinds, name) for kinds in patterns] for name, patterns in GROUPS.items()}
    for i, kinds in enumerate(PUBLISHED, 1):
        v[f"dh_{i}"], _, v[f"joints_{i}"] = _robot(rng, kinds)
    return v


def _robot(rng: np.random.Generator, kinds: str, group: str = "") -> list[Any]:
    """A table with offsets, oblique axes (none in the plane) and links in both directions, and a posture."""
    n = len(kinds)
    theta, alpha = rng.uniform(-3, 3, n), rng.choice([-1, 1], n) * rng.uniform(0.4, 2.7, n) * (group != "planar")
    d, a = (rng.choice([-1, 1], n) * rng.uniform(0.1, 0.8, n) for _ in range(2))
    q = np.where([kind == "R" for kind in kinds], rng.uniform(-2.5, 2.5, n), rng.uniform(0.2, 0.9, n))
    dh = np.round(np.stack([theta, d, a, alpha], axis=1), 3) + 0.0
    return [dh.tolist(), kinds, np.round(q, 3).tolist()]


def hidden(v: Variant) -> Calls:
    return {group: [tuple(robot) for robot in v[group]] for group in GROUPS}


def published(v: Variant) -> Calls:
    return {f"robot {i}": [(v[f"dh_{i}"], kinds, v[f"joints_{i}"])] for i, kinds in enumerate(PUBLISHED, 1)}


def reference(_: Variant, __: Given) -> Answer:
    return jacobian


# It is printed as the worked solution, where nothing but np is known: its annotations stay text.
def jacobian(dh: "Array", kinds: str, q: "Array") -> "Array":
    """J (6, n) of the last frame's origin in base axes, linear rows above angular ones."""
    T = [np.eye(4)]
    for (theta, d, a, alpha), kind, x in zip(dh, kinds, q, strict=True):
        angle, shift = (theta + x, d) if kind == "R" else (theta, d + x)
        c, s, ca, sa = np.cos(angle), np.sin(angle), np.cos(alpha), np.sin(alpha)
        A = np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, shift], [0, 0, 0, 1]])
        T.append(T[-1] @ A)
    J = np.zeros((6, len(kinds)))
    for i, kind in enumerate(kinds):
        z, lever = T[i][:3, 2], T[-1][:3, 3] - T[i][:3, 3]
        if kind == "R":
            J[:3, i], J[3:, i] = np.cross(z, lever), z
        else:
            J[:3, i] = z
    return J


def frames(dh: Any, kinds: str, q: Any) -> Array:
    """T_0^0 ... T_0^n."""
    turns = np.array([kind == "R" for kind in kinds])
    rows = np.array(dh, dtype=np.float64)
    rows[:, 0] += np.where(turns, q, 0.0)
    rows[:, 1] += np.where(turns, 0.0, q)
    T = [np.eye(4)]
    for link in standard_transform(rows):
        T.append(T[-1] @ link)
    return np.array(T)


def mistakes() -> Iterator[Mistake]:
    """Those of the sources, and three ways to misread the arguments."""
    for slip in SLIPS:
        yield _always(f"Your results show a mistake: {slip.plain}.", _slipping(slip.of))
    yield _always("The offsets in the table are lost: q is added to them.", _without_offsets)
    yield _always(
        "The table is read in the modified convention; it is a standard one.",
        lambda dh, kinds, q: jacobian_of_chain(from_modified(dh, kinds), q),
    )
    yield _always("The angles seem to be taken as degrees; they are radians.", _in_degrees)


def _always(sentence: str, wrong: Answer) -> Mistake:
    return Mistake(sentence, lambda _, __: wrong)


def _slipping(of: Callable[[Array, str], Array]) -> Answer:
    return lambda dh, kinds, q: of(frames(dh, kinds, q), kinds)


def _without_offsets(dh: Any, kinds: str, q: Any) -> Array:
    rows = np.array(dh, dtype=np.float64)
    turns = np.array([kind == "R" for kind in kinds])
    rows[:, 0] = np.where(turns, 0.0, rows[:, 0])
    rows[:, 1] = np.where(turns, rows[:, 1], 0.0)
    return jacobian(rows, kinds, np.asarray(q))


def _in_degrees(dh: Any, kinds: str, q: Any) -> Array:
    rows = np.array(dh, dtype=np.float64)
    rows[:, (0, 3)] = np.radians(rows[:, (0, 3)])
    turns, joints = np.array([kind == "R" for kind in kinds]), np.array(q, dtype=np.float64)
    return jacobian(rows, kinds, np.where(turns, np.radians(joints), joints))


def explain_function(v: Variant, given: Given) -> list[Step]:
    (robot,) = published(v)["robot 2"]
    return [
        Step(
            r"Row $i$ gives $\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$, with $q_i$ added to $\theta_i$ of a "
            r"revolute and to $d_i$ of a prismatic joint, and $\mathbf T_0^{i} = \mathbf T_0^{i-1} \mathbf T_{i-1}^{i}$, beginning with "
            r"$\mathbf T_0^{0} = \mathbf I$. (S2 prints the product as $\mathbf T_0^0 \mathbf T_1^0 \mathbf T_2^0 \cdots$ in one place; each factor "
            "leads from one frame to the next.)"
        ),
        Step(
            r"$\mathbf z_{i-1}$ and $\mathbf o_{i-1}$ are the third and the fourth column of $\mathbf T_0^{i-1}$. Column $i$ is "
            r"$\mathbf z_{i-1} \times (\mathbf o_n - \mathbf o_{i-1})$ above $\mathbf z_{i-1}$ (revolute), or $\mathbf z_{i-1}$ above zeros "
            "(prismatic)."
        ),
        Step("For robot 2 it returns:", r"\mathbf J", numbers=given["implement_it_jacobian"](*robot)),
    ]


def explain_steps(v: Variant, given: Given) -> list[Step]:
    return [Step(KEY)]


def key(_: Variant, __: Given) -> str:
    return KEY


def statement(_: Variant) -> str:
    kinds = ", ".join(f"robot {i} `{kinds}`" for i, kinds in enumerate(PUBLISHED, 1))
    return rf"""Write a Python function `implement_it_jacobian(dh, kinds, q)` that returns the Jacobian of **any** serial arm.

- `dh` is an $n$ × 4 array, one row $\theta_i, d_i, a_i, \alpha_i$ per joint, in this order, in the **standard** Denavit–Hartenberg
  convention (joint $i$ moves about or along $\mathbf z_{{i-1}}$). Angles are in radians, lengths in metres.
- `kinds` is a string of $n$ letters, such as `"RRP"`: R for a revolute joint, P for a prismatic one.
- `q` is an array of the $n$ joint variables, in radians or metres. $q_i$ is **added** to $\theta_i$ of a revolute joint and to $d_i$
  of a prismatic one; what stands in the table is its offset.
- The result is a 6 × $n$ array: $\mathbf J$ of the origin of frame $n$, in the axes of base frame 0, linear rows above angular rows.

It is called for arms that you do not see: planar ones, arms with prismatic joints, arms with six and with seven revolute
joints; each of these four groups is worth the same. Numpy is there as `np`; results are compared to six digits.

The tables `dh_1, dh_2, dh_3` and the joint variables `joints_1, joints_2, joints_3` of your numbers are three arms to try it with: {kinds}.
If you work **without Python** and hand in a file of numbers (.json, .csv, .mat), it holds the three Jacobians of these arms, in
this order, in place of the function."""


EXERCISE = Exercise(
    slug="implement_it",
    title="One function for every arm",
    source="S2",
    draw=draw,
    statement=statement,
    units={
        **{f"dh_{i}": [["rad", "m", "m", "rad"]] * len(kinds) for i, kinds in enumerate(PUBLISHED, 1)},
        **{f"joints_{i}": [UNITS[kind] for kind in kinds] for i, kinds in enumerate(PUBLISHED, 1)},
    },
    scale=lambda _: 1.0,
    objectives=(
        "Write the computation of a Jacobian once, for all arms.",
        "Test a function with cases whose answer is known.",
    ),
    minutes=60,
    hidden=tuple(GROUPS),
    parts=(
        Part(
            "implement_it_jacobian",
            "The function, under this name",
            8,
            Function("(dh, kinds, q)", inputs=hidden, published=published),
            reference,
            mistakes=tuple(mistakes()),
            hints=(
                "Write a function for one row of the table first.",
                "Keep all the transforms from the base, that of frame 0 too.",
                "Test it: move one joint by 1e-6 and divide the way of the origin by that.",
            ),
            explain=explain_function,
        ),
        Part(
            "implement_it_steps",
            "Which steps from an arm on the table to its Jacobian are done by hand, and which are automated by your function? Say in "
            "your own words what each step takes and gives, and why those by hand cannot be automated in the same way",
            2,
            Manual(
                (
                    (1, "the steps by hand, what they take and give, and why they are done anew for every arm"),
                    (1, "the automated steps in their order, each with what it takes and gives"),
                )
            ),
            key,
            hints=("Which steps are the same for every arm?",),
            explain=explain_steps,
        ),
    ),
)
