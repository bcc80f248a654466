"""Matrices and conditions as students type them: [[a, b], [c, d]], [a, b; c, d], sin(q2) = 0 or q3 = 0."""

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

from .expression import Expression
from .tokens import LENGTH, ExpressionError, Token, paired, refusing, split, tokens_of
from .typed import MODULES, TYPED, WORDS, typed_tokens

ENTRIES, MATRIX_LENGTH = 4096, 20_000
EQUATIONS, EQUATIONS_LENGTH = 64, 2000
MATRIX, EQUATION = TYPED | frozenset("[];\n"), TYPED | frozenset("=±;\n")
WRAPPERS = {  # what a flat list is in them; numpy's matrix makes a row of it, MuPAD's a column
    "Matrix": "column", "MutableDenseMatrix": "column", "ImmutableMatrix": "column", "ImmutableDenseMatrix": "column",
    "array": "row", "sym": "row", "matrix": "",
}  # fmt: skip
FREE, INTEGERS = ("k", "n", "m"), range(-4, 5)
BRACKETS = "a matrix takes square brackets around all of it, as in [[a, b], [c, d]]"
Entries = list[list[Token]]


def typed_matrix(text: str, names: Collection[str]) -> list[list[Expression]]:
    """Rows of expressions of a typed matrix: rows in brackets, or ended by semicolons or lines; a scalar is 1 x 1.

    Entries are read as `typed` reads them. A flat list is one row, in sympy's Matrix a column. Raises ExpressionError,
    with the place in the text, where rows differ in length, spaces stand for commas, a line may be a row or not, or
    there are more than 4096 entries.
    """
    with refusing(text, "a matrix"):
        tokens = tokens_of(text, MATRIX, MATRIX_LENGTH)
        paired(tokens)
        wrapper, tokens = _unwrapped(_joined(tokens), names)
        if tokens[0].text != "[":
            return [[_entry(_without_brackets(tokens), names)]]
        inside = _inside(tokens)
        nested = inside[0].text == "["
        rows = _nested(inside) if nested else _flat(inside, wrapper)
        _check_rows(rows)
        python = nested or wrapper not in ("", "sym")
        for row in rows:
            for entry in row:
                _check_spaces(entry, text, python and len(row) > 1)
        return [[_entry(entry, names) for entry in row] for row in rows]


def typed_equations(text: str, names: Collection[str]) -> list[Expression]:
    """Left side minus right side of each typed condition; without "=" it is the formula that is to be zero.

    Conditions stand between semicolons, commas, lines or "or"; `q2 = 0, pi` and `q2 = ±pi/2` are two; in `q2 = k*pi`
    a k, n or m that is no name runs from -4 to 4. Raises ExpressionError with the place in the text.
    """
    with refusing(text, "a condition"):
        tokens = [_or(token, names) for token in tokens_of(text, EQUATION, EQUATIONS_LENGTH)]
        paired(tokens)
        tokens = _joined(tokens)
        _check_decimals(tokens)
        return [_difference(variant, names) for part in _equations(tokens, names) for variant in _variants(part, names)]


def _joined(tokens: Sequence[Token]) -> list[Token]:
    """Tokens without the line ends that end nothing: at the edges, in round brackets, in rows with own brackets."""
    found, inside = list[Token](), list[str]()
    for token, following in pairwise([*tokens, tokens[-1]]):
        if token.text in ("(", "["):
            inside.append(token.text)
        elif token.text in (")", "]"):
            inside.pop()
        if token.text != "\n" or _ends_row(found[-1].text if found else "", following, inside):
            found.append(token)
    return found


def _ends_row(before: str, following: Token, inside: Sequence[str]) -> bool:
    if inside[-1:] == ["("] or before in ("", "[", ";") or following.text in ("", "]", ";", "\n", ","):
        return False
    if before == "," and len(inside) == 1 and following.text != "[":
        raise ExpressionError("a line that ends with a comma may go on or not: " + BRACKETS, following.offset)
    if following.text in ("+", "-", "±"):
        raise ExpressionError(
            "a line that starts with a sign may be new or not: end the one before with it", following.offset
        )
    return before != "," and len(inside) < 2


