"""Conditions as students type them: sin(q2) = 0 or q3 = 0, and several equations at once: q2 = 0, pi and q3 = 0."""

from collections.abc import Collection, Iterator, Sequence
from functools import reduce

from ...solutions.condition import Condition, all_of
from ...solutions.expression import Expression
from ...solutions.tokens import PAIRS, ExpressionError, Token, paired, refusing, split, tokens_of
from .bars import without_bars
from .shorthands import WORDS
from .typed import TYPED
from .typed_matrix import entry_of, joined_lines, without_trailing

EQUATIONS, TOGETHER, LENGTH = 64, 8, 2000
EQUATION = TYPED | frozenset("=±;&\n")
FREE, INTEGERS = ("k", "n", "m"), range(-4, 5)
LISTED = {"or": ";", "and": "&"}


def typed_equations(text: str, names: Collection[str]) -> list[Condition]:
    """Left side minus right side of each typed condition; without "=" it is the formula that is to be zero.

    Conditions stand between semicolons, commas, lines or "or"; `q2 = 0, pi` and `q2 = ±pi/2` are two; in `q2 = k*pi`
    a k, n or m that is no name runs from -4 to 4. Equations with "and" between them are one condition, in which
    `q2 = 0, pi` is the equation q2*(q2 - pi) = 0. Raises ExpressionError with the place in the text.
    """
    with refusing(text, "a condition"):
        tokens = [_listing(token, names) for token in tokens_of(text, EQUATION, LENGTH)]
        paired(tokens)
        tokens = without_bars(joined_lines(tokens))
        _check_decimals(tokens)
        if all(token.text != "&" for token in tokens):
            return [*_differences(tokens, names, written=len(split(tokens, "=")) > 1)]
        written = any(token.text == "=" for token in tokens)
        cases = without_trailing(split(_unbracketed(tokens), (";", "\n")))
        return [condition for case in cases for condition in _case(case, names, written=written)]


def _listing(token: Token, names: Collection[str]) -> Token:
    """The token, or the sign for the words "or" and "and"."""
    word = token.text.lower() if token.kind == "name" and token.text not in names else ""
    return Token("sign", LISTED[word], token.offset) if word in LISTED else token


def _case(tokens: Sequence[Token], names: Collection[str], *, written: bool) -> Iterator[Condition]:
    """The condition that some equations hold at once; where there is but one, what it says by itself."""
    equations = split(_unbracketed(tokens), "&")
    if len(equations) > TOGETHER:
        place = equations[TOGETHER][0].offset
        raise ExpressionError(
            f"up to {TOGETHER} equations hold at once, got {len(equations)}", place
        )
    if len(equations) == 1:
        yield from _differences(equations[0], names, written=written)
        return
    _check_shared(equations, names)
    yield all_of([_equation(equation, names, written=written) for equation in equations])


def _unbracketed(tokens: Sequence[Token]) -> Sequence[Token]:
    """The tokens without brackets around all of them."""
    depth = 0
    for place, token in enumerate(tokens):
        depth += (token.text in PAIRS) - (token.text in PAIRS.values())
        if not depth:
            whole = tokens[0].text == "(" and place == len(tokens) - 2  # the last token is the end
            return _unbracketed([*tokens[1:-2], tokens[-1]]) if whole else tokens
    return tokens


def _check_shared(equations: Sequence[Sequence[Token]], names: Collection[str]) -> None:
    """Refuse a free integer or a ± in two equations that hold at once: it may be the same one or not."""
    seen = set[str]()
    for equation in equations:
        marks = [
            token for token in _plus_minus(equation) if token.text == "±" or _is_free(token, names)
        ]
        for token in marks:
            if token.text in seen:
                says = f"'{token.text}' in two equations may be one and the same or not"
                raise ExpressionError(f"{says}: list the values, as in q2 = 0, pi", token.offset)
        seen |= {token.text for token in marks}


def _equation(tokens: Sequence[Token], names: Collection[str], *, written: bool) -> Expression:
    """What is zero where one equation of several holds: for `q2 = 0, pi` it is q2*(q2 - pi)."""
    inside = _unbracketed(tokens)
    for token in inside:
        if token.text == "&":
            raise ExpressionError(
                "brackets take one equation here: write every case by itself", token.offset
            )
    for part in split(inside, ",")[1:]:
        if not written or any(token.text == "=" for token in part):
            says = "beside 'and' a comma between equations may be an 'or' or an 'and'"
            raise ExpressionError(f"{says}: write the word", part[0].offset)
    found = _differences(inside, names, written=written)
    return reduce(lambda left, right: _together("*", left, right), found)


