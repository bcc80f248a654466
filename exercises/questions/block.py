"""The square block of the task as a formula: its determinant, and where it is singular."""

import numpy as np

from ...solutions.expression import Expression
from ...solutions.expression_array import ExpressionArray
from ...solutions.robot import Robot
from ..answers import Conditions, Formulas
from ..arm import Arm
from ..calculations.own_formulas import closed_determinant, closed_factors
from ..calculations.twists import VELOCITIES, listed, rows_on_sheet
from ..contract.question import Question
from ..exercise import ExerciseError, Outcome
from ..part import Ready, Setting
from ..properties import named_multiple
from .frames import filled

DETERMINANT = r"""The determinant of the rows @rows@ of $\mathbf J$ in base axes at the tool point,
with its sign, as one formula in the names of your lengths and q1, q2 ...

- It does not depend on the first joint where that one only turns or shifts the whole arm: choose it
  as you like.
- Expand along a row or column with zeros.

Written as a product:
$$\det = <@name@>$$
"""
SINGULAR = r"""All postures in which the rows @rows@ of $\mathbf J$ are singular: a list of
conditions in the names of your lengths and q1, q2 ..., each as text such as `'cos(q1) = 0'` or
`'d1 + q3*q2 = 0'`; a posture is singular when one of them holds. Count postures with @limits@

- Where is the determinant zero? Take its factors one by one.
- An angle has more than one solution in a full turn.

The determinant is a product, which is zero where one of its factors is:
$$\det = <product>$$

The factors that can be zero:
$$<@name@>$$
"""
FORMULA = r"""The manipulability $w = \sqrt{\det(\mathbf J \mathbf J^T)}$ of the rows @rows@ of
$\mathbf J$ in base axes at the tool point, as one formula in the names of your lengths and q1, q2
..., with `abs(...)` or `sqrt(...)` where its sign could change

- The block is square: what is the determinant of a product of square matrices?

For a square block $\det(\mathbf J \mathbf J^T) = (\det \mathbf J)^2$, so $w$ is the size of the
determinant:
$$w = <@name@>$$
"""


def determinant(*, name: str = "det", points: float = 2) -> Ready:
    """The determinant of the robot's task rows as a formula; a multiple of it is named.

    Raises:
        ExerciseError: on a sheet, where a length of the arm is not among the drawn numbers.
    """

    def ready(setting: Setting) -> Question:
        robot = setting.robot
        _check_names(setting, "determinant")
        rows = rows_on_sheet("task", setting.rows, robot.task_rows)
        text = filled(DETERMINANT, rows=listed(VELOCITIES, rows), name=name)
        return Question(
            _determinant, name, points, Formulas((), robot.names), check=_named, docstring=text
        )

    return ready


def _check_names(setting: Setting, what: str) -> None:
    """Formulas are in names of the sheet: a length that is not drawn has none there."""
    robot = setting.robot
    on_sheet = {*robot.joints, *setting.arm.lengths}
    missing = closed_determinant(robot).names - on_sheet
    if missing:
        raise ExerciseError(
            f"{what} takes an arm whose lengths are drawn, since it asks for formulas in their "
            f"names; {', '.join(sorted(missing))} of {robot.name} should be among the drawn numbers"
        )


def _determinant(arm: Arm) -> ExpressionArray:
    return closed_determinant(arm.robot)


def manipulability_formula(*, name: str = "w", points: float = 2) -> Ready:
    """The manipulability of the robot's task rows as a formula: the size of their determinant.

    Raises:
        ExerciseError: on a sheet, where a length of the arm is not among the drawn numbers.
    """

    def ready(setting: Setting) -> Question:
        robot = setting.robot
        _check_names(setting, "manipulability_formula")
        rows = rows_on_sheet("task", setting.rows, robot.task_rows)
        text = filled(FORMULA, rows=listed(VELOCITIES, rows), name=name)
        return Question(_size, name, points, Formulas((), robot.names), docstring=text)

    return ready


def _size(arm: Arm) -> str:
    return f"abs({closed_determinant(arm.robot).text()})"


def _named(arm: Arm, value: ExpressionArray) -> Outcome | None:
    return named_multiple(value, closed_determinant(arm.robot), arm.robot.names)


def singular(*, name: str = "singular", points: float = 3) -> Ready:
    """All conditions under which the robot's task rows are singular, within its limits.

    Raises:
        ExerciseError: on a sheet, where a length of the arm is not among the drawn numbers.
    """

    def ready(setting: Setting) -> Question:
        robot = setting.robot
        _check_names(setting, "singular")
        rows = rows_on_sheet("task", setting.rows, robot.task_rows)
        limits = limits_of(robot)
        text = filled(
            SINGULAR, rows=listed(VELOCITIES, rows), limits=_said(limits, robot.kinds), name=name
        )
        answer = Conditions(robot.names, lambda _: limits)
        shows = {"product": lambda arm: closed_determinant(arm.robot)}
        return Question(_factors, name, points, answer, shows=shows, docstring=text)

    return ready


def _factors(arm: Arm) -> tuple[Expression, ...]:
    return closed_factors(arm.robot)


def limits_of(robot: Robot) -> dict[str, tuple[float, float]]:
    """The range of every joint within which conditions count [rad, m].

    A full turn, or a slide's longest stroke to both sides, since a stroke of zero may be what is
    asked.
    """
    ranges: dict[str, tuple[float, float]] = {}
    for joint, kind, (_, longest) in zip(robot.joints, robot.kinds, robot.limits, strict=True):
        most = np.pi
        if kind == "P":
            most = round(longest, 2)
        ranges[joint] = (-most, most)
    return ranges


def _said(limits: dict[str, tuple[float, float]], kinds: str) -> str:
    said = [r"every angle from $-\pi$ to $\pi$"]
    for (joint, (low, high)), kind in zip(limits.items(), kinds, strict=True):
        if kind == "P":
            said.append(
                f"${joint[0]}_{joint[1:]}$ from −{-low:g} m to {high:g} m, "
                "the slide running through to the other side"
            )
    return " and ".join(said)
