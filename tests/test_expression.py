"""Formulas: what is read, what is refused and where, and what comes out again."""

import json
import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kinegrade.solutions.errors import KinegradeError
from kinegrade.solutions.expression import Expression, ExpressionError, latex_name, parse

NAMES = ("q1", "q2", "a1", "l2", "theta1", "alpha1")
VALUES: dict[str, float] = {
    "q1": 1.3,
    "q2": -0.4,
    "a1": 0.7,
    "l2": 0.9,
    "theta1": 0.2,
    "alpha1": 0.5,
}
BAD: list[dict[str, str]] = json.loads(
    (Path(__file__).parent / "data" / "bad_inputs.json").read_text(encoding="utf-8")
)
READABLE = {"1e-3": 0.001}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^3^2", 512.0),
        ("2**-1", 0.5),
        ("8 - 4 - 2", 2.0),
        ("8/4/2", 1.0),
        ("8/4*2", 4.0),
        ("1 + 2*3", 7.0),
        ("2*-3", -6.0),
        ("2--3", 5.0),
        ("+.5", 0.5),
        ("1e-3", 0.001),
        ("2.5E2", 250.0),
        ("sqrt(16)/4", 1.0),
        ("asin(1)", math.pi / 2),
        ("acos(0) + atan(1)*2 - pi", 0.0),
        ("tan(pi/4)", 1.0),
        ("atan2(-1, -1)", -3 * math.pi / 4),
        ("2*atan2(q1 + q2, a1)^2", 2 * math.atan2(0.9, 0.7) ** 2),
        ("-a1*sin(q1) - l2*sin(q1+q2)", -0.7 * math.sin(1.3) - 0.9 * math.sin(0.9)),
        ("cos(q1)^2 + sin(q1)**2", 1.0),
        ("abs(q2)*a1", 0.4 * 0.7),
        ("Abs(q2 - q1)^2", 1.7**2),
        ("  q1\t", 1.3),
    ],
)
def test_formulas_are_read_as_mathematics_has_them(text: str, value: float):
    assert parse(text, NAMES).at(VALUES) == pytest.approx(value, abs=1e-15)


@pytest.mark.parametrize(
    ("typed", "plain"),
    [
        ("q1 − q2", "q1 - q2"),
        ("q1 – q2", "q1 - q2"),
        ("2×q1·q2⋅a1", "2*q1*q2*a1"),
        ("a1÷l2", "a1/l2"),
        ("π/2", "pi/2"),
        ("θ1 + α1", "theta1 + alpha1"),
        ("θ₁ + q₂", "theta1 + q2"),
        ("q1² + q2³", "q1^2 + q2^3"),
        ("q1⁻¹·2¹⁰", "q1^-1*2^10"),
        ("q1\u00a0+\u2009q2", "q1 + q2"),
    ],
)
def test_mathematical_signs_are_read_as_their_plain_twins(typed: str, plain: str):
    assert parse(typed, NAMES) == parse(plain, NAMES)


