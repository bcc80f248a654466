"""A sheet's starting point for MATLAB: numbers, blanks, and a line that saves the answers."""

import re
import textwrap
from collections.abc import Iterator, Sequence
from typing import Any

from ...exercises.answers import Choice, Function
from ...exercises.exercise import Exercise, Part, Rows
from ...exercises.kinds.manual import is_on_paper
from ..language.speech import later, phrase, retold
from ..settings.config import SCRIPT_NAME, CourseError, Sheet, Student
from ..text.escape import printable
from ..text.words import points_text
from .assignment import Assignment
from .given import given, unit_names
from .matlab_literal import literal, literal_lines

__all__ = ["literal", "starter"]

WIDTH = 100
FORMATTED = ("$", "\\", "|", "](", "<")
"""Formulas, tables, links and markup: what has them is read in the notebook."""
STACKED: dict[Rows, str] = {
    "linear, angular": later("linear rows above angular"),
    "angular, linear": later("angular rows above linear"),
}

FILLING_IN = later(
    "The questions with formulas and figures stand in {sheet}.ipynb. The numbers below are yours "
    "alone. Fill in the blanks, keep the names of the variables, run the whole script, and hand in "
    "{sheet}.mat."
)
QUESTION = later("The question: {sheet}.ipynb, number and title as here.")
RESULTS = later("Results of {call} for the arguments in each cell of {inputs}:")
TEXTS = later(
    "Units are metres, radians and seconds. Text stands in single quotes: text in double quotes "
    "and symbolic objects cannot be read outside MATLAB; char(...) turns both into text. What is "
    "left empty is not answered."
)


def starter(course: str, sheet: Sheet, student: Student, assignments: Sequence[Assignment]) -> str:
    """The text of a MATLAB script with a section for every exercise, the same every time.

    Raises:
        CourseError: a variable has a name that MATLAB does not take, or a drawn number is of a kind
            that MATLAB has no word for.
    """
    handed_in = _handed_in(assignments)
    for part in handed_in:
        if not SCRIPT_NAME.fullmatch(part.variable):
            raise CourseError(
                f"sheet {sheet.name}: {part.variable} is no name in MATLAB "
                "(ASCII, at most 63 characters)"
            )

    lines = [*_heading(course, sheet, student), ""]
    for number, one in enumerate(assignments, 1):
        lines += _section(number, one.exercise, one.v, sheet)
    lines += _saving(sheet, handed_in)
    return "\n".join(lines) + "\n"


def _handed_in(assignments: Sequence[Assignment]) -> list[Part]:
    """All parts of a sheet but those that are done on paper."""
    parts: list[Part] = []
    for one in assignments:
        parts += [part for part in one.exercise.asked if not is_on_paper(part.answer)]
    return parts


def _heading(course: str, sheet: Sheet, student: Student) -> Iterator[str]:
    yield from _comment(sheet.title or sheet.name)
    whose = phrase(
        "{course}, sheet {sheet}, {name} ({student})",
        course=course,
        sheet=sheet.name,
        name=student.name,
        student=student.id,
    )
    yield from _comment(whose)
    yield "%"
    yield from _comment(phrase(FILLING_IN, sheet=sheet.name))
    yield from _comment(phrase(TEXTS))


def _section(number: int, exercise: Exercise, v: dict[str, Any], sheet: Sheet) -> Iterator[str]:
    """One exercise: its question, its numbers, and a blank for every part."""
    yield f"%% {number}. {_one_line(exercise.title)} ({points_text(exercise.points)})"
    yield from _statement(exercise.statement(v), sheet)
    yield from _numbers(exercise, v)
    yield ""
    for part in exercise.asked:
        yield from _question(part)
        yield from _blank(part, exercise, v)
        yield ""


def _statement(text: str, sheet: Sheet) -> Iterator[str]:
    if not _is_plain(text):
        yield from _comment(phrase(QUESTION, sheet=sheet.name))
        return
    for paragraph in re.split(r"\n\s*\n", text):
        yield from _comment(paragraph)


