# pyright: basic
"""The task block of a robot, in the axes and for the point that make it shortest.

Places are numbered along the arm: 0 is the base, 1 to n are the joints, n + 1 is the tool.
"""

from __future__ import annotations

from contextlib import suppress
from itertools import product
from typing import TYPE_CHECKING

import sympy as sp

from ..symbolic import IDENTITY, Rows, rotation, times
from .length import TooLong
from .polynomial import ZERO, Polynomial, polynomial

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..expression import Expression
    from ..robot import Robot

Vector = tuple[Polynomial, ...]
Block = list[list[Polynomial]]
Motion = tuple[str, sp.Expr]  # such as ("Rx", angle) or ("Tz", length)
Line = tuple[Vector, Vector]  # the direction z and the origin of an axis

LINEAR = (0, 1, 2)
ANGULAR = (3, 4, 5)
SPACE = (*LINEAR, *ANGULAR)
LONGEST = 2000  # letters and numbers of the axis and the origin of a joint, written out
WORTH = 3  # times the shortest axes: those seen from further away make no short block
ORIGIN = (ZERO, ZERO, ZERO)


def task_columns(robot: Robot) -> list[Block]:
    """Square blocks whose determinants multiply to that of the task rows of J.

    There is one block, or two where a spherical wrist splits J. A determinant of three linear or
    three angular rows is the same in all axes, one of all six rows also for all points that move
    with the tool. Any other is taken in base axes for the tool point.

    Joints with `offsets` stand for the sums of both.

    Raises:
        TooLong: The axes are too oblique to be written down from anywhere.
    """
    jacobians = _jacobians(robot)
    if robot.n == 6 and robot.task_rows == SPACE:
        split = [J for J in jacobians if _is_split(J)]
        if split:
            return [_shortest(split, LINEAR, LINEAR), _shortest(split, ANGULAR, ANGULAR)]
    return [_shortest(jacobians, robot.task_rows, range(robot.n))]


def blocks_without_a_joint(robot: Robot) -> list[Block]:
    """Square blocks of a robot with one joint more than task rows: without joint 1, 2, and so on.

    Raises:
        TooLong: As of `task_columns`.
    """
    jacobians = _jacobians(robot)
    joints = range(robot.n)
    found: list[Block] = []
    for left_out in joints:
        columns = [joint for joint in joints if joint != left_out]
        found.append(_shortest(jacobians, robot.task_rows, columns))
    return found


def _jacobians(robot: Robot) -> list[Block]:
    """Jacobians (6, n) whose task rows all have the same determinant."""
    everywhere = range(robot.n + 2)
    axes: Sequence[int] = (0,)
    points: Sequence[int] = (robot.n + 1,)
    if robot.task_rows in (LINEAR, ANGULAR, SPACE):
        axes = everywhere
    if robot.task_rows == SPACE:
        points = everywhere

    motions = _motions(robot)
    seen = _seen(motions, axes)
    lengths = [_length_of_lines(lines) for lines in seen]
    found: list[Block] = []
    for lines, length in zip(seen, lengths, strict=True):
        if length <= WORTH * min(lengths):
            found += [_jacobian(robot.kinds, lines, point) for point in points]
    return found


def _seen(motions: Sequence[Sequence[Motion]], axes: Iterable[int]) -> list[list[Line]]:
    """All lines in the frame at each place, where they are not too long."""
    found: list[list[Line]] = []
    for place in axes:
        with suppress(TooLong):
            found.append(_seen_from(motions, place))
    if not found:
        raise TooLong
    return found


def _length_of_lines(lines: Sequence[Line]) -> int:
    """How long the axes of the joints are, written out."""
    return _length([[*z, *o] for z, o in lines[1:-1]])


def _is_split(J: Block) -> bool:
    """Whether the wrist, the last three joints, leaves the point of J where it is.

    J is then block triangular, and its determinant that of the arm times that of the wrist.
    """
    return not any(J[row][column].terms for row, column in product(LINEAR, ANGULAR))


def _shortest(jacobians: Iterable[Block], rows: Sequence[int], columns: Sequence[int]) -> Block:
    """The shortest of the blocks that these rows and columns are in Jacobians."""
    blocks = [_part(J, rows, columns) for J in jacobians]
    return min(blocks, key=_length)


def _part(J: Block, rows: Iterable[int], columns: Iterable[int]) -> Block:
    part: Block = []
    for row in rows:
        entries = [J[row][column] for column in columns]
        part.append(entries)
    return part


