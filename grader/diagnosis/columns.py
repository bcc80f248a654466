"""The mistakes behind the numbers, for the joints and columns of one arm."""

from collections.abc import Iterator

from . import known_columns as known
from .mistake import Mistake
from .steps import Steps
from .switches import (
    LINEAR_IN_TOOL_AXES,
    NEXT_FRAME,
    ORIGIN,
    RPY_RATES,
    TOOL_AXES,
    ZYZ_RATES,
    Edit,
)

OTHER_CONVENTION = {"standard": "modified", "modified": "standard"}
NUMBER_OF_AXIS = {"standard": "i - 1", "modified": "i", "frames": "i"}


def in_frames(steps: Steps) -> Iterator[Mistake]:
    """Mistakes in multiplying the transforms."""
    if steps.convention in OTHER_CONVENTION:
        other = OTHER_CONVENTION[steps.convention]
        shift = 1 if steps.convention == "standard" else -1
        order = Edit("other_order", "set", value=True)
        yield known.ORDER.of(order, other=other)
        shifts = _shifts("axis_shift", "origin_shift", by=shift)
        yield known.OTHER_TABLE.of(order, *shifts, other=other)
    yield known.REVERSE.of(Edit("reverse", "set", value=True))
    yield known.ONE_FRAME.of(Edit("one_frame", "set", value=True))
    yield known.EARLY.of(Edit("early", "set", value=True))


def _shifts(*switches: str, by: int) -> list[Edit]:
    return [Edit(switch, "set", by) for switch in switches]


def in_columns(steps: Steps) -> Iterator[Mistake]:
    """Mistakes in putting the columns together."""
    yield from _in_indices(steps)
    yield known.OWN_LINK.of(Edit("lever_end", "set", NEXT_FRAME))
    yield known.FROM_BASE.of(Edit("lever_from_base", "set", value=True))
    yield known.REVERSED.of(Edit("cross", "set", -1.0))
    yield known.MIDDLE.of(Edit("middle", "set", -1.0))
    yield known.NO_TURN.of(Edit("angular", "set", 0.0))
    yield known.UPRIGHT.of(Edit("upright", "set", value=True))
    yield known.SECOND_COLUMN.of(Edit("column", "set", 1))
    yield known.SECOND_COLUMN.of(Edit("column", "set", 0), less_likely=0.1, column="x")
    yield from _in_types(steps)


def _in_indices(steps: Steps) -> Iterator[Mistake]:
    """Axes and points taken from another frame, in all columns or in one."""
    at = NUMBER_OF_AXIS[steps.convention]
    late, early = {"by": 1}, {"by": -1}
    if steps.convention == "standard":
        yield known.LATE.of(*_shifts("axis_shift", "origin_shift", **late))
        yield known.LATE_AXES.of(*_shifts("axis_shift", **late))
    else:
        yield known.NEXT_AXES.of(*_shifts("axis_shift", **late), at=at)
    yield known.EARLY_FRAME.of(*_shifts("axis_shift", "origin_shift", **early), at=at)
    yield known.EARLY_AXES.of(*_shifts("axis_shift", **early), at=at)
    yield known.LATE_ORIGINS.of(*_shifts("origin_shift", **late))
    yield known.EARLY_ORIGINS.of(*_shifts("origin_shift", **early))
    for joint in range(steps.n):
        at_joint, i = (joint,), joint + 1
        yield known.LATE_AXIS.of(Edit("axis_shift", "set", 1, at_joint), i=i)
        yield known.LATE_ORIGIN.of(Edit("origin_shift", "set", 1, at_joint), i=i)
        if joint:
            yield known.EARLY_AXIS.of(Edit("axis_shift", "set", -1, at_joint), i=i)
            yield known.EARLY_ORIGIN.of(Edit("origin_shift", "set", -1, at_joint), i=i)


def _in_types(steps: Steps) -> Iterator[Mistake]:
    """Columns of the wrong type of joint."""
    slides = tuple(joint for joint, kind in enumerate(steps.kinds) if kind == "P")
    if len(slides) > 1:
        turn = Edit("angular", "set", 1.0, slides)
        yield known.ALL_TURN.of(Edit("turns", "set", value=True, at=slides), turn)
        yield known.TURNING_SLIDE.of(turn)
    for joint, kind in enumerate(steps.kinds):
        at, i = (joint,), joint + 1
        no_product = Edit("turns", "set", value=False, at=at)
        product = Edit("turns", "set", value=True, at=at)
        no_turn = Edit("angular", "set", 0.0, at)
        turn = Edit("angular", "set", 1.0, at)
        if kind == "R":
            yield known.REVERSED_COLUMN.of(Edit("cross", "set", -1.0, at), i=i)
            yield known.SLIDES.of(no_product, no_turn, i=i)
            yield known.AXIS_FOR_PRODUCT.of(no_product, i=i)
        else:
            yield known.TURNS.of(product, turn, i=i)
            yield known.TURNING_SLIDE.of(turn, i=i)
            yield known.CROSSED_SLIDE.of(product, i=i)


def in_output(axes: int, point: int) -> Iterator[Mistake]:
    """Right columns in other axes, of another point or of other rates than are asked."""
    if axes:
        yield known.IN_BASE.of(Edit("axes", "set", 0))
    else:
        yield known.IN_TOOL.of(Edit("axes", "set", TOOL_AXES))
        yield known.HALF_IN_TOOL.of(Edit("axes", "set", LINEAR_IN_TOOL_AXES))
    if point:
        yield known.AT_TOOL.of(Edit("point", "set", 0))
    else:
        yield known.AT_ORIGIN.of(Edit("point", "set", ORIGIN))
    if not axes:
        yield known.ANGLE_RATES.of(Edit("rates", "set", ZYZ_RATES), angles="ZYZ angles")
        yield known.ANGLE_RATES.of(Edit("rates", "set", RPY_RATES), angles="roll, pitch and yaw")
