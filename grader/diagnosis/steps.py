"""An arm as a list of elementary motions with numbers, each of which somebody may get wrong."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ...solutions.expression import Expression
from ...solutions.robot import Robot

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
OTHER_ORDER = {"standard": (3, 2, 0, 1), "modified": (2, 3, 1, 0)}  # of the four of a row
SIZE = 1e-9  # [rad, m]: what is smaller is no angle and no length
PROBES = (1.0, 2.0)  # [m] by which a length is moved


class HasRobot(Protocol):
    """An arm, as exercises/arm.py has it: what is computed there does not belong to marking."""

    @property
    def robot(self) -> Robot:
        """Its rows."""
        ...

    @property
    def lengths(self) -> Mapping[str, float]:
        """Its lengths by name [m]."""
        ...

    @property
    def q(self) -> NDArray[np.float64]:
        """Its joint variables (n,) [rad, m]."""
        ...


@dataclass(frozen=True, eq=False)
class Steps:
    """The motions of an arm from its base to its tool, K of them.

    The amount of a motion is its constant plus, where the joint's own variable stands, that.

    Attributes:
        motions: "Rz", "Tx", ... of each.
        rows: The row (K,) of each: 0 before the first joint, i for joint i, n + 1 behind the last.
        constants: The amount (K,) at q = 0 [rad, m].
        gains: How much (K,) of its joint's variable is added: 1 or 0.
        own: The place (n,) of each joint's own motion.
        q: The joint variables (n,) [rad, m].
        kinds: Joint types, such as "RRP".
        convention: "standard", "modified" or "frames".
        lengths: By name, what 1 m more of a length adds to the constants (K,).
        values: The lengths by name [m].
    """

    motions: tuple[str, ...]
    rows: Indices
    constants: Array
    gains: Array
    own: Indices
    q: Array
    kinds: str
    convention: str
    lengths: dict[str, Array]
    values: dict[str, float]

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.kinds)

    @property
    def first(self) -> int:
        """The place of joint 1's axis in the stack of frames: frame 0 is the base."""
        return 0 if self.convention == "standard" else 1

    def at(self, row: int, motion: str) -> list[int]:
        """Places of such motions in a row."""
        places = np.flatnonzero(self.rows == row)
        return [int(place) for place in places if self.motions[place] == motion]

    def other_order(self) -> Indices | None:
        """The places (K,) in the order of the other convention; None without a table."""
        if self.convention not in OTHER_ORDER:
            return None
        order = np.arange(len(self.motions))
        for row in range(1, self.n + 1):
            places = np.flatnonzero(self.rows == row)
            order[places] = places[list(OTHER_ORDER[self.convention])]
        return order


def steps_of(arm: HasRobot) -> Steps:
    """The motions of an arm with a student's numbers."""
    robot = arm.robot
    parts = [robot.base_steps, *robot.steps, robot.tool_steps]
    motions: list[str] = []
    rows: list[int] = []
    amounts: list[Expression] = []
    for row, steps in enumerate(parts):
        for motion, amount in steps:
            motions.append(motion)
            rows.append(row)
            amounts.append(amount)

    values = robot.values(arm.lengths)
    constants = _constants(amounts, robot, values)
    gains = _amounts(amounts, {**values, **dict.fromkeys(robot.joints, 1.0)}) - constants
    return Steps(
        tuple(motions),
        np.array(rows),
        constants,
        np.round(gains),
        np.flatnonzero(np.round(gains) != 0),
        np.asarray(arm.q, dtype=np.float64),
        robot.kinds,
        robot.convention,
        _lengths(amounts, robot, values),
        values,
    )


def _amounts(amounts: Sequence[Expression], values: dict[str, float]) -> Array:
    return np.array([float(np.asarray(amount.at(values))) for amount in amounts])


def _constants(amounts: Sequence[Expression], robot: Robot, values: dict[str, float]) -> Array:
    return _amounts(amounts, {**values, **dict.fromkeys(robot.joints, 0.0)})


def _lengths(
    amounts: Sequence[Expression], robot: Robot, values: dict[str, float]
) -> dict[str, Array]:
    """The direction of each length in which the constants are linear."""
    here = _constants(amounts, robot, values)
    found: dict[str, Array] = {}
    for name, value in values.items():
        once, twice = [
            _constants(amounts, robot, {**values, name: value + probe}) - here for probe in PROBES
        ]
        is_linear = np.allclose(twice, 2 * once, rtol=0, atol=SIZE)
        if is_linear and np.abs(once).max(initial=0.0) > SIZE:
            found[name] = once
    return found
