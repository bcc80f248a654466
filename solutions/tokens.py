"""What a typed formula is made of: numbers, names and signs, with their places."""

import math
import re
from collections.abc import Collection, Generator, Sequence
from contextlib import contextmanager
from typing import NamedTuple

from .errors import KinegradeError

LENGTH = 20_000  # characters that are looked at; the work of a formula is limited by its nodes
NAME = 400  # characters of a name, at most
DEPTH = 40  # brackets and operators inside one another, at most
DIGITS_OF_A_NUMBER = 40  # and of one number in it
LARGEST = 1e12  # of a number, at most; 1 / LARGEST is the least
GREEK = {
    "θ": "theta", "ϑ": "theta", "α": "alpha", "β": "beta", "γ": "gamma",
    "φ": "phi", "ϕ": "phi", "ψ": "psi", "π": "pi",
}  # fmt: skip
SIGNS = {
    "−": "-", "–": "-",
    "×": "*", "·": "*", "⋅": "*", "∙": "*", "∗": "*", "÷": "/", "**": "^",
    "==": "=", "&&": "&", "∧": "&", "º": "°", "˚": "°",
}  # fmt: skip
# What is copied along from web pages and is not seen: zero-width spaces and joiners, marks of the
# direction of writing, the sign between a function and its argument, soft hyphens.
UNSEEN = dict.fromkeys(
    [
        *(0xAD, 0x2060, 0x2061, 0xFEFF),
        *range(0x200B, 0x2010),
        *range(0x202A, 0x202D),
        *range(0x2066, 0x206A),
    ]
)
SUBSCRIPTS = "₀₁₂₃₄₅₆₇₈₉"
SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
DIGITS = dict(zip(SUBSCRIPTS + SUPERSCRIPTS, "0123456789" * 2, strict=True))
TRANSLATED = str.maketrans({**GREEK, **DIGITS, "{": None, "}": None, "\\": None})
FORMULA = frozenset("-+*/^(),")
PAIRS = {"(": ")", "[": "]"}
CLOSING = frozenset(PAIRS.values())
TOO_DEEP = "the formula is nested too deeply"
LETTER = f"A-Za-z_{''.join(GREEK)}"
WORD = rf"[{LETTER}][{LETTER}0-9{SUBSCRIPTS}]*(?:(?<=_)\{{[0-9]+\}})?"  # s_{12}, too
TOKEN = re.compile(
    rf"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    rf"|(?P<name>\\?{WORD}(?:\.{WORD})*)"  # \theta_1 of LaTeX, too
    rf"|(?P<power>⁻?[{SUPERSCRIPTS}]+)"
    r"|(?P<line>\n)"
    r"|(?P<space>[^\S\n]+)"
    r"|(?P<sign>\*\*|==|&&|.)"
    r"|(?P<end>\Z)"
)
POWER = re.compile(rf"\s*(?:\^|\*\*|⁻|[{SUPERSCRIPTS}])")