@pytest.mark.parametrize("entry", BAD, ids=[ascii(entry["input"])[:30] for entry in BAD])
def test_every_bad_input_is_refused_at_a_place_or_read_as_a_person_would(entry: dict[str, str]):
    text = entry["input"]
    if text in READABLE:
        assert parse(text, ("q1", "n")).at({}) == READABLE[text]
        return
    with pytest.raises(ExpressionError) as caught:
        parse(text, ("q1", "n"))
    error = caught.value
    assert error.message
    assert 0 <= error.offset <= len(text)
    shown, arrow = error.caret.split("\n")
    assert arrow.strip() == "^"
    assert len(arrow) <= len(shown) + 1


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("2q1", 1, "a sign such as * is missing before 'q1'"),
        ("2(q1)", 1, "a sign such as * is missing before '('"),
        ("q1 q2", 3, "a sign such as * is missing before 'q2'"),
        ("(q1)(q2)", 4, "a sign such as * is missing before '('"),
        ("q1(2)", 2, "a sign such as * is missing before '('"),
        ("1.5.2", 3, "a sign such as * is missing before '.2'"),
        ("x2", 0, "unknown name 'x2'"),
        ("a1 + alpha2", 5, "unknown name 'alpha2'; did you mean alpha1?"),
        ("sinn(q1)", 0, "unknown function 'sinn'; did you mean sin?"),
        ("sin q1", 4, "sin takes its argument in brackets"),
        ("sin²(q1)", 3, "sin takes its argument in brackets"),
        ("3,14", 1, "a decimal number takes a point, as in 3.14, got a comma"),
        ("sin(0,5)", 5, "a decimal number takes a point, as in 3.14, got a comma"),
        ("π + 2q1", 5, "a sign such as * is missing before 'q1'"),
        ("(q1, q2)", 3, "a comma has no place here"),
        ("q1²^3", 2, "two powers in a row take brackets"),
        ("abs q1", 4, "abs takes its argument in brackets, as in abs(x)"),
        ("|q1|", 0, "'|' has no meaning in a formula"),
        ("atan2(q1)", 8, "atan2 takes 2 arguments, got 1"),
        ("atan2(q1, q2, a1)", 12, "a comma has no place here"),
        ("atan2(q1", 8, "a comma and another argument are missing"),
        ("atan2 q1", 6, "atan2 takes two arguments in brackets, as in atan2(y, x)"),
        ("q1 atan2 q2", 3, "a sign such as * is missing before 'atan2'"),
        ("(q1", 3, "a closing bracket is missing"),
        ("q1)", 2, "this bracket was never opened"),
        ("", 0, "the formula stops"),
        ("q1 +", 4, "the formula stops"),
        ("q1 * / q2", 5, "a number, a name or a bracket is expected, got '/'"),
        ("q1; q2", 2, "';' has no meaning in a formula"),
        ("q1[0]", 2, "'[' has no meaning in a formula"),
        ("1/0", 1, "division by zero"),
        ("q1/(1 - 1)", 2, "division by zero"),
        ("q1/sin(pi)", 2, "division by zero"),
        ("0^-1", 1, "this is not a finite number"),
        ("sqrt(-1)", 0, "this has no real value"),
        ("1 + acos(2)", 4, "this has no real value"),
        ("tan(pi/2)", 0, "this number is too large"),
        ("1e999", 0, "a number takes a size between"),
        ("1e-400", 0, "a number takes a size between"),
        ("9" * 41, 0, "a number takes a size between"),
        ("q1^21", 2, "an exponent takes a number between -20 and 20"),
        ("((q1^5)^5)^5", 7, "an exponent takes a number between -20 and 20"),
        ("2^q1", 1, "an exponent takes a number, got a formula with names"),
        ("q1+" * 7000 + "q1", 20_000, "a formula takes up to 20000 characters, got 21002"),
        ("q1+" * 2000 + "q1", 6002, "a formula takes up to 4000 numbers, names and signs"),
        ("q" * 401, 0, "a name takes up to 400 characters"),
        ("(" * 60 + "1" + ")" * 60, 41, "the formula is nested too deeply"),
        ("-" * 200 + "1", 41, "the formula is nested too deeply"),
        ("2^" * 100 + "1", 82, "the formula is nested too deeply"),
    ],
)
def test_what_is_ambiguous_or_hostile_is_refused_at_its_place(text: str, offset: int, message: str):
    with pytest.raises(ExpressionError) as caught:
        parse(text, NAMES)
    assert caught.value.message.startswith(message)
    assert caught.value.offset == offset


def test_the_caret_stands_under_the_place_even_in_long_or_strange_text():
    with pytest.raises(ExpressionError) as caught:
        parse("q1+\tq1+" * 20 + "!" + "+q1" * 30, NAMES)
    shown, arrow = caught.value.caret.split("\n")
    assert shown[len(arrow) - 1] == "!"
    assert shown.isprintable()


@pytest.mark.parametrize("value", [None, 3.5, b"q1", ["q1"]])
def test_what_is_no_text_is_refused(value: Any):
    with pytest.raises(ExpressionError, match="a formula takes text, got"):
        parse(value, NAMES)


def test_refusals_are_the_projects_errors_and_travel_between_processes():
    with pytest.raises(KinegradeError) as caught:
        parse("2q1", NAMES)
    twin = pickle.loads(pickle.dumps(caught.value))  # noqa: S301  our own bytes
    assert isinstance(twin, ExpressionError)
    assert (twin.message, twin.offset, twin.caret) == (
        "a sign such as * is missing before 'q1'",
        1,
        "2q1\n ^",
    )


def test_names_are_those_that_occur():
    assert parse("a1*sin(q1) + pi", NAMES).names == {"a1", "q1"}


