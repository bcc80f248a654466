"""What students type: shorthands are read as the long form, and what may be two things is refused at its place."""

import pickle
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kinegrade.grader.reading.typed import typed
from kinegrade.solutions.expression import ExpressionError, parse

NAMES = ("q1", "q2", "q3", "l1", "a_2", "d1", "alpha1")
TWELVE = tuple(f"q{i}" for i in range(1, 13))


def refusal(text: Any, names: Any = NAMES) -> ExpressionError:
    with pytest.raises(ExpressionError) as caught:
        typed(text, names)
    return caught.value


@pytest.mark.parametrize(
    ("text", "long"),
    [
        ("s12", "sin(q1 + q2)"),
        ("c1", "cos(q1)"),
        ("c_23", "cos(q2 + q3)"),
        ("c13", "cos(q1 + q3)"),
        ("S123", "sin(q1 + q2 + q3)"),
        ("C1", "cos(q1)"),
        ("s_{12}", "sin(q1 + q2)"),
        ("s₁₂", "sin(q1 + q2)"),
        ("sin_12", "sin(q1 + q2)"),
        ("cθ12", "cos(q1 + q2)"),
        ("-s1²", "-sin(q1)^2"),
        ("2/c1", "2/cos(q1)"),
        ("th1 + theta1 + theta_1 + θ₁ + θ_1", "q1 + q1 + q1 + q1 + q1"),
        ("q_1*Q2", "q1*q2"),
        ("l_1 + L1 + L_1 + a2 + A_2", "l1 + l1 + l1 + a_2 + a_2"),
        ("α₁ + alpha_1", "alpha1 + alpha1"),
        ("rrt_d1 + three_axis_l1 + rrt_d_1 + rrt_a2", "d1 + l1 + d1 + a_2"),
        ("rrt_theta1 + rrt_θ₂ + rrt_q_3", "q1 + q2 + q3"),
        ("np.sin(q1) + numpy.cos(q1)", "sin(q1) + cos(q1)"),
        ("math.pi/2 - np.pi + sp.pi + Pi", "pi/2 - pi + pi + pi"),
        ("sympy.sqrt(2) + Sqrt(2)", "sqrt(2) + sqrt(2)"),
        ("arcsin(l1) + np.arccos(l1) + arctan(l1)", "asin(l1) + acos(l1) + atan(l1)"),
        ("np.arctan2(l1, d1)", "atan2(l1, d1)"),
        ("tg(q1)", "tan(q1)"),
        ("sin²(q1) + cos^2(q1) + np.sin**2(q1)", "sin(q1)^2 + cos(q1)^2 + sin(q1)^2"),
        ("sin²(q1)^3", "(sin(q1)^2)^3"),
        ("-sin²(q1 + (q2))", "-sin(q1 + (q2))^2"),
        ("2/sec(q1)^2", "2/(1/cos(q1))^2"),
        ("csc²(q1)", "(1/sin(q1))^2"),
        ("cot(sec(q1) + cos²(q2))", "1/tan(1/cos(q1) + cos(q2)^2)"),
        ("√3/2 + √(l1)", "sqrt(3)/2 + sqrt(l1)"),
        ("2·√2×l1 − d1", "2*sqrt(2)*l1 - d1"),
        ("q1⁻¹", "q1^-1"),
        ("|l1*s12|", "abs(l1*sin(q1 + q2))"),
        ("Abs(l1*s1) + np.abs(d1) + math.fabs(q1)", "abs(l1*sin(q1)) + abs(d1) + abs(q1)"),
        ("|q1| - |q2|", "abs(q1) - abs(q2)"),
        ("-|q1|²/2", "-abs(q1)^2/2"),
        ("|-q1*(|q2| - 1)|", "abs(-q1*(abs(q2) - 1))"),
        ("atan2(|q1|, abs²(q2))", "atan2(abs(q1), abs(q2)^2)"),
        ("sqrt(|s1|)*|c1|", "sqrt(abs(sin(q1)))*abs(cos(q1))"),
    ],
)
def test_shorthands_are_the_long_form(text: str, long: str):
    assert typed(text, NAMES) == parse(long, NAMES)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("s12", ("s12", "q1", "q2")),
        ("C1", ("C1", "c1", "q1")),
        ("theta1", ("theta1", "q1")),
        ("L1", ("L1", "l1")),
        ("rrt_d1", ("rrt_d1", "d1")),
        ("t1", ("t1", "q1")),
    ],
)
def test_a_name_is_itself_before_it_is_a_shorthand(text: str, names: tuple[str, ...]):
    assert typed(text, names) == parse(text, names)


