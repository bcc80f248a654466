"""What a typed formula is made of: numbers, names and signs, with their places."""

import math
import re
from typing import NamedTuple

from .errors import KinegradeError

LENGTH, SIZE = 400, 1e12
GREEK = {"θ": "theta", "ϑ": "theta", "α": "alpha", "π": "pi"}
SIGNS = {"−": "-", "–": "-", "×": "*", "·": "*", "⋅": "*", "∙": "*", "∗": "*", "÷": "/", "**": "^"}
SUBSCRIPTS, SUPERSCRIPTS = "₀₁₂₃₄₅₆₇₈₉", "⁰¹²³⁴⁵⁶⁷⁸⁹"
TRANSLATED = str.maketrans(GREEK | dict(zip(SUBSCRIPTS + SUPERSCRIPTS, "0123456789" * 2, strict=True)))
LETTER = f"A-Za-z_{''.join(GREEK)}"
TOKEN = re.compile(
    rf"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    rf"|(?P<name>[{LETTER}][{LETTER}0-9{SUBSCRIPTS}]*)"
    rf"|(?P<power>[{SUPERSCRIPTS}]+)"
    rf"|(?P<sign>\*\*|[-+*/^(),{''.join(s for s in SIGNS if len(s) == 1)}])"
    rf"|(?P<end>\Z)"
)


class ExpressionError(KinegradeError):
    """A formula that cannot be read: `message` says why, `offset` where in the typed text."""

    def __init__(self, message: str, offset: int = 0, text: str = "") -> None:
        super().__init__(message)
        self.message, self.offset, self.text = message, offset, text

    def __reduce__(self) -> tuple[type["ExpressionError"], tuple[str, int, str]]:
        return ExpressionError, (self.message, self.offset, self.text)

    @property
    def caret(self) -> str:
        """Two lines: the typed text around the place, and a caret under it."""
        start = max(0, self.offset - 40)
        shown = "".join(c if c.isprintable() else " " for c in self.text[start : start + 70])
        return f"{shown}\n{' ' * (self.offset - start)}^"


class Token(NamedTuple):
    kind: str  # number, name, sign or end
    text: str
    offset: int


def tokens_of(text: str) -> list[Token]:
    """Tokens of a formula, the last of kind "end"; ExpressionError where it is too long or has another character."""
    if len(text) > LENGTH:
        raise ExpressionError(f"a formula takes up to {LENGTH} characters, got {len(text)}", LENGTH)
    tokens, place = list[Token](), 0
    while not tokens or tokens[-1].kind != "end":
        place += len(text[place:]) - len(text[place:].lstrip())
        match = TOKEN.match(text, place)
        if match is None or match.lastgroup is None:
            raise ExpressionError(f"{text[place]!r} has no meaning in a formula", place)
        kind, found = match.lastgroup, match[0]
        if kind == "power":
            tokens += [Token("sign", "^", place), Token("number", found.translate(TRANSLATED), place)]
        else:
            plain = SIGNS.get(found, found) if kind == "sign" else found.translate(TRANSLATED)
            tokens.append(Token(kind, plain, place))
        place = match.end()
    return tokens


def number(text: str, offset: int) -> float:
    """Value of a number token; ExpressionError beyond 1e12 and, unless it is 0, below 1e-12."""
    value = float(text) if len(text) <= 40 else math.inf
    if value > SIZE or (value < 1 / SIZE and re.search("[1-9]", re.split("[eE]", text)[0])):
        raise ExpressionError(f"a number takes a size between {1 / SIZE:g} and {SIZE:g}, or 0", offset)
    return value
