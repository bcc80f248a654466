"""The arms of the course, as data."""

import difflib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, configuration, elementary, from_frames, product
from .errors import KinegradeError
from .expression import Expression, parse
from .table import Table, read_table

if TYPE_CHECKING:
    from .symbolic import ClosedForm

Step = tuple[str, str]  # a motion and its amount: ("Tz", "L"), ("Rz", "q1")
DEGREE = math.pi / 180
LINEAR = (0, 1, 2)
STANDARD = (("Rz", 0), ("Tz", 1), ("Tx", 2), ("Rx", 3))  # motions of one row and the columns of their amounts
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
    joint's frame to the next, each ending in the joint's own ("Rz", "q1") or ("Tz", "q1 + l1"). `task_rows` are the
    rows of J whose determinant has `factors`, up to a constant.
    """

    name: str
    title: str
    parameters: Mapping[str, float]
    rows: Sequence[Sequence[str]] | Sequence[Sequence[Step]]
    limits: tuple[tuple[float, float], ...]
    source: str
    convention: Literal["standard", "modified", "frames"] = "standard"
    tool: tuple[Step, ...] = ()
    task_rows: tuple[int, ...] = LINEAR
    factors: tuple[Factor, ...] = field(default=())

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

    @cached_property
    def table(self) -> Table:
        """Denavit-Hartenberg table; RobotError for hand-placed frames."""
        if self.convention == "frames":
            raise RobotError(
                f"table takes a robot with a Denavit-Hartenberg table, got {self.name} with hand-placed frames"
            )
        return read_table([[str(cell) for cell in row] for row in self.rows], self.names, self.convention)

    @cached_property
    def steps(self) -> tuple[tuple[tuple[str, Expression], ...], ...]:
        """Elementary motions of each row, in order, in every convention."""
        if self.convention == "frames":
            return tuple(self._motions([(str(motion), str(amount)) for motion, amount in row]) for row in self.rows)
        order = STANDARD if self.convention == "standard" else MODIFIED
        return tuple(tuple((motion, row[column]) for motion, column in order) for row in self.table.rows)

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
        the tool transform in the last, the other conventions T_1^0 ... T_n^0 and the tool. Raises RobotError or
        ChainError.
        """
        joints = configuration(self.n, q)
        values: dict[str, ArrayLike] = {**self.values(parameters)}
        values |= {name: joints[..., i] for i, name in enumerate(self.joints)}
        reached = [np.broadcast_to(np.eye(4), (*joints.shape[:-1], 4, 4))]
        for steps in self.steps:
            reached.append(reached[-1] @ _transform(steps, values))
        tool = reached[-1] @ _transform(self.tool_steps, values)
        return np.stack([*(reached[:-1] if self.convention == "standard" else reached[1:]), tool], axis=-3)

    def values(self, parameters: Mapping[str, float] | None = None) -> dict[str, float]:
        """Values of all parameters [m], the given ones over the defaults. RobotError for an unknown one."""
        for name, value in (parameters or {}).items():
            if name not in self.parameters:
                raise RobotError(_unknown(f"parameters of {self.name}", name, self.parameters))
            if not _is_finite(value):
                raise RobotError(f"parameter {name} of {self.name} takes a finite number, got {value!r}")
        return {**self.parameters, **{name: float(value) for name, value in (parameters or {}).items()}}

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
        tool = _transform(self.tool_steps, values)
        if self.convention != "frames":
            return self.table.chain(values, tool)
        home = {**values, **dict.fromkeys(self.joints, 0.0)}
        offsets = [np.eye(4), *(_transform(steps[-1:], home) for steps in self.steps)]
        placements = [
            offset @ _transform(steps[:-1], values) for offset, steps in zip(offsets, self.steps, strict=False)
        ]
        return from_frames(np.array(placements), self.kinds, offsets[-1] @ tool)

    def _motions(self, steps: Sequence[Step]) -> tuple[tuple[str, Expression], ...]:
        return tuple((motion, parse(amount, self.names)) for motion, amount in steps)


def robot(name: str) -> Robot:
    """Robot of that name; RobotError lists the valid ones."""
    if name not in ROBOTS:
        raise RobotError(_unknown("robot", name, ROBOTS))
    return ROBOTS[name]


def _transform(steps: Sequence[tuple[str, Expression]], values: Mapping[str, ArrayLike]) -> Array:
    return product(elementary(motion, amount.at(values)) for motion, amount in steps)


def _is_finite(value: object) -> bool:
    if isinstance(value, bool) or not isinstance(value, SupportsFloat):
        return False
    return math.isfinite(float(value))


