"""Proof that the worked solution of an exercise runs: collected and marked as a student's."""

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

from ...exercises.exercise import Exercise, Function, Manual
from ...grader.collecting.ask import Limits
from ...grader.collecting.collect import cannot_run
from ...grader.jail.jail import FOR_ONE, Jail
from ...grader.jail.level import ANY
from ...grader.marking.answer_key import AnswerKey
from ...grader.marking.mark import mark
from ..sheet.submissions import READERS, Submission


def unasked(exercise: Exercise, v: dict[str, Any], key: AnswerKey) -> dict[str, str]:
    """Functions that cannot be printed, and calls that cannot be made, of whatever file.

    Variables with a sentence each.
    """
    found: dict[str, str] = {}
    for part in exercise.asked:
        if not isinstance(part.answer, Function):
            continue
        sentence = part.answer.unprintable(part.variable, key.reference[part.variable])
        if sentence:
            found[part.variable] = sentence
    for suffix in READERS:
        submission = Submission(Path(f"solution{suffix}"), b"")
        for ask in submission.asks(exercise, v):
            if ask.hindrance:
                found[ask.name] = ask.hindrance
    return found


def unsolved(
    exercise: Exercise, v: dict[str, Any], key: AnswerKey, solution: bytes, known: Collection[str]
) -> Iterator[tuple[str, str]]:
    """Parts that the notebook with the worked solution does not earn in full, with a sentence each.

    Parts that are `known` to be at fault are left out; where no notebook can run, all are.
    """
    if cannot_run():
        return
    submission = Submission(Path("solution.ipynb"), solution)
    with Jail(ANY, preload=FOR_ONE) as jail:  # the solution is ours, not a student's
        raws = submission.raws(submission.asks(exercise, v), Limits(), jail)
    for part, verdict in zip(exercise.asked, mark(exercise, v, raws, key=key), strict=True):
        if part.variable in known or isinstance(part.answer, Manual):
            continue
        if verdict.points == part.points:
            continue
        said = " ".join(finding.text for finding in verdict.findings)
        earned = f"{verdict.points} of {part.points:g}"
        yield part.variable, f"the notebook with the worked solution earns {earned}. {said}"
