"""The six rows of a Jacobian, a twist or a wrench on a sheet: their order, names and units.

The engine counts vx, vy, vz, wx, wy, wz from 0 and has the linear rows on top; a sheet may have the
angular ones there.
"""

from collections.abc import Sequence
from typing import Literal

from ..exercise import ExerciseError, Rows

Chosen = Literal["all", "linear", "angular", "task"] | Sequence[int]
"""Which rows are asked: a block, the rows of the robot's task, or rows of the engine."""
Prescribed = tuple[int, ...]
"""Indices of the rows of a twist that a wish prescribes."""
LINEAR: Prescribed = (0, 1, 2)
ANGULAR: Prescribed = (3, 4, 5)
WHOLE = LINEAR + ANGULAR
BLOCKS: dict[str, tuple[int, ...]] = {"linear": LINEAR, "angular": ANGULAR}
ORDERS: dict[Rows, tuple[int, ...]] = {
    "linear, angular": WHOLE,
    "angular, linear": ANGULAR + LINEAR,
}
WORDS: dict[Rows, str] = {
    "linear, angular": "linear rows above angular rows",
    "angular, linear": "angular rows above linear rows",
}

VELOCITIES = ("v_x", "v_y", "v_z", r"\omega_x", r"\omega_y", r"\omega_z")
LOADS = ("f_x", "f_y", "f_z", "m_x", "m_y", "m_z")
VELOCITY_UNITS = ("m/s", "m/s", "m/s", "rad/s", "rad/s", "rad/s")
LOAD_UNITS = ("N", "N", "N", "N m", "N m", "N m")
COLUMN_UNITS = {"R": "m/rad", "P": "1"}  # of linear rows, by joint type
RATE_UNITS = {"R": "rad/s", "P": "m/s"}
TORQUE_UNITS = {"R": "N m", "P": "N"}


def rows_on_sheet(chosen: Chosen, rows: Rows, task: Sequence[int]) -> list[int]:
    """Rows of the engine in the order of the sheet; `task` are those of the robot.

    Raises:
        ExerciseError: it names no rows.
    """
    if isinstance(chosen, str):
        blocks = {**BLOCKS, "all": range(6), "task": task}
        wanted = blocks.get(chosen, ())
    else:
        wanted = chosen

    found = [row for row in ORDERS[rows] if row in wanted]
    if not found or len(found) != len(wanted):
        raise ExerciseError(
            f"rows takes 'all', 'linear', 'angular', 'task' or some of 0 to 5, got {chosen!r}"
        )
    return found


def listed(symbols: Sequence[str], rows: Sequence[int]) -> str:
    """LaTeX of the names of rows, such as $(v_x, v_y)$."""
    names = ", ".join(symbols[row] for row in rows)
    return f"$({names})$"


def described(rows: Sequence[int], order: Rows) -> str:
    """What stands where: the words for all six rows, else the names of those that are asked."""
    if len(rows) == 6:
        return WORDS[order]
    return f"for {listed(VELOCITIES, rows)}"


def jacobian_units(rows: Sequence[int], kinds: str) -> list[list[str]]:
    """Units of J (m, n): metres a radian in a revolute column's linear rows, else plain numbers."""
    units: list[list[str]] = []
    for row in rows:
        if row in LINEAR:
            units.append([COLUMN_UNITS[kind] for kind in kinds])
        else:
            units.append(["1"] * len(kinds))
    return units


def twist_units(rows: Sequence[int]) -> list[str]:
    """Units of the rows of a twist."""
    return [VELOCITY_UNITS[row] for row in rows]


def wrench_units(rows: Sequence[int]) -> list[str]:
    """Units of the rows of a wrench."""
    return [LOAD_UNITS[row] for row in rows]


def rate_units(kinds: str) -> list[str]:
    """Units of joint rates."""
    return [RATE_UNITS[kind] for kind in kinds]


def torque_units(kinds: str) -> list[str]:
    """Units of joint torques, and of forces along slides."""
    return [TORQUE_UNITS[kind] for kind in kinds]