def test_joints_may_be_called_theta():
    assert typed("th_1 + θ₂", ("theta1", "theta2")) == parse(
        "theta1 + theta2", ("theta1", "theta2")
    )


@pytest.mark.parametrize(
    ("text", "long"),
    [
        ("s23", "sin(q2 + q3)"),
        ("c10", "cos(q10)"),
        ("s1112", "sin(q11 + q12)"),
        ("s910", "sin(q9 + q10)"),
    ],
)
def test_digits_are_read_with_twelve_joints_where_one_cut_is_possible(text: str, long: str):
    assert typed(text, TWELVE) == parse(long, TWELVE)


@pytest.mark.parametrize(
    ("text", "names", "message"),
    [
        ("l1*s12", (*TWELVE, "l1"), "'s12' may be sin(q1 + q2) or sin(q12)"),
        ("l1*sin12", NAMES, "'sin12' may be sin(12) or sin(q1 + q2)"),
        ("l1*t1", NAMES, "'t1' may be q1 or tan(q1)"),
        ("l1*C1", ("l1", "c1", "q1"), "'C1' may be c1 or cos(q1)"),
        ("l1*th1", ("l1", "q1", "theta1"), "'th1' may be q1 or theta1"),
        ("l1*M", ("l1", "m_", "m"), "'M' may be m or m_"),
    ],
)
def test_what_may_be_two_things_is_refused_with_both(
    text: str, names: tuple[str, ...], message: str
):
    error = refusal(text, names)
    assert (error.message, error.offset) == (message, 3)


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("2q1", 1, "a sign such as * is missing before 'q1'"),
        ("2s12", 1, "a sign such as * is missing before 's12'"),
        ("2θ₁", 1, "a sign such as * is missing before 'θ₁'"),
        ("l1 cos(q1)", 3, "a sign such as * is missing before 'cos'"),
        ("l1cos(q1)", 2, "a sign such as * is missing before 'cos'"),
        ("(q1)(q2)", 4, "a sign such as * is missing before '('"),
        ("q1 + s1c23", 7, "a sign such as * is missing before 'c23'"),
        ("q1 + θ₁θ₂s3", 7, "a sign such as * is missing before 'θ₂s3'"),
        ("x2", 0, "unknown name 'x2'"),
        ("s4", 0, "unknown name 's4'"),
        ("s21", 0, "unknown name 's21'"),
        ("s11", 0, "unknown name 's11'"),
        ("theta12", 0, "unknown name 'theta12'"),
        ("1 + d_q1", 4, "unknown name 'd_q1'"),
        ("1 + dot_q1", 4, "unknown name 'dot_q1'"),
        ("1 + c_q1", 4, "unknown name 'c_q1'"),
        ("1 + s1_q2", 4, "unknown name 's1_q2'"),
        ("np.exp(1)", 0, "unknown function 'np.exp'"),
        ("os.sin(q1)", 0, "unknown function 'os.sin'"),
        ("np.d1", 0, "unknown name 'np.d1'"),
        ("e", 0, "unknown name 'e'"),
        ("2*i", 2, "unknown name 'i'"),
        ("sin q1", 4, "sin takes its argument in brackets"),
        ("sin²q1", 3, "a power stands behind the argument"),
        ("sin^q1(q1)", 3, "a power stands behind the argument"),
        ("sin⁻¹(q1)", 3, "sin to a negative power is written asin(x) or 1/sin(x)"),
        ("sec^-1(q1)", 3, "sec to a negative power is written 1/sec(x)"),
        ("sec q1", 4, "sec takes its argument in brackets"),
        ("√q1", 1, "√ takes a number or brackets"),
        ("q1²^3", 2, "two powers in a row take brackets"),
        ("q1² ³", 2, "two powers in a row take brackets"),
        ("atan2(q1)", 8, "atan2 takes 2 arguments, got 1"),
        ("atan2 q1", 6, "atan2 takes two arguments in brackets"),
        ("atan(q1, q2)", 7, "a comma has no place here"),
        ("θ₁ + 3,14", 6, "a decimal number takes a point"),
        ("sec(q1", 6, "a closing bracket is missing"),
        ("sin²(", 5, "the formula stops"),
        ("sin^", 3, "a power stands behind the argument"),
        ("√", 1, "√ takes a number or brackets"),
        ("sec(pi/2)", 0, "division by zero"),
        ("a_" * 199, 0, "unknown name"),
        ("s" + "1" * 399, 0, "unknown name"),
        ("q1 = 0", 3, "'=' has no meaning"),
        ("|q1", 3, "a second bar is missing: write abs(...)"),
        ("q1 + (|q2) + l1|", 9, "a second bar is missing: write abs(...)"),
        ("atan2(|q1, q2|)", 9, "a second bar is missing: write abs(...)"),
        ("q1|", 2, "this bar may open or close: write abs(...)"),
        ("||q1| - |q2||", 1, "this bar may open or close: write abs(...)"),
        ("|q1*|q2|*q3|", 4, "this bar may open or close: write abs(...)"),
        ("|q1|q2|q3|", 6, "this bar may open or close: write abs(...)"),
        ("|q1||q2|", 4, "this bar may open or close: write abs(...)"),
        ("2|q1|", 1, "this bar may open or close: write abs(...)"),
        ("sin|q1|", 3, "this bar may open or close: write abs(...)"),
        ("||", 1, "this bar may open or close: write abs(...)"),
        ("l1abs(q1)", 2, "a sign such as * is missing before 'abs'"),
    ],
)
def test_what_is_ambiguous_is_refused_at_the_place_as_typed(text: str, offset: int, message: str):
    error = refusal(text)
    assert error.message.startswith(message)
    assert error.offset == offset
    assert error.text == text


