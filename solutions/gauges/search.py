"""The search for gauges from joint to joint, over the senses that a mechanism leaves open."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..chain import Array, Chain, elementary
from ..rotation import inverse_transform
from .gauge import UNLINKED, Gauge

REVERSAL = np.diag([1.0, -1.0, -1.0])
SETTLED = 2e-2  # a direction of a free translation shorter than this does not settle it


@dataclass(frozen=True)
class Given:
    """What a sheet gives of a mechanism, so that a table has to agree; all else may be chosen.

    `base` and `tool` are those frames, `senses` the positive directions of the joints, `zero` the
    home pose.
    """

    base: bool = True
    tool: bool = True
    senses: bool = True
    zero: bool = True


@dataclass(frozen=True)
class Difference:
    """Where two chains differ first: `axis` from 1, n + 1 is the tool; `reason` is a sentence."""

    axis: int
    reason: str


class Search:
    """One search for the equivalences of two chains of the same kinds."""

    def __init__(
        self, first: Chain, second: Chain, given: Given, angle: float, length: float
    ) -> None:
        self.first = first
        self.second = second
        self.given = given
        self.angle = angle
        self.length = length
        self.signs = (1.0,) if given.senses else (1.0, -1.0)
        self.difference = Difference(0, "")

    def note(self, axis: int, reason: str) -> None:
        """Keeps the difference farthest from the base: all before it can be made to agree."""
        if axis > self.difference.axis:
            self.difference = Difference(axis, reason)

    def starts(self) -> Iterator[Gauge]:
        """Gauges G_0 that the base allows."""
        nothing = (np.zeros((3, 0)), np.zeros(0), np.zeros((0, 0)), ())
        if self.given.base:
            yield from self._given_base(nothing)
            return
        slide = self.first.kinds[0] == "P"
        directions = np.eye(3)
        if not slide:
            directions = directions[2:]  # along the axis
        for sign in self.signs:
            start = Gauge(kept_or_reversed(sign), np.zeros(3), *nothing, (sign,))
            for direction in directions:
                start = start.with_open("base", direction)
            if slide:  # about its direction the base may stand in any way
                start = replace(start, pending=0)
            yield start

    def _given_base(self, nothing: tuple[Array, Array, Array, tuple[str, ...]]) -> Iterator[Gauge]:
        between = inverse_transform(self.first.fixed[0]) @ self.second.fixed[0]
        sign = float(np.sign(between[2, 2]))
        if abs(abs(between[2, 2]) - 1) > self.angle:
            self.note(1, "axis 1 has another direction")
        elif sign not in self.signs:
            self.note(1, "the positive sense of axis 1 is reversed")
        else:
            start = Gauge(between[:3, :3], between[:3, 3], *nothing, (sign,))
            placed = self._on_axis(start, 1)
            if placed is not None:
                yield placed

    def found(self, gauge: Gauge, joint: int) -> Iterator[Gauge]:
        """Gauges G_n that go on from G_(joint - 1)."""
        if self.first.kinds[joint - 1] == "P":
            gauge = self._slid(gauge, joint)
        else:
            gauge = replace(gauge, pending=joint, links=UNLINKED)
        if joint == self.first.n:
            yield from self._at_the_tool(gauge)
            return
        for after in self._at_the_next_axis(gauge, joint):
            yield from self.found(after, joint + 1)

    def _slid(self, gauge: Gauge, joint: int) -> Gauge:
        """A prismatic joint has a direction and no place: its offset is open."""
        if gauge.pending is None:
            return gauge.with_open(f"c{joint}", gauge.turn[:, 2])
        # Parallel to the pending axis, so that the pending angle does not matter.
        return gauge.with_open(f"c{joint}", gauge.turn @ gauge.links[1][:3, 2])

    def _links(self, gauge: Gauge, joint: int) -> tuple[Array, Array]:
        """The transforms of both chains from the pending joint, or this one, to the next axis."""
        ours, theirs = gauge.links
        return ours @ self.first.fixed[joint], theirs @ self.second.fixed[joint]

    def _after(self, gauge: Gauge, links: tuple[Array, Array], angle: float) -> Gauge:
        """The gauge beyond the links, with the pending angle settled."""
        ours, theirs = links
        back = ours[:3, :3].T
        turned = gauge.turn @ elementary("Rz", angle)[:3, :3]
        if gauge.pending == 0:
            gauge = gauge.with_angle("base angle", angle)
        elif gauge.pending is not None:
            gauge = gauge.with_angle(f"c{gauge.pending}", angle)
        return replace(
            gauge,
            turn=back @ turned @ theirs[:3, :3],
            shift=back @ (turned @ theirs[:3, 3] + gauge.shift - ours[:3, 3]),
            open=back @ gauge.open,
            pending=None,
            links=UNLINKED,
        )

    def _at_the_next_axis(self, gauge: Gauge, joint: int) -> Iterator[Gauge]:
        axis = joint + 1
        links = self._links(gauge, joint)
        ours, theirs = links[0][:3, 2], links[1][:3, 2]
        if gauge.pending is None:
            yield from self._settled_direction(gauge, links, axis)
            return

        between = _angle_to_z(ours)
        seen = _angle_to_z(theirs)
        if abs(between - seen) > self.angle:
            wrong = f"it is at {np.degrees(seen):.0f} degrees to axis {joint}"
            self.note(axis, f"axis {axis} has another direction: {wrong}, which is drawn otherwise")
        elif between > SETTLED:
            yield from self._turned_to(gauge, links, axis)
        else:
            yield from self._parallel(gauge, links, axis)

    def _settled_direction(
        self, gauge: Gauge, links: tuple[Array, Array], axis: int
    ) -> Iterator[Gauge]:
        seen = gauge.turn @ links[1][:3, 2]
        for sign in self.signs:
            if np.linalg.norm(seen - sign * links[0][:3, 2]) <= self.angle:
                yield from self._placed(self._after(gauge, links, 0.0), axis, sign)
                return
        self.note(axis, f"axis {axis} has another direction, or the other sense")

    def _turned_to(self, gauge: Gauge, links: tuple[Array, Array], axis: int) -> Iterator[Gauge]:
        """The angle that turns the next axis of one chain onto the other's, for each sense."""
        theirs = links[1][:3, 2]
        for sign in self.signs:
            wanted = gauge.turn.T @ (sign * links[0][:3, 2])
            if abs(wanted[2] - theirs[2]) > self.angle:
                self.note(axis, f"the positive sense of axis {axis} is reversed")
                continue
            angle = np.arctan2(wanted[1], wanted[0]) - np.arctan2(theirs[1], theirs[0])
            yield from self._placed(self._after(gauge, links, float(angle)), axis, sign)

    def _parallel(self, gauge: Gauge, links: tuple[Array, Array], axis: int) -> Iterator[Gauge]:
        """The next axis is parallel: its place settles the angle, where it has one."""
        sign = float(np.sign((gauge.turn @ links[1][:3, 2])[2] * links[0][2, 2]))
        if sign not in self.signs:
            self.note(axis, f"the positive sense of axis {axis} is reversed")
        elif self.first.kinds[axis - 1] == "P":
            yield replace(gauge, links=links, signs=(*gauge.signs, sign))
        else:
            angle = self._turning_onto(gauge, links, axis)
            if angle is not None:
                yield from self._placed(self._after(gauge, links, angle), axis, sign)

    def _turning_onto(self, gauge: Gauge, links: tuple[Array, Array], axis: int) -> float | None:
        """The pending angle that brings one parallel axis onto the other; None if none does."""
        wanted = (gauge.turn.T @ (links[0][:3, 3] - gauge.shift))[:2]
        theirs = links[1][:2, 3]
        apart = float(np.linalg.norm(wanted))
        if abs(apart - float(np.linalg.norm(theirs))) > self.length:
            self.note(axis, f"axis {axis} is parallel to the axis before it at another distance")
            return None
        if apart <= max(5 * self.length, 1e-9):  # one line: any angle will do
            return self._aligning(gauge, links)
        return float(np.arctan2(wanted[1], wanted[0]) - np.arctan2(theirs[1], theirs[0]))

    def _aligning(self, gauge: Gauge, links: tuple[Array, Array]) -> float:
        """The angle about the pending axis that brings the frames beyond the links closest."""
        wanted = gauge.turn.T @ links[0][:3, :3] @ links[1][:3, :3].T
        # trace(wanted^T Rz(angle)) = along cos(angle) + across sin(angle) + ... is the largest.
        across = wanted[1, 0] - wanted[0, 1]
        along = wanted[0, 0] + wanted[1, 1]
        if np.hypot(across, along) < 1e-9:
            return 0.0
        return float(np.arctan2(across, along))

    def _placed(self, gauge: Gauge, axis: int, sign: float) -> Iterator[Gauge]:
        gauge = replace(gauge, signs=(*gauge.signs, sign))
        placed = self._on_axis(gauge, axis)
        if placed is not None:
            yield placed

    def _on_axis(self, gauge: Gauge, axis: int) -> Gauge | None:
        """The gauge with the origin on the axis, if it is revolute: a slide has no place."""
        if self.first.kinds[axis - 1] == "P":
            return gauge
        return self._vanishing(gauge, slice(0, 2), axis, f"axis {axis} stands in another place")

    def _at_the_tool(self, gauge: Gauge) -> Iterator[Gauge]:
        n = self.first.n
        links = self._links(gauge, n)
        angle = 0.0
        if gauge.pending is not None:
            angle = self._aligning(gauge, links)
        after = self._after(gauge, links, angle)
        if not self.given.tool:
            y, left = _settling(after.open, -after.shift)
            yield after.settled(y, left[:, :0])
            return
        if np.abs(after.turn - np.eye(3)).max() > self.angle:
            self.note(n + 1, "the tool frame is turned otherwise")
            return

        placed = self._vanishing(after, slice(0, 3), n + 1, "the tool point is in another place")
        if placed is not None:
            left = int(placed.open.shape[1])
            yield placed.settled(np.zeros(left), np.zeros((left, 0)))

    def _vanishing(self, gauge: Gauge, rows: slice, axis: int, reason: str) -> Gauge | None:
        """Open translations settled so that these rows of the shift vanish; None if they cannot."""
        A = gauge.open[rows]
        wanted = -gauge.shift[rows]
        y, left = _settling(A, wanted)
        if np.linalg.norm(wanted - A @ y) > self.length:
            self.note(axis, reason)
            return None
        return gauge.settled(y, left)


def _settling(A: Array, wanted: Array) -> tuple[Array, Array]:
    """The y (m,) that brings A y nearest to what is wanted, and what stays open of it (m, k)."""
    # By the singular values: a base that slides along with joint 1 leaves only dust to settle.
    U, sizes, V = np.linalg.svd(A, full_matrices=True)
    rank = int((sizes > SETTLED).sum())
    y = V[:rank].T @ ((U[:, :rank].T @ wanted) / sizes[:rank])
    return y, V[rank:].T


def kept_or_reversed(sign: float) -> Array:
    """The rotation (3, 3) that keeps the z axis for a positive sign and reverses it otherwise."""
    return np.eye(3) if sign > 0 else REVERSAL


def _angle_to_z(axis: Array) -> float:
    """The angle [rad] between a direction (3,) of either sense and the z axis."""
    return float(np.arctan2(np.hypot(*axis[:2]), abs(axis[2])))
