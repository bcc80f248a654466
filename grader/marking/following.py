"""What follows from a student's own earlier answers: the one place that marking and `check` ask."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...exercises.exercise import Numbers, Part
from ..kinds.marker import Wanted
from .answer_key import AnswerKey
from .follow import is_trivial, zeros_pass

EASIER = "that would make this part easier than it is"


@dataclass(frozen=True)
class OwnAnswers:
    """What one student handed in so far.

    Attributes:
        answers: Those that could be read, by variable.
        unfollowed: Variables from which nothing follows, each with the reason.
    """

    answers: dict[str, Any] = field(default_factory=dict[str, Any])
    unfollowed: dict[str, str] = field(default_factory=dict[str, str])

    def needed(self, part: Part) -> tuple[str, ...]:
        """The own answers that a part needs."""
        return tuple(name for name in part.needs if name in self.answers)


@dataclass(frozen=True)
class Following:
    """What is wanted where a part follows from own answers; else, where there is one, why not."""

    wanted: Wanted | None = None
    why: str = ""


def following(key: AnswerKey, part: Part, own: OwnAnswers, wrong: str) -> Following:
    """What follows from own earlier answers; the reference stands in for those that are missing.

    `wrong` names the answers that are not right. Right ones, though rounded, make nothing easier.
    """
    for name in part.needs:
        if name in own.unfollowed:
            return Following(why=f"from your own {name}: {own.unfollowed[name]}")

    wanted = _wanted(key, part, own)
    if wanted is not None and wrong and _is_easier(key, part, wanted):
        return Following(why=f"from your own {wrong}: {EASIER}")
    return Following(wanted)


def _wanted(key: AnswerKey, part: Part, own: OwnAnswers) -> Wanted | None:
    if part.follow == 0 or not own.needed(part):
        return None
    given = {name: own.answers.get(name, key.reference[name]) for name in part.needs}
    try:
        with np.errstate(all="ignore"):
            return key.following(part, given)
    except Exception:  # noqa: BLE001 - solve() on a student's data may fail in any way
        return None


def _is_easier(key: AnswerKey, part: Part, wanted: Wanted) -> bool:
    """Whether the student's own data made the part easier than it is."""
    values = {**wanted.given, part.variable: wanted.value}
    if any(is_trivial(key.reference[name], value) for name, value in values.items()):
        return True
    if not isinstance(part.answer, Numbers):
        return False
    return zeros_pass(wanted.value, wanted.allowed, lambda: key.earning(part))
