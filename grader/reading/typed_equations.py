"""Conditions as students type them, one of several or several at once.

`sin(q2) = 0 or q3 = 0` are two conditions, `q2 = 0, pi and q3 = 0` is one.
"""

from collections.abc import Collection, Iterator, Sequence
from functools import reduce

from ...solutions.condition import Condition, all_of
from ...solutions.expression import Expression
from ...solutions.tokens import PAIRS, ExpressionError, Token, paired, refusing, split, tokens_of
from .bars import without_bars
from .degrees import in_radians
from .shorthands import WORDS
from .typed import TYPED
from .typed_matrix import entry_of, joined_lines, without_trailing
from .variants import is_free, plus_minus, variants

EQUATIONS = 64
TOGETHER = 8  # equations that hold at once
EQUATION = TYPED | frozenset("=±;&\n°")
LISTED = {"or": ";", "and": "&"}
EITHER = "beside 'and' a comma between equations may be an 'or' or an 'and': write the word"


def typed_equations(text: str, names: Collection[str]) -> list[Condition]:
    """Left side minus right side of each typed condition.

    Without "=" it is the formula that is to be zero. Conditions stand between semicolons, commas,
    lines or "or"; `q2 = 0, pi` and `q2 = ±pi/2` are two; in `q2 = k*pi` a k, n or m that is no name
    runs from -4 to 4. Equations with "and" between them are one condition, in which `q2 = 0, pi` is
    the equation q2*(q2 - pi) = 0.

    Raises:
        ExpressionError: it is none of it or may be two things, with the place in the text.
    """
    with refusing(text, "a condition") as seen:
        tokens = in_radians(tokens_of(seen, EQUATION), names)
        tokens = [_listing(token, names) for token in tokens]
        paired(tokens)
        tokens = without_bars(joined_lines(tokens))
        _refuse_decimal_commas(tokens)
        if not _has(tokens, "&"):
            written = len(split(tokens, "=")) > 1
            return [*_differences(tokens, names, written=written)]

        written = _has(tokens, "=")
        conditions: list[Condition] = []
        for case in without_trailing(split(_unbracketed(tokens), (";", "\n"))):
            conditions += _case(case, names, written=written)
        return conditions


def _has(tokens: Sequence[Token], sign: str) -> bool:
    return any(token.text == sign for token in tokens)


def _listing(token: Token, names: Collection[str]) -> Token:
    """The token, or the sign for the words "or" and "and"."""
    word = token.text.lower()
    if token.kind != "name" or token.text in names or word not in LISTED:
        return token
    return Token("sign", LISTED[word], token.offset)


def _refuse_decimal_commas(tokens: Sequence[Token]) -> None:
    for before, comma, behind in zip(tokens, tokens[1:], tokens[2:], strict=False):
        numbers = before.kind == behind.kind == "number"
        if numbers and comma.text == "," and behind.offset == comma.offset + 1:
            raise ExpressionError(
                "a decimal number takes a point, as in 3.14, got a comma", comma.offset
            )


def _case(tokens: Sequence[Token], names: Collection[str], *, written: bool) -> Iterator[Condition]:
    """The condition that some equations hold at once; of one equation, what it says by itself."""
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
    while tokens[0].text == "(" and _closing_of_first(tokens) == len(tokens) - 2:
        tokens = [*tokens[1:-2], tokens[-1]]  # the last token is the end
    return tokens


def _closing_of_first(tokens: Sequence[Token]) -> int:
    """The place of the bracket that closes the first token, which is one."""
    depth = 0
    for place, token in enumerate(tokens):
        if token.text in PAIRS:
            depth += 1
        elif token.text in PAIRS.values():
            depth -= 1
        if depth == 0:
            return place
    return len(tokens)


