"""Conditions such as sin(q2) = 0: do they hold where they should, and nowhere else?"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Variant
from ...solutions.condition import Condition, equations_of
from ...solutions.expression import Expression
from .common_roots import common_roots
from .sums import equations_within

LINES, STEPS = 6, 720  # grid lines along each joint, and steps along a line, a turn at most
HALVINGS = 60
TURN = 2 * np.pi
EDGE = 0.01  # rad beyond a full turn, so that solutions at its ends are inside
EXACT, HOLDS = 1e-12, 1e-6  # of the size of an expression on its line
NEAR = 1e-4  # of its size a hundredth away: a double root is found to half the digits
MOST_ZEROS = 64  # of an expression within a turn
STARTS = 300  # places from which common zeros are looked for
SLOPE = 1e-4  # to both sides: where an expression is least its slopes are zero too
OUTSIDE = 1e-7  # that a common zero at the end of a range may lie beyond it
Domain = Mapping[str, tuple[float, float]]
Points = dict[str, NDArray[np.float64]]


@dataclass(frozen=True)
class Judged:
    """Which of the student's conditions are true, the share of the points, and what is missing or wrong."""

    holds: tuple[bool, ...]
    share: float
    findings: tuple[str, ...]


def judge_conditions(
    reference: Sequence[Condition], own: Sequence[Condition], domain: Domain, v: Variant
) -> Judged:
    """The student's conditions against the reference, within the ranges of the joints.

    A condition of the student's holds when some reference condition is met wherever it is met; a reference condition is
    covered when the student's conditions together are met wherever it is. Each false one costs one covered.
    """
    met = [_roots(condition, domain, v) for condition in own]
    met = [
        points if _size(points) else _roots(own[i], _more_turns(domain), v)
        for i, points in enumerate(met)
    ]
    holds = tuple(
        bool(_size(points)) and bool(_any_met(reference, points, domain, v).all()) for points in met
    )
    true = [condition for condition, ok in zip(own, holds, strict=True) if ok]
    covered = [_any_met(true, _roots(condition, domain, v), domain, v) for condition in reference]
    full = sum(bool(hit.all()) for hit in covered)
    partial = [hit for hit in covered if hit.any() and not hit.all()]
    false = len(holds) - sum(holds)
    findings: list[str] = []
    if partial:
        findings.append(
            "A condition has more solutions than you list: look for another branch, such as q + π or −q."
        )
    if len(covered) - full - len(partial):
        findings.append("Not all conditions are there.")
    if any(not _size(points) for points in met):
        findings.append("A condition of yours is met nowhere within the limits.")
    if any(_size(points) and not ok for points, ok in zip(met, holds, strict=True)):
        findings.append("A condition of yours holds at postures that are not asked for.")
    return Judged(holds, max(0, full - false) / len(covered), tuple(findings))


def _roots(condition: Condition, domain: Domain, v: Variant) -> Points:
    """Points of the domain where a condition is met: of one expression along lines, of several by common zeros.

    Where one is zero nowhere along lines it may yet be where several joints are right at once, as a sum of squares is;
    where it is no sum of such terms as it stands, its slopes are zero there too.
    """
    equations = equations_of(condition)
    if len(equations) == 1:
        found = _along_lines(equations[0], domain, v)
        if found is None:
            return {name: np.zeros(0) for name in domain}
        if (
            _size(found)
            or (np.abs(equations[0].at({**v, **_spread(domain, LINES)})) <= EXACT).all()
        ):
            return found
    numbers = {name: float(x) for name, x in v.items() if isinstance(x, int | float)}
    sought = [part for equation in equations for part in equations_within(equation, numbers)]

    def values(points: Mapping[str, Any]) -> list[Any]:
        return (
            [part.at(points) for part in sought]
            if len(sought) > 1
            else _with_slopes(sought[0], points, domain)
        )

    return _common(equations, values, domain, v)