class ExpressionError(KinegradeError):
    """A formula that cannot be read: `message` says why, `offset` where in the typed text."""

    def __init__(self, message: str, offset: int = 0, text: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.offset = offset
        self.text = text

    def __reduce__(self) -> tuple[type["ExpressionError"], tuple[str, int, str]]:
        return ExpressionError, (self.message, self.offset, self.text)

    @property
    def caret(self) -> str:
        """Two lines: the typed text around the place, and a caret under it."""
        start = max(0, self.offset - 40)
        shown = self.text[start : start + 70]
        for character in set(shown):
            if not character.isprintable():
                shown = shown.replace(character, " ")

        return f"{shown}\n{' ' * (self.offset - start)}^"


class Token(NamedTuple):
    """A piece of the text; `kind` is "number", "name", "sign" or "end"."""

    kind: str
    text: str
    offset: int
    typed: str = ""  # a name as it stands there: θ₁ for theta1


@contextmanager
def refusing(text: object, what: str = "a formula") -> Generator[str]:
    """The typed text as it is seen, which an ExpressionError raised inside takes along.

    Raises ExpressionError where it is no text.
    """
    if not isinstance(text, str):  # what a notebook held may be anything
        raise ExpressionError(f"{what} takes text, got {type(text).__name__}")
    seen = visible(text)
    try:
        yield seen
    except ExpressionError as error:
        error.text = seen
        raise


def visible(text: str) -> str:
    """The text without characters that are not seen, such as zero-width spaces."""
    return text.translate(UNSEEN)


def tokens_of(text: str, signs: frozenset[str] = FORMULA) -> list[Token]:
    """Tokens of a text, the last of kind "end"; line ends are tokens where they are among `signs`.

    Raises ExpressionError where the text is too long or has a character without meaning.
    """
    if len(text) > LENGTH:
        raise ExpressionError(f"a formula takes up to {LENGTH} characters, got {len(text)}", LENGTH)

    tokens = list[Token]()
    for match in TOKEN.finditer(text):  # any character is a token: what has no meaning is a sign
        kind, found, place = str(match.lastgroup), match[0], match.start()
        if kind == "power":
            tokens += _power(text, match)
        elif kind == "sign":
            tokens.append(_sign(found, place, signs))
        elif kind == "line" and "\n" in signs:
            tokens.append(Token("sign", "\n", place))
        elif kind == "name" and len(found) > NAME:
            raise ExpressionError(f"a name takes up to {NAME} characters", place)
        elif kind == "number" and text[match.end() : match.end() + 1] == "_":
            raise ExpressionError("a number takes no '_' between its digits", match.end())
        elif kind in ("number", "name", "end"):
            tokens.append(Token(kind, found.translate(TRANSLATED), place, found))
    return tokens


def _sign(found: str, place: int, signs: frozenset[str]) -> Token:
    plain = SIGNS.get(found, found)
    if found.isdecimal():
        raise ExpressionError(f"numbers take the digits 0 to 9, got {found!r}", place)
    if plain not in signs:
        raise ExpressionError(f"{found!r} has no meaning in a formula", place)
    return Token("sign", plain, place)


def _power(text: str, match: re.Match[str]) -> list[Token]:
    """The tokens ^ - 2 of a superscript such as ⁻²."""
    place = match.start()
    if POWER.match(text, match.end()):
        raise ExpressionError("two powers in a row take brackets, as in (x²)^3", place)

    tokens = [Token("sign", "^", place)]
    if match[0].startswith("⁻"):
        tokens.append(Token("sign", "-", place))

    digits = match[0].removeprefix("⁻").translate(TRANSLATED)
    tokens.append(Token("number", digits, place))
    return tokens


def paired(tokens: Sequence[Token]) -> None:
    """Raises ExpressionError where a bracket is not closed by its like or was never opened.

    Brackets that stand in more than eighty others are refused, too.
    """
    awaited = list[str]()
    too_deep: Token | None = None
    for token in tokens:
        if token.text in PAIRS:
            awaited.append(PAIRS[token.text])
            if len(awaited) > 2 * DEPTH:  # some of them may be those of a matrix
                too_deep = too_deep or token
        elif token.kind == "end" and awaited:
            raise ExpressionError("a closing bracket is missing", token.offset)
        elif token.text in CLOSING:
            _close(token, awaited)
    if too_deep:
        raise ExpressionError(TOO_DEEP, too_deep.offset)


def _close(token: Token, awaited: list[str]) -> None:
    """Take the closing bracket that is awaited last off the list."""
    if not awaited:
        raise ExpressionError("this bracket was never opened", token.offset)
    expected = awaited.pop()
    if token.text != expected:
        raise ExpressionError(f"'{expected}' is expected, got '{token.text}'", token.offset)


def split(tokens: Sequence[Token], separators: Collection[str]) -> list[list[Token]]:
    """Tokens between the separators that stand in no brackets.

    Each part ends with a token of kind "end".
    """
    parts = list[list[Token]]()
    part = list[Token]()
    depth = 0
    for token in tokens:
        if token.text in PAIRS:
            depth += 1
        elif token.text in CLOSING:
            depth -= 1

        separates = depth == 0 and token.kind == "sign" and token.text in separators
        if separates or token.kind == "end":
            parts.append([*part, Token("end", "", token.offset)])
            part = list[Token]()
        else:
            part.append(token)
    return parts


def number(text: str, offset: int) -> float:
    """Value of a number token; ExpressionError beyond 1e12 and, unless it is 0, below 1e-12."""
    value = math.inf
    if len(text) <= DIGITS_OF_A_NUMBER:
        value = float(text)

    # 1e-400 is 0 in floating point, but was not meant as 0
    mantissa = re.split("[eE]", text)[0]
    too_small = value < 1 / LARGEST and re.search("[1-9]", mantissa) is not None
    if value > LARGEST or too_small:
        raise ExpressionError(
            f"a number takes a size between {1 / LARGEST:g} and {LARGEST:g}, or 0", offset
        )
    return value