def _length(block: Sequence[Sequence[Polynomial]]) -> int:
    """How long a block is, written out: the letters and the numbers of all its entries."""
    length = 0
    for row in block:
        for entry in row:
            for monomial in entry.terms:
                length += len(monomial) + 1
    return length


def _motions(robot: Robot) -> list[list[Motion]]:
    """Motions from each place to the next.

    They are cut so that each joint's own motion begins a list: the z of the frame before it is the
    axis of the joint.
    """
    between = [_in_sympy(robot.base_steps)]
    without = offsets(robot)
    for name, steps in zip(robot.joints, robot.steps, strict=True):
        motions = _in_sympy(steps)
        joint = sp.Symbol(name, real=True)
        at = _first_with(joint, motions)
        if joint in without:
            motions[at] = ("Rz", joint)
        between[-1] += motions[:at]
        between.append(motions[at:])
    between[-1] += _in_sympy(robot.tool_steps)
    return between


def offsets(robot: Robot) -> dict[sp.Symbol, sp.Expr]:
    """Oblique angles that are added to turning joints, such as theta2 to q2.

    The determinant is written down without them and holds for the sums: q2 then stands for both.
    """
    found: dict[sp.Symbol, sp.Expr] = {}
    for name, steps in zip(robot.joints, robot.steps, strict=True):
        joint = sp.Symbol(name, real=True)
        for motion, amount in _in_sympy(steps):
            if motion == "Rz" and joint in amount.free_symbols:
                offset = amount - joint
                if not (2 * offset / sp.pi).is_integer:
                    found[joint] = offset
    return found


def _in_sympy(steps: Iterable[tuple[str, Expression]]) -> list[Motion]:
    return [(motion, amount.sympy()) for motion, amount in steps]


def _first_with(joint: sp.Symbol, motions: Iterable[Motion]) -> int:
    """The index of the first motion whose amount holds a joint."""
    return next(i for i, (_, amount) in enumerate(motions) if joint in amount.free_symbols)


def _seen_from(motions: Sequence[Sequence[Motion]], place: int) -> list[Line]:
    """The lines of all places, the base first and the tool last, in the frame at one of them."""
    back = [_undone(row) for row in reversed(motions[:place])]
    behind = _walk(back)
    ahead = _walk(motions[place:])
    return [*reversed(behind), *ahead[1:]]  # both begin at the place itself


def _undone(motions: Sequence[Motion]) -> list[Motion]:
    return [(motion, -amount) for motion, amount in reversed(motions)]


def _walk(rows: Iterable[Sequence[Motion]]) -> list[Line]:
    """The lines where a walk starts and where it is after each row, in the frame of the start."""
    R: Rows = IDENTITY
    p: Vector = ORIGIN
    reached: list[Line] = [(_column(R, 2), p)]
    for row in rows:
        for motion, amount in row:
            if motion[0] == "T":
                p = _moved(p, _column(R, "xyz".index(motion[1])), polynomial(amount))
            else:
                R = _turned(R, motion[1], amount)
        line = (_column(R, 2), p)
        if _length(line) > LONGEST:
            raise TooLong
        reached.append(line)
    return reached


def _column(R: Rows, i: int) -> Vector:
    return tuple(row[i] for row in R)


def _moved(p: Vector, direction: Vector, length: Polynomial) -> Vector:
    return tuple(x + way * length for x, way in zip(p, direction, strict=True))


def _turned(R: Rows, axis: str, amount: sp.Expr) -> Rows:
    # One angle after the other: half angles take cosines and sines of single angles, not of sums.
    for angle in sp.Add.make_args(amount):
        if angle:
            R = times(R, rotation(axis, angle))
    return R


def _jacobian(kinds: Sequence[str], lines: Sequence[Line], point: int) -> Block:
    """The Jacobian (6, n) for the origin of one place: z x (p - o) above z for a revolute joint."""
    _, p = lines[point]
    columns: list[Vector] = []
    for kind, (z, o) in zip(kinds, lines[1:-1], strict=True):
        if kind == "R":
            r = tuple(a - b for a, b in zip(p, o, strict=True))
            columns.append((*_cross(z, r), *z))
        else:
            columns.append((*z, *ORIGIN))
    return [list(row) for row in zip(*columns, strict=True)]


def _cross(a: Vector, b: Vector) -> Vector:
    (a1, a2, a3), (b1, b2, b3) = a, b
    return (a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1)
