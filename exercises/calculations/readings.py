r"""Joint rates for a wished velocity, and the ways in which such a wish is read.

"2 m/s along x" may prescribe the whole twist with its zeros, the linear velocity alone or one component of it, along an
axis of the base or of the tool. Each leads to other joint rates. A sheet says which of them is meant, and who answers
another one is told which it was.

J (6, n) and twists (6,) have linear rows above angular ones, in base axes at the tool point. `rows` are the indices of
those rows that are prescribed; where they are fewer than the joints, the rates of least norm are asked.
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

Prescribed = tuple[int, ...]
WHOLE: Prescribed = (0, 1, 2, 3, 4, 5)
LINEAR: Prescribed = (0, 1, 2)
ANGULAR: Prescribed = (3, 4, 5)
SLACK = 0.01  # of the largest component of the wish: a velocity this near is meant
LETTERS = "xyz"
SYMBOLS = ("v_x", "v_y", "v_z", r"\omega_x", r"\omega_y", r"\omega_z")
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
    "These come from J transposed in place of its inverse or pseudoinverse; put them into J and look at the velocity "
    "they give."
)


def rates_for(J: Array, twist: Array, rows: Prescribed = WHOLE) -> Array:
    """Joint rates (n,) for the prescribed rows of a twist: those that are unique, or those of least norm.

    Raises:
        LinAlgError: there are as many rows as joints, and they are singular.
    """
    block, wanted = J[list(rows)], twist[list(rows)]
    if len(rows) == J.shape[1]:
        return np.linalg.solve(block, wanted)
    return pseudoinverse(block) @ wanted


def judged_rates(
    J: Array, R: Array, twist: Array, value: Array, rows: Prescribed = WHOLE, *, decimals: int = 4
) -> Outcome:
    """Right by the velocity that is reached where the rates are unique; else the reading of the question is named.

    `R` (3, 3) are the axes of the tool, `decimals` those that are asked of the rates `value` (n,). Half of the points
    go to rates that reach what is prescribed, or more, in base axes, and are not those of least norm.
    """
    n = J.shape[1]
    allowed = SLACK * np.abs(twist).max()
    if len(rows) >= n:
        rounding = 0.75 * 10.0**-decimals * (np.abs(J).sum(axis=1) + np.abs(value).sum())
        if _reaches(J, value, twist, rows, np.minimum(rounding, allowed)):
            return Outcome(right=np.ones(n, dtype=bool))
    turned = {"base": J, "tool": in_axes(J, R)}
    for reading in _readings(twist, rows):
        if _reaches(turned[reading.axes], value, twist, reading.rows, np.full(6, allowed)):
            return _as_read(reading, turned[reading.axes], twist, value, rows)
    return Outcome()


def _reaches(J: Array, value: Array, twist: Array, rows: Prescribed, allowed: Array) -> bool:
    chosen = list(rows)
    return meets(J[chosen], value, twist[chosen], allowed[chosen])


@dataclass(frozen=True)
class Reading:
    """Which rows of a twist a wish prescribes, and in which axes."""

    rows: Prescribed
    axes: Literal["base", "tool"] = "base"

    @property
    def name(self) -> str:
        """Its rows in words."""
        return NAMES.get(self.rows) or "the components " + ", ".join(
            COMPONENTS[row] for row in self.rows
        )

    def met(self, twist: Array) -> str:
        """What rates meet that answer it."""
        only = "" if self.rows == WHOLE else " only,"
        if self.axes == "tool":
            axis = _axis(twist)
            where = (
                "in the axes of the tool"
                if axis is None
                else f"along the {LETTERS[axis]} axis of the tool"
            )
            return f"{self.name}{only} {where}"
        return self.asked(twist) if self.rows == WHOLE else f"{self.name} only"

    def asked(self, twist: Array) -> str:
        """What a sheet asks for that means it, in base axes."""
        if self.rows != WHOLE:
            return f"{self.name} in base axes"
        return self.name if twist[3:].any() else f"{self.name}, with zero angular velocity"


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
    for read in sorted(likely, key=lambda other: (-len(other), other != rows)):
        yield Reading(read, "base")
        yield Reading(read, "tool")


def _as_read(reading: Reading, J: Array, twist: Array, value: Array, rows: Prescribed) -> Outcome:
    """What is said of rates that meet this reading, of which `rows` in base axes are the asked one."""
    block, wanted = J[list(reading.rows)], twist[list(reading.rows)]
    least = pseudoinverse(block) @ wanted
    is_least = bool(np.abs(value - least).max() <= SLACK * max(1.0, np.abs(least).max()))
    is_free = bool(rank(block) < J.shape[1])
    as_asked = reading == Reading(rows)
    if as_asked and (is_least or not is_free):
        return Outcome()  # how near the rates are is left to the tolerance
    met = reading.met(twist)
    if is_least and is_free:
        met += ", with least norm"
    asked = "the rates of least norm" if as_asked else Reading(rows).asked(twist)
    if not as_asked and len(rows) < J.shape[1]:
        asked += ", with least norm"
    covers = reading.axes == "base" and set(rows) <= set(reading.rows)
    share = 0.5 if covers and len(reading.rows) > 1 else None  # one component is met by chance
    return Outcome(reading=f"This meets {met}; the sheet asks for {asked}.", share=share)


def _axis(twist: Array) -> int | None:
    """The axis along which a twist is a mere translation, if there is one."""
    used = np.flatnonzero(twist)
    return int(used[0]) if len(used) == 1 and used[0] < 3 else None


@dataclass(frozen=True)
class Speed:
    """A speed along a base axis (0, 1, 2), wished of `n` joints: all rows are prescribed, the linear ones, or its own.

    `symbol` is the speed in LaTeX.
    """

    n: int
    rows: Prescribed
    symbol: str = "v"
    axis: int = 0

    def twist(self, speed: float) -> Array:
        """The twist (6,) with that speed and zeros [m/s, rad/s], whether or not they are prescribed."""
        return speed * np.eye(6)[self.axis]

    @property
    def text(self) -> str:
        """What a sheet says of it."""
        own, letter = SYMBOLS[self.axis], LETTERS[self.axis]
        others = [symbol for symbol in SYMBOLS if symbol != own]
        if self.rows == WHOLE:
            said = (
                f"The tool moves along base ${letter}$ with the speed ${self.symbol}$ and its orientation is **held**: "
                f"the other five components of the twist, ${', '.join(others)}$, are zero."
            )
        elif self.rows == LINEAR:
            said = (
                f"The tool point moves along base ${letter}$ with the speed ${self.symbol}$, so that "
                f"${' = '.join(others[:2])} = 0$, and its orientation is **free**: ${', '.join(others[2:])}$ are not "
                "prescribed."
            )
        else:
            said = (
                f"**Only** ${own} = {self.symbol}$ is prescribed; ${', '.join(others)}$ are free."
            )
        return said if len(self.rows) == self.n else f"{said} {self._least}"

    @property
    def _least(self) -> str:
        return (
            r"Of all joint rates that do this, find those of least norm, that is with the smallest "
            rf"$\dot q_1^2 + \cdots + \dot q_{self.n}^2$."
        )

    @property
    def solution(self) -> str:
        """How the rates are found, in a worked solution."""
        if len(self.rows) == 1:
            return self._of_one_row
        components = ", ".join(self.symbol if row == self.axis else "0" for row in self.rows)
        if self.rows == WHOLE:
            block, wanted = r"\mathbf J", r"\boldsymbol\xi"
            said = rf"All six components are prescribed, ${wanted} = ({components})$."
        else:
            block, wanted = r"\mathbf J_v", r"\mathbf v"
            said = rf"Let ${block}$ be the three linear rows of $\mathbf J$ and ${wanted} = ({components})$."
        if len(self.rows) == self.n:
            return rf"{said} ${block}$ is square with full rank, so $\dot{{\mathbf q}} = {block}^{{-1}} {wanted}$."
        return (
            rf"{said} There are more joints than rows; the rates of least norm are $\dot{{\mathbf q}} = {block}^{{+}} "
            rf"{wanted}$ with ${block}^{{+}} = {block}^{{T}} ({block} {block}^{{T}})^{{-1}}$ (S3 5.2.1)."
        )

    @property
    def _of_one_row(self) -> str:
        row = rf"\mathbf J_{LETTERS[self.axis]}"
        return (
            rf"Let ${row}$ be the {('first', 'second', 'third')[self.axis]} row of $\mathbf J$; only "
            rf"${row} \dot{{\mathbf q}} = {self.symbol}$ is prescribed. There are more joints than rows; the rates of "
            rf"least norm are $\dot{{\mathbf q}} = {row}^{{+}} {self.symbol}$ with ${row}^{{+}} = {row}^{{T}} / "
            rf"({row} {row}^{{T}})$ (S3 5.2.1): ${row} {row}^{{T}}$ is a number."
        )
