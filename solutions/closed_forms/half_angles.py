# pyright: basic
"""Trigonometric polynomials as polynomials in t = tan(q/2), where factoring is unique.

In cosines and sines it is not: sin q sin q = (1 - cos q)(1 + cos q) are two factorings. With

    cos q = (1 - t^2) / (1 + t^2)    sin q = 2 t / (1 + t^2)    tan(q/2) = t

a polynomial of degree d in cos q and sin q becomes one of degree 2 d in t, over (1 + t^2)^d. Every
angle of a turn is one value of t, with t = infinity for q = pi; 1 + t^2 has no real zero.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.polys.rings import PolyRing

from .length import TooLong
from .polynomial import Polynomial, polynomial
from .readable import shortest

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

LONGEST = 3000  # terms of a polynomial that is factored: a few seconds
LONGEST_FACTOR = 300  # terms of a factor that is brought back to cosines and sines

# How often each irreducible polynomial in t and lengths divides; an angle q stands for t = infinity
Powers = Counter[Any]


class HalfAngles:
    """Angles [rad] and the tangents of their halves."""

    def __init__(self, angles: Collection[sp.Symbol]) -> None:
        self.angles = tuple(angles)
        self.tangents = tuple(sp.Symbol(f"t_{angle.name}", real=True) for angle in angles)
        self._degrees_of: dict[Any, tuple[int, ...]] = {}  # of factors found, in each tangent
        self._angle_of: dict[Any, sp.Symbol] = {}
        for angle in self.angles:
            self._angle_of[sp.cos(angle)] = angle
            self._angle_of[sp.sin(angle)] = angle

    def polynomial(self, expression: sp.Expr) -> Polynomial:
        """Polynomial in the cosines and sines of single angles."""
        return polynomial(sp.expand_trig(expression))

    def factored(self, of: Polynomial) -> tuple[sp.Expr, Powers]:
        """Rational number and irreducible factors of a polynomial in cosines and sines of angles.

        With degree d in cosine and sine of an angle, the polynomial times (1 + t^2)^d is a form of
        degree 2 d; what t misses of that degree are zeros at infinity, q = pi, and counted under
        the angle. Factors 1 + t^2 have no zeros and are left out on both sides.

        Raises:
            TooLong: The polynomial in t has more than `LONGEST` terms, or one of its factors has
                more than `LONGEST_FACTOR`.
        """
        of = of.gathered()
        if of.terms.keys() <= {()}:  # rings and their factors take one letter at least
            return sp.sympify(of.terms.get((), 0)), Counter()

        degrees = self._degrees(of)
        form = self._form(of, degrees)
        if len(form) > LONGEST:
            raise TooLong
        number, parts = form.factor_list()
        if max((len(part) for part, _ in parts), default=0) > LONGEST_FACTOR:
            raise TooLong

        tangents = form.ring.gens[: len(self.angles)]
        without_zeros = [1 + t**2 for t in tangents]
        powers: Powers = Counter()
        for part, count in parts:
            if part in without_zeros:
                continue
            expression = part.as_expr()
            powers[expression] += count
            self._degrees_of[expression] = tuple(max(part.degree(t), 0) for t in tangents)
        for q, t in zip(self.angles, tangents, strict=True):
            found = sum(part.degree(t) * count for part, count in parts)
            at_infinity = 2 * degrees[q] - found
            if at_infinity:
                powers[q] = at_infinity
        return sp.QQ.to_sympy(number), powers

    def trigonometric(self, powers: Powers) -> Iterator[tuple[sp.Expr, sp.Expr, int]]:
        """Numbers, primitive factors in cosines and sines of angle sums, and powers.

        They multiply to what `factored` returned as `powers`. A factor of odd degree in t leaves a
        cos(q/2) over, as sin q has 2 t at zero and t = infinity, and cos q has 1 + t and 1 - t. So
        they are multiplied until they are even: all that share such a tangent, or one of them
        squared.
        """
        left = {part: count for part, count in powers.items() if count}
        while left:
            group = self._linked(left)
            repeated = 1
            if self._odd_together(group):
                # All that is left is even, so one of the group is left twice.
                group = [_first_repeated(group, left)]
                repeated = 2
            count = min(left[part] for part in group) // repeated
            number, factor = self._in_angles(group, repeated)
            yield number, factor, count

            for part in group:
                left[part] -= repeated * count
                if not left[part]:
                    del left[part]

    def _degrees(self, of: Polynomial) -> dict[sp.Symbol, int]:
        """The degree in cosine and sine together of each angle."""
        degrees = dict.fromkeys(self.angles, 0)
        for monomial in of.terms:
            for q, degree in self._powers_of_angles(monomial).items():
                degrees[q] = max(degrees[q], degree)
        return degrees

    def _powers_of_angles(self, monomial: tuple[Any, ...]) -> Counter[sp.Symbol]:
        powers: Counter[sp.Symbol] = Counter()
        for letter in monomial:
            if letter in self._angle_of:
                powers[self._angle_of[letter]] += 1
        return powers

    def _form(self, of: Polynomial, degrees: dict[sp.Symbol, int]) -> Any:
        """The polynomial times all (1 + t^2)^d, in the ring of the tangents and all other letters.

        The ring's first generators are the tangents, in the order of the angles.
        """
        # In the same order at every call, so that a factor comes out with the same sign.
        others = sorted(of.letters() - self._angle_of.keys(), key=sp.default_sort_key)
        ring = PolyRing((*self.tangents, *others), sp.QQ, sp.lex)
        values = dict(zip(ring.symbols, ring.gens, strict=True))
        denominators: dict[sp.Symbol, Any] = {}
        for q, t in zip(self.angles, ring.gens, strict=False):
            values[sp.cos(q)] = 1 - t**2
            values[sp.sin(q)] = 2 * t
            denominators[q] = 1 + t**2

        form = ring.zero
        for monomial, number in of.terms.items():
            term = ring(sp.Rational(number))
            for letter in monomial:
                term *= values[letter]
            # Each cosine and sine has used up one of the d denominators.
            used = self._powers_of_angles(monomial)
            for q, degree in degrees.items():
                term *= denominators[q] ** (degree - used[q])
            form += term
        return form

    def _degree(self, part: Any, i: int) -> int:
        """The degree of a factor in tangent i; infinity is a simple zero of its own angle."""
        if part in self.angles:
            return int(part == self.angles[i])
        return self._degrees_of[part][i]

    def _odd(self, part: Any) -> set[int]:
        """The tangents in which the degree of a factor is odd."""
        odd: set[int] = set()
        for i in range(len(self.angles)):
            if self._degree(part, i) % 2:
                odd.add(i)
        return odd

    def _odd_together(self, group: Collection[Any]) -> set[int]:
        """The tangents in which the degree of a product of factors is odd."""
        odd: set[int] = set()
        for part in group:
            odd ^= self._odd(part)
        return odd

    def _linked(self, left: Collection[Any]) -> list[Any]:
        """The simplest factor, those of odd degree in a tangent where it is odd, and so on."""
        group: list[Any] = []
        shared: set[int] = set()
        more = [min(left, key=self._complexity)]
        while more:
            group += more
            for part in more:
                shared |= self._odd(part)
            more = [part for part in left if part not in group and self._odd(part) & shared]
        return group

    def _complexity(self, part: Any) -> tuple[int, Any]:
        return len(self._odd(part)), sp.default_sort_key(part)

    def _in_angles(self, group: Collection[Any], repeated: int) -> tuple[sp.Expr, sp.Expr]:
        """A product of factors as a number times a sum of cosines and sines of angle sums.

        Its degree is even in every tangent: with half of it as d, t^k / (1 + t^2)^d is
        sin(q/2)^k cos(q/2)^(2 d - k).
        """
        finite = [part**repeated for part in group if part not in self.angles]
        expression = sp.expand(sp.Mul(*finite))
        for i, (q, t) in enumerate(zip(self.angles, self.tangents, strict=True)):
            half = repeated * sum(self._degree(part, i) for part in group) // 2
            if half:
                expression = _by_angle(expression, q, t, half)

        number, primitive = shortest(polynomial(expression), self.angles).as_content_primitive()
        if primitive.could_extract_minus_sign():
            return -number, -primitive
        return number, primitive


def _first_repeated(group: Collection[Any], left: dict[Any, int]) -> Any:
    """The first factor that can be squared."""
    return next(part for part in group if left[part] > 1)


def _by_angle(expression: sp.Expr, q: sp.Symbol, t: sp.Symbol, half: int) -> sp.Expr:
    """A polynomial in t = tan(q/2), over (1 + t^2)^half, in the cosine and sine of q."""
    terms = sp.Poly(expression, t).terms()
    summed = [number * _power(q, k, half) for (k,), number in terms]
    return sp.Add(*summed) / 2**half


def _power(q: sp.Symbol, k: int, half: int) -> sp.Expr:
    """sin(q/2)^k cos(q/2)^(2 half - k), times 2^half.

    In pairs, 2 sin(q/2) cos(q/2) = sin q, 2 cos(q/2)^2 = 1 + cos q and 2 sin(q/2)^2 = 1 - cos q.
    """
    mixed = min(k, 2 * half - k)
    square = 1 + sp.cos(q) if k < half else 1 - sp.cos(q)
    return sp.sin(q) ** mixed * square ** (half - mixed)
