"""Jacobians in any frame and at any point, twists, and joint rates."""

from collections.abc import Callable, Sequence
from typing import Any, Literal

import numpy as np

from ...solutions.jacobian import in_axes
from ...solutions.jacobian import jacobian as jacobian_of
from ...solutions.velocity import pseudoinverse
from ..answers import Numbers
from ..arm import Arm, Array
from ..calculations.columns import SLIPS, TOOL_AXES, Slip, all_turning, late, late_axes, right
from ..calculations.twists import (
    VELOCITIES,
    Chosen,
    described,
    jacobian_units,
    listed,
    rate_units,
    rows_on_sheet,
    twist_units,
)
from ..contract.question import Question, Wrong
from ..exercise import ExerciseError, Outcome
from ..part import Ready, Setting
from ..properties import meets
from .frames import filled

Point = Literal["tool", "origin"] | int
"""The tool point, the point of the tool body at the base origin, or the origin of a frame of the arm, from 1."""
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
TWIST = r"""The twist $\boldsymbol\xi =$ @twist@ of the tool at your $\mathbf q$ for the joint rates
$@symbol@$

- One matrix times one vector: the joint rates are the weights of the columns.

$\boldsymbol\xi = \mathbf J \dot{\mathbf q}$:
$$\boldsymbol\xi = <@name@>$$
"""
TRANSPOSED_TWIST = (
    "This is J transposed times the joint rates; joint rates are weights of the columns of J."
)
RATES = r"""The joint rates $\dot{\mathbf q}$ @least@at which the tool has the velocity $@symbol@ =$
@twist@ at your $\mathbf q$

- Which rows of $\mathbf J$ take part?
- Are there as many of them as joints, or fewer?

@how@
$$\dot{\mathbf q} = <@name@>$$
"""
SQUARE = r"There are as many rows as joints, so $\dot{\mathbf q} = \mathbf J^{-1} @symbol@$:"
WIDE = (
    r"There are more joints than rows; of all rates that give the velocity those of least norm are "
    r"$\dot{\mathbf q} = \mathbf J^{+} @symbol@$ with $\mathbf J^{+} = \mathbf J^{T} (\mathbf J \mathbf J^{T})^{-1}$:"
)
TRANSPOSED = "This comes from J transposed, which is no inverse: put the rates into J and look at the velocity they give."
NORM = "These rates give the velocity, but there are smaller ones: of all that do, those of least norm are asked."
REACHED = 0.01  # of the velocity: rates this near were meant to reach it
UNASKED_NORM = 0.5  # of the points for rates that reach the velocity, but not with the least norm
DIFFERENT = 1e-3  # by which a mistake must change some entry to be one for this robot


def jacobian(
    *,
    frame: Literal["base", "tool"] = "base",
    point: Point = "tool",
    rows: Chosen = "all",
    name: str = "J",
    points: float = 4,
    decimals: int = 3,
    mistakes: Sequence[Wrong] = (),
) -> Ready:
    """The Jacobian (m, n) of a point in base or tool axes; of the origin of frame `point`, where that is a number.

    With base axes at the tool point of a standard table it follows from the student's own
    transforms `T` (n, 4, 4). `mistakes` are known wrong ways beside those that it has for any arm.
    """

    def ready(setting: Setting) -> Question:
        arm = setting.arm
        asked = rows_on_sheet(rows, setting.rows, arm.robot.task_rows)
        if not np.abs(_jacobian(arm, frame, point)[asked]).max() > DIFFERENT:
            raise ExerciseError(
                f"jacobian: no joint of {arm.robot.name} moves {_named(point)}; choose another point"
            )
        plain = frame == "base" and point == "tool"
        own_T = plain and arm.robot.convention == "standard" and _has_transforms(setting)

        def whole(arm: Arm) -> Array:
            return _jacobian(arm, frame, point)[asked]

        def of_frames(T: Array, arm: Arm) -> Array:
            return right(np.concatenate([np.eye(4)[None], T]), arm.kinds)[asked]

        text = filled(
            JACOBIAN,
            size=f"{len(asked)} × {arm.robot.n}",
            point=_named(point),
            frame="base axes" if frame == "base" else "the axes of the tool frame",
            rows=described(asked, setting.rows),
            lever=f"The lever arm of a revolute joint ends at {_named(point)}.",
            hint=SLIDE_HINT if "P" in arm.kinds else ORDER_HINT,
            slide=SLIDE if "P" in arm.kinds else "",
            turned=TURNED if frame == "tool" else "",
            name=name,
        )
        return Question(
            of_frames if own_T else whole,
            name,
            points,
            Numbers((len(asked), arm.robot.n), jacobian_units(asked, arm.kinds), decimals),
            mistakes=(*_mistakes(arm, asked, frame, point), *mistakes),
            shows={"axes": lambda arm: arm.axes, "places": lambda arm: _places(arm, point)},
            docstring=text,
        )

    return ready