def _differences(
    tokens: Sequence[Token], names: Collection[str], *, written: bool
) -> Iterator[Expression]:
    """Left side minus right side of every equation, once for each value of its free integer and sign."""
    for part in _equations(tokens, names, written=written):
        for variant in _variants(part, names):
            yield _difference(variant, names)


def _check_decimals(tokens: Sequence[Token]) -> None:
    for before, comma, behind in zip(tokens, tokens[1:], tokens[2:], strict=False):
        if (before.kind, comma.text, behind.kind) == (
            "number",
            ",",
            "number",
        ) and behind.offset == comma.offset + 1:
            raise ExpressionError(
                "a decimal number takes a point, as in 3.14, got a comma", comma.offset
            )


def _equations(
    tokens: Sequence[Token], names: Collection[str], *, written: bool
) -> Iterator[list[Token]]:
    """Tokens of each equation with both sides; `= 0` where none is written, and `q2 = 0, pi` goes on with q2."""
    parts = without_trailing(split(tokens, (",", ";", "\n")))
    if len(parts) > EQUATIONS:
        raise ExpressionError(
            f"up to {EQUATIONS} conditions are read, got {len(parts)}", parts[EQUATIONS][0].offset
        )
    sides = [split(part, "=") for part in parts]
    left = list[Token]()
    for part, (first, *more) in zip(parts, sides, strict=True):
        place = part[-1].offset
        if len(more) > 1:
            raise ExpressionError("a = b = c takes two equations, a = b; b = c", more[0][-1].offset)
        if more:
            left = first
            yield part
        elif not written:
            yield [
                *part[:-1],
                Token("sign", "=", place),
                Token("number", "0", place),
                Token("end", "", place),
            ]
        elif left and part[:-1] and all(_is_constant(token, names) for token in part):
            yield [*left[:-1], Token("sign", "=", left[-1].offset), *part]
        else:
            raise ExpressionError("an equation takes two sides, as in q2 = 0", part[0].offset)


def _is_constant(token: Token, names: Collection[str]) -> bool:
    return token.kind != "name" or token.text in WORDS or _is_free(token, names)


def _is_free(token: Token, names: Collection[str]) -> bool:
    return token.kind == "name" and token.text in FREE and token.text not in names


def _variants(tokens: Sequence[Token], names: Collection[str]) -> Iterator[list[Token]]:
    """The condition for each value of its free integer and for both signs of its ±."""
    signed = _plus_minus(tokens)
    free = [token for token in tokens if _is_free(token, names)]
    for token in [token for token in free if token.text != free[0].text]:
        raise ExpressionError("an equation takes one free integer", token.offset)
    for token in [token for token in signed if token.text == "±"][1:]:
        raise ExpressionError("an equation takes one ±", token.offset)
    for value in INTEGERS if free else (0,):
        whole = [
            part
            for token in signed
            for part in (_integer(token, value) if token in free else [token])
        ]
        for sign in "+-" if any(token.text == "±" for token in whole) else "+":
            yield [token._replace(text=sign) if token.text == "±" else token for token in whole]


def _plus_minus(tokens: Sequence[Token]) -> list[Token]:
    """Tokens where +- without a space is ±."""
    found = list[Token]()
    for token in tokens:
        if (
            token.text == "-"
            and found
            and found[-1].text == "+"
            and found[-1].offset + 1 == token.offset
        ):
            found[-1] = found[-1]._replace(text="±")
        else:
            found.append(token)
    return found


def _integer(token: Token, value: int) -> list[Token]:
    sign, digits = "-" if value < 0 else "+", str(abs(value))
    signs = [token._replace(kind="sign", text=text) for text in ("(", sign, ")")]
    return [*signs[:2], token._replace(kind="number", text=digits), signs[2]]


def _difference(equation: Sequence[Token], names: Collection[str]) -> Expression:
    left, right = (entry_of(side, names, "a side of the equation") for side in split(equation, "="))
    if not left.names | right.names:
        raise ExpressionError(
            "a condition takes a joint or another name, as in q2 = 0", equation[0].offset
        )
    return left if right.nodes == (("n", 0.0),) else _together("-", left, right)


def _together(operation: str, left: Expression, right: Expression) -> Expression:
    """The expression with this operation between two others."""
    shift = len(left.nodes)
    moved = [
        node if node[0] in ("n", "s") else (node[0], *(int(i) + shift for i in node[1:]))
        for node in right.nodes
    ]
    last = shift + len(moved)
    return Expression((*left.nodes, *moved, (operation, shift - 1, last - 1)))
