"""A speed along an axis as a sheet wishes it: its text, and how the joint rates are found."""

from dataclasses import dataclass

import numpy as np

from ..arm import Array
from .twists import LINEAR, VELOCITIES, WHOLE, Prescribed

LETTERS = "xyz"
ORDINALS = ("first", "second", "third")


@dataclass(frozen=True)
class Speed:
    """A speed along a base axis (0, 1, 2), wished of `n` joints.

    All `rows` of the twist are prescribed, the linear ones, or its own alone. `symbol` is the speed
    in LaTeX.
    """

    n: int
    rows: Prescribed
    symbol: str = "v"
    axis: int = 0

    def twist(self, speed: float) -> Array:
        """The twist (6,) with that speed [m/s] and zeros, whether or not they are prescribed."""
        return speed * np.eye(6)[self.axis]

    @property
    def text(self) -> str:
        """What a sheet says of it."""
        if len(self.rows) == self.n:
            return self._wish
        return f"{self._wish} {self._least}"

    @property
    def _wish(self) -> str:
        own, letter = VELOCITIES[self.axis], LETTERS[self.axis]
        others = [symbol for symbol in VELOCITIES if symbol != own]
        listed = ", ".join(others)
        if self.rows == WHOLE:
            return (
                f"The tool moves along base ${letter}$ with the speed ${self.symbol}$ and its "
                "orientation is **held**: the other five components of the twist, "
                f"${listed}$, are zero."
            )

        if self.rows == LINEAR:
            zeros, free = " = ".join(others[:2]), ", ".join(others[2:])
            return (
                f"The tool point moves along base ${letter}$ with the speed ${self.symbol}$, so "
                f"that ${zeros} = 0$, and its orientation is **free**: ${free}$ are not prescribed."
            )
        return f"**Only** ${own} = {self.symbol}$ is prescribed; ${listed}$ are free."

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
        if self.rows == WHOLE:
            block, wanted = r"\mathbf J", r"\boldsymbol\xi"
            said = rf"All six components are prescribed, ${wanted} = ({self._components})$."
        else:
            block, wanted = r"\mathbf J_v", r"\mathbf v"
            said = (
                rf"Let ${block}$ be the three linear rows of $\mathbf J$ and "
                rf"${wanted} = ({self._components})$."
            )

        if len(self.rows) == self.n:
            return (
                rf"{said} ${block}$ is square with full rank, so "
                rf"$\dot{{\mathbf q}} = {block}^{{-1}} {wanted}$."
            )
        return (
            rf"{said} There are more joints than rows; the rates of least norm are "
            rf"$\dot{{\mathbf q}} = {block}^{{+}} {wanted}$ with "
            rf"${block}^{{+}} = {block}^{{T}} ({block} {block}^{{T}})^{{-1}}$."
        )

    @property
    def _components(self) -> str:
        """Those of the prescribed rows, with the symbol at its place."""
        components = ["0"] * len(self.rows)
        components[self.rows.index(self.axis)] = self.symbol
        return ", ".join(components)

    @property
    def _of_one_row(self) -> str:
        row = rf"\mathbf J_{LETTERS[self.axis]}"
        return (
            rf"Let ${row}$ be the {ORDINALS[self.axis]} row of $\mathbf J$; only "
            rf"${row} \dot{{\mathbf q}} = {self.symbol}$ is prescribed. There are more joints "
            r"than rows; the rates of least norm are "
            rf"$\dot{{\mathbf q}} = {row}^{{+}} {self.symbol}$ with "
            rf"${row}^{{+}} = {row}^{{T}} / ({row} {row}^{{T}})$: "
            rf"${row} {row}^{{T}}$ is a number."
        )
