"""Rows that cannot be read: each costs one student's sheet, and is named."""

import json
from collections.abc import Callable, Collection, Mapping
from functools import cache
from math import isfinite
from types import NoneType
from typing import Any

from sqlalchemy import RowMapping, Table


class DamagedError(Exception):
    """A row does not hold what was written."""


class Damages:
    """What could not be read so far, by kind of row, sheet and student."""

    def __init__(self) -> None:
        """Nothing is damaged until it is read."""
        self._found: dict[tuple[str, str, str], str] = {}

    def add(self, kind: str, sheet: str, student: Any, what: str, mended: str) -> None:
        """Notes what of a student's sheet is damaged, and how it is mended; the first is told.

        A row whose student cannot be read is nobody's: it is passed over.
        """
        if not isinstance(student, str):
            return
        damage = "a row of the gradebook is damaged"
        sentence = f"{what} of {student} cannot be read: {damage}; {mended}"
        self._found.setdefault((kind, sheet, student), sentence)

    def forget(self, kind: str, sheet: str) -> None:
        """Rows of that kind are going to be read anew."""
        for place in [*self._found]:
            if place[:2] == (kind, sheet):
                del self._found[place]

    def of(self, sheet: str, kinds: Collection[str]) -> dict[str, str]:
        """Student to a sentence, on rows of some kinds; of any where none is named."""
        found: dict[str, str] = {}
        for (kind, of_sheet, student), sentence in self._found.items():
            if of_sheet == sheet and (not kinds or kind in kinds):
                found.setdefault(student, sentence)
        return found


def check_row(row: RowMapping | Mapping[str, Any], table: Table) -> None:
    """Every cell is what its column takes; SQLite keeps anything in any column.

    Raises:
        DamagedError: one is not.
    """
    for name, kinds in _takes(table):
        cell = row[name]
        if not isinstance(cell, kinds) or (isinstance(cell, float) and not isfinite(cell)):
            raise DamagedError


@cache
def _takes(table: Table) -> list[tuple[str, tuple[type, ...]]]:
    """What the cells of each column are, by its name; asked once, and not for every row."""
    found: list[tuple[str, tuple[type, ...]]] = []
    for column in table.c:
        kinds = (column.type.python_type,)
        if kinds == (float,):
            kinds = (float, int)
        if column.nullable:
            kinds = (*kinds, NoneType)
        found.append((column.name, kinds))
    return found


def is_whole(row: RowMapping | Mapping[str, Any], table: Table) -> bool:
    """Whether every cell is what its column takes."""
    try:
        check_row(row, table)
    except DamagedError:
        return False
    return True


def text_of(cell: Any, instead: str) -> str:
    """The text of a cell that is only shown, or what stands in its place."""
    return cell if isinstance(cell, str) else instead


def loaded(text: Any, kind: type | None = None) -> Any:
    """The JSON of a cell.

    Raises:
        DamagedError: it is none, or of another kind.
    """
    return _tried(json.loads, text, kind)


def as_number(cell: Any) -> float | None:
    """A number, or none; SQLite keeps any text in a column of numbers.

    Raises:
        DamagedError: it is something else.
    """
    if cell is None:
        return None
    found = _tried(float, cell, float)
    if not isfinite(found):
        raise DamagedError
    return found


def _tried(read: Callable[[Any], Any], cell: Any, kind: type | None) -> Any:
    try:
        found = read(cell)
    except (ValueError, TypeError, RecursionError) as error:
        raise DamagedError from error
    if kind is not None and not isinstance(found, kind):
        raise DamagedError
    return found


def plain(text: str) -> str:
    """Text that both databases take: whole characters, and no NUL."""
    return text.encode(errors="replace").decode().replace("\0", "\N{REPLACEMENT CHARACTER}")
