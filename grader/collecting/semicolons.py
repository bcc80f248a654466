"""Rows of a CSV file, whichever way a spreadsheet wrote it: 0.5,1 as in most of the world, or 0,5;1 as in Europe."""

import csv
import io
import re

NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?")
DECIMAL = re.compile(r"(?<![\d.,])(\d*),(\d+)(?![\d.,])")
MATRIX = re.compile(r"[\d.eE+\- ]*;[\d.;eE+\- ]*")
QUOTED = re.compile(r'"[^"]*+(?:""[^"]*+)*+"')
BRACKETS = re.compile(r"[()]+|[^()]+")
LINE_OR_SEMICOLON = re.compile(r"[\r\n;]")
SENTENCE = (
    "the file can be read in two ways, for it has both commas and semicolons between its cells; write 0.5,1.25 with "
    "points in decimals and commas between cells, and text with either of them in double quotes"
)


class Ambiguous(ValueError):
    """Commas or semicolons could both be what stands between cells."""


def rows_of(text: str) -> list[list[str]]:
    """Cells of all rows that are not empty, without blanks around them and without empty cells at the end.

    Raises:
        Ambiguous: both separators are there and neither explains every row.
        csv.Error: it is no CSV.
    """
    comma = _rows(text, ",")
    bare = QUOTED.sub('""', text)
    if ";" not in bare:
        return comma
    semicolon = _rows(text, ";")
    cells = [cell for row in semicolon for cell in row]
    numbers = [cell for cell in cells if NUMBER.fullmatch(cell)]
    clean = not any(_outer_comma(cell) for cell in LINE_OR_SEMICOLON.split(bare))
    mixed = any("," in x for x in numbers) and any("." in x for x in numbers)
    beside = any(NUMBER.fullmatch(cell) for row in semicolon if len(row) > 1 for cell in row)
    if clean and not mixed and (beside or "," not in bare):
        return [[_decimal_point(cell) for cell in row] for row in semicolon]
    if not beside and not any(MATRIX.fullmatch(cell) for row in comma for cell in row):
        return comma  # a semicolon within some text
    raise Ambiguous(SENTENCE)


def _rows(text: str, separator: str) -> list[list[str]]:
    rows: list[list[str]] = []
    for line in csv.reader(
        io.StringIO(text, newline=""), delimiter=separator, skipinitialspace=True
    ):
        cells = ["\n".join(cell.strip().splitlines()) for cell in line]
        while cells and not cells[-1]:
            cells.pop()
        if cells:
            rows.append(cells)
    return rows


def _outer_comma(cell: str) -> bool:
    """A comma outside brackets that is no decimal comma."""
    return "," in cell and _commas_outside(DECIMAL.sub(r"\1.\2", cell)) > 0


def _commas_outside(cell: str) -> int:
    """Commas that do not stand in round brackets."""
    depth = count = 0
    for piece in BRACKETS.finditer(cell):
        depth += piece[0].count("(") - piece[0].count(")")
        count += 0 if depth else piece[0].count(",")
    return count


def _decimal_point(cell: str) -> str:
    """0.5*q1 for 0,5*q1; commas in brackets, as in atan2(1,2), are not touched."""
    if "," not in cell or _commas_outside(cell) < cell.count(","):
        return cell
    return DECIMAL.sub(r"\1.\2", cell)
