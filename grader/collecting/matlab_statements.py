"""A MATLAB script taken apart into statements; nothing of it is run."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

TOKEN = re.compile(
    r"(?P<skip>\.\.\.[^\n]*(?:\n|\Z)|[%#][^\n]*)"
    r"|(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z]\w*(?:\.[A-Za-z]\w*)*)"
    r"|(?P<blank>[^\S\n]+)"
    r"|(?P<line>\n)"
    r"|(?P<sign>\.[*/\\^']|[=~<>]=|&&|\|\||.)",
    re.ASCII,
)
SINGLE = re.compile(r"'((?:[^'\n]|'')*)'")
DOUBLE = re.compile(r'"((?:[^"\n]|"")*)"')
BLOCK_COMMENT = re.compile(
    r"^[^\S\n]*%\{[^\S\n]*$.*?(?:^[^\S\n]*%\}[^\S\n]*$|\Z)", re.MULTILINE | re.DOTALL
)
OPENING = {
    "if", "for", "while", "switch", "try", "parfor", "function", "classdef", "unwind_protect",
}  # fmt: skip
CLOSING = {"end", "endif", "endfor", "endwhile", "endfunction", "endswitch", "end_try_catch"}
BRACKETS = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}
TRANSPOSED = (")", "]", "}", "'", ".'")
"""Behind what a quotation mark transposes, besides names and numbers, and begins no text."""


@dataclass(frozen=True)
class Token:
    """A piece of a statement: of kind number, name, text, line or sign.

    `spaced` says whether a blank stands before it, which parts the entries of a matrix.
    """

    kind: str
    text: str
    spaced: bool


@dataclass(frozen=True)
class Statement:
    """What stands between semicolons, commas and lines.

    Attributes:
        line: Where it begins, counted from 1.
        tokens: What it is made of.
        inside: Whether it stands in a loop, a condition or a function.
    """

    line: int
    tokens: tuple[Token, ...]
    inside: bool


def statements(text: str) -> Iterator[Statement]:
    """The statements of a script in their order, without comments."""
    depth = 0
    for line, tokens in _pieces(_without_blocks(text)):
        word = tokens[0].text if tokens[0].kind == "name" else ""
        if word in CLOSING:
            depth = max(0, depth - 1)
            continue
        if word in OPENING:
            depth += 1
        yield Statement(line, tuple(tokens), depth > 0)


def _without_blocks(text: str) -> str:
    """The text with as many lines, where block comments stood."""
    unix = text.replace("\r\n", "\n").replace("\r", "\n")
    return BLOCK_COMMENT.sub(lambda found: "\n" * found[0].count("\n"), unix)


def _pieces(text: str) -> Iterator[tuple[int, list[Token]]]:
    """Tokens between the ends of statements, with the line in which they begin."""
    piece: list[Token] = []
    first = 1
    depth = 0
    for line, token in _tokens(text):
        ends = token.kind == "line" or token.text in (";", ",")
        if depth == 0 and ends and token.kind != "text":
            if piece:
                yield first, piece
            piece = []
            continue
        if not piece:
            first = line
        if token.kind == "sign":
            depth = max(0, depth + BRACKETS.get(token.text, 0))
        piece.append(token)
    if piece:
        yield first, piece


def _tokens(text: str) -> Iterator[tuple[int, Token]]:
    """Tokens with their lines."""
    place = 0
    line = 1
    spaced = False
    before: Token | None = None
    while place < len(text):
        quoted = _quoted(text, place, spaced=spaced, before=before)
        if quoted:
            kind, said = "text", quoted[1].replace(quoted[0][0] * 2, quoted[0][0])
            end = quoted.end()
        else:
            found = TOKEN.match(text, place)
            if found is None:  # every character is one of the kinds
                return
            kind, said, end = str(found.lastgroup), found[0], found.end()
        if kind in ("skip", "blank"):
            spaced = True
        else:
            before = Token(kind, said, spaced)
            yield line, before
            spaced = False
        line += text.count("\n", place, end)
        place = end


def _quoted(text: str, place: int, *, spaced: bool, before: Token | None) -> re.Match[str] | None:
    """The text in quotes that begins at a place; None where none does."""
    if text[place] == '"':
        return DOUBLE.match(text, place)
    if text[place] != "'":
        return None
    if before and not spaced and _ends_value(before):
        return None  # it transposes
    return SINGLE.match(text, place)


def _ends_value(token: Token) -> bool:
    return token.kind in ("name", "number", "text") or token.text in TRANSPOSED


def assigned(tokens: Sequence[Token]) -> tuple[list[str], Sequence[Token] | None]:
    """Names that a statement sets, and what it sets a single one to as a whole.

    That is None where it sets several, or a part of one as in J(1, 2) = 3.
    """
    equals = _equals_sign(tokens)
    if equals < 1:
        return [], None
    left = tokens[:equals]
    if len(left) == 1 and left[0].kind == "name":
        return [left[0].text], tokens[equals + 1 :]
    if left[0].text == "[":
        names = [token.text for token in left if token.kind == "name"]
        return names, None
    if left[0].kind == "name":
        return [left[0].text.partition(".")[0]], None
    return [], None


def _equals_sign(tokens: Sequence[Token]) -> int:
    """The place of the sign that assigns; -1 where there is none."""
    depth = 0
    for place, token in enumerate(tokens):
        if token.kind != "sign":
            continue
        depth += BRACKETS.get(token.text, 0)
        if token.text == "=" and depth == 0:
            return place
    return -1
