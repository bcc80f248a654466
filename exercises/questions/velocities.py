"""Twists for joint rates, and joint rates for velocities."""

from collections.abc import Callable

import numpy as np

from ..answers import Numbers
from ..arm import Array
from ..calculations.readings import SLACK, reaches, unique_or_least_rates
from ..calculations.twists import (
    VELOCITIES,
    Chosen,
    listed,
    rate_units,
    rows_on_sheet,
    twist_units,
)
from ..contract.question import Question, Wrong
from ..exercise import Outcome
from ..part import Ready, Setting
from .frames import filled

TWIST = r"""The twist $\boldsymbol\xi =$ @twist@ of the tool at your $\mathbf q$ for the joint rates
$@symbol@$

- One matrix times one vector: the joint rates are the weights of the columns.

$\boldsymbol\xi = \mathbf J \dot{\mathbf q}$:
$$\boldsymbol\xi = <@name@>$$
"""
TRANSPOSED_TWIST = (
    "This is J transposed times the joint rates; joint rates are weights of the columns of J."
)
RATES = r"""The joint rates $\dot{\mathbf q}$ @least@at which the tool has the velocity $@symbol@ =$
@twist@ at your $\mathbf q$

- Which rows of $\mathbf J$ take part?
- Are there as many of them as joints, or fewer?

@how@
$$\dot{\mathbf q} = <@name@>$$
"""
SQUARE = r"There are as many rows as joints, so $\dot{\mathbf q} = \mathbf J^{-1} @symbol@$:"
WIDE = (
    r"There are more joints than rows; of all rates that give the velocity those of least norm are "
    r"$\dot{\mathbf q} = \mathbf J^{+} @symbol@$ with "
    r"$\mathbf J^{+} = \mathbf J^{T} (\mathbf J \mathbf J^{T})^{-1}$:"
)
TRANSPOSED = (
    "This comes from J transposed, which is no inverse: put the rates into J and look at the "
    "velocity they give."
)
NORM = (
    "These rates give the velocity, but there are smaller ones: "
    "of all that do, those of least norm are asked."
)
UNASKED_NORM = 0.5  # of the points for rates that reach the velocity, but not with the least norm


def twist(
    *,
    rows: Chosen = "all",
    name: str = "xi",
    points: float = 2,
    decimals: int = 3,
    J: str = "J",
    qdot: str = "qdot",
    symbol: str = r"\dot{\mathbf q}",
) -> Ready:
    """The twist (m,) that the drawn joint rates `qdot`, printed as `symbol`, give.

    `rows` are those of the Jacobian `J` before it.
    """

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        text = filled(TWIST, twist=listed(VELOCITIES, asked), symbol=symbol, name=name)
        answer = Numbers((len(asked),), twist_units(asked), decimals)
        wrong: list[Wrong] = []
        if len(asked) == setting.robot.n:
            wrong.append((TRANSPOSED_TWIST, lambda J, qdot: J.T @ qdot))
        renamed = {"J": J, "qdot": qdot}
        return Question(_twist, name, points, answer, wrong, docstring=text, renamed=renamed)

    return ready


def _twist(J: Array, qdot: Array) -> Array:
    return J @ qdot


def rates(
    *,
    rows: Chosen = "all",
    name: str = "rates",
    points: float = 3,
    decimals: int = 4,
    J: str = "J",
    xi: str = "xi",
    symbol: str = r"\boldsymbol\xi",
) -> Ready:
    """Joint rates (n,) for the drawn velocity `xi`, printed as `symbol`.

    `rows` are those of the Jacobian `J` before it. The rates are unique for a square block, and
    those of least norm where there are fewer rows than joints. Rates are right by the velocity they
    reach, too.
    """

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        square = len(asked) == setting.robot.n
        least, how = "of least norm ", WIDE
        if square:
            least, how = "", SQUARE
        text = filled(
            RATES,
            least=least,
            twist=listed(VELOCITIES, asked),
            how=how,
            symbol=symbol,
            name=name,
        )
        return Question(
            unique_or_least_rates,
            name,
            points,
            Numbers((setting.robot.n,), rate_units(setting.robot.kinds), decimals),
            mistakes=((TRANSPOSED, lambda J, xi: J.T @ xi),),
            check=_by_velocity(decimals, least=not square),
            docstring=text,
            renamed={"J": J, "xi": xi},
        )

    return ready


def _by_velocity(decimals: int, *, least: bool) -> Callable[..., Outcome | None]:

    def judged(J: Array, xi: Array, value: Array) -> Outcome | None:
        if not reaches(J, value, xi, decimals, float(np.abs(xi).max())):
            return None
        if not least:
            return Outcome(right=True)

        apart = np.abs(value - unique_or_least_rates(J, xi)).max()
        if apart <= SLACK * max(1.0, float(np.abs(value).max())):
            return None  # how near the rates are is left to the tolerance
        return Outcome(finding=NORM, share=UNASKED_NORM)

    return judged
