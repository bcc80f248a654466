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
from .table import Table, joint_names, joint_values, printed_frames, read_table

if TYPE_CHECKING:
    from .symbolic import ClosedForm

Motion = tuple[str, str]  # a motion and its amount: ("Tz", "L"), ("Rz", "q1")
Steps = tuple[tuple[str, Expression], ...]  # the same, read
LINEAR = (0, 1, 2)
ALL = (0, 1, 2, 3, 4, 5)
# motions of one row of a table, and the columns of their amounts
STANDARD = (("Rz", 0), ("Tz", 1), ("Tx", 2), ("Rx", 3))
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

    `rows` are the cells theta, d, a, alpha of a table, or, with convention "frames", the steps that
    lead from one joint's frame to the next, each ending in the joint's own ("Rz", "q1") or
    ("Tz", "q1 + l1"). `base` and `tool` are the steps from the base to the first row and from the
    last frame to the tool. `task_rows` are the rows of J whose determinant is the `constant` times
    the `factors`; a robot without a square task block has none. `poses` are named configurations
    (n,), as their source has them.
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
        return joint_names(self.n)

    @property
    def names(self) -> tuple[str, ...]:
        """Names that may stand in formulas: parameters and joints."""
        return (*self.parameters, *self.joints)

    @property
    def kinds(self) -> str:
        """Joint types in order, "R" revolute and "P" prismatic."""
        if self.convention != "frames":
            return self.table.kinds
        return "".join(_kind(steps) for steps in self.steps)

    @property
    def determinant(self) -> str:
        """Determinant of the task block, the constant in front of its factors.

        Raises RobotError if there are none.
        """
        if not self.factors:
            raise RobotError(
                "determinant takes a robot with a factored task block, "
                f"got {self.name} without factors"
            )

        factors = list[str]()
        if self.constant != "1":
            factors.append(self.constant)
        for factor in self.factors:
            power = ""
            if factor.power != 1:
                power = f"^{factor.power}"
            factors.append(f"({factor.expression}){power}")
        return "*".join(factors)

    def pose(self, name: str) -> Array:
        """Configuration (n,) [rad, m] of that name; RobotError lists the valid ones."""
        if name not in self.poses:
            raise RobotError(unknown(f"pose of {self.name}", name, self.poses))
        return one_configuration(self.n, self.poses[name], f"pose {name} of {self.name}")

    def outside(self, q: ArrayLike) -> tuple[Outside, ...]:
        """The joints that are outside their limits at q (n,) [rad, m].

        The str() of each is a sentence. Raises ChainError.
        """
        return outside(self.limits, self.kinds, q)

    @cached_property
    def table(self) -> Table:
        """Denavit-Hartenberg table; RobotError for hand-placed frames."""
        if self.convention == "frames":
            raise RobotError(
                "table takes a robot with a Denavit-Hartenberg table, "
                f"got {self.name} with hand-placed frames"
            )
        cells = [list(map(str, row)) for row in self.rows]
        return read_table(cells, self.names, self.convention)

    @cached_property
    def steps(self) -> tuple[Steps, ...]:
        """Elementary motions of each row, in order, in every convention."""
        if self.convention == "frames":
            return tuple(self._read(row) for row in self.rows)

        order = MODIFIED
        if self.convention == "standard":
            order = STANDARD
        steps = list[Steps]()
        for row in self.table.rows:
            steps.append(tuple((motion, row[column]) for motion, column in order))
        return tuple(steps)

    @cached_property
    def base_steps(self) -> Steps:
        """Elementary motions from the base to the first row."""
        return self._read(self.base)

    @cached_property
    def tool_steps(self) -> Steps:
        """Elementary motions from the last frame to the tool."""
        return self._read(self.tool)

    def chain(self, parameters: Mapping[str, float] | None = None) -> Chain:
        """Chain with `parameters` [m]; those left out have their defaults.

        Raises RobotError for an unknown one.
        """
        if not parameters:
            return self._default
        return self._build(self.values(parameters))

    def frames(self, parameters: Mapping[str, float] | None, q: ArrayLike) -> Array:
        """Frames (..., n + 1, 4, 4) in base coordinates as the source prints them.

        At q (..., n) [rad, m]. Frame i - 1 has the axis of joint i as its z; the last is the tool.
        A standard table gives T_0^0 ... T_n^0 with the tool transform in the last, the other
        conventions T_1^0 ... T_n^0 and the tool. The base transform leads in all of them. Raises
        RobotError or ChainError.
        """
        joints = configuration(self.n, q)
        values: dict[str, ArrayLike] = {**self.values(parameters), **joint_values(joints)}

        base = np.broadcast_to(_transform(self.base_steps, values), (*joints.shape[:-1], 4, 4))
        links = [_transform(steps, values) for steps in self.steps]
        tool = _transform(self.tool_steps, values)
        return printed_frames(self.convention, base, links, tool)

    def values(self, parameters: Mapping[str, float] | None = None) -> dict[str, float]:
        """Values of all parameters [m], the given ones over the defaults.

        Raises RobotError for an unknown one.
        """
        values = dict(self.parameters)
        for name, value in (parameters or {}).items():
            if name not in self.parameters:
                raise RobotError(unknown(f"parameters of {self.name}", name, self.parameters))
            if not _is_finite(value):
                raise RobotError(
                    f"parameter {name} of {self.name} takes a finite number, got {value!r}"
                )
            values[name] = float(value)
        return values

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
        base = _transform(self.base_steps, values)
        tool = _transform(self.tool_steps, values)
        if self.convention == "frames":
            return self._chain_of_frames(values, base, tool)

        chain = self.table.chain(values, tool)
        if not self.base:
            return chain
        first = base @ chain.fixed[0]
        return Chain(np.concatenate([first[None], chain.fixed[1:]]), chain.kinds)

    def _chain_of_frames(self, values: Mapping[str, float], base: Array, tool: Array) -> Chain:
        """Chain whose constants are what lies between one joint's motion and the next one's."""
        home = {**values, **dict.fromkeys(self.joints, 0.0)}
        placements = list[Array]()
        offset = base  # what the joint before adds at q = 0, as l1 in ("Tz", "q1 + l1")
        for steps in self.steps:
            placements.append(offset @ _transform(steps[:-1], values))
            offset = _transform(steps[-1:], home)
        return from_frames(np.array(placements), self.kinds, offset @ tool)

    def _read(self, motions: Sequence[str] | Sequence[Motion]) -> Steps:
        steps = list[tuple[str, Expression]]()
        for motion, amount in motions:
            steps.append((str(motion), parse(str(amount), self.names)))
        return tuple(steps)


def unknown(what: str, name: str, valid: Mapping[str, object]) -> str:
    """Sentence for a name that is none of the valid ones, with the nearest of them."""
    if not valid:
        return f"{what} takes no name, got {name!r}"
    near = nearest(str(name), valid, cutoff=0)
    return f"{what} takes one of {', '.join(valid)}, got {name!r}; the nearest is {near!r}"


def _kind(steps: Steps) -> str:
    """Type of the joint in whose own motion the steps end."""
    motion, _ = steps[-1]
    if motion == "Rz":
        return "R"
    return "P"


def _transform(steps: Steps, values: Mapping[str, ArrayLike]) -> Array:
    return product(elementary(motion, amount.at(values)) for motion, amount in steps)


def _is_finite(value: object) -> bool:
    if isinstance(value, float):  # most are, and to look at a protocol takes long
        return math.isfinite(value)
    if isinstance(value, bool) or not isinstance(value, SupportsFloat):
        return False
    return math.isfinite(float(value))
