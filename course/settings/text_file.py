"""Text files that people keep beside a course: read as UTF-8, CSV strictly, with the line named."""

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ...grader.collecting.other_formats import other_format
from ..errors import CourseError

SEPARATORS = ",;\t"


@dataclass(frozen=True)
class Row:
    """The cells of one row and the lines of the file that it begins and ends in."""

    first: int
    last: int
    cells: list[str]


def text_of(path: Path, missing: str) -> str:
    """The text of a file; `missing` says what to do where it is not there.

    Raises:
        CourseError: it is not there, is a folder, cannot be read, or is no UTF-8 text.
    """
    if path.is_dir():
        raise CourseError(f"{path} is a folder; this takes a file")
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        raise CourseError(f"{path} is not there: {missing}") from None
    except OSError as error:
        raise CourseError(f"{path} cannot be read as UTF-8 text: {error}") from error

    other = other_format(data)
    if other:
        raise CourseError(f"{path}: {other.sentence}")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise CourseError(
            f"{path} cannot be read as UTF-8 text; Excel writes that as 'CSV UTF-8': {error}"
        ) from error


def csv_rows(path: Path, text: str) -> Iterator[Row]:
    """The rows of a CSV text, whichever of comma, semicolon and tab its heading has most of.

    Raises:
        CourseError: a quote is left open or has text behind it; the sentence names the line.
    """
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=_separator(text), strict=True)
    first = 1
    while True:
        try:
            cells = next(lines)
        except StopIteration:
            return
        except csv.Error as error:
            raise CourseError(f"{path}, line {first}: {_sentence(error)}") from error
        yield Row(first, lines.line_num, cells)
        first = lines.line_num + 1


def _sentence(error: csv.Error) -> str:
    if "limit" in str(error):
        return f"not a CSV file: {error}"
    return (
        "a quotation mark is left open, or has text behind it; a cell with quotation marks in it "
        'is written with each of them doubled: "Cyd, the ""third"""'
    )


def _separator(text: str) -> str:
    """What stands between the cells of the first line; spreadsheets of Europe write semicolons."""
    heading = text.lstrip("\r\n").partition("\n")[0]
    return max(SEPARATORS, key=heading.count)
