"""A hundred thousand strings: each is read as Python reads it, or refused at a place; nothing else happens."""

import ast
import math
import random
import warnings
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from kinegrade.grader.reading.typed import typed
from kinegrade.grader.reading.typed_equations import typed_equations
from kinegrade.grader.reading.typed_matrix import typed_matrix
from kinegrade.solutions.expression import ExpressionError

MANY = 100_000
VALUES = {"q1": 0.7, "q2": -0.4, "q3": 1.9, "l1": 0.83, "a2": 0.31, "d1": 1.27}
NAMES = tuple(VALUES)
SHORT = {
    "l_1": VALUES["l1"], "L1": VALUES["l1"], "rrt_d1": VALUES["d1"], "theta1": 0.7, "th_2": -0.4, "theta_3": 1.9,
    "q_1": 0.7, "s1": math.sin(0.7), "c2": math.cos(-0.4), "s12": math.sin(0.7 - 0.4), "c_23": math.cos(1.9 - 0.4),
    "S123": math.sin(0.7 - 0.4 + 1.9), "C13": math.cos(0.7 + 1.9), "pi": math.pi,
}  # fmt: skip
FUNCTIONS: dict[str, Callable[..., float]] = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "asin": np.arcsin, "acos": np.arccos,
    "atan": np.arctan, "arcsin": np.arcsin, "arctan": np.arctan, "atan2": np.arctan2, "arctan2": np.arctan2,
    "abs": np.abs, "Abs": np.abs,
    "sec": lambda x: 1 / np.cos(x), "csc": lambda x: 1 / np.sin(x), "cot": lambda x: 1 / np.tan(x),
}  # fmt: skip
MODULES = ("np", "numpy", "math", "sp", "sympy")
OPERATIONS = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.Pow: np.power,
}
LEAVES = [*VALUES, *SHORT, "1", "2", "0.5", "3.75", "1e-3", "10", "np.pi", "0"]
PIECES = [
    *LEAVES, *FUNCTIONS, *"+-*/^(),;[]", "**", " ", "  ", "\n", "=", ".", "e", "x2", "s1c2", "9" * 30, "1e999",
    "²", "³", "⁻¹", "√", "π", "θ₁", "·", "−", "s_{12}", "np.", "Matrix", "array", "sin x", "__class__", "lambda", "if",
    "1e-400", "°", "or", "k", "'", '"', "!", "%", "//", "<<", "~", "@", "{", "}", "\\", "#", "\t", "_", "1_000", "0x1f",
    "1j", "±", "|", "|", "and", "&", "\u200b", "\\theta_1", "(t)", "90°", " deg", "J =",
]  # fmt: skip


AROUND = [
    ("(", ")"), ("[", "]"), ("-", ""), ("2^", ""), ("sin(", ")"), ("sec(", ")"), ("1+", ""), ("[[", "]]"), ("√(", ")"),
    ("sin²(", ")"), ("", "9"), ("", "!"), ("", "^9"), ("s", ""), ("", "1"), ("", "e9"), ("q1,", ""), ("", "\n"),
    ("q1", ""), ("s1_", ""), ("atan2(1,", ")"), ("((", ")"), ("Matrix(", ")"), ("±", ""), ("q1=", ""),
    ("|", "|"), ("abs(", ")"), ("(|", "|)"), ("q1 and ", ""),
]  # fmt: skip


class Unknown(Exception):
    """Python may read it, but not as a formula."""


def python_value(node: ast.AST):  # noqa: PLR0911  one for each kind of node
    match node:
        case ast.Expression(body=body):
            return python_value(body)
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return np.float64(value)
        case ast.Name(id=name) if name in VALUES or name in SHORT:
            return np.float64((VALUES | SHORT)[name])
        case ast.Attribute(value=ast.Name(id=module), attr="pi") if module in MODULES:
            return np.float64(math.pi)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATIONS:
            return OPERATIONS[type(op)](number(left), number(right))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -number(operand)
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return number(operand)
        case ast.Call(func=function, args=arguments, keywords=[]) if (
            function_name(function) in FUNCTIONS
        ):
            return FUNCTIONS[function_name(function)](*map(number, arguments))
        case ast.List(elts=entries):
            return [python_value(entry) for entry in entries]
        case _:
            raise Unknown


def number(node: ast.AST):
    value = python_value(node)
    if isinstance(value, list):
        raise Unknown
    return value


def function_name(node: ast.AST) -> str:
    match node:
        case ast.Name(id=name):
            return name
        case ast.Attribute(value=ast.Name(id=module), attr=name) if module in MODULES:
            return name
    return ""


def oracle(text: str):
    """What Python makes of the text, its ^ taken as **; None where it is no formula to Python."""
    try:
        with np.errstate(all="ignore"):
            return python_value(ast.parse(text.strip().replace("^", "**"), mode="eval"))
    except (
        SyntaxError,
        ValueError,
        TypeError,
        OverflowError,
        RecursionError,
        MemoryError,
        Unknown,
    ):
        return None


