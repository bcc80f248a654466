"""Statement, figures and scale of an exercise: the file's own, or those that its robot brings."""

from collections.abc import Callable

from ..answers import Variant
from ..arm import Arm
from ..drawing import Drawing
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
