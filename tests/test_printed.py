"""What programs print is read as it stands: arrays, rows of MATLAB, times, dust, unseen signs."""

import numpy as np
import pytest
from kinegrade.exercises.answers import Configurations, Formulas, Numbers
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import read
from kinegrade.grader.reading.typed import typed
from kinegrade.grader.reading.typed_matrix import typed_matrix
from kinegrade.grader.reading.unreadable import Unreadable
from kinegrade.solutions.expression import ExpressionError, parse

V = {"l1": 0.8, "d1": 0.5, "q": [0.4, 0.9]}
NAMES = ("l1", "d1", "q1", "q2")
RNG = np.random.default_rng(3)
WIDE = RNG.normal(size=(6, 6)) * 1e-4  # numpy breaks its rows in two


def array(shape, text):
    return read(Numbers(shape), Raw("text", text), V)


@pytest.mark.parametrize(
    "value",
    [
        np.array([[0.1, 0.2], [0.3, 0.4]]),
        np.array([[1, -2], [-3, 4]]),
        np.array([0.5, -0.25, -1.5]),
        np.array([[-1.0], [6e-17], [-0.5]]),
        RNG.normal(size=(3, 4, 4)),
        -np.abs(WIDE),
        np.array([[1e-9, 1e5], [2.0, -3.0]]),
    ],
)
@pytest.mark.parametrize(
    "printed", [str, repr, lambda value: f"J =\n{value}", lambda x: str(x.tolist())]
)
def test_a_printed_array_is_the_array(value, printed):
    np.testing.assert_allclose(array(value.shape, printed(value)), value, rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "[[0.1 -0.2] [0.3 0.4]]",
        "[0.1 -0.2; 0.3 0.4]",
        "[0.1, -0.2\n 0.3, 0.4]",
        "J =\n\n    0.1000   -0.2000\n    0.3000    0.4000\n",
        "0.1 -0.2; 0.3 sqrt(0.16)",
        "0.1, -0.2; 0.3, 0.4",
        "rrt_J = np.array([[0.1, -0.2], [0.3, 0.4]])",
        "[0.1, -0.2]\n[0.3, 0.4]",
    ],
)
def test_rows_with_blanks_are_read_where_the_shape_is_asked(text):
    np.testing.assert_allclose(array((2, 2), text), [[0.1, -0.2], [0.3, 0.4]])


def test_a_line_may_start_with_a_sign_where_the_shape_is_asked():
    np.testing.assert_array_equal(array((2, 2), "J =\n  1  2\n -3 -4"), [[1, 2], [-3, -4]])


@pytest.mark.parametrize("text", ["[0.1 - 0.2; 0.3 0.4]", "[0.1 0.2 0.3; 1 2 3]", "[1 2]\n[90° 0]"])
def test_other_rows_are_refused(text):
    with pytest.raises(Unreadable):
        array((2, 2), text)


def test_rows_of_formulas_may_have_blanks():
    answer = Formulas((2, 2), NAMES)
    found = read(answer, Raw("text", "J = [-l1*s1 -d1; l1*cos(q1) + d1 0]"), V)
    assert found.text() == [["-l1*sin(q1)", "-d1"], ["l1*cos(q1) + d1", "0"]]


def test_a_printed_list_of_configurations_is_read():
    answer = Configurations(2, units=("rad", "rad"), decimals=3, most=8)
    found = read(answer, Raw("text", "[[ 0.1 -0.2]\n [ 0.3  0.4]]"), V)
    np.testing.assert_allclose(found, [[0.1, -0.2], [0.3, 0.4]])


def test_blanks_stay_refused_where_no_shape_is_known():
    with pytest.raises(ExpressionError, match="entries take commas between them"):
        typed_matrix("[[1 2]\n [3 4]]", ())


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("l1*sin(q1(t)) + theta_2(t)", "l1*sin(q1) + q2"),
        (r"\sin(\theta_{1}) + \theta_2*\pi", "sin(q1) + q2*pi"),
        ("l1*cos(q1) + 6.123e-17*q2", "l1*cos(q1) + 0*q2"),
        ("sin(q2\u200b)\ufeff", "sin(q2)"),
        ("q\u20602 + cos\u2061(q1)\u200e", "q2 + cos(q1)"),
        ("det = -l1*s2", "-l1*sin(q2)"),
        ("rrt_det =\t-l1", "-l1"),
        ("q1 + 180°", "q1 + 3.141592653589793"),
        ("q1 + 180 deg", "q1 + 3.141592653589793"),
        ("q1 + 180º", "q1 + 3.141592653589793"),
    ],
)
def test_a_formula_is_read_as_it_is_seen(text, meant):
    assert typed(text, NAMES) == parse(meant, NAMES)


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("sinq2", 3, "sin takes its argument in brackets, as in sin(q2)"),
        ("l1*cosθ1", 6, "cos takes its argument in brackets, as in cos(θ1)"),
        ("asinq1", 4, "asin takes its argument in brackets, as in asin(q1)"),
        ("sqrt3/2", 4, "sqrt takes its argument in brackets, as in sqrt(3)"),
        ("np.sinq1q2", 6, "np.sin takes its argument in brackets, as in np.sin(q1q2)"),
        ("q1 = 0", 3, "'=' has no meaning"),
        ("l1 = d1", 3, "'=' has no meaning"),
        ("x = y = 1", 6, "'=' has no meaning"),
        ("l1(d1)", 2, "a sign such as * is missing before '('"),
        ("sin(t)", 4, "unknown name 't'"),
        ("q1°", 2, "'°' has no place here"),
    ],
)
def test_what_is_meant_otherwise_is_refused_with_what_is_missing(text, offset, message):
    with pytest.raises(ExpressionError) as caught:
        typed(text, NAMES)
    assert caught.value.message.startswith(message)
    assert caught.value.offset == offset


def test_the_caret_stands_where_the_sign_is_seen():
    with pytest.raises(ExpressionError) as caught:
        typed("\u200bl1*x", NAMES)
    assert caught.value.caret == "l1*x\n   ^"
