"""Conditions such as sin(q2) = 0: do they hold where they should, and nowhere else?"""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.answers import Variant
from ...solutions.condition import Condition, equations_of
from ...solutions.expression import Expression
from .common_roots import common_roots
from .domain import (
    EDGE,
    Array,
    Domain,
    Points,
    count_of,
    more_turns,
    no_points,
    spread,
    turned,
    with_edges,
)
from .line_zeros import EXACT, LINES, zeros_along_lines
from .sums import equations_within
from .work import evaluated

NEAR = 1e-4  # of a size a hundredth away: a double root is found to half the digits
STARTS = 300  # places from which common zeros are looked for
SLOPE = 1e-4  # to both sides: where an expression is least its slopes are zero too
OUTSIDE = 1e-7  # that a common zero at the end of a range may lie beyond it
MORE_SOLUTIONS = (
    "A condition has more solutions than you list: look for another branch, such as q + π or −q."
)
INCOMPLETE = "Not all conditions are there."
NEVER_MET = "A condition of yours is met nowhere within the limits."
NOT_ASKED = "A condition of yours holds at postures that are not asked for."
SENTENCES = (
    MORE_SOLUTIONS,
    INCOMPLETE,
    NEVER_MET,
    NOT_ASKED,
)  # in the order in which they are said
Values = Callable[[Mapping[str, Any]], Sequence[Any]]
"""From values of all names to values of some expressions."""


@dataclass(frozen=True)
class Judged:
    """The student's conditions, judged.

    Attributes:
        holds: Which of them are true.
        share: Share of the points, in [0, 1].
        findings: Sentences on what is missing or wrong.
    """

    holds: tuple[bool, ...]
    share: float
    findings: tuple[str, ...]


def judge_conditions(
    reference: Sequence[Condition], own: Sequence[Condition], domain: Domain, v: Variant
) -> Judged:
    """The student's conditions against the reference, within the ranges of the joints.

    A condition of the student's holds when some reference condition is met wherever it is met; a
    reference condition is covered when the student's conditions together are met wherever it is.
    Each false one costs one covered.
    """
    met = [_met_somewhere(condition, domain, v) for condition in own]
    holds: list[bool] = []
    true: list[Condition] = []
    for condition, points in zip(own, met, strict=True):
        right = count_of(points) > 0 and _any_met(reference, points, domain, v).all()
        holds.append(bool(right))
        if right:
            true.append(condition)

    covered = [_any_met(true, _roots(condition, domain, v), domain, v) for condition in reference]
    full = sum(bool(hit.all()) for hit in covered)
    false = len(holds) - sum(holds)
    share = max(0, full - false) / len(covered)
    return Judged(tuple(holds), share, tuple(_findings(met, holds, covered)))


def _findings(
    met: Sequence[Points], holds: Sequence[bool], covered: Sequence[NDArray[np.bool_]]
) -> list[str]:
    """Sentences on what is missing, from how far each reference condition is covered, or wrong."""
    found: set[str] = set()
    for hit in covered:
        if not hit.all():
            found.add(MORE_SOLUTIONS if hit.any() else INCOMPLETE)
    for points, right in zip(met, holds, strict=True):
        if not count_of(points):
            found.add(NEVER_MET)
        elif not right:
            found.add(NOT_ASKED)
    return [sentence for sentence in SENTENCES if sentence in found]


def _met_somewhere(condition: Condition, domain: Domain, v: Variant) -> Points:
    """Points where a condition is met, looked for some turns beyond the domain if need be.

    The same answer is judged several times: against the reference and against each known mistake.
    """
    return _met_with(condition, tuple(domain.items()), json.dumps(v, sort_keys=True, default=repr))


@lru_cache(maxsize=128)
def _met_with(
    condition: Condition, limits: tuple[tuple[str, tuple[float, float]], ...], numbers: str
) -> Points:
    """The points by what can be looked up; they are not to be written to."""
    domain = dict(limits)
    v: Variant = json.loads(numbers)
    points = _roots(condition, domain, v)
    if count_of(points):
        return points
    return _roots(condition, more_turns(domain), v)


