"""From the drawing to the table, and from the table to the frames."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...solutions.equivalence import ALL_GIVEN, Given
from ...solutions.table import Table
from ..answers import Numbers, TableOf
from ..arm import Arm, Array
from ..contract.question import Question, Wrong
from ..exercise import ExerciseError
from ..part import Ready, Setting

POSE = [["1", "1", "1", "m"]] * 3 + [["1"] * 4]
ON_AXIS = 1e-9  # [rad, m]
EITHER_AXIS = r"In the standard convention $\mathbf z_{i-1}$, in the modified one $\mathbf z_i$"
AXIS = {"standard": r"\mathbf z_{i-1}", "modified": r"\mathbf z_i"}
TABLE = r"""The Denavit–Hartenberg table: one row $[\theta_i, d_i, a_i, \alpha_i]$ per joint, as
text in the names of your lengths and q1, q2 ..., for instance `['q1 + pi', 0.25, 'd1', 'pi/3']`, or
as numbers at your $\mathbf q$ (radians, metres); the frames between the drawn ones may stand in any
way that describes this arm

- Which way does the positive arrow of each joint make its axis point?
- A prismatic joint's variable stands in the column d.

@axis@ lies along the axis of joint $i$, in its positive sense. Then $d_i$ and $\theta_i$ are
measured along and about $\mathbf z$, $a_i$ and $\alpha_i$ along and about $\mathbf x$. The columns
are $\theta_i, d_i, a_i, \alpha_i$:
$$\mathrm{DH} = <@name@>$$
"""
ROW = {
    "standard": r"$\mathbf T_{i-1}^{i} = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)$",
    "modified": r"$\mathbf T_{i-1}^{i} = R_x(\alpha_i)\,T_x(a_i)\,R_z(\theta_i)\,T_z(d_i)$",
    "frames": r"the transform from frame $i-1$ to frame $i$",
}
TRANSFORMS = r"""The poses of frames 1 to @n@@tool@ in the base frame at your $\mathbf q$,
$\mathbf T_0^1, \mathbf T_0^2, \ldots$, stacked to an array @count@ × 4 × 4

- Multiply from the left to the right: T01, then T01 @ T12, and so on.

Each row gives @row@, and $\mathbf T_0^i = \mathbf T_0^1 \mathbf T_1^2 \cdots \mathbf T_{i-1}^{i}$.
The last pose in closed form:
$$\mathbf T = <closed>$$

With your numbers:
$$\mathbf T_0^1, \ldots = <@name@>$$
"""
TOOL = r"""The pose $\mathbf T$ of the tool frame in the base frame at your $\mathbf q$

- Multiply the transforms from the base to the tool, from left to right.

Each row gives @row@; their product is the pose. Its columns are the axes of the tool frame
($\mathbf R$) and the tool point ($\mathbf p$), in base coordinates. In closed form:
$$\mathbf T = <closed>$$