def _with_slopes(expression: Expression, points: Mapping[str, Any], domain: Domain) -> list[Any]:
    """Values of an expression and of its derivatives by the joints."""
    values = [expression.at(points)]
    for name in (name for name in domain if name in expression.names):
        ahead = expression.at({**points, name: points[name] + SLOPE})
        back = expression.at({**points, name: points[name] - SLOPE})
        values.append(np.subtract(ahead, back) / (2 * SLOPE))
    return values


def _common(
    equations: Sequence[Expression],
    values: Callable[[Mapping[str, Any]], Sequence[Any]],
    domain: Domain,
    v: Variant,
) -> Points:
    """Points of the domain where all equations are met, sought from many places as common zeros of the values."""
    starts = np.array([*_spread(domain, STARTS).values()])

    def functions(x: NDArray[np.float64]) -> NDArray[np.float64]:
        points: dict[str, Any] = {**v, **dict(zip(domain, x, strict=True))}
        return np.array(
            [np.broadcast_to(value, x.shape[1]) for value in values(points)], dtype=np.float64
        )

    points: Points = dict(zip(domain, common_roots(functions, starts), strict=True))
    kept = np.ones(_size(points), dtype=bool)
    for name, limits in domain.items():
        low, high = _with_edges(limits)
        kept &= (points[name] >= low - OUTSIDE) & (points[name] <= high + OUTSIDE)
    for equation in equations:
        kept &= _is_zero(equation, points, v)
    return {name: place[kept] for name, place in points.items()}


def _along_lines(expression: Expression, domain: Domain, v: Variant) -> Points | None:
    """Points where an expression is zero, on lines parallel to every joint it holds.

    None for an expression that is zero more than 64 times on a line: it is no condition of this kind.
    """
    found: list[Points] = []
    for joint in (name for name in domain if name in expression.names):
        start = _spread(domain, LINES)
        low, high = _with_edges(domain[joint])
        line = np.linspace(low, high, STEPS * math.ceil((high - low) / (TURN + 3 * EDGE)) + 1)
        number, place = _zeros(expression, v, start, joint, line)
        if len(number) and np.bincount(number).max() > MOST_ZEROS * len(line) / STEPS:
            return None
        found.append({name: x[number] for name, x in start.items()} | {joint: place})
    if not found:
        return {name: np.zeros(0) for name in domain}
    return {name: np.concatenate([points[name] for points in found]) for name in domain}


def _spread(domain: Domain, count: int) -> Points:
    """Values inside the ranges, never at a special place."""
    rng = np.random.default_rng(1)
    return {
        name: low + (high - low) * rng.uniform(0.05, 0.95, count)
        for name, (low, high) in domain.items()
    }


