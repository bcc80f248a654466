# pyright: basic
"""Closed forms in sympy, for printing only."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import sympy as sp

from .closed_forms.polynomial import ONE, ZERO, Polynomial, polynomial, total

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from .expression import Expression

    Steps = Sequence[tuple[str, Expression]]

Row = tuple[Polynomial, ...]
Rows = tuple[Row, ...]
IDENTITY: Rows = ((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE))


class Mechanism(Protocol):
    """What a closed form is made from: names, joint types and elementary motions, as of a Robot."""

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of the parameters by name; only the names are read."""
        ...

    @property
    def joints(self) -> Sequence[str]:
        """Names of the joint variables."""
        ...

    @property
    def kinds(self) -> str:
        """Joint types in order, "R" revolute and "P" prismatic."""
        ...

    @property
    def convention(self) -> str:
        """Of the frames: those of "standard" come before the motion of their joint."""
        ...

    @cached_property
    def base_steps(self) -> Steps:
        """Motions from the base to the first row."""
        ...

    @cached_property
    def steps(self) -> Sequence[Steps]:
        """Motions of each row."""
        ...

    @cached_property
    def tool_steps(self) -> Steps:
        """Motions from the last frame to the tool."""
        ...


@dataclass(frozen=True, eq=False)
class ClosedForm:
    """Frames (4 x 4), tool transform T and Jacobian J (6 x n) of a robot.

    Angles of parallel axes are merged. `frames` are those of Robot.frames, `poses` their rotations
    and origins as polynomials. Every symbol is Symbol(name, real=True).
    """

    poses: tuple[tuple[Rows, Row], ...]
    J: sp.Matrix
    parameters: tuple[sp.Symbol, ...]
    joints: tuple[sp.Symbol, ...]

    @cached_property
    def frames(self) -> tuple[sp.Matrix, ...]:
        """Written when they are asked for: the Jacobian alone is wanted more often."""
        return tuple(_frame(R, p) for R, p in self.poses)

    @property
    def T(self) -> sp.Matrix:
        """The tool transform, which is the last frame."""
        return self.frames[-1]


class Turning:
    """A frame of rotation base Rz(angle): angles of parallel axes add before a cosine is taken."""

    def __init__(self, joints: Collection[sp.Symbol]) -> None:
        self.joints = set(joints)
        self.base = IDENTITY
        self.angle = sp.S.Zero
        self.p: Row = (ZERO, ZERO, ZERO)

    @property
    def rotation(self) -> Rows:
        """Rows of the rotation."""
        if not self.angle:
            return self.base
        return times(self.base, rotation("z", self.angle))

    def follow(self, steps: Steps) -> None:
        """Go on by elementary motions."""
        for motion, amount in steps:
            self.move(motion, amount.sympy())

    def move(self, motion: str, amount: sp.Expr) -> None:
        """Go on by one motion."""
        if amount == 0:
            return
        if motion[0] == "T":
            self._slide(motion[1], amount)
        elif motion == "Rz":
            self._turn(amount)
        else:
            self._tilt(motion[1], amount)

    def _slide(self, axis: str, amount: sp.Expr) -> None:
        column = "xyz".index(axis)
        length = polynomial(amount)
        p = [x + row[column] * length for x, row in zip(self.p, self.rotation, strict=True)]
        self.p = tuple(p)

    def _turn(self, amount: sp.Expr) -> None:
        """Turn about z; what no joint turns goes into the base."""
        turning = sp.S.Zero
        for term in sp.Add.make_args(amount):
            if term.free_symbols & self.joints:
                turning += term
        if amount != turning:
            self.base = times(self.base, rotation("z", amount - turning))
        self.angle += turning

    def _tilt(self, axis: str, amount: sp.Expr) -> None:
        """Turn about x or y, after which z is another axis."""
        turn = rotation(axis, amount)
        # half a turn only reverses the axis: Rz(s) F = F Rz(-s)
        if turn[2][2].terms == {(): -1}:
            self.base = times(self.base, turn)
            self.angle = -self.angle
        else:
            self.base = times(self.rotation, turn)
            self.angle = sp.S.Zero


def closed_form(robot: Mechanism) -> ClosedForm:
    """Closed form of a robot in its named parameters.

    The linear rows are derivatives of p (S1, section 5.10), which holds each cosine and sine to the
    first power; the angular rows are the joint axes.
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
    columns = list[sp.Matrix]()
    for q, kind, (R, _) in zip(joints, robot.kinds, axes, strict=True):
        linear = _expressions(x.diff(q) for x in state.p)
        angular = [sp.S.Zero] * 3
        if kind == "R":
            angular = _expressions(z for _, _, z in R)
        columns.append(sp.Matrix([*linear, *angular]))
    poses = (*axes, (state.rotation, state.p))
    return ClosedForm(poses, sp.Matrix.hstack(*columns), parameters, joints)


def rotation(axis: str, angle: sp.Expr) -> Rows:
    """Rows of the rotation about x, y or z."""
    i = "xyz".index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    cosine, sine = polynomial(sp.cos(angle)), polynomial(sp.sin(angle))
    rows = [list(row) for row in IDENTITY]
    rows[j][j] = cosine
    rows[k][k] = cosine
    rows[k][j] = sine
    rows[j][k] = -sine
    return tuple(tuple(row) for row in rows)


def shorthand(expression: Any) -> Any:
    """The expression, or matrix, with c_1 for cos(q1) and s_23 for sin(q2 + q3)."""
    replaced = {}
    for function in expression.atoms(sp.cos, sp.sin):
        indices = [_joint_index(term) for term in sp.Add.make_args(function.args[0])]
        if not all(indices):
            continue
        letter = "c" if isinstance(function, sp.cos) else "s"
        name = f"{letter}_{''.join(sorted(indices, key=int))}"
        replaced[function] = sp.Symbol(name, real=True)
    return expression.xreplace(replaced)


def times(left: Rows, right: Rows) -> Rows:
    """Product of two rotations."""
    columns = list(zip(*right, strict=True))
    return tuple(_row_times(row, columns) for row in left)


def _row_times(row: Row, columns: Sequence[Row]) -> Row:
    return tuple(_dot(row, column) for column in columns)


def _dot(row: Row, column: Row) -> Polynomial:
    products = list[Polynomial]()
    for a, b in zip(row, column, strict=True):
        if a.terms and b.terms:
            products.append(a * b)
    return total(products)


def _frame(R: Rows, p: Row) -> sp.Matrix:
    rows = list[list[Any]]()
    for row, x in zip(R, p, strict=True):
        rows.append(_expressions([*row, x]))
    return sp.Matrix([*rows, [0, 0, 0, 1]])


def _expressions(entries: Iterable[Polynomial]) -> list[sp.Expr]:
    return [entry.expression() for entry in entries]


def _joint_index(term: sp.Expr) -> str:
    """The digits of a joint such as q12; empty for anything else."""
    if not isinstance(term, sp.Symbol):
        return ""
    letter, digits = term.name[:1], term.name[1:]
    if letter == "q" and digits.isdigit():
        return digits
    return ""
