"""The arms of the literature by their names; their data stand in the files of arms."""

from .positioning_arms import PLANAR, POSITIONING
from .robot import Factor, Motion, Robot, RobotError, unknown
from .wristed_arms import WRISTED

__all__ = ["ROBOTS", "Factor", "Motion", "Robot", "RobotError", "robot"]

ROBOTS: dict[str, Robot] = {arm.name: arm for arm in (*PLANAR, *POSITIONING, *WRISTED)}


def robot(name: str) -> Robot:
    """Robot of that name; RobotError lists the valid ones."""
    if name not in ROBOTS:
        raise RobotError(unknown("robot", name, ROBOTS))
    return ROBOTS[name]