def _unwrapped(tokens: list[Token], names: Collection[str]) -> tuple[str, list[Token]]:
    """The name and the argument of Matrix(...) or np.array(...); "" and the tokens where there is none."""
    module, _, name = tokens[0].text.rpartition(".")
    if name not in WRAPPERS or name in names or module not in MODULES or tokens[1].text != "(":
        return "", tokens
    inside = _inside(tokens[1:])
    if inside[0].text != "[":
        raise ExpressionError(f"{name} takes rows in square brackets, as in {name}([[a, b], [c, d]])", inside[0].offset)
    return name, inside


def _inside(tokens: Sequence[Token]) -> list[Token]:
    """Tokens between the first, which is a bracket, and its closing one, behind which nothing may stand."""
    depth, place = 1, 0
    while depth:
        place += 1
        depth += (tokens[place].text in ("(", "[")) - (tokens[place].text in (")", "]"))
    if tokens[place + 1].kind != "end":
        raise ExpressionError("nothing stands behind a matrix or a row but the next row", tokens[place + 1].offset)
    return [*tokens[1:place], Token("end", "", tokens[place].offset)]


def _without_brackets(tokens: list[Token]) -> list[Token]:
    for token in tokens:
        if token.text in ("[", "]", ";", "\n"):
            raise ExpressionError(BRACKETS, token.offset)
    return tokens


def _nested(inside: list[Token]) -> list[Entries]:
    """Entries of rows that have brackets of their own."""
    rows = _without_trailing(split(inside, (",", ";", "\n")))
    for row in rows:
        if row[0].text != "[":
            raise ExpressionError("a row takes square brackets, as the first one has", row[0].offset)
    return [split(_inside(row), ",") for row in rows]


def _flat(inside: list[Token], wrapper: str) -> list[Entries]:
    """Entries of rows between semicolons or lines; the list in a wrapper is a row or a column."""
    rows = [split(row, ",") for row in _without_trailing(split(inside, (";", "\n")))]
    shape = WRAPPERS.get(wrapper, "row")
    if not shape:
        raise ExpressionError(f"{wrapper} takes rows in brackets of their own, as in [[a, b]]", inside[0].offset)
    return [[entry] for entry in rows[0]] if shape == "column" and len(rows) == 1 else rows


def _without_trailing(parts: list[list[Token]]) -> list[list[Token]]:
    return parts[:-1] if len(parts) > 1 and parts[-1][0].kind == "end" else parts


def _check_rows(rows: list[Entries]) -> None:
    for row in rows:
        if len(row) != len(rows[0]):
            raise ExpressionError(
                f"rows take {len(rows[0])} entries as the first one has, got {len(row)}", row[0][0].offset
            )
    entries = [entry for row in rows for entry in row]
    if len(entries) > ENTRIES:
        raise ExpressionError(f"a matrix takes up to {ENTRIES} entries, got {len(entries)}", entries[ENTRIES][0].offset)


def _check_spaces(entry: Sequence[Token], text: str, python: bool) -> None:
    """Refuse an entry that MATLAB, or a printed array, has as two: `a b` and, unless rows are Python's, `a -b`."""
    depth = 0
    for token, following in pairwise(entry):
        depth += (token.text == "(") - (token.text == ")")
        ends = token.text == ")" or token.kind == "number" or (token.kind == "name" and token.text not in WORDS)
        if depth or not ends or not text[following.offset - 1].isspace():
            continue
        opens = following.text in ("(", "√") and token.kind != "name"
        if opens or following.kind in ("number", "name"):
            raise ExpressionError(
                "entries take commas between them and products a *, as in [[a, 2*b], [c, d]]", following.offset
            )
        if (
            following.text in ("+", "-")
            and not python
            and not text[following.offset + 1 : following.offset + 2].isspace()
        ):
            raise ExpressionError(
                f"this may be one entry or two: write a {following.text} b or a, {following.text}b", following.offset
            )


def _entry(tokens: Sequence[Token], names: Collection[str], what: str = "an entry") -> Expression:
    if tokens[0].kind == "end":
        raise ExpressionError(f"{what} is missing", tokens[0].offset)
    if (long := tokens[-1].offset - tokens[0].offset) > LENGTH:
        raise ExpressionError(f"{what} takes up to {LENGTH} characters, got {long}", tokens[0].offset + LENGTH)
    return typed_tokens(tokens, names)


