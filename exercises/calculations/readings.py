r"""Joint rates for a wished velocity, and the ways in which such a wish is read.

"2 m/s along x" may prescribe the whole twist with its zeros, the linear velocity alone or one
component of it, along an axis of the base or of the tool. Each leads to other joint rates. A sheet
says which of them is meant, and who answers another one is told which it was.

J (6, n) and twists (6,) have linear rows above angular ones, in base axes at the tool point. `rows`
are the indices of those rows that are prescribed; where they are fewer than the joints, the rates
of least norm are asked.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...solutions.jacobian import in_axes
from ...solutions.singularity import rank
from ...solutions.velocity import pseudoinverse
from ..arm import Array
from ..exercise import Outcome
from ..properties import meets
from .speeds import LETTERS, Speed
from .twists import ANGULAR, LINEAR, WHOLE, Prescribed

__all__ = [
    "ANGULAR",
    "LINEAR",
    "SLACK",
    "TRANSPOSED",
    "WHOLE",
    "Prescribed",
    "Reading",
    "Speed",
    "judged_rates",
    "rates_for",
    "reaches",
    "unique_or_least_rates",
]

SLACK = 0.01  # of the largest component of the wish: a velocity this near is meant
COMPONENTS = ("vx", "vy", "vz", "omega_x", "omega_y", "omega_z")
NAMES: dict[Prescribed, str] = {
    WHOLE: "the whole twist",
    LINEAR: "the linear velocity",
    ANGULAR: "the angular velocity",
    (0,): "the x component",
    (1,): "the y component",
    (2,): "the z component",
}
TRANSPOSED = (
    "These come from J transposed in place of its inverse or pseudoinverse; put them into J and "
    "look at the velocity they give."
)


def unique_or_least_rates(J: Array, xi: Array) -> Array:
    """Joint rates (n,) that give xi (m,): of square J (m, n) the unique ones, else of least norm.

    Raises:
        LinAlgError: J is square and singular.
    """
    if J.shape[0] == J.shape[1]:
        return np.linalg.solve(J, xi)
    return pseudoinverse(J) @ xi


def rates_for(J: Array, twist: Array, rows: Prescribed = WHOLE) -> Array:
    """Joint rates (n,) for the prescribed rows of a twist: the unique ones, or those of least norm.

    Raises:
        LinAlgError: there are as many rows as joints, and they are singular.
    """
    return unique_or_least_rates(J[list(rows)], twist[list(rows)])


def reaches(J: Array, rates: Array, wanted: Array, decimals: int, largest: float) -> bool:
    """Whether rates (n,) with so many decimals give `wanted` (m,) with J (m, n), but for rounding.

    It counts for both, the rates and a J of the student's own, but for no more than `SLACK` of
    `largest`, the size of the wish.
    """
    rounding = 0.75 * 10.0**-decimals * (np.abs(J).sum(axis=1) + np.abs(rates).sum())
    return meets(J, rates, wanted, np.minimum(rounding, SLACK * largest))


def judged_rates(
    J: Array, R: Array, twist: Array, value: Array, rows: Prescribed = WHOLE, *, decimals: int = 4
) -> Outcome:
    """Right by the velocity that is reached where the rates are unique; else names their reading.

    `R` (3, 3) are the axes of the tool, `decimals` those that are asked of the rates `value` (n,).
    Half of the points go to rates that reach what is prescribed, or more, in base axes, and are not
    those of least norm.
    """
    n = J.shape[1]
    largest = float(np.abs(twist).max())
    chosen = list(rows)
    are_unique = len(rows) >= n
    if are_unique and reaches(J[chosen], value, twist[chosen], decimals, largest):
        return Outcome(right=np.ones(n, dtype=bool))

    turned = {"base": J, "tool": in_axes(J, R)}
    for reading in _readings(twist, rows):
        block, wanted = turned[reading.axes][list(reading.rows)], twist[list(reading.rows)]
        if meets(block, value, wanted, SLACK * largest):
            return _as_read(reading, block, twist, value, rows)
    return Outcome()


@dataclass(frozen=True)
class Reading:
    """Which rows of a twist a wish prescribes, and in which axes."""

    rows: Prescribed
    axes: Literal["base", "tool"] = "base"

    @property
    def name(self) -> str:
        """Its rows in words."""
        if self.rows in NAMES:
            return NAMES[self.rows]
        components = ", ".join(COMPONENTS[row] for row in self.rows)
        return f"the components {components}"

    def met(self, twist: Array) -> str:
        """What rates meet that answer it."""
        is_whole = self.rows == WHOLE
        if self.axes == "base":
            return self.asked(twist) if is_whole else f"{self.name} only"

        axis = _axis(twist)
        where = "in the axes of the tool"
        if axis is not None:
            where = f"along the {LETTERS[axis]} axis of the tool"
        if is_whole:
            return f"{self.name} {where}"
        return f"{self.name} only, {where}"

    def asked(self, twist: Array) -> str:
        """What a sheet asks for that means it, in base axes."""
        if self.rows != WHOLE:
            return f"{self.name} in base axes"
        if twist[3:].any():
            return self.name
        return f"{self.name}, with zero angular velocity"


def _readings(twist: Array, rows: Prescribed) -> Iterator[Reading]:
    """The strictest first: each is met by whoever meets one above it in the same axes."""
    likely = {rows, WHOLE}
    if twist[:3].any():
        likely.add(LINEAR)
    if twist[3:].any():
        likely.add(ANGULAR)
    axis = _axis(twist)
    if axis is not None:
        likely.add((axis,))

    # the asked one goes before others with as many rows
    for read in sorted(likely, key=lambda other: (-len(other), other != rows)):
        yield Reading(read, "base")
        yield Reading(read, "tool")


def _as_read(
    reading: Reading, block: Array, twist: Array, value: Array, rows: Prescribed
) -> Outcome:
    """What is said of rates that meet this reading, of which `rows` in base axes are the asked one.

    `block` (m, n) are the rows of J that the reading prescribes, in its axes.
    """
    least = pseudoinverse(block) @ twist[list(reading.rows)]
    is_least = bool(np.abs(value - least).max() <= SLACK * max(1.0, np.abs(least).max()))
    n = block.shape[1]
    is_free = bool(rank(block) < n)

    met = reading.met(twist)
    if is_least and is_free:
        met += ", with least norm"
    if reading == Reading(rows):
        if is_least or not is_free:
            return Outcome()  # how near the rates are is left to the tolerance
        asked = "the rates of least norm"
    else:
        asked = Reading(rows).asked(twist)
        if len(rows) < n:
            asked += ", with least norm"

    covers = reading.axes == "base" and set(rows) <= set(reading.rows)
    by_chance = len(reading.rows) == 1  # one component is met without meaning to
    share = 0.5 if covers and not by_chance else None
    return Outcome(reading=f"This meets {met}; the sheet asks for {asked}.", share=share)


def _axis(twist: Array) -> int | None:
    """The axis along which a twist is a mere translation, if there is one."""
    used = np.flatnonzero(twist)
    if len(used) != 1 or used[0] > 2:
        return None
    return int(used[0])
