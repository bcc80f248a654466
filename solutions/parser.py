"""A Pratt parser: from tokens to the nodes of one formula, in post-order."""

import math
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from .errors import nearest
from .nodes import BINDING, CALLED, Node, applied
from .tokens import DEPTH, LARGEST, TOO_DEEP, ExpressionError, Token, number

AS_PRINTED = {"Abs": "abs"}  # functions that sympy prints under another name
NODES = 4000  # numbers, names, functions and signs of a formula, at most
EXPONENT = 20  # powers and powers of powers, at most
SHOWN = 40  # characters of a name in a message
MISSING = {
    "(": "",
    ")": "a closing bracket is missing",
    ",": "a comma and another argument are missing",
}


def nodes_of(tokens: Sequence[Token], names: Collection[str]) -> tuple[Node, ...]:
    """Nodes of the formula that the tokens are, the last token of kind "end".

    Raises ExpressionError without the text.
    """
    return _Parser(tokens, names).whole()


class _Parser:
    """Next to the nodes it keeps each constant's value and each node's power."""

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
            if token.kind == "end":
                raise ExpressionError(MISSING[expected], token.offset)
            raise self.leftover()

        if token.kind != "end":
            self.place += 1
        return token

    def whole(self) -> tuple[Node, ...]:
        self.operand(0, 0)
        if self.next.kind != "end":
            raise self.leftover()
        return tuple(self.nodes)

    def operand(self, binding: int, depth: int) -> int:
        """Read one operand and the operators behind it that bind tighter than `binding`."""
        if depth > DEPTH:
            raise ExpressionError(TOO_DEEP, self.next.offset)

        left = self.prefix(depth)
        while self.next.kind == "sign" and BINDING.get(self.next.text, 0) > binding:
            _, sign, offset, _ = self.take()
            least = BINDING[sign]
            if sign == "^":  # powers group from the right
                least -= 1
            right = self.operand(least, depth + 1)
            left = self.operation(offset, sign, left, right)
        return left

    def prefix(self, depth: int) -> int:
        """Read a number, a name, a call, a bracket, or a sign and its operand."""
        kind, text, offset, _ = self.take()
        if kind == "number":
            return self.number(number(text, offset))
        if kind == "name":
            return self.named(text, offset, depth)
        if text == "(":
            inside = self.operand(0, depth + 1)
            self.take(")")
            return inside
        if text == "-":
            inside = self.operand(BINDING["neg"], depth + 1)
            return self.operation(offset, "neg", inside)
        if text == "+":
            return self.operand(BINDING["neg"], depth + 1)
        if kind == "end":
            raise ExpressionError(
                "the formula stops where a number, a name or a bracket is expected", offset
            )
        raise ExpressionError(f"a number, a name or a bracket is expected, got '{text}'", offset)

    def named(self, name: str, offset: int, depth: int) -> int:
        """Read what stands behind a function's name; a constant or a name stands alone."""
        function = name
        if name not in self.names:
            function = AS_PRINTED.get(name, name)

        if function in CALLED:
            return self.operation(offset, function, *self.arguments(function, depth))
        if name == "pi":
            return self.number(math.pi)
        if name in self.names:
            return self.append(("s", name), None, 1.0)
        raise self.unknown(name, offset)

    def arguments(self, name: str, depth: int) -> list[int]:
        """Read the arguments of a function, in brackets and with commas between them."""
        many = CALLED[name]
        opening = self.next
        if opening.text != "(":
            takes = f"its argument in brackets, as in {name}(x)"
            if many == 2:
                takes = f"two arguments in brackets, as in {name}(y, x)"
            raise ExpressionError(f"{name} takes {takes}", opening.offset)

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

    def number(self, value: float) -> int:
        return self.append(("n", value), value, 1.0)

    def operation(self, offset: int, operation: str, *arguments: int) -> int:
        """Append an operation; a constant must be finite, a power within its bounds."""
        values = [self.constants[i] for i in arguments]
        power = max(self.powers[i] for i in arguments)
        if operation == "^":
            power = _power(values[1], power, offset)
        if operation == "/" and values[1] is not None and abs(values[1]) < 1 / LARGEST:
            raise ExpressionError("division by zero", offset)

        constant = None
        if None not in values:
            constant = _constant(operation, values, offset)
        return self.append((operation, *arguments), constant, power)

    def append(self, node: Node, constant: float | None, power: float) -> int:
        """Append a node; its place."""
        if len(self.nodes) == NODES:
            raise ExpressionError(
                f"a formula takes up to {NODES} numbers, names and signs", self.next.offset
            )
        self.nodes.append(node)
        self.constants.append(constant)
        self.powers.append(power)
        return len(self.nodes) - 1

    def leftover(self) -> ExpressionError:
        """What is wrong with a next token that has no place there."""
        token = self.next
        after_number = self.place > 0 and self.tokens[self.place - 1].kind == "number"
        if token.text == "," and after_number:
            message = "a decimal number takes a point, as in 3.14, got a comma"
        elif token.text == ",":
            message = "a comma has no place here"
        elif token.text == ")":
            message = "this bracket was never opened"
        elif token.kind in ("number", "name") or token.text == "(":
            typed = token.typed or token.text
            message = f"a sign such as * is missing before '{typed[:SHOWN]}'"
        else:
            message = f"'{token.text}' has no place here"
        return ExpressionError(message, token.offset)

    def unknown(self, name: str, offset: int) -> ExpressionError:
        """What is wrong with a name that nobody knows, and which was perhaps meant."""
        what = "name"
        known = [*sorted(self.names), "pi"]
        if self.next.text == "(":
            what = "function"
            known = list(CALLED)

        hint = f"known: {', '.join(known)}"
        near = nearest(name[:SHOWN], known, cutoff=0.5)
        if near:
            hint = f"did you mean {near}?"
        return ExpressionError(f"unknown {what} '{name[:SHOWN]}'; {hint}", offset)


def _power(exponent: float | None, power: float, offset: int) -> float:
    """Power of a node whose base has a power, so that nothing is expanded without end."""
    if exponent is None:
        raise ExpressionError("an exponent takes a number, got a formula with names", offset)
    if abs(exponent) * power > EXPONENT:
        raise ExpressionError(
            f"an exponent takes a number between -{EXPONENT} and {EXPONENT}", offset
        )
    return max(1.0, abs(exponent)) * power


def _constant(operation: str, values: Sequence[Any], offset: int) -> float:
    with np.errstate(all="ignore"):
        value = float(applied(operation, values))
    if math.isnan(value):
        raise ExpressionError("this has no real value", offset)
    if math.isinf(value):
        raise ExpressionError("this is not a finite number", offset)
    if abs(value) > LARGEST:
        raise ExpressionError("this number is too large", offset)
    return value
