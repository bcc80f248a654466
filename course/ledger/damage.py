"""Rows that cannot be read: each costs one student's sheet, and is named."""

import json
from collections.abc import Callable
from math import isfinite
from typing import Any


class DamagedError(Exception):
    """A row does not hold what was written."""


class Damages:
    """What could not be read so far, by sheet and student."""

    def __init__(self) -> None:
        """Nothing is damaged until it is read."""
        self._found: dict[tuple[str, str], str] = {}

    def add(self, sheet: str, student: str, what: str, mended: str) -> None:
        """Notes what of a student's sheet is damaged, and how it is mended; the first is told."""
        damage = "a row of the gradebook is damaged"
        sentence = f"{what} of {student} cannot be read: {damage}; {mended}"
        self._found.setdefault((sheet, student), sentence)

    def of(self, sheet: str) -> dict[str, str]:
        """Student to a sentence."""
        found: dict[str, str] = {}
        for (of_sheet, student), sentence in self._found.items():
            if of_sheet == sheet:
                found[student] = sentence
        return found


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
