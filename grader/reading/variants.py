"""Signs that stand for several values: the ± of q2 = ±pi/2, and the free integer of q2 = k*pi."""

from collections.abc import Collection, Iterator, Sequence

from ...solutions.tokens import ExpressionError, Token

FREE = ("k", "n", "m")  # names of a free integer
INTEGERS = range(-4, 5)


def variants(tokens: Sequence[Token], names: Collection[str]) -> Iterator[list[Token]]:
    """Tokens of an equation for each value of its free integer and for both signs of its ±.

    Raises:
        ExpressionError: it has two free integers or two ±; the error does not have the text.
    """
    tokens = plus_minus(tokens)
    free = _free_integer(tokens, names)
    has_both_signs = _has_plus_minus(tokens)

    values = INTEGERS if free else (0,)
    for value in values:
        whole = _with_integer(tokens, free, value)
        yield _with_sign(whole, "+")
        if has_both_signs:
            yield _with_sign(whole, "-")


def is_free(token: Token, names: Collection[str]) -> bool:
    """Whether a token is a free integer, which a name of the question is not."""
    return token.kind == "name" and token.text in FREE and token.text not in names


def plus_minus(tokens: Sequence[Token]) -> list[Token]:
    """Tokens where +- without a space is ±."""
    found = list[Token]()
    for token in tokens:
        if found and _is_plus_minus(found[-1], token):
            found[-1] = found[-1]._replace(text="±")
        else:
            found.append(token)
    return found


def _is_plus_minus(plus: Token, minus: Token) -> bool:
    return plus.text == "+" and minus.text == "-" and minus.offset == plus.offset + 1


def _free_integer(tokens: Sequence[Token], names: Collection[str]) -> str:
    """The name of the free integer of an equation; empty where there is none."""
    found = ""
    for token in tokens:
        if not is_free(token, names):
            continue
        if found and token.text != found:
            raise ExpressionError("an equation takes one free integer", token.offset)
        found = token.text
    return found


def _has_plus_minus(tokens: Sequence[Token]) -> bool:
    """Whether there is a ±; a second one is refused."""
    found = False
    for token in tokens:
        if token.text != "±":
            continue
        if found:
            raise ExpressionError("an equation takes one ±", token.offset)
        found = True
    return found


def _with_integer(tokens: Sequence[Token], name: str, value: int) -> list[Token]:
    """Tokens with a value in brackets in the place of the free integer."""
    sign = "-" if value < 0 else "+"
    found: list[Token] = []
    for token in tokens:
        if token.kind == "name" and token.text == name:
            found += [
                token._replace(kind="sign", text="("),
                token._replace(kind="sign", text=sign),
                token._replace(kind="number", text=str(abs(value))),
                token._replace(kind="sign", text=")"),
            ]
        else:
            found.append(token)
    return found


def _with_sign(tokens: Sequence[Token], sign: str) -> list[Token]:
    """Tokens with a sign in the place of the ±."""
    found = [*tokens]
    for place, token in enumerate(tokens):
        if token.text == "±":
            found[place] = token._replace(text=sign)
    return found