def _roots(condition: Condition, domain: Domain, v: Variant) -> Points:
    """Points of the domain where a condition is met.

    Of one expression they are looked for along lines, of several as common zeros. Where one is zero
    nowhere along lines it may yet be where several joints are right at once, as a sum of squares
    is; where it is no sum of such terms as it stands, its slopes are zero there too.
    """
    equations = equations_of(condition)
    if len(equations) == 1:
        (equation,) = equations
        found = zeros_along_lines(equation, domain, v)
        if found is None:
            return no_points(domain)
        if count_of(found) or _is_zero_everywhere(equation, domain, v):
            return found

    numbers = {name: float(x) for name, x in v.items() if isinstance(x, int | float)}
    sought: list[Expression] = []
    for equation in equations:
        sought += equations_within(equation, numbers)

    def values(points: Mapping[str, Any]) -> list[Any]:
        if len(sought) == 1:
            return _with_slopes(sought[0], points, domain)
        return [evaluated(part, points) for part in sought]

    return _common(equations, values, domain, v)


def _is_zero_everywhere(expression: Expression, domain: Domain, v: Variant) -> bool:
    values = evaluated(expression, {**v, **spread(domain, LINES)})
    return bool((np.abs(values) <= EXACT).all())


def _with_slopes(expression: Expression, points: Mapping[str, Any], domain: Domain) -> list[Any]:
    """Values of an expression and of its derivatives by the joints."""
    values = [evaluated(expression, points)]
    for name in domain:
        if name in expression.names:
            ahead = evaluated(expression, {**points, name: points[name] + SLOPE})
            back = evaluated(expression, {**points, name: points[name] - SLOPE})
            values.append(np.subtract(ahead, back) / (2 * SLOPE))
    return values


def _common(equations: Sequence[Expression], values: Values, domain: Domain, v: Variant) -> Points:
    """Points of the domain where all equations are met: common zeros of the values."""

    def functions(x: Array) -> Array:
        points: dict[str, Any] = {**v, **dict(zip(domain, x, strict=True))}
        rows = [np.broadcast_to(value, x.shape[1]) for value in values(points)]
        return np.array(rows, dtype=np.float64)

    starts = np.array(list(spread(domain, STARTS).values()))
    points: Points = dict(zip(domain, common_roots(functions, starts), strict=True))
    kept = np.ones(count_of(points), dtype=bool)
    for name, limits in domain.items():
        low, high = with_edges(limits)
        kept &= (points[name] >= low - OUTSIDE) & (points[name] <= high + OUTSIDE)
    for equation in equations:
        kept &= _is_zero(equation, points, v)
    return {name: place[kept] for name, place in points.items()}


def _any_met(
    conditions: Sequence[Condition], points: Points, domain: Domain, v: Variant
) -> NDArray[np.bool_]:
    """At which points any of the conditions is met."""
    hit = np.zeros(count_of(points), dtype=bool)
    for condition in conditions:
        equations = equations_of(condition)
        zeros = [_zero_in_a_turn(equation, points, domain, v) for equation in equations]
        hit |= np.all(zeros, axis=0)
    return hit


def _zero_in_a_turn(
    expression: Expression, points: Points, domain: Domain, v: Variant
) -> NDArray[np.bool_]:
    """At which points an expression is zero.

    Joints that may turn in full are looked at one turn before and after too: q2 = pi is q2 = -pi.
    """
    hit = np.zeros(count_of(points), dtype=bool)
    for shifted in turned(points, domain):
        hit |= _is_zero(expression, shifted, v)
    return hit


def _is_zero(expression: Expression, points: Points, v: Variant) -> NDArray[np.bool_]:
    """At which points an expression is zero, measured against its size close by."""
    here = _size(expression, points, v)
    return np.less_equal(here, NEAR * _size_nearby(expression, points, v), dtype=bool)


def _size_nearby(expression: Expression, points: Points, v: Variant) -> Array:
    """The largest size of an expression a hundredth away along any joint.

    A flat stretch is no zero; a pole is no measure.
    """
    largest = np.zeros(1)
    for name in points:
        if name not in expression.names:
            continue
        for step in (-EDGE, EDGE):
            size = _size(expression, points | {name: points[name] + step}, v)
            largest = np.maximum(largest, np.where(np.isfinite(size), size, 0.0))
    return largest


def _size(expression: Expression, points: Points, v: Variant) -> Array:
    """How far from zero an expression is at each of the points."""
    return np.abs(np.broadcast_to(evaluated(expression, {**v, **points}), count_of(points)))
