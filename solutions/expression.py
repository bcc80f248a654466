"""One type for formulas: robot rows, course files, typed answers."""

import math
import operator
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .nodes import (
    CALLED,
    OPERATIONS,
    Node,
    Printed,
    arguments_of,
    moved,
    printed_leaf,
    printed_operation,
)
from .parser import nodes_of
from .tokens import ExpressionError, Token, refusing, tokens_of

__all__ = [
    "CALLED",
    "Expression",
    "ExpressionError",
    "Node",
    "expression_of",
    "latex_name",
    "parse",
]

NAME = "name"
PLAIN = {"+": "add", "-": "sub", "*": "mul", "/": "truediv", "^": "pow", "neg": "neg", "abs": "abs"}
GREEK = frozenset({"theta", "alpha", "beta", "gamma", "phi", "psi", "omega", "pi", "xi"})


@dataclass(frozen=True)
class Expression:
    """A formula as nodes in post-order; the last is the whole. `parse` makes it.

    Raises ExpressionError where the nodes are not one tree.
    """

    nodes: tuple[Node, ...]

    def __post_init__(self) -> None:
        unused = list[int]()  # places that no later node has taken as its argument
        for i, node in enumerate(self.nodes):
            arguments = arguments_of(node)
            start = len(unused) - len(arguments or ())
            if arguments is None or unused[start:] != arguments:
                raise ExpressionError(
                    f"nodes takes a tree in post-order, got {node!r} at place {i}"
                )
            unused[start:] = [i]
        if len(unused) != 1:
            raise ExpressionError(f"nodes takes one tree in post-order, got {len(unused)}")

    @cached_property
    def names(self) -> frozenset[str]:
        """Names that occur."""
        return frozenset(str(node[1]) for node in self.nodes if node[0] == "s")

    def at(self, values: Mapping[str, ArrayLike]) -> float | NDArray[np.float64]:
        """Value where each name has its value.

        Arrays broadcast; a result without any array is a float. Outside a function's domain the
        value is NaN or infinite, as numpy has it. Raises ExpressionError if a name has no value.
        """
        if not self.names <= values.keys():
            missing = ", ".join(sorted(self.names - values.keys()))
            given = ", ".join(sorted(values)) or "none"
            raise ExpressionError(f"values takes {missing}, got only {given}")

        results = list[Any]()
        with np.errstate(all="ignore"):
            for function, first, second in self._steps:
                if function is None:
                    results.append(first)
                elif function is NAME:
                    results.append(np.asarray(values[first], dtype=np.float64))
                elif second is None:
                    results.append(function(results[first]))
                else:
                    results.append(function(results[first], results[second]))

        value = np.asarray(results[-1], dtype=np.float64)
        if value.ndim == 0:
            return float(value)
        return value

    @cached_property
    def _steps(self) -> tuple[tuple[Any, Any, Any], ...]:
        """What `at` does: a function and one or two places, or None and a number, or a name."""
        steps: dict[Node, int] = {}  # what occurs twice is computed once
        places = list[int]()
        for node in self.nodes:
            step = moved(node, places)
            if node[0] == "n":
                step = (*node, len(places))  # by its place, for 0.0 and -0.0 are equal
            places.append(steps.setdefault(step, len(steps)))
        return tuple(map(_step, steps))

    def sympy(self) -> Any:
        """The sympy expression: names become Symbol(name, real=True), decimals exact rationals."""
        sympy: Any = import_module("sympy")
        results = list[Any]()
        for kind, *content in self.nodes:
            if kind == "s":
                results.append(sympy.Symbol(content[0], real=True))
            elif kind == "n" and content[0] == math.pi:
                results.append(sympy.pi)
            elif kind == "n":
                results.append(sympy.Rational(repr(content[0])))
            else:
                function = _sympy_function(sympy, kind)
                results.append(function(*(results[i] for i in content)))
        return results[-1]

    def put(self, values: Mapping[str, "Expression"]) -> "Expression":
        """The formula with other formulas in place of names; a name without one stays."""
        nodes = list[Node]()
        places = list[int]()  # of the results of the formula's own nodes
        for node in self.nodes:
            if node[0] == "s" and node[1] in values:
                inside = values[node[1]].nodes
                inside_places = range(len(nodes), len(nodes) + len(inside))
                nodes += [moved(inner, inside_places) for inner in inside]
            else:
                nodes.append(moved(node, places))
            places.append(len(nodes) - 1)
        return Expression(tuple(nodes))

    def __str__(self) -> str:
        """Text that parses back to the same value."""
        printed = list[Printed]()
        for node in self.nodes:
            if node[0] in ("n", "s"):
                printed.append(printed_leaf(node[0], node[1]))
            else:
                printed.append(printed_operation(node[0], [printed[i] for i in node[1:]]))
        return printed[-1][0]


def _step(node: Node) -> tuple[Any, Any, Any]:
    kind, first, *second = node
    function: Any = OPERATIONS.get(kind)
    if kind == "s":
        function = NAME
    return function, first, second[0] if second else None


def _sympy_function(sympy: Any, operation: str) -> Any:
    if operation in PLAIN:
        return getattr(operator, PLAIN[operation])
    return getattr(sympy, operation)


def parse(text: str, names: Collection[str]) -> Expression:
    """Expression of `text` in `names`, the functions of `CALLED` and the constant pi.

    The functions are sin cos tan asin acos atan atan2 sqrt abs. Products need a sign; ** and ^ are
    powers; mathematical minus, times and dot signs, Greek letters, subscripts and superscripts are
    read. Raises ExpressionError where the text is anything else, too long, too deep or not finite.
    """
    with refusing(text) as seen:
        return expression_of(tokens_of(seen), names)


def expression_of(tokens: Sequence[Token], names: Collection[str]) -> Expression:
    """Expression of the tokens, the last of kind "end"; ExpressionError without the text."""
    return Expression(nodes_of(tokens, names))


def latex_name(name: str) -> str:
    r"""LaTeX of a name: q1 is q_1, alpha1 is \alpha_1, L is L."""
    stem, index = name.replace("_", r"\_"), ""
    match = re.fullmatch(r"([A-Za-z]+)_?([0-9]*)", name)
    if match:
        stem, index = match.groups()

    if stem in GREEK:
        stem = f"\\{stem}"
    elif len(stem) > 1:
        stem = rf"\mathrm{{{stem}}}"

    if not index:
        return stem
    if len(index) == 1:
        return f"{stem}_{index}"
    return f"{stem}_{{{index}}}"
