"""A sheet's starting point for MATLAB: numbers, blanks and the line that saves what is handed in."""

import math
import re
import textwrap
from collections.abc import Iterator, Sequence
from typing import Any, cast

from ...exercises.answers import Choice, Function
from ...exercises.exercise import Exercise, Part, Rows
from ...exercises.kinds.manual import is_on_paper
from ..config import SCRIPT_NAME, CourseError, Sheet, Student
from ..escape import printable
from ..words import points_text

Pair = tuple[Exercise, dict[str, Any]]
WIDTH = 100
LONG = 72  # of a matrix, beside its name and unit
NEWLINE = "\n"
UNREADABLE = (
    "$",
    "\\",
    "|",
    "](",
    "<",
)  # formulas, tables, links and markup: those are read in the notebook
STACKED: dict[Rows, str] = {
    "linear, angular": "linear rows above angular",
    "angular, linear": "angular rows above linear",
}


def starter(course: str, sheet: Sheet, student: Student, pairs: Sequence[Pair]) -> str:
    """The text of a MATLAB script, a section for every exercise; the same for the same student, every time.

    Raises:
        CourseError: a variable has a name that MATLAB does not take, or a drawn number that it cannot be given.
    """
    parts = [part for exercise, _ in pairs for part in exercise.asked]
    handed_in = [part for part in parts if not is_on_paper(part.answer)]
    for name in [part.variable for part in handed_in]:
        if not SCRIPT_NAME.fullmatch(name):
            raise CourseError(
                f"sheet {sheet.name}: {name} is no name in MATLAB (ASCII, at most 63 characters)"
            )
    lines = [*_heading(course, sheet, student), ""]
    for number, (exercise, v) in enumerate(pairs, 1):
        lines += [f"%% {number}. {_one_line(exercise.title)} ({points_text(exercise.points)})"]
        lines += [*_statement(exercise, sheet, v), *_given(exercise, v), ""]
        for part in exercise.asked:
            lines += [*_blank(part, (exercise, v)), ""]
    return "\n".join([*lines, *_saving(sheet, handed_in)]) + "\n"


def _heading(course: str, sheet: Sheet, student: Student) -> Iterator[str]:
    yield from _comment(sheet.title or sheet.name)
    yield from _comment(f"{course}, sheet {sheet.name}, {student.name} ({student.id})")
    yield "%"
    yield from _comment(
        f"The questions with formulas and figures stand in {sheet.name}.ipynb. The numbers below are yours alone. Fill "
        f"in the blanks, keep the names of the variables, run the whole script, and hand in {sheet.name}.mat."
    )
    yield from _comment(
        "Units are metres, radians and seconds. Text stands in single quotes: text in double quotes and symbolic "
        "objects cannot be read outside MATLAB; char(...) turns both into text. What is left empty is not answered."
    )


def _statement(exercise: Exercise, sheet: Sheet, v: dict[str, Any]) -> Iterator[str]:
    text = exercise.statement(v)
    if _readable(text):
        for paragraph in re.split(r"\n\s*\n", text):
            yield from _comment(paragraph)
    else:
        yield from _comment(f"The question: {sheet.name}.ipynb, number and title as here.")


def _given(exercise: Exercise, v: dict[str, Any]) -> Iterator[str]:
    """The printed numbers, under the names that they have in the notebook."""
    for name, unit in exercise.units.items():
        if name in v:
            units = ", ".join(dict.fromkeys(_units(unit)))
            yield _continued(
                [f"{exercise.slug}_{name} = ", *_pieces(v[name]), f";  % [{_one_line(units)}]"]
            )


def _pieces(value: Any) -> list[str]:
    """A value as MATLAB writes it; the rows of a matrix, and the fields of a dict, each in a piece if it is long."""
    text = literal(value)
    if isinstance(value, dict) and len(text) > LONG:
        first, *others = _fields(cast("dict[Any, Any]", value))
        return _closed([f"struct({first}", *others])
    return (
        re.split(r"(?<=;) ", text)
        if len(text) > LONG and re.fullmatch(r"\[[^'{]*\]", text)
        else [text]
    )


def _closed(fields: Sequence[str]) -> list[str]:
    """Fields of a structure with the commas between them and the bracket at the end."""
    return [*(f"{field}," for field in fields[:-1]), f"{fields[-1]})"]


def _continued(pieces: Sequence[str]) -> str:
    """The head, pieces and end of a statement, over several lines where there is more than one piece."""
    head, *middle, end = pieces
    return f"{head}{f' ...{NEWLINE}    '.join(middle)}{end}"


def _units(unit: Any) -> Iterator[str]:
    if isinstance(unit, str):
        yield unit
    else:
        for inner in unit:
            yield from _units(inner)


