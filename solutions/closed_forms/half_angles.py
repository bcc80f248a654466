# pyright: basic
"""Trigonometric polynomials as polynomials in t = tan(q/2), where factoring is unique."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.polys.rings import PolyRing
from sympy.simplify.fu import TR8

from .polynomial import Polynomial, polynomial, reduced

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

MANY = 8  # terms above which products of single angles are left nested
Powers = Counter[
    Any
]  # irreducible polynomials in t and lengths, and the angles that count for t = infinity


class HalfAngles:
    """Angles [rad] and the tangents of their halves."""

    def __init__(self, angles: Sequence[sp.Symbol]) -> None:
        self.angles = tuple(angles)
        self.tangents = tuple(sp.Symbol(f"t_{angle.name}", real=True) for angle in angles)

    def polynomial(self, expression: sp.Expr) -> Polynomial:
        """Polynomial in the cosines and sines of single angles."""
        return polynomial(sp.expand_trig(expression))

    def factored(self, of: Polynomial) -> tuple[sp.Expr, Powers]:
        """Rational number and irreducible factors of a polynomial in cosines and sines of single angles.

        With degree d in cosine and sine of an angle, the polynomial times (1 + t^2)^d is a form of degree 2d;
        what t misses of that degree are zeros at infinity, q = pi, and counted under the angle. Factors 1 + t^2 have
        no zeros and are left out on both sides.
        """
        of = of.gathered()
        if of.terms.keys() <= {()}:  # rings and their factors take one letter at least
            return sp.sympify(of.terms.get((), 0)), Counter()
        degrees = {
            q: max(
                (sum(x in (sp.cos(q), sp.sin(q)) for x in monomial) for monomial in of.terms),
                default=0,
            )
            for q in self.angles
        }
        form = self._form(of, degrees)
        number, parts = form.factor_list()
        powers: Powers = Counter()
        missing = {q: 2 * degree for q, degree in degrees.items()}
        tangents = dict(zip(self.angles, form.ring.gens, strict=False))
        units = {1 + t**2: q for q, t in tangents.items()}
        for part, count in parts:
            if part in units:
                missing[units[part]] -= 2 * count
                continue
            powers[part.as_expr()] += count
            for q, t in tangents.items():
                missing[q] -= part.degree(t) * count
        powers.update({q: count for q, count in missing.items() if count})
        return sp.QQ.to_sympy(number), powers

    def trigonometric(self, powers: Powers) -> Iterator[tuple[sp.Expr, sp.Expr, int]]:
        """Numbers, primitive factors in cosines and sines of angle sums, and powers, of what `factored` returned.

        Those of odd degree in a tangent, as the t + 1 and t - 1 of cos q, are multiplied until they are even: all that
        share such a tangent, or one of them squared.
        """
        left = {part: count for part, count in powers.items() if count}
        while left:
            group, repeated = self._linked(left), 1
            if not self._is_even(group):
                group, repeated = [next(part for part in group if left[part] > 1)], 2
            count = min(left[part] for part in group) // repeated
            yield *self._angles_of(group, repeated), count
            for part in group:
                left[part] -= repeated * count
            left = {part: count for part, count in left.items() if count}

    def _form(self, of: Polynomial, degrees: dict[sp.Symbol, int]) -> Any:
        """Element, of the ring of the tangents and all letters of no angle, times all (1 + t^2)^d."""
        letters = {letter for monomial in of.terms for letter in monomial}
        single = {f(q): q for q in self.angles for f in (sp.cos, sp.sin)}
        # In the same order at every call, so that a factor comes out with the same sign.
        others = sorted(letters - single.keys(), key=sp.default_sort_key)
        ring = PolyRing((*self.tangents, *others), sp.QQ, sp.lex)
        tangents = dict(zip(self.angles, ring.gens, strict=False))
        values = dict(zip(ring.symbols, ring.gens, strict=True))
        values |= {sp.cos(q): 1 - t**2 for q, t in tangents.items()}
        values |= {sp.sin(q): 2 * t for q, t in tangents.items()}
        form = ring.zero
        for monomial, number in of.terms.items():
            lacking = Counter(degrees)
            lacking.subtract(single[letter] for letter in monomial if letter in single)
            term = ring(sp.Rational(number))
            for letter in monomial:
                term *= values[letter]
            for q, count in lacking.items():
                term *= (1 + tangents[q] ** 2) ** count
            form += term
        return form

    def _degree(self, part: Any, i: int) -> int:
        return (
            int(part == self.angles[i]) if part in self.angles else _degree(part, self.tangents[i])
        )

    def _odd(self, part: Any) -> set[int]:
        return {i for i in range(len(self.angles)) if self._degree(part, i) % 2}

    def _is_even(self, group: Sequence[Any]) -> bool:
        return not any(
            sum(self._degree(part, i) for part in group) % 2 for i in range(len(self.angles))
        )

    def _linked(self, left: dict[Any, int]) -> list[Any]:
        first = min(left, key=lambda part: (len(self._odd(part)), sp.default_sort_key(part)))
        group, shared = [first], self._odd(first)
        while shared and (
            more := [part for part in left if part not in group and self._odd(part) & shared]
        ):
            group += more
            shared = shared.union(*(self._odd(part) for part in more))
        return group

    def _angles_of(self, group: Sequence[Any], repeated: int) -> tuple[sp.Expr, sp.Expr]:
        """A product of factors, even in every tangent, as a number times a sum of cosines and sines of angle sums."""
        expression = sp.expand(
            sp.Mul(*(part**repeated for part in group if part not in self.angles))
        )
        for i, (q, t) in enumerate(zip(self.angles, self.tangents, strict=True)):
            half = repeated * sum(self._degree(part, i) for part in group) // 2
            if half:
                terms = sp.Poly(expression, t).terms()
                expression = (
                    sp.Add(*(number * _power(q, k, half) for (k,), number in terms)) / 2**half
                )
        number, primitive = sp.expand(TR8(sp.expand(expression))).as_content_primitive()
        if len(sp.Add.make_args(primitive)) > MANY:
            number, primitive = reduced(polynomial(expression)).expression().as_content_primitive()
        return (
            (-number, -primitive) if primitive.could_extract_minus_sign() else (number, primitive)
        )


def _degree(part: Any, t: Any) -> int:
    return int(sp.degree(part, t))


def _power(q: sp.Symbol, k: int, half: int) -> sp.Expr:
    """sin(q/2)^k cos(q/2)^(2 half - k), times 2^half."""
    both = min(k, 2 * half - k)
    return sp.sin(q) ** both * (1 + (sp.cos(q) if k < half else -sp.cos(q))) ** (half - both)
