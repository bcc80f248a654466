# pyright: basic
"""Sheets and worked solutions as notebooks: the same bytes for the same student, every time."""

import hashlib
from collections.abc import Iterator, Sequence
from html import escape
from typing import Any

import nbformat
import numpy as np

from ...exercises.drawing import Drawing
from ...exercises.exercise import (
    Choice,
    Exercise,
    ExerciseError,
    Manual,
    Part,
    Rows,
    Step,
    references,
)
from ...grader.figures.arm import draw
from ...grader.figures.raster import data_uri, png
from ...solutions.expression import latex_name
from ..config import Sheet, Student
from ..escape import no_markup
from ..formulas import closed_form, given_number, matrix
from ..words import points_text
from .self_check import self_check

Pair = tuple[Exercise, dict[str, Any]]
"""An exercise and the numbers drawn for the student."""
WIDTH = 380  # of a figure on the page, in pixels; the PNG has twice as many
DECIMALS = 4  # of numbers in the worked solution of a part that asks for none
KEY = "kinegrade"
STACKED: dict[Rows, str] = {
    "linear, angular": "the linear rows stand above the angular ones",
    "angular, linear": "the angular rows stand above the linear ones",
}
SELF_CHECK = (
    "## Self-check\n\nRun this cell at any time. It sees what is there, not whether it is right."
)


def notebooks(
    course: str, sheet: Sheet, student: Student, pairs: Sequence[Pair]
) -> tuple[bytes, bytes]:
    """What the student gets, and what the instructor keeps."""
    mixed = len(_orders(pairs)) > 1
    questions = [
        question_text(number, exercise, v, order=mixed)
        for number, (exercise, v) in enumerate(pairs, 1)
    ]
    heading = _heading(course, sheet, student, pairs)
    handout, solution = (
        [_markdown(heading)],
        [_markdown(f"{heading}\n\n**Worked solution, for the instructor.**")],
    )
    for cells in (handout, solution):
        cells.append(_code("import numpy as np"))
    for (exercise, v), question in zip(pairs, questions, strict=True):
        handout += [
            _markdown(question),
            _code(given_cell(exercise, v)),
            *_blanks(exercise, hints=sheet.mode != "exam"),
        ]
        solution += [_markdown(question), *_worked(exercise, v)]
    handout += [
        _markdown(SELF_CHECK),
        _code(self_check([part for exercise, _ in pairs for part in exercise.asked])),
    ]
    about = {"sheet": sheet.name, "student": student.id, "mode": sheet.mode}
    order = [
        exercise.slug for exercise, _ in pairs
    ]  # a notebook's keys are sorted when it is written
    numbers = {exercise.slug: printed(exercise, v) for exercise, v in pairs}
    return (
        _written(
            handout, about | {"exercises": order, "numbers": numbers}, f"{sheet.name}/{student.id}"
        ),
        _written(solution, about, f"solution/{sheet.name}/{student.id}"),
    )


def _blanks(exercise: Exercise, *, hints: bool) -> Iterator[Any]:
    for part in exercise.asked:
        yield _markdown(prompt_text(part, hints=hints))
        yield _code(part.answer.blank(part.variable), part.variable)


def _worked(exercise: Exercise, v: dict[str, Any]) -> Iterator[Any]:
    answers = references(exercise, v)
    for part in exercise.asked:
        yield _markdown(prompt_text(part, hints=False))
        yield from map(_markdown, worked_steps(part, v, answers))
        if isinstance(part.answer, Manual):
            yield _markdown(
                "\n".join(f"- {points_text(points)}: {text}" for points, text in part.answer.rubric)
            )
        yield _code(part.answer.code(part.variable, answers[part.variable]), part.variable)


def printed(exercise: Exercise, v: dict[str, Any]) -> dict[str, Any]:
    """The drawn numbers without those that stay with the instructor."""
    return {name: value for name, value in v.items() if name not in exercise.hidden}


