"""Lines of a section that grow on both sides of their seeds, all at once, a step at a time."""

from typing import NamedTuple

import numpy as np

from ..singularity import Values
from .stands import Mask, Plane, Stand, Whole, margins, onward, settled, slopes
from .visited import Visited, places

STEP = 0.04  # along a curve [radians and arm lengths]
SPREAD = 40  # cells along a square that gets one seed for each direction
REPEATED = 4  # steps in a row along another curve end a line; it may cross one at a slant
MOST = 2000  # steps


class Line(NamedTuple):
    """Configurations `q` (m, n) along a line, and whether a joint is `held` at a limit."""

    held: bool
    q: Values


class Walkers(NamedTuple):
    """Lines that are still on their way.

    Attributes:
        stand: Where they are.
        margins: What may not fall below zero there (m, 3 k + 2).
        ahead: Unit steps of joints and bearing (m, k + 1).
        line: Numbers of their own (m,).
        born: The steps they began at (m,).
        repeated: Steps in a row along other lines (m,).
    """

    stand: Stand
    margins: Values
    ahead: Values
    line: Whole
    born: Whole
    repeated: Whole

    def joined(self, other: "Walkers") -> "Walkers":
        """These lines and then the others."""
        return Walkers(
            self.stand.joined(other.stand),
            np.concatenate([self.margins, other.margins]),
            np.concatenate([self.ahead, other.ahead]),
            np.concatenate([self.line, other.line]),
            np.concatenate([self.born, other.born]),
            np.concatenate([self.repeated, other.repeated]),
        )


class Advance(NamedTuple):
    """What became of lines in one step.

    Attributes:
        going: Those that go on.
        last: Where all lines are, short of the step where a margin was used up.
        end: The margin that is used up first (m,).
        ended: Whether it is what ended the line (m,).
    """

    going: Walkers
    last: Stand
    end: Whole
    ended: Mask


