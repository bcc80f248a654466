# pyright: basic
"""Closed forms in sympy, for printing only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import sympy as sp

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .expression import Expression
    from .robots import Robot


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


class _Turning:
    """A frame whose rotation is base Rz(angle): the angles of parallel axes add before a cosine is taken."""

    def __init__(self) -> None:
        self.base, self.angle, self.p = sp.eye(3), sp.S.Zero, sp.zeros(3, 1)

    @property
    def rotation(self) -> sp.Matrix:
        return (self.base * _rotation("z", self.angle)).applyfunc(sp.expand)

    @property
    def frame(self) -> sp.Matrix:
        return self.rotation.row_join(self.p).col_join(sp.Matrix([[0, 0, 0, 1]]))

    def move(self, motion: str, amount: sp.Expr, joints: Iterable[sp.Symbol]) -> None:
        axis = "xyz".index(motion[1])
        if motion[0] == "T":
            self.p = (self.p + self.rotation[:, axis] * amount).applyfunc(sp.expand)
        elif motion[1] == "z":
            turning = sum((term for term in sp.Add.make_args(amount) if term.has(*joints)), sp.S.Zero)
            self.base = self.base * _rotation("z", amount - turning)
            self.angle += turning
        else:
            turn = _rotation(motion[1], amount)
            # half a turn about x or y only reverses the axis: Rz(s) F = F Rz(-s)
            reverses, stays = turn[2, 2] == -1, turn[2, 2] == 1
            self.base = (self.base if reverses or stays else self.rotation) * turn
            self.angle = self.angle if stays else -self.angle if reverses else sp.S.Zero
        self.base = self.base.applyfunc(sp.expand)


def closed_form(robot: Robot) -> ClosedForm:
    """Closed form of a robot in its named parameters.

    The linear rows are derivatives of p (S1, section 5.10), which holds each cosine and sine to the first power;
    the angular rows are the joint axes.
    """
    parameters = tuple(sp.Symbol(name, real=True) for name in robot.parameters)
    joints = tuple(sp.Symbol(name, real=True) for name in robot.joints)
    state = _Turning()
    reached = [state.frame]
    for steps in robot.steps:
        _follow(state, steps, joints)
        reached.append(state.frame)
    _follow(state, robot.tool_steps, joints)
    frames = (*(reached[:-1] if robot.convention == "standard" else reached[1:]), state.frame)
    p: Any = frames[-1][:3, 3]
    columns = [
        p.diff(q).col_join(frame[:3, 2] if kind == "R" else sp.zeros(3, 1))
        for q, kind, frame in zip(joints, robot.kinds, frames[:-1], strict=True)
    ]
    printed = tuple(frame.applyfunc(shortest) for frame in frames)
    return ClosedForm(printed, printed[-1], sp.Matrix.hstack(*columns).applyfunc(shortest), parameters, joints)


def shortest(expression: sp.Expr) -> sp.Expr:
    """The shortest of the multiplied-out form, the factored one, and those with one cosine or sine in front."""
    expanded = sp.expand(expression)
    fronts = sorted(expanded.atoms(sp.cos, sp.sin), key=sp.default_sort_key)
    forms = (expanded, sp.factor(expanded), *(sp.collect(expanded, front) for front in fronts))
    return min(forms, key=lambda form: sp.count_ops(shorthand(form)))


def shorthand(expression: Any) -> Any:
    """The expression, or matrix, with c_1 for cos(q1) and s_23 for sin(q2 + q3)."""
    replaced = {}
    for function in expression.atoms(sp.cos, sp.sin):
        indices = [_joint_index(term) for term in sp.Add.make_args(function.args[0])]
        if all(indices):
            letter = "c" if isinstance(function, sp.cos) else "s"
            replaced[function] = sp.Symbol(f"{letter}_{''.join(sorted(indices, key=int))}", real=True)
    return expression.xreplace(replaced)


def _follow(state: _Turning, steps: tuple[tuple[str, Expression], ...], joints: tuple[sp.Symbol, ...]) -> None:
    for motion, amount in steps:
        state.move(motion, amount.sympy(), joints)


def _rotation(axis: str, angle: sp.Expr) -> sp.Matrix:
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    matrix = sp.eye(3)
    matrix[j, j] = matrix[k, k] = sp.cos(angle)
    matrix[j, k], matrix[k, j] = -sp.sin(angle), sp.sin(angle)
    return matrix


def _joint_index(term: sp.Expr) -> str:
    name = term.name if isinstance(term, sp.Symbol) else ""
    return name[1:] if name[:1] == "q" and name[1:].isdigit() else ""