def _unknown(what: str, name: str, valid: Mapping[str, object]) -> str:
    nearest = difflib.get_close_matches(str(name), list(valid), 1, cutoff=0)
    return f"{what} takes one of {', '.join(valid)}, got {name!r}; the nearest is {nearest[0]!r}"


def _degrees(*limits: tuple[float, float]) -> tuple[tuple[float, float], ...]:
    return tuple((low * DEGREE, high * DEGREE) for low, high in limits)


ROBOTS: dict[str, Robot] = {
    arm.name: arm
    for arm in (
        Robot(
            name="planar_2r",
            title="Planar arm with two revolute joints",
            parameters={"l1": 1.0, "l2": 0.7},
            rows=(("q1", "0", "l1", "0"), ("q2", "0", "l2", "0")),
            limits=_degrees((-180, 180), (-180, 180)),
            source="S2, the planar 2R arm; lengths chosen here, limits one full turn chosen here",
            task_rows=(0, 1),
            factors=(Factor("elbow: arm straight or folded", "sin(q2)"),),
        ),
        Robot(
            name="three_axis",
            title="Three-axis arm with a turning base, shoulder and elbow",
            parameters={"L": 3.0, "a2": 2.0, "a3": 2.0},
            rows=(
                (("Tz", "L"), ("Rz", "q1")),
                (("Rx", "pi/2"), ("Rz", "q2")),
                (("Ty", "a2"), ("Rz", "q3")),
            ),
            convention="frames",
            tool=(("Tx", "a3"),),
            limits=_degrees((-180, 180), (-120, 120), (-135, 135)),
            source=(
                "S0, section 4.3.1, with its lengths; frames placed so that the printed points come out "
                "(figure 4.1 is missing); limits chosen here"
            ),
            factors=(
                Factor("elbow: arm straight or folded", "cos(q3)"),
                Factor("shoulder: tip on axis 1", "a3*cos(q2 + q3) - a2*sin(q2)"),
            ),
        ),
        Robot(
            name="rrt_spherical",
            title="Spherical arm RRT",
            parameters={"d1": 0.6},
            rows=(("q1", "d1", "0", "-pi/2"), ("q2", "0", "0", "pi/2"), ("0", "q3", "0", "0")),
            limits=(*_degrees((-180, 180), (-120, 120)), (0.2, 1.0)),
            source="S3, problem 5.4.1 (figure 5.2 is missing): q2 from the vertical; length and limits chosen here",
            factors=(
                Factor("stroke: hand at the shoulder", "q3", power=2),
                Factor("shoulder: hand on axis 1", "sin(q2)"),
            ),
        ),
        Robot(
            name="rrt_offset",
            title="Spherical arm RRT with shoulder offsets",
            parameters={"a1": 0.2, "d1": 0.5, "d2": 0.15},
            rows=(("q1", "d1", "a1", "-pi/2"), ("q2", "d2", "0", "pi/2"), ("0", "q3", "0", "0")),
            limits=(*_degrees((-180, 180), (-120, 120)), (0.2, 1.0)),
            source=(
                "S3, problem 5.4.1, with offsets a1 and d2 added; q2 from the vertical; lengths and limits chosen here"
            ),
            factors=(
                Factor("stroke: hand on axis 2", "q3"),
                Factor("shoulder: hand beside axis 1, at the distance |d2|", "a1 + q3*sin(q2)"),
            ),
        ),
        Robot(
            name="puma560",
            title="Puma 560",
            parameters={"d1": 26.45 * 0.0254, "a2": 0.4318, "a3": 0.0203, "d3": 0.15005, "d4": 0.4318},
            rows=(
                ("q1", "d1", "0", "pi/2"),
                ("q2", "0", "a2", "0"),
                ("q3", "d3", "a3", "-pi/2"),
                ("q4", "d4", "0", "pi/2"),
                ("q5", "0", "0", "-pi/2"),
                ("q6", "0", "0", "0"),
            ),
            limits=_degrees((-160, 160), (-45, 225), (-225, 45), (-110, 170), (-100, 100), (-266, 266)),
            source=(
                "S3, problem 5.4.2; Corke and Armstrong-Helouvry, ICRA 1994, as in the Robotics Toolbox; d1 is the "
                "pedestal of 26.45 in; limits from the toolbox's model of the Puma 560 after Wang and Chen, "
                "IEEE Trans. RA 7(4), 1991"
            ),
            task_rows=(0, 1, 2, 3, 4, 5),
            factors=(
                Factor("wrist: axes 4 and 6 in line", "sin(q5)"),
                Factor("elbow: arm straight or folded", "a3*sin(q3) + d4*cos(q3)"),
                Factor(
                    "shoulder: wrist centre beside axis 1, at the distance |d3|",
                    "a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3)",
                ),
            ),
        ),
    )
}
