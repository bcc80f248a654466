"""Jacobians in base or tool axes, at the tool point or any other."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Literal

import numpy as np

from ...solutions.jacobian import in_axes
from ...solutions.jacobian import jacobian as jacobian_of
from ...solutions.table import Table
from ..answers import Numbers, TableOf
from ..arm import Arm, Array
from ..calculations.columns import SLIPS, TOOL_AXES, Slip, all_turning, late, late_axes, right
from ..calculations.twists import Chosen, described, jacobian_units, rows_on_sheet
from ..contract.question import Question, Wrong
from ..exercise import ExerciseError
from ..part import Ready, Setting
from .frames import filled, follows_table, frames_of_table

Axes = Literal["base", "tool"]
Point = Literal["tool", "origin"] | int
"""The tool point, the point of the tool body at the base origin, or a frame's origin, from 1."""
JACOBIAN = r"""The @size@ Jacobian $\mathbf J$ of @point@ in @frame@ at your $\mathbf q$, @rows@

- @lever@
- @hint@

A revolute joint's column is $\mathbf z \times (\mathbf p - \mathbf o)$ in the linear rows and
$\mathbf z$ in the angular ones@slide@: $\mathbf z$ is the joint's axis, $\mathbf o$ a point on it,
$\mathbf p$ @point@.@turned@ The axes as columns:
$$\left[\mathbf z\right] = <axes>$$

A point on each axis, and $\mathbf p$, as columns:
$$\left[\mathbf o \cdots \mathbf p\right] = <places>$$

The columns, with your numbers:
$$\mathbf J = <@name@>$$
"""
TURNED = r""" In tool axes both blocks are multiplied by $\mathbf R^T$, where $\mathbf R$ holds the
tool axes as columns."""
SLIDE = r", a prismatic joint's is $\mathbf z$ and zeros"
SLIDE_HINT = "A prismatic joint turns nothing: its column holds its axis and zeros."
ORDER_HINT = "The order of a cross product decides its sign."
BASE_AXES = "This is the Jacobian in base axes; the axes of the tool frame are asked."
AT_ORIGIN = "This is at the base origin; the tool point is asked."
AT_TOOL = "This is the Jacobian of the tool point; another point is asked."
BEYOND = "A joint behind that frame cannot move its origin; look again at the last columns."
AXES = {"base": "base axes", "tool": "the axes of the tool frame"}
DIFFERENT = 1e-3  # by which a mistake must change some entry to be one for this robot


def jacobian(
    *,
    frame: Axes = "base",
    point: Point = "tool",
    rows: Chosen = "all",
    name: str = "J",
    points: float = 4,
    decimals: int = 3,
    mistakes: Sequence[Wrong] = (),
) -> Ready:
    """The Jacobian (m, n) of a point in base or tool axes.

    A number as `point` is the origin of that frame. With base axes at the tool point the Jacobian
    follows from the student's own transforms `T` (n, 4, 4), or else from the student's own table,
    where they are asked before. `mistakes` are known wrong ways beside those that it has for any
    arm.

    Raises:
        ExerciseError: on a sheet, where no joint of the arm moves the point.
    """

    def ready(setting: Setting) -> Question:
        arm = setting.arm
        asked = rows_on_sheet(rows, setting.rows, arm.robot.task_rows)
        if not np.abs(_jacobian(arm, frame, point)[asked]).max() > DIFFERENT:
            raise ExerciseError(
                f"jacobian: no joint of {arm.robot.name} moves {_named(point)}; "
                "choose another point"
            )
        return Question(
            _solved(setting, asked, frame, point),
            name,
            points,
            Numbers((len(asked), arm.robot.n), jacobian_units(asked, arm.kinds), decimals),
            mistakes=(*_mistakes(arm, asked, frame, point), *mistakes),
            shows={"axes": lambda arm: arm.axes, "places": lambda arm: _places(arm, point)},
            docstring=_text(setting, asked, frame, point, name),
        )

    return ready


def _solved(setting: Setting, asked: list[int], frame: Axes, point: Point) -> Callable[..., Array]:
    """The function of the part: of the student's own frames where these are asked before."""

    def of_arm(arm: Arm) -> Array:
        return _jacobian(arm, frame, point)[asked]

    def of_frames(T: Array, arm: Arm) -> Array:
        return right(_placed(T, setting.robot.convention), arm.kinds)[asked]

    def of_own_frames(T: Array, dh: Table) -> Array:
        return right(_placed(T, dh.convention), dh.kinds)[asked]

    def of_table(arm: Arm, dh: Table) -> Array:
        return right(frames_of_table(arm, dh), dh.kinds)[asked]

    if frame != "base" or point != "tool":
        return of_arm
    if _has_transforms(setting):
        return of_own_frames if _chosen_convention(setting) else of_frames
    return of_table if follows_table(setting) else of_arm


def _chosen_convention(setting: Setting) -> bool:
    """Whether the student's table says on which axes the student's frames are."""
    table = setting.earlier.get("dh")
    return isinstance(table, TableOf) and table.convention == "either" and follows_table(setting)


