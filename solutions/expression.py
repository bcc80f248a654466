"""One type for formulas: robot rows, course files, typed answers."""

import math
import operator
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import nearest
from .tokens import SIZE, ExpressionError, Token, number, refusing, tokens_of

Node = tuple[str, *tuple[Any, ...]]  # ("n", 2.0) | ("s", "q1") | ("sin", i) | ("*", i, j)
FUNCTIONS: dict[str, Callable[[Any], Any]] = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan,
    "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "sqrt": np.sqrt, "abs": np.abs,
}  # fmt: skip
PLAIN = {"+": "add", "-": "sub", "*": "mul", "/": "truediv", "^": "pow", "neg": "neg", "abs": "abs"}
UNARY = FUNCTIONS | {"neg": np.negative}
BINARY: dict[str, Callable[[Any, Any], Any]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": np.power,
    "atan2": np.arctan2,
}  # fmt: skip
CALLED = {**dict.fromkeys(FUNCTIONS, 1), "atan2": 2}  # functions and how many arguments they take
AS_PRINTED = {"Abs": "abs"}  # functions that sympy prints under another name
DEPTH, EXPONENT = 40, 20
MISSING = {
    "(": "",
    ")": "a closing bracket is missing",
    ",": "a comma and another argument are missing",
}
BINDING = {"+": 10, "-": 10, "*": 20, "/": 20, "neg": 30, "^": 40}


@dataclass(frozen=True)
class Expression:
    """A formula as nodes in post-order; the last is the whole. `parse` makes it."""

    nodes: tuple[Node, ...]

    def __post_init__(self) -> None:
        open_nodes = list[int]()
        for i, node in enumerate(self.nodes):
            kind, *arguments = node or ("",)
            size = 1 if kind in UNARY else 2 if kind in BINARY else 0
            known = len(arguments) == size if size else _is_leaf(node)
            arguments = arguments if size else []
            if not known or open_nodes[len(open_nodes) - len(arguments) :] != arguments:
                raise ExpressionError(
                    f"nodes takes a tree in post-order, got {node!r} at place {i}"
                )
            open_nodes[len(open_nodes) - len(arguments) :] = [i]
        if len(open_nodes) != 1:
            raise ExpressionError(f"nodes takes one tree in post-order, got {len(open_nodes)}")

    @property
    def names(self) -> frozenset[str]:
        """Names that occur."""
        return frozenset(str(node[1]) for node in self.nodes if node[0] == "s")

    def at(self, values: Mapping[str, ArrayLike]) -> float | NDArray[np.float64]:
        """Value where each name has its value; arrays broadcast, a result without any array is a float.

        Outside a function's domain the value is NaN or infinite, as numpy has it. Raises ExpressionError if a
        name has no value.
        """
        if missing := sorted(self.names - set(values)):
            raise ExpressionError(
                f"values takes {', '.join(missing)}, got only {', '.join(sorted(values)) or 'none'}"
            )
        results = list[Any]()
        with np.errstate(all="ignore"):
            for node in self.nodes:
                if node[0] == "n":
                    results.append(node[1])
                elif node[0] == "s":
                    results.append(np.asarray(values[node[1]], dtype=np.float64))
                else:
                    results.append(_apply(node[0], [results[i] for i in node[1:]]))
        value = np.asarray(results[-1], dtype=np.float64)
        return value if value.ndim else float(value)

    def sympy(self) -> Any:
        """The sympy expression: names become Symbol(name, real=True), decimals exact rationals."""
        sympy: Any = import_module("sympy")
        results = list[Any]()
        for kind, *content in self.nodes:
            if kind == "s":
                results.append(sympy.Symbol(content[0], real=True))
            elif kind == "n":
                results.append(
                    sympy.pi if content[0] == math.pi else sympy.Rational(repr(content[0]))
                )
            else:
                operation = (
                    getattr(operator, PLAIN[kind]) if kind in PLAIN else getattr(sympy, kind)
                )
                results.append(operation(*(results[i] for i in content)))
        return results[-1]

    def put(self, values: Mapping[str, "Expression"]) -> "Expression":
        """The formula with other formulas in place of names; a name without one stays."""
        nodes = list[Node]()
        places = list[int]()  # of the results of the formula's own nodes
        for node in self.nodes:
            if node[0] == "s" and node[1] in values:
                inside, start = values[node[1]].nodes, len(nodes)
                nodes += [_moved(inner, range(start, start + len(inside))) for inner in inside]
            else:
                nodes.append(_moved(node, places))
            places.append(len(nodes) - 1)
        return Expression(tuple(nodes))

    def __str__(self) -> str:
        """Text that parses back to the same value."""
        printed = list[tuple[str, int]]()
        for node in self.nodes:
            if node[0] in ("n", "s"):
                printed.append(_printed_leaf(node))
            else:
                printed.append(_printed(node[0], [printed[i] for i in node[1:]]))
        return printed[-1][0]


