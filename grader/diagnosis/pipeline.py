"""From numbers to frames, columns and Jacobians, for all hypotheses at once.

Without a mistake it agrees with the engine; a test says so for every robot.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...solutions.analytic import angles_from_rotation, angular_velocity_map
from ...solutions.chain import elementary
from ...solutions.errors import KinegradeError
from .steps import Array, Steps
from .switches import (
    LINEAR_IN_TOOL_AXES,
    NEXT_FRAME,
    ORIGIN,
    RPY_RATES,
    SUM_AS_PRODUCT,
    TOOL_AXES,
    ZYZ_RATES,
    Codes,
    Switches,
)

ANGLE_SETS = {ZYZ_RATES: "ZYZ", RPY_RATES: "xyz"}


@dataclass(frozen=True, eq=False)
class Solved:
    """What H hypotheses lead to, computed when it is asked for."""

    steps: Steps
    switches: Switches

    @cached_property
    def frames(self) -> Array:
        """Frame 0 to the last link's, with the tool in the last, (H, m, 4, 4).

        Outside the standard convention the tool's frame stands behind the last link's.
        """
        return _frames(self.steps, self.switches)

    @property
    def printed(self) -> Array:
        """The frames (H, n + 1, 4, 4) that sources print: those of all axes, and the tool."""
        return self.frames[:, self.steps.first :]

    @cached_property
    def axes(self) -> Array:
        """What stands for the joint axes, (H, n, 3)."""
        return _axes(self.steps, self.switches, self.frames)

    @cached_property
    def origins(self) -> Array:
        """What stands for a point on each axis, (H, n, 3)."""
        places = _places(self.steps, self.switches.origin_shift, self.frames)
        return _taken(self.frames, places)[..., :3, 3]

    @cached_property
    def points(self) -> Array:
        """The points on the axes and the tool point, (H, n + 1, 3)."""
        return np.concatenate([self.origins, self.frames[:, -1:, :3, 3]], axis=1)

    @cached_property
    def J(self) -> Array:
        """The Jacobian, (H, 6, n)."""
        return _jacobian(self.steps, self.switches, self)


def _frames(steps: Steps, switches: Switches) -> Array:
    count, n = switches.count, steps.n
    links = np.empty((n + 2, count, 4, 4))
    amounts = _amounts(steps, switches)
    order = np.arange(len(steps.motions))
    links[:] = _links(steps, switches, amounts, order)
    other, chosen = steps.other_order(), np.flatnonzero(switches.other_order)
    if other is not None and len(chosen):
        links[:, chosen] = _links(steps, switches.of(chosen), amounts[chosen], other)
    return _chained(steps, switches, links)


def _amounts(steps: Steps, switches: Switches) -> Array:
    """Amounts (H, K) of all motions; the variable of a joint may stand at any motion of its row."""
    joint = np.clip(steps.rows - 1, 0, steps.n - 1)
    return switches.constants + switches.gains * switches.q[:, joint]


def _links(steps: Steps, switches: Switches, amounts: Array, order: Codes) -> Array:
    """The transform (n + 2, H, 4, 4) of each row."""
    links = np.tile(np.eye(4), (steps.n + 2, switches.count, 1, 1))
    for place in order:
        row, motion = int(steps.rows[place]), str(steps.motions[int(place)])
        if not amounts[:, place].any():
            continue
        turn = elementary(motion, amounts[:, place])
        if motion == "Rz" and place in steps.own:
            _take_sums(steps, switches, amounts, row - 1, turn)
        links[row] = links[row] @ turn
    return links


def _take_sums(steps: Steps, switches: Switches, amounts: Array, joint: int, turn: Array) -> None:
    """Puts in the turns of a joint whose sum with the one before was taken wrongly."""
    chosen = np.flatnonzero(switches.sums[:, joint])
    if not len(chosen):
        return
    angles: Array = amounts[chosen][:, steps.own[[joint - 1, joint]]]
    before, own = angles[:, 0], angles[:, 1]
    as_product = switches.sums[chosen, joint] == SUM_AS_PRODUCT
    cosine = np.where(as_product, np.cos(before) * np.cos(own), np.cos(before) + np.cos(own))
    sine = np.where(as_product, np.sin(before) * np.sin(own), np.sin(before) + np.sin(own))
    both = np.tile(np.eye(4), (len(chosen), 1, 1))
    both[:, 0, 0] = both[:, 1, 1] = cosine
    both[:, 1, 0] = sine
    both[:, 0, 1] = -sine
    turn[chosen] = elementary("Rz", -before) @ both


def _chained(steps: Steps, switches: Switches, links: Array) -> Array:
    """Frames (H, m, 4, 4) from the transforms of the rows."""
    tool = links[-1]
    reverse = switches.reverse[:, None, None]
    frames = [links[0]]
    for link in links[1:-1]:
        last: Array = frames[-1]
        following: Array = last @ link
        if switches.reverse.any():
            following = np.where(reverse, link @ last, following)
        frames.append(following)

    end = frames[-1] @ tool
    if steps.convention == "standard":
        frames[-1] = end
    else:
        frames.append(end)
    stack = np.stack(frames, axis=1)
    stack[switches.early, -1] = stack[switches.early, -2]
    stack[switches.one_frame] = stack[switches.one_frame, -1:]
    return stack


def _places(steps: Steps, shift: Codes, frames: Array) -> Codes:
    """Places (H, n) in the stack of frames."""
    places = steps.first + np.arange(steps.n) + shift
    return np.clip(places, 0, frames.shape[1] - 1)


def _taken(frames: Array, places: Codes) -> Array:
    return np.take_along_axis(frames, places[..., None, None], axis=1)


def _axes(steps: Steps, switches: Switches, frames: Array) -> Array:
    rotations = _taken(frames, _places(steps, switches.axis_shift, frames))[..., :3, :3]
    columns = switches.column[..., None, None]
    axes = np.take_along_axis(rotations, columns, axis=-1)[..., 0]
    axes[switches.upright] = (0.0, 0.0, 1.0)
    return axes


def _levers(steps: Steps, switches: Switches, solved: Solved) -> Array:
    """From each axis to the point whose velocity is meant, (H, n, 3)."""
    origins = solved.frames[..., :3, 3]
    ends = np.repeat(origins[:, -1:], steps.n, axis=1)
    following = np.zeros_like(switches.axis_shift) + 1
    after = _taken(solved.frames, _places(steps, following, solved.frames))[..., :3, 3]
    ends = np.where((switches.lever_end == NEXT_FRAME)[:, None, None], after, ends)
    starts = np.where(switches.lever_from_base[:, None, None], origins[:, :1], solved.origins)
    return ends - starts


def _jacobian(steps: Steps, switches: Switches, solved: Solved) -> Array:
    axes = solved.axes
    product = np.cross(axes, _levers(steps, switches, solved)) * switches.cross[..., None]
    product[..., 1] *= switches.middle[:, None]
    linear = np.where(switches.turns[..., None], product, axes)
    angular = axes * switches.angular[..., None]

    tool = solved.frames[:, -1]
    at_origin = switches.point == ORIGIN
    moved = np.cross(tool[:, None, :3, 3], angular)
    linear = np.where(at_origin[:, None, None], linear + moved, linear)
    angular = _other_rates(switches, tool, angular)

    turned = tool[:, :3, :3]
    in_tool = np.isin(switches.axes, (TOOL_AXES, LINEAR_IN_TOOL_AXES))
    linear = np.where(in_tool[:, None, None], linear @ turned, linear)
    in_tool = switches.axes == TOOL_AXES
    angular = np.where(in_tool[:, None, None], angular @ turned, angular)
    return np.concatenate([linear, angular], axis=-1).swapaxes(1, 2)


def _other_rates(switches: Switches, tool: Array, angular: Array) -> Array:
    """Angular rows as rates of a set of angles, where these are taken."""
    for code, letters in ANGLE_SETS.items():
        chosen = np.flatnonzero(switches.rates == code)
        if len(chosen):
            angular[chosen] = _angle_rates(tool[chosen, :3, :3], letters, angular[chosen])
    return angular


def _angle_rates(rotations: Array, letters: str, angular: Array) -> Array:
    """Angular velocities (H, n, 3) as rates of angles; not a number where there are none."""
    try:
        to_velocity = angular_velocity_map(angles_from_rotation(rotations, letters), letters)
        rates = np.linalg.solve(to_velocity, angular.swapaxes(1, 2)).swapaxes(1, 2)
        return np.asarray(rates, dtype=np.float64)
    except (KinegradeError, np.linalg.LinAlgError):
        if len(angular) == 1:
            return np.full_like(angular, np.nan)
    each = [slice(place, place + 1) for place in range(len(angular))]
    return np.concatenate([_angle_rates(rotations[one], letters, angular[one]) for one in each])
