# pyright: basic
"""The RRT robot of S3 5.4.1 in formulas: Jacobian, determinant of its linear rows, singular postures.

What follows from a student's own table or Jacobian is put together, not simplified: it is compared, never printed.
"""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from ...solutions.errors import KinegradeError
from ...solutions.expression import Expression, parse
from ...solutions.expression_array import POINTS, ExpressionArray, expression_array, sample
from ...solutions.robots import Robot
from ...solutions.table import Table

CELLS = tuple(f"{cell}{i}" for i in (1, 2, 3) for cell in ("theta", "d", "a", "alpha"))
VARIABLES = {"theta1": "q1", "theta2": "q2", "d3": "q3"}  # cells that hold a joint variable
ANY_ARM = Robot(
    name="rrt",
    title="RRT robot of any shape",
    parameters=dict.fromkeys((cell for cell in CELLS if cell not in VARIABLES), 1.0),
    rows=tuple(tuple(VARIABLES.get(cell, cell) for cell in CELLS[start : start + 4]) for start in (0, 4, 8)),
    limits=((-1.0, 1.0),) * 3,
    source="standard Denavit-Hartenberg convention",
)
ENTRIES = tuple(f"x{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))
DETERMINANT = parse(
    "x11*(x22*x33 - x23*x32) - x12*(x21*x33 - x23*x31) + x13*(x21*x32 - x22*x31)",
    ENTRIES,
)


class EasierError(KinegradeError):
    """Nothing follows from own formulas that leave hardly anything to find out."""


@lru_cache
def jacobian_formulas(arm: Robot) -> ExpressionArray:
    """The closed 6 x 3 Jacobian of an arm."""
    return expression_array(arm.symbolic().J, arm.names)


def jacobian_of_table(table: Table, arm: Robot) -> ExpressionArray:
    """The 6 x 3 Jacobian that follows from a table, the closed one from the arm's own. Raises EasierError."""
    closed = jacobian_formulas(arm)
    if table.rows == arm.table.rows:
        return closed
    cells = dict(zip(CELLS, (cell for row in table.rows for cell in row), strict=True))
    own = {VARIABLES.get(name, name): cell for name, cell in cells.items()}
    entries = tuple(put_in(entry, own) for entry in jacobian_formulas(ANY_ARM).entries)
    return _not_easier(ExpressionArray(entries, closed.shape), closed)


def determinant_of(J: ExpressionArray, arm: Robot) -> ExpressionArray:
    """Determinant of the linear rows of J (6, 3), as a product where J is the arm's own. Raises EasierError."""
    closed = determinant_formula(arm)
    if J is jacobian_formulas(arm):
        return closed
    entries = dict(zip(ENTRIES, J.entries[: len(ENTRIES)], strict=True))
    return _not_easier(ExpressionArray((put_in(DETERMINANT, entries),), ()), closed)


@lru_cache
def determinant_formula(arm: Robot) -> ExpressionArray:
    """Determinant of the linear rows, the product of what is zero in singular postures."""
    return expression_array(_product("-", arm, "sin(q2)"), arm.names)


@lru_cache
def determinant_by_elevation(arm: Robot) -> ExpressionArray:
    """The determinant where q2 is taken from the horizontal."""
    return expression_array(_product("", arm, "cos(q2)"), arm.names)


def singular_conditions(arm: Robot, across: str = "sin(q2)") -> tuple[str, str]:
    """What is zero in singular postures: the way from axis 2 to the hand, and how far it reaches from axis 1.

    `across` is the part of that way across axis 1. The offset d2 along axis 2 is in neither; without a1 the reach is
    zero where `across` is.
    """
    way = "q3 + l3" if "l3" in arm.parameters else "q3"
    if "a1" not in arm.parameters:
        return way, across
    return way, f"({way})*{across} {'-' if arm.rows[0][3] == 'pi/2' else '+'} a1"


def _product(sign: str, arm: Robot, across: str) -> str:
    way, reach = singular_conditions(arm, across)
    return f"{sign}({way})*({reach})" if "a1" in arm.parameters else f"{sign}({way})^2*{reach}"


@lru_cache
def turning_slide(arm: Robot) -> ExpressionArray:
    """The Jacobian with the axis of the slide in its angular rows, as if a slide turned the hand."""
    J = arm.symbolic().J.copy()
    J[3:, 2] = J[:3, 2]
    return expression_array(J, arm.names)


@lru_cache
def columns_of_frames(arm: Robot, *, late: int = 0, to_hand: bool = True) -> ExpressionArray:
    """The Jacobian with column i from frame i - 1 + late, and the way to the hand or only to the next frame."""
    import sympy

    frames: Any = arm.symbolic().frames
    columns: list[list[Any]] = []
    for i, kind in enumerate(arm.kinds):
        z, o = (frames[i + late][:3, column] for column in (2, 3))
        way = frames[-1 if to_hand else i + 1][:3, 3] - o
        columns.append([*z.cross(way).expand(), *z] if kind == "R" else [*z, 0, 0, 0])
    return expression_array(sympy.Matrix(columns).T, arm.names)


def put_in(formula: Expression, values: Mapping[str, Expression]) -> Expression:
    """A formula with other formulas in place of names."""
    nodes: list[Any] = []
    places: list[int] = []  # of the results of the formula's own nodes
    for node in formula.nodes:
        if node[0] == "s" and node[1] in values:
            inside = values[node[1]].nodes
            start = len(nodes)
            nodes += [_moved(inner, range(start, start + len(inside))) for inner in inside]
        else:
            nodes.append(_moved(node, places))
        places.append(len(nodes) - 1)
    return Expression(tuple(nodes))


def _moved(node: tuple[Any, ...], places: Sequence[int]) -> tuple[Any, ...]:
    return node if node[0] in ("n", "s") else (node[0], *(places[i] for i in node[1:]))


def _not_easier(own: ExpressionArray, closed: ExpressionArray) -> ExpressionArray:
    """Own formulas that come to at least half as many different numbers as the closed ones."""
    values = sample([*(own.names | closed.names)], POINTS)
    sizes = [np.unique(np.round(np.abs(formulas.at(values)), 6)) for formulas in (own, closed)]
    telling = [int(((size != 0) & (size != 1)).sum()) for size in sizes]
    if 2 * telling[0] < telling[1]:
        raise EasierError(f"own formulas come to {telling[0]} different numbers, the arm's own to {telling[1]}")
    return own
