"""One exercise of one student: readable, right from the reference, or right from the student's own earlier answers."""

import logging
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from ..exercises.exercise import Exercise, Numbers, Part, TableOf, Variant, references, solve
from ..solutions.table import Table
from .compare import Mask, earning_entries, fraction, right_entries, varying_entries
from .findings import findings, presentation
from .follow import Others, is_trivial, may_be_followed, owner_of, zeros_pass
from .read import Unreadable, read
from .tolerance import tolerance
from .verdict import Finding, Verdict, not_graded
from .wire import Raw

SAMPLE = 12  # draws that decide which entries vary between students
MOST_TEXT = 400  # of a sentence that repeats what a student's process said
log = logging.getLogger(__name__)


@dataclass(frozen=True)
class _Sheet:
    """What marking one exercise of one student refers to: its references and the answers that could be read."""

    exercise: Exercise
    v: Variant
    reference: Mapping[str, Any]
    answers: Mapping[str, Any]
    verdicts: Mapping[str, Verdict]
    copied: Mapping[str, str]


def mark(exercise: Exercise, v: Variant, raws: Mapping[str, Raw], others: Others | None = None) -> list[Verdict]:
    """A verdict for every asked part. A failure of ours in one part leaves that part `not_graded` and no other.

    Nothing follows from a wrong answer that is the right one of somebody in `others`.
    """
    reference = references(exercise, v)
    answers: dict[str, Any] = {}
    verdicts: dict[str, Verdict] = {}
    copied: dict[str, str] = {}
    for part in exercise.asked:
        raw = raws.get(part.variable, Raw("missing"))
        try:
            answer = read(part.answer, raw, v)
        except Unreadable as error:
            verdicts[part.variable] = _unreadable(part, raw, str(error))
            continue
        try:
            verdict = _judge(_Sheet(exercise, v, reference, answers, verdicts, copied), part, answer)
        except Exception:
            log.exception("%s could not be marked", part.variable)
            verdict = not_graded(part.variable, part.points, "The grader failed on this part; your answer is kept.")
        if verdict.status != "correct" and (owner := owner_of(part, answer, others or {})):
            copied[part.variable] = owner
            found = Finding(f"This is the reference answer of {owner}'s variant.", private=True)
            verdict = replace(verdict, findings=(*verdict.findings, found))
        answers[part.variable], verdicts[part.variable] = answer, verdict
    return [_with_note(verdict, raws.get(name, Raw("missing"))) for name, verdict in verdicts.items()]


def _with_note(verdict: Verdict, raw: Raw) -> Verdict:
    """The verdict, with how the cell ended that left a wrong value behind."""
    if not raw.note or verdict.status not in ("incorrect", "partly"):
        return verdict
    return replace(verdict, findings=(*verdict.findings, Finding(f"In your file: {raw.note[:MOST_TEXT]}.")))


def _unreadable(part: Part, raw: Raw, sentence: str) -> Verdict:
    if raw.kind == "missing":
        return Verdict(part.variable, "missing", 0.0, part.points)
    said = sentence[:MOST_TEXT]
    text = f"In your file: {said}." if raw.kind == "error" else f"{said[:1].upper()}{said[1:]}."
    return Verdict(part.variable, "failed", 0.0, part.points, (Finding(text),))


def _judge(sheet: _Sheet, part: Part, answer: Any) -> Verdict:
    given = {name: sheet.reference[name] for name in part.needs}
    verdict = _compare(sheet, part, given, answer)
    if verdict.status == "correct":
        return verdict
    followed = _follow(sheet, part, answer)
    if followed and (followed.points or 0) > (verdict.points or 0):
        return followed
    found = tuple(findings(sheet.exercise, part, sheet.v, given, answer, verdict.right))
    return replace(verdict, findings=(*verdict.findings, *found))