def test_the_caret_stands_under_the_typed_letter():
    assert refusal("θ₁² + s12 − 2cθ1").caret == "θ₁² + s12 − 2cθ1\n             ^"


@pytest.mark.parametrize("text", [None, 3.5, b"q1"])
def test_what_is_no_text_is_refused(text: Any):
    assert refusal(text).message.startswith("a formula takes text, got")


def test_refusals_travel_between_processes_with_their_place():
    error = pickle.loads(pickle.dumps(refusal("2s12")))  # noqa: S301  our own bytes
    assert error.caret == "2s12\n ^"


JOINTS = st.sets(st.integers(1, 9), min_size=1).map(sorted)


@given(st.sampled_from(["s", "c", "S", "C", "s_", "cθ"]), JOINTS)
def test_any_rising_digits_are_the_sum_of_their_joints(stem: str, joints: list[int]):
    function = "sin" if stem[0] in "sS" else "cos"
    text = f"2*{stem}{''.join(map(str, joints))}^2"
    assert typed(text, TWELVE[:9]) == parse(
        f"2*{function}({' + '.join(f'q{i}' for i in joints)})^2", TWELVE
    )


SHORT = [
    "s1",
    "c_23",
    "θ₂",
    "L1",
    "rrt_d1",
    "√2",
    "sec(q1)",
    "sin²(q3)",
    "np.pi",
    "atan2(s1, c1)",
    "q2²",
]


@given(st.lists(st.tuples(st.sampled_from(SHORT), st.sampled_from("+-*/")), min_size=1, max_size=6))
def test_what_is_read_is_printed_in_the_long_form(terms: list[tuple[str, str]]):
    text = " ".join(f"{term} {sign}" for term, sign in terms)[:-2]
    formula = typed(text, NAMES)
    values = {"q1": 0.3, "q2": -1.1, "q3": 0.8, "l1": 0.7, "a_2": 0.4, "d1": 1.2}
    assert parse(str(formula), NAMES).at(values) == formula.at(values)
