"""Students of a class who handed in the same wrong numbers: their marks are looked at again."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...exercises.exercise import Numbers, Part
from ...grader.marking.follow import HANDED_IN_TOO, TELLING, Peers, different_numbers, is_own
from ...grader.marking.sharing import sharing
from ...grader.marking.verdict import Verdict

Verdicts = Mapping[str, Iterable[Verdict]]
"""Student to the verdicts of one sheet."""


def same_numbers(parts: Mapping[str, Part], marked: Verdicts) -> dict[str, Peers]:
    """Student to the others with the same wrong numbers, and what these handed in.

    Whose many numbers are right was not helped by them, and is not looked at again.
    """
    handed: dict[str, dict[str, Any]] = {}
    own: dict[str, set[str]] = {}
    for student, verdicts in marked.items():
        wrong = [verdict for verdict in verdicts if tells(parts.get(verdict.part), verdict)]
        handed[student] = {verdict.part: verdict.answer for verdict in wrong}
        own[student] = {verdict.part for verdict in wrong if is_own(*_numbers(verdict))}
    return {
        student: peers
        for student, peers in sharing(parts.values(), handed).items()
        if any(answers.keys() - own[student] for answers in peers.values())
    }


def marked_for_it(verdicts: Iterable[Verdict]) -> bool:
    """Whether a student's marks say that somebody else has the same numbers."""
    for verdict in verdicts:
        for finding in verdict.findings:
            if finding.private and finding.text.endswith(HANDED_IN_TOO):
                return True
    return False


def tells(part: Part | None, verdict: Verdict) -> bool:
    """Whether an answer has enough wrong numbers to tell that they were not computed twice."""
    if part is None or not isinstance(part.answer, Numbers):
        return False
    if verdict.status not in ("partly", "incorrect", "follows"):
        return False
    answer, right = _numbers(verdict)
    return different_numbers(np.where(right, 0.0, answer)) >= TELLING


def _numbers(verdict: Verdict) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """The numbers of an answer, and which of them are right."""
    answer = np.asarray(verdict.answer, dtype=np.float64)
    return answer, np.broadcast_to(np.asarray(verdict.right, dtype=bool), answer.shape)
