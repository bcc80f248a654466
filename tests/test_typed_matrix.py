"""Typed matrices and conditions; and what people and machines have thrown at readers of formulas."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kinegrade.grader.reading.typed import typed
from kinegrade.grader.reading.typed_equations import typed_equations
from kinegrade.grader.reading.typed_matrix import typed_matrix
from kinegrade.solutions.condition import equations_of
from kinegrade.solutions.expression import ExpressionError, parse

NAMES = ("q1", "q2", "q3", "a", "b", "c", "d", "a1")
ABCD = [["a", "b"], ["c", "d"]]
BAD: list[dict[str, str]] = json.loads(
    (Path(__file__).parent / "data" / "bad_inputs.json").read_text(encoding="utf-8")
)
REFUSED = None
READ: dict[str, tuple[Any, Any, Any]] = {  # as a formula, as a matrix, as conditions
    "1e-3": (0.001, [[0.001]], REFUSED),
    "[1 - 2]": (REFUSED, [[-1.0]], REFUSED),
    "(16-9*(sec(0)^2))/3": (7 / 3, [[7 / 3]], REFUSED),
}
PLACES = {
    "eval('dict')": (5, 5, 5),
    "sin(f(n))": (4, 4, 4),
    "1\uff3c2": (1, 1, 1),
    "n + 2 # comment": (6, 6, 6),
    "3e5j": (3, 3, 3),
    "(16-9*(sec(0)^2))/3": (None, None, 0),
    "aatan(n)": (0, 0, 0),
    "[1,, 2, 3]": (0, 3, 0),
    "[1 2 np.inf]": (0, 3, 0),
    'system("rm *")': (7, 7, 7),
    '"system(rm *)"': (0, 0, 0),
    "''diff(f,x)": (0, 0, 0),
    "3.67x10^2": (4, 4, 4),
    "3,14": (1, 1, 1),
    "3e8e8": (3, 3, 3),
    "0^-1": (1, 1, 1),
    "A^^(-1)": (0, 0, 0),
    "99999999!": (8, 8, 8),
    "Float('1e99999999')": (6, 6, 6),
    "1e-400": (0, 0, 0),
    "x2": (0, 0, 0),
    "[1,5 2,5]": (0, 5, 0),
    "[1 - 2]": (0, None, 0),
    "\u0663": (0, 0, 0),
    "1/0": (1, 1, 1),
    "9**9**9": (1, 1, 1),
    "1e999999999": (0, 0, 0),
    "1<<9999999999": (1, 1, 1),
    "~q1": (0, 0, 0),
    "factorial(factorial(factorial(9)))": (0, 0, 0),
    "1e-3": (None, None, 0),
    "nan": (0, 0, 0),
    "().__class__": (2, 2, 2),
    "q1.__class__": (0, 0, 0),
    "(" * 51 + "1" + ")" * 51: (41, 41, 41),
}


def printed(rows: Any) -> Any:
    return [[str(entry) for entry in row] for row in rows]


def refusal(read: Callable, text: Any, names: Any = NAMES) -> ExpressionError:
    with pytest.raises(ExpressionError) as caught:
        read(text, names)
    return caught.value


def value_of(found: Any) -> Any:
    return [value_of(entry) for entry in found] if isinstance(found, list) else found.at({})


@pytest.mark.parametrize("which", range(3), ids=["formula", "matrix", "conditions"])
@pytest.mark.parametrize("text", sorted({entry["input"] for entry in BAD}), ids=ascii)
def test_every_bad_input_is_refused_at_its_place_or_read_as_a_person_would(text: str, which: int):
    read = (typed, typed_matrix, typed_equations)[which]
    meant, place = READ.get(text, (REFUSED,) * 3)[which], PLACES[text][which]
    if meant is not REFUSED:
        assert place is None
        assert value_of(read(text, ("q1", "n"))) == meant
    else:
        error = refusal(read, text, ("q1", "n"))
        assert error.offset == place
        assert error.message
        assert error.caret.split("\n")[1].strip() == "^"


@pytest.mark.parametrize(
    "text",
    [
        "[[a, b], [c, d]]",
        "[[a, b]; [c, d]]",
        "[[a,b],\n [c,d]]",
        "[[a, b]\n [c, d]]",
        "[\n  [a,\n   b],\n  [c, d],\n]",
        "[a, b; c, d]",
        "[a, b;\n c, d;]",
        "[a, b\n c, d]",
        "[a,b\r\n\r\nc,d\r\n]",
        "Matrix([[a, b], [c, d]])",
        "sp.ImmutableDenseMatrix([[a, b], [c, d]])",
        "sym([a, b; c, d])",
        "matrix([[a, b], [c, d]])",
        "np.array([[a, b],\n       [c, d]])",
        "Matrix(\n[\n[a, b],\n[c, d]\n]\n)",
    ],
)
def test_rows_are_read_in_any_of_the_usual_ways(text: str):
    assert printed(typed_matrix(text, NAMES)) == ABCD


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("a", [["a"]]),
        ("  -s1*b ", [["-sin(q1)*b"]]),
        ("[a]", [["a"]]),
        ("[a, b, c]", [["a", "b", "c"]]),
        ("[a; b]", [["a"], ["b"]]),
        ("[[a], [b]]", [["a"], ["b"]]),
        ("array([a, b])", [["a", "b"]]),
        ("Matrix([a, b])", [["a"], ["b"]]),
        ("[a - b, c-d, -a]", [["a - b", "c - d", "-a"]]),
        ("[[a -b, c]]", [["a - b", "c"]]),
        ("[(a -b), c]", [["a - b", "c"]]),
        ("[|a -b|, |c| - d]", [["abs(a - b)", "abs(c) - d"]]),
        ("[|a|; abs(b)]", [["abs(a)"], ["abs(b)"]]),
        ("[atan2(a, b); s12]", [["atan2(a, b)"], ["sin(q1 + q2)"]]),
        ("[sin (q1), (a\n+ b)]", [["sin(q1)", "a + b"]]),
        ("[3,14]", [["3", "14"]]),
        ("[θ₁, q2²; √2, 1e-3]", [["q1", "q2^2"], ["sqrt(2)", "0.001"]]),
    ],
)
def test_entries_are_read_as_typed(text: str, rows: list[list[str]]):
    assert printed(typed_matrix(text, NAMES)) == rows


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("[a b; c d]", 3, "entries take commas between them"),
        ("[[1 2]\n [3 4]]", 4, "entries take commas between them"),
        ("[sin(q1) cos(q1)]", 9, "entries take commas between them"),
        ("[a (b)]", 3, "a sign such as * is missing before '('"),
        ("[2 (b)]", 3, "entries take commas between them"),
        ("[√3 √2]", 4, "entries take commas between them"),
        ("[[a, b\n c, d]]", 8, "entries take commas between them"),
        ("[1 -2]", 3, "this may be one entry or two: write a - b or a, -b"),
        ("[a +b, c]", 3, "this may be one entry or two: write a + b or a, +b"),
        ("[[1 -2]\n [3 -4]]", 4, "this may be one entry or two"),
        ("[a\n-b]", 3, "a line that starts with a sign may be new or not"),
        ("[[a\n - b, c]]", 5, "a line that starts with a sign may be new or not"),
        ("[a,\nb]", 4, "a line that ends with a comma may go on or not"),
        ("[2a, 1]", 2, "a sign such as * is missing before 'a'"),
        ("[[a, b], [c]]", 10, "rows take 2 entries as the first one has, got 1"),
        ("[a, b; c]", 7, "rows take 2 entries as the first one has, got 1"),
        ("[a,, b]", 3, "an entry is missing"),
        ("[a, b,]", 6, "an entry is missing"),
        ("[]", 1, "an entry is missing"),
        ("[[]]", 2, "an entry is missing"),
        ("", 0, "an entry is missing"),
        ("[[a, b], c]", 9, "a row takes square brackets"),
        ("[a, [b]]", 4, "a number, a name or a bracket is expected, got '['"),
        ("[[[a]]]", 2, "a number, a name or a bracket is expected, got '['"),
        ("[[a; b], [c; d]]", 3, "';' has no place here"),
        ("a, b", 1, "a comma has no place here"),
        ("a; b", 1, "a matrix takes square brackets"),
        ("a\nb", 1, "a matrix takes square brackets"),
        ("2*[a, b]", 2, "a matrix takes square brackets"),
        ("[a, b]*2", 6, "nothing stands behind a matrix"),
        ("[[a]*2, [b]]", 4, "nothing stands behind a matrix"),
        ("Matrix([a]) + 1", 12, "nothing stands behind a matrix"),
        ("[a, b]'", 6, '"\'" has no meaning'),
        ("[a, b", 5, "a closing bracket is missing"),
        ("a]", 1, "this bracket was never opened"),
        ("(a]", 2, "')' is expected, got ']'"),
        ("matrix([a, b])", 8, "matrix takes rows in brackets of their own"),
        ("Matrix(2, 1, [a, b])", 7, "Matrix takes rows in square brackets"),
        ("os.array([a])", 9, "a matrix takes square brackets"),
        ("{a, b}", 0, "'{' has no meaning"),
        ("[" * 3000, 3000, "a closing bracket is missing"),
        (f"[{'a,' * 5000}a]", 1 + 2 * 4096, "a matrix takes up to 4096 entries, got 5001"),
        (f"[a, {'b + ' * 2000}b]", 8005, "a formula takes up to 4000 numbers, names and signs"),
        ("a" * 20_001, 20_000, "a formula takes up to 20000 characters"),
        ("[a, 1/0]", 5, "division by zero"),
        ("[|a| -|b|]", 5, "this may be one entry or two"),
        ("[a |b|]", 3, "this bar may open or close"),
        ("[|a, b|]", 3, "a second bar is missing"),
        ("[a, np.inf]", 4, "unknown name 'np.inf'"),
    ],
)
def test_what_is_no_matrix_is_refused_at_its_place(text: str, offset: int, message: str):
    error = refusal(typed_matrix, text)
    assert error.message.startswith(message)
    assert error.offset == offset
    assert error.text == text


def test_the_caret_stands_in_the_whole_matrix():
    assert refusal(typed_matrix, "[θ₁, 1;\n 2q1, 0]").caret == "[θ₁, 1;  2q1, 0]\n          ^"


@pytest.mark.parametrize(
    ("read", "what"), [(typed_matrix, "a matrix"), (typed_equations, "a condition")]
)
def test_what_is_no_text_is_refused(read: Callable, what: str):
    assert refusal(read, [["a"]]).message == f"{what} takes text, got list"


ENTRY = st.sampled_from(
    ["a", "-b", "c1", "s12*a", "(a -b)", "2", "atan2(a, b)", "a - b", "√2", "q1²"]
)


@given(
    st.integers(1, 3).flatmap(
        lambda n: st.lists(st.lists(ENTRY, min_size=n, max_size=n), min_size=1, max_size=3)
    )
)
def test_all_ways_to_write_a_matrix_are_one_matrix(rows: list[list[str]]):
    lines = [", ".join(row) for row in rows]
    expected = [[typed(entry, NAMES) for entry in row] for row in rows]
    for text in (f"[{'; '.join(lines)}]", f"Matrix([{', '.join(f'[{line}]' for line in lines)}])"):
        assert typed_matrix(text, NAMES) == expected


INTEGERS = [f"q2 - {f'(-{-k}*pi)' if k < 0 else f'{k}*pi'}" for k in range(-4, 5)]


@pytest.mark.parametrize(
    ("text", "conditions"),
    [
        ("sin(q2) = 0", ["sin(q2)"]),
        ("s2 == 0", ["sin(q2)"]),
        ("sin(q2)", ["sin(q2)"]),
        ("s2, q3", ["sin(q2)", "q3"]),
        ("0 = q3", ["0 - q3"]),
        ("sin(q2) = -a1/q3", ["sin(q2) - (-a1/q3)"]),
        ("q2 = 0 or q2 = pi", ["q2", "q2 - pi"]),
        ("q2 = 0 OR pi", ["q2", "q2 - pi"]),
        ("q2 = 0, pi, -pi", ["q2", "q2 - pi", "q2 - (-pi)"]),
        ("q2 = 0, 1", ["q2", "q2 - 1"]),
        ("q2 = 0; q3 = 0;", ["q2", "q3"]),
        ("q2 = 0\nq3 = 0\n", ["q2", "q3"]),
        ("q2 = 0 or\n q3 = 0,\n1", ["q2", "q3", "q3 - 1"]),
        ("q2 = +-pi/2", ["q2 - pi/2", "q2 - (-pi/2)"]),
        ("q2 = ±pi/2", ["q2 - pi/2", "q2 - (-pi/2)"]),
        ("q2 = a ± b", ["q2 - (a + b)", "q2 - (a - b)"]),
        ("q2 = 1 + -a", ["q2 - (1 + (-a))"]),
        ("q2 = k*pi", INTEGERS),
        ("q3 = 0, q2 = n*pi", ["q3", *INTEGERS]),
        ("atan2(q1,\n q2) = 0", ["atan2(q1, q2)"]),
        ("|q2| = pi", ["abs(q2) - pi"]),
        ("sin(q2) = 0 and sin(q3) = 0", ["sin(q2) = 0 and sin(q3) = 0"]),
        ("s2 AND s3", ["sin(q2) = 0 and sin(q3) = 0"]),
        ("q2 == 0 & q3 == 0 && a = b ∧ c = d", ["q2 = 0 and q3 = 0 and a - b = 0 and c - d = 0"]),
        ("q2 = 0, pi and q3 = 0", ["q2*(q2 - pi) = 0 and q3 = 0"]),
        ("(q2 = 0 or q2 = pi) and q3 = ±1", ["q2*(q2 - pi) = 0 and (q3 - 1)*(q3 - (-1)) = 0"]),
        ("q2 = 0 and q3 = 0 or q1 = 0", ["q2 = 0 and q3 = 0", "q1"]),
        ("(q2 = 0 and q3 = 0) or (q1 = 0)", ["q2 = 0 and q3 = 0", "q1"]),
        (
            "q1 = 0, pi; (q2 = 0) and\n (q3 = 0)\na = b",
            ["q1", "q1 - pi", "q2 = 0 and q3 = 0", "a - b"],
        ),
        ("q2 = 0\nand q3 = 0", ["q2 = 0 and q3 = 0"]),
    ],
)
def test_conditions_are_left_side_minus_right_side(text: str, conditions: list[str]):
    assert [str(condition) for condition in typed_equations(text, NAMES)] == conditions


def test_a_free_integer_and_a_sign_run_through_all_values():
    found = typed_equations("q2 = ±(2*k + 1)*pi/2", NAMES)
    assert len(found) == 18
    turns = {round(-2 * float(condition.at({"q2": 0.0})) / math.pi) for condition in found}
    assert turns == {-9, *range(-7, 8, 2), 9}


def test_free_integers_of_equations_that_hold_at_once_run_each_for_itself():
    (condition,) = typed_equations("q2 = k*pi and q3 = n*pi", NAMES)
    for expression, name in zip(equations_of(condition), ("q2", "q3"), strict=True):
        values = [float(expression.at({name: turns * math.pi / 2})) for turns in range(-9, 10)]
        assert [value == 0 for value in values] == [
            abs(turns) < 9 and turns % 2 == 0 for turns in range(-9, 10)
        ]


def test_an_integer_that_is_a_name_is_the_name():
    names = (*NAMES, "k")
    assert typed_equations("q2 = k*pi", names) == [parse("q2 - k*pi", names)]


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("a = b = c", 6, "a = b = c takes two equations"),
        ("q2 == == 0", 6, "a = b = c takes two equations"),
        ("q2 = 1,57", 6, "a decimal number takes a point"),
        ("q2, q3 = 0", 0, "an equation takes two sides"),
        ("q2 = 0, q3", 8, "an equation takes two sides"),
        ("q2 = 0, s3", 8, "an equation takes two sides"),
        ("q2 = 0;; q3 = 0", 7, "an equation takes two sides"),
        ("q2 = 0 and", 10, "an equation takes two sides"),
        ("and q2 = 0", 0, "an equation takes two sides"),
        ("q2 = 0 and q3", 11, "an equation takes two sides"),
        ("q2 = 0 and pi", 11, "an equation takes two sides"),
        ("q2 = 0 or pi and q3 = 0", 10, "an equation takes two sides"),
        ("q2 = 0 and 1 = 1", 11, "a condition takes a joint"),
        (
            "q1 = 0, q2 = 0 and q3 = 0",
            8,
            "beside 'and' a comma between equations may be an 'or' or an 'and'",
        ),
        ("s1, s2 and s3", 4, "beside 'and' a comma between equations may be an 'or' or an 'and'"),
        (
            "q2 = k*pi and q3 = k*pi",
            19,
            "'k' in two equations may be one and the same or not: list the values",
        ),
        ("q2 = ±1 and q3 = +-1", 17, "'±' in two equations may be one and the same or not"),
        ("((q1 = 0 and q2 = 0) or q3 = 0) and a = b", 9, "brackets take one equation here"),
        ("q1 = 0" + " and q1 = 0" * 8, 88, "up to 8 equations hold at once, got 9"),
        ("q2 = 0 | q3 = 0", 7, "this bar may open or close"),
        ("1 = 0", 0, "a condition takes a joint"),
        ("k*pi", 0, "a condition takes a joint"),
        ("q2 =", 4, "a side of the equation is missing"),
        ("= 0", 0, "a side of the equation is missing"),
        ("", 0, "a side of the equation is missing"),
        ("q2 = k*n", 7, "an equation takes one free integer"),
        ("±q2 = ±1", 6, "an equation takes one ±"),
        ("q2 = pi/k", 7, "division by zero"),
        ("q2 = 2k*pi", 6, "a sign such as * is missing before 'k'"),
        ("q2 = 0\n-pi", 7, "a line that starts with a sign"),
        ("q2 >= 0", 3, "'>' has no meaning"),
        ("q2 != 0", 3, "'!' has no meaning"),
        ("[q2 = 0]", 0, "'[' has no meaning"),
        ("(q2 = 0)", 4, "'=' has no place here"),
        ("q2 = (0", 7, "a closing bracket is missing"),
        ("q2 = 0;" * 65, 7 * 64, "up to 64 conditions are read, got 65"),
        ("q2 = " + "1 + " * 2000 + "1", 8006, "a formula takes up to 4000 numbers"),
        ("q2 = " + "(" * 9000 + "1" + ")" * 9000, 85, "the formula is nested too deeply"),
        ("q" * 20_001, 20_000, "a formula takes up to 20000 characters"),
    ],
)
def test_what_is_no_condition_is_refused_at_its_place(text: str, offset: int, message: str):
    error = refusal(typed_equations, text)
    assert error.message.startswith(message)
    assert error.offset == offset
    assert error.text == text