def _or(token: Token, names: Collection[str]) -> Token:
    """The token, or a semicolon for the word "or"."""
    word = token.text.lower() if token.kind == "name" and token.text not in names else ""
    if word == "and":
        raise ExpressionError("conditions are listed with or or with semicolons, got and", token.offset)
    return Token("sign", ";", token.offset) if word == "or" else token


def _check_decimals(tokens: Sequence[Token]) -> None:
    for before, comma, behind in zip(tokens, tokens[1:], tokens[2:], strict=False):
        if (before.kind, comma.text, behind.kind) == ("number", ",", "number") and behind.offset == comma.offset + 1:
            raise ExpressionError("a decimal number takes a point, as in 3.14, got a comma", comma.offset)


def _equations(tokens: Sequence[Token], names: Collection[str]) -> Iterator[list[Token]]:
    """Tokens of each condition with both sides; `= 0` where none has "=", and `q2 = 0, pi` goes on with q2."""
    parts = _without_trailing(split(tokens, (",", ";", "\n")))
    if len(parts) > EQUATIONS:
        raise ExpressionError(f"up to {EQUATIONS} conditions are read, got {len(parts)}", parts[EQUATIONS][0].offset)
    sides = [split(part, "=") for part in parts]
    written = any(len(both) > 1 for both in sides)
    left = list[Token]()
    for part, (first, *more) in zip(parts, sides, strict=True):
        place = part[-1].offset
        if len(more) > 1:
            raise ExpressionError("a = b = c takes two equations, a = b; b = c", more[0][-1].offset)
        if more:
            left = first
            yield part
        elif not written:
            yield [*part[:-1], Token("sign", "=", place), Token("number", "0", place), Token("end", "", place)]
        elif left and part[:-1] and all(_is_constant(token, names) for token in part):
            yield [*left[:-1], Token("sign", "=", left[-1].offset), *part]
        else:
            raise ExpressionError("an equation takes two sides, as in q2 = 0", part[0].offset)


def _is_constant(token: Token, names: Collection[str]) -> bool:
    return token.kind != "name" or token.text in WORDS or (token.text in FREE and token.text not in names)


def _variants(tokens: Sequence[Token], names: Collection[str]) -> Iterator[list[Token]]:
    """The condition for each value of its free integer and for both signs of its ±."""
    signed = _plus_minus(tokens)
    free = [token for token in tokens if token.kind == "name" and token.text in FREE and token.text not in names]
    for token in [token for token in free if token.text != free[0].text]:
        raise ExpressionError("an equation takes one free integer", token.offset)
    for token in [token for token in signed if token.text == "±"][1:]:
        raise ExpressionError("an equation takes one ±", token.offset)
    for value in INTEGERS if free else (0,):
        whole = [part for token in signed for part in (_integer(token, value) if token in free else [token])]
        for sign in "+-" if any(token.text == "±" for token in whole) else "+":
            yield [token._replace(text=sign) if token.text == "±" else token for token in whole]


def _plus_minus(tokens: Sequence[Token]) -> list[Token]:
    """Tokens where +- without a space is ±."""
    found = list[Token]()
    for token in tokens:
        if token.text == "-" and found and found[-1].text == "+" and found[-1].offset + 1 == token.offset:
            found[-1] = found[-1]._replace(text="±")
        else:
            found.append(token)
    return found


def _integer(token: Token, value: int) -> list[Token]:
    sign, digits = "-" if value < 0 else "+", str(abs(value))
    signs = [token._replace(kind="sign", text=text) for text in ("(", sign, ")")]
    return [*signs[:2], token._replace(kind="number", text=digits), signs[2]]


def _difference(equation: Sequence[Token], names: Collection[str]) -> Expression:
    left, right = (_entry(side, names, "a side of the equation") for side in split(equation, "="))
    if not left.names | right.names:
        raise ExpressionError("a condition takes a joint or another name, as in q2 = 0", equation[0].offset)
    if right.nodes == (("n", 0.0),):
        return left
    shift = len(left.nodes)
    moved = [node if node[0] in ("n", "s") else (node[0], *(int(i) + shift for i in node[1:])) for node in right.nodes]
    last = shift + len(moved)
    return Expression((*left.nodes, *moved, ("-", shift - 1, last - 1)))
