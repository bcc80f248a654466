"""Every place to go wrong, one row a hypothesis: numbers, orders, frames, formulas."""

from dataclasses import dataclass, fields, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .steps import Array, Steps

Flags = NDArray[np.bool_]
Codes = NDArray[np.int64]
How = Literal["set", "scale", "add", "exchange"]
AXIS_Z = 2  # the column of a rotation that is a joint's axis

SUM_AS_PRODUCT, SUM_AS_SUM = 1, 2  # c23 taken for c2 c3, for c2 + c3
NEXT_FRAME = 1  # where levers end
TOOL_AXES, LINEAR_IN_TOOL_AXES = 1, 2
ORIGIN = 1  # the point of the tool body at the base origin
ZYZ_RATES, RPY_RATES = 1, 2


@dataclass(frozen=True)
class Switches:
    """H hypotheses on how an answer was computed; the arrays are written to while they are set.

    Attributes:
        constants: Amounts (H, K) at q = 0 [rad, m].
        gains: How much (H, K) of the joint's variable is added.
        q: Joint variables (H, n) [rad, m].
        other_order: Whether (H,) rows are multiplied in the other convention's order.
        reverse: Whether (H,) links are multiplied from the right to the left.
        one_frame: Whether (H,) all frames are the last one.
        early: Whether (H,) the chain stops one link early.
        sums: How (H, n) sine and cosine of a joint's and its parallel neighbour's angle are taken.
        axis_shift: Frames (H, n) by which the axis is late.
        origin_shift: Frames (H, n) by which the point on the axis is late.
        column: Which column (H, n) of a rotation is taken for the axis.
        upright: Whether (H,) all axes are (0, 0, 1).
        lever_end: Where (H,) levers end.
        lever_from_base: Whether (H,) levers begin at the base.
        cross: Factor (H, n) of the cross product.
        middle: Factor (H,) of the second component of a cross product.
        turns: Whether (H, n) the linear rows are a cross product.
        angular: Factor (H, n) of the axis in the angular rows.
        axes: In which axes (H,) the rows are.
        point: Whose velocity (H,) it is.
        rates: Which angular rates (H,) these are.
    """

    constants: Array
    gains: Array
    q: Array
    other_order: Flags
    reverse: Flags
    one_frame: Flags
    early: Flags
    sums: Codes
    axis_shift: Codes
    origin_shift: Codes
    column: Codes
    upright: Flags
    lever_end: Codes
    lever_from_base: Flags
    cross: Array
    middle: Array
    turns: Flags
    angular: Array
    axes: Codes
    point: Codes
    rates: Codes

    @property
    def count(self) -> int:
        """Number H of hypotheses."""
        return len(self.q)

    def of(self, chosen: Any) -> "Switches":
        """Some of the hypotheses."""
        kept = {field.name: getattr(self, field.name)[chosen] for field in fields(self)}
        return replace(self, **kept)


@dataclass(frozen=True)
class Edit:
    """One switch set otherwise.

    Attributes:
        switch: Its name.
        how: "set", "scale" or "add" a value, or "exchange" the two places of `at`.
        value: The value; of "exchange", none.
        at: Places behind the hypothesis; all of them where it is None.
    """

    switch: str
    how: How
    value: Any = None
    at: Any = None


def as_it_is(steps: Steps, count: int) -> Switches:
    """So many hypotheses without a mistake."""
    n = steps.n
    slides = np.array([kind == "P" for kind in steps.kinds])

    def none() -> Flags:
        return np.zeros(count, dtype=bool)

    def code(*shape: int) -> Codes:
        return np.zeros((count, *shape), dtype=np.int64)

    return Switches(
        constants=np.tile(steps.constants, (count, 1)),
        gains=np.tile(steps.gains, (count, 1)),
        q=np.tile(steps.q, (count, 1)),
        other_order=none(),
        reverse=none(),
        one_frame=none(),
        early=none(),
        sums=code(n),
        axis_shift=code(n),
        origin_shift=code(n),
        column=np.full((count, n), AXIS_Z),
        upright=none(),
        lever_end=code(),
        lever_from_base=none(),
        cross=np.ones((count, n)),
        middle=np.ones(count),
        turns=np.tile(~slides, (count, 1)),
        angular=np.tile(np.where(slides, 0.0, 1.0), (count, 1)),
        axes=code(),
        point=code(),
        rates=code(),
    )


def edit(switches: Switches, chosen: Any, one: Edit) -> None:
    """Sets a switch otherwise in the chosen hypotheses."""
    array = getattr(switches, one.switch)
    if one.how == "exchange":
        a, b = one.at
        rows = array[chosen]
        rows[..., [a, b]] = rows[..., [b, a]]
        array[chosen] = rows
        return
    place = (chosen,)
    if one.at is not None:
        place = np.ix_(np.atleast_1d(chosen), np.atleast_1d(one.at))
    if one.how == "set":
        array[place] = one.value
    elif one.how == "scale":
        array[place] = array[place] * one.value
    else:
        array[place] = array[place] + one.value
