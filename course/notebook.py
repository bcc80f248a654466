"""Sheets and worked solutions as notebooks: the same bytes for the same student, every time."""

import hashlib
from collections.abc import Iterator, Sequence
from importlib.resources import files
from typing import Any

import nbformat
import numpy as np

from ..exercises.drawing import Drawing
from ..exercises.exercise import Exercise, Numbers, Part, Step, TableOf, references
from ..grader.arm import draw
from ..grader.raster import data_uri, png
from ..solutions.table import Table
from .config import Sheet, Student
from .formulas import closed_form, given_number, matrix

Pair = tuple[Exercise, dict[str, Any]]
"""An exercise and the numbers drawn for the student."""
WIDTH = 420  # of a figure on the page, in pixels; the PNG has twice as many
KEY = "kinegrade"


def sheet_notebook(course: str, sheet: Sheet, student: Student, pairs: Sequence[Pair]) -> bytes:
    """What the student gets: statements, figures, given numbers, an empty answer cell per part, a self-check."""
    cells: list[Any] = [_markdown(_heading(course, sheet, student, pairs)), _code("import numpy as np")]
    for number, (exercise, v) in enumerate(pairs, 1):
        cells += [_markdown(_question(number, exercise, v)), _code(given_cell(exercise, v))]
        for part in exercise.asked:
            cells += [_markdown(_prompt(part, hints=sheet.mode != "exam")), _code(_blank(part), part.variable)]
    cells += [
        _markdown("## Self-check\n\nRun this cell at any time. It sees what is there, not whether it is right."),
        _code(self_check([part for exercise, _ in pairs for part in exercise.asked])),
    ]
    numbers = {exercise.slug: v for exercise, v in pairs}
    about = {"sheet": sheet.name, "student": student.id, "mode": sheet.mode, "numbers": numbers}
    return _written(cells, about, f"{sheet.name}/{student.id}")


def solution_notebook(course: str, sheet: Sheet, student: Student, pairs: Sequence[Pair]) -> bytes:
    """What the instructor keeps: the sheet's questions, each with its worked steps and the answer as code."""
    cells: list[Any] = [
        _markdown(_heading(course, sheet, student, pairs) + "\n\n**Worked solution, for the instructor.**"),
        _code("import numpy as np"),
    ]
    for number, (exercise, v) in enumerate(pairs, 1):
        cells.append(_markdown(_question(number, exercise, v)))
        answers = references(exercise, v)
        for part in exercise.asked:
            cells.append(_markdown(_prompt(part, hints=False)))
            cells += [_markdown(text) for text in worked_steps(part, v, answers)]
            cells.append(_code(answer_code(part, answers[part.variable]), part.variable))
    about = {"sheet": sheet.name, "student": student.id, "solution": True}
    return _written(cells, about, f"solution/{sheet.name}/{student.id}")


def given_cell(exercise: Exercise, v: dict[str, Any]) -> str:
    """Python that sets every printed number under a name of its own, such as rrt_d1."""
    lines = [f"# Your numbers for {exercise.slug}, in metres, radians and seconds. Run this cell, do not change it."]
    for name, unit in exercise.units.items():
        if name in v:
            value = f"np.array({v[name]!r})" if isinstance(v[name], list) else repr(v[name])
            shown = unit if isinstance(unit, str) else ", ".join(dict.fromkeys(unit))
            lines.append(f"{exercise.slug}_{name} = {value}  # [{shown}]")
    return "\n".join(lines)


def answer_code(part: Part, answer: Any) -> str:
    """Python that assigns an answer in full, as a student could write it."""
    if isinstance(answer, Table):
        rows = ",\n".join(f"    {[str(cell) for cell in row]!r}" for row in answer.rows)
        return f"{part.variable} = [\n{rows},\n]"
    rounded = np.round(np.asarray(answer), 9) + 0.0
    return f"{part.variable} = np.array({np.array2string(rounded, separator=', ', threshold=10_000)})"


def worked_steps(part: Part, v: dict[str, Any], answers: dict[str, Any]) -> Iterator[str]:
    """Markdown of a part's steps, the general formula before the numbers."""
    decimals = part.answer.decimals
    for step in part.explain(v, answers) if part.explain else ():
        yield "\n\n".join(text for text in (step.text, *_displayed(step, decimals)) if text)


