"""Conditions such as sin(q2) = 0: do they hold where they should, and nowhere else?"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..exercises.answers import Variant
from ..solutions.expression import Expression

LINES, STEPS = 6, 720  # grid lines along each joint, and steps along a line, a turn at most
HALVINGS = 60
TURN = 2 * np.pi
EDGE = 0.01  # rad beyond a full turn, so that solutions at its ends are inside
HOLDS = 1e-6  # of the size of an expression: a double root is found to half the digits
Domain = Mapping[str, tuple[float, float]]
Points = dict[str, NDArray[np.float64]]


@dataclass(frozen=True)
class Judged:
    """Which of the student's conditions are true, the share of the points, and what is missing or wrong."""

    holds: tuple[bool, ...]
    share: float
    findings: tuple[str, ...]


def judge_conditions(reference: Sequence[Expression], own: Sequence[Expression], domain: Domain, v: Variant) -> Judged:
    """The student's conditions against the reference, within the ranges of the joints.

    A condition of the student's holds when some reference condition is met wherever it is met; a reference condition is
    covered when the student's conditions together are met wherever it is. Each false one costs one covered.
    """
    met = [_roots(expression, domain, v) for expression in own]
    met = [points if _size(points) else _roots(own[i], _more_turns(domain), v) for i, points in enumerate(met)]
    holds = tuple(bool(_size(points)) and bool(_any_zero(reference, points, domain, v).all()) for points in met)
    true = [expression for expression, ok in zip(own, holds, strict=True) if ok]
    covered = [_any_zero(true, _roots(expression, domain, v), domain, v) for expression in reference]
    full = sum(bool(hit.all()) for hit in covered)
    partial = [hit for hit in covered if hit.any() and not hit.all()]
    false = len(holds) - sum(holds)
    findings: list[str] = []
    if partial:
        findings.append("A condition has more solutions than you list: look for another branch, such as q + π or −q.")
    if len(covered) - full - len(partial):
        findings.append("Not all conditions are there.")
    if any(not _size(points) for points in met):
        findings.append("A condition of yours is met nowhere within the limits.")
    if any(_size(points) and not ok for points, ok in zip(met, holds, strict=True)):
        findings.append("A condition of yours holds at postures that are not asked for.")
    return Judged(holds, max(0, full - false) / len(covered), tuple(findings))


def _roots(expression: Expression, domain: Domain, v: Variant) -> Points:
    """Points of the domain where an expression is zero, found along lines parallel to every joint it holds."""
    joints = [name for name in domain if name in expression.names]
    found: list[Points] = []
    for joint in joints:
        start = _spread(domain, LINES)
        low, high = domain[joint]
        low, high = (low - EDGE, high + EDGE) if _is_turn(domain[joint]) else (low, high)
        line = np.linspace(low, high, STEPS * math.ceil((high - low) / (TURN + 3 * EDGE)) + 1)
        values: dict[str, Any] = {**v, **{name: x[:, None] for name, x in start.items()}, joint: line[None]}
        along = np.broadcast_to(expression.at(values), (LINES, len(line)))
        for number, place in _zeros_on_lines(expression, values, along, joint, line):
            found.append({name: np.array([x[number]]) for name, x in start.items()} | {joint: np.array([place])})
    if not found:
        return {name: np.zeros(0) for name in domain}
    return {name: np.concatenate([point[name] for point in found]) for name in domain}


def _spread(domain: Domain, count: int) -> Points:
    """Values inside the ranges, never at a special place."""
    rng = np.random.default_rng(1)
    return {name: low + (high - low) * rng.uniform(0.05, 0.95, count) for name, (low, high) in domain.items()}


