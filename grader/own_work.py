"""What can be said of answers without the key: readable, of the asked shape, and fitting each other."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ..exercises.exercise import Exercise, Part, Variant, solve
from .compare import right_entries
from .read import Unreadable, read
from .wire import Raw

Mode = Literal["practice", "graded", "exam"]


@dataclass(frozen=True)
class Remark:
    """One sentence on one part; `ok` is False when the student should look again."""

    part: str
    ok: bool
    text: str


def remarks(exercise: Exercise, v: Variant, raws: Mapping[str, Raw], *, consistency: bool) -> Iterator[Remark]:
    """A remark on every asked part; with `consistency`, also whether it follows from the student's earlier answers.

    The latter checks the student's J against the student's own T (S0, eq. 4.11) and uses no reference answer.
    """
    answers: dict[str, Any] = {}
    for part in exercise.asked:
        raw = raws.get(part.variable, Raw("missing"))
        try:
            answers[part.variable] = read(part.answer, raw, v)
        except Unreadable as error:
            yield Remark(part.variable, ok=False, text=str(error))
            continue
        if consistency and part.needs and all(need in answers for need in part.needs):
            yield _fits(exercise, part, v, answers)
        else:
            yield Remark(part.variable, ok=True, text="can be read")


def _fits(exercise: Exercise, part: Part, v: Variant, answers: Mapping[str, Any]) -> Remark:
    own = {need: answers[need] for need in part.needs}
    names = " and ".join(own)
    try:
        with np.errstate(all="ignore"):
            wanted = solve(exercise.slug, part, v, own)
            right = right_entries(exercise, part, v, own, wanted, answers[part.variable])
    except Exception:  # noqa: BLE001 - whatever a student's earlier answer does to solve(), nothing follows from it
        return Remark(part.variable, ok=True, text=f"can be read; nothing follows from your {names} to compare it with")
    if right.all():
        return Remark(part.variable, ok=True, text=f"can be read and follows from your own {names}")
    return Remark(part.variable, ok=False, text=f"can be read, but does not follow from your own {names}")