def _has_transforms(setting: Setting) -> bool:
    """Whether the frames 1 to n are asked before; a pose of the tool alone does not lead to the columns."""
    earlier = setting.earlier.get("T")
    return isinstance(earlier, Numbers) and earlier.shape == (setting.robot.n, 4, 4)


def _jacobian(arm: Arm, frame: Literal["base", "tool"], point: Point) -> Array:
    """J (6, n) with the linear rows on top."""
    if point == "tool":
        return jacobian_of(arm.chain, arm.q, frame)
    if point == "origin":
        J = jacobian_of(arm.chain, arm.q, point="origin")
    else:
        J = jacobian_of(arm.chain, arm.q, point=_place(arm, point))
        J[:, point:] = 0.0  # joints behind that frame do not move it
    return in_axes(J, arm.R) if frame == "tool" else J


def _place(arm: Arm, point: Point) -> Array:
    """The point (3,) in base axes."""
    if point == "tool":
        return arm.p
    if point == "origin":
        return np.zeros(3)
    return _frame(arm, point)[:3, 3]


def _frame(arm: Arm, number: int) -> Array:
    """Frame 1 to n of the arm; in the other conventions than the standard one, frame 1 comes first."""
    return arm.frames[number if arm.robot.convention == "standard" else number - 1]


def _places(arm: Arm, point: Point) -> Array:
    return np.column_stack([arm.origins, _place(arm, point)])


def _named(point: Point) -> str:
    if point == "tool":
        return "the tool point"
    if point == "origin":
        return "the point of the tool body at the base origin"
    return f"the origin of frame {point}"


def _mistakes(arm: Arm, asked: list[int], frame: str, point: Point) -> tuple[Wrong, ...]:
    """The known wrong ways that change the Jacobian of such an arm."""
    found: list[Wrong] = []
    if frame == "base" and point == "tool":
        for slip in SLIPS:
            wrong = _wrong_columns(slip.columns, asked)
            standard = arm.robot.convention == "standard" or slip.columns not in (late, late_axes)
            if standard:
                found.append((_sentence(slip, arm.kinds), wrong))
        found.append((AT_ORIGIN, lambda arm: _jacobian(arm, frame, "origin")[asked]))
    if frame == "tool":
        found.append((BASE_AXES, lambda arm: _jacobian(arm, "base", point)[asked]))
    elif point != "tool":
        found.append((TOOL_AXES, lambda arm: _jacobian(arm, "tool", point)[asked]))
    if point != "tool":
        found.append((AT_TOOL, lambda arm: _jacobian(arm, frame, "tool")[asked]))  # pyright: ignore[reportArgumentType]
    if isinstance(point, int):
        found.append((BEYOND, lambda arm: _beyond(arm, point)[asked]))
    J = _jacobian(arm, frame, point)[asked]  # pyright: ignore[reportArgumentType]
    return tuple(
        (sentence, wrong) for sentence, wrong in found if np.abs(wrong(arm) - J).max() > DIFFERENT
    )


