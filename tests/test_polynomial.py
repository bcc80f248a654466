# pyright: basic
"""Polynomials of letters do what sympy does, in less time; half angles lose no zero."""

import pytest
import sympy as sp
from kinegrade.solutions.closed_forms.half_angles import HalfAngles
from kinegrade.solutions.closed_forms.polynomial import ONE, ZERO, polynomial, reduced, total
from sympy.parsing.sympy_parser import parse_expr

a, b, q1, q2 = sp.symbols("a b q1 q2", real=True)
TEXTS = (
    "0",
    "-3/4",
    "a - a",
    "(a + b)**3 - a**3",
    "sqrt(2)*a*cos(q1) + sin(q1)**2",
    "a*cos(q1 + q2)*sin(q1) - b/7",
    "(a*cos(q1) - sin(q2))*(b + cos(q1))**2",
    "1/(a + b)",
)
EXPRESSIONS = [parse_expr(text, local_dict={"a": a, "b": b, "q1": q1, "q2": q2}) for text in TEXTS]
expressions = pytest.mark.parametrize("x", EXPRESSIONS, ids=str)


@expressions
def test_a_polynomial_prints_what_it_was_read_from(x):
    assert sp.expand(polynomial(x).expression() - x) == 0


@expressions
@pytest.mark.parametrize("y", EXPRESSIONS[3:6], ids=str)
def test_sums_differences_and_products_are_sympys(x, y):
    for found, expected in (
        (polynomial(x) + polynomial(y), x + y),
        (polynomial(x) - polynomial(y), x - y),
        (polynomial(x) * polynomial(y), x * y),
        (-polynomial(x), -x),
        (total([polynomial(x), polynomial(y), ONE]), x + y + 1),
    ):
        assert sp.expand(found.expression() - expected) == 0


@expressions
def test_nothing_is_kept_of_what_cancels(x):
    assert not (polynomial(x) - polynomial(x)).terms
    assert not (polynomial(x) * ZERO).terms


@expressions
@pytest.mark.parametrize("by", [a, q1], ids=str)
def test_derivatives_are_sympys(x, by):
    assert sp.simplify(polynomial(x).diff(by).expression() - sp.diff(x, by)) == 0


@pytest.mark.parametrize("power", range(6))
def test_powers_of_a_sine_are_reduced_to_the_first(power):
    found = reduced(polynomial(a * sp.sin(q1) ** power * sp.cos(q1)))
    assert all(monomial.count(sp.sin(q1)) == power % 2 for monomial in found.terms)
    assert sp.simplify(found.expression() - a * sp.sin(q1) ** power * sp.cos(q1)) == 0


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("1 + cos(q1)", 2),
        ("1 - cos(q1)", 2),
        ("sin(q1)", 2),
        ("cos(q1)", 2),
        ("sin(q1)**2 + cos(q1)**2", 0),
        ("a", 0),
    ],
)
def test_half_angles_count_the_zeros_of_a_turn_those_at_half_a_turn_too(text, count):
    half = HalfAngles([q1])
    _, powers = half.factored(polynomial(parse_expr(text, local_dict={"a": a, "q1": q1})))
    t = half.tangents[0]
    zeros = [
        n * (1 if part == q1 else int(sp.Poly(part, t).degree()))
        for part, n in powers.items()
        if part != a
    ]
    assert sum(zeros) == count


@pytest.mark.parametrize(
    ("x", "number", "factors"),
    [
        (sp.S.Zero, 0, {}),
        (sp.Rational(-3, 4), sp.Rational(-3, 4), {}),
        (a / 2, sp.Rational(1, 2), {a: 1}),
    ],
    ids=str,
)
@pytest.mark.parametrize("angles", [[], [q1]], ids=str)
def test_what_turns_with_no_angle_is_factored_too(x, number, factors, angles):
    assert HalfAngles(angles).factored(polynomial(x)) == (number, factors)


def test_a_product_of_square_roots_is_a_number():
    root = polynomial(sp.sqrt(2))
    assert HalfAngles([q1]).factored(root * root * polynomial(a)) == (2, {a: 1})
    assert HalfAngles([q1]).factored(root * root - polynomial(sp.S(2))) == (0, {})


def test_equal_factors_have_the_same_sign_whatever_stands_beside_them():
    half = HalfAngles([q1, q2])
    factor = polynomial(a - b)
    _, alone = half.factored(factor)
    for other in (sp.cos(q2), a, -sp.Symbol("A", real=True), sp.sin(q1)):
        _, found = half.factored(factor * polynomial(other))
        assert alone.keys() <= found.keys()
