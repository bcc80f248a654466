"""Formulas in the shorthands students use: s12, c_23, theta_1, np.sin, sec(q1), sin²(q1), √3, |q1|."""

from collections.abc import Callable, Collection, Iterator, Sequence

from ...solutions.expression import CALLED, Expression, expression_of
from ...solutions.tokens import FORMULA, TRANSLATED, ExpressionError, Token, refusing, tokens_of
from .bars import without_bars

TYPED = FORMULA | {"√", "|"}
MODULES = ("", "np", "numpy", "math", "sp", "sympy")
ALIASES = {
    "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctan2": "atan2", "tg": "tan", "arctg": "atan",
    "cosec": "csc", "ctg": "cot", "fabs": "abs", "absolute": "abs",
}  # fmt: skip
RECIPROCALS = {"sec": "cos", "csc": "sin", "cot": "tan"}
FACTORS = 20  # as long is a name that may be a product without signs
WORDS = frozenset({*CALLED, *RECIPROCALS, "pi"})
SHORT = {
    "s": "sin", "S": "sin", "sin": "sin", "sth": "sin", "stheta": "sin",
    "c": "cos", "C": "cos", "cos": "cos", "cth": "cos", "ctheta": "cos",
}  # fmt: skip
JOINTS = ("q", "theta", "th")
NO_PREFIX = {
    *WORDS,
    *SHORT,
    *ALIASES,
    *JOINTS,
    "d",
    "dot",
    "ddot",
    "delta",
    "minus",
    "neg",
}  # d_q1 is no q1


def typed(text: str, names: Collection[str]) -> Expression:
    """Expression of what a student typed, as `parse` reads it and in shorthands that are not themselves names.

    s12, c_23 and S1 are sines and cosines of sums of joints; theta1, th_1 and θ₁ are q1; l_1, L1 and rrt_l1 are l1;
    np.sin, arcsin, sec, sin²(q1), √3 and |q1| are read. Raises ExpressionError, with the place in the text as typed,
    where that is none of it or may be two things.
    """
    with refusing(text):
        return typed_tokens(tokens_of(text, TYPED), names)


def typed_tokens(tokens: Sequence[Token], names: Collection[str]) -> Expression:
    """Expression of the tokens, the last of kind "end", in shorthands; ExpressionError without the text."""
    known = frozenset(names)
    spelled = [long for token in without_bars(tokens) for long in _spelled(token, known)]
    return expression_of(_rearranged(spelled), known)


def _spelled(token: Token, names: frozenset[str]) -> list[Token]:
    """The token, or where it is a shorthand the long form at the same place."""
    readings = _readings(token.text, names) if token.kind == "name" else {token.text}
    if token.text in readings:
        return [token]
    if len(readings) > 1:
        raise ExpressionError(
            f"'{token.text[:40]}' may be {' or '.join(sorted(readings)[:3])}", token.offset
        )
    if not readings:
        _refuse_product(token, names)
        return [token]
    return [
        token._replace(kind=long.kind, text=long.text) for long in tokens_of(readings.pop())[:-1]
    ]


def _refuse_product(token: Token, names: frozenset[str]) -> None:
    """Raises ExpressionError at the second factor of s1c23."""
    name = token.typed
    for cut in range(1, len(name) if len(name) <= FACTORS else 0):
        if _is_product(name[:cut], name[cut:], names):
            raise ExpressionError(
                f"a sign such as * is missing before '{name[cut:]}'", token.offset + cut
            )


def _readings(name: str, names: frozenset[str]) -> set[str]:
    if name in names or name in WORDS:
        return {name}
    return _respelled(name, names) or {
        long for reading in READINGS for long in reading(name, names)
    }


def _is_product(left: str, right: str, names: frozenset[str]) -> bool:
    """Whether both, or the left one and all factors of the right one, are names or shorthands."""
    if not _readings(left.translate(TRANSLATED), names):
        return False
    cuts = range(1, len(right))
    return bool(_readings(right.translate(TRANSLATED), names)) or any(
        _is_product(right[:cut], right[cut:], names) for cut in cuts
    )


def _respelled(name: str, names: frozenset[str]) -> set[str]:
    """l_1 is l1, d3 is d_3."""
    meant = _indexed(name)
    return {name} & names or {known for known in names if _indexed(known) == meant}


def _other_case(name: str, names: frozenset[str]) -> set[str]:
    """L1 is l1."""
    meant = _indexed(name.lower())
    return {known for known in names if _indexed(known.lower()) == meant}


def _prefixed(name: str, names: frozenset[str]) -> set[str]:
    """rrt_d1 is d1; a single letter or what has a meaning of its own is no prefix."""
    cuts = [
        i for i, letter in enumerate(name) if letter == "_" and i > 1 and name[:i] not in NO_PREFIX
    ]
    rests = {name[:i]: name[i + 1 :] for i in cuts if not _has_meaning(name[:i], names)}
    return {
        long for rest in rests.values() for long in _respelled(rest, names) or _joint(rest, names)
    }


