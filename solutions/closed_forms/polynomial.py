# pyright: basic
"""Polynomials in lengths, cosines and sines, each cosine and sine of an angle sum its own letter.

Sympy rebuilds and sorts an expression at every step; a dictionary of monomials does not.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import sympy as sp

from .monomial import Monomial, monomial_of, product_of
from .nested import nested

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

__all__ = [
    "ONE",
    "ZERO",
    "Monomial",
    "Polynomial",
    "polynomial",
    "reduced",
    "total",
    "without_squares",
]


@dataclass(frozen=True, eq=False)
class Polynomial:
    """Sum of coefficient times letters, which are sympy symbols, functions, irrational numbers.

    `terms` holds the coefficient, a rational number, of each monomial; none of them is zero.
    """

    terms: dict[Monomial, Any]

    def __add__(self, other: Polynomial) -> Polynomial:
        summed = dict(self.terms)
        for monomial, coefficient in other.terms.items():
            summed[monomial] = summed.get(monomial, 0) + coefficient
        return _without_zeros(summed)

    def __mul__(self, other: Polynomial) -> Polynomial:
        summed: dict[Monomial, Any] = {}
        for left, a in self.terms.items():
            for right, b in other.terms.items():
                monomial = product_of(left, right)
                summed[monomial] = summed.get(monomial, 0) + a * b
        return _without_zeros(summed)

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
                if slope.terms:  # the product rule: one letter after the other
                    others = monomial[:i] + monomial[i + 1 :]
                    summed = summed + Polynomial({others: coefficient}) * slope
        return summed

    def gathered(self) -> Polynomial:
        """Polynomial with irrational numbers multiplied: sqrt(3)*sqrt(3) is one more 3."""
        letters = self.letters()
        if not any(letter.is_number for letter in letters):
            return self
        products = [sp.Mul(c, *m) for m, c in self.terms.items()]
        return polynomial(sp.Add(*products))

    def letters(self) -> set[Any]:
        """All letters of the monomials."""
        return set[Any]().union(*self.terms)

    def expression(self) -> sp.Expr:
        """Sympy expression in a short nested form, such as c1*(a2*c2 + a3*c23) + d3*s1."""
        terms = self.gathered().terms
        if not terms:
            return sp.S.Zero
        form = nested(frozenset(terms.items()))
        return sp.Mul(form.sign, form.expression)


ZERO = Polynomial({})
ONE = Polynomial({(): 1})


@cache
def polynomial(expression: Any) -> Polynomial:
    """Polynomial of an expression.

    What is no sum, product, whole power or rational number is a letter.
    """
    return total(_of_product(term) for term in sp.Add.make_args(sp.expand(expression)))


def total(terms: Iterable[Polynomial]) -> Polynomial:
    """Sum of polynomials."""
    summed: dict[Monomial, Any] = {}
    for term in terms:
        for monomial, coefficient in term.terms.items():
            summed[monomial] = summed.get(monomial, 0) + coefficient
    return _without_zeros(summed)


def reduced(sum_of_products: Polynomial) -> Polynomial:
    """Polynomial with 1 - cos^2 for every sin^2 of the same angle."""
    sines = {letter for letter in sum_of_products.letters() if isinstance(letter, sp.sin)}
    return without_squares(sum_of_products, sines)


def without_squares(sum_of_products: Polynomial, functions: Collection[Any]) -> Polynomial:
    """Polynomial in which none of these sines and cosines has a power above the first.

    A square is one less the square of the same angle's other function.
    """
    if not functions:
        return sum_of_products
    terms = sum_of_products.terms.items()
    return total(_of_first_degree(m, c, functions) for m, c in terms)


def _without_zeros(terms: dict[Monomial, Any]) -> Polynomial:
    return Polynomial({m: c for m, c in terms.items() if c})


def _of_product(term: Any) -> Polynomial:
    number, factors = term.as_coeff_mul()
    if not number.is_Rational:
        number, factors = sp.S.One, (number, *factors)
    letters: list[Any] = []
    for factor in factors:
        if factor.is_Pow and factor.exp.is_Integer and factor.exp > 0:
            letters += [factor.base] * int(factor.exp)
        else:
            letters.append(factor)
    # Python's integers are faster than sympy's; both are equal as coefficients.
    coefficient = int(number) if number.is_Integer else number
    return Polynomial({monomial_of(letters): coefficient})


def _of_first_degree(
    monomial: Monomial, coefficient: Any, functions: Collection[Any]
) -> Polynomial:
    """A term in which none of the functions is left with a power above the first."""
    kept: list[Any] = []
    squares: list[Polynomial] = []
    for letter, power in Counter(monomial).items():
        if power > 1 and letter in functions:
            pairs, single = divmod(power, 2)
            squares += [_squared(letter)] * pairs
            kept += [letter] * single
        else:
            kept += [letter] * power

    term = Polynomial({tuple(kept): coefficient})
    for square in squares:
        term = term * square
    return term


@cache
def _squared(function: Any) -> Polynomial:
    (angle,) = function.args
    other = sp.cos(angle) if isinstance(function, sp.sin) else sp.sin(angle)
    return Polynomial({(): 1, (other, other): -1})


@cache
def _slope(letter: Any, symbol: sp.Symbol) -> Polynomial:
    if not letter.has(symbol):
        return ZERO
    return polynomial(sp.diff(letter, symbol))