def _sentence(slip: Slip, kinds: str) -> str:
    """What names the slip for an arm of such joints: its slide by number, where it has one alone."""
    if slip.columns is all_turning and kinds.count("P") == 1:
        i = kinds.index("P") + 1
        return f"Column {i} looks as if joint {i} were revolute; look again at its type."
    return slip.sentence


def _wrong_columns(columns: Callable[[Any, str], Any], asked: list[int]) -> Callable[[Arm], Array]:
    def wrong(arm: Arm) -> Array:
        return columns(arm.frames, arm.kinds)[asked]

    return wrong


def _beyond(arm: Arm, point: int) -> Array:
    return jacobian_of(arm.chain, arm.q, point=_place(arm, point))


def twist(
    *,
    rows: Chosen = "all",
    name: str = "xi",
    points: float = 2,
    decimals: int = 3,
    J: str = "J",
    qdot: str = "qdot",
    symbol: str = r"\dot{\mathbf q}",
) -> Ready:
    """The twist (m,) that the drawn joint rates `qdot`, printed as `symbol`, give; `rows` are those of the Jacobian `J` before it."""

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        text = filled(TWIST, twist=listed(VELOCITIES, asked), symbol=symbol, name=name)
        answer = Numbers((len(asked),), twist_units(asked), decimals)
        wrong = (
            ((TRANSPOSED_TWIST, lambda J, qdot: J.T @ qdot),)
            if len(asked) == setting.robot.n
            else ()
        )
        renamed = {"J": J, "qdot": qdot}
        return Question(_twist, name, points, answer, wrong, docstring=text, renamed=renamed)

    return ready


def _twist(J: Array, qdot: Array) -> Array:
    return J @ qdot


def rates(
    *,
    rows: Chosen = "all",
    name: str = "rates",
    points: float = 3,
    decimals: int = 4,
    J: str = "J",
    xi: str = "xi",
    symbol: str = r"\boldsymbol\xi",
) -> Ready:
    """Joint rates (n,) for the drawn velocity `xi`, printed as `symbol`, in the rows of the Jacobian `J` before it.

    They are unique for a square block, and those of least norm where there are fewer rows than
    joints. Rates are right by the velocity they reach, too.
    """

    def ready(setting: Setting) -> Question:
        asked = rows_on_sheet(rows, setting.rows, setting.robot.task_rows)
        square = len(asked) == setting.robot.n
        text = filled(
            RATES,
            least="" if square else "of least norm ",
            twist=listed(VELOCITIES, asked),
            how=SQUARE if square else WIDE,
            symbol=symbol,
            name=name,
        )
        return Question(
            _rates,
            name,
            points,
            Numbers((setting.robot.n,), rate_units(setting.robot.kinds), decimals),
            mistakes=((TRANSPOSED, lambda J, xi: J.T @ xi),),
            check=_by_velocity(decimals, least=not square),
            docstring=text,
            renamed={"J": J, "xi": xi},
        )

    return ready


def _rates(J: Array, xi: Array) -> Array:
    if J.shape[0] == J.shape[1]:
        return np.linalg.solve(J, xi)
    return pseudoinverse(J) @ xi


def _by_velocity(decimals: int, *, least: bool) -> Callable[..., Outcome | None]:
    """A check by which unique rates are right that reach the velocity, and rates not of least norm are named."""
    half = 0.5 * 10.0**-decimals

    def judged(J: Array, xi: Array, value: Array) -> Outcome | None:
        rounding = 1.5 * half * (np.abs(J).sum(axis=1) + np.abs(value).sum())
        reached = meets(J, value, xi, np.minimum(rounding, REACHED * np.abs(xi).max()))
        if not reached:
            return None
        if not least:
            return Outcome(right=True)
        is_least = np.abs(value - _rates(J, xi)).max() <= REACHED * max(
            1.0, float(np.abs(value).max())
        )
        return None if is_least else Outcome(finding=NORM, share=UNASKED_NORM)

    return judged