def _has_meaning(name: str, names: frozenset[str]) -> bool:
    return name in names or any(reading(name, names) for reading in (_respelled, *SHORTHANDS))


def _function(name: str, names: frozenset[str]) -> set[str]:
    """np.sin, Sin and arcsin are functions of ours, math.pi is pi."""
    module, _, word = name.rpartition(".")
    word = ALIASES.get(word.lower(), word.lower())
    return {word} if module in MODULES and word in WORDS else set()


def _joint(name: str, names: frozenset[str]) -> set[str]:
    """theta1 and th_1 are q1."""
    stem, digits = _indexed(name)
    return {f"{joint}{digits}" for joint in JOINTS if stem in JOINTS and digits} & names


def _sine(name: str, names: frozenset[str]) -> set[str]:
    """s12 is sin(q1 + q2); sin1 may be sin(1) as well."""
    stem, digits = _indexed(name)
    if stem not in SHORT:
        return set()
    found = {f"{SHORT[stem]}({' + '.join(joints)})" for joints in _sums(digits, names)}
    return found | {f"{stem}({digits})" for _ in found if name == stem + digits and stem in WORDS}


def _tangent(name: str, names: frozenset[str]) -> set[str]:
    """t1 may be q1 or tan(q1)."""
    stem, digits = _indexed(name)
    joint = f"q{digits}"
    return {joint, f"tan({joint})"} if stem == "t" and joint in names else set()


SHORTHANDS: tuple[Callable[[str, frozenset[str]], set[str]], ...] = (
    _other_case,
    _function,
    _joint,
    _sine,
    _tangent,
)
READINGS = (*SHORTHANDS, _prefixed)


def _indexed(name: str) -> tuple[str, str]:
    """Stem and index: s_12 is s and 12."""
    stem = name.rstrip("0123456789")
    return stem.removesuffix("_"), name[len(stem) :]


def _sums(digits: str, names: frozenset[str], least: int = 1) -> Iterator[tuple[str, ...]]:
    """The ways to cut digits into rising joints: 12 is q1 and q2, and q12 where there is one."""
    for cut in range(1, min(2, len(digits)) + 1):
        joint = f"q{digits[:cut]}"
        if joint not in names or int(digits[:cut]) < least:
            continue
        if cut == len(digits):
            yield (joint,)
        for rest in _sums(digits[cut:], names, int(digits[:cut]) + 1):
            yield (joint, *rest)


def _rearranged(tokens: Sequence[Token]) -> list[Token]:
    """Tokens where sin²(x) is (sin(x)^2), sec(x) is (1/cos(x)) and √3 is sqrt(3)."""
    rest, found, closings = list(reversed(tokens)), list[Token](), list[list[Token]]()
    while rest:
        token = rest.pop()
        if token.kind == "name" and token.text in WORDS - {"pi"}:
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
    """What stands before the opening bracket of a function's argument, and what behind the closing one."""
    before, behind = [function], list[Token]()
    power = _power(function, rest)
    if function.text in RECIPROCALS and rest[-1].text != "(":
        raise ExpressionError(
            f"{function.text} takes its argument in brackets, as in {function.text}(x)",
            rest[-1].offset,
        )

    def sign(text: str) -> Token:
        return Token("sign", text, function.offset)

    if function.text in RECIPROCALS:
        cosine = function._replace(text=RECIPROCALS[function.text])
        before, behind = (
            [sign("("), Token("number", "1", function.offset), sign("/"), cosine],
            [sign(")")],
        )
    if power:
        before, behind = [sign("("), *before], [*behind, *power, sign(")")]
    return before, behind


def _power(function: Token, rest: list[Token]) -> list[Token]:
    """The power between a function and its argument, taken from the rest."""
    if rest[-1].text != "^":
        return []
    sign, exponent, opening = rest.pop(), rest.pop(), rest[-1:]
    if exponent.text == "-":
        name = function.text
        inverse = f"a{name}(x) or " * (f"a{name}" in CALLED)
        raise ExpressionError(
            f"{name} to a negative power is written {inverse}1/{name}(x)", sign.offset
        )
    if not exponent.text.isdigit() or opening[0].text != "(":
        raise ExpressionError(
            f"a power stands behind the argument, as in {function.text}(x)^2", sign.offset
        )
    return [sign, exponent]


def _rooted(root: Token, rest: list[Token]) -> list[Token]:
    """√3 as sqrt(3); the root of a bracket is sqrt of it."""
    function = Token("name", "sqrt", root.offset)
    if rest[-1].text == "(":
        return [function]
    if rest[-1].kind != "number":
        raise ExpressionError("√ takes a number or brackets, as in √3 or √(x)", rest[-1].offset)
    return [function, Token("sign", "(", root.offset), rest.pop(), Token("sign", ")", root.offset)]
