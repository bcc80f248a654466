"""Entries with blanks between them, as MATLAB and printed arrays have them: [a -b] is a and -b.

Where it is not known how many entries a row takes, a blank may be a comma or not, and is refused.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise

from ...solutions.tokens import ExpressionError, Token
from .shorthands import WORDS

COMMAS = "entries take commas between them and products a *, as in [[a, 2*b], [c, d]]"


def parted_by_blanks(entry: Sequence[Token], text: str) -> list[list[Token]]:
    """The entries of tokens without commas, each of which ends with a token of kind "end"."""
    starts = set[int]()
    for before, following in _beside_blanks(entry, text):
        if _starts_entry(before, following) or _is_sign_of_entry(following, text):
            starts.add(following.offset)

    parts = list[list[Token]]()
    part = list[Token]()
    for token in entry:
        if token.offset in starts and part:
            parts.append([*part, Token("end", "", token.offset)])
            part = []
        part.append(token)
    return [*parts, part]


def refuse_blanks(entry: Sequence[Token], text: str, *, signs: bool) -> None:
    """Refuses what MATLAB, or a printed array, has as two entries: `a b` and, with signs, `a -b`.

    Raises:
        ExpressionError: without the text.
    """
    for before, following in _beside_blanks(entry, text):
        if _starts_entry(before, following):
            raise ExpressionError(COMMAS, following.offset)
        if signs and _is_sign_of_entry(following, text):
            sign = following.text
            raise ExpressionError(
                f"this may be one entry or two: write a {sign} b or a, {sign}b", following.offset
            )


def _beside_blanks(entry: Sequence[Token], text: str) -> Iterator[tuple[Token, Token]]:
    """Pairs of tokens with a space between them, of which the first ends an operand.

    Those in round brackets are no entries of their own.
    """
    depth = 0
    for token, following in pairwise(entry):
        if token.text == "(":
            depth += 1
        elif token.text == ")":
            depth -= 1
        if depth == 0 and _ends_operand(token) and text[following.offset - 1].isspace():
            yield token, following


def _ends_operand(token: Token) -> bool:
    if token.kind == "name":
        return token.text not in WORDS or token.text == "pi"
    return token.kind == "number" or token.text == ")"


def _starts_entry(before: Token, following: Token) -> bool:
    opens = following.text in ("(", "√") and before.kind != "name"  # `f (x)` may be a call
    return opens or following.kind in ("number", "name")


def _is_sign_of_entry(following: Token, text: str) -> bool:
    """Whether it is the sign of `a -b`, which is one entry in `a - b`."""
    behind = text[following.offset + 1 : following.offset + 2]
    return following.text in ("+", "-") and not behind.isspace()
