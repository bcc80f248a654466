"""Ranges of the joints in which conditions are judged, and points inside of them."""

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Domain = Mapping[str, tuple[float, float]]
"""From where to where each joint may go [rad or m]."""
Points = dict[str, Array]
"""For each joint its values (count,) at some points."""

TURN = 2 * np.pi
EDGE = 0.01  # rad beyond a full turn, so that solutions at its ends are inside
MORE = 4  # turns


def no_points(domain: Domain) -> Points:
    """Not a single point."""
    return {name: np.zeros(0) for name in domain}


def count_of(points: Points) -> int:
    """How many points there are."""
    return len(next(iter(points.values())))


def spread(domain: Domain, count: int) -> Points:
    """Points inside the ranges, never at a special place."""
    rng = np.random.default_rng(1)
    points: Points = {}
    for name, (low, high) in domain.items():
        points[name] = low + (high - low) * rng.uniform(0.05, 0.95, count)
    return points


def is_turn(limits: tuple[float, float]) -> bool:
    """Whether a joint may turn in full."""
    return limits[1] - limits[0] >= TURN - EDGE


def with_edges(limits: tuple[float, float]) -> tuple[float, float]:
    """A range, with what lies beyond a full turn so that solutions at its ends are inside."""
    low, high = limits
    if not is_turn(limits):
        return limits
    return low - EDGE, high + EDGE


def more_turns(domain: Domain) -> Domain:
    """Four turns more on both sides, of joints that may turn in full: q2 = 3*pi is met there."""
    wider: dict[str, tuple[float, float]] = {}
    for name, (low, high) in domain.items():
        more = MORE * TURN if is_turn((low, high)) else 0.0
        wider[name] = (low - more, high + more)
    return wider


def turned(points: Points, domain: Domain) -> Iterator[Points]:
    """The points, and the same with each joint that may turn in full a turn before and after."""
    yield points
    for name, limits in domain.items():
        if is_turn(limits):
            for turn in (-TURN, TURN):
                yield points | {name: points[name] + turn}
