"""Matrices as students type them: [[a, b], [c, d]], [a, b; c, d], Matrix([[a, b]])."""

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

from ...solutions.expression import Expression
from ...solutions.tokens import ExpressionError, Token, paired, refusing, split, tokens_of
from .bars import without_bars
from .shorthands import MODULES, WORDS
from .typed import TYPED, typed_tokens

ENTRIES = 4096
MATRIX = TYPED | frozenset("[];\n")
WRAPPERS = {  # what a flat list is in them; numpy's matrix makes a row of it, MuPAD's a column
    "Matrix": "column", "MutableDenseMatrix": "column",
    "ImmutableMatrix": "column", "ImmutableDenseMatrix": "column",
    "array": "row", "sym": "row", "matrix": "",
}  # fmt: skip
BRACKETS = "a matrix takes square brackets around all of it, as in [[a, b], [c, d]]"
COMMAS = "entries take commas between them and products a *, as in [[a, 2*b], [c, d]]"
LINE_AFTER_COMMA = f"a line that ends with a comma may go on or not: {BRACKETS}"
LINE_WITH_SIGN = "a line that starts with a sign may be new or not: end the one before with it"
ROW_STARTS = frozenset({"", "[", ";", "&"})  # behind these, a line end ends no row
ROW_ENDS = frozenset({"", "]", ";", "\n", ",", "&"})  # nor before these
Row = list[list[Token]]


def typed_matrix(text: str, names: Collection[str]) -> list[list[Expression]]:
    """Rows of expressions of a typed matrix; a scalar is 1 x 1.

    Rows stand in brackets, or semicolons or lines end them. Entries are read as `typed` reads them.
    A flat list is one row, in sympy's Matrix a column.

    Raises:
        ExpressionError: rows differ in length, spaces stand for commas, a line may be a row or not,
            or there are more than 4096 entries; with the place in the text.
    """
    with refusing(text, "a matrix"):
        tokens = tokens_of(text, MATRIX)
        paired(tokens)
        wrapper, tokens = _unwrapped(without_bars(joined_lines(tokens)), names)
        if tokens[0].text != "[":
            _refuse_brackets(tokens)
            return [[entry_of(tokens, names)]]

        inside = _inside(tokens)
        nested = inside[0].text == "["
        rows = _nested(inside) if nested else _flat(inside, wrapper)
        _check_rows(rows)
        _check_spaces(rows, text, python=nested or wrapper not in ("", "sym"))
        return [_entries(row, names) for row in rows]


def _entries(row: Row, names: Collection[str]) -> list[Expression]:
    return [entry_of(entry, names) for entry in row]


def joined_lines(tokens: Sequence[Token]) -> list[Token]:
    """Tokens without the line ends that end nothing.

    Those are at the edges, in round brackets, and in rows with brackets of their own.
    """
    found = list[Token]()
    inside = list[str]()  # the brackets that are open
    for token, following in pairwise([*tokens, tokens[-1]]):
        if token.text in ("(", "["):
            inside.append(token.text)
        elif token.text in (")", "]"):
            inside.pop()
        before = found[-1].text if found else ""
        if token.text != "\n" or _ends_row(before, following, inside):
            found.append(token)
    return found


def _ends_row(before: str, following: Token, inside: Sequence[str]) -> bool:
    """Whether a line end between two tokens ends a row."""
    if inside[-1:] == ["("] or before in ROW_STARTS or following.text in ROW_ENDS:
        return False
    if before == "," and len(inside) == 1 and following.text != "[":
        raise ExpressionError(LINE_AFTER_COMMA, following.offset)
    if following.text in ("+", "-", "±"):
        raise ExpressionError(LINE_WITH_SIGN, following.offset)
    return before != "," and len(inside) < 2


def _unwrapped(tokens: list[Token], names: Collection[str]) -> tuple[str, list[Token]]:
    """The name and the argument of Matrix(...) or np.array(...); "" and all where there is none."""
    module, _, name = tokens[0].text.rpartition(".")
    known = name in WRAPPERS and name not in names and module in MODULES
    if not known or tokens[1].text != "(":
        return "", tokens
    inside = _inside(tokens[1:])
    if inside[0].text != "[":
        raise ExpressionError(
            f"{name} takes rows in square brackets, as in {name}([[a, b], [c, d]])",
            inside[0].offset,
        )
    return name, inside


