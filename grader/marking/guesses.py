"""What can be guessed counts beside own work: letters, conditions, ranks, tables in names.

A letter is right by chance once in four times, a slide is zero in many a singular posture, and a
table of lengths by their letters is right for many an arm. None of it depends on the numbers of one
student, so that it earns its points once parts do that take those numbers. Formulas are work by
themselves.
"""

from collections.abc import Sequence
from dataclasses import replace

from ...exercises.answers import Formulas, Manual
from ...exercises.exercise import Exercise, Part
from ..kinds.marker import Alone
from ..kinds.markers import marker_of
from .verdict import GUESSABLE, Finding, Verdict

OWN_WORK = 0.2  # of the points for parts that take a student's own numbers
ALONE = (
    f"{GUESSABLE}: it counts in full as soon as a fifth of the points is earned "
    "for the parts of this exercise that are computed with your numbers."
)


def counted(exercise: Exercise, verdicts: Sequence[Verdict]) -> list[Verdict]:
    """The verdicts of one exercise, where what can be guessed earns less without own work.

    Nothing is taken where no part is computed, or where one is not graded yet.
    """
    parts = {part.variable: part for part in exercise.asked}
    computed = [verdict for verdict in verdicts if _is_computed(parts[verdict.part])]
    if _has_own_work(computed):
        return [*verdicts]
    return [_alone(verdict, parts[verdict.part]) for verdict in verdicts]


def _counts_alone(part: Part) -> Alone:
    return marker_of(part.answer).alone(part.answer)


def _is_computed(part: Part) -> bool:
    """Whether it takes numbers of one student. Formulas are the same for an arm of one form."""
    return _counts_alone(part) == "in full" and not isinstance(part.answer, Formulas | Manual)


def _has_own_work(computed: Sequence[Verdict]) -> bool:
    earned = 0.0
    out_of = 0.0
    for verdict in computed:
        if verdict.points is None:
            return True
        earned += verdict.points
        out_of += verdict.out_of
    return earned >= OWN_WORK * out_of


def _alone(verdict: Verdict, part: Part) -> Verdict:
    """The verdict with what it is worth by itself."""
    if not verdict.points or _counts_alone(part) == "in full":
        return verdict
    findings = (*verdict.findings, Finding(ALONE))
    return replace(verdict, status="partly", points=0.0, findings=findings)
