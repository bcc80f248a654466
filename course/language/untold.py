"""The texts of an exercise that its translation does not have, for whoever writes one."""

from collections.abc import Iterator
from typing import Any

from ...exercises.exercise import Choice, Exercise, Manual, Part, references
from .retelling import Retelling


def untold(exercise: Exercise, v: dict[str, Any], retelling: Retelling) -> list[str]:
    """The sentences with one student's numbers that stay as they are, each once."""
    missing: list[str] = []
    for text in texts(exercise, v):
        missing += retelling.untold(text)
    return list(dict.fromkeys(missing))


def texts(exercise: Exercise, v: dict[str, Any]) -> Iterator[str]:
    """All that an exercise says by itself, with one student's numbers."""
    yield exercise.title
    yield from exercise.objectives
    yield exercise.statement(v)
    for drawing in (*exercise.drawings(v), *exercise.solved_drawings(v)):
        yield drawing.caption
        yield drawing.alt
    answers = references(exercise, v)
    for part in exercise.asked:
        yield from _of_part(part, v, answers)


def _of_part(part: Part, v: dict[str, Any], answers: dict[str, Any]) -> Iterator[str]:
    yield part.prompt
    yield part.answer.form
    yield part.answer.asked_beside
    yield from part.hints
    for mistake in part.mistakes:
        yield mistake.sentence
    if isinstance(part.answer, Choice):
        yield from part.answer.options
    if isinstance(part.answer, Manual):
        for _, text in part.answer.rubric:
            yield text
    if callable(part.explain):
        for step in part.explain(v, answers):
            yield step.text