def _inside(tokens: Sequence[Token]) -> list[Token]:
    """Tokens between the first, which is a bracket, and its closing one.

    Nothing may stand behind that.
    """
    depth = 1
    place = 0
    while depth:
        place += 1
        if tokens[place].text in ("(", "["):
            depth += 1
        elif tokens[place].text in (")", "]"):
            depth -= 1
    behind = tokens[place + 1]
    if behind.kind != "end":
        raise ExpressionError(
            "nothing stands behind a matrix or a row but the next row", behind.offset
        )
    return [*tokens[1:place], Token("end", "", tokens[place].offset)]


def _refuse_brackets(tokens: Sequence[Token]) -> None:
    for token in tokens:
        if token.text in ("[", "]", ";", "\n"):
            raise ExpressionError(BRACKETS, token.offset)


def _nested(inside: list[Token]) -> list[Row]:
    """Entries of rows that have brackets of their own."""
    rows = without_trailing(split(inside, (",", ";", "\n")))
    for row in rows:
        if row[0].text != "[":
            raise ExpressionError(
                "a row takes square brackets, as the first one has", row[0].offset
            )
    return [split(_inside(row), ",") for row in rows]


def _flat(inside: list[Token], wrapper: str) -> list[Row]:
    """Entries of rows between semicolons or lines; the list in a wrapper is a row or a column."""
    parts = without_trailing(split(inside, (";", "\n")))
    rows = [split(part, ",") for part in parts]
    shape = WRAPPERS.get(wrapper, "row")
    if not shape:
        raise ExpressionError(
            f"{wrapper} takes rows in brackets of their own, as in [[a, b]]", inside[0].offset
        )
    if shape == "column" and len(rows) == 1:
        return [[entry] for entry in rows[0]]
    return rows


def without_trailing(parts: list[list[Token]]) -> list[list[Token]]:
    """The parts without a last one that is empty."""
    if len(parts) > 1 and parts[-1][0].kind == "end":
        return parts[:-1]
    return parts


def _check_rows(rows: list[Row]) -> None:
    """Refuses rows of different lengths, and more entries than are read."""
    columns = len(rows[0])
    for row in rows:
        if len(row) != columns:
            raise ExpressionError(
                f"rows take {columns} entries as the first one has, got {len(row)}",
                row[0][0].offset,
            )
    count = len(rows) * columns
    if count > ENTRIES:
        first_too_many = rows[ENTRIES // columns][ENTRIES % columns]
        raise ExpressionError(
            f"a matrix takes up to {ENTRIES} entries, got {count}", first_too_many[0].offset
        )


def _check_spaces(rows: list[Row], text: str, *, python: bool) -> None:
    """Refuses entries that MATLAB, or a printed array, has as two.

    Those are `a b` and, unless rows are Python's, `a -b`.
    """
    for row in rows:
        signs = not python or len(row) == 1
        for entry in row:
            for before, following in _parted_by_space(entry, text):
                _refuse_second_entry(before, following)
                if signs:
                    _refuse_sign(following, text)


def _parted_by_space(entry: Sequence[Token], text: str) -> Iterator[tuple[Token, Token]]:
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
        return token.text not in WORDS
    return token.kind == "number" or token.text == ")"


def _refuse_second_entry(before: Token, following: Token) -> None:
    opens = following.text in ("(", "√") and before.kind != "name"  # `f (x)` may be a call
    if opens or following.kind in ("number", "name"):
        raise ExpressionError(COMMAS, following.offset)


def _refuse_sign(following: Token, text: str) -> None:
    """Refuses the sign of `a -b`, which is one entry in `a - b`."""
    sign = following.text
    behind = text[following.offset + 1 : following.offset + 2]
    if sign in ("+", "-") and not behind.isspace():
        raise ExpressionError(
            f"this may be one entry or two: write a {sign} b or a, {sign}b", following.offset
        )


def entry_of(tokens: Sequence[Token], names: Collection[str], what: str = "an entry") -> Expression:
    """Expression of the tokens of one entry; `what` they are is named in errors.

    Raises:
        ExpressionError: it is missing or no formula; the error does not have the text.
    """
    start = tokens[0].offset
    if tokens[0].kind == "end":
        raise ExpressionError(f"{what} is missing", start)
    return typed_tokens(tokens, names)