def _displayed(step: Step, decimals: int) -> Iterator[str]:
    left = f"{step.symbol} = " if step.symbol else ""
    if step.formula is not None:
        yield f"$${left}{closed_form(step.formula)}$$"
    if step.numbers is not None:
        yield f"$${left}{matrix(step.numbers, decimals)}$$"


def _heading(course: str, sheet: Sheet, student: Student, pairs: Sequence[Pair]) -> str:
    points = sum(exercise.points for exercise, _ in pairs)
    minutes = sum(exercise.minutes for exercise, _ in pairs)
    lines = [
        f"# {sheet.title or sheet.name}",
        f"{course} · sheet `{sheet.name}` · **{_plain(student.name)}** (`{student.id}`) · {points:g} points · "
        f"about {minutes} minutes",
        "The numbers on this sheet are yours alone. Replace each `...` by your answer and keep the names of the "
        "variables: answers are collected by name. Run all cells, save, and hand in this file.",
        "Units are metres, radians and seconds. In every Jacobian and twist the linear rows stand above the angular ones.",
    ]
    return "\n\n".join(lines)


def _plain(name: str) -> str:
    """A student's name without what Markdown or HTML would read as markup."""
    return "".join(char for char in name if char not in "*_`<>[]\\$&#|")


def _question(number: int, exercise: Exercise, v: dict[str, Any]) -> str:
    goals = "\n".join(f"- {objective}" for objective in exercise.objectives)
    given = ", $\\quad$".join(
        f"${given_number(name, v[name], unit)}$" for name, unit in exercise.units.items() if name in v
    )
    figures = "\n\n".join(_figure(drawing) for drawing in exercise.drawings(v))
    title = f"## {number}. {exercise.title} ({exercise.points:g} points)"
    return "\n\n".join(
        part for part in (title, goals, exercise.statement(v), f"**Your numbers:** {given}", figures) if part
    )


def _figure(drawing: Drawing) -> str:
    """The drawing as a PNG data URI: attachments are not shown everywhere."""
    image = png(draw(drawing, WIDTH), 2 * WIDTH)
    return f'<img src="{data_uri(image)}" alt="{drawing.alt}" width="{WIDTH}">\n\n*{drawing.caption}*'


def _prompt(part: Part, *, hints: bool) -> str:
    asked = f" to {part.answer.decimals} decimals" if isinstance(part.answer, Numbers) else ""
    text = f"**`{part.variable}`** ({part.points:g} points): {part.prompt}{asked}."
    if hints and part.hints:
        listed = "\n".join(f"{i}. {hint}" for i, hint in enumerate(part.hints, 1))
        text += f"\n\n<details><summary>Hints</summary>\n\n{listed}\n\n</details>"
    return text


def _blank(part: Part) -> str:
    if isinstance(part.answer, TableOf):
        return f"{part.variable} = ...  # {len(part.answer.kinds)} rows [theta, d, a, alpha]"
    shape = " x ".join(map(str, part.answer.shape))
    return f"{part.variable} = ...  # {shape} numbers"


def self_check(parts: Sequence[Part]) -> str:
    """A cell that needs nothing installed: which answers are there, of the right shape and finite."""
    shapes = {
        part.variable: (len(part.answer.kinds), 4) if isinstance(part.answer, TableOf) else part.answer.shape
        for part in parts
    }
    tables = [part.variable for part in parts if isinstance(part.answer, TableOf)]
    listed = "".join(f"    {name!r}: {shape!r},\n" for name, shape in shapes.items())
    template = files("kinegrade.course").joinpath("templates/self_check.txt").read_text(encoding="utf-8")
    return template.replace("@SHAPES@", listed.rstrip("\n")).replace("@TABLES@", repr(tables)).rstrip("\n")


def _markdown(text: str) -> Any:
    return nbformat.v4.new_markdown_cell(text)


def _code(source: str, answer: str = "") -> Any:
    # Tags are for people and tools that keep them; answers are collected by the variable's name.
    return nbformat.v4.new_code_cell(source, metadata={"tags": ["answer", answer]} if answer else {})


def _written(cells: list[Any], about: dict[str, Any], identity: str) -> bytes:
    for i, cell in enumerate(cells):
        cell["id"] = hashlib.sha256(f"{identity}/{i}".encode()).hexdigest()[:8]  # nbformat draws a random one
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}, KEY: about}
    notebook = nbformat.v4.new_notebook(cells=cells, metadata=metadata)
    nbformat.validate(notebook)
    return (nbformat.writes(notebook) + "\n").encode("utf-8")
