"""Curves in a section that the tool has no velocity across.

It has none at singular postures, and on faces of the joint limits; all of the workspace's boundary
is among them. The curves are followed from many seeds at once, in steps of a posture and of the
normal's bearing.
"""

import numpy as np

from ..chain import Chain, elementary
from ..singularity import RegionalArm, Values
from .approach import in_axis_frame, projected
from .lines import chained
from .stands import Plane, Stand, margins, settled, slopes
from .visited import CELL
from .walkers import STEP, Line, followed

__all__ = ["CELL", "STEP", "Line", "barriers", "clearance"]

SEEDS = 6_000
FULL_TURN = 2 * np.pi - 1e-9


def barriers(part: RegionalArm, axes: tuple[str, str], free: tuple[int, ...]) -> list[Line]:
    """Lines within the limits of an arm whose images the tool has no velocity across.

    Singular sets of all free joints that move the tool are whole. Of those with a joint at a limit
    only that is kept which the tool, from this posture, cannot pass. Of lines with the same image
    one is found. Their configurations are of shape (m, n) [rad, m].
    """
    moving = [i for i in free if _moves(part, i, axes)]
    if not moving:
        return []
    low, high = np.transpose(part.limits)
    turning = np.array([_turns(part, i) for i in range(part.chain.n)])
    rest = np.clip(np.zeros(part.chain.n), low, high)
    length = _length(part, moving)
    units = _units(part, moving, length)
    plane = _plane(part, axes, moving, rest, length)
    lines = list[Line]()
    for held, q in _strung(plane, followed(plane, _seeds(plane))):
        whole = np.tile(rest, (len(q), 1))
        whole[:, moving] = q * units
        whole = np.where(turning, low + (whole - low) % (high - low), whole)
        lines.append(Line(held, np.clip(whole, low, high)))
    return lines


def clearance(part: RegionalArm, free: tuple[int, ...]) -> float:
    """How far apart curves are at most that are found as one, as they run the same way [m]."""
    moving = [i for i in free if _moves(part, i, ("r", "z"))]
    return 2 * CELL * _length(part, moving)


def _moves(part: RegionalArm, joint: int, axes: tuple[str, str]) -> bool:
    """Whether a joint moves the tool in the section."""
    low, high = np.transpose(part.limits)
    q = np.random.default_rng(0).uniform(low, high, (64, part.chain.n))
    turned = q.copy()
    turned[:, joint] = q[::-1, joint]
    at = projected(in_axis_frame(part.chain, q), axes)
    other = projected(in_axis_frame(part.chain, turned), axes)
    return bool(np.abs(other - at).max() > 1e-9 * np.abs(at).max())


def _turns(part: RegionalArm, joint: int) -> bool:
    """Whether a joint has no limits: it is revolute and turns all the way round."""
    low, high = part.limits[joint]
    return part.chain.kinds[joint] == "R" and high - low > FULL_TURN


def _length(part: RegionalArm, moving: list[int]) -> float:
    """The length of the arm, all links and slides stretched out [m]."""
    links = np.linalg.norm(part.chain.fixed[1:, :3, 3], axis=-1).sum()
    strokes = 0.0
    for i in moving:
        if part.chain.kinds[i] == "P":
            strokes += np.abs(part.limits[i]).max()
    return float(links + strokes)


def _units(part: RegionalArm, moving: list[int], length: float) -> Values:
    """One unit of each moving joint (k,): a radian, or the length of the arm [m]."""
    revolute = np.array([part.chain.kinds[i] == "R" for i in moving])
    return np.where(revolute, 1.0, length)


def _plane(
    part: RegionalArm, axes: tuple[str, str], moving: list[int], rest: Values, length: float
) -> Plane:
    """The moving joints alone, the others at rest, with all lengths as shares of the arm's."""
    fixed = [np.eye(4)]  # from the frame of axis 1: where the base is changes no slope
    kinds = ""
    for i, (kind, C) in enumerate(zip(part.chain.kinds, part.chain.fixed[1:], strict=True)):
        if i in moving:
            fixed.append(C)
            kinds += kind
        else:
            motion = "Rz" if kind == "R" else "Tz"
            fixed[-1] = fixed[-1] @ elementary(motion, rest[i]) @ C
    shares = np.array(fixed)
    shares[:, :3, 3] /= length

    limits = np.array([part.limits[i] for i in moving], dtype=np.float64)
    limits[[_turns(part, i) for i in moving]] = (-np.inf, np.inf)
    low, high = limits.T / _units(part, moving, length)
    return Plane(Chain(shares, kinds), axes, low, high)


def _seeds(plane: Plane) -> Stand:
    """Postures on barriers, those with no joint at a limit first."""
    rng = np.random.default_rng(1)
    k = plane.chain.n
    bounded = np.isfinite(plane.low)
    low = np.where(bounded, plane.low, -np.pi)
    high = np.where(bounded, plane.high, np.pi)
    held = rng.integers(-1, 2, (SEEDS, k)) * bounded
    held[: SEEDS // 3] = 0
    held = held[(held == 0).any(axis=1)]

    q = rng.uniform(low, high, (len(held), k))
    q = np.where(held < 0, low, q)
    q = np.where(held > 0, high, q)
    bearing = rng.uniform(-np.pi, np.pi, len(held))
    stand, found = settled(plane, Stand(q, bearing, held), 12)
    within = (margins(plane, stand, slopes(plane, stand)) >= 0).all(axis=1)
    return stand.of(found & within)


def _strung(plane: Plane, lines: list[Line]) -> list[Line]:
    """Lines that run on into each other as one; those whose image is a point are left out."""
    points = [plane.points(line.q) for line in lines]
    kinds = [line.held for line in lines]
    strung = list[Line]()
    for row in chained(points, kinds, 1.5 * STEP, CELL):
        joined = Line(kinds[row[0] // 2], _joined(lines, row))
        if np.ptp(plane.points(joined.q), axis=0).max() > CELL:
            strung.append(joined)
    return strung


def _joined(lines: list[Line], row: list[int]) -> Values:
    """The configurations of lines entered at these ends; a ring, whose row does too, closes."""
    parts = list[Values]()
    for end in row:
        q = lines[end // 2].q
        parts.append(q[::-1] if end % 2 else q)
    if len(row) > 1 and row[-1] == row[0]:
        parts[-1] = parts[0][:1]
    return np.concatenate(parts)