def formula(rng: random.Random, depth: int) -> str:
    if depth == 0 or rng.random() < 0.2:
        return rng.choice(LEAVES)
    inner, space = formula(rng, depth - 1), rng.choice(["", "", " "])
    match rng.randrange(6):
        case 0:
            return f"({inner})"
        case 1:
            return f"{rng.choice(['', '', 'np.', 'math.'])}{rng.choice(list(FUNCTIONS))}({inner})"
        case 2:
            return f"-{inner}"
        case 3:
            return f"{inner}{rng.choice(['^', '**', ' ** '])}{rng.choice(['2', '-1', '3', '0.5', '(1/2)', '2^2'])}"
        case _:
            return f"{inner}{space}{rng.choice('+-*/')}{space}{formula(rng, depth - 1)}"


def matrix(rng: random.Random) -> str:
    rows = [[formula(rng, 2) for _ in range(rng.randint(1, 3))] for _ in range(rng.randint(1, 3))]
    if rng.random() < 0.9:
        rows = [row[: min(map(len, rows))] for row in rows]
    comma = rng.choice([",", ", ", ", ", " , ", " "])
    typed_rows = [comma.join(row) for row in rows]
    match rng.randrange(4):
        case 0:
            return f"[{rng.choice([';', '; ', chr(10)]).join(typed_rows)}]"
        case 1:
            return f"[{', '.join(comma.join(row) for row in rows)}]"
        case 2:
            return f"Matrix([{', '.join(f'[{row}]' for row in typed_rows)}])"
        case _:
            return f"[{rng.choice([',', ', ', f',{chr(10)} ']).join(f'[{row}]' for row in typed_rows)}]"


def mutated(rng: random.Random, text: str) -> str:
    for _ in range(rng.randint(1, 3)):
        place = rng.randint(0, len(text))
        text = (
            text[:place]
            + rng.choice(["", rng.choice(PIECES), " "])
            + text[place + rng.randint(0, 2) :]
        )
    return text


def anything(rng: random.Random) -> str:
    return "".join(
        chr(rng.choice([rng.randrange(128), rng.randrange(0x2200), rng.randrange(0x110000)]))
        for _ in range(12)
    )


def extreme(rng: random.Random) -> str:
    many, inner = rng.choice([5, 20, 39, 45, 150, 3000]), rng.choice(LEAVES)
    opening, closing = rng.choice(AROUND)
    return opening * many + inner + closing * rng.choice([many, many, many - 1])


def strings(rng: random.Random) -> Iterator[str]:
    kinds: list[tuple[int, Callable[[], str]]] = [
        (25, lambda: formula(rng, 4)),
        (25, lambda: mutated(rng, formula(rng, 3))),
        (20, lambda: mutated(rng, matrix(rng))),
        (10, lambda: matrix(rng)),
        (12, lambda: "".join(rng.choices(PIECES, k=rng.randint(1, 9)))),
        (6, lambda: anything(rng)),
        (2, lambda: extreme(rng)),
    ]
    makers = rng.choices([make for _, make in kinds], [weight for weight, _ in kinds], k=MANY)
    yield from (make() for make in makers)


def outcome(read: Callable, text: str):
    """What is read, or None where the text is refused at a place within it."""
    try:
        return read(text, NAMES)
    except ExpressionError as refusal:
        error = refusal
    assert 0 <= error.offset <= len(text), text
    assert error.message, text
    assert error.caret.endswith("^"), text
    return None


def with_two_columns(text: str, names: tuple[str, ...]):
    return typed_matrix(text, names, 2)


def as_matrix(text: str):
    """What Python makes of a matrix: a flat list is a row, in Matrix(...) a column, and a number 1 x 1."""
    bare = text.strip()
    wrapped = bare.startswith("Matrix(") and bare.endswith(")")
    value: Any = oracle(bare[7:-1] if wrapped else bare)
    if not isinstance(value, list):
        return None if value is None else [[value]]
    nested = bool(value) and all(isinstance(row, list) for row in value)
    return value if nested else [[entry] for entry in value] if wrapped else [value]


def same(value: Any, meant: Any) -> bool:
    if isinstance(meant, list):
        return len(value) == len(meant) and all(map(same, value, meant))
    return math.isclose(value, meant, rel_tol=1e-9, abs_tol=1e-12) or (
        math.isnan(value) and math.isnan(meant)
    )


@pytest.mark.slow
def test_strings_are_read_as_python_reads_them_or_refused():
    rng = random.Random(20)  # noqa: S311  the same strings every time
    formulas = matrices = 0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Python's, about 1or and the like
        for i, text in enumerate(strings(rng)):
            if i % 4 == 0:  # conditions have no twin in Python: they are only to be read or refused
                outcome(typed_equations, text)
            if i % 4 == 1:  # where a blank may be a comma, Python reads otherwise
                outcome(with_two_columns, text)
            read, meant = outcome(typed, text), oracle(text)
            if read is not None and meant is not None:
                assert same(read.at(VALUES), meant), text
                formulas += 1
            rows, meant = outcome(typed_matrix, text), as_matrix(text)
            if rows is not None and meant is not None:
                assert same([[entry.at(VALUES) for entry in row] for row in rows], meant), text
                matrices += 1
    assert min(formulas, matrices) > 10_000
