"""Curves in a section that the tool has no velocity across: at singular postures, and on faces of the joint limits.

All of the workspace's boundary is among them. They are followed from many seeds at once, in steps of a posture and of
the normal's bearing.
"""

from itertools import product
from typing import NamedTuple

import numpy as np

from ..chain import Chain, elementary
from ..singularity import RegionalArm, Values
from .approach import in_axis_frame, projected
from .lines import chained
from .stands import Mask, Plane, Stand, Whole, margins, onward, settled, slopes

SEEDS = 6_000
STEP = 0.04  # along a curve [radians and lengths of the arm]
CELL = 0.006  # points that near, of curves that run the same way, are of one curve [lengths of the arm]
SIDE = int(2.4 / CELL)
SPREAD = 40  # cells along a square that gets one seed for each direction
TURNS = 24  # directions told apart on half a turn
REPEATED = (
    4  # steps in a row along another curve before a line ends: it may cross one at a small angle
)
RING = 40  # steps after which a line may come back to itself
MOST = 2000  # steps

Line = tuple[bool, Values]  # whether a joint is held at a limit, and configurations (m, n)


def barriers(part: RegionalArm, axes: tuple[str, str], free: tuple[int, ...]) -> list[Line]:
    """Lines of configurations (m, n) within the limits of an arm, whose images the tool has no velocity across.

    Singular sets of all free joints that move the tool are whole. Of those with a joint at a limit only that is kept
    which the tool, from this posture, cannot pass. Of lines with the same image one is found.
    """
    moving = tuple(i for i in free if _moves(part, i, axes))
    if not moving:
        return []
    low, high = np.transpose(part.limits)
    rest = np.clip(np.zeros(part.chain.n), low, high)
    units, turning = _units(part, moving), np.array([_turns(part, i) for i in range(part.chain.n)])
    plane = _plane(part, axes, moving, rest, units)
    lines = list[Line]()
    for held, q in _strung(plane, _followed(plane, _seeds(plane))):
        whole = np.tile(rest, (len(q), 1))
        whole[:, moving] = q * units[list(moving)]
        whole = np.where(turning, low + (whole - low) % (high - low), whole)
        lines.append((held, np.clip(whole, low, high)))
    return lines


def _moves(part: RegionalArm, joint: int, axes: tuple[str, str]) -> bool:
    """Whether a joint moves the tool in the section."""
    low, high = np.transpose(part.limits)
    q = np.random.default_rng(0).uniform(low, high, (64, part.chain.n))
    turned = q.copy()
    turned[:, joint] = q[::-1, joint]
    at, other = (projected(in_axis_frame(part.chain, x), axes) for x in (q, turned))
    return bool(np.abs(other - at).max() > 1e-9 * np.abs(at).max())


def _turns(part: RegionalArm, joint: int) -> bool:
    low, high = part.limits[joint]
    return part.chain.kinds[joint] == "R" and high - low > 2 * np.pi - 1e-9


def _units(part: RegionalArm, moving: tuple[int, ...]) -> Values:
    """What one unit of each joint is, and of lengths: a radian, or the length of the arm [m]."""
    strokes = [np.abs(part.limits[i]).max() for i in moving if part.chain.kinds[i] == "P"]
    length = float(np.linalg.norm(part.chain.fixed[1:, :3, 3], axis=-1).sum() + sum(strokes))
    return np.array([*(1.0 if kind == "R" else length for kind in part.chain.kinds), length])


def _plane(
    part: RegionalArm, axes: tuple[str, str], moving: tuple[int, ...], rest: Values, units: Values
) -> Plane:
    fixed, kinds = [np.eye(4)], ""  # from the frame of axis 1: where the base is changes no slope
    for i, (kind, C) in enumerate(zip(part.chain.kinds, part.chain.fixed[1:], strict=True)):
        if i in moving:
            fixed.append(C)
            kinds += kind
        else:
            fixed[-1] = fixed[-1] @ elementary("Rz" if kind == "R" else "Tz", rest[i]) @ C
    shares = np.array(fixed)
    shares[:, :3, 3] /= units[-1]
    limits = np.array([(-np.inf, np.inf) if _turns(part, i) else part.limits[i] for i in moving])
    low, high = limits.T / units[list(moving)]
    return Plane(Chain(shares, kinds), axes, low, high)


