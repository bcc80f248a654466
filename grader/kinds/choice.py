"""The letter of an option."""

from typing import Any, cast

import numpy as np

from ...exercises.answers import Choice, Variant
from ...solutions.tokens import visible
from ..collecting.wire import Raw
from ..reading.arrays import flat_texts
from ..reading.unreadable import Unreadable, clip
from .marker import Comparison, Marker, Wanted, not_at_all


def read_choice(answer: Choice, raw: Raw, _: Variant) -> str:
    """The letter of the option that was handed in: the letter, the option, or both as printed.

    Raises:
        Unreadable: it is none of them.
    """
    text = visible(_single(raw)).strip().lower()
    typed = {text, text.strip("().: ")}
    for letter, option in zip(answer.letters, answer.options, strict=True):
        if typed & {letter, option.lower(), f"{letter}) {option.lower()}"}:
            return letter

    got = "a number" if raw.kind == "num" else repr(clip(raw.value))
    raise Unreadable(f"takes one of the letters {', '.join(answer.letters)} in quotes, got {got}")


def _single(raw: Raw) -> str:
    """What was handed in as text; a list or an array of one entry is that entry."""
    if raw.kind == "num" and raw.value.size == 1:  # an option may be a number
        return f"{raw.value.item():g}"
    value: Any = raw.value
    if isinstance(value, list):
        texts, _ = flat_texts(value)
        if len(texts) == 1:
            return texts[0]
    return str(cast("object", value))


def _compared(_: Choice, __: Variant, wanted: Wanted, value: str) -> Comparison:
    right = value == wanted.value
    return Comparison(np.array(right), float(right))


def _handed_in(_: Choice, value: str, __: Variant) -> Raw:
    return Raw("text", value)


MARKER = Marker(read_choice, _compared, _handed_in, alone=not_at_all)
