"""What can be said of answers without the key: readable, of the asked shape, fitting each other."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...exercises.exercise import Exercise, Manual, Part, Variant
from ..collecting.wire import Raw
from ..kinds.markers import read
from ..reading.unreadable import Unreadable
from .answer_key import AnswerKey
from .judge import judged


@dataclass(frozen=True)
class Remark:
    """One sentence on one part; `ok` is False when the student should look again."""

    part: str
    ok: bool
    text: str


def remarks(
    exercise: Exercise, v: Variant, raws: Mapping[str, Raw], *, consistency: bool
) -> Iterator[Remark]:
    """A remark on every asked part; with `consistency`, also whether it follows from earlier ones.

    The latter checks the student's J against the student's own T (S0, eq. 4.11) and uses no
    reference answer.
    """
    key = AnswerKey(exercise, v)
    answers: dict[str, Any] = {}
    for part in exercise.asked:
        raw = raws.get(part.variable, Raw("missing"))
        if isinstance(part.answer, Manual):
            yield _by_hand(part, part.answer, raw, v)
            continue
        if raw.kind in ("unasked", "interrupted"):
            yield Remark(part.variable, ok=True, text=f"not checked: {raw.value}")
            continue
        try:
            answers[part.variable] = read(part.answer, raw, v)
        except Unreadable as error:
            hint = f": {raw.value}" if raw.kind == "missing" and raw.value else ""
            yield Remark(part.variable, ok=False, text=f"{error}{hint}")
            continue
        if consistency and part.needs and all(need in answers for need in part.needs):
            yield _fits(key, part, answers)
        else:
            yield Remark(part.variable, ok=True, text="can be read")


def _by_hand(part: Part, answer: Manual, raw: Raw, v: Variant) -> Remark:
    """Whether there is something to mark, as marking has it."""
    if answer.on_paper:
        return Remark(part.variable, ok=True, text="is on paper; it is marked by hand")
    try:
        read(answer, raw, v)
    except Unreadable as error:
        return Remark(part.variable, ok=False, text=f"{error}; it is marked by hand")
    return Remark(part.variable, ok=True, text="is there; it is marked by hand")


def _fits(key: AnswerKey, part: Part, answers: Mapping[str, Any]) -> Remark:
    own = {need: answers[need] for need in part.needs}
    names = " and ".join(own)
    try:
        with np.errstate(all="ignore"):
            right = judged(key, part, key.following(part, own), answers[part.variable]).all_right
    except Exception:  # noqa: BLE001 - whatever a student's earlier answer does to solve(), nothing follows from it
        return Remark(
            part.variable,
            ok=True,
            text=f"can be read; nothing follows from your {names} to compare it with",
        )
    if right:
        return Remark(part.variable, ok=True, text=f"can be read and follows from your own {names}")
    return Remark(
        part.variable, ok=False, text=f"can be read, but does not follow from your own {names}"
    )
