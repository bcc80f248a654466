# pyright: basic
"""Monomials: products of letters, each in the order of the sort keys, repeated for its power.

A letter is a sympy symbol, function or irrational number; a1^2 cos(q1) is (a1, a1, cos(q1)).
"""

from __future__ import annotations

from collections import Counter
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

Monomial = tuple[Any, ...]


@cache
def order(letter: Any) -> Any:
    """The key that letters are sorted by."""
    return letter.sort_key()


def monomial_of(letters: Iterable[Any]) -> Monomial:
    """The product of letters in any order."""
    return tuple(sorted(letters, key=order))


def product_of(left: Monomial, right: Monomial) -> Monomial:
    """The product of two monomials."""
    if left and right:
        return tuple(sorted(left + right, key=order))
    return left + right


def common_letters(monomials: Iterable[Monomial]) -> Monomial:
    """The greatest monomial that divides all of them, of which there is one at least."""
    first, *others = monomials
    shared = Counter(first)
    for monomial in others:
        shared &= Counter(monomial)
    return monomial_of(shared.elements())


def quotient(monomial: Monomial, letters: Monomial) -> Monomial:
    """The monomial divided by letters that it has."""
    if not letters:
        return monomial
    left = list(monomial)
    for letter in letters:
        left.remove(letter)
    return tuple(left)
