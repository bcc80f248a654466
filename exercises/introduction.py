"""What a sheet says of an arm where the exercise says nothing of its own: joints, table or frames, and its figure."""

from collections.abc import Sequence
from typing import Any

from ..solutions.robot import Robot
from .arm import Arm
from .drawing import Drawing
from .printed_table import cell_latex, printed_table, table_rows

WORDS = {"R": "revolute", "P": "prismatic"}
AXIS = {"standard": r"\mathbf z_{i-1}", "modified": r"\mathbf z_i"}


def introduction(arm: Arm) -> str:
    """Joint types, the table or the transforms with numbers for lengths that were not drawn, and the ends."""
    described = _transforms(arm.robot) if arm.robot.convention == "frames" else _table(arm)
    return "\n\n".join([f"{arm.robot.title} ({joint_types(arm.kinds)}).", described, _ends(arm.robot)])


def joint_types(kinds: str) -> str:
    """Joint types such as "RRP" in words."""
    return ", ".join(f"joint {i} {WORDS[kind]}" for i, kind in enumerate(kinds, 1))


def drawn_arm(arm: Arm) -> Drawing:
    """The arm at the student's q with its base and tool frames."""
    joints = ", ".join(WORDS[kind] for kind in arm.kinds)
    alt = f"{arm.robot.title}, its joints {joints} from the base on, drawn at your q with base and tool frame."
    return arm.drawing("The arm at your q, with its base frame and its tool frame.", alt)


def _table(arm: Arm) -> str:
    fixed = {name: value for name, value in arm.robot.parameters.items() if name not in arm.lengths}
    convention = arm.robot.convention
    return (
        f"Its table in the **{convention}** Denavit–Hartenberg convention (metres, radians), with ${AXIS[convention]}$ "
        f"along the axis of joint $i$:\n\n{printed_table(table_rows(arm.robot, fixed))}"
    )


def _transforms(robot: Robot) -> str:
    lines = [rf"- $\mathbf T_{{{i - 1}}}^{{{i}}} = {_motions(steps)}$" for i, steps in enumerate(robot.rows, 1)]
    listed = "\n".join(lines)
    return (
        r"Frame $i$ sits on the axis of joint $i$, with $\mathbf z_i$ along it. $T_x, T_y, T_z$ move along, and "
        r"$R_x, R_y, R_z$ turn about, an axis of the current frame:\n\n" + listed
    )


def _motions(steps: Sequence[Any]) -> str:
    return r"\,".join(rf"{motion[0]}_{motion[1]}({cell_latex(str(amount))})" for motion, amount in steps)


def _ends(robot: Robot) -> str:
    reached = f"is frame {robot.n}"
    if robot.tool:
        reached = rf"is reached from frame {robot.n} by ${_motions(robot.tool)}$"
    return f"The base frame is frame 0. The tool frame {reached}; its origin is the tool point."
