"""Absolute values typed with bars: |q1 - q2| is abs(q1 - q2)."""

from collections.abc import Sequence

from ...solutions.tokens import PAIRS, ExpressionError, Token

BETWEEN = frozenset(",;\n=&")  # signs that part entries, rows and equations
CLOSINGS = frozenset(PAIRS.values())
UNCLOSED = "a second bar is missing: write abs(...)"
EITHER = "this bar may open or close: write abs(...)"


def without_bars(tokens: Sequence[Token]) -> list[Token]:
    """Tokens where abs( ) stands in the place of each pair of bars.

    Since products take a sign, a bar behind a number, a name or a bracket closes, and any other
    opens.

    Raises:
        ExpressionError: a bar has nothing to close, opens right inside other bars, or stays open.
    """
    if all(token.text != "|" for token in tokens):
        return [*tokens]
    found = list[Token]()
    opened = list[str]()  # brackets and bars
    for token in tokens:
        if token.text == "|":
            closes = bool(found) and _ends_operand(found[-1])
            found += _called(token, opened, closes=closes)
        else:
            _follow(token, opened)
            found.append(token)
    return found


def _called(bar: Token, opened: list[str], *, closes: bool) -> list[Token]:
    """The tokens in the place of a bar; `opened` goes on behind it."""
    inside = opened[-1:] == ["|"]
    if inside != closes:
        raise ExpressionError(EITHER, bar.offset)
    if closes:
        opened.pop()
        return [Token("sign", ")", bar.offset)]
    opened.append("|")
    return [Token("name", "abs", bar.offset, "abs"), Token("sign", "(", bar.offset)]


def _follow(token: Token, opened: list[str]) -> None:
    """Keeps what is open behind a token that is no bar; nothing may end inside bars but they."""
    if token.text in PAIRS:
        opened.append(token.text)
    elif opened[-1:] == ["|"] and _parts(token):
        raise ExpressionError(UNCLOSED, token.offset)
    elif token.text in CLOSINGS and opened:
        opened.pop()


def _ends_operand(token: Token) -> bool:
    return token.kind in ("number", "name") or token.text in CLOSINGS


def _parts(token: Token) -> bool:
    """Whether a token ends what stands before it."""
    return token.kind == "end" or token.text in BETWEEN or token.text in CLOSINGS