class Walk:
    """All lines of a plane, as far as they are followed."""

    def __init__(self, plane: Plane) -> None:
        self.plane = plane
        self.visited = Visited()
        self.corners = set[bytes]()
        self.trails = list[list[Values]]()
        self.held = list[bool]()
        self.step = 0

    def lines(self) -> list[Line]:
        """The lines of more than a point."""
        found = list[Line]()
        for held, trail in zip(self.held, self.trails, strict=True):
            if len(trail) > 1:
                found.append(Line(held, np.array(trail)))
        return found

    def follow(self, seeds: Stand) -> None:
        """Goes on from seeds both ways, up to where lines end or come to another line.

        Where a joint comes to its limit, or one that is held would leave it, new lines begin.
        """
        born = seeds
        walkers = started(self.plane, seeds.of(np.arange(0)), 0, 0)
        while (len(born.q) or len(walkers.line)) and self.step < MOST:
            walkers = walkers.joined(self._begun(born))
            self.step += 1
            advance = self._advanced(walkers)
            walkers = advance.going
            born = self._beyond(advance)

    def unvisited(self, seeds: Stand) -> Stand:
        """The seeds that no line has come to."""
        coming = np.full(len(seeds.q), len(self.trails))  # the number of a line yet to begin
        at = self.plane.points(seeds.q)
        return seeds.of(~self.visited.met(at, seeds.bearing, coming, coming, self.step))

    def _begun(self, born: Stand) -> Walkers:
        """The lines that begin at postures, entered everywhere."""
        begun = started(self.plane, born, len(self.trails), self.step)
        stand = begun.stand
        self.visited.enter(self.plane.points(stand.q), stand.bearing, begun.line, self.step)
        for q, held in zip(stand.q, stand.held, strict=True):
            self.trails.append([q])
            self.held.append(bool(held.any()))
        return begun

    def _advanced(self, walkers: Walkers) -> Advance:
        """One step of all lines."""
        stand, room, ahead, line, born, repeated = walkers
        there, found = settled(self.plane, stand.moved(STEP * ahead), 2)
        change = np.column_stack([there.q - stand.q, there.bearing - stand.bearing])
        found &= np.linalg.norm(change[:, :-1], axis=1) < 2 * STEP  # else it is another curve

        # Up to where the first margin is used up, on a straight line between both postures
        rates = slopes(self.plane, there)
        left = margins(self.plane, there, rates)
        shares = np.where(left < 0, room / np.maximum(room - left, 1e-300), 1.0)
        share = shares.min(axis=1)
        last = stand.moved(share[:, None] * change)

        met = self.visited.met(rates.at, there.bearing, line, born, self.step)
        repeated = np.where(met, repeated + 1, 0)
        self._lengthen(line[found], last.q[found], repeated[found])
        found &= repeated < REPEATED

        on = found & (share == 1)
        self.visited.enter(rates.at[on], there.bearing[on], line[on], self.step)
        onwards = onward(rates, there.held, ahead)
        going = Walkers(there.of(on), left[on], onwards[on], line[on], born[on], repeated[on])
        ended = found & (share < 1) & (share > 1e-6)
        return Advance(going, last, shares.argmin(axis=1), ended)

    def _lengthen(self, line: Whole, q: Values, repeated: Whole) -> None:
        """Puts a posture to each line; those that run along another lose what repeats it."""
        for i, number in enumerate(line):
            trail = self.trails[int(number)]
            trail.append(q[i])
            if repeated[i] == REPEATED:
                del trail[1 - REPEATED :]

    def _beyond(self, advance: Advance) -> Stand:
        """Where lines that ended go on, with one joint more or less at a limit.

        They do not go on twice from the same corner.
        """
        last = advance.last
        k = last.q.shape[1]
        # Of the margins, the first k are to lower limits, then to upper ones, then of held joints.
        rows = np.flatnonzero(advance.ended & (advance.end < 3 * k))
        kind, joint = np.divmod(advance.end[rows], k)
        held = last.held.copy()
        held[rows, joint] = np.array([-1, 1, 0])[kind]
        inside = np.clip(last.q, self.plane.low, self.plane.high)
        stand = Stand(inside, last.bearing, held).of(rows)
        # The joint may hold the tool either way.
        stand = stand.joined(Stand(stand.q, stand.bearing + np.pi, stand.held))

        # With half the bearing, opposite normals are two directions.
        cells = places(self.plane.points(stand.q), stand.bearing / 2)
        keys = np.column_stack([cells, stand.held]).astype(np.int16)
        corners = {key.tobytes(): i for i, key in enumerate(keys)}
        fresh = [i for key, i in corners.items() if key not in self.corners]
        self.corners.update(corners)
        return stand.of(np.array(fresh, dtype=int))


def followed(plane: Plane, seeds: Stand) -> list[Line]:
    """Lines of the plane's joint values (m, k) from the seeds, each up to where it ends.

    It may end at another line.
    """
    walk = Walk(plane)
    while len(seeds.q) and walk.step < MOST:
        walk.follow(seeds.of(_scattered(plane, seeds)))
        seeds = walk.unvisited(seeds)
    return walk.lines()


def started(plane: Plane, stand: Stand, line: int, step: int) -> Walkers:
    """Both ways on from each posture on a barrier: lines 2 i and 2 i + 1, from `line` on."""
    rates = slopes(plane, stand)
    room = margins(plane, stand, rates)
    kept = np.flatnonzero((room > -1e-3).all(axis=1))
    # The tool moves along the curve, if it can; a little noise decides where it cannot.
    along = np.pad(rates.derivatives[:, :, -1], ((0, 0), (0, 1)))
    along += 1e-3 * np.random.default_rng(2).normal(size=along.shape)
    ahead = onward(rates, stand.held, along)[kept]
    both = np.stack([ahead, -ahead], axis=1).reshape(-1, ahead.shape[1])

    twice = np.repeat(kept, 2)
    numbers = np.arange(line, line + len(twice))
    return Walkers(
        stand.of(twice),
        np.maximum(room[twice], 0.0),
        both,
        numbers,
        born=np.full_like(numbers, step),
        repeated=np.zeros_like(numbers),
    )


def _scattered(plane: Plane, seeds: Stand) -> Whole:
    """Indices of one seed for each square and direction."""
    squares = places(plane.points(seeds.q), seeds.bearing) // (SPREAD, SPREAD, 1)
    _, first = np.unique(squares, axis=0, return_index=True)
    return np.sort(first)
