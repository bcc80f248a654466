"""Rounded angles: 3.1416 is pi where an angle is meant, as in q2 = 3.1416 or sin(q2 - 1.571)."""

import math
from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction

from ...solutions.expression import Expression, Node, parse
from ...solutions.table import JOINT

PARTS = 12  # of pi, of which angles are multiples: 15 degrees
LEAST_DECIMALS = 3
CUT_OFF = 4  # from so many decimals on they may be cut off, too: 3.1415
TRIGONOMETRIC = ("sin", "cos", "tan")
INVERSE = ("asin", "acos", "atan", "atan2")
SAME_KIND = ("neg", "abs")


def exact_angle(number: float) -> str:
    """The multiple of pi/12 that a number is to its own decimals, such as "3*pi/4", or ""."""
    whole, point, digits = repr(number).partition(".")
    if not point or not (whole + digits).isdigit() or len(digits) < LEAST_DECIMALS:
        return ""
    multiple = Fraction(round(number * PARTS / math.pi), PARTS)
    left = float(multiple) * math.pi - number
    unit = 10.0 ** -len(digits)
    rounded = abs(left) <= 0.5 * unit + 1e-15 * number
    cut_off = len(digits) >= CUT_OFF and 0 <= left < unit
    return _written(multiple) if rounded or cut_off else ""


def _written(multiple: Fraction) -> str:
    if not multiple:
        return ""
    factor = "" if multiple.numerator == 1 else f"{multiple.numerator}*"
    divisor = "" if multiple.denominator == 1 else f"/{multiple.denominator}"
    return f"{factor}pi{divisor}"


def with_exact_angles(
    expression: Expression, angles: Collection[str], given: Collection[float] = ()
) -> Expression:
    """The expression with exact multiples of pi in the place of their roundings.

    A number is an angle beside one: in a sum that is to be zero, where joints that are `angles` are
    its only other terms, or in one inside sin, cos or tan. The `given` numbers stay as they are.
    """
    nodes = list(expression.nodes)
    meant: dict[str, Expression] = {}
    for place in _beside_angles(nodes, angles):
        number = float(nodes[place][1])
        exact = exact_angle(number)
        if exact and number not in given:
            name = f"exact{place}"
            nodes[place] = ("s", name)
            meant[name] = parse(exact, ())
    return Expression(tuple(nodes)).put(meant) if meant else expression


def rounded_angles(expression: Expression, angles: Collection[str]) -> dict[str, str]:
    """Numbers of the expression that are roundings of angles, and what they round."""
    found: dict[str, str] = {}
    for place in _beside_angles(expression.nodes, angles):
        number = float(expression.nodes[place][1])
        exact = exact_angle(number)
        if exact and parse(exact, ()).at({}) != number:
            found[repr(number)] = exact
    return found


def _beside_angles(nodes: Sequence[Node], angles: Collection[str]) -> Iterator[int]:
    """Places of numbers that are terms of sums of angles."""
    kinds = _kinds(nodes, angles)
    if kinds[-1] == "angle":
        yield from _terms(nodes, kinds, len(nodes) - 1)

    joints = {str(node[1]) for node in nodes if node[0] == "s" and JOINT.fullmatch(str(node[1]))}
    kinds = _kinds(nodes, joints)
    for kind, *inside in nodes:
        if kind in TRIGONOMETRIC and kinds[inside[0]] == "angle":
            yield from _terms(nodes, kinds, inside[0])


def _kinds(nodes: Sequence[Node], angles: Collection[str]) -> list[str]:
    """What each node is: "constant", "angle" for a sum of multiples of angles, or "other"."""
    kinds = list[str]()
    for node in nodes:
        if node[0] == "n":
            kinds.append("constant")
        elif node[0] == "s":
            kinds.append("angle" if node[1] in angles else "other")
        else:
            kinds.append(_kind(node[0], [kinds[place] for place in node[1:]]))
    return kinds


def _kind(operation: str, inside: list[str]) -> str:
    """What an operation comes to on arguments of these kinds."""
    found = set(inside)
    if found == {"constant"}:
        return "constant"
    if operation in INVERSE:
        return "angle"
    if operation in SAME_KIND:
        return inside[0]
    if operation in ("+", "-") and "other" not in found:
        return "angle"
    is_multiple = operation == "*" and found == {"angle", "constant"}
    if is_multiple or (operation == "/" and inside == ["angle", "constant"]):
        return "angle"
    return "other"


def _terms(nodes: Sequence[Node], kinds: Sequence[str], place: int) -> Iterator[int]:
    """Places of the numbers in a sum and in its constant terms; factors of angles are none."""
    waiting = [place]
    while waiting:
        at = waiting.pop()
        operation, *inside = nodes[at]
        is_term = operation in ("*", "/") and kinds[at] == "constant"
        if operation == "n":
            yield at
        elif is_term or operation in ("+", "-", *SAME_KIND):
            waiting += inside
