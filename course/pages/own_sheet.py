"""The questions of a student's own sheet, as they were handed out: text, numbers and figures."""

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise
from ..sheet.assignment import Assignment
from ..sheet.question import question_text
from ..text.markdown import markdown_html

PICTURE = re.compile(r"data:image/[a-z+]+;base64,[A-Za-z0-9+/=]+")
HEADING = re.compile(r"\A## [^\n]*\n+")
PLACE = "\ue003{}\ue003"  # private characters round the number of a picture


def own_questions(
    released: Path, exercises: Sequence[Exercise], numbers: Mapping[str, dict[str, Any]]
) -> dict[str, str]:
    """HTML of what every exercise tells and gives, without its heading, by slug.

    It is read from the notebook that was handed out, with the figures that are in it; an exercise
    that is not found there is written and drawn anew from its `numbers`.
    """
    texts = _texts(released)
    questions: dict[str, str] = {}
    for number, exercise in enumerate(exercises, 1):
        if exercise.slug not in numbers:
            continue
        start = f"## {number}. {exercise.title} ("
        found = [text for text in texts if text.startswith(start)]
        if not found:
            found = [question_text(number, Assignment(exercise, numbers[exercise.slug]))]
        questions[exercise.slug] = _html(found[0])
    return questions


def _texts(released: Path) -> list[str]:
    """The Markdown cells of a notebook; none where it cannot be read."""
    try:
        cells = json.loads(released.read_bytes())["cells"]
        return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]
    except (OSError, ValueError, LookupError, TypeError):
        return []


def _html(text: str) -> str:
    """HTML of a question, its pictures kept out of the renderer's way, which is slow on them."""
    pictures: list[str] = PICTURE.findall(text)
    for i, picture in enumerate(pictures):
        text = text.replace(picture, PLACE.format(i))
    html = markdown_html(HEADING.sub("", text))
    for i, picture in enumerate(pictures):
        html = html.replace(PLACE.format(i), picture)
    return html
