"""What a sheet says of an arm where the exercise says nothing of its own, and its figure."""

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
    """Joint types, the table or the transforms, and the ends.

    Lengths that were not drawn stand there as numbers.
    """
    robot = arm.robot
    fixed = {name: value for name, value in robot.parameters.items() if name not in arm.lengths}
    joints = joint_types(arm.kinds)
    if len({*arm.kinds}) == 1:
        joints = f"all joints {WORDS[arm.kinds[0]]}"
    described = _transforms if robot.convention == "frames" else _table
    paragraphs = (f"{robot.title} ({joints}).", described(robot, fixed), _ends(robot, fixed))
    return "\n\n".join(paragraphs)


def joint_types(kinds: str) -> str:
    """Joint types such as "RRP" in words."""
    return ", ".join(f"joint {i} {WORDS[kind]}" for i, kind in enumerate(kinds, 1))


def drawn_arm(arm: Arm) -> Drawing:
    """The arm at the student's q with its base and tool frames."""
    alt = f"{_pictured(arm)}, drawn at your q with base and tool frame."
    return arm.drawing("The arm at your q, with its base frame and its tool frame.", alt)


def off_the_drawing(arm: Arm) -> str:
    """The introduction where the table itself is asked: what fixes it is said and drawn instead."""
    convention = arm.robot.convention
    figures = (
        "The first figure shows it with all joint angles at zero, with frame 0, the tool frame, "
        "the lengths and the positive sense of each joint; "
        r"the second shows it at your $\mathbf q$."
    )
    convention_said = (
        f"Use the **{convention}** Denavit–Hartenberg convention, ${AXIS[convention]}$ along the "
        "axis of joint $i$ in its positive sense. The last frame is the tool frame that is drawn."
    )
    return f"{arm.robot.title}. {figures}\n\n{convention_said}"


def home_and_now(arm: Arm) -> tuple[Drawing, Drawing]:
    """The arm with its angles at zero and its lengths, and at the student's q."""
    alt = f"{_pictured(arm)}. "

    slides = np.array([kind == "P" for kind in arm.kinds])
    home = arm.at(np.where(slides, arm.q, 0.0))
    at_zero = "The angles at zero, with the positive sense of each joint."
    first = home.drawing(at_zero, alt + at_zero, lengths=_lengths(home))

    at_q = "The same arm at your q."
    second = arm.drawing(at_q, alt + at_q, base="", tool="")
    return first, second


def _pictured(arm: Arm) -> str:
    """The arm in words, for who cannot see its figure."""
    joints = ", ".join(WORDS[kind] for kind in arm.kinds)
    return f"{arm.robot.title}, its joints {joints} from the base on"


def _lengths(arm: Arm) -> dict[str, tuple[Any, Any]]:
    """Dimension lines of the lengths and strokes that stand alone in a cell of the table."""
    names = {*arm.robot.parameters, *arm.robot.joints}
    is_standard = arm.robot.convention == "standard"
    frames = arm.frames if is_standard else [np.eye(4), *arm.frames]

    lines: dict[str, tuple[Any, Any]] = {}
    for row, before, after in zip(arm.robot.rows, frames, frames[1:], strict=False):
        _, d, a, _ = map(str, row)
        start, end = before[:3, 3], after[:3, 3]
        if is_standard:  # d along the old z, then a along the new x
            x = after[:3, 0]
            corner = end - x * ((end - start) @ x)
            found = {d: (start, corner), a: (corner, end)}
        else:  # a along the old x, then d along the new z
            x = before[:3, 0]
            corner = start + x * ((end - start) @ x)
            found = {a: (start, corner), d: (corner, end)}

        for name, ends in found.items():
            if name in names:
                lines.setdefault(name, ends)
    return lines


def _table(robot: Robot, fixed: Mapping[str, float]) -> str:
    said = (
        f"Its table in the **{robot.convention}** Denavit–Hartenberg convention (metres, radians), "
        f"with ${AXIS[robot.convention]}$ along the axis of joint $i$:"
    )
    return f"{said}\n\n{printed_table(table_rows(robot, fixed))}"


def _transforms(robot: Robot, fixed: Mapping[str, float]) -> str:
    lines: list[str] = []
    for i, steps in enumerate(robot.rows, 1):
        motions = _motions(steps, fixed)
        lines.append(rf"- $\mathbf T_{{{i - 1}}}^{{{i}}} = {motions}$")
    listed = "\n".join(lines)
    said = (
        r"Frame $i$ sits on the axis of joint $i$, with $\mathbf z_i$ along it. $T_x, T_y, T_z$ "
        r"move along, and $R_x, R_y, R_z$ turn about, an axis of the current frame:"
    )
    return f"{said}\n\n{listed}"


def _motions(steps: Sequence[Any], fixed: Mapping[str, float]) -> str:
    """LaTeX of motions such as Rz by q1, one behind the other."""
    factors: list[str] = []
    for (kind, axis), amount in steps:
        shown = cell_latex(with_numbers(str(amount), fixed))
        factors.append(f"{kind}_{axis}({shown})")
    return r"\,".join(factors)


def _ends(robot: Robot, fixed: Mapping[str, float]) -> str:
    reached = f"is frame {robot.n}"
    if robot.tool:
        reached = rf"is reached from frame {robot.n} by ${_motions(robot.tool, fixed)}$"
    return f"The base frame is frame 0. The tool frame {reached}; its origin is the tool point."
