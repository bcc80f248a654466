"""The text of a question: an exercise with its numbers and figures, and what each part asks."""

from collections.abc import Sequence
from html import escape

from ...exercises.exercise import Choice, Exercise, Part
from ...grader.figures.raster import data_uri
from ..language.speech import phrase, retold
from ..text.words import points_text
from .assignment import WIDTH, Assignment, Figure
from .given import given_form, given_numbers
from .heading import STACKED


def question_text(number: int, one: Assignment, *, order: bool = False) -> str:
    """Markdown of heading, statement, numbers and figures of an exercise.

    With `order`, it says which rows of a Jacobian come first.
    """
    exercise = one.exercise
    blocks = [f"## {number}. {exercise.title} ({points_text(exercise.points)})"]
    if exercise.objectives:
        blocks.append(f"*{' '.join(exercise.objectives)}*")
    if order:
        blocks.append(order_text(exercise))

    statement = exercise.statement(one.v)
    if statement:
        blocks.append(statement)
    blocks += given_numbers(exercise, one.v)
    form = given_form(exercise, one.v)
    if form:
        blocks.append(form)
    if one.figures:
        blocks.append(figures_text(one.figures))
    return "\n\n".join(blocks)


def order_text(exercise: Exercise) -> str:
    """Which rows of a Jacobian come first in an exercise."""
    rows = phrase(STACKED[exercise.rows])
    return phrase("In the Jacobians and twists of this exercise {rows}.", rows=rows)


def figures_text(figures: Sequence[Figure]) -> str:
    """Markdown: a table of figures over their captions."""
    images = [_image(figure) for figure in figures]
    centred = [":-:"] * len(figures)
    captions = [f"*{figure.caption}*" for figure in figures]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (images, centred, captions))


def _image(figure: Figure) -> str:
    """A figure as SVG in the text itself.

    JupyterLab, VS Code and GitHub show it there; they do not show an SVG that is attached.
    """
    source = data_uri(figure.svg)
    return f'<img src="{source}" alt="{escape(figure.alt)}" width="{WIDTH}">'


def prompt_text(part: Part, *, hints: bool) -> str:
    """Markdown of what a part asks, with its options and, where wanted, its hints."""
    blocks = [f"**`{part.variable}`** ({points_text(part.points)}): {asked(part)}"]
    if isinstance(part.answer, Choice):
        blocks.append(_options(part.answer))
    if hints and part.hints:
        blocks.append(_hints(part.hints))
    return "\n\n".join(blocks)


def asked(part: Part) -> str:
    """Markdown of what a part asks, as sentences, without its name."""
    stop = "" if part.prompt.endswith((".", "?", "!", ":")) else "."
    return f"{part.prompt}{stop} {retold(part.answer.asked_beside)}".rstrip()


def _options(answer: Choice) -> str:
    options = zip(answer.letters, answer.options, strict=True)
    return "\n".join(f"- **{letter})** {option}" for letter, option in options)


def _hints(hints: Sequence[str]) -> str:
    """A numbered list that opens when it is clicked on."""
    listed = "\n".join(f"{i}. {hint}" for i, hint in enumerate(hints, 1))
    return f"<details><summary>{phrase('Hints')}</summary>\n\n{listed}\n\n</details>"
