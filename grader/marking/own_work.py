"""What can be said of answers without the key: readable, of the asked shape, fitting each other."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...exercises.exercise import Exercise, Manual, Part, Variant
from ..collecting.wire import Raw
from ..kinds.markers import marker_of, raw_of, read
from ..reading.unreadable import Unreadable
from .answer_key import AnswerKey
from .compare import compare
from .following import OwnAnswers, following
from .judge import judges
from .mark import mark_all
from .marked import Marked

READABLE = "can be read"


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

    The latter checks the student's J against the student's own T (S0, eq. 4.11). That a part
    follows is said where marking says so, by the same function; what is right stays untold. It is
    not said of answers that could be tried out until it fits: choices, conditions, whole numbers,
    and what a part's own check judges.
    """
    key = AnswerKey(exercise, v)
    marked = Marked(key)
    if consistency:
        mark_all(marked, raws)
    for part in exercise.asked:
        raw = raw_of(part, raws)
        if isinstance(part.answer, Manual):
            yield _by_hand(part, part.answer, raw, v)
            continue
        if raw.kind in ("unasked", "interrupted"):
            yield Remark(part.variable, ok=True, text=f"not checked: {raw.value}")
            continue
        try:
            answer = read(part.answer, raw, v)
        except Unreadable as error:
            hint = f": {raw.value}" if raw.kind == "missing" and raw.value else ""
            yield Remark(part.variable, ok=False, text=f"{error}{hint}")
            continue
        may_follow = _may_follow(exercise, part, marked.own)
        if may_follow and marker_of(part.answer).priced(part.answer, answer):
            yield _fits(key, part, marked.own, answer)
        else:
            yield Remark(part.variable, ok=True, text=READABLE)


def readable(part: Part, raws: Mapping[str, Raw], v: Variant, text: str = READABLE) -> Remark:
    """Whether a part's answer can be read, with nothing said of what it should be."""
    try:
        read(part.answer, raw_of(part, raws), v)
    except Unreadable as error:
        return Remark(part.variable, ok=False, text=str(error))
    return Remark(part.variable, ok=True, text=text)


def _may_follow(exercise: Exercise, part: Part, own: OwnAnswers) -> bool:
    """Whether the part is marked from own answers, and all that it needs are there.

    For one that is missing the reference would stand in, and so tell what is right.
    """
    if part.follow == 0:
        return False
    asked = {one.variable for one in exercise.asked}
    return bool(own.needed(part)) and asked.intersection(part.needs) <= own.answers.keys()


def _by_hand(part: Part, answer: Manual, raw: Raw, v: Variant) -> Remark:
    """Whether there is something to mark, as marking has it."""
    if answer.on_paper:
        return Remark(part.variable, ok=True, text="is on paper; it is marked by hand")
    try:
        read(answer, raw, v)
    except Unreadable as error:
        return Remark(part.variable, ok=False, text=f"{error}; it is marked by hand")
    return Remark(part.variable, ok=True, text="is there; it is marked by hand")


def _fits(key: AnswerKey, part: Part, own: OwnAnswers, answer: Any) -> Remark:
    names = " and ".join(own.needed(part))
    follows = following(key, part, own, names)
    untold = Remark(part.variable, ok=True, text=READABLE)
    if follows.why:  # the reason, said here, would tell that earlier numbers are not right
        return untold

    wanted = follows.wanted
    try:
        with np.errstate(all="ignore"):
            if wanted is not None and judges(key, part, wanted, answer):
                return untold
            right = wanted and compare(key, part, wanted, answer).all_right
    except Exception:  # noqa: BLE001 - a part's own check may fail in any way on what follows
        right = None
    if right is None:
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
