"""What follows in formulas from a table, a Jacobian or a determinant.

From the robot's own it is the closed form. From anything else, a student's own, it is put together
and not simplified, since it is compared and never printed.
"""

from collections.abc import Sequence
from functools import lru_cache
from importlib import import_module
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.errors import KinegradeError
from ...solutions.expression import Expression, parse
from ...solutions.expression_array import (
    POINTS,
    ExpressionArray,
    expression_array,
    same_formulas,
    sample,
)
from ...solutions.robot import Robot
from ...solutions.table import COLUMNS, Table

ENTRIES: tuple[str, ...] = ("x11", "x12", "x13", "x21", "x22", "x23", "x31", "x32", "x33")
DETERMINANT = parse(
    "x11*(x22*x33 - x23*x32) - x12*(x21*x33 - x23*x31) + x13*(x21*x32 - x22*x31)", ENTRIES
)

KEPT = 32  # of one student's formulas, which marking asks for again and again
JOINT_COLUMN = {"R": "theta", "P": "d"}


class EasierError(KinegradeError):
    """Nothing follows from own formulas that leave hardly anything to find out."""


@lru_cache
def closed_jacobian(robot: Robot) -> ExpressionArray:
    """The Jacobian (6, n) of a robot, as it is printed."""
    return expression_array(robot.symbolic().J, robot.names)


@lru_cache
def closed_determinant(robot: Robot) -> ExpressionArray:
    """The determinant of a robot's task block, as a product."""
    return expression_array(_determinant(robot).expression, robot.names)


@lru_cache
def closed_factors(robot: Robot) -> tuple[Expression, ...]:
    """The factors of that determinant, each of which is zero in singular postures."""
    factors = [factor for _, factor, _ in _determinant(robot).factors]
    return tuple(parse(str(factor), robot.names) for factor in factors)


def jacobian_of_table(table: Table, robot: Robot) -> ExpressionArray:
    """The Jacobian (6, n) that follows from a standard table.

    Raises:
        EasierError: the table is not the robot's own, and its Jacobian comes to far fewer different
            numbers.
    """
    closed = closed_jacobian(robot)
    if table.rows == robot.table.rows:
        return closed
    return _of_other_table(table.rows, table.kinds, robot)


@lru_cache(maxsize=KEPT)
def _of_other_table(
    rows: tuple[tuple[Expression, ...], ...], kinds: str, robot: Robot
) -> ExpressionArray:
    names, general = _any_table(kinds)
    cells = dict(zip(names, chain.from_iterable(rows), strict=True))
    entries = tuple(entry.put(cells) for entry in general.entries)
    return _not_easier(ExpressionArray(entries, general.shape), closed_jacobian(robot))


@lru_cache(maxsize=KEPT)
def determinant_of(J: ExpressionArray, robot: Robot) -> ExpressionArray:
    """The determinant of the linear block of a Jacobian (6, 3), where it is the robot's task block.

    Raises:
        EasierError: the Jacobian is not the robot's own, and its determinant comes to far fewer
            different numbers.
    """
    closed = closed_determinant(robot)
    if same_formulas(J, closed_jacobian(robot), robot.names).all():
        return closed
    entries = dict(zip(ENTRIES, J.entries[: len(ENTRIES)], strict=True))
    return _not_easier(ExpressionArray((DETERMINANT.put(entries),), ()), closed)


@lru_cache(maxsize=KEPT)
def factors_of(determinant: ExpressionArray, robot: Robot) -> tuple[Expression, ...]:
    """The factors of the robot's own determinant; any other one as it is."""
    if same_formulas(determinant, closed_determinant(robot), robot.names).all():
        return closed_factors(robot)
    return determinant.entries


def _determinant(robot: Robot) -> Any:
    from ...solutions.determinant import determinant

    return determinant(robot)


@lru_cache
def _any_table(kinds: str) -> tuple[tuple[str, ...], ExpressionArray]:
    """The names of all cells of a table of nothing but names, and its Jacobian (6, n).

    q_i stands in theta or d.
    """
    # made once: the Jacobian of any such table is this one with its cells put in
    rows: list[list[str]] = []
    for i, kind in enumerate(kinds, 1):
        cells = {column: f"{column}{i}" for column in COLUMNS}
        cells[JOINT_COLUMN[kind]] = f"q{i}"
        rows.append([*cells.values()])

    names = tuple(chain.from_iterable(rows))
    lengths = dict.fromkeys(names, 1.0)
    for i in range(1, len(kinds) + 1):
        del lengths[f"q{i}"]
    robot = Robot(
        "any", "Arm of any shape", lengths, rows, ((-1.0, 1.0),) * len(rows), "standard convention"
    )
    return names, closed_jacobian(robot)


def _not_easier(own: ExpressionArray, closed: ExpressionArray) -> ExpressionArray:
    """Own formulas that come to at least half as many different numbers as the closed ones."""
    values = sample([*(own.names | closed.names)], POINTS)
    found = _different_numbers(own.at(values))
    wanted = _different_numbers(closed.at(values))
    if 2 * found < wanted:
        raise EasierError(
            f"own formulas come to {found} different numbers, the robot's own to {wanted}"
        )
    return own


def _different_numbers(numbers: NDArray[np.float64]) -> int:
    """How many, but for signs, zeros and ones."""
    sizes = np.unique(np.round(np.abs(numbers), 6))
    return int(((sizes != 0) & (sizes != 1)).sum())


def jacobian_of_position(
    pose: ExpressionArray, printed: Sequence[str], names: Sequence[str], rows: int
) -> Any:
    """The derivatives (m, n) in sympy of a pose (m,) by the joints among `names`.

    Its first `rows` are a position.

    Raises:
        EasierError: the pose is the `printed` one of another arm, or no joint stands in a
            derivative of a coordinate.
    """
    if same_formulas(pose, expression_array(printed, names), names).all():
        raise EasierError(
            "nothing follows from the pose of another arm, whose Jacobian is printed in the source"
        )

    sympy: Any = import_module("sympy")
    q = sympy.symbols([name for name in names if name.startswith("q")], real=True)
    J = pose.sympy().jacobian(q)
    for entry in J[:rows, :]:
        if entry.free_symbols.isdisjoint(q):
            raise EasierError("coordinates take formulas whose derivatives depend on a joint")
    return J
