"""An exercise with its texts in another language; what it computes and marks is untouched."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...exercises.drawing import Drawing
from ...exercises.exercise import Choice, Exercise, Given, Manual, Part, Step, Variant
from ...exercises.files.finding import exercise_files
from .catalogues import retelling
from .retelling import Retelling
from .speech import ENGLISH, Language, later, phrase

ENGLISH_ONLY = later("This exercise has no translation; it stands here in English.")


def translations(slugs: Sequence[str], language: Language, *folders: Path) -> dict[str, Path]:
    """The files with the translations of exercises, each beside its exercise file, by slug.

    Raises:
        ExerciseError: an exercise file cannot be read.
    """
    if language == ENGLISH:
        return {}
    files = exercise_files(*folders)
    found: dict[str, Path] = {}
    for slug in slugs:
        if slug not in files:
            continue
        path = files[slug].with_suffix(f".{language}.po")
        if path.is_file():
            found[slug] = path
    return found


def translated(exercise: Exercise, language: Language, path: Path | None) -> Exercise:
    """The exercise as it is shown; without a translation, in English with a note that says so.

    It is for showing only: answers are marked by the exercise as it was written.

    Raises:
        CourseError: the translation cannot be read.
    """
    if language == ENGLISH:
        return exercise
    if path is None:

        def statement(v: Variant) -> str:
            return _noted(exercise.statement(v))

        return replace(exercise, statement=statement)
    return _Telling(exercise, retelling(language, (path,))).exercise()


def _noted(statement: str) -> str:
    """The statement behind the note, in the language spoken when it is written."""
    return f"*{phrase(ENGLISH_ONLY)}*\n\n{statement}".rstrip()


class _Telling:
    """An exercise, and how its texts are told."""

    def __init__(self, written: Exercise, retelling: Retelling) -> None:
        self._written = written
        self._told = retelling.told

    def exercise(self) -> Exercise:
        written = self._written
        return replace(
            written,
            title=self._told(written.title),
            objectives=tuple(map(self._told, written.objectives)),
            statement=self._statement,
            parts=tuple(map(self._part, written.parts)),
            drawings=self._drawings,
            solved_drawings=self._solved_drawings,
        )

    def _statement(self, v: Variant) -> str:
        return self._told(self._written.statement(v))

    def _drawings(self, v: Variant) -> tuple[Drawing, ...]:
        return tuple(map(self._drawing, self._written.drawings(v)))

    def _solved_drawings(self, v: Variant) -> tuple[Drawing, ...]:
        return tuple(map(self._drawing, self._written.solved_drawings(v)))

    def _part(self, part: Part) -> Part:
        return replace(
            part,
            prompt=self._told(part.prompt),
            hints=tuple(map(self._told, part.hints)),
            answer=self._answer(part.answer),
            explain=self._explain(part),
        )

    def _answer(self, answer: Any) -> Any:
        if isinstance(answer, Choice):
            return replace(answer, options=tuple(map(self._told, answer.options)))
        if isinstance(answer, Manual):
            rubric = [(points, self._told(text)) for points, text in answer.rubric]
            return replace(answer, rubric=tuple(rubric))
        return answer

    def _explain(self, part: Part) -> Any:
        written = part.explain
        if not callable(written):
            return written

        def explain(v: Variant, given: Given) -> Any:
            told: Any = written(v, given)
            if told is None or isinstance(told, str):  # refused where steps are written
                return told
            return [self._step(step) for step in told]

        return explain

    def _step(self, step: Any) -> Any:
        if not isinstance(step, Step):
            return step
        return replace(step, text=self._told(step.text))

    def _drawing(self, drawing: Drawing) -> Drawing:
        return replace(drawing, caption=self._told(drawing.caption), alt=self._told(drawing.alt))