def _zeros(
    expression: Expression, v: Variant, start: Points, joint: str, line: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Numbers of lines and places of zeros: at grid points, where the sign changes, and where the size dips to zero."""

    def at(number: NDArray[np.intp], place: NDArray[np.float64]) -> NDArray[np.float64]:
        values: dict[str, Any] = {
            **v,
            **{name: x[number] for name, x in start.items()},
            joint: place,
        }
        return np.broadcast_to(expression.at(values), place.shape)

    every = np.repeat(np.arange(LINES)[:, None], len(line), axis=1)
    along = at(every, np.broadcast_to(line, every.shape))
    size = np.median(
        np.where(np.isfinite(along), np.abs(along), 0.0), axis=1
    )  # a pole is no measure
    size = np.maximum(1.0, size)
    at_zero = np.abs(along) <= EXACT * size[:, None]
    at_zero &= ~at_zero.all(axis=1, keepdims=True)
    exact = np.argwhere(at_zero)
    changes = np.argwhere((along[:, :-1] * along[:, 1:] < 0) & ~at_zero[:, :-1] & ~at_zero[:, 1:])
    inner = np.abs(along)
    dips = (
        (inner[:, 1:-1] < inner[:, :-2])
        & (inner[:, 1:-1] < inner[:, 2:])
        & (along[:, :-2] * along[:, 2:] > 0)
    )
    dips = np.argwhere(dips & ~at_zero[:, 1:-1])
    crossed = _bisected(at, changes[:, 0], line[changes[:, 1]], line[changes[:, 1] + 1])
    lowest = _lowest(at, dips[:, 0], line[dips[:, 1]], line[dips[:, 1] + 2])
    crosses = np.abs(at(changes[:, 0], crossed)) <= HOLDS * size[changes[:, 0]]  # else a pole
    touches = np.abs(at(dips[:, 0], lowest)) <= EXACT * size[dips[:, 0]]
    numbers = (exact[:, 0], changes[crosses, 0], dips[touches, 0])
    return np.concatenate(numbers), np.concatenate(
        [line[exact[:, 1]], crossed[crosses], lowest[touches]]
    )


Along = Callable[[NDArray[np.intp], NDArray[np.float64]], NDArray[np.float64]]


def _bisected(
    at: Along, number: NDArray[np.intp], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Where the sign changes between low and high, all at once."""
    below = at(number, low)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = below * at(number, middle) > 0
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return 0.5 * (low + high)


def _lowest(
    at: Along, number: NDArray[np.intp], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Where the size is least between low and high, by thirds, all at once."""
    for _ in range(2 * HALVINGS):
        third = (high - low) / 3
        left = np.abs(at(number, low + third)) <= np.abs(at(number, high - third))
        low, high = np.where(left, low, low + third), np.where(left, high - third, high)
    return 0.5 * (low + high)


def _any_met(
    conditions: Sequence[Condition], points: Points, domain: Domain, v: Variant
) -> NDArray[np.bool_]:
    """At which points any of the conditions is met."""
    hit = np.zeros(_size(points), dtype=bool)
    for condition in conditions:
        zeros = [
            _zero_in_a_turn(expression, points, domain, v) for expression in equations_of(condition)
        ]
        hit |= np.all(zeros, axis=0)
    return hit


def _zero_in_a_turn(
    expression: Expression, points: Points, domain: Domain, v: Variant
) -> NDArray[np.bool_]:
    """At which points an expression is zero.

    Joints that may turn in full are looked at one turn before and after too: q2 = pi is q2 = -pi.
    """
    hit = np.zeros(_size(points), dtype=bool)
    for shifted in _turned(points, domain):
        hit |= _is_zero(expression, shifted, v)
    return hit


def _is_zero(expression: Expression, points: Points, v: Variant) -> NDArray[np.bool_]:
    """At which points an expression is zero, measured against its size close by."""
    here = np.abs(np.broadcast_to(expression.at({**v, **points}), _size(points)))
    return np.less_equal(here, NEAR * _size_nearby(expression, points, v), dtype=bool)


def _size_nearby(expression: Expression, points: Points, v: Variant) -> NDArray[np.float64]:
    """The largest size of an expression a hundredth away along any joint: a flat stretch is no zero."""
    moved = [
        np.abs(
            np.broadcast_to(
                expression.at({**v, **points, name: points[name] + step}), _size(points)
            )
        )
        for name in points
        if name in expression.names
        for step in (-EDGE, EDGE)
    ]
    return (
        np.max([np.where(np.isfinite(size), size, 0.0) for size in moved], axis=0)
        if moved
        else np.zeros(1)
    )


def _turned(points: Points, domain: Domain) -> Iterator[Points]:
    yield points
    for name in (name for name in domain if _is_turn(domain[name])):
        for turn in (-TURN, TURN):
            yield points | {name: points[name] + turn}


def _more_turns(domain: Domain) -> Domain:
    """Four turns more on both sides: q2 = 3*pi is met there."""
    more = {
        name: (low - 4 * TURN, high + 4 * TURN)
        for name, (low, high) in domain.items()
        if _is_turn((low, high))
    }
    return {**domain, **more}


def _with_edges(limits: tuple[float, float]) -> tuple[float, float]:
    """A range, with what lies beyond a full turn so that solutions at its ends are inside."""
    low, high = limits
    return (low - EDGE, high + EDGE) if _is_turn(limits) else limits


def _is_turn(limits: tuple[float, float]) -> bool:
    return limits[1] - limits[0] >= TURN - EDGE


def _size(points: Points) -> int:
    return len(next(iter(points.values())))