def _zeros_on_lines(
    expression: Expression, values: Mapping[str, Any], along: NDArray[np.float64], joint: str, line: NDArray[np.float64]
) -> list[tuple[int, float]]:
    """(line, place) of every zero: at grid points, where the sign changes, and where the size has a minimum at zero."""
    found: list[tuple[int, float]] = []
    size = np.median(np.where(np.isfinite(along), np.abs(along), 0.0), axis=1)  # a pole is no measure
    for number, row in enumerate(along):
        fixed = {name: x[number, 0] if np.ndim(x) == 2 and x.shape[0] == LINES else x for name, x in values.items()}
        at_zero = np.abs(row) <= 1e-12 * max(1.0, size[number])
        if at_zero.all():
            continue
        found += [(number, float(x)) for x in line[at_zero]]
        changes = np.flatnonzero((row[:-1] * row[1:] < 0) & ~at_zero[:-1] & ~at_zero[1:])
        inner = np.abs(row)
        dips = np.flatnonzero((inner[1:-1] < inner[:-2]) & (inner[1:-1] < inner[2:]) & (row[:-2] * row[2:] > 0)) + 1
        for i in changes:
            place = _bisected(expression, fixed, joint, float(line[i]), float(line[i + 1]))
            if abs(_value(expression, fixed, joint, place)) <= 1e-6 * max(1.0, size[number]):  # else a pole
                found.append((number, place))
        for i in dips[~at_zero[dips]]:
            place = _lowest(expression, fixed, joint, float(line[i - 1]), float(line[i + 1]))
            if abs(_value(expression, fixed, joint, place)) <= 1e-12 * max(1.0, size[number]):
                found.append((number, place))
    return found


def _value(expression: Expression, fixed: Mapping[str, Any], joint: str, x: float) -> float:
    return float(expression.at({**fixed, joint: x}))


def _bisected(expression: Expression, fixed: Mapping[str, Any], joint: str, low: float, high: float) -> float:
    below = _value(expression, fixed, joint, low)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        here = _value(expression, fixed, joint, middle)
        low, high = (middle, high) if below * here > 0 else (low, middle)
    return 0.5 * (low + high)


def _lowest(expression: Expression, fixed: Mapping[str, Any], joint: str, low: float, high: float) -> float:
    """Where the size is least, by thirds."""
    for _ in range(2 * HALVINGS):
        third = (high - low) / 3
        left, right = (abs(_value(expression, fixed, joint, x)) for x in (low + third, high - third))
        low, high = (low, high - third) if left <= right else (low + third, high)
    return 0.5 * (low + high)


def _any_zero(expressions: Sequence[Expression], points: Points, domain: Domain, v: Variant) -> NDArray[np.bool_]:
    """At which points any of the expressions is zero, measured against its size over the domain.

    Joints that may turn in full are looked at one turn before and after too: q2 = pi is q2 = -pi.
    """
    count = _size(points)
    hit = np.zeros(count, dtype=bool)
    everywhere: dict[str, Any] = {**v, **_spread(domain, 64)}
    for expression in expressions:
        typical = np.abs(np.broadcast_to(expression.at(everywhere), 64))
        scale = float(np.median(typical[np.isfinite(typical)])) if np.isfinite(typical).any() else 1.0
        for shifted in _turned(points, domain):
            here = np.broadcast_to(expression.at({**v, **shifted}), count)
            hit |= np.abs(here) <= HOLDS * max(scale, 1e-9)
    return hit


def _turned(points: Points, domain: Domain) -> Iterator[Points]:
    yield points
    for name in (name for name in domain if _is_turn(domain[name])):
        for turn in (-TURN, TURN):
            yield points | {name: points[name] + turn}


def _more_turns(domain: Domain) -> Domain:
    """Four turns more on both sides: q2 = 3*pi is met there."""
    more = {name: (low - 4 * TURN, high + 4 * TURN) for name, (low, high) in domain.items() if _is_turn((low, high))}
    return {**domain, **more}


def _is_turn(limits: tuple[float, float]) -> bool:
    return limits[1] - limits[0] >= TURN - EDGE


def _size(points: Points) -> int:
    return len(next(iter(points.values())))
