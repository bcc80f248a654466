"""What a sheet says of an arm where the exercise says nothing of its own: joints, table or frames, and its figure."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...solutions.robot import Robot
from ..arm import Arm
from ..drawing import Drawing
from .printed_table import cell_latex, printed_table, table_rows, with_numbers

WORDS = {"R": "revolute", "P": "prismatic"}
AXIS = {"standard": r"\mathbf z_{i-1}", "modified": r"\mathbf z_i"}


def introduction(arm: Arm) -> str:
    """Joint types, the table or the transforms with numbers for lengths that were not drawn, and the ends."""
    fixed = {name: value for name, value in arm.robot.parameters.items() if name not in arm.lengths}
    described = (
        _transforms(arm.robot, fixed)
        if arm.robot.convention == "frames"
        else _table(arm.robot, fixed)
    )
    alike = len({*arm.kinds}) == 1
    joints = f"all joints {WORDS[arm.kinds[0]]}" if alike else joint_types(arm.kinds)
    return "\n\n".join([f"{arm.robot.title} ({joints}).", described, _ends(arm.robot, fixed)])


def joint_types(kinds: str) -> str:
    """Joint types such as "RRP" in words."""
    return ", ".join(f"joint {i} {WORDS[kind]}" for i, kind in enumerate(kinds, 1))


def drawn_arm(arm: Arm) -> Drawing:
    """The arm at the student's q with its base and tool frames."""
    joints = ", ".join(WORDS[kind] for kind in arm.kinds)
    alt = (
        f"{arm.robot.title}, its joints {joints} from the base on, drawn at your q with base and "
        "tool frame."
    )
    return arm.drawing("The arm at your q, with its base frame and its tool frame.", alt)


def off_the_drawing(arm: Arm) -> str:
    """The introduction where the table itself is asked: what fixes it is said and drawn instead."""
    convention = arm.robot.convention
    figures = (
        "The first figure shows it with all joint angles at zero, with frame 0, the tool frame, "
        "the "
        r"lengths and the positive sense of each joint; the second shows it at your $\mathbf q$."
    )
    convention_said = (
        f"Use the **{convention}** Denavit–Hartenberg convention, ${AXIS[convention]}$ along the "
        "axis of joint $i$ in "
        "its positive sense. The last frame is the tool frame that is drawn."
    )
    return f"{arm.robot.title}. {figures}\n\n{convention_said}"


def home_and_now(arm: Arm) -> tuple[Drawing, Drawing]:
    """The arm with its angles at zero and its lengths, and at the student's q."""
    joints = ", ".join(WORDS[kind] for kind in arm.kinds)
    alt = f"{arm.robot.title}, its joints {joints} from the base on. "
    home = arm.at([0.0 if kind == "R" else x for kind, x in zip(arm.kinds, arm.q, strict=True)])
    captions = (
        "The angles at zero, with the positive sense of each joint.",
        "The same arm at your q.",
    )
    first = home.drawing(captions[0], alt + captions[0], lengths=_lengths(home))
    return first, arm.drawing(captions[1], alt + captions[1], base="", tool="")


def _lengths(arm: Arm) -> dict[str, tuple[Any, Any]]:
    """Dimension lines of the lengths and strokes that stand alone in a cell of the table."""
    lines: dict[str, tuple[Any, Any]] = {}
    names = {*arm.robot.parameters, *arm.robot.joints}
    standard = arm.robot.convention == "standard"
    frames = arm.frames if standard else [np.eye(4), *arm.frames]
    for row, before, after in zip(arm.robot.rows, frames, frames[1:], strict=False):
        _, d, a, _ = (str(cell) for cell in row)
        start, end = before[:3, 3], after[:3, 3]
        # standard: first d along the old z, then a along the new x; modified: first a along the old x, then d
        if standard:
            corner = end - after[:3, 0] * ((end - start) @ after[:3, 0])
            found = {d: (start, corner), a: (corner, end)}
        else:
            corner = start + before[:3, 0] * ((end - start) @ before[:3, 0])
            found = {a: (start, corner), d: (corner, end)}
        lines |= {name: ends for name, ends in found.items() if name in names and name not in lines}
    return lines


def _table(robot: Robot, fixed: Mapping[str, float]) -> str:
    return (
        f"Its table in the **{robot.convention}** Denavit–Hartenberg convention (metres, "
        "radians), with "
        f"${AXIS[robot.convention]}$ along the axis of joint "
        f"$i$:\n\n{printed_table(table_rows(robot, fixed))}"
    )


def _transforms(robot: Robot, fixed: Mapping[str, float]) -> str:
    lines = [
        rf"- $\mathbf T_{{{i - 1}}}^{{{i}}} = {_motions(steps, fixed)}$"
        for i, steps in enumerate(robot.rows, 1)
    ]
    listed = "\n".join(lines)
    said = (
        r"Frame $i$ sits on the axis of joint $i$, with $\mathbf z_i$ along it. $T_x, T_y, T_z$ "
        "move along, and "
        r"$R_x, R_y, R_z$ turn about, an axis of the current frame:"
    )
    return f"{said}\n\n{listed}"


def _motions(steps: Sequence[Any], fixed: Mapping[str, float]) -> str:
    return r"\,".join(
        rf"{motion[0]}_{motion[1]}({cell_latex(with_numbers(str(amount), fixed))})"
        for motion, amount in steps
    )


def _ends(robot: Robot, fixed: Mapping[str, float]) -> str:
    reached = f"is frame {robot.n}"
    if robot.tool:
        reached = rf"is reached from frame {robot.n} by ${_motions(robot.tool, fixed)}$"
    return f"The base frame is frame 0. The tool frame {reached}; its origin is the tool point."
