"""S1 5.26: the columns of a Jacobian in the axes of the last frame, from the transforms that lead to it.

S1 names the formulas after n, o, a and p, the columns of the transform from frame i - 1 to frame 6. Two transforms are
printed, for two columns on paper; the rest is for the notebook.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ...solutions.jacobian import jacobian
from ...solutions.jacobian import last_frame_columns as last_frame
from ...solutions.robots import ROBOTS, Robot
from ..drawing import Drawing, Triad
from ..draws import angles, length, until
from ..exercise import Exercise, Given, Mistake, Numbers, Part, Step, Variant

Array = NDArray[np.float64]
LENGTHS = ("a2", "a3", "a4", "d6")
TWIST_UNITS = ["m/rad"] * 3 + ["1"] * 3
POSE_UNITS = [["1", "1", "1", "m"]] * 3 + [["1"] * 4]
PRINTED = ("TA", "TB")
SHOWS = 0.05  # by which a mistake changes a column, and the size of its linear rows


@lru_cache(maxsize=1)
def robot() -> Robot:
    """S1's arm with a hand of length d6 on axis 6."""
    arm = ROBOTS["articulated_6r"]
    rows = [(str(theta), str(d), str(a), str(alpha)) for theta, d, a, alpha in arm.rows]
    rows[5] = ("q6", "d6", "0", "0")
    parameters = {**arm.parameters, "d6": 0.1}
    return Robot(arm.name, arm.title, parameters, tuple(rows), arm.limits, arm.source)


@lru_cache(maxsize=2)
def misread(convention: Literal["standard", "modified"]) -> Robot:
    """The arm of a student who reads the table in this convention; in the standard one, with 90 for a right angle."""
    if convention == "modified":
        return replace(robot(), convention="modified")
    degrees = {"pi/2": "90", "-pi/2": "-90", "0": "0"}
    return replace(robot(), rows=tuple((t, d, a, degrees[str(alpha)]) for t, d, a, alpha in robot().rows))


def lengths(v: Variant) -> dict[str, float]:
    return {name: v[name] for name in LENGTHS}


def to_last_frame(v: Variant) -> Array:
    """Transforms (7, 4, 4) from frame 0, 1, ... 6 to frame 6."""
    poses = robot().frames(lengths(v), v["q"])
    return np.linalg.inv(poses) @ poses[-1]


def sums_for_differences(v: Variant) -> Array:
    T = to_last_frame(v)[:6]
    x, y, z = (T[:, i, :3] for i in range(3))
    p = T[:, :3, 3, None]
    return np.concatenate([x * p[:, 1] + y * p[:, 0], z], axis=1).T


def rows_for_columns(v: Variant) -> Array:
    T = to_last_frame(v)[:6]
    T[:, :3, :3] = T[:, :3, :3].mT
    return last_frame(T, "R" * 6)


def next_transforms(v: Variant) -> Array:
    return last_frame(to_last_frame(v)[1:], "R" * 6)


def signs_of_linear_rows(v: Variant) -> Array:
    return last_frame(to_last_frame(v)[:6], "R" * 6) * np.array([[-1.0], [1.0]]).repeat(3, 0)


def base_axes(v: Variant) -> Array:
    return jacobian(robot().chain(lengths(v)), v["q"])