def _check_shared(equations: Sequence[Sequence[Token]], names: Collection[str]) -> None:
    """Refuses a free integer or a ± in two equations that hold at once.

    It may be the same one or not.
    """
    seen = set[str]()
    for equation in equations:
        marks = set[str]()
        for token in plus_minus(equation):
            if token.text != "±" and not is_free(token, names):
                continue
            if token.text in seen:
                says = f"'{token.text}' in two equations may be one and the same or not"
                raise ExpressionError(f"{says}: list the values, as in q2 = 0, pi", token.offset)
            marks.add(token.text)
        seen |= marks


def _equation(tokens: Sequence[Token], names: Collection[str], *, written: bool) -> Expression:
    """What is zero where one equation of several holds: for `q2 = 0, pi` it is q2*(q2 - pi)."""
    inside = _unbracketed(tokens)
    for token in inside:
        if token.text == "&":
            raise ExpressionError(
                "brackets take one equation here: write every case by itself", token.offset
            )
    for part in split(inside, ",")[1:]:
        if not written or _has(part, "="):
            raise ExpressionError(EITHER, part[0].offset)
    return reduce(_product, _differences(inside, names, written=written))


def _differences(
    tokens: Sequence[Token], names: Collection[str], *, written: bool
) -> Iterator[Expression]:
    """Left side minus right side of every equation, for each value of its free integer and sign."""
    for equation in _equations(tokens, names, written=written):
        for variant in variants(equation, names):
            yield _difference(variant, names)


def _equations(
    tokens: Sequence[Token], names: Collection[str], *, written: bool
) -> Iterator[list[Token]]:
    """Tokens of each equation with both sides; `q2 = 0, pi` goes on with q2.

    Where no "=" is written anywhere, each part is to be zero.
    """
    parts = without_trailing(split(tokens, (",", ";", "\n")))
    if len(parts) > EQUATIONS:
        raise ExpressionError(
            f"up to {EQUATIONS} conditions are read, got {len(parts)}", parts[EQUATIONS][0].offset
        )

    left: list[Token] = []
    for part in parts:
        sides = split(part, "=")
        if len(sides) > 2:
            place = sides[1][-1].offset
            raise ExpressionError("a = b = c takes two equations, a = b; b = c", place)
        if len(sides) == 2:
            left = sides[0]
            yield part
        elif not written:
            yield _is_zero(part)
        else:
            yield _next_value(left, part, names)


def _is_zero(formula: Sequence[Token]) -> list[Token]:
    """The equation that says so of a formula."""
    place = formula[-1].offset
    equals, zero = Token("sign", "=", place), Token("number", "0", place)
    return [*formula[:-1], equals, zero, Token("end", "", place)]


def _next_value(
    left: Sequence[Token], value: Sequence[Token], names: Collection[str]
) -> list[Token]:
    """The equation of a left side and one more value of it."""
    is_value = all(_is_constant(token, names) for token in value)
    if not left or len(value) == 1 or not is_value:
        raise ExpressionError("an equation takes two sides, as in q2 = 0", value[0].offset)
    return [*left[:-1], Token("sign", "=", left[-1].offset), *value]


def _is_constant(token: Token, names: Collection[str]) -> bool:
    return token.kind != "name" or token.text in WORDS or is_free(token, names)


def _difference(equation: Sequence[Token], names: Collection[str]) -> Expression:
    """Left side minus right side of one equation."""
    left_tokens, right_tokens = split(equation, "=")
    left = entry_of(left_tokens, names, "a side of the equation")
    right = entry_of(right_tokens, names, "a side of the equation")
    if not left.names | right.names:
        raise ExpressionError(
            "a condition takes a joint or another name, as in q2 = 0", equation[0].offset
        )
    if right.nodes == (("n", 0.0),):
        return left
    return _together("-", left, right)


def _product(left: Expression, right: Expression) -> Expression:
    return _together("*", left, right)


def _together(operation: str, left: Expression, right: Expression) -> Expression:
    """The expression with this operation between two others."""
    between = Expression((("s", "left"), ("s", "right"), (operation, 0, 1)))
    return between.put({"left": left, "right": right})