def given_cell(exercise: Exercise, v: dict[str, Any]) -> str:
    """Python that sets every printed number under a name of its own, such as rrt_d1."""
    lines = [
        f"# Your numbers for {exercise.slug}, in metres, radians and seconds. Run this cell, do not change it."
    ]
    for name, unit in exercise.units.items():
        if name in v:
            value = f"np.array({_rows(v[name])})" if isinstance(v[name], list) else repr(v[name])
            shown = ", ".join(dict.fromkeys(np.array(unit).ravel().tolist()))
            lines.append(f"{exercise.slug}_{name} = {value}  # [{shown}]")
    return "\n".join(lines)


def _rows(numbers: list[Any]) -> str:
    """A list in one line, a matrix with a line for every row."""
    if not isinstance(numbers[0], list):
        return repr(numbers)
    return "[\n" + "".join(f"    {row!r},\n" for row in numbers) + "]"


def worked_steps(part: Part, v: dict[str, Any], answers: dict[str, Any]) -> Iterator[str]:
    """Markdown of a part's steps, the general formula before the numbers."""
    decimals = getattr(part.answer, "decimals", DECIMALS)
    for step in _steps(part, v, answers):
        yield "\n\n".join(text for text in (step.text, *_displayed(step, decimals)) if text)


def _steps(part: Part, v: dict[str, Any], answers: dict[str, Any]) -> Sequence[Step]:
    """What `explain` returns.

    Raises:
        ExerciseError: it is text, or something else than steps.
    """
    told: Any = part.explain
    if callable(told):
        told = told(v, answers)
    steps = [] if told is None else list(told)
    if isinstance(told, str) or not all(isinstance(step, Step) for step in steps):
        got = "text" if isinstance(told, str) else type(told).__name__
        raise ExerciseError(
            f"explain of {part.variable} takes a function that returns steps, "
            f'such as explain=lambda v, given: [Step("Differentiate the position:")], got {got}'
        )
    return steps


def _displayed(step: Step, decimals: int) -> Iterator[str]:
    left = f"{step.symbol} = " if step.symbol else ""
    if step.formula is not None:
        yield f"$${left}{closed_form(step.formula)}$$"
    if step.numbers is not None:
        shown = decimals if step.decimals is None else step.decimals
        yield f"$${left}{matrix(step.numbers, shown)}$$"


def _heading(course: str, sheet: Sheet, student: Student, pairs: Sequence[Pair]) -> str:
    points = sum(exercise.points for exercise, _ in pairs)
    minutes = sum(exercise.minutes for exercise, _ in pairs)
    lines = [
        f"# {sheet.title or sheet.name}",
        (
            f"{course} · sheet `{sheet.name}` · **{no_markup(student.name) or student.id}** (`{student.id}`) · "
            f"{points_text(points)} · about {minutes} minutes"
        ),
        (
            "The numbers on this sheet are yours alone. Replace each `...` by your answer and keep the names of the "
            "variables: answers are collected by name. At the end restart the kernel and run all cells - the sheet is "
            "marked in that way, from top to bottom - then save and hand in this file."
        ),
        " ".join(
            [
                f"Units are {_units(pairs)}.",
                *_order_of_all(pairs),
                "Round only what you hand in, and compute on with all digits.",
            ]
        ),
    ]
    return "\n\n".join(lines)


def _units(pairs: Sequence[Pair]) -> str:
    """The basic units of a sheet; newtons where a force or a moment is on it."""
    forces = any(
        np.char.startswith(np.array(unit).astype(str), "N").any()
        for exercise, _ in pairs
        for unit in exercise.units.values()
    )
    return "metres, radians, seconds and newtons" if forces else "metres, radians and seconds"


def _orders(pairs: Sequence[Pair]) -> set[Rows]:
    return {exercise.rows for exercise, _ in pairs}


def _order_of_all(pairs: Sequence[Pair]) -> Iterator[str]:
    """The order of rows, where the exercises of a sheet agree on one; else each of them says its own."""
    orders = _orders(pairs)
    if len(orders) == 1:
        yield f"In every Jacobian and twist {STACKED[orders.pop()]}."