MODIFIED = (
    "The table seems to be read in the modified convention; look again at the order of the four motions of a row."
)
DEGREES = "Angles in degrees seem to have gone into a sine or cosine that takes radians."
WRONG: tuple[tuple[str, Callable[[Variant], Array]], ...] = (
    ("Look again at the signs of the linear rows: one of the two products is subtracted.", sums_for_differences),
    (
        "Rows and columns of the rotation seem exchanged: n, o and a are its columns, and n_z is the last entry of n.",
        rows_for_columns,
    ),
    ("This comes out of the transform of another frame: column i takes the one from frame i - 1.", next_transforms),
    ("This is in base axes; the axes of frame 6 are asked.", base_axes),
    ("Every sign of the linear rows is reversed: which of the two products is subtracted?", signs_of_linear_rows),
)


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm, two columns for the paper, and their transforms with four decimals; every known mistake shows."""
    columns = sorted(int(i) for i in rng.choice([1, 2, 3, 4, 5], 2, replace=False))

    def drawn() -> dict[str, Any]:
        v: dict[str, Any] = {"columns": columns, "a2": length(rng), "a3": length(rng)}
        return v | {"a4": length(rng, 0.2, 0.6), "d6": length(rng, 0.2, 0.5), "q": angles(rng, 6, [(1, 2), (1, 2, 3)])}

    v = until(drawn, shows_mistakes)
    printed = np.round(to_last_frame(v)[[i - 1 for i in columns]], 4) + 0.0
    return v | dict(zip(PRINTED, printed.tolist(), strict=True))


def shows_mistakes(v: Variant) -> bool:
    """Whether every known mistake changes the columns on paper, and no column is small."""
    J, columns = last_frame(to_last_frame(v)[:6], "R" * 6), [i - 1 for i in v["columns"]]
    changes = [np.abs(wrong(v) - J)[:, columns].max(axis=0).min() for _, wrong in WRONG]
    return min(changes) > SHOWS and bool((np.linalg.norm(J[:3, :5], axis=0) > SHOWS).all())


def modified_transforms(v: Variant) -> Array:
    """Transforms (7, 4, 4) from frame 0, 1, ... 6 to frame 6 where the table is read in the modified convention."""
    poses = np.array([np.eye(4), *misread("modified").frames(lengths(v), v["q"])[:6]])
    return np.linalg.inv(poses) @ poses[-1]


def transforms_in_degrees(v: Variant) -> Array:
    """Transforms (6, 4, 4) with every angle in degrees in functions that take radians."""
    poses = misread("standard").frames(lengths(v), np.degrees(v["q"]))
    return np.linalg.inv(poses[:6]) @ poses[-1]


def transforms(v: Variant, _: Given) -> Array:
    return to_last_frame(v)[:6]


def printed_transforms(v: Variant, _: Given) -> Array:
    return np.array([v[name] for name in PRINTED])


def column(k: int) -> Callable[[Variant, Given], Array]:
    """Solves for the column of the first or second printed transform."""
    return lambda _, given: last_frame(given["last_frame_columns_printed"][k : k + 1], "R")[:, 0]


def wrong_columns(k: int) -> tuple[Mistake, ...]:
    """Known mistakes in the first or second column on paper."""

    def mistake(sentence: str, wrong: Callable[[Variant], Array]) -> Mistake:
        return Mistake(sentence, lambda v, _: wrong(v)[:, v["columns"][k] - 1])

    return tuple(mistake(sentence, wrong) for sentence, wrong in WRONG)


def wrong_jacobian(sentence: str, wrong: Callable[[Variant], Array]) -> Mistake:
    return Mistake(sentence, lambda v, _: wrong(v))


def all_columns(_: Variant, given: Given) -> Array:
    return last_frame(given["last_frame_columns_T"], "R" * 6)


def turned(R: Array, J: Array) -> Array:
    """J with both blocks turned by R."""
    return np.concatenate([R @ J[:3], R @ J[3:]])


def in_base_axes(_: Variant, given: Given) -> Array:
    return turned_by(given["last_frame_columns_T"], given)


def turned_by(T: Array, given: Given) -> Array:
    """The student's own J turned by the rotation of the first of these transforms."""
    return turned(T[0, :3, :3], given["last_frame_columns_J"])


def turned_back(_: Variant, given: Given) -> Array:
    return turned(given["last_frame_columns_T"][0, :3, :3].T, given["last_frame_columns_J"])


def linear_rows_only(v: Variant, given: Given) -> Array:
    return np.concatenate([in_base_axes(v, given)[:3], given["last_frame_columns_J"][3:]])


