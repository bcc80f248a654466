"""A robot: rows of formulas in named parameters and joints, and what is computed from them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, configuration, elementary, from_frames, one_configuration, product
from .errors import KinegradeError, nearest
from .expression import Expression, parse
from .limits import Outside, outside
from .table import Table, read_table

if TYPE_CHECKING:
    from .symbolic import ClosedForm

Motion = tuple[str, str]  # a motion and its amount: ("Tz", "L"), ("Rz", "q1")
LINEAR = (0, 1, 2)
STANDARD = (
    ("Rz", 0),
    ("Tz", 1),
    ("Tx", 2),
    ("Rx", 3),
)  # motions of one row and the columns of their amounts
MODIFIED = (("Rx", 3), ("Tx", 2), ("Rz", 0), ("Tz", 1))


class RobotError(KinegradeError):
    """A robot, or a parameter of one, that does not exist."""


@dataclass(frozen=True)
class Factor:
    """One factor of the determinant of the task block, with the posture in which it vanishes."""

    name: str
    expression: str
    power: int = 1


@dataclass(frozen=True, eq=False)
class Robot:
    """Rows of formulas in named parameters [m] and joints q1 ... qn [rad, m].

    `rows` are the cells theta, d, a, alpha of a table, or, with convention "frames", the steps that lead from one
    joint's frame to the next, each ending in the joint's own ("Rz", "q1") or ("Tz", "q1 + l1"). `base` and `tool` are
    the steps from the base to the first row and from the last frame to the tool. `task_rows` are the rows of J whose
    determinant is the `constant` times the `factors`; a robot without a square task block has none. `poses` are named
    configurations (n,), as their source has them.
    """

    name: str
    title: str
    parameters: Mapping[str, float]
    rows: Sequence[Sequence[str]] | Sequence[Sequence[Motion]]
    limits: tuple[tuple[float, float], ...]
    source: str
    convention: Literal["standard", "modified", "frames"] = "standard"
    base: tuple[Motion, ...] = ()
    tool: tuple[Motion, ...] = ()
    task_rows: tuple[int, ...] = LINEAR
    factors: tuple[Factor, ...] = ()
    constant: str = "1"
    poses: Mapping[str, tuple[float, ...]] = field(default_factory=dict[str, tuple[float, ...]])

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.rows)

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joint variables, q1 ... qn."""
        return tuple(f"q{i}" for i in range(1, self.n + 1))

    @property
    def names(self) -> tuple[str, ...]:
        """Names that may stand in formulas: parameters and joints."""
        return (*self.parameters, *self.joints)

    @property
    def kinds(self) -> str:
        """Joint types in order, "R" revolute and "P" prismatic."""
        if self.convention == "frames":
            return "".join("R" if steps[-1][0] == "Rz" else "P" for steps in self.steps)
        return self.table.kinds

    @property
    def determinant(self) -> str:
        """Determinant of the task block, the constant in front of its factors; RobotError if there are none."""
        if not self.factors:
            raise RobotError(
                f"determinant takes a robot with a factored task block, got {self.name} without factors"
            )
        products = (
            f"({f.expression})" + (f"^{f.power}" if f.power != 1 else "") for f in self.factors
        )
        return "*".join([*([self.constant] if self.constant != "1" else []), *products])

    def pose(self, name: str) -> Array:
        """Configuration (n,) [rad, m] of that name; RobotError lists the valid ones."""
        if name not in self.poses:
            raise RobotError(unknown(f"pose of {self.name}", name, self.poses))
        return one_configuration(self.n, self.poses[name], f"pose {name} of {self.name}")

    def outside(self, q: ArrayLike) -> tuple[Outside, ...]:
        """The joints that are outside their limits at q (n,) [rad, m]; str() of each is a sentence. ChainError."""
        return outside(self.limits, self.kinds, q)

    @cached_property
    def table(self) -> Table:
        """Denavit-Hartenberg table; RobotError for hand-placed frames."""
        if self.convention == "frames":
            raise RobotError(
                f"table takes a robot with a Denavit-Hartenberg table, got {self.name} with hand-placed frames"
            )
        return read_table(
            [[str(cell) for cell in row] for row in self.rows], self.names, self.convention
        )

    @cached_property
    def steps(self) -> tuple[tuple[tuple[str, Expression], ...], ...]:
        """Elementary motions of each row, in order, in every convention."""
        if self.convention == "frames":
            return tuple(
                self._motions([(str(motion), str(amount)) for motion, amount in row])
                for row in self.rows
            )
        order = STANDARD if self.convention == "standard" else MODIFIED
        return tuple(
            tuple((motion, row[column]) for motion, column in order) for row in self.table.rows
        )

    @cached_property
    def base_steps(self) -> tuple[tuple[str, Expression], ...]:
        """Elementary motions from the base to the first row."""
        return self._motions(self.base)

    @cached_property
    def tool_steps(self) -> tuple[tuple[str, Expression], ...]:
        """Elementary motions from the last frame to the tool."""
        return self._motions(self.tool)

    def chain(self, parameters: Mapping[str, float] | None = None) -> Chain:
        """Chain with `parameters` [m]; those left out have their defaults. RobotError for an unknown one."""
        return self._build(self.values(parameters)) if parameters else self._default

    def frames(self, parameters: Mapping[str, float] | None, q: ArrayLike) -> Array:
        """Frames (..., n + 1, 4, 4) in base coordinates as the source prints them, at q (..., n) [rad, m].

        Frame i - 1 has the axis of joint i as its z; the last is the tool. A standard table gives T_0^0 ... T_n^0 with
        the tool transform in the last, the other conventions T_1^0 ... T_n^0 and the tool. The base transform leads
        in all of them. Raises RobotError or ChainError.
        """
        joints = configuration(self.n, q)
        values: dict[str, ArrayLike] = {**self.values(parameters)}
        values |= {name: joints[..., i] for i, name in enumerate(self.joints)}
        reached = [np.broadcast_to(_transform(self.base_steps, values), (*joints.shape[:-1], 4, 4))]
        for steps in self.steps:
            reached.append(reached[-1] @ _transform(steps, values))
        tool = reached[-1] @ _transform(self.tool_steps, values)
        return np.stack(
            [*(reached[:-1] if self.convention == "standard" else reached[1:]), tool], axis=-3
        )

    def values(self, parameters: Mapping[str, float] | None = None) -> dict[str, float]:
        """Values of all parameters [m], the given ones over the defaults. RobotError for an unknown one."""
        for name, value in (parameters or {}).items():
            if name not in self.parameters:
                raise RobotError(unknown(f"parameters of {self.name}", name, self.parameters))
            if not _is_finite(value):
                raise RobotError(
                    f"parameter {name} of {self.name} takes a finite number, got {value!r}"
                )
        return {
            **self.parameters,
            **{name: float(value) for name, value in (parameters or {}).items()},
        }

    def symbolic(self) -> "ClosedForm":
        """Closed forms of frames and Jacobian in sympy, made once."""
        return self._closed_form

    @cached_property
    def _closed_form(self) -> "ClosedForm":
        from .symbolic import closed_form

        return closed_form(self)

    @cached_property
    def _default(self) -> Chain:
        return self._build(dict(self.parameters))

    def _build(self, values: Mapping[str, float]) -> Chain:
        base, tool = _transform(self.base_steps, values), _transform(self.tool_steps, values)
        if self.convention != "frames":
            chain = self.table.chain(values, tool)
            return Chain(
                np.concatenate([(base @ chain.fixed[0])[None], chain.fixed[1:]]), chain.kinds
            )
        home = {**values, **dict.fromkeys(self.joints, 0.0)}
        offsets = [base, *(_transform(steps[-1:], home) for steps in self.steps)]
        placements = [
            offset @ _transform(steps[:-1], values)
            for offset, steps in zip(offsets, self.steps, strict=False)
        ]
        return from_frames(np.array(placements), self.kinds, offsets[-1] @ tool)

    def _motions(self, steps: Sequence[Motion]) -> tuple[tuple[str, Expression], ...]:
        return tuple((motion, parse(amount, self.names)) for motion, amount in steps)


def _transform(steps: Sequence[tuple[str, Expression]], values: Mapping[str, ArrayLike]) -> Array:
    return product(elementary(motion, amount.at(values)) for motion, amount in steps)


def _is_finite(value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, SupportsFloat):
        return False
    return math.isfinite(float(value))


def unknown(what: str, name: str, valid: Mapping[str, object]) -> str:
    """Sentence for a name that is none of the valid ones, with the nearest of them."""
    if not valid:
        return f"{what} takes no name, got {name!r}"
    near = nearest(str(name), valid, cutoff=0)
    return f"{what} takes one of {', '.join(valid)}, got {name!r}; the nearest is {near!r}"