def _numbers(exercise: Exercise, v: dict[str, Any]) -> Iterator[str]:
    """The printed numbers, under the names that they have in the notebook."""
    for name, value, unit in given(exercise, v):
        units = _one_line(", ".join(unit_names(unit)))
        yield _statement_of(f"{exercise.slug}_{name} = ", literal_lines(value), f";  % [{units}]")


def _statement_of(start: str, lines: Sequence[str], end: str) -> str:
    """A statement around a value, which goes on over all lines of the value."""
    value = " ...\n    ".join(lines)
    return f"{start}{value}{end}"


def _question(part: Part) -> Iterator[str]:
    """What a part asks; in the notebook alone where it has formulas."""
    question = f"{part.variable} ({points_text(part.points)})"
    if _is_plain(part.prompt):
        question += f": {part.prompt}."
    yield from _comment(question)


def _blank(part: Part, exercise: Exercise, v: dict[str, Any]) -> Iterator[str]:
    """Where a part is answered, with what its answer looks like."""
    answer = part.answer
    if is_on_paper(answer):
        yield from _comment(phrase("On paper: nothing is expected in this file."))
        return
    if isinstance(answer, Function):
        calls = answer.published_calls(v)
        if calls:
            yield from _published(part.variable, answer, calls)
            return
    if isinstance(answer, Choice):
        yield from _options(answer)

    for name, (first, *others) in answer.declared_beside.items():
        alternatives = ", ".join(map(literal, others))
        other = phrase("or {alternatives}", alternatives=alternatives)
        yield f"{part.beside[name]} = {literal(first)};  % {other}"
    value, form = answer.matlab(phrase(STACKED[exercise.rows]))
    comment = _one_line(retold(form).replace("NAME", part.variable))
    yield f"{part.variable} = {value};  % {comment}"


def _options(answer: Choice) -> Iterator[str]:
    for letter, option in zip(answer.letters, answer.options, strict=False):
        shown = option if _is_plain(option) else phrase("see the notebook")
        yield from _comment(f"  {letter}: {shown}")


def _published(name: str, answer: Function, calls: Sequence[Sequence[Any]]) -> Iterator[str]:
    """The inputs whose results are asked in place of a function."""
    results = phrase(RESULTS, call=f"{name}{answer.signature}", inputs=f"{name}_inputs")
    yield from _comment(results)
    yield f"{name}_inputs = {{ ..."
    for arguments in calls:
        yield _call(arguments)
    yield "};"
    each = phrase(
        "{result} = result for {inputs}", result=f"{name}{{k}}", inputs=f"{name}_inputs{{k}}{{:}}"
    )
    yield f"{name} = cell(1, {len(calls)});  % {each}"


def _call(arguments: Sequence[Any]) -> str:
    """A cell with the arguments of one call, in one line where each of them takes no more."""
    lines: list[str] = []
    for argument in arguments:
        if lines:
            lines[-1] += ","
        lines += literal_lines(argument)
    if len(lines) == len(arguments):
        return f"    {{{' '.join(lines)}}}; ..."
    return _statement_of("    {", lines, "}; ...")


def _saving(sheet: Sheet, parts: Sequence[Part]) -> Iterator[str]:
    yield "%% " + phrase("Saving {sheet}.mat, the file to hand in", sheet=sheet.name)
    names: list[str] = []
    for part in parts:
        names += [f"'{name}'" for name in (*part.beside.values(), part.variable)]
    yield ", ...\n    ".join([f"save('{sheet.name}.mat'", *names, "'-v7')"])


def _is_plain(text: str) -> bool:
    return not any(mark in text for mark in FORMATTED)


def _comment(text: str) -> list[str]:
    """Comment lines; whatever the text holds, each of its lines begins with a percent sign."""
    plain = _one_line(text).replace("**", "").replace("`", "")
    return textwrap.wrap(
        plain, WIDTH, initial_indent="% ", subsequent_indent="% ", break_on_hyphens=False
    )


def _one_line(text: str) -> str:
    return printable(" ".join(text.split()))
