"""Rows of a CSV file, whichever way a spreadsheet wrote it.

Most of the world writes 0.5,1 and Europe 0,5;1; the cells of a file say which of the two it is.
"""

import csv
import io
import re

NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?", re.ASCII)
DECIMAL = re.compile(r"(?<![\d.,])(\d*),(\d+)(?![\d.,])", re.ASCII)
MATRIX = re.compile(r"[\d.eE+\- ]*;[\d.;eE+\- ]*", re.ASCII)
QUOTED = re.compile(r'"[^"]*+(?:""[^"]*+)*+"')
BRACKETS = re.compile(r"[()]+|[^()]+")
LINE_OR_SEMICOLON = re.compile(r"[\r\n;]")
END = "the last line"
SENTENCE = (
    "the file can be read in two ways, for it has both commas and semicolons between its cells; "
    "write 0.5,1.25 with points in decimals and commas between cells, and text with either of them "
    "in double quotes"
)


class Ambiguous(ValueError):
    """Commas or semicolons could both be what stands between cells."""


def rows_of(text: str) -> list[list[str]]:
    """Cells of all rows that are not empty, without blanks around them.

    Empty cells at the end of a row are left out, as a spreadsheet fills up its shorter rows.

    Raises:
        Ambiguous: both separators are there and neither explains every row.
        csv.Error: it is no CSV, or a quotation mark is left open.
    """
    comma_rows = _rows(text, ",")
    bare = QUOTED.sub('""', text)
    if ";" not in bare:
        return comma_rows

    semicolon_rows = _rows(text, ";")
    beside = _has_number_beside(semicolon_rows)
    explained = _commas_are_decimal(bare) and not _has_both_decimals(semicolon_rows)
    if explained and (beside or "," not in bare):
        return [_with_decimal_points(row) for row in semicolon_rows]

    if beside or _has_typed_matrix(comma_rows):
        raise Ambiguous(SENTENCE)
    return comma_rows  # a semicolon within some text


def _rows(text: str, separator: str) -> list[list[str]]:
    file = io.StringIO(f"{text}\n{END}", newline="")
    lines = list(csv.reader(file, delimiter=separator, skipinitialspace=True))
    if lines.pop() != [END]:  # it is in the cell of a quotation mark that nothing closes
        raise csv.Error("a quotation mark is left open")
    rows: list[list[str]] = []
    for line in lines:
        cells = ["\n".join(cell.strip().splitlines()) for cell in line]
        while cells and not cells[-1]:
            cells.pop()
        if cells:
            rows.append(cells)
    return rows


def _has_number_beside(rows: list[list[str]]) -> bool:
    """Whether a number stands in a row with other cells, so that the separator did part cells."""
    for row in rows:
        if len(row) < 2:
            continue
        if any(map(NUMBER.fullmatch, row)):
            return True
    return False


def _has_both_decimals(rows: list[list[str]]) -> bool:
    """Whether some numbers have a decimal comma and others a point, which no spreadsheet writes."""
    numbers: list[str] = []
    for row in rows:
        numbers += filter(NUMBER.fullmatch, row)
    joined = " ".join(numbers)
    return "," in joined and "." in joined


def _commas_are_decimal(bare: str) -> bool:
    """Whether every comma outside quotes and brackets stands between the digits of a number."""
    return not any(map(_has_outer_comma, LINE_OR_SEMICOLON.split(bare)))


def _has_typed_matrix(rows: list[list[str]]) -> bool:
    """Whether a cell looks like a matrix of numbers with semicolons between its rows."""
    return any(any(map(MATRIX.fullmatch, row)) for row in rows)


def _has_outer_comma(cell: str) -> bool:
    """A comma outside brackets that is no decimal comma."""
    return "," in cell and _commas_outside(DECIMAL.sub(r"\1.\2", cell)) > 0


def _commas_outside(cell: str) -> int:
    """Commas that do not stand in round brackets."""
    depth = count = 0
    for piece in BRACKETS.findall(cell):
        depth += piece.count("(") - piece.count(")")
        if depth == 0:
            count += piece.count(",")
    return count


def _with_decimal_points(row: list[str]) -> list[str]:
    return [_decimal_point(cell) for cell in row]


def _decimal_point(cell: str) -> str:
    """0.5*q1 for 0,5*q1; commas in brackets, as in atan2(1,2), are not touched."""
    if "," not in cell or _commas_outside(cell) < cell.count(","):
        return cell
    return DECIMAL.sub(r"\1.\2", cell)