def question_text(
    number: int, exercise: Exercise, v: dict[str, Any], *, order: bool = False
) -> str:
    """Markdown of heading, statement, numbers and figures; with `order`, it says which rows come first."""
    parts = (
        f"## {number}. {exercise.title} ({points_text(exercise.points)})",
        f"*{' '.join(exercise.objectives)}*" if exercise.objectives else "",
        f"In the Jacobians and twists of this exercise {STACKED[exercise.rows]}." if order else "",
        exercise.statement(v),
        *_given_numbers(exercise, v),
        *_figures(exercise.drawings(v)),
    )
    return "\n\n".join(part for part in parts if part)


def _given_numbers(exercise: Exercise, v: dict[str, Any]) -> tuple[str, ...]:
    """Numbers and vectors in one line, every matrix on its own."""
    texts = {
        name: given_number(exercise.symbols.get(name) or _symbol(name, v[name]), v[name], unit)
        for name, unit in exercise.units.items()
        if name in v
    }
    matrices = [f"$${text}$$" for text in texts.values() if "bmatrix" in text]
    line = r", $\quad$ ".join(f"${text}$" for text in texts.values() if "bmatrix" not in text)
    return (f"**Your numbers:** {line}", *matrices)


def _symbol(name: str, value: Any) -> str:
    """LaTeX of a printed name; vectors and matrices are bold."""
    stem, index, *rest = [*latex_name(name).partition("_")]
    if not isinstance(value, list):
        return latex_name(name)
    bold = rf"\boldsymbol{{{stem}}}" if stem.startswith("\\") else rf"\mathbf{{{stem}}}"
    return "".join([bold, index, *rest])


def _figures(drawings: Sequence[Drawing]) -> tuple[str, ...]:
    """A table of drawings over their captions, as PNG data URIs: attachments are not shown everywhere."""
    if not drawings:
        return ()
    images = [
        f'<img src="{data_uri(png(draw(drawing, WIDTH), 2 * WIDTH))}" alt="{escape(drawing.alt)}" width="{WIDTH}">'
        for drawing in drawings
    ]
    captions = [f"*{drawing.caption}*" for drawing in drawings]
    rows = [f"| {' | '.join(cells)} |" for cells in (images, [":-:"] * len(images), captions)]
    return ("\n".join(rows),)


def prompt_text(part: Part, *, hints: bool) -> str:
    """Markdown of a part's question, with its options and hints."""
    stop = "" if part.prompt.endswith((".", "?", "!", ":")) else "."
    question = f"**`{part.variable}`** ({points_text(part.points)}): {part.prompt}{stop}"
    blocks = [f"{question} {part.answer.asked_beside}".rstrip()]
    if isinstance(part.answer, Choice):
        options = zip(part.answer.letters, part.answer.options, strict=True)
        blocks.append("\n".join(f"- **{letter})** {option}" for letter, option in options))
    if hints and part.hints:
        listed = "\n".join(f"{i}. {hint}" for i, hint in enumerate(part.hints, 1))
        blocks.append(f"<details><summary>Hints</summary>\n\n{listed}\n\n</details>")
    return "\n\n".join(blocks)


def _markdown(text: str) -> Any:
    return nbformat.v4.new_markdown_cell(text)


def _code(source: str, answer: str = "") -> Any:
    # Tags are for people and tools that keep them; answers are collected by the variable's name.
    return nbformat.v4.new_code_cell(
        source, metadata={"tags": ["answer", answer]} if answer else {}
    )


def _written(cells: list[Any], about: dict[str, Any], identity: str) -> bytes:
    for i, cell in enumerate(cells):
        cell["id"] = hashlib.sha256(f"{identity}/{i}".encode()).hexdigest()[
            :8
        ]  # nbformat draws a random one
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}, KEY: about}
    notebook = nbformat.v4.new_notebook(cells=cells, metadata=metadata)
    nbformat.validate(notebook)
    return (nbformat.writes(notebook) + "\n").encode("utf-8")
