"""Matrices as students type them: [[a, b], [c, d]], [a, b; c, d], Matrix([[a, b]])."""

from collections.abc import Collection, Sequence
from itertools import pairwise

from ...solutions.expression import Expression
from ...solutions.tokens import ExpressionError, Token, paired, refusing, split, tokens_of
from .bars import without_bars
from .blanks import parted_by_blanks, refuse_blanks
from .degrees import SIGN, in_radians
from .printed import without_assignment
from .shorthands import MODULES
from .typed import TYPED, typed_tokens

ENTRIES = 4096
MATRIX = TYPED | frozenset("[];\n=")
WRAPPERS = {  # what a flat list is in them; numpy's matrix makes a row of it, MuPAD's a column
    "Matrix": "column", "MutableDenseMatrix": "column",
    "ImmutableMatrix": "column", "ImmutableDenseMatrix": "column",
    "array": "row", "sym": "row", "matrix": "",
}  # fmt: skip
BRACKETS = "a matrix takes square brackets around all of it, as in [[a, b], [c, d]]"
LINE_AFTER_COMMA = f"a line that ends with a comma may go on or not: {BRACKETS}"
LINE_WITH_SIGN = "a line that starts with a sign may be new or not: end the one before with it"
ROW_STARTS = frozenset({"", "[", ";", "&"})  # behind these, a line end ends no row
ROW_ENDS = frozenset({"", "]", ";", "\n", ",", "&"})  # nor before these
Row = list[list[Token]]


def typed_matrix(
    text: str, names: Collection[str], columns: int = 0, *, degrees: bool = True
) -> list[list[Expression]]:
    """Rows of expressions of a typed matrix; a scalar is 1 x 1.

    Rows stand in brackets, or semicolons or lines end them. Entries are read as `typed` reads them.
    A flat list is one row, in sympy's Matrix a column. A name and "=" may stand in front.

    Where it is known how many `columns` are asked, blanks may stand between as many entries,
    brackets around all of it may be missing, and the matrices of a stack are put one below the
    other. Without `degrees`, angles in them are refused.

    Raises:
        ExpressionError: rows differ in length, a blank may be a comma or not, a line may be a row
            or not, or there are more than 4096 entries; with the place in the text.
    """
    with refusing(text, "a matrix") as seen:
        tokens = tokens_of(seen, MATRIX | {SIGN} if degrees else MATRIX)
        if degrees:
            tokens = in_radians(tokens, names)
        paired(tokens)
        tokens = joined_lines(without_assignment(tokens, names), known=columns > 0)
        wrapper, tokens = _unwrapped(without_bars(tokens), names)
        if not _is_matrix(tokens, columns):
            _refuse_brackets(tokens)
            return [[entry_of(tokens, names)]]

        rows, python = _rows(tokens, wrapper, columns)
        rows = [_parted(row, seen, columns) for row in rows]
        _check_rows(rows)
        _check_spaces(rows, seen, python=python)
        return [_entries(row, names) for row in rows]


def _is_matrix(tokens: Sequence[Token], columns: int) -> bool:
    if tokens[0].text == "[":
        return True
    return columns > 0 and all(token.text != "[" for token in tokens)


def _rows(tokens: list[Token], wrapper: str, columns: int) -> tuple[list[Row], bool]:
    """Entries of the rows, and whether they are written as Python writes them."""
    written_as_python = wrapper not in ("", "sym")
    if tokens[0].text != "[":
        return _flat(tokens, wrapper), written_as_python

    lines = split(tokens, "\n")
    on_lines = len(lines) > 1 and all(line[0].text == "[" for line in lines)
    inside = tokens if on_lines else _inside(tokens)  # MATLAB prints a bracket a line
    if inside[0].text == "[":
        return _nested(inside, known=columns > 0), True
    return _flat(inside, wrapper), written_as_python


def _parted(row: Row, text: str, columns: int) -> Row:
    """The row, or the entries that stand between blanks where they are as many as are asked."""
    if columns < 2 or len(row) != 1:
        return row
    entries = parted_by_blanks(row[0], text)
    return entries if len(entries) == columns else row


def _entries(row: Row, names: Collection[str]) -> list[Expression]:
    return [entry_of(entry, names) for entry in row]


def joined_lines(tokens: Sequence[Token], *, known: bool = False) -> list[Token]:
    """Tokens without the line ends that end nothing.

    Those are at the edges, in round brackets, and in rows with brackets of their own. Where the
    shape is `known`, a line may start with a sign.
    """
    found = list[Token]()
    inside = list[str]()  # the brackets that are open
    for token, following in pairwise([*tokens, tokens[-1]]):
        if token.text in ("(", "["):
            inside.append(token.text)
        elif token.text in (")", "]"):
            inside.pop()
        before = found[-1].text if found else ""
        if token.text != "\n" or _ends_row(before, following, inside, known=known):
            found.append(token)
    return found


def _ends_row(before: str, following: Token, inside: Sequence[str], *, known: bool) -> bool:
    """Whether a line end between two tokens ends a row."""
    if inside[-1:] == ["("] or before in ROW_STARTS or following.text in ROW_ENDS:
        return False
    if before == "," and len(inside) == 1 and following.text != "[":
        raise ExpressionError(LINE_AFTER_COMMA, following.offset)
    if following.text in ("+", "-", "±") and not known:
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


def _nested(inside: list[Token], *, known: bool) -> list[Row]:
    """Entries of rows that have brackets of their own.

    Where the shape is `known`, a blank may stand between rows and rows in the matrices of a stack.
    """
    if known:
        inside = _with_separators(inside)
    rows = without_trailing(split(inside, (",", ";", "\n")))
    for row in rows:
        if row[0].text != "[":
            raise ExpressionError(
                "a row takes square brackets, as the first one has", row[0].offset
            )
    insides = [_inside(row) for row in rows]
    if not known or any(entries[0].text != "[" for entries in insides):
        return [split(entries, ",") for entries in insides]
    found: list[Row] = []
    for matrix in insides:
        found += _nested(_with_separators(matrix), known=False)
    return found


def _with_separators(tokens: Sequence[Token]) -> list[Token]:
    """Tokens with a semicolon between brackets that close and open right behind one another."""
    found = list[Token]()
    for token in tokens:
        if found and found[-1].text == "]" and token.text == "[":
            found.append(Token("sign", ";", token.offset))
        found.append(token)
    return found


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
        for entry in row:
            refuse_blanks(entry, text, signs=not python or len(row) == 1)


def entry_of(tokens: Sequence[Token], names: Collection[str], what: str = "an entry") -> Expression:
    """Expression of the tokens of one entry; `what` they are is named in errors.

    Raises:
        ExpressionError: it is missing or no formula; the error does not have the text.
    """
    start = tokens[0].offset
    if tokens[0].kind == "end":
        raise ExpressionError(f"{what} is missing", start)
    return typed_tokens(tokens, names)