def test_arrays_broadcast_and_scalars_stay_floats():
    formula = parse("a1*sin(q1)", NAMES)
    assert isinstance(formula.at(VALUES), float)
    value = formula.at({"a1": np.ones((2, 1), dtype=int), "q1": np.zeros(3)})
    assert isinstance(value, np.ndarray)
    assert value.shape == (2, 3)
    assert parse("q1^-1", NAMES).at({"q1": np.array([2, 4])}) == pytest.approx([0.5, 0.25])


def test_outside_a_domain_the_value_is_not_finite_and_nothing_warns():
    assert math.isnan(parse("sqrt(q1)", NAMES).at({"q1": -1.0}))
    assert parse("1/q1", NAMES).at({"q1": 0.0}) == math.inf


def test_a_missing_value_is_named():
    with pytest.raises(ExpressionError, match="values takes a1, q2, got only q1"):
        parse("q1 + q2*a1", NAMES).at({"q1": 1.0})


def formulas() -> st.SearchStrategy[str]:
    numbers = st.sampled_from(["0.1", "2", "3.75", "1e-3", "pi"])
    leaves = numbers | st.sampled_from(["q1", "q2", "a1"])

    def grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
        return (
            st.tuples(inner, st.sampled_from("+-*/"), inner).map(
                lambda x: f"({x[0]}) {x[1]} ({x[2]})"
            )
            | st.tuples(inner, st.sampled_from("+-*/"), leaves).map(" ".join)
            | st.tuples(st.sampled_from(["-", "sin", "cos", "abs"]), inner).map(
                lambda x: f"{x[0]}({x[1]})"
            )
            | st.tuples(inner, leaves).map(lambda x: f"atan2({x[0]}, {x[1]})")
            | st.tuples(inner, st.sampled_from(["2", "-1", "-(1/2)"])).map(
                lambda x: f"({x[0]})^{x[1]}"
            )
        )

    return st.recursive(leaves, grown, max_leaves=8)


def read(text: str) -> Expression | None:
    try:
        return parse(text, NAMES)
    except ExpressionError:
        return None  # a constant part may divide by zero or have no real value


@given(formulas())
@settings(max_examples=200, deadline=None)
def test_a_printed_formula_reads_back_to_the_same_value(text: str):
    formula = read(text)
    if formula is not None:
        np.testing.assert_equal(parse(str(formula), NAMES).at(VALUES), formula.at(VALUES))


@given(
    st.text(alphabet="q12a+-*/^().,eE sincopt²πθ₁[]'\"\\\n!", max_size=60) | st.text(max_size=40)
)
@settings(max_examples=300, deadline=None)
def test_any_text_is_read_or_refused_at_a_place_within_it(text: str):
    place, caret = 0, "^"
    try:
        parse(text, NAMES)
    except ExpressionError as error:
        place, caret = error.offset, error.caret
    assert 0 <= place <= len(text)
    assert caret.endswith("^")


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("a1-(q1-q2)", "a1 - (q1 - q2)"),
        ("a1/(q1*q2)", "a1/(q1*q2)"),
        ("(a1*q1)*q2", "a1*q1*q2"),
        ("(q1^2)^3", "(q1^2)^3"),
        ("(-q1)^2", "(-q1)^2"),
        ("q1 + -2", "q1 + (-2)"),
        ("2.0*pi", "2*pi"),
        ("-Abs(q1 - 2)^2", "-abs(q1 - 2)^2"),
    ],
)
def test_formulas_are_printed_with_the_brackets_they_need(text: str, printed: str):
    assert str(parse(text, NAMES)) == printed


def test_a_number_below_zero_may_stand_in_the_nodes():
    formula = Expression((("n", -2.0), ("s", "q1"), ("^", 0, 1)))
    assert str(formula) == "(-2)^q1"
    assert formula.at({"q1": 2}) == 4


@pytest.mark.parametrize(
    "nodes",
    [
        (),
        (("n", math.inf),),
        (("n", "2"),),
        (("s", "a b"),),
        (("s", 3),),
        (("n", 1.0), ("n", 2.0)),
        (("sin", 0),),
        (("s", "q1"), ("sin", 0), ("*", 0, 1)),
        (("s", "q1"), ("*", 0, 0)),
        (("s", "q1"), ("s", "q2"), ("-", 1, 0)),
        (("s", "q1"), ("__import__", 0)),
        (("s", "q1"), ("sin", 0, 0)),
        (("s", "q1"), ("atan2", 0)),
        ((),),
    ],
)
def test_nodes_that_are_no_tree_in_post_order_are_refused(nodes: Any):
    with pytest.raises(ExpressionError, match="nodes takes"):
        Expression(nodes)