With your numbers:
$$\mathbf T = <@name@>$$
"""
INVERSE = "This is the base frame seen from the tool, the inverse of the asked pose."
NEXT = "These lead from each frame to the next; all of them shall start at the base frame."


def filled(text: str, **values: object) -> str:
    """A text with @name@ replaced."""
    for name, value in values.items():
        text = text.replace(f"@{name}@", str(value))
    return text


def dh_table(
    *,
    name: str = "dh",
    points: float = 3,
    decimals: int = 3,
    given: Given = ALL_GIVEN,
    either: bool = False,
) -> Ready:
    """The table of the arm off its drawing; the sheet then prints no table.

    The base frame, the tool frame, the positive senses and the home pose are drawn, unless `given`
    leaves some of them to the student: the sheet says which. With `either`, the student chooses the
    convention and declares it in a variable beside the table.

    Raises:
        ExerciseError: on a sheet, where the arm has no Denavit-Hartenberg table, or none in the
            other convention that leads from the drawn base frame to the drawn tool frame.
    """

    def ready(setting: Setting) -> Question:
        robot = setting.robot
        if robot.convention == "frames":
            raise ExerciseError(
                f"dh_table takes a robot with a Denavit-Hartenberg table, got {robot.name}"
            )
        convention, axis = robot.convention, f"${AXIS[robot.convention]}$"
        if either:
            _check_either(setting, given)
            convention, axis = "either", EITHER_AXIS
        answer = TableOf(tuple(robot.parameters), robot.kinds, convention, decimals, given)
        text = filled(TABLE, axis=axis, name=name)
        return Question(_table_of, name, points, answer, docstring=text)

    return ready


def _check_either(setting: Setting, given: Given) -> None:
    """Refuses an arm whose drawn base or tool frame is no frame of the other convention."""
    robot = setting.robot
    at_zero = dict.fromkeys(robot.joints, 0.0)
    rows = robot.table.numbers({**robot.values(setting.arm.lengths), **at_zero})
    first_or_last, frame = rows[-1], "tool"
    if robot.convention == "modified":
        first_or_last, frame = rows[0], "base"
    is_given = given.tool if frame == "tool" else given.base
    if is_given and np.abs(first_or_last[2:]).max() > ON_AXIS:
        raise ExerciseError(
            f"dh_table takes either convention where the {frame} frame lies on the axis of its "
            f"joint, or is not given; that of {robot.name} does not"
        )


def _table_of(arm: Arm) -> Table:
    return arm.robot.table


def pose(
    *, name: str = "T", points: float = 2, decimals: int = 4, mistakes: Sequence[Wrong] = ()
) -> Ready:
    """The pose (4, 4) of the tool frame in the base frame, from the student's own table, if asked.

    `mistakes` are known wrong ways beside its inverse.
    """

    def ready(setting: Setting) -> Question:
        text = filled(TOOL, row=ROW[setting.robot.convention], name=name)
        solve = _tool
        if follows_table(setting):
            solve = _tool_of_table
        return Question(
            solve,
            name,
            points,
            Numbers((4, 4), POSE, decimals),
            mistakes=((INVERSE, lambda arm: np.linalg.inv(arm.T)), *mistakes),
            shows={"closed": lambda arm: arm.closed.T},
            docstring=text,
        )

    return ready


def _tool(arm: Arm) -> Array:
    return arm.T


def _tool_of_table(arm: Arm, dh: Table) -> Array:
    return frames_of_table(arm, dh)[-1]


def follows_table(setting: Setting) -> bool:
    """Whether a table is asked before, whose last frame is the tool."""
    return "dh" in setting.earlier and not setting.robot.tool


def frames_of_table(arm: Arm, dh: Table) -> Array:
    """Frames (n + 1, 4, 4) of a student's own table as its convention prints them."""
    return dh.frames(arm.robot.values(arm.lengths), arm.q)


def transforms(*, name: str = "T", points: float = 3, decimals: int = 3) -> Ready:
    """The poses of all frames behind the base, (n, 4, 4).

    The tool comes behind them where it is another frame, (n + 1, 4, 4). They follow from the
    student's own table where one is asked before.
    """

    def ready(setting: Setting) -> Question:
        robot = setting.robot
        count = len(poses(setting.arm))
        tool = ""
        if count > robot.n:
            tool = " and of the tool frame"
        text = filled(
            TRANSFORMS, n=robot.n, count=count, tool=tool, row=ROW[robot.convention], name=name
        )

        solve, each_step = poses, _next
        if follows_table(setting):
            solve, each_step = _of_table, _next_of_table
        mistakes: list[Wrong] = []
        if count > 1:
            mistakes.append((NEXT, each_step))
        return Question(
            solve,
            name,
            points,
            Numbers((count, 4, 4), [POSE], decimals),
            mistakes=mistakes,
            shows={"closed": lambda arm: arm.closed.T},
            docstring=text,
        )

    return ready


def poses(arm: Arm) -> Array:
    """Frames behind the base (k, 4, 4): all that the source prints, the tool once."""
    frames = arm.frames
    if arm.robot.convention == "standard":
        frames = frames[1:]
    if _same(frames):
        return frames[:-1]
    return frames


def _of_table(arm: Arm, dh: Table) -> Array:
    frames = frames_of_table(arm, dh)
    if dh.convention == "standard":
        return frames[1:]
    return frames[:-1]  # a modified table has its tool at the end


def _same(frames: Array) -> bool:
    """Whether the tool is the last frame."""
    return len(frames) > 1 and bool(np.abs(frames[-1] - frames[-2]).max() < 1e-12)


def _next(arm: Arm) -> Array:
    return steps(poses(arm))


def _next_of_table(arm: Arm, dh: Table) -> Array:
    return steps(_of_table(arm, dh))


def steps(T: Any) -> Array:
    """From each pose (k, 4, 4) to the next, the first from the base."""
    before = np.concatenate([np.eye(4)[None], T[:-1]])
    return np.linalg.inv(before) @ T