def _placed(T: Array, convention: str) -> Array:
    """Frames (n + 1, 4, 4) on the axis of each joint and at the tool, of frames 1 to n.

    In the standard convention frame i - 1 is on axis i, in the others frame i, and n is the tool.
    """
    if convention == "standard":
        return np.concatenate([np.eye(4)[None], T])
    return np.concatenate([T, T[-1:]])


def _text(setting: Setting, asked: list[int], frame: Axes, point: Point, name: str) -> str:
    """Question, hints and solution for such an arm."""
    slide, hint, turned = "", ORDER_HINT, ""
    if "P" in setting.arm.kinds:
        slide, hint = SLIDE, SLIDE_HINT
    if frame == "tool":
        turned = TURNED
    return filled(
        JACOBIAN,
        size=f"{len(asked)} × {setting.robot.n}",
        point=_named(point),
        frame=AXES[frame],
        rows=described(asked, setting.rows),
        lever=f"The lever arm of a revolute joint ends at {_named(point)}.",
        hint=hint,
        slide=slide,
        turned=turned,
        name=name,
    )


def _has_transforms(setting: Setting) -> bool:
    """Whether frames 1 to n are asked before; the tool's pose alone leads to no columns."""
    earlier = setting.earlier.get("T")
    return isinstance(earlier, Numbers) and earlier.shape == (setting.robot.n, 4, 4)


def _jacobian(arm: Arm, frame: Axes, point: Point) -> Array:
    """J (6, n) with the linear rows on top."""
    if point == "tool":
        return jacobian_of(arm.chain, arm.q, frame)
    if point == "origin":
        J = jacobian_of(arm.chain, arm.q, point="origin")
    else:
        J = _beyond(arm, point)
        J[:, point:] = 0.0  # joints behind that frame do not move it
    if frame == "tool":
        return in_axes(J, arm.R)
    return J


def _beyond(arm: Arm, point: int) -> Array:
    """J (6, n) of the origin of a frame as if it were a point of the tool body."""
    return jacobian_of(arm.chain, arm.q, point=_place(arm, point))


def _place(arm: Arm, point: Point) -> Array:
    """The point (3,) in base axes."""
    if point == "tool":
        return arm.p
    if point == "origin":
        return np.zeros(3)
    return _frame(arm, point)[:3, 3]


def _frame(arm: Arm, number: int) -> Array:
    """Frame 1 to n of the arm; only in the standard convention frame 0 comes first."""
    if arm.robot.convention == "standard":
        return arm.frames[number]
    return arm.frames[number - 1]


def _places(arm: Arm, point: Point) -> Array:
    return np.column_stack([arm.origins, _place(arm, point)])


def _named(point: Point) -> str:
    if point == "tool":
        return "the tool point"
    if point == "origin":
        return "the point of the tool body at the base origin"
    return f"the origin of frame {point}"


def _mistakes(arm: Arm, asked: list[int], frame: Axes, point: Point) -> list[Wrong]:
    """The known wrong ways that change the Jacobian of such an arm."""
    J = _jacobian(arm, frame, point)[asked]
    ways = [*_other_frames(asked, frame, point)]
    if frame == "base" and point == "tool":
        ways = [*_slips(arm, asked), *ways]

    found: list[Wrong] = []
    for sentence, wrong in ways:
        if np.abs(wrong(arm) - J).max() > DIFFERENT:
            found.append((sentence, wrong))
    return found


def _slips(arm: Arm, asked: list[int]) -> Iterator[Wrong]:
    """Columns put together wrongly; an axis one frame late is a slip of standard tables."""
    for slip in SLIPS:
        if arm.robot.convention == "standard" or slip.columns not in (late, late_axes):
            yield _sentence(slip, arm.kinds), _wrong_columns(slip.columns, asked)


def _other_frames(asked: list[int], frame: Axes, point: Point) -> Iterator[Wrong]:
    """The right Jacobian in other axes, or of another point."""
    if frame == "base" and point == "tool":
        yield AT_ORIGIN, lambda arm: _jacobian(arm, frame, "origin")[asked]
    if frame == "tool":
        yield BASE_AXES, lambda arm: _jacobian(arm, "base", point)[asked]
    elif point != "tool":
        yield TOOL_AXES, lambda arm: _jacobian(arm, "tool", point)[asked]
    if point != "tool":
        yield AT_TOOL, lambda arm: _jacobian(arm, frame, "tool")[asked]
    if isinstance(point, int):
        yield BEYOND, lambda arm: _beyond(arm, point)[asked]


def _sentence(slip: Slip, kinds: str) -> str:
    """What names the slip for such joints: a slide by its number, where there is one alone."""
    if slip.columns is all_turning and kinds.count("P") == 1:
        i = kinds.index("P") + 1
        return f"Column {i} looks as if joint {i} were revolute; look again at its type."
    return slip.sentence


def _wrong_columns(columns: Callable[[Any, str], Any], asked: list[int]) -> Callable[[Arm], Array]:
    def wrong(arm: Arm) -> Array:
        return columns(arm.frames, arm.kinds)[asked]

    return wrong