def _compare(sheet: _Sheet, part: Part, given: Mapping[str, Any], answer: Any) -> Verdict:
    """The verdict against what follows from `given`: points by earning entries, none for a worthless presentation."""
    wanted = solve(sheet.exercise.slug, part, sheet.v, given)
    right = right_entries(sheet.exercise, part, sheet.v, given, wanted, answer)
    reading, noted = "", ()
    if part.check:
        outcome = part.check(sheet.v, given, answer)
        right = right if outcome.right is None else np.broadcast_to(np.asarray(outcome.right, dtype=bool), right.shape)
        reading, noted = outcome.reading, (Finding(outcome.finding),) if outcome.finding else ()
    share = 0.0 if _worthless(sheet, part, given, wanted, answer, right) else _share(sheet, part, right)
    status = "correct" if right.all() else "partly" if share > 0 else "incorrect"
    points = round(part.points * share, 2)
    return Verdict(part.variable, status, points, part.points, noted, reading, right.tolist(), _printable(answer))


def _share(sheet: _Sheet, part: Part, right: Mask) -> float:
    earning = _earning(sheet, part)
    if isinstance(part.answer, TableOf):  # a wrong constant voids its joint's row
        return fraction(right.T, earning.T, part.credit)
    return fraction(right, earning, part.credit)


def _earning(sheet: _Sheet, part: Part) -> Mask:
    return earning_entries(part, sheet.reference[part.variable], _varying(sheet.exercise)[part.variable], sheet.v)


def _worthless(sheet: _Sheet, part: Part, given: Mapping[str, Any], wanted: Any, answer: Any, right: Mask) -> bool:
    if right.all() or not isinstance(part.answer, Numbers):
        return False
    allowed = tolerance(sheet.exercise.slug, part, sheet.v, given, sheet.exercise.scale(sheet.v))
    known = presentation(part.answer, answer, wanted, allowed)
    return known is not None and known.worthless


def _follow(sheet: _Sheet, part: Part, answer: Any) -> Verdict | None:
    """The verdict against what follows from the student's own earlier answers; None where nothing follows.

    Answers that were accepted though they differ from the reference keep the full share; wrong ones earn `follow`.
    """
    own = [name for name in part.needs if name in sheet.answers]
    if (
        not own
        or part.follow == 0
        or not all(may_be_followed(sheet.verdicts[name], name in sheet.copied) for name in own)
    ):
        return None
    given = {name: sheet.answers.get(name, sheet.reference[name]) for name in part.needs}
    try:
        with np.errstate(all="ignore"):
            wanted = solve(sheet.exercise.slug, part, sheet.v, given)
            if _is_easier(sheet, part, given, wanted):
                return None
            verdict = _compare(sheet, part, given, answer)
    except Exception:  # noqa: BLE001 - solve() on a student's data may fail in any way; then nothing follows from it
        return None
    wrong = " and ".join(name for name in own if sheet.verdicts[name].status != "correct")
    if not wrong:
        return verdict
    all_right = verdict.status == "correct"
    noted = Finding(f"{'It follows' if all_right else 'The entries marked right follow'} from your own {wrong}.")
    status = "partly" if all_right and part.follow < 1 else verdict.status
    points = round((verdict.points or 0.0) * part.follow, 2)
    return replace(verdict, status=status, points=points, findings=(*verdict.findings, noted))


def _is_easier(sheet: _Sheet, part: Part, given: Mapping[str, Any], wanted: Any) -> bool:
    """Whether the student's own data made the part easier than it is."""
    values = {**given, part.variable: wanted}
    if any(is_trivial(sheet.reference[name], value) for name, value in values.items()):
        return True
    if not isinstance(part.answer, Numbers):
        return False
    allowed = tolerance(sheet.exercise.slug, part, sheet.v, given, sheet.exercise.scale(sheet.v))
    return zeros_pass(wanted, allowed, _earning(sheet, part))


@lru_cache(maxsize=64)
def _varying(exercise: Exercise) -> dict[str, Mask]:
    variants: list[Variant] = [exercise.draw(np.random.default_rng(seed)) for seed in range(SAMPLE)]
    answers = [references(exercise, v) for v in variants]
    return {
        part.variable: varying_entries([answer[part.variable] for answer in answers], part, variants)
        for part in exercise.asked
    }


def _printable(answer: Any) -> Any:
    if isinstance(answer, Table):
        return [[str(cell) for cell in row] for row in answer.rows]
    return np.asarray(answer).tolist()
