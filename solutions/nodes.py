"""Nodes of formulas: which there are, what each takes and computes, and how it is printed."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

Node = tuple[str, *tuple[Any, ...]]  # ("n", 2.0) | ("s", "q1") | ("sin", i) | ("*", i, j)
Printed = tuple[str, int]  # text, and how tightly its outermost operation binds

FUNCTIONS: dict[str, Callable[[Any], Any]] = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan,
    "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "sqrt": np.sqrt, "abs": np.abs,
}  # fmt: skip
UNARY = FUNCTIONS | {"neg": np.negative}
BINARY: dict[str, Callable[[Any, Any], Any]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": np.power,
    "atan2": np.arctan2,
}  # fmt: skip
OPERATIONS: dict[str, Callable[..., Any]] = {**UNARY, **BINARY}
CALLED = {**dict.fromkeys(FUNCTIONS, 1), "atan2": 2}  # functions and how many arguments they take
BINDING = {"+": 10, "-": 10, "*": 20, "/": 20, "neg": 30, "^": 40}
WHOLE = 100  # how tightly a name, a number or a call binds: it never takes brackets


def arguments_of(node: Node) -> list[Any] | None:
    """Places of a node's arguments, none of a number or a name; None for what is no node."""
    if _is_leaf(node):
        return []

    kind, *arguments = node or ("",)
    if kind in UNARY:
        takes = 1
    elif kind in BINARY:
        takes = 2
    else:
        return None

    if len(arguments) != takes:
        return None
    return arguments


def _is_leaf(node: Node) -> bool:
    if len(node) != 2:
        return False
    kind, content = node
    if kind == "n":
        return isinstance(content, float) and math.isfinite(content)
    return kind == "s" and isinstance(content, str) and content.isidentifier()


def moved(node: Node, places: Sequence[int]) -> Node:
    """A node whose arguments have gone to other places."""
    kind, *arguments = node
    if kind in ("n", "s"):
        return node
    return (kind, *(places[int(i)] for i in arguments))


def applied(operation: str, values: Sequence[Any]) -> Any:
    """Value of an operation, as numpy has it."""
    return OPERATIONS[operation](*values)


def printed_leaf(kind: str, content: Any) -> Printed:
    """A number or a name as it is typed."""
    if kind == "s":
        return str(content), WHOLE
    if content == math.pi:
        return "pi", WHOLE

    text = repr(content).removesuffix(".0")
    if text.startswith("-"):
        return text, BINDING["neg"]
    return text, WHOLE


def printed_operation(operation: str, arguments: list[Printed]) -> Printed:
    """An operation on printed arguments, with the brackets that reading it back takes."""
    if operation in CALLED:
        inside = ", ".join(text for text, _ in arguments)
        return f"{operation}({inside})", WHOLE

    binding = BINDING[operation]
    if operation == "neg":
        return f"-{_bracketed(arguments[0], binding)}", binding

    left, right = arguments
    if operation == "^":  # powers group from the right
        return f"{_bracketed(left, binding + 1)}^{_bracketed(right, binding)}", binding

    least = binding + 1
    if right[0].startswith("-"):
        # a sign in front binds tighter than + and *, but reads better in brackets on the right
        least = BINDING["^"]

    sign = operation
    if operation in "+-":
        sign = f" {operation} "
    return f"{_bracketed(left, binding)}{sign}{_bracketed(right, least)}", binding


def _bracketed(part: Printed, least: int) -> str:
    """Text of a part, in brackets unless it binds at least that tightly."""
    text, binding = part
    if binding >= least:
        return text
    return f"({text})"