def _seeds(plane: Plane) -> Stand:
    """Postures on barriers, those with no joint at a limit first."""
    rng, k = np.random.default_rng(1), plane.chain.n
    bounded = np.isfinite(plane.low)
    low, high = np.where(bounded, plane.low, -np.pi), np.where(bounded, plane.high, np.pi)
    held = rng.integers(-1, 2, (SEEDS, k)) * bounded
    held[: SEEDS // 3] = 0
    held = held[(held == 0).any(axis=1)]
    q = rng.uniform(low, high, (len(held), k))
    q = np.where(held < 0, low, np.where(held > 0, high, q))
    stand, found = settled(plane, Stand(q, rng.uniform(-np.pi, np.pi, len(held)), held), 12)
    rates = slopes(plane, stand)
    return stand.of(found & (margins(plane, stand, rates) >= 0).all(axis=1))


def _scattered(plane: Plane, seeds: Stand) -> Whole:
    """Indices of one seed for each square and direction."""
    squares = _places(plane.points(seeds.q), seeds.bearing) // (SPREAD, SPREAD, 1)
    _, first = np.unique(squares, axis=0, return_index=True)
    return np.sort(first)


def _places(at: Values, bearing: Values) -> Whole:
    """Cell and direction (m, 3) of points; a normal and its opposite are one direction."""
    turn = np.floor(bearing % np.pi * (TURNS / np.pi)).astype(int) % TURNS
    return np.column_stack(
        [np.clip(np.floor(at / CELL).astype(int) + SIDE // 2, 1, SIDE - 2), turn]
    )


class _Passed:
    """The line that first came to each place, and at which step."""

    def __init__(self) -> None:
        self.line = np.full((SIDE, SIDE, TURNS), -1, dtype=np.int32)
        self.step = np.zeros((SIDE, SIDE, TURNS), dtype=np.int32)

    def enter(self, at: Values, bearing: Values, line: Whole, step: int) -> None:
        """Lines, the lower ones first, come to these places."""
        x, y, turn = _places(at, bearing)[::-1].T
        fresh = self.line[x, y, turn] < 0
        place = x[fresh], y[fresh], turn[fresh]
        self.line[place], self.step[place] = line[::-1][fresh], step

    def met(self, at: Values, bearing: Values, line: Whole, born: Whole, step: int) -> Mask:
        """Whether another line was at these places or beside them before, or the same one long ago."""
        x, y, turn = _places(at, bearing).T
        found = np.zeros(len(at), dtype=np.bool_)
        for i, j, k in product((-1, 0, 1), repeat=3):
            place = (x + i, y + j, (turn + k) % TURNS)
            first, then = self.line[place], self.step[place]
            between = np.where(
                first == line, step - then, step + then - 2 * born
            )  # along the two ways from one seed
            other = (first < line) | (step - then > 1)
            found |= (first >= 0) & np.where(first >> 1 == line >> 1, between > RING, other)
        return found


class _Walkers(NamedTuple):
    """Lines that are still on their way: where they stand, with margins, unit steps ahead, and numbers of their own."""

    stand: Stand
    margins: Values
    ahead: Values
    line: Whole
    born: Whole  # the step they began at
    repeated: Whole  # steps in a row along other lines

    def joined(self, other: "_Walkers") -> "_Walkers":
        """These lines and then the others."""
        return _Walkers(
            self.stand.joined(other.stand),
            np.concatenate([self.margins, other.margins]),
            np.concatenate([self.ahead, other.ahead]),
            np.concatenate([self.line, other.line]),
            np.concatenate([self.born, other.born]),
            np.concatenate([self.repeated, other.repeated]),
        )


def _started(plane: Plane, stand: Stand, line: int, step: int) -> _Walkers:
    """Both ways on from each posture that is on a barrier: lines 2 i and 2 i + 1, from `line` on."""
    rates = slopes(plane, stand)
    room = margins(plane, stand, rates)
    kept = np.flatnonzero((room > -1e-3).all(axis=1))
    along = np.pad(
        rates.derivatives[:, :, -1], ((0, 0), (0, 1))
    )  # the tool moves along the curve, if it can
    along += 1e-3 * np.random.default_rng(2).normal(size=along.shape)
    ahead, twice = onward(rates, stand.held, along)[kept], np.repeat(kept, 2)
    both = np.stack([ahead, -ahead], axis=1).reshape(-1, ahead.shape[1])
    numbers = np.arange(line, line + len(twice))
    return _Walkers(
        stand.of(twice),
        np.maximum(room[twice], 0.0),
        both,
        numbers,
        np.full_like(numbers, step),
        0 * numbers,
    )


def _followed(plane: Plane, seeds: Stand) -> list[Line]:
    """Lines of the plane's joint values (m, k) from the seeds, each up to where it ends or comes to another line.

    Where a joint comes to its limit, or one that is held would leave it, new lines begin.
    """
    passed, corners, step = _Passed(), set[bytes](), 0
    trails, held = list[list[Values]](), np.zeros(0, dtype=np.bool_)
    walkers = _started(plane, seeds.of(np.arange(0)), 0, 0)
    while len(seeds.q) and step < MOST:
        born = seeds.of(_scattered(plane, seeds))
        while (len(born.q) or len(walkers.line)) and step < MOST:
            started = _started(plane, born, len(trails), step)
            passed.enter(plane.points(started.stand.q), started.stand.bearing, started.line, step)
            trails += [[q] for q in started.stand.q]
            held = np.append(held, (started.stand.held != 0).any(axis=1))
            step += 1
            walkers, last, end, ended = _stepped(
                plane, walkers.joined(started), trails, passed, step
            )
            born = _beyond(plane, last, end, ended, corners)
        lines = np.full(len(seeds.q), len(trails))
        seeds = seeds.of(~passed.met(plane.points(seeds.q), seeds.bearing, lines, lines, step))
    return [(bool(held[i]), np.array(trail)) for i, trail in enumerate(trails) if len(trail) > 1]


def _stepped(
    plane: Plane, walkers: _Walkers, trails: list[list[Values]], passed: _Passed, step: int
) -> tuple[_Walkers, Stand, Whole, Mask]:
    """Those that go on after one step; then where all are, which margin was used up there, and whether one was."""
    stand, room, ahead, line, born, repeated = walkers
    there, found = settled(plane, stand.moved(STEP * ahead), 2)
    found &= np.linalg.norm(there.q - stand.q, axis=1) < 2 * STEP
    rates = slopes(plane, there)
    left = margins(plane, there, rates)
    shares = np.where(left < 0, room / np.maximum(room - left, 1e-300), 1.0)
    share = shares.min(axis=1)
    last = stand.moved(
        share[:, None] * np.column_stack([there.q - stand.q, there.bearing - stand.bearing])
    )
    repeated = np.where(passed.met(rates.at, there.bearing, line, born, step), repeated + 1, 0)
    for i in np.flatnonzero(found).tolist():
        trails[int(line[i])].append(last.q[i])
        if repeated[i] == REPEATED:
            del trails[int(line[i])][1 - REPEATED :]
    found &= repeated < REPEATED
    on = found & (share == 1)
    passed.enter(rates.at[on], there.bearing[on], line[on], step)
    going = _Walkers(
        there.of(on),
        left[on],
        onward(rates, there.held, ahead)[on],
        line[on],
        born[on],
        repeated[on],
    )
    return going, last, shares.argmin(axis=1), found & (share < 1) & (share > 1e-6)


def _beyond(plane: Plane, last: Stand, end: Whole, ended: Mask, corners: set[bytes]) -> Stand:
    """Where lines that ended go on, with one joint more or less at a limit; not twice from the same corner."""
    k = last.q.shape[1]
    held, rows = last.held.copy(), np.flatnonzero(ended & (end < 3 * k))
    held[rows, end[rows] % k] = np.array([-1, 1, 0])[end[rows] // k]
    stand = Stand(np.clip(last.q, plane.low, plane.high), last.bearing, held).of(rows)
    stand = stand.joined(
        Stand(stand.q, stand.bearing + np.pi, stand.held)
    )  # the joint may hold the tool either way
    keys = np.column_stack([_places(plane.points(stand.q), stand.bearing / 2), stand.held]).astype(
        np.int16
    )
    places = {key.tobytes(): i for i, key in enumerate(keys)}
    fresh = [i for key, i in places.items() if key not in corners]
    corners.update(places)
    return stand.of(np.array(fresh, dtype=int))


def _strung(plane: Plane, lines: list[Line]) -> list[Line]:
    """Lines that run on into each other as one; those whose image is a point are left out."""
    points = [plane.points(q) for _, q in lines]
    strung = list[Line]()
    for row in chained(points, [held for held, _ in lines], 1.5 * STEP, CELL):
        ring = len(row) > 1 and row[-1] == row[0]
        parts = [lines[end // 2][1][:: -1 if end % 2 else 1] for end in row[: len(row) - ring]]
        strung.append((lines[row[0] // 2][0], np.concatenate(parts + [parts[0][:1]] * ring)))
    return [(held, q) for held, q in strung if np.ptp(plane.points(q), axis=0).max() > CELL]
