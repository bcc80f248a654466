# pyright: basic
"""The shortest of the forms that a sum of products of cosines and sines can be written in."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.simplify.fu import TR8

from .nested import nested
from .polynomial import Polynomial, polynomial, reduced, without_squares

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

MANY = 48  # terms above which no angles are summed


def shortest(given: Polynomial, angles: Sequence[sp.Symbol]) -> sp.Expr:
    """The form of a sum with the fewest operations, in single angles or in sums of some of them.

    cos a cos b - sin a sin b is cos(a + b), where that is shorter. Squares of cosines or of sines
    stay or give way to each other.
    """
    least = _with_best_squares(given, angles)
    if len(given.terms) <= MANY:
        for summed in _with_summed_angles(given, angles):
            other = _with_best_squares(summed, angles)
            if _operations(other) < _operations(least):
                least = other
    return least.expression()


def with_whole_squares(form: Any) -> Any:
    """The form with sin^2 in place of 1 - cos^2 in brackets, and cos^2 in place of 1 - sin^2."""
    shorter: dict[Any, Any] = {}
    for function in form.atoms(sp.cos, sp.sin):
        (angle,) = function.args
        other = sp.cos(angle) if isinstance(function, sp.sin) else sp.sin(angle)
        shorter[1 - function**2] = other**2
        shorter[function**2 - 1] = -(other**2)
    return form.xreplace(shorter)


def _with_best_squares(given: Polynomial, angles: Sequence[sp.Symbol]) -> Polynomial:
    """The sum with the squares that make it shortest, chosen for one angle after the other."""
    least = reduced(given)
    if _operations(given) < _operations(least):
        least = given
    for angle in angles:
        for function in (sp.sin(angle), sp.cos(angle)):
            other = without_squares(least, {function})
            if _operations(other) < _operations(least):
                least = other
    return least


def _with_summed_angles(given: Polynomial, angles: Sequence[sp.Symbol]) -> Iterator[Polynomial]:
    """The sum with products of the functions of neighbouring angles as those of their sums."""
    letters = given.letters()
    present = [q for q in angles if letters & {sp.cos(q), sp.sin(q)}]
    expression = given.expression()
    for first, last in combinations(range(len(present)), 2):
        kept: dict[Any, Any] = {}
        for q in (*present[:first], *present[last + 1 :]):
            kept[sp.cos(q)] = sp.Dummy()
            kept[sp.sin(q)] = sp.Dummy()
        # cos a cos b = (cos(a - b) + cos(a + b)) / 2
        summed = TR8(sp.expand(expression.xreplace(kept)))
        back = {dummy: function for function, dummy in kept.items()}
        yield polynomial(summed.xreplace(back))


def _operations(of: Polynomial) -> int:
    if not of.terms:
        return 0
    return nested(frozenset(of.terms.items())).operations
