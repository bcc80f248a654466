"""The arm as an answer moves it beside what the arm does, where that shows the mistake."""

from typing import Any

from markupsafe import Markup

from ...exercises.exercise import Exercise, Numbers, Part
from ...grader.figures.motion import motion
from ...grader.figures.sketch import sketch
from ...grader.marking.verdict import Verdict
from ..language.speech import later, phrase
from ..variants.record import Record

BOTH = later("the velocity of the tool point and the angular velocity of the tool")
SAYS = {
    "v": later("how the tool point moves when one joint turns or slides with rate 1"),
    "ω": later("the axis about which each joint turns the tool"),
    "z": later("the axis of each joint"),
    "x": later("the frame, its axes and where it stands"),
}
"""What is compared, by the symbol of the first vector that differs."""


def explained(
    exercise: Exercise, part: Part, record: Record, verdict: Verdict
) -> dict[str, Any] | None:
    """A figure of the arm with own and reference vectors; None where a part is about no motion."""
    reference = record.answers.get(part.variable)
    if verdict.status not in ("partly", "incorrect") or not isinstance(part.answer, Numbers):
        return None
    if reference is None or part.answer.shape[:1] not in ((3,), (4,), (6,)):
        return None
    found = motion(
        exercise.drawings(record.numbers),
        reference,
        verdict.answer,
        angular_first=exercise.rows == "angular, linear",
        given=record.numbers,
    )
    if found is None:
        return None
    first = found.vectors[0]
    what = phrase(SAYS.get(first.symbol, SAYS["x"]))
    if not first.index and first.symbol in ("v", "ω"):
        what = phrase(BOTH)
    title = phrase("Your arm at your q: {what}, as it is and as your answer has it", what=what)
    # Text and numbers of the drawing are ours.
    return {"svg": Markup(sketch(found, title)), "says": what}  # noqa: S704
