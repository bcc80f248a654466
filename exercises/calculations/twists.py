"""The six rows of a Jacobian, a twist or a wrench as a sheet has them: their order, names and units.

The engine counts vx, vy, vz, wx, wy, wz from 0 and has the linear rows on top; a sheet may have the angular ones there.
"""

from collections.abc import Sequence
from typing import Literal

from ..exercise import ExerciseError, Rows

Chosen = Literal["all", "linear", "angular", "task"] | Sequence[int]
"""Which rows are asked: a block, the rows of the robot's task, or rows of the engine."""
BLOCKS: dict[str, tuple[int, ...]] = {"linear": (0, 1, 2), "angular": (3, 4, 5)}
ORDERS: dict[Rows, tuple[int, ...]] = {
    "linear, angular": (0, 1, 2, 3, 4, 5),
    "angular, linear": (3, 4, 5, 0, 1, 2),
}
WORDS: dict[Rows, str] = {
    "linear, angular": "linear rows above angular rows",
    "angular, linear": "angular rows above linear rows",
}
VELOCITIES = ("v_x", "v_y", "v_z", r"\omega_x", r"\omega_y", r"\omega_z")
LOADS = ("f_x", "f_y", "f_z", "m_x", "m_y", "m_z")


def rows_on_sheet(chosen: Chosen, rows: Rows, task: Sequence[int]) -> list[int]:
    """Rows of the engine in the order of the sheet; `task` are those of the robot.

    Raises:
        ExerciseError: it names no rows.
    """
    blocks = {**BLOCKS, "all": range(6), "task": task}
    wanted = blocks.get(chosen, ()) if isinstance(chosen, str) else chosen
    found = [row for row in ORDERS[rows] if row in wanted]
    if not found or len(found) != len(wanted):
        raise ExerciseError(
            f"rows takes 'all', 'linear', 'angular', 'task' or some of 0 to 5, got {chosen!r}"
        )
    return found


def listed(symbols: Sequence[str], rows: Sequence[int]) -> str:
    """LaTeX of the names of rows, such as $(v_x, v_y)$."""
    return f"$({', '.join(symbols[row] for row in rows)})$"


def described(rows: Sequence[int], order: Rows) -> str:
    """What stands where: the words for all six rows, else the names of those that are asked."""
    if len(rows) == 6:
        return WORDS[order]
    return f"for {listed(VELOCITIES, rows)}"


def jacobian_units(rows: Sequence[int], kinds: str) -> list[list[str]]:
    """Units of J (m, n): metres a radian for a revolute column's linear rows, plain numbers elsewhere."""
    return [["m/rad" if row < 3 and kind == "R" else "1" for kind in kinds] for row in rows]


def twist_units(rows: Sequence[int]) -> list[str]:
    """Units of the rows of a twist."""
    return ["m/s" if row < 3 else "rad/s" for row in rows]


def wrench_units(rows: Sequence[int]) -> list[str]:
    """Units of the rows of a wrench."""
    return ["N" if row < 3 else "N m" for row in rows]


def rate_units(kinds: str) -> list[str]:
    """Units of joint rates."""
    return ["rad/s" if kind == "R" else "m/s" for kind in kinds]


def torque_units(kinds: str) -> list[str]:
    """Units of joint torques, and of forces along slides."""
    return ["N m" if kind == "R" else "N" for kind in kinds]
