"""A Jacobian in base axes at the tool point, led to tool axes or to the base origin."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..answers import Numbers
from ..arm import Arm, Array
from ..calculations.conversions import (
    LINEAR_ONLY,
    MOVED,
    NEITHER,
    NOT_BASE,
    STILL_AT_TOOL,
    STILL_BASE,
    STILL_IN_TOOL,
    TOOL_MOVED,
    WRONG_SIGN,
    WRONG_WAY,
    shift,
    turn,
)
from ..calculations.twists import described, jacobian_units, rows_on_sheet
from ..contract.question import Question, Wrong
from ..exercise import Rows
from ..part import Ready, Setting
from .frames import filled

Conversion = Callable[[Array, Array], Array]
"""J (6, n) of a pose T (4, 4) and a J (6, n) in base axes at the tool point, linear rows on top."""
DIFFERENT = 1e-3  # by which a mistake must change some entry to be one for this robot
TOOL_AXES = r"""The @size@ Jacobian in tool axes at the tool point, @rows@

- Which way does R lead, and which way do you go?
- The point does not change.

The point stays, the axes change: $\mathbf v_{tool} = \mathbf R^T \mathbf v$ and
$\boldsymbol\omega_{tool} = \mathbf R^T \boldsymbol\omega$, because $\mathbf R$ leads from tool axes
to base axes. Both blocks turn alike:
$$@turn@ \mathbf J = <@name@>$$
"""
BASE_ORIGIN = r"""The @size@ Jacobian in base axes at the base origin, @rows@

- How do the velocities of two points of one body differ?
- The angular rows are those of every point.

The axes stay, the point changes. The point of the body at the base origin lies $-\mathbf p$ from
the tool point, so its velocity is $\mathbf v + \boldsymbol\omega \times (-\mathbf p) =
\mathbf v + \mathbf p \times \boldsymbol\omega$; $\boldsymbol\omega$ is the same for every point:
$$@shift@ \mathbf J = <@name@>$$
"""
TURN = r"\begin{bmatrix}\mathbf R^T & \mathbf 0\\ \mathbf 0 & \mathbf R^T\end{bmatrix}"
SHIFT_LINEAR = r"\begin{bmatrix}\mathbf 1 & S(\mathbf p)\\ \mathbf 0 & \mathbf 1\end{bmatrix}"
SHIFT_ANGULAR = r"\begin{bmatrix}\mathbf 1 & \mathbf 0\\ S(\mathbf p) & \mathbf 1\end{bmatrix}"
SHIFT: dict[Rows, str] = {"linear, angular": SHIFT_LINEAR, "angular, linear": SHIFT_ANGULAR}


@dataclass(frozen=True)
class _Lead:
    """A way from base axes at the tool point to another frame, with known wrong ways."""

    text: str
    convert: Conversion
    wrong: Sequence[tuple[str, Conversion]]

    def question(self, setting: Setting, name: str, points: float, decimals: int) -> Question:
        rows = rows_on_sheet("all", setting.rows, ())
        robot = setting.robot
        text = filled(
            self.text,
            size=f"6 × {robot.n}",
            rows=described(rows, setting.rows),
            turn=TURN,
            shift=SHIFT[setting.rows],
            name=name,
        )
        mistakes: list[Wrong] = []
        for sentence, way in self.wrong:
            if self.changed_by(way, setting.arm):
                mistakes.append((sentence, _on_sheet(way, rows)))
        return Question(
            _on_sheet(self.convert, rows),
            name,
            points,
            Numbers((6, robot.n), jacobian_units(rows, robot.kinds), decimals),
            mistakes,
            docstring=text,
        )

    def ready(
        self, name: str, points: float, decimals: int, mistakes: Sequence[Wrong], **earlier: str
    ) -> Ready:
        """The question for any setting, from the results `earlier` on the sheet."""

        def question(setting: Setting) -> Question:
            made = self.question(setting, name, points, decimals)
            return made.called(name, **earlier).also(mistakes)

        return question

    def changed_by(self, way: Conversion, arm: Arm) -> bool:
        """Whether a wrong way leads such an arm elsewhere."""
        right = self.convert(arm.T, arm.J)
        return bool(np.abs(way(arm.T, arm.J) - right).max() > DIFFERENT)


def _on_sheet(convert: Conversion, rows: list[int]) -> Conversion:
    """The same with rows in the order of the sheet."""

    def converted(T: Array, J: Array) -> Array:
        return convert(T, J[np.argsort(rows)])[rows]

    return converted


_TO_TOOL_AXES = _Lead(
    TOOL_AXES,
    lambda T, J: turn(T).T @ J,
    (
        (STILL_BASE, lambda _, J: J),
        (WRONG_WAY, lambda T, J: turn(T) @ J),
        (LINEAR_ONLY, lambda T, J: np.concatenate([T[:3, :3].T @ J[:3], J[3:]])),
        (TOOL_MOVED, lambda T, J: turn(T).T @ shift(T) @ J),
        (MOVED, lambda T, J: turn(T).T @ shift(T, -1) @ J),
        (MOVED, lambda T, J: shift(T) @ turn(T).T @ J),
    ),
)
_TO_BASE_ORIGIN = _Lead(
    BASE_ORIGIN,
    lambda T, J: shift(T) @ J,
    (
        (WRONG_SIGN, lambda T, J: shift(T, -1) @ J),
        (STILL_AT_TOOL, lambda _, J: J),
        (NEITHER, lambda T, J: turn(T).T @ J),
        (STILL_IN_TOOL, lambda T, J: turn(T).T @ shift(T) @ J),
        (NOT_BASE, lambda T, J: shift(T) @ turn(T).T @ J),
    ),
)


def to_tool_axes(
    *,
    name: str = "J_tool",
    points: float = 2,
    decimals: int = 3,
    J: str = "J",
    T: str = "T",
    mistakes: Sequence[Wrong] = (),
) -> Ready:
    """The Jacobian (6, n) in tool axes.

    It follows from the Jacobian `J` in base axes and the pose `T` (4, 4) before it. `mistakes` are
    known wrong ways beside those that it has for any arm.
    """
    return _TO_TOOL_AXES.ready(name, points, decimals, mistakes, J=J, T=T)


def to_base_origin(
    *,
    name: str = "J_origin",
    points: float = 2,
    decimals: int = 3,
    J: str = "J",
    T: str = "T",
    mistakes: Sequence[Wrong] = (),
) -> Ready:
    """The Jacobian (6, n) at the base origin.

    It follows from `J` at the tool point and the pose `T` (4, 4) before it. `mistakes` are known
    wrong ways beside those that it has for any arm.
    """
    return _TO_BASE_ORIGIN.ready(name, points, decimals, mistakes, J=J, T=T)
