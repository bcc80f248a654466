"""An exercise as its people see it, on one page: sheet, solution, feedback of known mistakes."""

from typing import Any

import numpy as np
from markupsafe import Markup

from ...exercises.answers import Manual
from ...exercises.exercise import Exercise, Part
from ...grader.collecting.wire import Raw
from ...grader.kinds.markers import handed_in
from ...grader.marking.answer_key import AnswerKey
from ...grader.marking.mark import mark
from ..pages.feedback import feedback_block
from ..pages.page import template
from ..sheet.assignment import Assignment
from ..sheet.given import given_cell
from ..sheet.question import prompt_text, question_text
from ..sheet.worked import rubric, worked_steps
from ..text.markdown import markdown_html
from ..text.words import points_text
from ..variants.drawn import drawn
from .draw import raws_of


def preview_page(exercise: Exercise, seed: int) -> str:
    """HTML that needs nothing else: the exercise with the numbers of that draw.

    Raises:
        ExerciseError: the exercise fails on these numbers; `validate` says more.
    """
    v = drawn(exercise, np.random.default_rng(seed))
    key = AnswerKey(exercise, v)
    right = raws_of(exercise, key.reference, v)
    return template("preview.html").render(
        exercise=exercise,
        seed=seed,
        points=points_text(exercise.points),
        about=_html(question_text(1, Assignment(exercise, v))),
        given=given_cell(exercise, v),
        parts=[_part(key, part, right) for part in exercise.asked],
    )


def _html(text: str) -> Markup:
    return Markup(markdown_html(text))  # noqa: S704 - the exercise's own text


def _part(key: AnswerKey, part: Part, right: dict[str, Raw]) -> dict[str, Any]:
    """What the page shows of one part."""
    reference = key.reference[part.variable]
    solution = [_html(step) for step in worked_steps(part, dict(key.v), key.reference)]
    if isinstance(part.answer, Manual):
        solution.append(_html(rubric(part.answer)))

    mistakes: list[dict[str, Any]] = []
    for named, wanted in key.mistaken(part, key.wanted(part)):
        mistake = _mistake(key, part, right, wanted.value)
        mistakes.append({"sentence": named.sentence, **mistake})
    return {
        "variable": part.variable,
        "prompt": _html(prompt_text(part, hints=True)),
        "needs": part.needs,
        "solution": solution,
        "code": part.answer.code(part.variable, reference),
        "mistakes": mistakes,
    }


def _mistake(key: AnswerKey, part: Part, right: dict[str, Raw], value: Any) -> dict[str, Any]:
    """The feedback of a sheet that is right but for this value, and what the part loses by it."""
    raws = {**right, part.variable: handed_in(part.answer, value, key.v)}
    verdicts = {verdict.part: verdict for verdict in mark(key.exercise, key.v, raws, key=key)}
    verdict = verdicts[part.variable]
    lost = part.points - (verdict.points or 0.0)
    return {"feedback": feedback_block(part, verdict), "loses": f"{lost:g}"}
