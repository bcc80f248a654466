"""Arrays of formulas: made from text and sympy, evaluated, printed, and compared at points."""

import numpy as np
import pytest
import sympy
from kinegrade.solutions.expression import Expression, ExpressionError
from kinegrade.solutions.expression_array import (
    ExpressionArray,
    ExpressionArrayError,
    expression_array,
    same_formulas,
    sample,
)

NAMES = ("l1", "q1", "q2")


@pytest.mark.parametrize(
    ("nested", "shape"),
    [
        ("l1*cos(q1)", ()),
        (["l1", 0, "2*q1"], (3,)),
        ([["l1", "q1"], ["0", 1.5]], (2, 2)),
        ([["q1"]], (1, 1)),
    ],
)
def test_shape_values_and_text_of_an_array(nested, shape):
    array = expression_array(nested, NAMES)
    assert array.shape == shape
    assert (
        array.at({"l1": 2, "q1": [0.1, 0.2, 0.3], "q2": 1}).shape[-len(shape) :] == shape
        or not shape
    )
    again = expression_array(array.text(), NAMES)
    assert again.entries == array.entries


def test_values_broadcast_over_a_batch():
    array = expression_array([["l1*cos(q1)", "0"]], NAMES)
    got = array.at({"l1": 2.0, "q1": np.array([0.0, np.pi / 2])})
    np.testing.assert_allclose(got, [[[2, 0]], [[0, 0]]], atol=1e-15)
    assert expression_array("7", NAMES).at({}) == 7


def test_a_sympy_matrix_becomes_an_array_and_back():
    q1, l1 = sympy.symbols("q1 l1", real=True)
    matrix = sympy.Matrix([[l1 * sympy.cos(q1) / 3, sympy.sqrt(2)], [-(q1**2), sympy.pi]])
    array = expression_array(matrix, NAMES)
    assert array.shape == (2, 2)
    difference = (array.sympy() - matrix).subs({q1: 0.3, l1: 0.7})
    assert max(abs(float(x)) for x in difference) < 1e-12


@pytest.mark.parametrize("nested", [[["l1"], ["q1", "q2"]], [], [[["l1"]]]])
def test_what_is_no_array_is_refused(nested):
    with pytest.raises(ExpressionArrayError):
        expression_array(nested, NAMES)


def test_a_name_that_is_not_allowed_is_refused():
    with pytest.raises(ExpressionError, match="l2"):
        expression_array(["l2"], NAMES)


def test_formulas_are_compared_by_value_entry_by_entry():
    a = expression_array(["sin(q1 + q2)", "cos(q1)^2", "l1/2", "1/tan(q1)", "sin(q1)"], NAMES)
    b = expression_array(
        ["sin(q1)*cos(q2) + cos(q1)*sin(q2)", "1 - sin(q1)^2", "0.5*l1", "cos(q1)/sin(q1)", "q1"],
        NAMES,
    )
    assert same_formulas(a, b, NAMES).tolist() == [True, True, True, True, False]


def test_formulas_that_have_no_value_where_the_reference_has_one_differ():
    assert not same_formulas(
        expression_array("sqrt(-l1)", NAMES), expression_array("l1", NAMES), NAMES
    )
    assert not same_formulas(
        expression_array("q1*0/0.5 + asin(2 + l1)", NAMES), expression_array("0", NAMES), NAMES
    )


def test_points_are_spread_and_the_same_everywhere():
    values = sample(("q1", "q2", "l1"), 100)
    assert list(values) == ["l1", "q1", "q2"]
    assert 0.4 < values["l1"].min() < values["l1"].max() < 1.6
    assert -2.6 < values["q1"].min() < -2 < 2 < values["q1"].max() < 2.6
    assert values["q1"][:2] == pytest.approx(
        [5.2 * (np.sqrt(3) % 1) - 2.6, 5.2 * (2 * np.sqrt(3) % 1) - 2.6]
    )
    assert abs(np.corrcoef(values["q1"], values["q2"])[0, 1]) < 0.3


def test_a_formula_made_to_agree_at_the_eight_known_points_differs():
    """A polynomial through the values at the points that everybody can know."""
    q1 = sample(NAMES, 8)["q1"]
    text, differences = "0", np.sin(q1)
    for k in range(8):  # Newton's form
        text = f"{text} + {float(differences[0])!r}*{'*'.join(['1', *(f'(q1 - {float(x)!r})' for x in q1[:k])])}"
        differences = np.diff(differences) / (q1[k + 1 :] - q1[: 7 - k]) if k < 7 else differences
    nodes = [expression_array(part, NAMES) for part in text.split(" + ")]
    total = sum(node.at({"q1": q1, "l1": 1, "q2": 1}) for node in nodes)
    np.testing.assert_allclose(total, np.sin(q1), atol=1e-9)
    interpolant = ExpressionArray((sum_of(nodes),), ())
    assert not same_formulas(interpolant, expression_array("sin(q1)", NAMES), NAMES)


def sum_of(arrays):
    """One expression, too long to be typed in one piece."""
    found = arrays[0].entries[0].nodes
    for array in arrays[1:]:
        n = len(found)
        nodes = array.entries[0].nodes
        moved = (
            node if node[0] in ("n", "s") else (node[0], *(i + n for i in node[1:]))
            for node in nodes
        )
        found = (*found, *moved, ("+", n - 1, n + len(nodes) - 1))
    return Expression(found)
