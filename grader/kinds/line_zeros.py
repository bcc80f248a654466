"""Where one expression is zero along lines parallel to the joints."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Variant
from ...solutions.expression import Expression
from .domain import EDGE, TURN, Array, Domain, Points, no_points, spread, with_edges
from .work import evaluated

LINES = 6  # along each joint
STEPS = 720  # along a line, a turn at most
PARTS = 16  # into which an interval is cut at once
CUTS = 16  # of an interval to a sixteenth, until there is no float in it
FINER_CUTS = 22  # to an eighth
STEEP = 1.5  # by how much a size falls within a step of the line to come to zero
EXACT = 1e-12  # of the size of an expression on its line: what is zero but for rounding
HOLDS = 1e-6  # of its size: what is small where its sign changes, unlike at a pole
MOST_ZEROS = 64  # of an expression within a turn

Numbers = NDArray[np.intp]
Along = Callable[[Numbers, Array], Array]
"""From numbers of lines and places on them to values of an expression."""
Zeros = tuple[Numbers, Array]
"""Numbers of lines (count,) and places on them (count,)."""


@dataclass(frozen=True, eq=False)
class _Sampled:
    """An expression along some lines.

    `values` (lines, steps) are those at the places `line` (steps,), `size` (lines,) is how large
    they are, and `at_zero` (lines, steps) says where they are zero on a line that is not all zero.
    """

    at: Along
    line: Array
    values: Array
    size: Array
    at_zero: NDArray[np.bool_]


def zeros_along_lines(expression: Expression, domain: Domain, v: Variant) -> Points | None:
    """Points where an expression is zero, on lines parallel to every joint it holds.

    None for an expression that is zero more than 64 times within a turn: it is no condition of this
    kind.
    """
    found = no_points(domain)
    for joint, limits in domain.items():
        if joint not in expression.names:
            continue
        start = spread(domain, LINES)
        low, high = with_edges(limits)
        turns = math.ceil((high - low) / (TURN + 3 * EDGE))
        line = np.linspace(low, high, STEPS * turns + 1)
        number, place = _zeros(_sampled(expression, v, start, joint, line))
        if len(number) and np.bincount(number).max() > MOST_ZEROS * len(line) / STEPS:
            return None

        for name, values in start.items():
            new = place if name == joint else values[number]
            found[name] = np.concatenate([found[name], new])
    return found


def _sampled(
    expression: Expression, v: Variant, start: Points, joint: str, line: Array
) -> _Sampled:
    """An expression along lines through the points of `start`, on which `joint` alone varies."""
    others = [name for name in start if name in expression.names and name != joint]

    def at(number: Numbers, place: Array) -> Array:
        values: dict[str, Any] = dict(v)
        for name in others:
            values[name] = start[name][number]
        values[joint] = place
        return np.broadcast_to(evaluated(expression, values), place.shape)

    every = np.repeat(np.arange(LINES)[:, None], len(line), axis=1)
    values = at(every, np.broadcast_to(line, every.shape))
    sizes = np.where(np.isfinite(values), np.abs(values), 0.0)  # a pole is no measure
    size = np.maximum(1.0, np.median(sizes, axis=1))
    at_zero = np.abs(values) <= EXACT * size[:, None]
    at_zero &= ~at_zero.all(axis=1, keepdims=True)
    return _Sampled(at, line, values, size, at_zero)


def _zeros(sampled: _Sampled) -> Zeros:
    """Zeros at the samples, where the sign changes, and where the size dips to zero."""
    exact = np.argwhere(sampled.at_zero)
    crossed, crossed_at = _crossings(sampled)
    touched, touched_at = _touches(sampled)
    numbers = np.concatenate([exact[:, 0], crossed, touched])
    return numbers, np.concatenate([sampled.line[exact[:, 1]], crossed_at, touched_at])


def _crossings(sampled: _Sampled) -> Zeros:
    """Zeros between two samples of opposite signs."""
    values, line, at_zero = sampled.values, sampled.line, sampled.at_zero
    changes = (values[:, :-1] * values[:, 1:] < 0) & ~at_zero[:, :-1] & ~at_zero[:, 1:]
    number, first = np.argwhere(changes).T
    place = _bisected(sampled.at, number, line[first], line[first + 1])
    small = np.abs(sampled.at(number, place)) <= HOLDS * sampled.size[number]  # else a pole
    return number[small], place[small]


def _touches(sampled: _Sampled) -> Zeros:
    """Zeros between three samples of one sign, the size of the middle one being the least.

    Around a zero one of the others is much larger, at least three times as far from it; all along a
    line that is nowhere zero there are dips that are not, by rounding alone.
    """
    values, line, size = sampled.values, sampled.line, np.abs(sampled.values)
    before, middle, behind = size[:, :-2], size[:, 1:-1], size[:, 2:]
    dips = (middle < before) & (middle < behind)
    dips &= np.maximum(before, behind) >= STEEP * middle
    dips &= values[:, :-2] * values[:, 2:] > 0
    number, first = np.argwhere(dips & ~sampled.at_zero[:, 1:-1]).T
    place = _lowest(sampled.at, number, line[first], line[first + 2])
    is_zero = np.abs(sampled.at(number, place)) <= EXACT * sampled.size[number]
    return number[is_zero], place[is_zero]


def _bisected(at: Along, number: Numbers, low: Array, high: Array) -> Array:
    """Where the sign changes between low and high, all at once."""
    if not len(number):
        return low
    below = at(number, low)
    every = np.arange(len(number))
    for _ in range(CUTS):
        places = _between(low, high)
        same = below * at(np.broadcast_to(number, places.shape), places) > 0
        same[0], same[-1] = True, False
        first = same.argmin(axis=0)  # behind a change of sign
        low, high = places[first - 1, every], places[first, every]
    return 0.5 * (low + high)


def _lowest(at: Along, number: Numbers, low: Array, high: Array) -> Array:
    """Where the size is least between low and high, all at once."""
    if not len(number):
        return low
    every = np.arange(len(number))
    for _ in range(FINER_CUTS):
        places = _between(low, high)
        sizes = np.abs(at(np.broadcast_to(number, places.shape), places))
        least = np.where(np.isfinite(sizes), sizes, np.inf).argmin(axis=0)
        low = places[np.maximum(least - 1, 0), every]
        high = places[np.minimum(least + 1, PARTS), every]
    return 0.5 * (low + high)


def _between(low: Array, high: Array) -> Array:
    """Places (17, count) from low to high: a call of numpy costs as much as hundreds of them."""
    shares = np.linspace(0.0, 1.0, PARTS + 1)[:, None]
    return low + (high - low) * shares
