# pyright: basic
"""The determinant of a robot's task block in sympy, multiplied out of the factors it is zero with.

The zeros of each factor are singularities of their own, and named as the robot names them.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import sympy as sp

from .closed_forms.block import offsets, task_columns
from .closed_forms.half_angles import HalfAngles
from .closed_forms.length import TooLong
from .closed_forms.polynomial import ONE, ZERO, Polynomial, reduced, total
from .closed_forms.readable import with_whole_squares
from .errors import KinegradeError
from .expression import parse
from .robot import Factor

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from .closed_forms.half_angles import Powers
    from .robot import Robot

PRODUCTS = 60_000  # of two terms, that an expansion may take: a second
UNFACTORED = "not factored further"  # the name of what is too long to be taken apart

NamedFactor = tuple[str, sp.Expr, int]  # name, expression, power


class DeterminantError(KinegradeError):
    """A robot whose task block has no determinant, or one that is too long to write down."""


@dataclass(frozen=True, eq=False)
class Determinant:
    """Determinant of the task block: `constant`, with the sign, times each factor to its power.

    `factors` are (name, expression, power); what the robot does not name is named by its own
    formula, and what is too long to be factored by `UNFACTORED`. `constant` holds lengths and
    numbers only. Every symbol is Symbol(name, real=True).
    """

    expression: sp.Expr
    factors: tuple[NamedFactor, ...]
    constant: sp.Expr


@lru_cache(maxsize=32)
def determinant(robot: Robot) -> Determinant:
    """Determinant of the task block of a robot, factored.

    The factors are those of a polynomial in the tangents of the half angles, where factoring is
    unique; the robot's own factors are found among them, not believed. A spherical wrist splits
    the block: det J = det J11 det J22. What stays too long to be factored, as of six oblique axes
    with all their offsets, is one factor of the name `UNFACTORED`. How long is counted in terms, so
    that the answer is the same on every machine.

    Raises:
        DeterminantError: The task block is not square, or its determinant would fill pages.
    """
    if len(robot.task_rows) != robot.n:
        raise DeterminantError(
            "determinant takes a robot with a square task block, "
            f"got {robot.name} with {len(robot.task_rows)} rows and {robot.n} joints"
        )
    return factored(robot, _expanded_blocks(robot))


def factored(robot: Robot, products: Iterable[Polynomial]) -> Determinant:
    """The product of polynomials in cosines and sines of a robot's joints, factored."""
    half = HalfAngles(_angles(robot))
    content = sp.S.One
    left: Powers = Counter()
    long: list[NamedFactor] = []
    for product in products:
        try:
            number, powers = half.factored(product)
        except TooLong:
            long += _in_front(product)
            continue
        content *= number
        left += powers

    number, named, left = _named_factors(robot, half, left)
    content *= number
    number, others = _moving(robot, (*_other_factors(half, left), *long))
    content *= number

    factors = (*named, *others)
    constant = sp.factor_terms(content)
    powers = [expression**power for _, expression, power in factors]
    return Determinant(sp.Mul(constant, *powers), factors, constant)


def with_factors(robot: Robot) -> Robot:
    """The robot with the factors of its determinant, as maps and sections draw them.

    For robots of tables and chains, which come without. Raises DeterminantError.
    """
    found = determinant(robot)
    factors = [Factor(name, str(form), power) for name, form, power in found.factors]
    return replace(robot, factors=tuple(factors), constant=str(found.constant))


def expanded(block: Sequence[Sequence[Polynomial]]) -> Polynomial:
    """Determinant of a square block, given by its rows.

    Laplace's expansion row by row: after k rows there is one minor for each set of k columns, and
    each is made once. A set of columns is a number with a bit for every column.

    Raises:
        TooLong: It takes more than `PRODUCTS` products of terms.
    """
    minors: dict[int, Polynomial] = {0: ONE}
    products = 0
    for row in block:
        terms: dict[int, list[Polynomial]] = {}
        for columns, entry, minor in _next_columns(minors, row):
            products += len(entry.terms) * len(minor.terms)
            if products > PRODUCTS:
                raise TooLong
            terms.setdefault(columns, []).append(reduced(entry * minor))
        minors = {columns: total(summed) for columns, summed in terms.items()}
    every_column = (1 << len(block)) - 1
    return minors.get(every_column, ZERO)


def _next_columns(
    minors: dict[int, Polynomial], row: Sequence[Polynomial]
) -> Iterator[tuple[int, Polynomial, Polynomial]]:
    """Sets of one more column, with an entry of the row and the minor that it multiplies.

    The entry has its sign; what vanishes term by term is left out.
    """
    for taken, minor in minors.items():
        for column, entry in enumerate(row):
            if taken >> column & 1 or not entry.terms or not minor.terms:
                continue
            # The sign turns with every earlier row that has taken a column further right.
            turned = (taken >> column).bit_count() % 2
            yield taken | 1 << column, -entry if turned else entry, minor


def _expanded_blocks(robot: Robot) -> list[Polynomial]:
    try:
        return [expanded(block).gathered() for block in task_columns(robot)]
    except TooLong:
        raise DeterminantError(
            f"determinant takes a robot whose determinant can be written down, got {robot.name}, "
            "whose oblique axes and offsets would fill pages; "
            "its values at joint angles are numpy.linalg.det(jacobian(...))"
        ) from None


def _in_front(product: Polynomial) -> Iterator[NamedFactor]:
    """A long product as it is: the letters that all terms share, and the rest in one."""
    for part in sp.Mul.make_args(product.expression()):
        if part.is_Add:
            yield UNFACTORED, part, 1
        else:
            base, power = part.as_base_exp()
            whole = bool(power.is_Integer)
            yield ("", base, int(power)) if whole else ("", part, 1)


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
    without = {joint: joint - offset for joint, offset in offsets(robot).items()}
    for factor in robot.factors:
        expression = parse(factor.expression, robot.names).sympy()
        number, parts = half.factored(half.polynomial(expression.xreplace(without)))
        power = min((powers[part] // count for part, count in parts.items()), default=0)
        if power:
            powers = powers - Counter({part: power * count for part, count in parts.items()})
            content /= number**power
            found.append((factor.name, expression, power))
    return content, found, powers


def _other_factors(half: HalfAngles, powers: Powers) -> Iterator[NamedFactor]:
    """The factors that no robot names, and numbers to their powers."""
    for number, expression, power in half.trigonometric(powers):
        yield "", number, power
        yield "", expression, power


def _moving(robot: Robot, factors: Iterable[NamedFactor]) -> tuple[sp.Expr, list[NamedFactor]]:
    """What no joint moves in a product of factors; the other factors, with the joints' offsets.

    One without a name is named by its formula.
    """
    joints = {sp.Symbol(q, real=True) for q in robot.joints}
    back = {joint: joint + offset for joint, offset in offsets(robot).items()}
    content = sp.S.One
    found: list[NamedFactor] = []
    for name, expression, power in factors:
        if expression.free_symbols & joints:
            whole = with_whole_squares(expression.xreplace(back))
            found.append((name or str(whole), whole, power))
        else:
            content *= expression**power
    return content, found
