"""Numbers, matrices and formulas are printed as a textbook would."""

import numpy as np
import pytest
import sympy
from kinegrade.course.text.formulas import closed_form, given_number, matrix, number, page_text
from kinegrade.solutions.condition import AllOf, condition_sympy
from kinegrade.solutions.expression import parse


@pytest.mark.parametrize(
    ("value", "text"), [(1.23456, "1.235"), (-0.0001, "0.000"), (-0.0, "0.000"), (-2, "-2.000")]
)
def test_a_number_has_the_asked_decimals_and_no_minus_before_zero(value, text):
    assert number(value, 3) == text


def test_vectors_are_columns_and_stacks_stand_side_by_side():
    assert matrix([1, 2], 0) == r"\begin{bmatrix} 1 \\ 2 \end{bmatrix}"
    assert matrix(np.eye(2), 0) == r"\begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}"
    assert matrix(np.zeros((2, 1, 1)), 0).count("bmatrix") == 4
    assert matrix(0.5, 1) == "0.5"


def test_closed_forms_use_the_shorthand_of_the_course():
    q1, q2, q3, a2 = sympy.symbols("q1 q2 q3 a2", real=True)
    assert closed_form(a2 * sympy.cos(q1) * sympy.sin(q2 + q3)) == r"a_{2} c_{1} s_{23}"


@pytest.mark.parametrize(
    ("value", "units", "text"),
    [
        (0.5, "m", r"x = 0.5\,\mathrm{m}"),
        (3, "1", "x = 3"),
        (3, "N m", r"x = 3\,\mathrm{N\,m}"),
        ([1, 2], ["N", "N m/rad"], r"x = (1\,\mathrm{N},\; 2\,\mathrm{N\,m/rad})"),
        ([0.1, 0.2], ["rad", "rad"], r"x = (0.1,\; 0.2)\,\mathrm{rad}"),
        ([0.1, 0.2], ["rad", "m"], r"x = (0.1\,\mathrm{rad},\; 0.2\,\mathrm{m})"),
        (
            [[1, 2], [3, 4]],
            [["m", "m"]] * 2,
            r"x = \begin{bmatrix} 1 & 2 \\ 3 & 4 \end{bmatrix}\,\mathrm{m}",
        ),
        ([[1, 2]], [["m", "rad"]], r"x = \begin{bmatrix} 1 & 2 \end{bmatrix}"),
        ([[1.25, 2.0]], [["m", "rad"]], r"x = \begin{bmatrix} 1.25 & 2.00 \end{bmatrix}"),
    ],
)
def test_given_numbers_carry_their_units(value, units, text):
    assert given_number("x", value, units) == text


def test_bold_letters_are_bold_in_every_browser():
    assert "<mi>\N{MATHEMATICAL BOLD SMALL P}</mi>" in page_text(r"$\mathbf p$")
    assert "<mi>\N{MATHEMATICAL BOLD ITALIC SMALL OMEGA}</mi>" in page_text(r"$\boldsymbol\omega$")
    for formula in (
        r"\mathbf{J}",
        r"\dot{\mathbf q}_b",
        r"\boldsymbol{\xi}_b",
        r"\boldsymbol\Lambda",
    ):
        assert "mathvariant" not in page_text(f"${formula}$")


def test_page_text_is_mathml_and_code_and_everything_else_is_escaped():
    html = page_text(r"<b>x</b> & $\mathbf{J}$ and `<i>`")
    assert html.startswith("&lt;b&gt;x&lt;/b&gt; &amp; <math")
    assert html.endswith("<code>&lt;i&gt;</code>")


def test_an_absolute_value_has_its_bars():
    formula = parse("abs(l1*l2*sin(q2))", ("l1", "l2", "q2"))
    assert closed_form(formula.sympy()) == r"\left|{l_{1} l_{2} s_{2}}\right|"
    assert "<mo" in page_text(f"${closed_form(formula.sympy())}$")


def test_a_joint_condition_is_printed_with_its_equations():
    condition = AllOf((parse("sin(q2)", ("q2",)), parse("sin(q2 + q3)", ("q2", "q3"))))
    assert closed_form(condition_sympy(condition)) == r"s_{2} = 0 \wedge s_{23} = 0"
