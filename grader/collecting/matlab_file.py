"""Answers in a MATLAB script: what is typed is read, what is computed is not, and says so."""

from collections.abc import Sequence
from typing import Any, cast

from .ask import Ask
from .matlab_literals import NotLiteralError, literal_value
from .matlab_statements import Statement, assigned, statements
from .named_matrices import every
from .nested_values import raw_value
from .wire import Raw

MAX_BYTES = 1 << 20
COMPUTED = (
    "{name} is computed in line {line}, and MATLAB is not run when a sheet is marked: run the "
    "script and hand in the .mat file that save('answers.mat', '{name}', '-v7') writes, or type "
    "the values, as in {name} = [0.5 1; 0 2];"
)


def from_m(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values that a script assigns as they stand: numbers, text, matrices and cell arrays of them.

    The last assignment counts. Where that is computed, stands in a loop, a condition or a function,
    or changes a part of what was there, the value is an error that says how to hand it in.
    """
    if len(data) > MAX_BYTES:
        return every(asks, f"the script has more than {MAX_BYTES >> 20} MB; hand in a .mat file")
    last: dict[str, Statement] = {}
    for statement in statements(_text(data)):
        for name in _names(statement):
            last[name] = statement
    return {ask.name: _raw(ask, last.get(ask.name)) for ask in asks}


def _names(statement: Statement) -> list[str]:
    """Names that a statement sets; of a function, its own as well."""
    if statement.tokens[0].text == "function":
        return [token.text for token in statement.tokens if token.kind == "name"]
    names, _ = assigned(statement.tokens)
    return names


def _text(data: bytes) -> str:
    """The text of a script; older ones are not UTF-8."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def _raw(ask: Ask, statement: Statement | None) -> Raw:
    if statement is None:
        return Raw("missing")
    computed = Raw("error", COMPUTED.format(name=ask.name, line=statement.line))
    _, tokens = assigned(statement.tokens)
    if tokens is None or statement.inside:
        return computed
    try:
        value = literal_value(tokens)
    except NotLiteralError:
        return computed
    if ask.calls:
        value = _results(value)
    return raw_value(value, ask)


def _results(value: Any) -> Any:
    """Results of calls, which a cell array holds in one row or column."""
    if not isinstance(value, list):
        return value
    rows = cast("list[Any]", value)
    if all(isinstance(row, list) and len(cast("list[Any]", row)) == 1 for row in rows):
        return [row[0] for row in rows]
    if len(rows) == 1:
        return rows[0]
    return rows
