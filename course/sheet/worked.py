"""The worked solution of a part: its steps, the general formula before the numbers."""

from collections.abc import Iterator, Sequence
from typing import Any

from ...exercises.exercise import ExerciseError, Manual, Part, Step
from ..text.escape import no_markup
from ..text.formulas import closed_form, matrix
from ..text.words import points_text

DECIMALS = 4  # of numbers in the worked solution of a part that asks for none


def worked_steps(part: Part, v: dict[str, Any], answers: dict[str, Any]) -> Iterator[str]:
    """Markdown of a part's steps, a text each.

    Raises:
        ExerciseError: what the part explains is text, or something else than steps.
    """
    decimals = getattr(part.answer, "decimals", DECIMALS)
    for step in _steps(part, v, answers):
        yield "\n\n".join(_blocks(step, decimals))


def _steps(part: Part, v: dict[str, Any], answers: dict[str, Any]) -> Sequence[Step]:
    """What `explain` returns, or is; none where the part has no explanation."""
    told: Any = part.explain
    if callable(told):
        told = told(v, answers)
    if told is None:
        return []
    if isinstance(told, str):  # its characters would be taken for steps
        raise _no_steps(part, "text")

    steps = list(told)
    for step in steps:
        if not isinstance(step, Step):
            raise _no_steps(part, type(told).__name__)
    return steps


def _no_steps(part: Part, got: str) -> ExerciseError:
    return ExerciseError(
        f"explain of {part.variable} takes a function that returns steps, "
        f'such as explain=lambda v, given: [Step("Differentiate the position:")], got {got}'
    )


def _blocks(step: Step, decimals: int) -> Iterator[str]:
    """The text, the formula and the numbers of a step, as far as it has them."""
    if step.text:
        yield step.text
    left = f"{step.symbol} = " if step.symbol else ""
    if step.formula is not None:
        yield f"$${left}{closed_form(step.formula)}$$"
    if step.numbers is not None:
        shown = decimals if step.decimals is None else step.decimals
        yield f"$${left}{matrix(step.numbers, shown)}$$"


def rubric(answer: Manual) -> str:
    """Markdown of the points of a part that is marked by hand, and what earns them."""
    lines: list[str] = []
    for points, text in answer.rubric:
        lines.append(f"- {points_text(points)}: {no_markup(text)}")
    return "\n".join(lines)
