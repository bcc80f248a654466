"""Formulas as students type them: s12, theta_1, np.sin, sec(q1), sin²(q1), √3, |q1|."""

from collections.abc import Collection, Sequence

from ...solutions.expression import CALLED, Expression, expression_of
from ...solutions.tokens import FORMULA, TRANSLATED, ExpressionError, Token, refusing, tokens_of
from .bars import without_bars
from .degrees import SIGN, in_radians
from .printed import without_assignment, without_dust, without_time
from .shorthands import RECIPROCALS, WORDS, readings

TYPED = FORMULA | {"√", "|"}
FUNCTIONS = WORDS - {"pi"}
FACTORS = 20  # as long is a name that may be a product without signs


def typed(text: str, names: Collection[str]) -> Expression:
    """Expression of what a student typed.

    It is read as `parse` reads it, and in shorthands that are not themselves names: s12, c_23 and
    S1 are sines and cosines of sums of joints; theta1, th_1 and θ₁ are q1; l_1, L1 and rrt_l1 are
    l1; np.sin, arcsin, sec, sin²(q1), √3, |q1|, 90° and q1(t) are read. A name and "=" may stand in
    front: det = -l1*s2.

    Raises:
        ExpressionError: it is none of it or may be two things, with the place in the text as typed.
    """
    with refusing(text) as seen:
        tokens = in_radians(tokens_of(seen, TYPED | {SIGN, "="}), names)
        return typed_tokens(without_assignment(tokens, names), names)


def typed_tokens(tokens: Sequence[Token], names: Collection[str]) -> Expression:
    """Expression of the tokens in shorthands, the last of kind "end".

    Raises:
        ExpressionError: they are none; the error has a place, but not the text.
    """
    known = frozenset(names)
    printed = without_time(without_dust(without_bars(tokens)), known)
    spelled: list[Token] = []
    for token in printed:
        spelled += _spelled(token, known)
    return expression_of(_rearranged(spelled), known)


def _spelled(token: Token, names: frozenset[str]) -> list[Token]:
    """The token, or where it is a shorthand the long form at the same place."""
    if token.kind != "name":
        return [token]
    found = readings(token.text, names)
    if token.text in found:
        return [token]
    if len(found) > 1:
        either = " or ".join(sorted(found)[:3])
        raise ExpressionError(f"'{token.text[:40]}' may be {either}", token.offset)
    if not found:
        _refuse_product(token, names)
        return [token]

    meant = tokens_of(found.pop())[:-1]
    return [token._replace(kind=long.kind, text=long.text) for long in meant]


def _refuse_product(token: Token, names: frozenset[str]) -> None:
    """Raises ExpressionError at the second factor of s1c23, and at the argument of sinq2."""
    name = token.typed
    if len(name) > FACTORS:
        return
    for cut in range(len(name) - 1, 0, -1):
        left, right = name[:cut], name[cut:]
        if _is_function(left, names) and _is_argument(right, names):
            raise ExpressionError(
                f"{left} takes its argument in brackets, as in {left}({right})", token.offset + cut
            )
    for cut in range(1, len(name)):
        if _is_product(name[:cut], name[cut:], names):
            raise ExpressionError(
                f"a sign such as * is missing before '{name[cut:]}'", token.offset + cut
            )


def _is_function(name: str, names: frozenset[str]) -> bool:
    return bool(readings(name.translate(TRANSLATED), names) & FUNCTIONS)


def _is_argument(text: str, names: frozenset[str]) -> bool:
    """Whether it is a number, a name, or a product of names."""
    if text.isdigit() or readings(text.translate(TRANSLATED), names):
        return True
    return any(_is_product(text[:cut], text[cut:], names) for cut in range(1, len(text)))


def _is_product(left: str, right: str, names: frozenset[str]) -> bool:
    """Whether both, or the left one and all factors of the right one, are names or shorthands."""
    if not readings(left.translate(TRANSLATED), names):
        return False
    if readings(right.translate(TRANSLATED), names):
        return True
    return any(_is_product(right[:cut], right[cut:], names) for cut in range(1, len(right)))


def _rearranged(tokens: Sequence[Token]) -> list[Token]:
    """Tokens where sin²(x) is (sin(x)^2), sec(x) is (1/cos(x)) and √3 is sqrt(3)."""
    rest = [*reversed(tokens)]
    found: list[Token] = []
    closings: list[list[Token]] = []  # what follows each bracket that is open, once it closes
    while rest:
        token = rest.pop()
        if token.kind == "name" and token.text in FUNCTIONS:
            before, behind = _called(token, rest)
            found += before
            if behind:
                found.append(rest.pop())
                closings.append(behind)
        elif token.text == "√":
            found += _rooted(token, rest)
        else:
            found.append(token)
            if token.text == "(":
                closings.append([])
            elif token.text == ")" and closings:
                found += closings.pop()
    return found


def _called(function: Token, rest: list[Token]) -> tuple[list[Token], list[Token]]:
    """What stands before the opening bracket of a function's argument, and what behind its end."""
    name, offset = function.text, function.offset
    power = _power(function, rest)
    if name in RECIPROCALS and rest[-1].text != "(":
        raise ExpressionError(
            f"{name} takes its argument in brackets, as in {name}(x)", rest[-1].offset
        )

    before = [function]
    behind: list[Token] = []
    opening = Token("sign", "(", offset)
    closing = Token("sign", ")", offset)
    if name in RECIPROCALS:
        one, over = Token("number", "1", offset), Token("sign", "/", offset)
        before = [opening, one, over, function._replace(text=RECIPROCALS[name])]
        behind = [closing]
    if power:
        before = [opening, *before]
        behind = [*behind, *power, closing]
    return before, behind


def _power(function: Token, rest: list[Token]) -> list[Token]:
    """The power between a function and its argument, taken from the rest."""
    name = function.text
    sign = rest[-1]
    if sign.text != "^":
        return []
    rest.pop()
    exponent = rest.pop()
    if exponent.text == "-":
        meant = f"1/{name}(x)"
        if f"a{name}" in CALLED:
            meant = f"a{name}(x) or {meant}"
        raise ExpressionError(f"{name} to a negative power is written {meant}", sign.offset)
    if not exponent.text.isdigit() or rest[-1].text != "(":
        raise ExpressionError(f"a power stands behind the argument, as in {name}(x)^2", sign.offset)
    return [sign, exponent]


def _rooted(root: Token, rest: list[Token]) -> list[Token]:
    """√3 as sqrt(3); the root of a bracket is sqrt of it."""
    function = Token("name", "sqrt", root.offset)
    if rest[-1].text == "(":
        return [function]
    if rest[-1].kind != "number":
        raise ExpressionError("√ takes a number or brackets, as in √3 or √(x)", rest[-1].offset)
    return [function, Token("sign", "(", root.offset), rest.pop(), Token("sign", ")", root.offset)]