def parse(text: str, names: Collection[str]) -> Expression:
    """Expression of `text` in `names`, the functions sin cos tan asin acos atan atan2 sqrt abs and the constant pi.

    Products need a sign; ** and ^ are powers; mathematical minus, times and dot signs, Greek letters, subscripts and
    superscripts are read. Raises ExpressionError where the text is anything else, too long, too deep or not finite.
    """
    with refusing(text):
        return expression_of(tokens_of(text), names)


def expression_of(tokens: Sequence[Token], names: Collection[str]) -> Expression:
    """Expression of the tokens, the last of kind "end"; ExpressionError without the text."""
    return _Parser(tokens, names).whole()


class _Parser:
    """Pratt parser; next to the nodes it keeps each constant's value and each node's power."""

    def __init__(self, tokens: Sequence[Token], names: Collection[str]) -> None:
        self.names = names
        self.tokens = tokens
        self.place = 0
        self.nodes = list[Node]()
        self.constants = list[float | None]()
        self.powers = list[float]()

    @property
    def next(self) -> Token:
        return self.tokens[self.place]

    def take(self, expected: str = "") -> Token:
        """Step over the next token, which is the expected bracket or comma, or "" for any."""
        token = self.next
        if expected and token.text != expected:
            before = self.tokens[self.place - 1].kind if self.place else ""
            raise ExpressionError(
                MISSING[expected] if token.kind == "end" else _leftover(token, before), token.offset
            )
        self.place += token.kind != "end"
        return token

    def whole(self) -> Expression:
        self.operand(0, 0)
        if self.next.kind != "end":
            raise ExpressionError(
                _leftover(self.next, self.tokens[self.place - 1].kind), self.next.offset
            )
        return Expression(tuple(self.nodes))

    def operand(self, binding: int, depth: int) -> int:
        """Read one operand and the operators behind it that bind tighter than `binding`."""
        if depth > DEPTH:
            raise ExpressionError("the formula is nested too deeply", self.next.offset)
        left = self.prefix(depth)
        while self.next.kind == "sign" and BINDING.get(self.next.text, 0) > binding:
            _, sign, offset, _ = self.take()
            right = self.operand(
                BINDING[sign] - (sign == "^"), depth + 1
            )  # powers group from the right
            left = self.node(offset, sign, left, right)
        return left

    def prefix(self, depth: int) -> int:
        kind, text, offset, _ = self.take()
        if kind == "number":
            return self.node(offset, "n", number(text, offset))
        if kind == "name":
            return self.named(text, offset, depth)
        if text == "(":
            inside = self.operand(0, depth + 1)
            self.take(")")
            return inside
        if text in ("-", "+"):
            inside = self.operand(BINDING["neg"], depth + 1)
            return self.node(offset, "neg", inside) if text == "-" else inside
        if kind == "end":
            raise ExpressionError(
                "the formula stops where a number, a name or a bracket is expected", offset
            )
        raise ExpressionError(f"a number, a name or a bracket is expected, got '{text}'", offset)

    def named(self, name: str, offset: int, depth: int) -> int:
        function = name if name in self.names else AS_PRINTED.get(name, name)
        if function in CALLED:
            return self.node(offset, function, *self.arguments(function, depth))
        if name == "pi":
            return self.node(offset, "n", math.pi)
        if name in self.names:
            return self.node(offset, "s", name)
        called = self.next.text == "("
        known = list(CALLED) if called else [*sorted(self.names), "pi"]
        near = nearest(name[:40], known, cutoff=0.5)
        hint = f"did you mean {near}?" if near else f"known: {', '.join(known)}"
        raise ExpressionError(
            f"unknown {'function' if called else 'name'} '{name[:40]}'; {hint}", offset
        )

    def arguments(self, name: str, depth: int) -> list[int]:
        many, opening = CALLED[name], self.next
        if opening.text != "(":
            takes, shown = ("its argument", "x") if many == 1 else ("two arguments", "y, x")
            raise ExpressionError(
                f"{name} takes {takes} in brackets, as in {name}({shown})", opening.offset
            )
        self.take("(")
        found = [self.operand(0, depth + 1)]
        while len(found) < many:
            if self.next.text == ")":
                raise ExpressionError(
                    f"{name} takes {many} arguments, got {len(found)}", self.next.offset
                )
            self.take(",")
            found.append(self.operand(0, depth + 1))
        self.take(")")
        return found

    def node(self, offset: int, operation: str, *arguments: Any) -> int:
        """Append a node; refuse a constant that is not finite and a power that is out of bounds."""
        constant, power = None, 1.0
        if operation == "n":
            constant = arguments[0]
        elif operation != "s":
            places = [int(i) for i in arguments]
            values, power = [self.constants[i] for i in places], max(self.powers[i] for i in places)
            if operation == "^":
                power = self.power(values[1], power, offset)
            if operation == "/" and values[1] is not None and abs(values[1]) < 1 / SIZE:
                raise ExpressionError("division by zero", offset)
            if None not in values:
                constant = _constant(operation, values, offset)
        self.nodes.append((operation, *arguments))
        self.constants.append(constant)
        self.powers.append(power)
        return len(self.nodes) - 1

    def power(self, exponent: float | None, power: float, offset: int) -> float:
        if exponent is None:
            raise ExpressionError("an exponent takes a number, got a formula with names", offset)
        if abs(exponent) * power > EXPONENT:
            raise ExpressionError(
                f"an exponent takes a number between -{EXPONENT} and {EXPONENT}", offset
            )
        return max(1.0, abs(exponent)) * power


