"""Denavit-Hartenberg tables of formulas."""

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from .chain import (
    Array,
    Chain,
    configuration,
    from_modified,
    from_standard,
    modified_transform,
    standard_transform,
)
from .errors import KinegradeError
from .expression import Expression, ExpressionError, parse

Convention = Literal["standard", "modified"]
Row = tuple[Expression, Expression, Expression, Expression]
COLUMNS = ("theta", "d", "a", "alpha")
JOINT = re.compile(r"q[1-9][0-9]*")


class TableError(KinegradeError):
    """A table that describes no chain; `row` (from 1) and `column` name the cell where one is at fault."""

    def __init__(self, message: str, row: int = 0, column: str = "") -> None:
        place = f"row {row}{', ' * bool(column)}{column}: " if row else ""
        super().__init__(f"{place}{message}")
        self.message, self.row, self.column = message, row, column

    def __reduce__(self) -> tuple[type["TableError"], tuple[str, int, str]]:
        return TableError, (self.message, self.row, self.column)


@dataclass(frozen=True)
class Table:
    """Rows of four expressions theta, d, a, alpha; q_i stands in theta or d of row i."""

    rows: tuple[Row, ...]
    convention: Convention = "standard"

    def __post_init__(self) -> None:
        if self.convention not in ("standard", "modified"):
            raise TableError(f"convention takes 'standard' or 'modified', got {self.convention!r}")
        if not self.rows:
            raise TableError("a table takes one row for each joint, got none")

    @cached_property
    def kinds(self) -> str:
        """Joint types read off the place of q_i: "R" in theta, "P" in d. Raises TableError."""
        return "".join(_kind(i, row) for i, row in enumerate(self.rows, 1))

    def numbers(self, values: Mapping[str, ArrayLike]) -> Array:
        """Numbers (..., n, 4) of all cells; every name takes a value, joints too. Raises TableError."""
        cells = [
            [_value(i, c, row[c], values) for c in range(4)] for i, row in enumerate(self.rows, 1)
        ]
        return np.stack(
            [np.stack(np.broadcast_arrays(*row), axis=-1) for row in _alike(cells)], axis=-2
        )

    def chain(self, values: Mapping[str, float], tool: ArrayLike | None = None) -> Chain:
        """Chain with the parameters' values [rad, m]; joint values are not needed. Raises TableError."""
        kinds = self.kinds
        build = from_standard if self.convention == "standard" else from_modified
        return build(self.numbers({**values, **dict.fromkeys(self.joints, 0.0)}), kinds, tool=tool)

    def frames(
        self, values: Mapping[str, float], q: ArrayLike, tool: ArrayLike | None = None
    ) -> Array:
        """Frames (..., n + 1, 4, 4) in base coordinates as printed tables have them, at q (..., n) [rad, m].

        Standard: T_0^0 ... T_n^0. Modified: T_1^0 ... T_n^0 and the tool. A tool transform (4, 4) is in the last
        only. Raises TableError or ChainError.
        """
        joints = configuration(len(self.rows), q)
        numbers = self.numbers(
            {**values, **{name: joints[..., i] for i, name in enumerate(self.joints)}}
        )
        standard = self.convention == "standard"
        links = standard_transform(numbers) if standard else modified_transform(numbers)
        reached = [np.broadcast_to(np.eye(4), links[..., 0, :, :].shape)]
        for i in range(len(self.rows)):
            reached.append(reached[-1] @ links[..., i, :, :])
        last = reached[-1] if tool is None else reached[-1] @ np.asarray(tool, dtype=np.float64)
        return np.stack([*(reached[:-1] if standard else reached[1:]), last], axis=-3)

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joint variables, q1 ... qn."""
        return tuple(f"q{i}" for i in range(1, len(self.rows) + 1))


def read_table(
    cells: Sequence[Sequence[str | float]],
    names: Collection[str],
    convention: Convention = "standard",
) -> Table:
    """Table of typed cells (rows of theta, d, a, alpha) in `names`; TableError names the cell that is at fault."""
    table = Table(tuple(_read_row(i, row, names) for i, row in enumerate(cells, 1)), convention)
    _ = table.kinds
    return table


def _read_row(i: int, row: Sequence[str | float], names: Collection[str]) -> Row:
    if isinstance(row, str) or len(row) != 4:
        found = repr(row) if isinstance(row, str) else len(row)
        raise TableError(f"a row takes four cells theta, d, a, alpha, got {found}", i)
    theta, d, a, alpha = (
        _read_cell(i, column, cell, names) for column, cell in zip(COLUMNS, row, strict=True)
    )
    return theta, d, a, alpha


def _read_cell(i: int, column: str, cell: str | float, names: Collection[str]) -> Expression:
    try:
        return parse(cell if isinstance(cell, str) else _typed(float(cell)), names)
    except ExpressionError as error:
        raise TableError(f"{error.message}\n{error.caret}", i, column) from None
    except (TypeError, ValueError):
        raise TableError(
            f"a cell takes a formula or a number, got {type(cell).__name__}", i, column
        ) from None


def _typed(number: float) -> str:
    return "0" if abs(number) < 1e-12 else repr(number)  # cos(pi/2) of somebody's calculator


def _kind(i: int, row: Row) -> str:
    joint = f"q{i}"
    for column, cell in zip(COLUMNS, row, strict=True):
        if others := sorted(name for name in cell.names if JOINT.fullmatch(name) and name != joint):
            raise TableError(f"this row takes {joint} only, got {', '.join(others)}", i, column)
        if joint in cell.names and column in ("a", "alpha"):
            raise TableError(
                f"{joint} takes a place in theta (revolute) or d (prismatic)", i, column
            )
    held = [column for column in (0, 1) if joint in row[column].names]
    if len(held) != 1:
        found = "both" if held else "no joint variable"
        raise TableError(
            f"{joint} takes a place in theta (revolute) or d (prismatic), got {found}", i
        )
    if not _stands_alone(row[held[0]], joint):
        raise TableError(
            f"{joint} stands alone with factor 1, as in {joint} + offset, got {row[held[0]]}",
            i,
            COLUMNS[held[0]],
        )
    return "RP"[held[0]]


def _stands_alone(cell: Expression, joint: str) -> bool:
    """Whether the cell is the joint plus terms without it: only sums lie between the root and its one place."""
    place = len(cell.nodes) - 1
    holds = [False] * len(cell.nodes)
    for k, node in enumerate(cell.nodes):
        holds[k] = (
            node == ("s", joint) if node[0] in ("n", "s") else any(holds[int(j)] for j in node[1:])
        )
    while cell.nodes[place] != ("s", joint):
        operation, *arguments = cell.nodes[place]
        inside = [j for j in arguments if holds[j]]
        if len(inside) != 1 or not (
            operation == "+" or (operation == "-" and inside[0] == arguments[0])
        ):
            return False
        place = inside[0]
    return True


def _value(i: int, column: int, cell: Expression, values: Mapping[str, ArrayLike]) -> Array:
    try:
        value = np.asarray(cell.at(values), dtype=np.float64)
    except ExpressionError as error:
        raise TableError(error.message, i, COLUMNS[column]) from None
    if not np.isfinite(value).all():
        raise TableError(f"{cell} has no finite value for these numbers", i, COLUMNS[column])
    return value


def _alike(cells: list[list[Array]]) -> list[list[Array]]:
    shape = np.broadcast_shapes(*(cell.shape for row in cells for cell in row))
    return [[np.broadcast_to(cell, shape) for cell in row] for row in cells]
