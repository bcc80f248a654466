"""An exercise with one student's numbers; what is worked out of them serves all formats."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...exercises.drawing import Drawing
from ...exercises.exercise import Exercise, references
from ...grader.figures.arm import draw
from .worked import worked_steps

WIDTH = 380  # of a figure on a page, in pixels


@dataclass(frozen=True)
class Figure:
    """A drawing as SVG, with its caption and a description for those who cannot see it."""

    svg: str
    caption: str
    alt: str

    @property
    def ratio(self) -> float:
        """Its height over its width."""
        view = self.svg.partition('viewBox="')[2].partition('"')[0]
        _, _, width, height = map(float, view.split())
        return height / width


@dataclass(frozen=True, eq=False)
class Assignment:
    """An exercise and the numbers that were drawn for a student."""

    exercise: Exercise
    v: dict[str, Any]

    @cached_property
    def figures(self) -> tuple[Figure, ...]:
        """The drawings of the question, each drawn once."""
        return tuple(_figure(drawing) for drawing in self.exercise.drawings(self.v))

    @cached_property
    def solved_figures(self) -> tuple[Figure, ...]:
        """The drawings that only the worked solution shows."""
        return tuple(_figure(drawing) for drawing in self.exercise.solved_drawings(self.v))

    @cached_property
    def answers(self) -> Mapping[str, Any]:
        """Reference answers by variable."""
        return references(self.exercise, self.v)

    @cached_property
    def solution(self) -> Mapping[str, tuple[str, ...]]:
        """The steps of the worked solution in Markdown, by variable.

        Raises:
            ExerciseError: what a part explains is text, or something else than steps.
        """
        answers = dict(self.answers)
        steps: dict[str, tuple[str, ...]] = {}
        for part in self.exercise.asked:
            steps[part.variable] = tuple(worked_steps(part, self.v, answers))
        return steps


def _figure(drawing: Drawing) -> Figure:
    return Figure(draw(drawing, WIDTH), drawing.caption, drawing.alt)
