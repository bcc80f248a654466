"""Matrices as students type them: [[a, b], [c, d]], [a, b; c, d], Matrix([[a, b]])."""

from collections.abc import Collection, Sequence
from itertools import pairwise

from ...solutions.expression import Expression
from ...solutions.tokens import LENGTH, ExpressionError, Token, paired, refusing, split, tokens_of
from .bars import without_bars
from .typed import MODULES, TYPED, WORDS, typed_tokens

ENTRIES, MATRIX_LENGTH = 4096, 20_000
MATRIX = TYPED | frozenset("[];\n")
WRAPPERS = {  # what a flat list is in them; numpy's matrix makes a row of it, MuPAD's a column
    "Matrix": "column", "MutableDenseMatrix": "column", "ImmutableMatrix": "column", "ImmutableDenseMatrix": "column",
    "array": "row", "sym": "row", "matrix": "",
}  # fmt: skip
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
        wrapper, tokens = _unwrapped(without_bars(joined_lines(tokens)), names)
        if tokens[0].text != "[":
            return [[entry_of(_without_brackets(tokens), names)]]
        inside = _inside(tokens)
        nested = inside[0].text == "["
        rows = _nested(inside) if nested else _flat(inside, wrapper)
        _check_rows(rows)
        python = nested or wrapper not in ("", "sym")
        for row in rows:
            for entry in row:
                _check_spaces(entry, text, python and len(row) > 1)
        return [[entry_of(entry, names) for entry in row] for row in rows]


def joined_lines(tokens: Sequence[Token]) -> list[Token]:
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
    if (
        inside[-1:] == ["("]
        or before in ("", "[", ";", "&")
        or following.text in ("", "]", ";", "\n", ",", "&")
    ):
        return False
    if before == "," and len(inside) == 1 and following.text != "[":
        raise ExpressionError(
            "a line that ends with a comma may go on or not: " + BRACKETS, following.offset
        )
    if following.text in ("+", "-", "±"):
        raise ExpressionError(
            "a line that starts with a sign may be new or not: end the one before with it",
            following.offset,
        )
    return before != "," and len(inside) < 2


def _unwrapped(tokens: list[Token], names: Collection[str]) -> tuple[str, list[Token]]:
    """The name and the argument of Matrix(...) or np.array(...); "" and the tokens where there is none."""
    module, _, name = tokens[0].text.rpartition(".")
    if name not in WRAPPERS or name in names or module not in MODULES or tokens[1].text != "(":
        return "", tokens
    inside = _inside(tokens[1:])
    if inside[0].text != "[":
        raise ExpressionError(
            f"{name} takes rows in square brackets, as in {name}([[a, b], [c, d]])",
            inside[0].offset,
        )
    return name, inside


def _inside(tokens: Sequence[Token]) -> list[Token]:
    """Tokens between the first, which is a bracket, and its closing one, behind which nothing may stand."""
    depth, place = 1, 0
    while depth:
        place += 1
        depth += (tokens[place].text in ("(", "[")) - (tokens[place].text in (")", "]"))
    if tokens[place + 1].kind != "end":
        raise ExpressionError(
            "nothing stands behind a matrix or a row but the next row", tokens[place + 1].offset
        )
    return [*tokens[1:place], Token("end", "", tokens[place].offset)]


def _without_brackets(tokens: list[Token]) -> list[Token]:
    for token in tokens:
        if token.text in ("[", "]", ";", "\n"):
            raise ExpressionError(BRACKETS, token.offset)
    return tokens


def _nested(inside: list[Token]) -> list[Entries]:
    """Entries of rows that have brackets of their own."""
    rows = without_trailing(split(inside, (",", ";", "\n")))
    for row in rows:
        if row[0].text != "[":
            raise ExpressionError(
                "a row takes square brackets, as the first one has", row[0].offset
            )
    return [split(_inside(row), ",") for row in rows]


def _flat(inside: list[Token], wrapper: str) -> list[Entries]:
    """Entries of rows between semicolons or lines; the list in a wrapper is a row or a column."""
    rows = [split(row, ",") for row in without_trailing(split(inside, (";", "\n")))]
    shape = WRAPPERS.get(wrapper, "row")
    if not shape:
        raise ExpressionError(
            f"{wrapper} takes rows in brackets of their own, as in [[a, b]]", inside[0].offset
        )
    return [[entry] for entry in rows[0]] if shape == "column" and len(rows) == 1 else rows


def without_trailing(parts: list[list[Token]]) -> list[list[Token]]:
    """The parts without a last one that is empty."""
    return parts[:-1] if len(parts) > 1 and parts[-1][0].kind == "end" else parts


def _check_rows(rows: list[Entries]) -> None:
    for row in rows:
        if len(row) != len(rows[0]):
            raise ExpressionError(
                f"rows take {len(rows[0])} entries as the first one has, got {len(row)}",
                row[0][0].offset,
            )
    entries = [entry for row in rows for entry in row]
    if len(entries) > ENTRIES:
        raise ExpressionError(
            f"a matrix takes up to {ENTRIES} entries, got {len(entries)}",
            entries[ENTRIES][0].offset,
        )


def _check_spaces(entry: Sequence[Token], text: str, python: bool) -> None:
    """Refuse an entry that MATLAB, or a printed array, has as two: `a b` and, unless rows are Python's, `a -b`."""
    depth = 0
    for token, following in pairwise(entry):
        depth += (token.text == "(") - (token.text == ")")
        ends = (
            token.text == ")"
            or token.kind == "number"
            or (token.kind == "name" and token.text not in WORDS)
        )
        if depth or not ends or not text[following.offset - 1].isspace():
            continue
        opens = following.text in ("(", "√") and token.kind != "name"
        if opens or following.kind in ("number", "name"):
            raise ExpressionError(
                "entries take commas between them and products a *, as in [[a, 2*b], [c, d]]",
                following.offset,
            )
        if (
            following.text in ("+", "-")
            and not python
            and not text[following.offset + 1 : following.offset + 2].isspace()
        ):
            raise ExpressionError(
                f"this may be one entry or two: write a {following.text} b or a, {following.text}b",
                following.offset,
            )


def entry_of(tokens: Sequence[Token], names: Collection[str], what: str = "an entry") -> Expression:
    """Expression of the tokens of one entry; ExpressionError, without the text, where it is missing or too long."""
    if tokens[0].kind == "end":
        raise ExpressionError(f"{what} is missing", tokens[0].offset)
    if (long := tokens[-1].offset - tokens[0].offset) > LENGTH:
        raise ExpressionError(
            f"{what} takes up to {LENGTH} characters, got {long}", tokens[0].offset + LENGTH
        )
    return typed_tokens(tokens, names)
