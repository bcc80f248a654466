# pyright: basic
"""Short nested forms of sums of products, such as c1*(a2*c2 + a3*c23) + d3*s1."""

from __future__ import annotations

from collections import Counter
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import sympy as sp

from .monomial import Monomial, common_letters, order, quotient

if TYPE_CHECKING:
    from collections.abc import Mapping

MANY = 8  # terms from which on the nested form is sought greedily


class Nested(NamedTuple):
    """`sign` times `expression`, which takes so many `operations`."""

    operations: int
    sign: int
    expression: sp.Expr


@cache
def nested(terms: frozenset[tuple[Monomial, Any]]) -> Nested:
    """The nested form of a sum of (monomial, coefficient), of which there is one at least.

    The letters that all terms share are put in front. The rest is written as it is, or split into
    the terms with and those without one letter, whichever takes the fewest operations.
    """
    coefficients = dict(terms)
    front = common_letters(coefficients)
    sign = -1 if all(number < 0 for number in coefficients.values()) else 1
    rest: dict[Monomial, Any] = {}
    for monomial, number in coefficients.items():
        rest[quotient(monomial, front)] = sign * number
    if len(rest) == 1:
        return _single(front, sign, rest)

    shortest = Nested(_operations(rest), 1, _sum(rest))
    for letter in _candidates(rest):
        split = _split(rest, letter)
        if split.operations < shortest.operations:
            shortest = split
    whole = sp.Mul(*front, shortest.expression)
    return Nested(shortest.operations + len(front), sign, whole)


def _single(front: Monomial, sign: int, terms: Mapping[Monomial, Any]) -> Nested:
    """The form of one term, whose letters all stand in front."""
    ((monomial, number),) = terms.items()
    letters = front + monomial
    return Nested(_multiplications(letters, number), sign, sp.Mul(number, *letters))


def _split(terms: Mapping[Monomial, Any], letter: Any) -> Nested:
    """A letter times the terms that have it, plus those that have not, both in nested form."""
    inside: set[tuple[Monomial, Any]] = set()
    outside: set[tuple[Monomial, Any]] = set()
    for monomial, number in terms.items():
        if letter in monomial:
            inside.add((quotient(monomial, (letter,)), number))
        else:
            outside.add((monomial, number))

    inner = nested(frozenset(inside))
    other = nested(frozenset(outside))
    operations = inner.operations + other.operations + 2  # the letter's product, and the sum
    product = sp.Mul(inner.sign, letter, inner.expression)
    return Nested(operations, 1, product + sp.Mul(other.sign, other.expression))


def _candidates(terms: Mapping[Monomial, Any]) -> list[Any]:
    """Letters of two terms or more, the most frequent first; only that one of many terms."""
    counts: Counter[Any] = Counter()
    for monomial in terms:
        counts.update(set(monomial))
    shared = [letter for letter, count in counts.items() if count > 1]
    shared.sort(key=lambda letter: (-counts[letter], order(letter)))
    return shared if len(terms) <= MANY else shared[:1]


def _operations(terms: Mapping[Monomial, Any]) -> int:
    """Products and sums of a sum that is written as it is; signs cost nothing."""
    operations = len(terms) - 1
    for monomial, number in terms.items():
        if monomial:
            operations += _multiplications(monomial, abs(number))
    return operations


def _multiplications(letters: Monomial, number: Any) -> int:
    """Products that a term takes: one less than it has factors, a 1 in front not counted."""
    return max(len(letters) - 1, 0) + int(number != 1)


def _sum(terms: Mapping[Monomial, Any]) -> sp.Expr:
    products = [sp.Mul(number, *monomial) for monomial, number in terms.items()]
    return sp.Add(*products)
