"""Denavit-Hartenberg tables of formulas."""

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
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
ROUNDED = 1e-12  # what is smaller in a typed number is 0: cos(pi/2) of somebody's calculator


class TableError(KinegradeError):
    """A table that describes no chain; `row` (from 1) and `column` name the cell at fault."""

    def __init__(self, message: str, row: int = 0, column: str = "") -> None:
        place = ""
        if row and column:
            place = f"row {row}, {column}: "
        elif row:
            place = f"row {row}: "

        super().__init__(place + message)
        self.message = message
        self.row = row
        self.column = column

    def __reduce__(self) -> tuple[type["TableError"], tuple[str, int, str]]:
        return TableError, (self.message, self.row, self.column)


@dataclass(frozen=True)
class Table:
    """Rows of four expressions theta, d, a, alpha; q_i stands in theta or d of row i.

    Raises TableError without rows or with an unknown convention.
    """

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

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joint variables, q1 ... qn."""
        return joint_names(len(self.rows))

    def numbers(self, values: Mapping[str, ArrayLike]) -> Array:
        """Numbers (..., n, 4) of all cells; every name takes a value, joints too.

        Raises TableError.
        """
        cells = list[Array]()
        for i, row in enumerate(self.rows, 1):
            for column, cell in zip(COLUMNS, row, strict=True):
                cells.append(_value(i, column, cell, values))

        stacked = np.stack(np.broadcast_arrays(*cells), axis=-1)
        return stacked.reshape((*stacked.shape[:-1], len(self.rows), 4))

    def chain(self, values: Mapping[str, float], tool: ArrayLike | None = None) -> Chain:
        """Chain with the parameters' values [rad, m]; joint values are not needed.

        Raises TableError.
        """
        kinds = self.kinds
        numbers = self.numbers({**values, **dict.fromkeys(self.joints, 0.0)})
        if self.convention == "standard":
            return from_standard(numbers, kinds, tool=tool)
        return from_modified(numbers, kinds, tool=tool)

    def frames(
        self, values: Mapping[str, float], q: ArrayLike, tool: ArrayLike | None = None
    ) -> Array:
        """Frames (..., n + 1, 4, 4) in base coordinates as printed tables have them.

        At q (..., n) [rad, m]. Standard: T_0^0 ... T_n^0. Modified: T_1^0 ... T_n^0 and the tool.
        A tool transform (4, 4) is in the last only. Raises TableError or ChainError.
        """
        joints = configuration(len(self.rows), q)
        numbers = self.numbers({**values, **joint_values(joints)})
        if self.convention == "standard":
            links = np.moveaxis(standard_transform(numbers), -3, 0)
        else:
            links = np.moveaxis(modified_transform(numbers), -3, 0)

        base = np.broadcast_to(np.eye(4), links[0].shape)
        return printed_frames(self.convention, base, links, tool)


def joint_names(n: int) -> tuple[str, ...]:
    """Names of n joint variables, q1 ... qn."""
    return tuple(f"q{i}" for i in range(1, n + 1))


def joint_values(q: Array) -> dict[str, Array]:
    """Values (...) [rad, m] of the joint variables by their names, of q (..., n)."""
    n = q.shape[-1]
    return dict(zip(joint_names(n), np.moveaxis(q, -1, 0), strict=True))


def printed_frames(
    convention: str, base: Array, links: Iterable[Array], tool: ArrayLike | None
) -> Array:
    """Frames (..., n + 1, 4, 4) in base coordinates, as sources of that convention print them.

    `base` and each of the n `links` (..., 4, 4) lead to the next frame, `tool` from the last one to
    the tool. With the standard convention the first n frames are before their links, with all
    others behind them.
    """
    reached = list(accumulate(links, np.matmul, initial=base))
    last = reached[-1]
    if tool is not None:
        last = last @ np.asarray(tool, dtype=np.float64)

    axes = reached[1:]
    if convention == "standard":
        axes = reached[:-1]
    return np.stack([*axes, last], axis=-3)


def read_table(
    cells: Sequence[Sequence[str | float]],
    names: Collection[str],
    convention: Convention = "standard",
) -> Table:
    """Table of typed cells (rows of theta, d, a, alpha) in `names`.

    Raises TableError, which names the cell that is at fault.
    """
    rows = tuple(_read_row(i, row, names) for i, row in enumerate(cells, 1))
    table = Table(rows, convention)
    _ = table.kinds  # raises where a row has no joint
    return table


def _read_row(i: int, row: Sequence[str | float], names: Collection[str]) -> Row:
    expected = "a row takes four cells theta, d, a, alpha"
    if isinstance(row, str):
        raise TableError(f"{expected}, got {row!r}", i)
    if len(row) != 4:
        raise TableError(f"{expected}, got {len(row)}", i)

    cells = zip(COLUMNS, row, strict=True)
    theta, d, a, alpha = [_read_cell(i, column, cell, names) for column, cell in cells]
    return theta, d, a, alpha


def _read_cell(i: int, column: str, cell: str | float, names: Collection[str]) -> Expression:
    try:
        return parse(_typed(cell), names)
    except ExpressionError as error:
        raise TableError(f"{error.message}\n{error.caret}", i, column) from None
    except (TypeError, ValueError):
        raise TableError(
            f"a cell takes a formula or a number, got {type(cell).__name__}", i, column
        ) from None


def _typed(cell: str | float) -> str:
    if isinstance(cell, str):
        return cell
    number = float(cell)
    if abs(number) < ROUNDED:
        return "0"
    return repr(number)


def _kind(i: int, row: Row) -> str:
    """Type of joint i, whose variable stands in theta or in d of its row and nowhere else."""
    joint = f"q{i}"
    expected = f"{joint} takes a place in theta (revolute) or d (prismatic)"
    _check_joints(joint, i, row, expected)

    theta, d, _, _ = row
    turns = joint in theta.names
    slides = joint in d.names
    if turns and slides:
        raise TableError(f"{expected}, got both", i)
    if turns:
        _check_alone(joint, i, "theta", theta)
        return "R"
    if slides:
        _check_alone(joint, i, "d", d)
        return "P"
    raise TableError(f"{expected}, got no joint variable", i)


def _check_joints(joint: str, i: int, row: Row, expected: str) -> None:
    """Raise TableError where a row holds another joint's variable, or its own in a or alpha."""
    for column, cell in zip(COLUMNS, row, strict=True):
        found = {name for name in cell.names if JOINT.fullmatch(name)}
        others = sorted(found - {joint})
        if others:
            raise TableError(f"this row takes {joint} only, got {', '.join(others)}", i, column)
        if joint in found and column in ("a", "alpha"):
            raise TableError(expected, i, column)


