"""The search for gauges from joint to joint, over the senses that a mechanism leaves open."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ..chain import Array, Chain, elementary
from ..rotation import inverse_transform
from .gauge import Gauge

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
        self.first, self.second, self.given = first, second, given
        self.angle, self.length = angle, length
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
        directions = np.eye(3)[2:] if self.first.kinds[0] == "R" else np.eye(3)
        for sign in self.signs:
            turn = np.eye(3) if sign > 0 else REVERSAL
            start = Gauge(turn, np.zeros(3), *nothing, (sign,))
            for direction in directions:
                start = start.with_open("base", direction)
            if self.first.kinds[0] == "P":  # about its direction the base may stand in any way
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
            placed = start if self.first.kinds[0] == "P" else self._on_axis(start, 1)
            if placed is not None:
                yield placed

    def found(self, gauge: Gauge, joint: int) -> Iterator[Gauge]:
        """Gauges G_n that go on from G_(joint - 1)."""
        if self.first.kinds[joint - 1] == "P":
            gauge = self._slid(gauge, joint)
        else:
            gauge = replace(gauge, pending=joint, links=(np.eye(4), np.eye(4)))
        last = joint == self.first.n
        for after in self._at_the_tool(gauge) if last else self._at_the_next_axis(gauge, joint):
            if last:
                yield after
            else:
                yield from self.found(after, joint + 1)

    def _slid(self, gauge: Gauge, joint: int) -> Gauge:
        """A prismatic joint has a direction and no place: its offset is open."""
        if gauge.pending is None:
            return gauge.with_open(f"c{joint}", gauge.turn[:, 2])
        # Parallel to the pending axis, so that the pending angle does not matter.
        return gauge.with_open(f"c{joint}", gauge.turn @ gauge.links[1][:3, 2])

    def _links(self, gauge: Gauge, joint: int) -> tuple[Array, Array]:
        """The transforms of both chains from the pending joint, or this one, to the next axis."""
        ours, theirs = (np.eye(4), np.eye(4)) if gauge.pending is None else gauge.links
        return ours @ self.first.fixed[joint], theirs @ self.second.fixed[joint]

    def _after(self, gauge: Gauge, links: tuple[Array, Array], angle: float) -> Gauge:
        """The gauge beyond the links, with the pending angle settled."""
        ours, theirs = links
        back = ours[:3, :3].T
        turned = gauge.turn @ elementary("Rz", angle)[:3, :3]
        if gauge.pending is not None:
            name = "base angle" if gauge.pending == 0 else f"c{gauge.pending}"
            gauge = gauge.with_angle(name, angle)
        return replace(
            gauge,
            turn=back @ turned @ theirs[:3, :3],
            shift=back @ (turned @ theirs[:3, 3] + gauge.shift - ours[:3, 3]),
            open=back @ gauge.open,
            pending=None,
        )

    def _at_the_next_axis(self, gauge: Gauge, joint: int) -> Iterator[Gauge]:
        axis = joint + 1
        links = self._links(gauge, joint)
        ours, theirs = links[0][:3, 2], links[1][:3, 2]
        if gauge.pending is None:
            yield from self._settled_direction(gauge, links, axis)
            return
        between = np.arctan2(np.hypot(*ours[:2]), abs(ours[2]))
        seen = np.arctan2(np.hypot(*theirs[:2]), abs(theirs[2]))
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
            wanted = (gauge.turn.T @ (links[0][:3, 3] - gauge.shift))[:2]
            theirs = links[1][:2, 3]
            apart = float(np.linalg.norm(wanted))
            if abs(apart - float(np.linalg.norm(theirs))) > self.length:
                self.note(
                    axis, f"axis {axis} is parallel to the axis before it at another distance"
                )
                return
            angle = np.arctan2(wanted[1], wanted[0]) - np.arctan2(theirs[1], theirs[0])
            if apart <= max(5 * self.length, 1e-9):  # one line: any angle will do
                angle = self._aligning(gauge, links)
            yield from self._placed(self._after(gauge, links, float(angle)), axis, sign)

    def _aligning(self, gauge: Gauge, links: tuple[Array, Array]) -> float:
        """The angle about the pending axis that brings the frames beyond the links closest."""
        wanted = gauge.turn.T @ links[0][:3, :3] @ links[1][:3, :3].T
        across, along = wanted[1, 0] - wanted[0, 1], wanted[0, 0] + wanted[1, 1]
        return 0.0 if np.hypot(across, along) < 1e-9 else float(np.arctan2(across, along))

    def _placed(self, gauge: Gauge, axis: int, sign: float) -> Iterator[Gauge]:
        gauge = replace(gauge, signs=(*gauge.signs, sign))
        placed = gauge if self.first.kinds[axis - 1] == "P" else self._on_axis(gauge, axis)
        if placed is not None:
            yield placed

    def _on_axis(self, gauge: Gauge, axis: int) -> Gauge | None:
        """The gauge with the origin on a revolute axis."""
        return self._vanishing(gauge, slice(0, 2), axis, f"axis {axis} stands in another place")

    def _at_the_tool(self, gauge: Gauge) -> Iterator[Gauge]:
        n = self.first.n
        links = self._links(gauge, n)
        angle = 0.0 if gauge.pending is None else self._aligning(gauge, links)
        after = self._after(gauge, links, angle)
        if not self.given.tool:
            nearest, *_ = np.linalg.lstsq(after.open, -after.shift, rcond=1e-3)
            y = np.asarray(nearest, dtype=np.float64)
            yield after.settled(y, np.zeros((after.open.shape[1], 0)))
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
        A, wanted = gauge.open[rows], -gauge.shift[rows]
        U, sizes, V = np.linalg.svd(A, full_matrices=True)
        rank = int((sizes > SETTLED).sum())
        y = V[:rank].T @ ((U[:, :rank].T @ wanted) / sizes[:rank])
        if np.linalg.norm(wanted - A @ y) > self.length:
            self.note(axis, reason)
            return None
        return gauge.settled(y, V[rank:].T)
