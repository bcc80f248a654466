"""Known mistakes of a part, as rules: which give the right answer, and which look alike."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np

from ...exercises.exercise import Numbers, Part
from ..kinds.marker import Wanted
from ..marking.answer_key import AnswerKey
from ..marking.judge import judged

Rule = tuple[str, Any]
"""The sentence of a mistake, and the wrong answer that it leads to."""


def known_rules(key: AnswerKey, part: Part) -> list[Rule]:
    """All rules that are known for a part.

    This is the one place that says which; a mistake that stops with an exception is none.
    """
    rules: list[Rule] = []
    try:
        for named, mistaken in key.mistaken(part, key.wanted(part)):
            rules.append((named.sentence, mistaken.value))
    except Exception:  # noqa: BLE001 - validate tells what a mistake of an exercise file raises
        return []
    return rules


def passing(key: AnswerKey, part: Part, rules: Sequence[Rule]) -> set[str]:
    """Sentences of the rules whose wrong answer passes for the right one."""
    wanted = key.wanted(part)
    return {sentence for sentence, value in rules if passes(key, part, wanted, value)}


def alike(key: AnswerKey, part: Part, rules: Sequence[Rule]) -> Iterator[tuple[str, str]]:
    """Pairs of rules that lead to one wrong answer, so that it does not tell which it was."""
    wanted = key.wanted(part)
    wrong: list[Rule] = []
    for sentence, value in rules:
        if not passes(key, part, wanted, value):
            wrong.append((sentence, value))

    for (one, first), (other, second) in combinations(wrong, 2):
        if one != other and _agree(key, part, replace(wanted, value=first), second):
            yield one, other


def passes(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> bool:
    """Whether an answer is as good as what is wanted, within its tolerance."""
    if part.check is None:
        return _agree(key, part, wanted, value)
    try:
        return judged(key, part, wanted, value).all_right
    except Exception:  # noqa: BLE001 - a part's own check may fail on a wrong answer in any way
        return False


def _agree(key: AnswerKey, part: Part, wanted: Wanted, value: Any) -> bool:
    """Whether two answers are equal by the kind's own comparison; of numbers, entry by entry."""
    if isinstance(part.answer, Numbers):
        return wanted.allowed.holds_everywhere(np.abs(value - wanted.value))
    try:
        return judged(key, replace(part, check=None), wanted, value).all_right
    except Exception:  # noqa: BLE001 - what cannot be compared is not equal
        return False
