"""The text of a question: an exercise with its numbers and figures, and what each part asks."""

from collections.abc import Sequence
from html import escape
from typing import Any

from ...exercises.drawing import Drawing
from ...exercises.exercise import Choice, Exercise, Part
from ...grader.figures.arm import draw
from ...grader.figures.raster import data_uri, png
from ..words import points_text
from .given import given_form, given_numbers
from .heading import STACKED

WIDTH = 380  # of a figure on the page, in pixels; the PNG has twice as many


def question_text(
    number: int, exercise: Exercise, v: dict[str, Any], *, order: bool = False
) -> str:
    """Markdown of heading, statement, numbers and figures of an exercise.

    With `order`, it says which rows of a Jacobian come first.
    """
    blocks = [f"## {number}. {exercise.title} ({points_text(exercise.points)})"]
    if exercise.objectives:
        blocks.append(f"*{' '.join(exercise.objectives)}*")
    if order:
        blocks.append(f"In the Jacobians and twists of this exercise {STACKED[exercise.rows]}.")

    statement = exercise.statement(v)
    if statement:
        blocks.append(statement)
    blocks += given_numbers(exercise, v)
    form = given_form(exercise, v)
    if form:
        blocks.append(form)

    drawings = exercise.drawings(v)
    if drawings:
        blocks.append(_figures(drawings))
    return "\n\n".join(blocks)


def _figures(drawings: Sequence[Drawing]) -> str:
    """A table of drawings over their captions."""
    images = [_image(drawing) for drawing in drawings]
    centred = [":-:"] * len(drawings)
    captions = [f"*{drawing.caption}*" for drawing in drawings]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (images, centred, captions))


def _image(drawing: Drawing) -> str:
    """A drawing as a PNG in the text itself: attachments are not shown everywhere."""
    source = data_uri(png(draw(drawing, WIDTH), 2 * WIDTH))
    return f'<img src="{source}" alt="{escape(drawing.alt)}" width="{WIDTH}">'


def prompt_text(part: Part, *, hints: bool) -> str:
    """Markdown of what a part asks, with its options and, where wanted, its hints."""
    stop = "" if part.prompt.endswith((".", "?", "!", ":")) else "."
    question = f"**`{part.variable}`** ({points_text(part.points)}): {part.prompt}{stop}"
    blocks = [f"{question} {part.answer.asked_beside}".rstrip()]
    if isinstance(part.answer, Choice):
        blocks.append(_options(part.answer))
    if hints and part.hints:
        blocks.append(_hints(part.hints))
    return "\n\n".join(blocks)


def _options(answer: Choice) -> str:
    options = zip(answer.letters, answer.options, strict=True)
    return "\n".join(f"- **{letter})** {option}" for letter, option in options)


def _hints(hints: Sequence[str]) -> str:
    """A numbered list that opens when it is clicked on."""
    listed = "\n".join(f"{i}. {hint}" for i, hint in enumerate(hints, 1))
    return f"<details><summary>Hints</summary>\n\n{listed}\n\n</details>"
