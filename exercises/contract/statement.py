"""Statement, figures and scale of an exercise: the file's own, or those that its robot brings."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ..answers import Variant
from ..arm import Arm, Array
from ..drawing import Drawing, Triad
from ..exercise import ExerciseError
from .introduction import drawn_arm, introduction
from .names import Function, Names


def statement_of(names: Names, statement: str | Function | None) -> Callable[[Variant], str]:
    """What the sheet says before its parts: a text, what a function returns, or the introduction.

    Raises:
        ExerciseError: there is neither a statement nor a robot.
    """
    if isinstance(statement, str):
        return lambda _: statement
    if statement is None:
        if names.arm is None:
            raise ExerciseError(
                f"exercise {names.slug}: a statement is missing; only a robot brings one"
            )
        statement = introduction
    bound = names.bound(statement, "the statement")
    return lambda v: bound(names, v, {})


def scale_of(names: Names, scale: float | Function | None) -> Callable[[Variant], float]:
    """A typical length [m]: a number, what a function returns, or the size of the arm.

    Raises:
        ExerciseError: there is neither a scale nor a robot.
    """
    if isinstance(scale, int | float):
        return lambda _: float(scale)
    if scale is None:
        if names.arm is None:
            raise ExerciseError(
                f"exercise {names.slug}: scale, a typical length [m], is missing; "
                "only a robot brings one"
            )
        return _size_of(names.arm)
    bound = names.bound(scale, "scale")
    return lambda v: float(bound(names, v, {}))


def _size_of(arm: Callable[[Variant], Arm]) -> Callable[[Variant], float]:
    return lambda v: arm(v).size


def drawings_of(
    names: Names, drawings: Function | None, *, standard: bool
) -> Callable[[Variant], tuple[Drawing, ...]]:
    """The figures that a function returns, or with `standard` that of the arm; else none."""
    if drawings is None:
        if not standard or names.arm is None:
            return lambda _: ()
        drawings = drawn_arm
    bound = names.bound(drawings, "drawings")

    def drawn(v: Variant) -> tuple[Drawing, ...]:
        found = bound(names, v, {})
        return (found,) if isinstance(found, Drawing) else tuple(found)

    return drawn


def with_frames(
    names: Names, drawings: Callable[[Variant], tuple[Drawing, ...]]
) -> Callable[[Variant], tuple[Drawing, ...]]:
    """For the worked solution: the arm at the student's q with every frame, as it is drawn last.

    There is none where no drawing shows the arm at q, or where one shows all frames already.
    """
    arm_of_variant = names.arm
    if arm_of_variant is None:
        return lambda _: ()

    def solved(v: Variant) -> tuple[Drawing, ...]:
        arm = arm_of_variant(v)
        at_q = [one for one in drawings(v) if np.array_equal(one.q, arm.q)]
        triads = tuple(_triads(arm))
        if not at_q or len(at_q[-1].triads) >= len(triads):
            return ()
        caption = "The arm with its frames."
        alt = f"{at_q[-1].alt} Every frame is drawn with its number."
        drawing = replace(at_q[-1], triads=triads, dimensions=(), arrows=False)
        return (replace(drawing, caption=caption, alt=alt),)

    return solved


def _triads(arm: Arm) -> Iterator[Triad]:
    """The base frame and all others, under their numbers; those that coincide once."""
    frames = [np.eye(4), *arm.frames]
    labels = [str(i) for i in range(len(frames))]
    if arm.robot.convention == "standard":  # its frames start with the base
        del frames[0]
    if len(frames) > arm.robot.n + 1:
        labels[arm.robot.n + 1] = "tool"

    for i, pose in enumerate(frames):
        if not _is_among(pose, frames[:i]):
            same = [labels[k] for k in range(i, len(frames)) if _is_among(frames[k], [pose])]
            yield Triad(pose, ",".join(same))


def _is_among(pose: Array, others: Sequence[Array]) -> bool:
    return any(np.allclose(pose, other, atol=1e-9) for other in others)
