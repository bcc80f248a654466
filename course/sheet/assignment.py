"""An exercise with one student's numbers; what is worked out of them serves all formats."""

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...exercises.drawing import Drawing
from ...exercises.exercise import Exercise, references
from ...grader.figures.arm import draw
from ...grader.figures.missing import missing
from .worked import worked_steps

WIDTH = 380  # of a figure on a page, in pixels
LOST = "This figure could not be drawn."
log = logging.getLogger(__name__)


@dataclass(frozen=True)
class Figure:
    """A drawing as SVG, with its caption and a description for those who cannot see it.

    Where it could not be drawn, `lost` says why, and the SVG holds a sentence.
    """

    svg: str
    caption: str
    alt: str
    lost: str = ""

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
        return _figures(self.exercise.slug, self.exercise.drawings, self.v)

    @cached_property
    def solved_figures(self) -> tuple[Figure, ...]:
        """The drawings that only the worked solution shows."""
        return _figures(self.exercise.slug, self.exercise.solved_drawings, self.v)

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


def _figures(
    slug: str, drawings: Callable[[dict[str, Any]], tuple[Drawing, ...]], v: dict[str, Any]
) -> tuple[Figure, ...]:
    """The figures of an exercise; a sheet does not wait for one that cannot be drawn."""
    try:
        shown = drawings(v)
    except Exception as error:
        log.exception("the figures of %s are left out of a sheet", slug)
        return (_lost("", "", error),)
    return tuple(_figure(slug, drawing) for drawing in shown)


def _figure(slug: str, drawing: Drawing) -> Figure:
    try:
        return Figure(draw(drawing, WIDTH), drawing.caption, drawing.alt)
    except Exception as error:
        log.exception("a figure of %s is left out of a sheet", slug)
        return _lost(drawing.caption, drawing.alt, error)


def _lost(caption: str, alt: str, error: Exception) -> Figure:
    why = f"{type(error).__name__}: {error}"
    return Figure(missing(LOST, WIDTH), caption or LOST, f"{LOST} {alt}".rstrip(), why)
