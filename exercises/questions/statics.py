"""Joint torques that hold a force and a moment at the tool."""

from inspect import signature
from typing import Any, Literal

import numpy as np

from ..answers import Numbers
from ..arm import Arm, Array
from ..calculations.twists import LOADS, Chosen, listed, rows_on_sheet, torque_units, wrench_units
from ..contract.question import Question
from ..part import Ready, Setting
from .frames import filled

TORQUES = r"""The joint torques $\boldsymbol\tau$@slides@ with which the drives hold the arm at your
$\mathbf q$ while the tool applies the @load@ $@symbol@ =$ @wrench@ to its surroundings, @axes@;
without gravity and friction

- Power is the same at the joints and at the tool: $\boldsymbol\tau^T \dot{\mathbf q} =
  \mathbf F^T \mathbf J \dot{\mathbf q}$ for all rates.
- Are force and Jacobian given in the same axes?

Because that holds for all rates, $\boldsymbol\tau = \mathbf J^T @symbol@$@turned@:
$$\boldsymbol\tau = <@name@>$$
"""
TURNED = r", with the force turned into base axes first by the tool axes $\mathbf R$, the columns of the tool frame"
WRENCH = r"""The @load@ $\mathbf F =$ @wrench@ in base axes at your $\mathbf q$; given is
$@symbol@$, in the axes of the tool frame

- The columns of which matrix are the tool axes in base axes?
- A moment is turned like a force.

Both blocks are multiplied by the tool axes $\mathbf R$, the columns of the tool frame, which lead
from tool axes to base axes:
$$\mathbf F = <@name@>$$
"""
STILL_TOOL = "This is still in the axes of the tool frame; base axes are asked."
NOT_TURNED = "The force seems to be used as if it were given in base axes; it is given in the axes of the tool frame."
TURNED_AWAY = "The force seems to be turned the wrong way round: the tool axes R lead from tool axes to base axes."
UNTRANSPOSED = (
    "J F is no torque: power is the same in both spaces, so the transposed J stands here."
)
INVERSE = "This comes from the inverse of J; torques follow from the transposed J."
DIFFERENT = 1e-3
SIGN = (
    "Every sign is reversed: the tool applies this force to its surroundings, it does not bear it."
)


def torques(
    *,
    rows: Chosen = "all",
    axes: Literal["base", "tool"] = "base",
    name: str = "tau",
    points: float = 3,
    decimals: int = 3,
    J: str = "J",
    wrench: str = "wrench",
    symbol: str = r"\mathbf F",
) -> Ready:
    """Joint torques (n,) for the drawn `wrench`, printed as `symbol`, in the rows of the Jacobian `J` before it (tool point, base axes).

    With `axes="tool"` the wrench is given in tool axes; its other components are zero.
    """

    def ready(setting: Setting) -> Question:
        robot = setting.robot
        asked = rows_on_sheet(rows, setting.rows, robot.task_rows)
        in_tool_axes = axes == "tool"

        def in_base_axes(arm: Arm, wrench: Array) -> Array:
            return turned(arm.R, wrench, asked) if in_tool_axes else wrench

        text = filled(
            TORQUES,
            slides=" (and forces along slides)" if "P" in robot.kinds else "",
            load=_load(asked),
            symbol=symbol,
            wrench=listed(LOADS, asked),
            axes="given in the axes of the tool frame" if in_tool_axes else "in base axes",
            turned=TURNED if in_tool_axes else "",
            name=name,
        )
        wrong: list[tuple[str, Any]] = [
            (SIGN, lambda arm, J, wrench: -_torques(J, in_base_axes(arm, wrench)))
        ]
        if in_tool_axes:
            wrong += [
                (NOT_TURNED, lambda J, wrench: J.T @ wrench),
                (TURNED_AWAY, lambda arm, J, wrench: J.T @ turned(arm.R.T, wrench, asked)),
            ]
        if len(asked) == robot.n:
            wrong += [
                (UNTRANSPOSED, lambda arm, J, wrench: J @ in_base_axes(arm, wrench)),
                (INVERSE, lambda arm, J, wrench: np.linalg.pinv(J) @ in_base_axes(arm, wrench)),
            ]

        def tau(arm: Arm, J: Array, wrench: Array) -> Array:
            return _torques(J, in_base_axes(arm, wrench))

        shown = _showing(wrong, tau, setting.arm, asked)
        answer = Numbers((robot.n,), torque_units(robot.kinds), decimals)
        renamed = {"J": J, "wrench": wrench}
        return Question(tau, name, points, answer, shown, docstring=text, renamed=renamed)

    return ready


def _load(rows: list[int]) -> str:
    if max(rows) < 3:
        return "force"
    return "moment" if min(rows) > 2 else "force and moment"


def _showing(
    wrong: list[tuple[str, Any]], tau: Any, arm: Arm, rows: list[int]
) -> list[tuple[str, Any]]:
    """The mistakes that change the torques of such an arm."""
    known = {"arm": arm, "J": arm.J[rows], "wrench": np.arange(2.0, 2.0 + len(rows)) ** 1.5}
    right = tau(**known)
    return [
        (said, of) for said, of in wrong if np.abs(_called(of, known) - right).max() > DIFFERENT
    ]


def _called(function: Any, known: dict[str, Any]) -> Array:
    return function(**{name: known[name] for name in signature(function).parameters})


def _torques(J: Array, F: Array) -> Array:
    return J.T @ F


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
    """A drawn `wrench` that is given in tool axes, in base axes; its components in other rows are zero."""

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
