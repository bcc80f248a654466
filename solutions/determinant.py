# pyright: basic
"""The determinant of a robot's task block in sympy, multiplied out of the factors that name its singularities."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import TYPE_CHECKING, Any

import sympy as sp

from .closed_forms.block import task_columns
from .closed_forms.half_angles import HalfAngles
from .closed_forms.polynomial import ONE, ZERO, Polynomial, reduced
from .errors import KinegradeError
from .expression import parse

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .robot import Robot


class DeterminantError(KinegradeError):
    """A robot whose task block has no determinant."""


@dataclass(frozen=True, eq=False)
class Determinant:
    """Determinant of the task block: `constant`, with the sign, times each factor to its power.

    `factors` are (name, expression, power); what the robot does not name is named by its own formula. `constant`
    holds lengths and numbers only. Every symbol is Symbol(name, real=True).
    """

    expression: sp.Expr
    factors: tuple[tuple[str, sp.Expr, int], ...]
    constant: sp.Expr


@lru_cache(maxsize=32)
def determinant(robot: Robot) -> Determinant:
    """Determinant of the task block of a robot, factored; the robot's own factors are found, not believed.

    The factors are those of a polynomial in the tangents of the half angles, where factoring is unique. A spherical
    wrist splits the block: det J = det J11 det J22. Raises DeterminantError if the block is not square.
    """
    if len(robot.task_rows) != robot.n:
        raise DeterminantError(
            f"determinant takes a robot with a square task block, got {robot.name} with {len(robot.task_rows)} rows "
            f"and {robot.n} joints"
        )
    angles = [
        sp.Symbol(q, real=True)
        for q, kind in zip(robot.joints, robot.kinds, strict=True)
        if kind == "R"
    ]
    half = HalfAngles(angles)
    content, left = sp.S.One, Counter[Any]()
    for block in task_columns(robot):
        number, found = half.factored(expanded(block))
        content, left = content * number, left + found
    factors: list[tuple[str, sp.Expr, int]] = []
    for named in robot.factors:
        expression = parse(named.expression, robot.names).sympy()
        number, parts = half.factored(half.polynomial(expression))
        if parts and (power := min(left[part] // count for part, count in parts.items())):
            left -= Counter({part: power * count for part, count in parts.items()})
            content /= number**power
            factors.append((named.name, expression, power))
    joints = {sp.Symbol(q, real=True) for q in robot.joints}
    for number, expression, power in half.trigonometric(left):
        content *= number**power
        if expression.free_symbols & joints:
            factors.append((str(expression), expression, power))
        else:
            content *= expression**power
    constant = sp.factor_terms(content)
    whole = sp.Mul(constant, *(expression**power for _, expression, power in factors))
    return Determinant(whole, tuple(factors), constant)


def expanded(block: Sequence[Sequence[Polynomial]]) -> Polynomial:
    """Determinant of a square block (rows of polynomials), row by row over sets of columns."""
    minors: dict[int, Polynomial] = {0: ONE}
    for row in block:
        longer: dict[int, Polynomial] = {}
        for (taken, minor), (column, entry) in product(minors.items(), enumerate(row)):
            if taken >> column & 1 or not entry.terms:
                continue
            odd = (
                taken >> column
            ).bit_count() % 2  # columns to the right that an earlier row has taken
            term = reduced(entry * minor)
            key = taken | 1 << column
            longer[key] = longer.get(key, ZERO) + (-term if odd else term)
        minors = longer
    return minors.get((1 << len(block)) - 1, ZERO)
