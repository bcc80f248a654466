"""An answer entry by entry, as tables of cells that say which of them are right."""

from dataclasses import dataclass
from typing import Any

from ...solutions.tokens import LARGEST
from ..text.formulas import number


@dataclass(frozen=True)
class Cell:
    """One entry as a page shows it; `typed` is an entry that the student gave as text."""

    text: str
    right: bool
    typed: bool


def entry_tables(answer: Any, right: Any, decimals: int) -> list[list[list[Cell]]]:
    """Tables of rows of cells, one for every matrix of a stack; a vector is a column.

    Args:
        answer: numbers and text, a single one or nested in lists.
        right: truth values, nested alike.
        decimals: how many of a number's are shown.

    Raises:
        ValueError: the two are of different lengths.
    """
    depth = _depth(right)
    pairs = zip(_stack(answer, depth), _stack(right, depth), strict=True)
    return [_table(matrix, flags, decimals) for matrix, flags in pairs]


def _depth(nested: Any) -> int:
    """How deep lists are nested: 0 for a number, 2 for a matrix."""
    if not isinstance(nested, list):
        return 0
    return 1 + _depth(nested[0])  # pyright: ignore[reportUnknownArgumentType]


def _stack(entries: Any, depth: int) -> Any:
    """Entries that are nested that deep as a stack of matrices."""
    if depth == 0:
        return [[[entries]]]
    if depth == 1:
        return [[[entry] for entry in entries]]
    if depth == 2:
        return [entries]
    return entries


def _table(matrix: Any, right: Any, decimals: int) -> list[list[Cell]]:
    table: list[list[Cell]] = []
    for row, flags in zip(matrix, right, strict=True):
        cells = [_cell(entry, ok, decimals) for entry, ok in zip(row, flags, strict=True)]
        table.append(cells)
    return table


def _cell(entry: Any, right: bool, decimals: int) -> Cell:
    if isinstance(entry, str):
        return Cell(entry, right, typed=True)
    if abs(entry) > LARGEST:
        return Cell(f"{entry:.3g}", right, typed=False)
    return Cell(number(entry, decimals), right, typed=False)
