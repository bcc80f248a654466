"""How fast the tool is in each direction: the velocity ellipsoid and its size."""

import numpy as np

from ...solutions.ellipsoids import velocity_ellipsoid
from ...solutions.singularity import manipulability as product_of_values
from ..answers import Numbers
from ..arm import Array
from ..calculations.twists import VELOCITIES, Chosen, jacobian_units, listed, rows_on_sheet
from ..contract.question import Question
from ..exercise import Outcome
from ..part import Ready, Setting
from ..properties import parallel
from .frames import filled

ELLIPSOID = r"""The half axes of the velocity ellipsoid of the @count@ rows @rows@ of $\mathbf J$:
the sizes of the velocities that joint rates with $\dot q_1^2 + \cdots + \dot q_{@n@}^2 = 1$ give
along its axes, the largest first

- They are the singular values of the block.
- The eigenvalues of $\mathbf J \mathbf J^T$ are their squares.

The singular values of the block,
$\mathbf J = \mathbf U\,\mathrm{diag}(\sigma_1, \ldots)\,\mathbf V^T$:
$$\boldsymbol\sigma = <@name@>$$
"""
LONGEST = r"""A unit vector $\mathbf u$ along the longest half axis of the velocity ellipsoid of the
rows @rows@ of $\mathbf J$, with either sign

- It is the direction in which the tool is fastest.
- It is an eigenvector of $\mathbf J \mathbf J^T$.

The first left singular vector of the block:
$$\mathbf u = <@name@>$$
"""
MANIPULABILITY = r"""The manipulability $w = \sqrt{\det(\mathbf J \mathbf J^T)}$ of the rows @rows@
of $\mathbf J$

- For a square block it is the size of the determinant.
- It is the product of the half axes of the velocity ellipsoid.

The product of the singular values:
$$w = <@name@>$$
"""
SLOWEST = "This is the direction in which the tool is slowest, and strongest."
SQUARES = "These are the squares: eigenvalues of J J^T. The half axes are their roots."
INVERSES = (
    "These are the half axes of the force ellipsoid, the inverses; "
    "those of the velocity ellipsoid are asked."
)
SQUARE = "This is det(J J^T), the square; the root is missing."
DIRECTION = 0.01  # how far an axis may be from the right one [rad]


def ellipsoid(
    *,
    rows: Chosen = "linear",
    name: str = "axes",
    points: float = 2,
    decimals: int = 3,
    J: str = "J",
) -> Ready:
    """Half axes (m,) of the velocity ellipsoid of the Jacobian `J` before it, with these rows."""

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        text = filled(
            ELLIPSOID,
            count=len(asked),
            rows=listed(VELOCITIES, asked),
            n=setting.robot.n,
            name=name,
        )
        mistakes = (
            (SQUARES, lambda J: velocity_ellipsoid(J).lengths ** 2),
            (INVERSES, lambda J: np.sort(1 / velocity_ellipsoid(J).lengths)[::-1]),
        )
        answer = Numbers((len(asked),), jacobian_units(asked, "R")[0][0], decimals)
        return Question(
            _half_axes, name, points, answer, mistakes, docstring=text, renamed={"J": J}
        )

    return ready


def _half_axes(J: Array) -> Array:
    return velocity_ellipsoid(J).lengths


def ellipsoid_axis(
    *,
    rows: Chosen = "linear",
    name: str = "axis",
    points: float = 2,
    decimals: int = 4,
    J: str = "J",
) -> Ready:
    """A direction (m,) of the longest half axis of the velocity ellipsoid.

    It is right at any length and with either sign. Draw postures whose two longest half axes differ
    clearly: on a circle every direction is one.
    """

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        text = filled(LONGEST, rows=listed(VELOCITIES, asked), name=name)
        return Question(
            _longest,
            name,
            points,
            Numbers((len(asked),), "1", decimals),
            check=_judged_axis,
            options={"credit": "all"},
            docstring=text,
            renamed={"J": J},
        )

    return ready


def _longest(J: Array) -> Array:
    return velocity_ellipsoid(J).axes[:, 0]


def _judged_axis(J: Array, value: Array) -> Outcome:
    axes = velocity_ellipsoid(J).axes
    if parallel(value, axes[:, 0], DIRECTION):
        return Outcome(right=True)
    if parallel(value, axes[:, -1], DIRECTION):
        return Outcome(right=False, finding=SLOWEST)
    return Outcome(right=False)


def manipulability(
    *, rows: Chosen = "task", name: str = "w", points: float = 1, decimals: int = 4, J: str = "J"
) -> Ready:
    """Manipulability (Yoshikawa, 1985) of the Jacobian `J` before it, which has these rows."""

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        text = filled(MANIPULABILITY, rows=listed(VELOCITIES, asked), name=name)
        mistakes = ((SQUARE, lambda J: product_of_values(J) ** 2),)
        answer = Numbers((), "1", decimals)
        return Question(
            _manipulability, name, points, answer, mistakes, docstring=text, renamed={"J": J}
        )

    return ready


def _manipulability(J: Array) -> Array:
    return product_of_values(J)
