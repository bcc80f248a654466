"""A sum of squares is zero where each square is: the equations that one equation holds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...solutions.expression import Expression, Node

NEVER_NEGATIVE = ("abs", "sqrt")


def equations_within(expression: Expression, numbers: Mapping[str, float]) -> list[Expression]:
    """Expressions that are all zero where this one is.

    They are the terms of a sum of which none is below zero, or none above. Roots, powers, absolute
    values and constant factors are taken off; `numbers` are the values of names that have one.
    """
    signs: list[int] = []
    for node in expression.nodes:
        signs.append(_sign(node, expression.nodes, signs, numbers))
    tree = _SignedTree(expression.nodes, signs, numbers)
    root = len(expression.nodes) - 1
    return [_whole(expression.nodes, place) for place in _zero_together(tree, root)]


@dataclass(frozen=True)
class _SignedTree:
    """The nodes of an expression, the sign of each, and the values of names that have one."""

    nodes: Sequence[Node]
    signs: Sequence[int]
    numbers: Mapping[str, float]


def _zero_together(tree: _SignedTree, place: int) -> list[int]:
    """Places of nodes that are all zero where the node at `place` is."""
    found: list[int] = []
    waiting = [place]
    while waiting:  # no recursion: a sum of a thousand terms is a thousand sums in one another
        at = waiting.pop()
        if tree.nodes[at][0] in ("+", "-") and tree.signs[at]:
            waiting += reversed(_arguments(tree.nodes[at]))
            continue
        inner = _zero_with(tree, at)
        if inner is None:
            found.append(at)
        else:
            waiting.append(inner)
    return found


def _zero_with(tree: _SignedTree, place: int) -> int | None:
    """The argument that is zero where and only where the node is; None where there is no such."""
    node = tree.nodes[place]
    inside = _arguments(node)
    if node[0] in ("neg", *NEVER_NEGATIVE):
        return inside[0]
    if node[0] == "^" and _number(tree.nodes[inside[1]]) > 0:
        return inside[0]
    if node[0] in ("*", "/") and _is_factor(_whole(tree.nodes, inside[1]), tree.numbers):
        return inside[0]
    if node[0] == "*" and _is_factor(_whole(tree.nodes, inside[0]), tree.numbers):
        return inside[1]
    return None


def _sign(
    node: Node, nodes: Sequence[Node], signs: Sequence[int], numbers: Mapping[str, float]
) -> int:
    """1 for what is nowhere below zero, -1 for what is nowhere above, 0 for what may be both.

    `signs` are those of the nodes before it, which have its arguments.
    """
    kind, inside = node[0], _arguments(node)
    if not inside:
        return _sign_of_leaf(node, numbers)
    first, last = signs[inside[0]], signs[inside[-1]]
    if kind == "neg":
        return -first
    if kind in NEVER_NEGATIVE:
        return 1
    if kind == "^":
        return int(_number(nodes[inside[1]]) % 2 == 0)
    if kind in ("*", "/"):
        return first * last
    if kind == "-":
        kind, last = "+", -last
    return first if kind == "+" and first == last else 0


def _sign_of_leaf(node: Node, numbers: Mapping[str, float]) -> int:
    if node[0] == "n":
        value = float(node[1])
    elif node[1] in numbers:
        value = numbers[str(node[1])]
    else:
        return 0
    return 1 if value >= 0 else -1


def _arguments(node: Node) -> list[int]:
    """Places of a node's arguments; a number or a name has none."""
    if node[0] in ("n", "s"):
        return []
    return [int(place) for place in node[1:]]


def _is_factor(expression: Expression, numbers: Mapping[str, float]) -> bool:
    """Whether it is a constant that is not zero."""
    return expression.names <= set(numbers) and expression.at(numbers) != 0


def _number(node: Node) -> float:
    """The number of a leaf; of everything else one that is neither positive nor even."""
    return float(node[1]) if node[0] == "n" else -0.5


def _whole(nodes: Sequence[Node], place: int) -> Expression:
    """The expression that ends at a node."""
    start = place
    while _arguments(nodes[start]):
        start = _arguments(nodes[start])[0]  # what the first argument starts with stands first
    moved: list[Node] = []
    for node in nodes[start : place + 1]:
        inside = _arguments(node)
        moved.append((node[0], *(i - start for i in inside)) if inside else node)
    return Expression(tuple(moved))
