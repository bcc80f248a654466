"""A robot as one student has it: with the student's lengths, at the student's q."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..solutions.expression import Expression, parse
from ..solutions.jacobian import jacobian
from ..solutions.robot import Robot
from ..solutions.singularity import factor_values
from .answers import Variant
from .drawing import Dimension, Drawing, Triad, point
from .exercise import ExerciseError

if TYPE_CHECKING:
    from ..solutions.chain import Chain
    from ..solutions.symbolic import ClosedForm

Array = NDArray[Any]  # of floats: exercises are typed no further
UNIT = {"R": "rad", "P": "m"}
Ends = tuple[ArrayLike, ArrayLike]


@dataclass(frozen=True, eq=False)
class Arm:
    """A robot with lengths [m] at one configuration q (n,) [rad, m].

    Lengths left out have their defaults.
    """

    robot: Robot
    lengths: Mapping[str, float]
    q: Array

    def at(self, q: ArrayLike) -> "Arm":
        """The same arm elsewhere."""
        return replace(self, q=np.asarray(q, dtype=float))

    @property
    def kinds(self) -> str:
        """Joint types, such as "RRP"."""
        return self.robot.kinds

    @cached_property
    def frames(self) -> Array:
        """Frames (n + 1, 4, 4) in base coordinates as the source prints them, the tool last."""
        return self.robot.frames(self.lengths, self.q)

    @property
    def T(self) -> Array:
        """The tool frame (4, 4) in base coordinates."""
        return self.frames[-1]

    @property
    def R(self) -> Array:
        """The tool axes (3, 3) in base axes, as columns."""
        return self.frames[-1, :3, :3]

    @property
    def p(self) -> Array:
        """The tool point (3,) in base axes [m]."""
        return self.frames[-1, :3, 3]

    @property
    def axes(self) -> Array:
        """The joint axes (3, n) in base axes, as columns."""
        return self.frames[:-1, :3, 2].T

    @property
    def origins(self) -> Array:
        """A point (3, n) on every joint's axis in base axes [m], as columns."""
        return self.frames[:-1, :3, 3].T

    @property
    def chain(self) -> "Chain":
        """The arm as a chain, one for all postures."""
        return _chain(self.robot, tuple(self.lengths.items()))

    @cached_property
    def J(self) -> Array:
        """The Jacobian (6, n) in base axes at the tool point, linear rows above angular."""
        return jacobian(self.chain, self.q)

    @property
    def determinant(self) -> Expression:
        """The determinant of the robot's task block in closed form."""
        return parse(self.robot.determinant, self.robot.names)

    @property
    def factors(self) -> Array:
        """Values of the factors of det J, in the robot's order."""
        values = factor_values(self.robot, self.lengths, self.q)
        return np.array([*values.values()])

    @property
    def closed(self) -> "ClosedForm":
        """Frames and Jacobian in closed form."""
        return self.robot.symbolic()

    @property
    def size(self) -> float:
        """All lengths and strokes together [m]."""
        sizes = [*self.robot.values(self.lengths).values()]
        for x, kind in zip(self.q, self.kinds, strict=True):
            if kind == "P":
                sizes.append(float(x))
        return sum(map(abs, sizes))

    def drawing(
        self,
        caption: str,
        alt: str,
        *,
        base: str = "0",
        tool: str = "tool",
        lengths: Mapping[str, Ends] | None = None,
        arrows: bool = True,
        more: Mapping[str, Array] | None = None,
        view: tuple[float, float] | None = Drawing.view,
        stands: ArrayLike = Drawing.stands,
    ) -> Drawing:
        """The arm as it stands, its base and tool frame under these names.

        An empty name draws no frame. `lengths` are dimension lines: name to the two ends in base
        coordinates [m]. `more` are other frames that are drawn: name to the frame (4, 4) in base
        coordinates. `view` and `stands` are those of `Drawing`.
        """
        frames = {base: np.eye(4), tool: self.T, **(more or {})}
        triads = tuple(Triad(pose, label) for label, pose in frames.items() if label)

        lines: list[Dimension] = []
        for name, (start, end) in (lengths or {}).items():
            lines.append(Dimension(point(np.asarray(start)), point(np.asarray(end)), name))

        return Drawing(
            self.chain,
            tuple(self.q.tolist()),
            caption,
            alt,
            triads,
            tuple(lines),
            arrows,
            view,
            stands=point(np.asarray(stands)),
        )


def arm_of(robot: Robot, v: Variant, names: tuple[str, ...] | None = None) -> Arm:
    """The arm of a variant: q and the robot's lengths as drawn, or those of `names` alone.

    Raises:
        ExerciseError: no q was drawn.
    """
    if "q" not in v:
        raise ExerciseError(
            f"arm takes a q among the drawn numbers, one value for each of the {robot.n} joints of "
            f"{robot.name}, got {', '.join(v) or 'no numbers'}"
        )
    sizes = robot.parameters if names is None else names
    lengths = tuple((name, float(v[name])) for name in sizes if name in v)
    q = tuple(float(x) for x in v["q"])
    return _kept(robot, lengths, q)


def units_of(robot: Robot, names: tuple[str, ...] | None = None) -> dict[str, str | list[str]]:
    """Units of a robot's lengths, or of `names` alone, and of q."""
    lengths = robot.parameters if names is None else names
    return {**dict.fromkeys(lengths, "m"), "q": [UNIT[kind] for kind in robot.kinds]}


@lru_cache(maxsize=256)
def _chain(robot: Robot, lengths: tuple[tuple[str, float], ...]) -> "Chain":
    """One chain for one student, since it is compiled when it is used first."""
    return robot.chain(dict(lengths))


@lru_cache(maxsize=256)
def _kept(robot: Robot, lengths: tuple[tuple[str, float], ...], q: tuple[float, ...]) -> Arm:
    """One arm for one student, whose frames and Jacobian are computed once."""
    return Arm(robot, dict(lengths), np.array(q))
