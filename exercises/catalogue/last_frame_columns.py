"""S1 5.26: the columns of a Jacobian in the axes of the last frame, from the transforms to it.

S1 names the formulas after n, o, a and p, the columns of the transform from frame i - 1 to frame 6.
Two transforms are printed, for two columns on paper; the rest is for the notebook.
"""

from typing import Any

import numpy as np

from ...solutions.jacobian import last_frame_columns
from ..answers import Numbers
from ..arm import Arm, Array, arm_of
from ..arms.hand import CONVENTION, DEGREES, ROBOT, drawn, in_degrees, modified
from ..calculations.last_frame import (
    HALF,
    WAY_BACK,
    WRONG,
    columns_of,
    shows_mistakes,
    to_last,
    turned,
)
from ..contract.names import Function
from ..contract.printed_table import printed_table, table_rows
from ..contract.question import Question
from ..draws import angles, length, until
from ..part import exercise, part

TWIST_UNITS = ["m/rad"] * 3 + ["1"] * 3
COLUMN = Numbers((6,), TWIST_UNITS, 3)
WHOLE = Numbers((6, 6), [[unit] for unit in TWIST_UNITS], 3)
POSE_UNITS = [["1", "1", "1", "m"]] * 3 + [["1"] * 4]
BLOCKS = r"\begin{bmatrix} \mathbf R & \mathbf 0 \\ \mathbf 0 & \mathbf R \end{bmatrix}"
IN_LAST = "This is still in the axes of frame 6; base axes are asked."


def draw(rng: np.random.Generator) -> dict[str, Any]:
    """An arm, two columns for the paper, and their transforms with four decimals."""
    columns: list[int] = np.sort(rng.choice([1, 2, 3, 4, 5], 2, replace=False)).tolist()
    first, second = columns

    def arm() -> dict[str, Any]:
        return {
            "columns": columns,
            "a2": length(rng),
            "a3": length(rng),
            "a4": length(rng, 0.4, 0.8),
            "d6": length(rng, 0.4, 0.8),
            "q": angles(rng, 6, [(1, 2), (1, 2, 3)]),
        }

    v = until(arm, lambda v: shows_mistakes(arm_of(ROBOT, v), [first - 1, second - 1]))
    printed = np.round(to_last(arm_of(ROBOT, v)), 4) + 0.0
    return v | {"TA": printed[first - 1].tolist(), "TB": printed[second - 1].tolist()}


@part(0, Numbers((2, 4, 4)), asked=False)
def printed(TA: Array, TB: Array) -> Array:
    """What is printed is rounded, and so are the columns on paper."""
    return np.array([TA, TB])


@part(0, Numbers((6, 4, 4)), asked=False)
def T(arm: Arm) -> Array:
    """The transforms from frames 0 ... 5 to frame 6."""
    return to_last(arm)[:6]


def on_paper(k: int) -> Question:
    """The part about the first or the second printed transform."""
    X = "AB"[k]

    def column(printed: Array) -> Array:
        return last_frame_columns(printed[k : k + 1], "R")[:, 0]

    def same_column_of(way: Function) -> Function:
        return lambda arm, columns: way(arm)[:, columns[k] - 1]

    column.__doc__ = rf"""Column {X} of $\mathbf J^{{6}}$ from T{X}, on paper or with a pocket
    calculator: six numbers, linear rows first

    - Name the columns of the printed matrix n, o, a and p first.
    - The linear rows are the same formula three times, with n, o and a in turn.

    Column <i> takes $\mathbf T_{{<before>}}^{{6}}$, with the columns
    $\mathbf n, \mathbf o, \mathbf a, \mathbf p$:
    $$\mathbf T_{{<before>}}^{{6}} = <T{X}>$$

    The linear rows are $-n_x p_y + n_y p_x$, $-o_x p_y + o_y p_x$ and $-a_x p_y + a_y p_x$: the
    velocity $\mathbf z \times \mathbf p$ of the hand along each axis of frame 6. The angular rows
    are $n_z, o_z, a_z$, the axis $\mathbf z$ in that frame:
    $$\mathbf J_{{<i>}} = <{X}>$$
    """
    mistakes = [(sentence, same_column_of(way)) for sentence, way in WRONG]
    shows = {
        "i": lambda columns: int(columns[k]),
        "before": lambda columns: int(columns[k]) - 1,
    }
    return part(2, COLUMN, mistakes=mistakes, shows=shows)(column).called(X)


