"""Numbers, text, matrices and cell arrays as MATLAB writes them, where nothing is computed."""

from collections.abc import Sequence
from typing import Any, cast

from ...solutions.expression import CALLED
from ...solutions.plain_number import plain_number
from .matlab_statements import Token

DEPTH = 6  # of brackets inside one another
KNOWN = frozenset({*CALLED, "pi", "sec", "csc", "cot", "Inf", "NaN", "inf", "nan"})
"""Names that a typed answer may have; every other one is computed before."""
OPERATORS = {".*": "*", "./": "/", ".^": "^"}
CALCULATED = frozenset({"+", "-", "*", "/", "^", *OPERATORS})
OPENING = {"[": "]", "{": "}", "(": ")"}
TRANSPOSE = ("'", ".'")
NEWLINE = ("newline", "10")  # between the texts of several lines
Grid = list[list[Any]]


class NotLiteralError(ValueError):
    """What is computed, or no value at all."""


def literal_value(tokens: Sequence[Token]) -> Any:
    """The value as nested lists of numbers and text; None where it is empty, as [] and '' are.

    Entries are numbers, or text such as "sqrt(3)/2", which is read as a typed answer. A matrix is a
    list of rows; a cell array is one too, unless it holds matrices: then it is their list.

    Raises:
        NotLiteralError: it takes MATLAB to know it.
    """
    return _value(tokens, DEPTH)


def _value(tokens: Sequence[Token], depth: int) -> Any:
    shown = [token for token in tokens if token.kind != "line"]
    if not shown or depth == 0:
        raise NotLiteralError
    first = shown[0]
    if len(shown) == 1 and first.kind == "text":
        return first.text or None
    if first.text not in ("[", "{") or first.kind == "text":
        return _entry(shown)

    last = len(tokens)
    turned = False
    while tokens[last - 1].text in TRANSPOSE and tokens[last - 1].kind == "sign":
        turned = not turned
        last -= 1
    rows = _rows(_inside(tokens[:last]))
    value = _matrix(rows, depth) if first.text == "[" else _cells(rows, depth)
    if turned and isinstance(value, list):
        return [list(column) for column in zip(*cast("Grid", value), strict=True)]
    return value


def _inside(tokens: Sequence[Token]) -> Sequence[Token]:
    """What stands between the first bracket and the last, which have to be a pair."""
    depth = 0
    for place, token in enumerate(tokens):
        if token.kind != "sign":
            continue
        if token.text in OPENING:
            depth += 1
        elif token.text in OPENING.values():
            depth -= 1
        if depth == 0 and place + 1 < len(tokens):  # something comes behind the pair
            raise NotLiteralError
    if depth or tokens[-1].text != OPENING[tokens[0].text]:
        raise NotLiteralError
    return tokens[1:-1]


def _rows(tokens: Sequence[Token]) -> list[list[list[Token]]]:
    """The entries of rows, as MATLAB parts them: by commas and blanks, semicolons and lines."""
    rows: list[list[list[Token]]] = [[]]
    entry: list[Token] = []
    depth = 0
    for place, token in enumerate(tokens):
        following = tokens[place + 1] if place + 1 < len(tokens) else None
        if depth == 0 and (token.kind == "line" or _is_sign(token, ";", ",")):
            _close(rows, entry)
            entry = []
            if token.text != ",":
                rows.append([])
            continue
        if depth == 0 and entry and _begins_entry(entry[-1], token, following):
            _close(rows, entry)
            entry = []
        if token.kind == "sign":
            depth += token.text in OPENING
            depth -= token.text in OPENING.values()
        entry.append(token)
    _close(rows, entry)
    return [row for row in rows if row]


def _close(rows: list[list[list[Token]]], entry: list[Token]) -> None:
    if entry:
        rows[-1].append(entry)


def _is_sign(token: Token, *signs: str) -> bool:
    return token.kind == "sign" and token.text in signs


def _begins_entry(before: Token, token: Token, following: Token | None) -> bool:
    """Whether a blank before a token parts two entries: `1 -2` are two, `1 - 2` is one."""
    if not token.spaced or (_is_sign(before, *CALCULATED)):
        return False
    if _is_sign(token, "+", "-"):
        return following is not None and not following.spaced
    return token.kind != "sign" or token.text in OPENING


def _matrix(rows: list[list[list[Token]]], depth: int) -> Any:
    """Rows of entries; text beside text is one text."""
    if not rows:
        return None
    if any(entry[0].kind == "text" for row in rows for entry in row):
        return _joined_text(rows)
    found: Grid = []
    for row in rows:
        found += _beside([_grid(_value(entry, depth - 1)) for entry in row])
    return found


def _grid(value: Any) -> Grid:
    """A value as rows; one number alone is one row of one."""
    if isinstance(value, list):
        return cast("Grid", value)
    return [[value]]


def _beside(grids: Sequence[Grid]) -> Grid:
    """Matrices put beside one another."""
    heights = {len(grid) for grid in grids}
    if len(heights) > 1:
        raise NotLiteralError
    found: Grid = []
    for parts in zip(*grids, strict=True):
        row: list[Any] = []
        for part in parts:
            row += part
        found.append(row)
    return found


def _joined_text(rows: list[list[list[Token]]]) -> Any:
    lines: list[str] = []
    for row in rows:
        said = ""
        for entry in row:
            if len(entry) != 1:
                raise NotLiteralError
            said += _piece_of_text(entry[0])
        lines.append(said)
    return lines[0] if len(lines) == 1 else lines


def _piece_of_text(token: Token) -> str:
    if token.kind == "text":
        return token.text
    if token.text in NEWLINE:
        return "\n"
    raise NotLiteralError


def _cells(rows: list[list[list[Token]]], depth: int) -> Any:
    found: Grid = []
    for row in rows:
        found.append([_cell(entry, depth - 1) for entry in row])
    cells = [cell for row in found for cell in row]
    if all(cell is None for cell in cells):
        return None
    if any(isinstance(cell, list) for cell in cells):
        return cells
    return found


def _cell(entry: list[Token], depth: int) -> Any:
    """The content of a cell; a cell array of one row in it is a list."""
    value = _value(entry, depth)
    if entry[0].text == "{" and isinstance(value, list):
        rows = cast("Grid", value)
        return rows[0] if len(rows) == 1 else rows
    return value


def _entry(tokens: Sequence[Token]) -> float | str:
    """A number, or the text of one that a typed answer may have."""
    text = ""
    for token in tokens:
        if token.kind == "text" or (token.kind == "name" and token.text not in KNOWN):
            raise NotLiteralError
        if token.kind == "sign" and token.text not in CALCULATED | {"(", ")", ","}:
            raise NotLiteralError
        text += OPERATORS.get(token.text, token.text)
    number = plain_number(text)
    return text if number is None else number
