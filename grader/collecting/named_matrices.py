"""Answers handed in without a notebook: JSON and CSV files of named values, as the same raw values."""

import csv
import json
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from .ask import MAX_CALLS, Ask
from .semicolons import Ambiguous, rows_of
from .wire import MAX_ANSWER, MAX_ELEMENTS, MAX_ROWS, MAX_TEXT, Raw

MAX_BYTES = 2 << 20
MAX_MARKS = 50_000  # of what stands between values or nests them, in a whole file
LONE_SURROGATE = re.compile("[\ud800-\udfff]")
KINDS = {"dict": "an object", "bool": "true or false", "NoneType": "null"}


class TooLarge(ValueError):
    """A file that cannot be one of answers alone."""


def from_json(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a JSON object such as {"rrt_J": [[...], ...]}; a broken file is an error of every answer.

    The results of published calls are a list, one result after another. Half a surrogate pair in a text, which no file
    could hold, becomes the replacement character.
    """
    try:
        values: Any = json.loads(_decode(data, ",:[{"), parse_int=float)
    except TooLarge as error:
        return every(asks, str(error))
    except (ValueError, RecursionError) as error:
        return every(asks, f"the file is not JSON: {error}")
    if not isinstance(values, dict):
        return every(asks, "the file takes a JSON object of names and matrices")
    return {
        ask.name: raw_value(values[ask.name], ask) if ask.name in values else Raw("missing")
        for ask in asks
    }  # pyright: ignore[reportUnknownArgumentType]


def from_csv(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a CSV file: a line with a name, then the rows of that matrix, and so on.

    The matrices of a stack, such as three 4 x 4 transforms, follow one another. The results of published calls follow
    lines with the name and a number: `name 1`, `name 2` and so on. Cells are numbers or text; a text with commas stands
    in double quotes, where it may hold line breaks too. One cell alone is read as it is, anything else as rows. Files
    with semicolons between cells and commas in decimals are read where there is no doubt that they are.
    """
    known = {ask.name: ask for ask in asks}
    try:
        rows = rows_of(_decode(data, ",;()\r\n"))
        blocks = _blocks(rows, known)
    except (Ambiguous, TooLarge) as error:
        return every(asks, str(error))
    except (ValueError, csv.Error) as error:
        return every(asks, f"the file is not CSV: {error}")
    return {name: _of_blocks(blocks.get(name, {}), ask) for name, ask in known.items()}


def _blocks(rows: list[list[str]], known: dict[str, Ask]) -> dict[str, dict[int, list[list[str]]]]:
    """Rows by name and number of the call, 0 where there is none."""
    blocks: dict[str, dict[int, list[list[str]]]] = {}
    current: list[list[str]] = []
    for cells in rows:
        head = (
            re.fullmatch(r"(\w+)(?:\s+([0-9]{1,4}))?\s*:?", cells[0]) if len(cells) == 1 else None
        )
        if head and head[1] in known:
            current = blocks.setdefault(head[1], {}).setdefault(int(head[2] or 0), [])
        else:
            current.append(cells)
    return blocks


def _of_blocks(blocks: dict[int, list[list[str]]], ask: Ask) -> Raw:
    cells = sum(len(row) for rows in blocks.values() for row in rows)
    if cells > MAX_ELEMENTS:
        return Raw("error", f"too large: it has {cells} cells; an answer may have {MAX_ELEMENTS}")
    numbered = [number for number in blocks if number]
    if not numbered:
        return raw_value(_typed(blocks.get(0, [])), ask)
    if blocks.get(0) or max(numbered) > MAX_CALLS or not ask.calls:
        return Raw(
            "error",
            f"the lines `{ask.name} 1`, `{ask.name} 2` ... take results of the calls on the sheet",
        )
    return raw_value([_typed(blocks.get(i, [])) for i in range(1, max(numbered) + 1)], ask)


def _typed(rows: list[list[str]]) -> Any:
    """Cells as numbers where every cell is one, else as they were typed; one text alone is that text."""
    try:
        return [[float(cell) for cell in row] for row in rows] or None
    except ValueError:
        return rows[0][0] if len(rows) == len(rows[0]) == 1 else [[*row] for row in rows]


def _decode(data: bytes, marks: str) -> str:
    """The text of a file; refused before it is taken apart where it has far more parts than any answers have."""
    if len(data) > MAX_BYTES:
        raise TooLarge(f"the file has more than {MAX_BYTES >> 20} MB; hand in only your answers")
    if sum(data.count(mark.encode()) for mark in marks) > MAX_MARKS:
        raise TooLarge(
            f"the file has more than {MAX_MARKS} values, lines or brackets; hand in only your answers"
        )
    return data.decode("utf-8-sig")


def every(asks: Sequence[Ask], reason: str) -> dict[str, Raw]:
    """One reason why there is no answer, for all of them."""
    return {ask.name: Raw("error", reason) for ask in asks}


def raw_value(value: Any, ask: Ask) -> Raw:
    """Nested lists of numbers and text as a notebook would give them.

    Where results of calls were asked, a list whose parts have different shapes is a list of results.
    """
    if _leaves(value, MAX_ELEMENTS) > MAX_ELEMENTS:
        return Raw("error", f"too large: it has more than {MAX_ELEMENTS} entries")
    if ask.calls and isinstance(value, list):  # a function may say yes or no
        value = [float(result) if isinstance(result, bool) else result for result in value]  # pyright: ignore[reportUnknownVariableType]
    raw = _raw(value)
    if raw.kind != "error" or not ask.calls or not isinstance(value, list):
        return raw
    if len(value) > MAX_CALLS:  # pyright: ignore[reportUnknownArgumentType]
        return raw
    results = [_raw(result) for result in value]  # pyright: ignore[reportUnknownVariableType]
    if all(result.kind == "missing" for result in results):
        return Raw("missing")
    if all(result.kind in ("missing", "error") for result in results):
        return raw
    return Raw("calls", results, listed=True)


def _leaves(value: Any, most: int, depth: int = 6) -> int:
    """Numbers, texts and empty lists in a value, counted no further than it takes to know that they are too many."""
    if not isinstance(value, list) or not value or not depth:
        return 1
    count = 0
    for item in value:  # pyright: ignore[reportUnknownVariableType]
        count += _leaves(item, most - count, depth - 1)
        if count > most:
            break
    return count


def _raw(value: Any) -> Raw:
    if value is None:
        return Raw("missing")
    try:
        shape, flat = _flatten(value)
        if any(isinstance(x, str) for x in flat):
            return Raw("text", _text(value, shape))
    except ValueError as error:
        return Raw("error", str(error))
    others = [x for x in flat if not isinstance(x, float | complex | bool)]
    if others or (flat and all(isinstance(x, bool) for x in flat)):
        kind = KINDS.get(type((others or flat)[0]).__name__, "something else")
        return Raw("error", f"not a matrix of numbers: it holds {kind}")
    return Raw(
        "num",
        np.array(
            flat, dtype=complex if any(isinstance(x, complex) for x in flat) else float
        ).reshape(shape),
    )


def _text(value: Any, shape: list[int]) -> Any:
    """Strings, and numbers as strings, with nothing cut off."""
    if len(shape) > 2:
        raise ValueError("not a matrix: its text is nested too deeply")
    if max(shape, default=0) > MAX_ROWS:
        raise ValueError(f"too long: a list of {max(shape)} entries; an answer may have {MAX_ROWS}")
    return _entries(value, MAX_TEXT if shape else MAX_ANSWER)


def _entries(value: Any, most: int) -> Any:
    if isinstance(value, list):
        return [_entries(item, most) for item in value]  # pyright: ignore[reportUnknownVariableType]
    text = repr(float(value)) if isinstance(value, float | bool) else str(value)
    if len(text) > most:
        raise ValueError(f"too long: a text of {len(text)} characters; {most} can be read here")
    return LONE_SURROGATE.sub("\N{REPLACEMENT CHARACTER}", text)


def _flatten(value: Any, depth: int = 4) -> tuple[list[int], list[Any]]:
    if not isinstance(value, list):
        return [], [value]
    if depth == 0:
        raise ValueError("not a matrix: it is nested too deeply")
    parts = [_flatten(item, depth - 1) for item in value]  # pyright: ignore[reportUnknownVariableType]
    shapes = {tuple(shape) for shape, _ in parts}
    if len(shapes) > 1:
        quotes = (
            "; a text with commas takes quotes"
            if any(isinstance(x, str) for _, flat in parts for x in flat)
            else ""
        )
        raise ValueError(f"not a matrix: its rows have different lengths{quotes}")
    inner = list(shapes.pop()) if shapes else []
    return [len(parts), *inner], [x for _, flat in parts for x in flat]