@part(
    4,
    WHOLE,
    mistakes=(
        *WRONG,
        (CONVENTION, lambda arm: columns_of(modified(arm))),
        (CONVENTION, lambda arm: columns_of(modified(arm)[1:])),
        (DEGREES, lambda arm: columns_of(in_degrees(arm))),
    ),
    shows={"T0": lambda T: T[0]},
)
def J(T: Array) -> Array:
    r"""All six columns of $\mathbf J^{6}$ at your $\mathbf q$, a 6 × 6 matrix with the linear rows
    above the angular ones

    - A loop over the columns from the last to the first needs one more matrix product each time.
    - Two of the columns are known already.

    Multiply from the end: $\mathbf T_5^{6} = \mathbf A_6$,
    $\mathbf T_4^{6} = \mathbf A_5 \mathbf T_5^{6}$ and so on to $\mathbf T_0^{6}$, where
    $\mathbf A_i$ is the transform of row $i$ of the table. The transform of the first column:
    $$\mathbf T_0^{6} = <T0>$$

    Column $i$ then comes from $\mathbf T_{i-1}^{6}$ as before. The tool point lies on axis 6, so
    that the last column is always $(0, 0, 0, 0, 0, 1)$:
    $$\mathbf J^{6} = <J>$$
    """
    return columns_of(T)


@part(
    2,
    WHOLE,
    credit="column",
    mistakes=(
        (WAY_BACK, lambda T, J: turned(T[0, :3, :3].T, J)),
        (HALF, lambda base, J: np.concatenate([base[:3], J[3:]])),
        (IN_LAST, lambda J: J),
        (CONVENTION, lambda arm, J: turned(modified(arm)[0, :3, :3], J)),
        (DEGREES, lambda arm, J: turned(in_degrees(arm)[0, :3, :3], J)),
    ),
    shows={"blocks": lambda: BLOCKS},
)
def base(J: Array, T: Array) -> Array:
    r"""$\mathbf J^{0}$ at your $\mathbf q$: the Jacobian of the same point in base axes, 6 × 6,
    from $\mathbf J^{6}$ and the rotation in $\mathbf T_0^{6}$

    - Only the axes change, the point does not.
    - Test your rotation on one axis that you know in both frames, such as z of frame 6.

    Velocity and angular velocity are vectors, so each block is turned by the rotation
    $\mathbf R = (\mathbf n\; \mathbf o\; \mathbf a)$ of $\mathbf T_0^{6}$, whose columns are the
    axes of frame 6 in the base frame; the point stays the same:
    $$\mathbf J^{0} = <blocks> \mathbf J^{6} = <base>$$
    """
    return turned(T[0, :3, :3], J)


def statement(columns: Array) -> str:
    """The table, what is meant by J^6 and J^0, and which columns are asked on paper."""
    first, second = columns
    return rf"""The articulated arm has six revolute joints. Its table in the **standard**
Denavit–Hartenberg convention:

{printed_table(table_rows(ROBOT))}

The point whose velocity is meant is the origin of frame 6. $\mathbf J^{{6}}$ is its Jacobian **in
the axes of frame 6**, the last frame; $\mathbf J^{{0}}$ is that of the same point in base axes.
$\mathbf T_{{i-1}}^{{6}}$ is the pose of frame 6 in frame $i-1$ at your $\mathbf q$, the product of
rows $i$ to 6 of the table. Two of them are among your numbers, rounded to four decimals, the first
three entries of the last column in metres:

- TA is $\mathbf T_{{{first - 1}}}^{{6}}$, for **column A**, which is column {first} of
  $\mathbf J^{{6}}$;
- TB is $\mathbf T_{{{second - 1}}}^{{6}}$, for **column B**, which is column {second} of
  $\mathbf J^{{6}}$."""


EXERCISE = exercise(
    "last_frame_columns",
    title="The Jacobian in the last frame",
    source="S1 5.10, eq. 5.26",
    minutes=40,
    objectives=(
        "Read a column of the Jacobian off the transform to the last frame.",
        "Turn a Jacobian from the axes of the hand into those of the base.",
    ),
    robot=ROBOT,
    robot_map="articulated_6r",
    units={"TA": POSE_UNITS, "TB": POSE_UNITS},
    structure=("columns",),
    draw=draw,
    statement=statement,
    drawings=drawn,
    parts=(printed, T, on_paper(0), on_paper(1), J, base),
)
