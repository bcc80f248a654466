"""Answers handed in without a notebook: JSON and CSV files of named values, as raw values."""

import csv
import json
import re
from collections.abc import Sequence
from typing import Any, cast

from ...solutions.plain_number import plain_number
from .ask import MAX_CALLS, Ask
from .nested_values import raw_value
from .semicolons import Ambiguous, rows_of
from .wire import MAX_ELEMENTS, Raw

MAX_BYTES = 2 << 20
MAX_MARKS = 50_000  # of what stands between values or nests them, in a whole file
HEAD = re.compile(r"(?P<name>\w+)(?:\s+(?P<call>[0-9]{1,4}))?\s*:?")
TWICE = object()
"""The value of a name that has several."""
Rows = list[list[str]]


class TooLarge(ValueError):
    """A file that cannot be one of answers alone."""


def from_json(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a JSON object such as {"rrt_J": [[...], ...]}.

    A broken file is an error of every answer; a name that stands there twice is one of its own.
    The results of published calls are a list, one result after another. Half a surrogate pair in a
    text, which no file could hold, becomes the replacement character.
    """
    try:
        text = _decode(data, ",:[{")
        content: Any = json.loads(text, parse_int=float, object_pairs_hook=_each_once)
    except TooLarge as error:
        return every(asks, str(error))
    except (ValueError, RecursionError) as error:
        return every(asks, f"the file is not JSON: {error}")
    if not isinstance(content, dict):
        return every(asks, "the file takes a JSON object of names and matrices")

    values = cast("dict[str, Any]", content)
    return {ask.name: _of_json(values.get(ask.name), ask) for ask in asks}


def _each_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object in which a name that stands in it twice has `TWICE` for a value."""
    values: dict[str, Any] = {}
    for name, value in pairs:
        values[name] = TWICE if name in values else value
    return values


def _of_json(value: Any, ask: Ask) -> Raw:
    return _stands_twice(ask) if value is TWICE else raw_value(value, ask)


def _stands_twice(ask: Ask) -> Raw:
    return Raw("error", f"{ask.name} stands twice in the file; only one of them can be meant")


def from_csv(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a CSV file: a line with a name, then the rows of that matrix, and so on.

    The matrices of a stack, such as three 4 x 4 transforms, follow one another. The results of
    published calls follow lines with the name and a number: `name 1`, `name 2` and so on. Cells are
    numbers or text; a text with commas stands in double quotes, where it may hold line breaks too.
    One cell alone is read as it is, anything else as rows. A line that stands there twice is an
    error of its name. Files with semicolons between cells and
    commas in decimals are read where there is no doubt that they are.
    """
    known = {ask.name: ask for ask in asks}
    try:
        rows = rows_of(_decode(data, ",;()\r\n"))
    except (Ambiguous, TooLarge) as error:
        return every(asks, str(error))
    except (ValueError, csv.Error) as error:
        return every(asks, f"the file is not CSV: {error}")

    blocks, twice = _blocks(rows, known)
    found: dict[str, Raw] = {}
    for name, ask in known.items():
        found[name] = _stands_twice(ask) if name in twice else _of_blocks(blocks[name], ask)
    return found


def every(asks: Sequence[Ask], reason: str) -> dict[str, Raw]:
    """One reason why there is no answer, for all of them."""
    return {ask.name: Raw("error", reason) for ask in asks}


def _decode(data: bytes, marks: str) -> str:
    """The text of a file.

    It is refused before it is taken apart where it has far more parts than any answers have.
    """
    if len(data) > MAX_BYTES:
        raise TooLarge(f"the file has more than {MAX_BYTES >> 20} MB; hand in only your answers")
    count = sum(data.count(mark.encode()) for mark in marks)
    if count > MAX_MARKS:
        raise TooLarge(
            f"the file has more than {MAX_MARKS} values, lines or brackets; "
            "hand in only your answers"
        )
    return data.decode("utf-8-sig")


def _blocks(rows: Rows, known: dict[str, Ask]) -> tuple[dict[str, dict[int, Rows]], set[str]]:
    """Rows by name and number of the call, 0 where there is none; and names that stand twice."""
    blocks: dict[str, dict[int, Rows]] = {name: {} for name in known}
    twice: set[str] = set()
    current: Rows = []  # what stands before the first name is nobody's
    for row in rows:
        head = HEAD.fullmatch(row[0])
        if head and len(row) == 1 and head["name"] in known:
            name, call = head["name"], int(head["call"] or 0)
            if call in blocks[name]:
                twice.add(name)
            current = blocks[name].setdefault(call, [])
        else:
            current.append(row)
    return blocks, twice


def _of_blocks(blocks: dict[int, Rows], ask: Ask) -> Raw:
    cells = 0
    for rows in blocks.values():
        cells += sum(map(len, rows))
    if cells > MAX_ELEMENTS:
        return Raw("error", f"too large: it has {cells} cells; an answer may have {MAX_ELEMENTS}")

    last = max(blocks, default=0)
    if last == 0:
        return raw_value(_typed(blocks.get(0, [])), ask)
    if blocks.get(0) or last > MAX_CALLS or not ask.calls:
        return Raw(
            "error",
            f"the lines `{ask.name} 1`, `{ask.name} 2` ... take results of the calls on the sheet",
        )
    return raw_value([_typed(blocks.get(call, [])) for call in range(1, last + 1)], ask)


def _typed(rows: Rows) -> Any:
    """Cells as numbers where every cell is one, else as they were typed.

    One text alone is that text, and no rows are None.
    """
    if not rows:
        return None
    try:
        return [_numbers(row) for row in rows]
    except ValueError:
        is_one = len(rows) == len(rows[0]) == 1
        return rows[0][0] if is_one else rows


def _numbers(row: list[str]) -> list[float]:
    """The numbers of a row; ValueError where a cell is none."""
    numbers: list[float] = []
    for cell in row:
        number = plain_number(cell)
        if number is None:
            raise ValueError(cell)
        numbers.append(number)
    return numbers
