# pyright: basic
"""The determinant of a robot's task block in sympy, multiplied out of the factors it is zero with.

The zeros of each factor are singularities of their own, and named as the robot names them.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import sympy as sp

from .closed_forms.block import task_columns
from .closed_forms.half_angles import HalfAngles
from .closed_forms.polynomial import ONE, ZERO, Polynomial, reduced
from .errors import KinegradeError
from .expression import parse

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .closed_forms.half_angles import Powers
    from .robot import Robot

NamedFactor = tuple[str, sp.Expr, int]  # name, expression, power


class DeterminantError(KinegradeError):
    """A robot whose task block has no determinant."""


@dataclass(frozen=True, eq=False)
class Determinant:
    """Determinant of the task block: `constant`, with the sign, times each factor to its power.

    `factors` are (name, expression, power); what the robot does not name is named by its own
    formula. `constant` holds lengths and numbers only. Every symbol is Symbol(name, real=True).
    """

    expression: sp.Expr
    factors: tuple[NamedFactor, ...]
    constant: sp.Expr


@lru_cache(maxsize=32)
def determinant(robot: Robot) -> Determinant:
    """Determinant of the task block of a robot, factored.

    The factors are those of a polynomial in the tangents of the half angles, where factoring is
    unique; the robot's own factors are found among them, not believed. A spherical wrist splits
    the block: det J = det J11 det J22.

    Raises:
        DeterminantError: The task block is not square.
    """
    if len(robot.task_rows) != robot.n:
        raise DeterminantError(
            "determinant takes a robot with a square task block, "
            f"got {robot.name} with {len(robot.task_rows)} rows and {robot.n} joints"
        )
    half = HalfAngles(_angles(robot))
    content = sp.S.One
    left: Powers = Counter()
    for block in task_columns(robot):
        number, powers = half.factored(expanded(block))
        content *= number
        left += powers

    number, named, left = _named_factors(robot, half, left)
    content *= number
    number, others = _other_factors(robot, half, left)
    content *= number

    factors = (*named, *others)
    constant = sp.factor_terms(content)
    powers = [expression**power for _, expression, power in factors]
    return Determinant(sp.Mul(constant, *powers), factors, constant)


def expanded(block: Sequence[Sequence[Polynomial]]) -> Polynomial:
    """Determinant of a square block, given by its rows.

    Laplace's expansion row by row: after k rows there is one minor for each set of k columns, and
    each is made once. A set of columns is a number with a bit for every column.
    """
    minors: dict[int, Polynomial] = {0: ONE}
    for row in block:
        minors = _longer_minors(minors, row)
    every_column = (1 << len(block)) - 1
    return minors.get(every_column, ZERO)


def _longer_minors(
    minors: dict[int, Polynomial], row: Sequence[Polynomial]
) -> dict[int, Polynomial]:
    """The minors of the rows so far and one more; those that vanish term by term are left out."""
    longer: dict[int, Polynomial] = {}
    for taken, minor in minors.items():
        for column, entry in enumerate(row):
            if taken >> column & 1 or not entry.terms:
                continue
            term = reduced(entry * minor)
            # The sign turns with every earlier row that has taken a column further right.
            if (taken >> column).bit_count() % 2:
                term = -term
            columns = taken | 1 << column
            longer[columns] = longer.get(columns, ZERO) + term
    return longer


def _angles(robot: Robot) -> list[sp.Symbol]:
    angles: list[sp.Symbol] = []
    for name, kind in zip(robot.joints, robot.kinds, strict=True):
        if kind == "R":
            angles.append(sp.Symbol(name, real=True))
    return angles


def _named_factors(
    robot: Robot, half: HalfAngles, powers: Powers
) -> tuple[sp.Expr, list[NamedFactor], Powers]:
    """A number, the factors that the robot names, and the powers that are left over.

    A named factor divides as often as all its irreducible parts do; one that does not is left out.
    """
    content = sp.S.One
    found: list[NamedFactor] = []
    for factor in robot.factors:
        expression = parse(factor.expression, robot.names).sympy()
        number, parts = half.factored(half.polynomial(expression))
        power = min((powers[part] // count for part, count in parts.items()), default=0)
        if power:
            powers = powers - Counter({part: power * count for part, count in parts.items()})
            content /= number**power
            found.append((factor.name, expression, power))
    return content, found, powers


def _other_factors(
    robot: Robot, half: HalfAngles, powers: Powers
) -> tuple[sp.Expr, list[NamedFactor]]:
    """What no joint moves in a product of factors; the other factors, named by their formulas."""
    joints = {sp.Symbol(q, real=True) for q in robot.joints}
    content = sp.S.One
    found: list[NamedFactor] = []
    for number, expression, power in half.trigonometric(powers):
        content *= number**power
        if expression.free_symbols & joints:
            found.append((str(expression), expression, power))
        else:
            content *= expression**power
    return content, found