def explain_column(k: int) -> Callable[[Variant, Given], list[Step]]:
    def explain(v: Variant, given: Given) -> list[Step]:
        i = v["columns"][k]
        return [
            Step(
                rf"Column {i} takes $\mathbf T_{{{i - 1}}}^{{6}}$, with the columns $\mathbf n, \mathbf o, \mathbf a, \mathbf p$:",
                rf"\mathbf T_{{{i - 1}}}^{{6}}",
                numbers=given["last_frame_columns_printed"][k],
            ),
            Step(
                r"The linear rows are $-n_x p_y + n_y p_x$, $-o_x p_y + o_y p_x$ and $-a_x p_y + a_y p_x$: the velocity "
                r"$\mathbf z \times \mathbf p$ of the hand along each axis of frame 6. The angular rows are $n_z, o_z, a_z$, the axis "
                r"$\mathbf z$ in that frame:",
                rf"\mathbf J_{{{i}}}",
                numbers=given[f"last_frame_columns_{'AB'[k]}"],
            ),
        ]

    return explain


def explain_jacobian(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Multiply from the end: $\mathbf T_5^{6} = \mathbf A_6$, $\mathbf T_4^{6} = \mathbf A_5 \mathbf T_5^{6}$ and so on to $\mathbf T_0^{6}$, where "
            r"$\mathbf A_i$ is the transform of row $i$ of the table. The transform of the first column:",
            r"\mathbf T_0^{6}",
            numbers=given["last_frame_columns_T"][0],
        ),
        Step(
            r"Column $i$ then comes from $\mathbf T_{i-1}^{6}$ as before. The tool point lies on axis 6, so that the last column is "
            r"always $(0, 0, 0, 0, 0, 1)$:",
            r"\mathbf J^{6}",
            numbers=given["last_frame_columns_J"],
        ),
    ]


def explain_base(_: Variant, given: Given) -> list[Step]:
    return [
        Step(
            r"Velocity and angular velocity are vectors, so each block is turned by the rotation $\mathbf R = (\mathbf n\; \mathbf o\; \mathbf a)$ "
            r"of $\mathbf T_0^{6}$, whose columns are the axes of frame 6 in the base frame; the point stays the same:",
            r"\mathbf J^{0} = \begin{bmatrix} \mathbf R & \mathbf 0 \\ \mathbf 0 & \mathbf R \end{bmatrix} \mathbf J^{6}",
            numbers=given["last_frame_columns_base"],
        )
    ]


def drawings(v: Variant) -> tuple[Drawing, ...]:
    poses = robot().frames(lengths(v), v["q"])
    return (
        Drawing(
            robot().chain(lengths(v)),
            tuple(v["q"]),
            "Your arm at your q, with frame 0 and frame 6.",
            "Articulated arm with six revolute joints, drawn at your q with its base frame and its hand frame.",
            (Triad(np.eye(4), "0"), Triad(poses[-1], "6")),
            arrows=False,
        ),
    )


def statement(v: Variant) -> str:
    first, second = v["columns"]
    return rf"""The articulated arm has six revolute joints. Its table in the **standard** Denavit–Hartenberg convention:

| $i$ | $\theta_i$ | $d_i$ | $a_i$ | $\alpha_i$ |
|:-:|:-:|:-:|:-:|:-:|
| 1 | $q_1$ | 0 | 0 | $\pi/2$ |
| 2 | $q_2$ | 0 | $a_2$ | 0 |
| 3 | $q_3$ | 0 | $a_3$ | 0 |
| 4 | $q_4$ | 0 | $a_4$ | $-\pi/2$ |
| 5 | $q_5$ | 0 | 0 | $\pi/2$ |
| 6 | $q_6$ | $d_6$ | 0 | 0 |

The point whose velocity is meant is the origin of frame 6. $\mathbf J^{{6}}$ is its Jacobian **in the axes of frame 6**, the last
frame; $\mathbf J^{{0}}$ is that of the same point in base axes. $\mathbf T_{{i-1}}^{{6}}$ is the pose of frame 6 in frame $i-1$ at your
$\mathbf q$, the product of rows $i$ to 6 of the table. Two of them are among your numbers, rounded to four decimals, the first three
entries of the last column in metres:

- TA is $\mathbf T_{{{first - 1}}}^{{6}}$, for **column A**, which is column {first} of $\mathbf J^{{6}}$;
- TB is $\mathbf T_{{{second - 1}}}^{{6}}$, for **column B**, which is column {second} of $\mathbf J^{{6}}$."""