def literal(value: Any) -> str:
    """A value as MATLAB writes it: numbers, text, rows; lists of matrices and of mixed things are cell arrays.

    A dict is a structure of fields; a field that holds a cell array stands in a second pair of braces, without which
    MATLAB would make an array of structures.

    Raises:
        CourseError: it is of another kind, or a name in a dict is none in MATLAB.
    """
    if hasattr(value, "tolist"):
        return literal(value.tolist())
    if value is None or isinstance(value, bool):
        return {None: "[]", True: "true", False: "false"}[value]
    if isinstance(value, int | float):
        return {math.inf: "Inf", -math.inf: "-Inf"}.get(
            value, "NaN" if math.isnan(value) else repr(value)
        )
    if isinstance(value, str):
        return _char(value)
    if isinstance(value, list | tuple):
        return _rows([*value])  # pyright: ignore[reportUnknownArgumentType]
    if isinstance(value, dict):
        return f"struct({', '.join(_fields(cast('dict[Any, Any]', value)))})"
    raise CourseError(
        f"a value on a sheet with matlab = true takes numbers, text, lists and dicts, got {value!r:.60}"
    )


def _fields(value: dict[Any, Any]) -> Iterator[str]:
    for name, inner in value.items():
        if not isinstance(name, str) or not SCRIPT_NAME.fullmatch(name):
            raise CourseError(
                f"a dict on a sheet with matlab = true takes names of MATLAB, such as 'kinds', got {name!r}"
            )
        text = literal(inner)
        yield f"{_char(name)}, {f'{{{text}}}' if text.startswith('{') else text}"


def _rows(items: list[Any]) -> str:
    if all(isinstance(item, int | float) for item in items):
        return f"[{', '.join(map(literal, items))}]"
    rows: list[Any] = [item for item in items if isinstance(item, list | tuple) and item]
    numeric = len(rows) == len(items) and all(
        isinstance(x, int | float) for row in rows for x in row
    )
    if numeric and len({len(row) for row in rows}) == 1:
        return f"[{'; '.join(', '.join(map(literal, row)) for row in rows)}]"
    return f"{{{', '.join(map(literal, items))}}}"


def _char(text: str) -> str:
    """Text in single quotes, which end at nothing but a single quote; line breaks are joined in by number."""
    pieces = ["'" + printable(line).replace("'", "''") + "'" for line in text.splitlines()] or [
        "''"
    ]
    return pieces[0] if len(pieces) == 1 else f"[{', 10, '.join(pieces)}]"


def _blank(part: Part, pair: Pair) -> Iterator[str]:
    """Comments and a blank for one part."""
    head = f"{part.variable} ({points_text(part.points)})"
    yield from _comment(f"{head}: {part.prompt}." if _readable(part.prompt) else head)
    answer, (exercise, v) = part.answer, pair
    if is_on_paper(answer):
        yield from _comment("On paper: nothing is expected in this file.")
        return
    if isinstance(answer, Choice):
        yield from _options(answer)
    calls = answer.published_calls(v) if isinstance(answer, Function) else []
    if isinstance(answer, Function) and calls:
        yield from _published(part.variable, answer, calls)
        return
    value, comment = answer.matlab(STACKED[exercise.rows])
    yield f"{part.variable} = {value};  % {_one_line(comment.replace('NAME', part.variable))}"


def _options(answer: Choice) -> Iterator[str]:
    for letter, option in zip(answer.letters, answer.options, strict=False):
        yield from _comment(f"  {letter}: {option if _readable(option) else 'see the notebook'}")


def _published(name: str, answer: Function, calls: Sequence[Sequence[Any]]) -> Iterator[str]:
    """The inputs whose results are asked in place of a function."""
    yield from _comment(
        f"Results of {name}{answer.signature} for the arguments in each cell of {name}_inputs:"
    )
    yield f"{name}_inputs = {{ ..."
    yield from map(_call, calls)
    yield "};"
    yield f"{name} = cell(1, {len(calls)});  % {name}{{k}} = result for {name}_inputs{{k}}{{:}}"


def _call(arguments: Sequence[Any]) -> str:
    pieces = [_pieces(argument) for argument in arguments]
    if all(len(piece) == 1 for piece in pieces):
        return f"    {{{', '.join(text for (text,) in pieces)}}}; ..."
    lines = [line for piece in pieces for line in (*piece[:-1], f"{piece[-1]},")]
    return _continued(["    {", *lines[:-1], lines[-1][:-1], "}; ..."])


def _saving(sheet: Sheet, parts: Sequence[Part]) -> Iterator[str]:
    yield f"%% Saving {sheet.name}.mat, the file to hand in"
    names = [f"'{part.variable}'" for part in parts]
    yield ", ...\n    ".join([f"save('{sheet.name}.mat'", *names, "'-v7')"])


def _readable(text: str) -> bool:
    return not any(mark in text for mark in UNREADABLE)


def _comment(text: str) -> Iterator[str]:
    """Comment lines; whatever the text holds, each of its lines begins with a percent sign."""
    plain = _one_line(text).replace("**", "").replace("`", "")
    yield from textwrap.wrap(
        plain, WIDTH, initial_indent="% ", subsequent_indent="% ", break_on_hyphens=False
    )


def _one_line(text: str) -> str:
    return printable(" ".join(text.split()))