def test_other_formulas_stand_in_place_of_names():
    values = {"q1": parse("a1 + q2", NAMES), "l2": parse("2*q1", NAMES)}
    whole = parse("l2*sin(q1 - l2) + a1", NAMES).put(values)
    assert whole == parse("2*q1*sin((a1 + q2) - 2*q1) + a1", NAMES)
    assert whole.names == {"q1", "a1", "q2"}


@given(formulas(), formulas())
@settings(max_examples=100, deadline=None)
def test_a_formula_in_place_of_a_name_has_the_value_of_its_own_value_there(outer: str, inner: str):
    whole, inside = read(outer), read(inner)
    if whole is not None and inside is not None:
        put = whole.put({"q1": inside})
        np.testing.assert_equal(put.at(VALUES), whole.at({**VALUES, "q1": inside.at(VALUES)}))


def test_sympy_gets_exact_numbers_and_real_symbols():
    import sympy as sp

    q1, a1 = sp.Symbol("q1", real=True), sp.Symbol("a1", real=True)
    expected = (
        sp.Rational(1, 10) * a1 * sp.sin(q1 + sp.pi / 2) - sp.sqrt(2) / sp.Rational(1, 1000) ** 2
    )
    assert (
        sp.simplify(parse("0.1*a1*sin(q1 + pi/2) - sqrt(2)/1e-3^2", NAMES).sympy() - expected) == 0
    )
    assert parse("atan2(q1, a1)", NAMES).sympy() == sp.atan2(q1, a1)
    assert parse("abs(a1*sin(q1))", NAMES).sympy() == sp.Abs(a1 * sp.sin(q1))
    assert parse("-q1 + asin(a1)*acos(a1)", NAMES).sympy() == -q1 + sp.asin(a1) * sp.acos(a1)


@given(formulas())
@settings(max_examples=60, deadline=None)
def test_sympy_has_the_same_value(text: str):
    formula = read(text)
    value = float("nan") if formula is None else float(formula.at(VALUES))
    if formula is not None and math.isfinite(value):
        exact = formula.sympy()
        number = complex(exact.subs({s: VALUES[s.name] for s in exact.free_symbols}).evalf())
        if math.isfinite(number.real) and abs(value) < 1e6:
            assert number.real == pytest.approx(value, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "latex"),
    [
        ("q1", "q_1"),
        ("q12", "q_{12}"),
        ("alpha1", r"\alpha_1"),
        ("theta", r"\theta"),
        ("L", "L"),
        ("l2", "l_2"),
        ("d_3", "d_3"),
        ("tool", r"\mathrm{tool}"),
        ("tool2", r"\mathrm{tool}_2"),
    ],
)
def test_names_have_one_latex_form(name: str, latex: str):
    assert latex_name(name) == latex


def test_a_name_that_sympy_has_for_a_function_is_the_name():
    assert parse("Abs + 1", ("Abs",)).names == {"Abs"}


def test_reading_runs_nothing_of_python(monkeypatch: pytest.MonkeyPatch):
    def forbidden(*_: Any, **__: Any) -> Any:
        raise AssertionError

    for name in ("eval", "exec", "compile", "__import__"):
        monkeypatch.setattr(f"builtins.{name}", forbidden)
    results = [read(entry["input"]) for entry in BAD]
    monkeypatch.undo()
    assert sum(result is not None for result in results) == 1


def test_what_occurs_twice_is_computed_once_but_for_zeros_of_either_sign():
    formula = parse("sin(q1) + sin(q1)*sin(q1)", ["q1"])
    assert len(formula._steps) == 4
    assert formula.at({"q1": 0.5}) == np.sin(0.5) + np.sin(0.5) * np.sin(0.5)
    one_over = (("n", 1.0), ("n", 0.0), ("/", 0, 1), ("n", 1.0), ("n", -0.0), ("/", 3, 4))
    assert np.isnan(Expression((*one_over, ("+", 2, 5))).at({}))
