# pyright: basic
"""Polynomials in lengths, cosines and sines, each cosine and sine of an angle sum a letter of its own.

Sympy rebuilds and sorts an expression at every step; a dictionary of monomials does not.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import sympy as sp

if TYPE_CHECKING:
    from collections.abc import Iterable

Monomial = tuple[Any, ...]  # letters in the order of their sort keys, repeated for powers
MANY = 8  # terms from which on the nested form is sought greedily


@dataclass(frozen=True, eq=False)
class Polynomial:
    """Sum of coefficient times letters; letters are sympy symbols, functions and irrational numbers."""

    terms: dict[Monomial, Any]

    def __add__(self, other: Polynomial) -> Polynomial:
        summed = dict(self.terms)
        for monomial, coefficient in other.terms.items():
            summed[monomial] = summed.get(monomial, 0) + coefficient
        return Polynomial({m: c for m, c in summed.items() if c})

    def __mul__(self, other: Polynomial) -> Polynomial:
        summed: dict[Monomial, Any] = {}
        for left, a in self.terms.items():
            for right, b in other.terms.items():
                monomial = (
                    tuple(sorted(left + right, key=_order)) if left and right else left + right
                )
                summed[monomial] = summed.get(monomial, 0) + a * b
        return Polynomial({m: c for m, c in summed.items() if c})

    def __neg__(self) -> Polynomial:
        return Polynomial({m: -c for m, c in self.terms.items()})

    def __sub__(self, other: Polynomial) -> Polynomial:
        return self + -other

    def diff(self, symbol: sp.Symbol) -> Polynomial:
        """Derivative by one joint or parameter."""
        summed = ZERO
        for monomial, coefficient in self.terms.items():
            for i, letter in enumerate(monomial):
                slope = _slope(letter, symbol)
                if slope.terms:
                    summed = (
                        summed + Polynomial({monomial[:i] + monomial[i + 1 :]: coefficient}) * slope
                    )
        return summed

    def gathered(self) -> Polynomial:
        """Polynomial with irrational numbers multiplied: sqrt(3)*sqrt(3) is one more 3."""
        if not any(letter.is_number for monomial in self.terms for letter in monomial):
            return self
        return polynomial(sp.Add(*(sp.Mul(c, *m) for m, c in self.terms.items())))

    def expression(self) -> sp.Expr:
        """Sympy expression in a short nested form, such as c1*(a2*c2 + a3*c23) + d3*s1."""
        terms = self.gathered().terms
        if not terms:
            return sp.S.Zero
        _, sign, expression = _nested(frozenset(terms.items()))
        return sp.Mul(sign, expression)


ZERO, ONE = Polynomial({}), Polynomial({(): 1})


@cache
def polynomial(expression: Any) -> Polynomial:
    """Polynomial of an expression; what is no sum, product, whole power or rational number is a letter."""
    result = ZERO
    terms: tuple[Any, ...] = sp.Add.make_args(sp.expand(expression))
    for term in terms:
        coefficient, factors = term.as_coeff_mul()
        if not coefficient.is_Rational:
            coefficient, factors = sp.S.One, (coefficient, *factors)
        letters: list[Any] = []
        for factor in factors:
            power = factor.exp if factor.is_Pow and factor.exp.is_Integer and factor.exp > 0 else 1
            letters += [factor if power == 1 else factor.base] * int(power)
        number = int(coefficient) if coefficient.is_Integer else coefficient
        result = result + Polynomial({tuple(sorted(letters, key=_order)): number})
    return result


def total(terms: Iterable[Polynomial]) -> Polynomial:
    """Sum of polynomials."""
    result = ZERO
    for term in terms:
        result = result + term
    return result


def reduced(sum_of_products: Polynomial) -> Polynomial:
    """Polynomial with 1 - cos^2 for every sin^2 of the same angle."""
    result = ZERO
    for monomial, coefficient in sum_of_products.terms.items():
        counts = Counter(monomial)
        squared = {
            letter: n // 2 for letter, n in counts.items() if n > 1 and isinstance(letter, sp.sin)
        }
        counts.subtract({letter: 2 * n for letter, n in squared.items()})
        term = Polynomial({tuple(counts.elements()): coefficient})
        for letter, n in squared.items():
            cosine = sp.cos(letter.args[0])
            for _ in range(n):
                term = term * Polynomial({(): 1, (cosine, cosine): -1})
        result = result + term
    return result


@cache
def _order(letter: Any) -> Any:
    return letter.sort_key()


@cache
def _slope(letter: Any, symbol: sp.Symbol) -> Polynomial:
    return polynomial(sp.diff(letter, symbol)) if letter.has(symbol) else ZERO


@cache
def _nested(items: frozenset[tuple[Monomial, Any]]) -> tuple[int, int, sp.Expr]:
    """Operations, sign and expression: the common letters in front, the rest split by the letter that saves most."""
    terms = dict(items)
    front = _common(terms)
    sign = -1 if all(c < 0 for c in terms.values()) else 1
    rest = {_without(m, front): sign * c for m, c in terms.items()}
    if len(rest) == 1:
        ((monomial, coefficient),) = rest.items()
        letters = front + monomial
        return max(len(letters) - 1, 0) + (coefficient != 1), sign, sp.Mul(coefficient, *letters)
    operations = (
        sum(max(len(m) - 1, 0) + (abs(c) != 1 and bool(m)) for m, c in rest.items()) + len(rest) - 1
    )
    shortest = sp.Add(*(sp.Mul(c, *m) for m, c in rest.items()))
    for letter in _splits(rest):
        inner = _nested(
            frozenset((_without(m, (letter,)), c) for m, c in rest.items() if letter in m)
        )
        other = _nested(frozenset((m, c) for m, c in rest.items() if letter not in m))
        if (found := inner[0] + other[0] + 2) < operations:
            operations = found
            shortest = sp.Mul(inner[1], letter, inner[2]) + sp.Mul(other[1], other[2])
    return operations + len(front), sign, sp.Mul(*front, shortest)


def _splits(terms: dict[Monomial, Any]) -> list[Any]:
    """Letters of two terms or more that may be taken in front; the most frequent one if there are many terms."""
    counts = Counter(letter for monomial in terms for letter in dict.fromkeys(monomial))
    frequent = sorted(
        (x for x, k in counts.items() if k > 1), key=lambda x: (-counts[x], _order(x))
    )
    return frequent if len(terms) <= MANY else frequent[:1]


def _common(terms: dict[Monomial, Any]) -> Monomial:
    shared = Counter(next(iter(terms)))
    for monomial in terms:
        shared &= Counter(monomial)
    return tuple(sorted(shared.elements(), key=_order))


def _without(monomial: Monomial, letters: Monomial) -> Monomial:
    if not letters:
        return monomial
    left = list(monomial)
    for letter in letters:
        left.remove(letter)
    return tuple(left)
