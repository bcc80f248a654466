# pyright: basic
"""The task block of a robot where its entries are shortest: in the axes, and for the point, that suit it."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import sympy as sp

from ..symbolic import IDENTITY, Rows, rotation, times
from .polynomial import ZERO, Polynomial, polynomial

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..robot import Robot

Vector = tuple[Polynomial, ...]
Block = list[list[Polynomial]]
Motion = tuple[str, sp.Expr]
SPACE = (0, 1, 2, 3, 4, 5)


def task_columns(robot: Robot) -> list[Block]:
    """Square blocks whose determinants multiply to that of the task rows of J; one block, or two with a wrist.

    A determinant of three linear rows is the same in all axes, one of all six rows also for all points that move
    with the tool. Any other is taken in base axes for the tool point.
    """
    n = robot.n
    turned = robot.task_rows in (SPACE[:3], SPACE[3:], SPACE)
    seen = [_seen_from(robot, place) for place in (range(n + 2) if turned else (0,))]
    points = range(n + 2) if robot.task_rows == SPACE else (n + 1,)
    blocks = [_jacobian(robot, axes, point) for axes, point in product(seen, points)]
    if n == 6 and robot.task_rows == SPACE:
        split = [J for J in blocks if not any(entry.terms for row in J[:3] for entry in row[3:])]
        if split:
            arm, wrist = (
                ([row[:3] for row in J[:3]] for J in split),
                ([row[3:] for row in J[3:]] for J in split),
            )
            return [min(arm, key=_length), min(wrist, key=_length)]
    return [min(([J[row] for row in robot.task_rows] for J in blocks), key=_length)]


def _seen_from(robot: Robot, place: int) -> list[tuple[Vector, Vector]]:
    """Axis z and origin of the base, of every joint and of the tool in coordinates of one of them."""
    motions = _motions(robot)
    ahead = _walk(motions[place:], backwards=False)
    behind = _walk(motions[:place][::-1], backwards=True)
    return [*behind[::-1], *ahead[1:]] if place else ahead


def _motions(robot: Robot) -> list[list[Motion]]:
    """Motions from the base to the frame whose z is the axis of joint 1, on to that of joint 2, ... and to the tool."""
    rows = [[(motion, amount.sympy()) for motion, amount in steps] for steps in robot.steps]
    base, tool = (
        [(m, a.sympy()) for m, a in steps] for steps in (robot.base_steps, robot.tool_steps)
    )
    joined: list[list[Motion]] = [base]
    for name, row in zip(robot.joints, rows, strict=True):
        at = next(
            i
            for i, (_, amount) in enumerate(row)
            if sp.Symbol(name, real=True) in amount.free_symbols
        )
        joined[-1] += row[:at]
        joined.append(row[at:])
    joined[-1] += tool
    return joined


def _walk(rows: Iterable[Sequence[Motion]], *, backwards: bool) -> list[tuple[Vector, Vector]]:
    R: Rows = IDENTITY
    p: Vector = (ZERO, ZERO, ZERO)
    reached: list[tuple[Vector, Vector]] = [(tuple(row[2] for row in R), p)]
    for row in rows:
        for motion, amount in [(m, -a) for m, a in reversed(row)] if backwards else row:
            axis = "xyz".index(motion[1])
            if motion[0] == "T":
                length = polynomial(amount)
                p = tuple(x + line[axis] * length for x, line in zip(p, R, strict=True))
            else:
                for angle in sp.Add.make_args(amount):
                    R = times(R, rotation(motion[1], angle)) if angle else R
        reached.append((tuple(line[2] for line in R), p))
    return reached


def _jacobian(robot: Robot, seen: Sequence[tuple[Vector, Vector]], point: int) -> Block:
    p = seen[point][1]
    columns: list[Vector] = []
    for kind, (z, o) in zip(robot.kinds, seen[1:-1], strict=True):
        r = tuple(a - b for a, b in zip(p, o, strict=True))
        moved = tuple(z[i - 2] * r[i - 1] - z[i - 1] * r[i - 2] for i in range(3))
        columns.append((*moved, *z) if kind == "R" else (*z, ZERO, ZERO, ZERO))
    return [list(row) for row in zip(*columns, strict=True)]


def _length(block: Block) -> int:
    return sum(len(monomial) + 1 for row in block for entry in row for monomial in entry.terms)
