"""Angles in degrees: 90° and 90 deg are a quarter turn."""

import math
from collections.abc import Collection, Sequence

from ...solutions.tokens import DIGITS_OF_A_NUMBER, Token

SIGN = "°"
WORDS = ("deg", "degree", "degrees")


def in_radians(tokens: Sequence[Token], names: Collection[str]) -> list[Token]:
    """Tokens with radians in the place of a number and the sign or the word for degrees."""
    found = list[Token]()
    for token in tokens:
        if found and _is_degree(token, names) and _is_number(found[-1]):
            number = found.pop()
            found.append(number._replace(text=repr(math.radians(float(number.text)))))
        else:
            found.append(token)
    return found


def _is_degree(token: Token, names: Collection[str]) -> bool:
    if token.kind == "name":
        return token.text.lower() in WORDS and token.text not in names
    return token.text == SIGN


def _is_number(token: Token) -> bool:
    return token.kind == "number" and len(token.text) <= DIGITS_OF_A_NUMBER
