"""A chain as a Denavit-Hartenberg table: along common normals from axis to axis, up to the tool."""

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from .chain import Array, Chain, standard_transform
from .expression import parse
from .kinematics import frames
from .rotation import inverse_transform

Row = tuple[str, str, str, str]  # theta, d, a, alpha
QUARTER = np.pi / 4


@dataclass(frozen=True)
class NamedTable:
    """Rows of theta, d, a, alpha in the names of `parameters` [m, rad].

    `tool` are the motions left from the last row to the tool.
    """

    rows: list[Row] = field(default_factory=list[Row])
    tool: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    parameters: dict[str, float] = field(default_factory=dict[str, float])


def named_table(chain: Chain, tolerance: float) -> NamedTable:
    """The standard table of a chain from its first transform on, every length and angle by a name.

    Lengths and angles within the `tolerance` [of the arm's length, rad] of zero are zero, angles
    that near a multiple of pi/4 are that.
    """
    table = NamedTable()
    F = frames(chain, np.zeros(chain.n))
    small = tolerance * float(np.abs(chain.fixed[:, :3, 3]).max())

    def named(letter: str, place: int, amount: float) -> str:
        near = _exact(amount, small) if letter in "da" else _exact_angle(amount, tolerance)
        if near is not None:
            return near
        name = f"{letter}{place}"
        table.parameters[name] = amount
        return name

    reached = F[0]
    for place, (here, kind) in enumerate(zip(pairwise(F), chain.kinds, strict=True), 1):
        is_last = place == chain.n
        numbers = _row(reached, here[1], tolerance, small, is_last=is_last)
        row = _written(place, kind, numbers, named)
        table.rows.append(row)
        reached = reached @ standard_transform(_values(table, row, place))

    left = inverse_transform(reached) @ F[-1]
    turn = named("theta", chain.n + 1, float(np.arctan2(left[1, 0], left[0, 0])))
    along = named("d", chain.n + 1, float(left[2, 3]))
    table.tool.extend(step for step in (("Rz", turn), ("Tz", along)) if step[1] != "0")
    return table


def _row(
    reached: Array, following: Array, tolerance: float, small: float, *, is_last: bool
) -> tuple[float, float, float, float]:
    """theta, d, a and alpha from a frame (4, 4) to the next z axis, by their common normal.

    Parallel axes have many: the one through the frame's origin is taken, behind the last joint the
    one through the tool.
    """
    x_before, z, origin = reached[:3, 0], reached[:3, 2], reached[:3, 3]
    w, gap = following[:3, 2], following[:3, 3] - origin
    normal = np.cross(z, w)
    sine = float(np.linalg.norm(normal))
    if sine > tolerance:
        x = normal / sine
        d = float(np.dot(np.cross(gap, w), normal)) / sine**2
    else:
        d = float(gap @ z) if is_last else 0.0
        across = gap - z * float(gap @ z)
        distance = float(np.linalg.norm(across))
        x = across / distance if distance > small else x_before

    # of both directions the one that turns the frame least
    if x @ x_before < -tolerance:
        x = -x
    theta = float(np.arctan2(np.cross(x_before, x) @ z, x_before @ x))
    alpha = float(np.arctan2(np.cross(z, w) @ x, z @ w))
    return theta, d, float(gap @ x), alpha


def _written(
    place: int,
    kind: str,
    numbers: tuple[float, float, float, float],
    named: Callable[[str, int, float], str],
) -> Row:
    letters = ("theta", "d", "a", "alpha")
    cells = [named(x, place, number) for x, number in zip(letters, numbers, strict=True)]
    moving = 0 if kind == "R" else 1
    rest = cells[moving]
    if rest == "0":
        cells[moving] = f"q{place}"
    else:
        cells[moving] = f"q{place} + {rest}".replace("+ -", "- ")
    theta, d, a, alpha = cells
    return theta, d, a, alpha


def _values(table: NamedTable, row: Row, place: int) -> list[float]:
    """The cells of a row as numbers, at q = 0."""
    values = {**table.parameters, f"q{place}": 0.0}
    return [float(parse(cell, values).at(values)) for cell in row]


def _exact(amount: float, small: float) -> str | None:
    """A 0 for what is nothing, else None."""
    return "0" if abs(amount) <= small else None


def _exact_angle(amount: float, tolerance: float) -> str | None:
    """A multiple of pi/4 where an angle is one, else None."""
    quarters = round(amount / QUARTER)
    if abs(amount - quarters * QUARTER) > tolerance:
        return None
    written = {0: "0", 1: "pi/4", 2: "pi/2", 3: "3*pi/4", 4: "pi"}[abs(quarters)]
    return f"-{written}" if quarters < 0 else written
