"""What programs print along with a formula: `J =` in front, q1(t), 6e-17 in the place of a zero."""

from collections.abc import Collection, Sequence

from ...solutions.tokens import DIGITS_OF_A_NUMBER, LARGEST, ExpressionError, Token
from .shorthands import readings

TIME = "t"  # what sympy's dynamicsymbols depend on
BEHIND = ("(", TIME, ")")


def without_assignment(tokens: Sequence[Token], names: Collection[str]) -> list[Token]:
    """The tokens without a name and "=" in front; `q1 = 0` with a name of the sheet is an equation.

    Raises:
        ExpressionError: there is any other "="; the error does not have the text.
    """
    found = [*tokens]
    if len(found) > 2 and found[1].text == "=" and _is_variable(found[0], frozenset(names)):
        found = found[2:]
    for token in found:
        if token.text == "=":
            raise ExpressionError("'=' has no meaning in a formula", token.offset)
    return found


def _is_variable(token: Token, names: frozenset[str]) -> bool:
    """Whether it is a name that a student gave to the answer."""
    return token.kind == "name" and not readings(token.text, names)


def without_time(tokens: Sequence[Token], names: frozenset[str]) -> list[Token]:
    """Tokens where q1(t) is q1, as joints of sympy's mechanics are printed."""
    if all(token.text != TIME for token in tokens) or TIME in names:
        return [*tokens]
    found = list[Token]()
    place = 0
    while place < len(tokens):
        found.append(tokens[place])
        place += 1
        following = tuple(token.text for token in tokens[place : place + 3])
        if following == BEHIND and _stands_for_a_name(found[-1], names):
            place += 3
    return found


def _stands_for_a_name(token: Token, names: frozenset[str]) -> bool:
    meant = readings(token.text, names)
    return token.kind == "name" and bool(meant) and meant <= names


def without_dust(tokens: Sequence[Token]) -> list[Token]:
    """Tokens with 0 in the place of what rounding leaves of it, such as cos(pi/2) = 6e-17."""
    return [_without_dust(token) for token in tokens]


def _without_dust(token: Token) -> Token:
    if token.kind != "number" or len(token.text) > DIGITS_OF_A_NUMBER:
        return token
    if 0 < float(token.text) < 1 / LARGEST:
        return token._replace(text="0")
    return token
