"""Joint torques that hold a force and a moment at the tool."""

from collections.abc import Callable, Iterable, Iterator
from inspect import signature
from typing import Any, Literal

import numpy as np

from ..answers import Numbers
from ..arm import Arm, Array
from ..calculations.twists import LOADS, Chosen, listed, rows_on_sheet, torque_units, wrench_units
from ..contract.question import Question, Wrong
from ..part import Ready, Setting
from .frames import filled

Axes = Literal["base", "tool"]
Turn = Callable[[Arm, Array], Array]
"""A wrench (m,) of the arm and of a wrench (m,) in other axes."""
TORQUES = r"""The joint torques $\boldsymbol\tau$@slides@ with which the drives hold the arm at your
$\mathbf q$ while the tool applies the @load@ $@symbol@ =$ @wrench@ to its surroundings, @axes@;
without gravity and friction

- Power is the same at the joints and at the tool: $\boldsymbol\tau^T \dot{\mathbf q} =
  \mathbf F^T \mathbf J \dot{\mathbf q}$ for all rates.
- Are force and Jacobian given in the same axes?

Because that holds for all rates, $\boldsymbol\tau = \mathbf J^T @symbol@$@turned@:
$$\boldsymbol\tau = <@name@>$$
"""
TURNED = (
    r", with the force turned into base axes first by the tool axes $\mathbf R$, the columns of "
    "the tool frame"
)
WRENCH = r"""The @load@ $\mathbf F =$ @wrench@ in base axes at your $\mathbf q$; given is
$@symbol@$, in the axes of the tool frame

- The columns of which matrix are the tool axes in base axes?
- A moment is turned like a force.

Both blocks are multiplied by the tool axes $\mathbf R$, the columns of the tool frame, which lead
from tool axes to base axes:
$$\mathbf F = <@name@>$$
"""
STILL_TOOL = "This is still in the axes of the tool frame; base axes are asked."
NOT_TURNED = (
    "The force seems to be used as if it were given in base axes; "
    "it is given in the axes of the tool frame."
)
TURNED_AWAY = (
    "The force seems to be turned the wrong way round: "
    "the tool axes R lead from tool axes to base axes."
)
UNTRANSPOSED = (
    "J F is no torque: power is the same in both spaces, so the transposed J stands here."
)
INVERSE = "This comes from the inverse of J; torques follow from the transposed J."
SIGN = (
    "Every sign is reversed: the tool applies this force to its surroundings, it does not bear it."
)
DIFFERENT = 1e-3  # by which a mistake must change some torque to be one for this robot
GIVEN_IN = {"base": "in base axes", "tool": "given in the axes of the tool frame"}


def torques(
    *,
    rows: Chosen = "all",
    axes: Axes = "base",
    name: str = "tau",
    points: float = 3,
    decimals: int = 3,
    J: str = "J",
    wrench: str = "wrench",
    symbol: str = r"\mathbf F",
) -> Ready:
    """Joint torques (n,) for the drawn `wrench`, printed as `symbol`.

    The wrench has the rows of the Jacobian `J` before it (tool point, base axes). With
    `axes="tool"` it is given in tool axes; its other components are zero.
    """

    def ready(setting: Setting) -> Question:
        robot = setting.robot
        asked = rows_on_sheet(rows, setting.rows, robot.task_rows)
        in_base_axes = _in_base_axes(axes, asked)

        def tau(arm: Arm, J: Array, wrench: Array) -> Array:
            return J.T @ in_base_axes(arm, wrench)

        slides, turn = "", ""
        if "P" in robot.kinds:
            slides = " (and forces along slides)"
        if axes == "tool":
            turn = TURNED
        text = filled(
            TORQUES,
            slides=slides,
            load=_load(asked),
            symbol=symbol,
            wrench=listed(LOADS, asked),
            axes=GIVEN_IN[axes],
            turned=turn,
            name=name,
        )
        shown = _showing(_mistakes(axes, asked, robot.n), tau, setting.arm, asked)
        answer = Numbers((robot.n,), torque_units(robot.kinds), decimals)
        renamed = {"J": J, "wrench": wrench}
        return Question(tau, name, points, answer, shown, docstring=text, renamed=renamed)

    return ready


def _in_base_axes(axes: Axes, rows: list[int]) -> Turn:
    """How a wrench with these rows that is given in these axes comes to base axes."""
    if axes == "tool":
        return lambda arm, wrench: turned(arm.R, wrench, rows)
    return lambda _, wrench: wrench


def _mistakes(axes: Axes, rows: list[int], n: int) -> Iterator[Wrong]:
    """Known wrong ways to the torques of an arm with n joints."""
    in_base_axes = _in_base_axes(axes, rows)
    yield SIGN, lambda arm, J, wrench: -J.T @ in_base_axes(arm, wrench)
    if axes == "tool":
        yield NOT_TURNED, lambda J, wrench: J.T @ wrench
        yield TURNED_AWAY, lambda arm, J, wrench: J.T @ turned(arm.R.T, wrench, rows)
    if len(rows) == n:
        yield UNTRANSPOSED, lambda arm, J, wrench: J @ in_base_axes(arm, wrench)
        yield INVERSE, lambda arm, J, wrench: np.linalg.pinv(J) @ in_base_axes(arm, wrench)


def _load(rows: list[int]) -> str:
    if max(rows) < 3:
        return "force"
    if min(rows) > 2:
        return "moment"
    return "force and moment"


def _showing(ways: Iterable[Wrong], tau: Any, arm: Arm, rows: list[int]) -> list[Wrong]:
    """The mistakes that change the torques of such an arm."""
    generic = np.arange(2.0, 2.0 + len(rows)) ** 1.5
    known = {"arm": arm, "J": arm.J[rows], "wrench": generic}
    right = tau(**known)

    found: list[Wrong] = []
    for sentence, wrong in ways:
        if np.abs(_called(wrong, known) - right).max() > DIFFERENT:
            found.append((sentence, wrong))
    return found


def _called(function: Any, known: dict[str, Any]) -> Array:
    return function(**{name: known[name] for name in signature(function).parameters})


def turned(R: Array, wrench: Array, rows: list[int]) -> Array:
    """Both blocks of a wrench times R; `rows` are those that it has, all others are zero."""
    whole = np.zeros(6)
    whole[rows] = wrench
    return np.concatenate([R @ whole[:3], R @ whole[3:]])[rows]


def wrench_in_base_axes(
    *,
    rows: Chosen = "all",
    name: str = "F",
    points: float = 2,
    decimals: int = 3,
    wrench: str = "F_tool",
    symbol: str = r"\mathbf F^{tool}",
) -> Ready:
    """A drawn `wrench` that is given in tool axes, in base axes.

    Its components in other rows than `rows` are zero.
    """

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        text = filled(
            WRENCH, load=_load(asked), wrench=listed(LOADS, asked), symbol=symbol, name=name
        )

        def F(arm: Arm, wrench: Array) -> Array:
            return turned(arm.R, wrench, asked)

        mistakes = (
            (STILL_TOOL, lambda wrench: wrench),
            (TURNED_AWAY, lambda arm, wrench: turned(arm.R.T, wrench, asked)),
        )
        answer = Numbers((len(asked),), wrench_units(asked), decimals)
        return Question(
            F, name, points, answer, mistakes, docstring=text, renamed={"wrench": wrench}
        )

    return ready
