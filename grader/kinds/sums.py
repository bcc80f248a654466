"""A sum of squares is zero where each square is: the equations that one equation holds."""

from collections.abc import Mapping, Sequence
from typing import Any

from ...solutions.expression import Expression, Node

NEVER_NEGATIVE = ("abs", "sqrt")


def equations_within(expression: Expression, numbers: Mapping[str, float]) -> list[Expression]:
    """Expressions that are all zero where this one is: terms of a sum of which none is below zero, or none above.

    Roots, powers, absolute values and constant factors are taken off; `numbers` are the values of names that have one.
    """
    nodes, signs = expression.nodes, list[int]()
    for node in nodes:
        signs.append(_sign(node, nodes, signs, numbers))

    def parts(place: int) -> list[int]:
        kind, inside = nodes[place][0], _arguments(nodes[place])
        if kind in ("+", "-") and signs[place]:
            return [part for term in inside for part in parts(term)]
        if kind in ("neg", *NEVER_NEGATIVE) or (kind == "^" and _number(nodes[inside[1]]) > 0):
            return parts(inside[0])
        if kind in ("*", "/") and _is_factor(_whole(nodes, inside[1]), numbers):
            return parts(inside[0])
        if kind == "*" and _is_factor(_whole(nodes, inside[0]), numbers):
            return parts(inside[1])
        return [place]

    return [_whole(nodes, place) for place in parts(len(nodes) - 1)]


def _sign(
    node: Node, nodes: Sequence[Node], signs: Sequence[int], numbers: Mapping[str, float]
) -> int:
    """1 for what is nowhere below zero, -1 for what is nowhere above, 0 for what may be both."""
    kind, inside = node[0], _arguments(node)
    if not inside:
        return _sign_of_leaf(node, numbers)
    first, last = signs[inside[0]], signs[inside[-1]]
    if kind in NEVER_NEGATIVE or (kind == "^" and _number(nodes[inside[1]]) % 2 == 0):
        return 1
    if kind in ("*", "/"):
        return first * last
    if kind == "+":
        return first if first == last else 0
    if kind == "-":
        return first if first == -last else 0
    return -first if kind == "neg" else 0


def _sign_of_leaf(node: Node, numbers: Mapping[str, float]) -> int:
    if node[0] == "s" and node[1] not in numbers:
        return 0
    value = node[1] if node[0] == "n" else numbers[str(node[1])]
    return 1 if float(value) >= 0 else -1


def _arguments(node: Node) -> list[int]:
    """Places of a node's arguments; a number or a name has none."""
    return [] if node[0] in ("n", "s") else [int(i) for i in node[1:]]


def _is_factor(expression: Expression, numbers: Mapping[str, float]) -> bool:
    """Whether it is a constant that is not zero."""
    return expression.names <= set(numbers) and expression.at(numbers) != 0


def _number(node: Node) -> Any:
    """The number of a leaf; of everything else one that is neither positive nor even."""
    return node[1] if node[0] == "n" else -0.5


def _whole(nodes: Sequence[Node], place: int) -> Expression:
    """The expression that ends at a node."""
    start = place
    while inside := _arguments(nodes[start]):
        start = inside[0]  # what the first argument starts with stands first
    moved = list[Node]()
    for node in nodes[start : place + 1]:
        inside = _arguments(node)
        moved.append((node[0], *(i - start for i in inside)) if inside else node)
    return Expression(tuple(moved))