def _check_alone(joint: str, i: int, column: str, cell: Expression) -> None:
    if not _stands_alone(cell, joint):
        raise TableError(
            f"{joint} stands alone with factor 1, as in {joint} + offset, got {cell}", i, column
        )


def _stands_alone(cell: Expression, joint: str) -> bool:
    """Whether the cell is the joint plus terms without it.

    Then only sums, and differences on their left, lie between the root and its one place.
    """
    holds = _holding(cell, joint)
    place = len(cell.nodes) - 1
    while cell.nodes[place] != ("s", joint):
        operation, *arguments = cell.nodes[place]
        inside = [argument for argument in arguments if holds[argument]]
        if len(inside) != 1 or operation not in ("+", "-"):
            return False
        if operation == "-" and inside[0] != arguments[0]:
            return False
        place = inside[0]
    return True


def _holding(cell: Expression, joint: str) -> list[bool]:
    """Whether the joint's variable occurs in each node or below it."""
    holds = list[bool]()
    for node in cell.nodes:
        if node[0] in ("n", "s"):
            holds.append(node == ("s", joint))
        else:
            holds.append(any(holds[int(argument)] for argument in node[1:]))
    return holds


def _value(i: int, column: str, cell: Expression, values: Mapping[str, ArrayLike]) -> Array:
    try:
        value = np.asarray(cell.at(values), dtype=np.float64)
    except ExpressionError as error:
        raise TableError(error.message, i, column) from None
    if not np.isfinite(value).all():
        raise TableError(f"{cell} has no finite value for these numbers", i, column)
    return value
