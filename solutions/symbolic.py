# pyright: basic
"""Closed forms in sympy, for printing only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import sympy as sp

from .closed_forms.polynomial import ONE, ZERO, Polynomial, polynomial, total

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from .expression import Expression
    from .robot import Robot

Rows = tuple[tuple[Polynomial, ...], ...]
IDENTITY: Rows = tuple(tuple(ONE if i == j else ZERO for j in range(3)) for i in range(3))


@dataclass(frozen=True, eq=False)
class ClosedForm:
    """Frames (4 x 4), tool transform T and Jacobian J (6 x n) of a robot, with angles of parallel axes merged.

    `frames` are those of Robot.frames. Every symbol is Symbol(name, real=True).
    """

    frames: tuple[sp.Matrix, ...]
    T: sp.Matrix
    J: sp.Matrix
    parameters: tuple[sp.Symbol, ...]
    joints: tuple[sp.Symbol, ...]


class Turning:
    """A frame whose rotation is base Rz(angle): the angles of parallel axes add before a cosine is taken."""

    def __init__(self, joints: Collection[sp.Symbol]) -> None:
        self.joints = set(joints)
        self.base, self.angle = IDENTITY, sp.S.Zero
        self.p: tuple[Polynomial, ...] = (ZERO, ZERO, ZERO)

    @property
    def rotation(self) -> Rows:
        """Rows of the rotation."""
        return times(self.base, rotation("z", self.angle)) if self.angle else self.base

    def follow(self, steps: Sequence[tuple[str, Expression]]) -> None:
        """Go on by elementary motions."""
        for motion, amount in steps:
            self.move(motion, amount.sympy())

    def move(self, motion: str, amount: sp.Expr) -> None:
        """Go on by one motion."""
        if amount == 0:
            return
        axis = "xyz".index(motion[1])
        if motion[0] == "T":
            length = polynomial(amount)
            self.p = tuple(
                x + row[axis] * length for x, row in zip(self.p, self.rotation, strict=True)
            )
        elif motion[1] == "z":
            turning = sum(
                (term for term in sp.Add.make_args(amount) if term.free_symbols & self.joints),
                sp.S.Zero,
            )
            if amount != turning:
                self.base = times(self.base, rotation("z", amount - turning))
            self.angle += turning
        else:
            turn = rotation(motion[1], amount)
            # half a turn about x or y only reverses the axis: Rz(s) F = F Rz(-s)
            reverses = turn[2][2].terms == {(): -1}
            self.base = times(self.base if reverses else self.rotation, turn)
            self.angle = -self.angle if reverses else sp.S.Zero


def closed_form(robot: Robot) -> ClosedForm:
    """Closed form of a robot in its named parameters.

    The linear rows are derivatives of p (S1, section 5.10), which holds each cosine and sine to the first power;
    the angular rows are the joint axes.
    """
    parameters = tuple(sp.Symbol(name, real=True) for name in robot.parameters)
    joints = tuple(sp.Symbol(name, real=True) for name in robot.joints)
    state = Turning(joints)
    state.follow(robot.base_steps)
    reached = [(state.rotation, state.p)]
    for steps in robot.steps:
        state.follow(steps)
        reached.append((state.rotation, state.p))
    state.follow(robot.tool_steps)
    axes = reached[:-1] if robot.convention == "standard" else reached[1:]
    frames = tuple(_frame(R, p) for R, p in (*axes, (state.rotation, state.p)))
    columns = [
        [x.diff(q) for x in state.p] + [row[2] if kind == "R" else ZERO for row in R]
        for q, kind, (R, _) in zip(joints, robot.kinds, axes, strict=True)
    ]
    J = sp.Matrix([[entry.expression() for entry in row] for row in zip(*columns, strict=True)])
    return ClosedForm(frames, frames[-1], J, parameters, joints)


def rotation(axis: str, angle: sp.Expr) -> Rows:
    """Rows of the rotation about x, y or z."""
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    rows = [list(row) for row in IDENTITY]
    rows[j][j] = rows[k][k] = polynomial(sp.cos(angle))
    rows[k][j] = polynomial(sp.sin(angle))
    rows[j][k] = -rows[k][j]
    return tuple(map(tuple, rows))


def shorthand(expression: Any) -> Any:
    """The expression, or matrix, with c_1 for cos(q1) and s_23 for sin(q2 + q3)."""
    replaced = {}
    for function in expression.atoms(sp.cos, sp.sin):
        indices = [_joint_index(term) for term in sp.Add.make_args(function.args[0])]
        if all(indices):
            letter = "c" if isinstance(function, sp.cos) else "s"
            replaced[function] = sp.Symbol(
                f"{letter}_{''.join(sorted(indices, key=int))}", real=True
            )
    return expression.xreplace(replaced)


def times(left: Rows, right: Rows) -> Rows:
    """Product of two rotations."""
    columns = tuple(zip(*right, strict=True))
    return tuple(
        tuple(
            total(a * b for a, b in zip(row, column, strict=True) if a.terms and b.terms)
            for column in columns
        )
        for row in left
    )


def _frame(R: Rows, p: Sequence[Polynomial]) -> sp.Matrix:
    rows = [
        [*(entry.expression() for entry in row), x.expression()]
        for row, x in zip(R, p, strict=True)
    ]
    return sp.Matrix([*rows, [0, 0, 0, 1]])


def _joint_index(term: sp.Expr) -> str:
    name = term.name if isinstance(term, sp.Symbol) else ""
    return name[1:] if name[:1] == "q" and name[1:].isdigit() else ""
