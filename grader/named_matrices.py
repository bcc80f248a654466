"""Answers handed in without a notebook: JSON and CSV files of named matrices, as the same raw values."""

import csv
import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from .ask import Ask
from .wire import Raw

MAX_BYTES = 2 << 20


def from_json(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a JSON object such as {"rrt_J": [[...], ...]}; a broken file is an error of every answer."""
    try:
        values: Any = json.loads(_decode(data), parse_int=float)
    except (ValueError, RecursionError) as error:
        return _all(asks, f"the file is not JSON: {error}")
    if not isinstance(values, dict):
        return _all(asks, "the file takes a JSON object of names and matrices")
    return {ask.name: _raw(values[ask.name]) if ask.name in values else Raw("missing") for ask in asks}  # pyright: ignore[reportUnknownArgumentType]


def from_csv(data: bytes, asks: Sequence[Ask]) -> dict[str, Raw]:
    """Values of a CSV file: a line with a name, then the rows of that matrix, and so on.

    The matrices of a stack, such as three 4 x 4 transforms, follow one another.
    """
    names = {ask.name for ask in asks}
    blocks: dict[str, list[list[str]]] = {}
    rows: list[list[str]] = []
    try:
        for line in csv.reader(_decode(data).splitlines()):
            cells = [cell.strip() for cell in line]
            while cells and not cells[-1]:
                cells.pop()
            if len(cells) == 1 and cells[0].rstrip(":") in names:
                rows = blocks.setdefault(cells[0].rstrip(":"), [])
            elif cells:
                rows.append(cells)
    except (ValueError, csv.Error) as error:
        return _all(asks, f"the file is not CSV: {error}")
    return {name: _raw(_numbers(blocks[name])) if name in blocks else Raw("missing") for name in sorted(names)}


def _decode(data: bytes) -> str:
    if len(data) > MAX_BYTES:
        raise ValueError(f"it has {len(data) >> 20} MB, answers fit into {MAX_BYTES >> 20}")
    return data.decode("utf-8-sig")


def _all(asks: Sequence[Ask], reason: str) -> dict[str, Raw]:
    return {ask.name: Raw("error", reason) for ask in asks}


def _numbers(rows: list[list[str]]) -> list[list[Any]]:
    """Cells as numbers where every cell is one, else as they were typed."""
    try:
        return [[float(cell) for cell in row] for row in rows]
    except ValueError:
        return [[*row] for row in rows]


def _raw(value: Any) -> Raw:
    if value is None:
        return Raw("missing")
    try:
        shape, flat = _flatten(value)
    except ValueError as error:
        return Raw("error", str(error))
    if any(isinstance(x, str) for x in flat):
        return Raw("text", value)
    for x in flat:
        if not isinstance(x, float):
            kind = {"dict": "an object", "bool": "true or false", "NoneType": "null"}.get(
                type(x).__name__, "something else"
            )
            return Raw("error", f"not a matrix of numbers: it holds {kind}")
    return Raw("num", np.array(flat, dtype=float).reshape(shape))


def _flatten(value: Any, depth: int = 4) -> tuple[list[int], list[Any]]:
    if not isinstance(value, list):
        return [], [value]
    if depth == 0:
        raise ValueError("not a matrix: it is nested too deeply")
    parts = [_flatten(item, depth - 1) for item in value]  # pyright: ignore[reportUnknownVariableType]
    shapes = {tuple(shape) for shape, _ in parts}
    if len(shapes) > 1:
        raise ValueError("not a matrix: its rows have different lengths")
    inner = list(shapes.pop()) if shapes else []
    return [len(parts), *inner], [x for _, flat in parts for x in flat]