def latex_name(name: str) -> str:
    r"""LaTeX of a name: q1 is q_1, alpha1 is \alpha_1, L is L."""
    match = re.fullmatch(r"([A-Za-z]+)_?([0-9]*)", name)
    stem, index = match.groups() if match else (name.replace("_", r"\_"), "")
    if stem in {"theta", "alpha", "beta", "gamma", "phi", "psi", "omega", "pi", "xi"}:
        stem = f"\\{stem}"
    elif len(stem) > 1:
        stem = rf"\mathrm{{{stem}}}"
    subscript = f"_{index}" if len(index) == 1 else f"_{{{index}}}"
    return stem + (subscript if index else "")


def _constant(operation: str, values: list[Any], offset: int) -> float:
    with np.errstate(all="ignore"):
        value = float(_apply(operation, values))
    if math.isnan(value):
        raise ExpressionError("this has no real value", offset)
    if abs(value) > SIZE:
        raise ExpressionError(
            "this is not a finite number" if math.isinf(value) else "this number is too large",
            offset,
        )
    return value


def _apply(operation: str, values: list[Any]) -> Any:
    return (
        UNARY[operation](*values)
        if operation in UNARY
        else BINARY[operation](*map(np.float64, values))
    )


def _leftover(token: Token, before: str) -> str:
    if token.text == ",":
        return (
            "a decimal number takes a point, as in 3.14, got a comma"
            if before == "number"
            else "a comma has no place here"
        )
    if token.text == ")":
        return "this bracket was never opened"
    if token.kind in ("number", "name") or token.text == "(":
        return f"a sign such as * is missing before '{(token.typed or token.text)[:40]}'"
    return f"'{token.text}' has no place here"


def _is_leaf(node: Node) -> bool:
    if len(node) != 2:
        return False
    if node[0] == "n":
        return isinstance(node[1], float) and math.isfinite(node[1])
    return node[0] == "s" and isinstance(node[1], str) and node[1].isidentifier()


def _moved(node: Node, places: Sequence[int]) -> Node:
    """A node whose arguments have gone to other places."""
    if node[0] in ("n", "s"):
        return node
    return (node[0], *(places[int(i)] for i in node[1:]))


def _printed_leaf(node: Node) -> tuple[str, int]:
    if node[0] == "s":
        return str(node[1]), 100
    text = "pi" if node[1] == math.pi else repr(node[1]).removesuffix(".0")
    return text, BINDING["neg"] if text.startswith("-") else 100


def _printed(operation: str, arguments: list[tuple[str, int]]) -> tuple[str, int]:
    if operation in CALLED:
        return f"{operation}({', '.join(text for text, _ in arguments)})", 100
    binding = BINDING[operation]

    def inside(index: int, least: int) -> str:
        text, own = arguments[index]
        return text if own >= least else f"({text})"

    if operation == "neg":
        return f"-{inside(0, binding)}", binding
    if operation == "^":
        return f"{inside(0, binding + 1)}^{inside(1, binding)}", binding
    space = " " if operation in "+-" else ""
    # a sign in front binds tighter than + and *, but reads better in brackets on the right
    left, right = (
        inside(0, binding),
        inside(1, BINDING["^"] if arguments[1][0].startswith("-") else binding + 1),
    )
    return f"{left}{space}{operation}{space}{right}", binding