def paper_part(k: int) -> Part:
    name = "AB"[k]
    return Part(
        f"last_frame_columns_{name}",
        rf"Column {name} of $\mathbf J^{{6}}$ from T{name}, on paper or with a pocket calculator: six numbers, linear rows first",
        2,
        Numbers((6,), TWIST_UNITS, decimals=3),
        column(k),
        needs=("last_frame_columns_printed",),
        mistakes=wrong_columns(k),
        hints=(
            "Name the columns of the printed matrix n, o, a and p first.",
            "The linear rows are the same formula three times, with n, o and a in turn.",
        ),
        explain=explain_column(k),
    )


EXERCISE = Exercise(
    slug="last_frame_columns",
    title="The Jacobian in the last frame",
    source="S1 5.10, eq. 5.26",
    draw=draw,
    statement=statement,
    units={**dict.fromkeys(LENGTHS, "m"), "q": ["rad"] * 6, "TA": POSE_UNITS, "TB": POSE_UNITS},
    scale=lambda v: sum(v[name] for name in LENGTHS),
    objectives=(
        "Read a column of the Jacobian off the transform to the last frame.",
        "Turn a Jacobian from the axes of the hand into those of the base.",
    ),
    minutes=40,
    robot="articulated_6r",
    drawings=drawings,
    parts=(
        Part(
            "last_frame_columns_printed",
            "",
            0,
            Numbers((2, 4, 4)),
            printed_transforms,
            asked=False,
        ),
        Part("last_frame_columns_T", "", 0, Numbers((6, 4, 4)), transforms, asked=False),
        paper_part(0),
        paper_part(1),
        Part(
            "last_frame_columns_J",
            r"All six columns of $\mathbf J^{6}$ at your $\mathbf q$, a 6 × 6 matrix with the linear rows above the angular ones",
            4,
            Numbers((6, 6), [[unit] for unit in TWIST_UNITS], decimals=3),
            all_columns,
            needs=("last_frame_columns_T",),
            mistakes=(
                *(wrong_jacobian(sentence, wrong) for sentence, wrong in WRONG),
                wrong_jacobian(MODIFIED, lambda v: last_frame(modified_transforms(v)[:6], "R" * 6)),
                wrong_jacobian(MODIFIED, lambda v: last_frame(modified_transforms(v)[1:], "R" * 6)),
                wrong_jacobian(DEGREES, lambda v: last_frame(transforms_in_degrees(v), "R" * 6)),
            ),
            hints=(
                "A loop over the columns from the last to the first needs one more matrix product each time.",
                "Two of the columns are known already.",
            ),
            explain=explain_jacobian,
        ),
        Part(
            "last_frame_columns_base",
            r"$\mathbf J^{0}$ at your $\mathbf q$: the Jacobian of the same point in base axes, 6 × 6, from $\mathbf J^{6}$ and the rotation in "
            r"$\mathbf T_0^{6}$",
            2,
            Numbers((6, 6), [[unit] for unit in TWIST_UNITS], decimals=3),
            in_base_axes,
            needs=("last_frame_columns_J", "last_frame_columns_T"),
            credit="column",
            mistakes=(
                Mistake(
                    "The rotation seems to be turned the other way round: whose axes are its columns?", turned_back
                ),
                Mistake("Which of the two blocks change when only the axes change?", linear_rows_only),
                Mistake(
                    "This is still in the axes of frame 6; base axes are asked.",
                    lambda _, given: given["last_frame_columns_J"],
                ),
                Mistake(MODIFIED, lambda v, given: turned_by(modified_transforms(v), given)),
                Mistake(DEGREES, lambda v, given: turned_by(transforms_in_degrees(v), given)),
            ),
            hints=(
                "Only the axes change, the point does not.",
                "Test your rotation on one axis that you know in both frames, such as z of frame 6.",
            ),
            explain=explain_base,
        ),
    ),
)
