"""Values as MATLAB writes them: numbers, text, matrices, cell arrays and structures."""

import math
import re
from collections.abc import Iterator, Sequence
from typing import Any, cast

from ..settings.config import SCRIPT_NAME, CourseError
from ..text.escape import printable

LONG = 72  # of a matrix, beside its name and unit
WORDS: dict[bool | None, str] = {None: "[]", True: "true", False: "false"}
MATRIX_OF_NUMBERS = re.compile(r"\[[^'{]*\]")


def literal(value: Any) -> str:
    """A value as MATLAB writes it; lists of matrices and of mixed things are cell arrays.

    A dict is a structure of fields.

    Raises:
        CourseError: it is of another kind, or a name in a dict is none in MATLAB.
    """
    if hasattr(value, "tolist"):
        return literal(value.tolist())
    if value is None or isinstance(value, bool):
        return WORDS[value]
    if isinstance(value, int | float):
        return _number(value)
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, list | tuple):
        return _rows([*value])  # pyright: ignore[reportUnknownArgumentType]
    if isinstance(value, dict):
        fields = _fields(cast("dict[Any, Any]", value))
        return f"struct({', '.join(fields)})"
    raise CourseError(
        "a value on a sheet with matlab = true takes numbers, text, lists and dicts, "
        f"got {value!r:.60}"
    )


def literal_lines(value: Any) -> list[str]:
    """A value as MATLAB writes it, cut where a statement may go on in the next line.

    The rows of a long matrix, and the fields of a long structure, stand alone. All else is whole.

    Raises:
        CourseError: it is of no kind that `literal` takes.
    """
    text = literal(value)
    if len(text) <= LONG:
        return [text]
    if isinstance(value, dict):
        return _structure_lines(cast("dict[Any, Any]", value))
    if MATRIX_OF_NUMBERS.fullmatch(text):
        return re.split(r"(?<=;) ", text)
    return [text]


def _structure_lines(value: dict[Any, Any]) -> list[str]:
    *fields, last = _fields(value)
    lines = [f"{field}," for field in fields]
    lines.append(f"{last})")
    lines[0] = f"struct({lines[0]}"
    return lines


def quoted(text: str) -> str:
    """Text in single quotes, which nothing in it ends; line breaks are joined in by number."""
    lines: list[str] = []
    for line in text.splitlines():
        doubled = printable(line).replace("'", "''")
        lines.append(f"'{doubled}'")
    if not lines:
        return "''"
    if len(lines) == 1:
        return lines[0]
    return f"[{', 10, '.join(lines)}]"


def _number(value: float) -> str:
    if math.isnan(value):
        return "NaN"
    if value == math.inf:
        return "Inf"
    if value == -math.inf:
        return "-Inf"
    return repr(value)


def _rows(items: list[Any]) -> str:
    """A row of numbers, a matrix, or a cell array."""
    if _all_numbers(items):
        return f"[{_listed(items)}]"
    if _is_matrix(items):
        rows = [_listed(row) for row in items]
        return f"[{'; '.join(rows)}]"
    return f"{{{_listed(items)}}}"


def _listed(items: Sequence[Any]) -> str:
    return ", ".join(map(literal, items))


def _all_numbers(items: Sequence[Any]) -> bool:
    return all(isinstance(item, int | float) for item in items)


def _is_matrix(items: list[Any]) -> bool:
    """Whether the items are rows of numbers, none of them empty, all of one length."""
    lengths: set[int] = set()
    for item in items:
        if not isinstance(item, list | tuple):
            return False
        row = cast("Sequence[Any]", item)
        if not _all_numbers(row):
            return False
        lengths.add(len(row))
    return len(lengths) == 1 and 0 not in lengths


def _fields(value: dict[Any, Any]) -> Iterator[str]:
    """Names and values of a structure, as `struct` takes them."""
    for name, inner in value.items():
        if not isinstance(name, str) or not SCRIPT_NAME.fullmatch(name):
            raise CourseError(
                "a dict on a sheet with matlab = true takes names of MATLAB, such as 'kinds', "
                f"got {name!r}"
            )
        text = literal(inner)
        if text.startswith("{"):  # of a bare cell array MATLAB makes an array of structures
            text = f"{{{text}}}"
        yield f"{quoted(name)}, {text}"
