"""The letter of an option."""

import numpy as np

from ...exercises.answers import Choice, Variant
from ..collecting.wire import Raw
from ..reading.unreadable import Unreadable, clip
from .marker import Comparison, Marker, Wanted


def read_choice(answer: Choice, raw: Raw, _: Variant) -> str:
    text = (
        f"{raw.value.item():g}"
        if raw.kind == "num" and raw.value.size == 1
        else str(raw.value).strip()
    )
    for letter, option in zip(answer.letters, answer.options, strict=True):
        ways = {letter, option.lower(), f"{letter}) {option.lower()}"}
        if {text.lower(), text.lower().strip("().: ")} & ways:
            return letter
    got = "a number" if raw.kind == "num" else repr(clip(raw.value))
    raise Unreadable(f"takes one of the letters {', '.join(answer.letters)} in quotes, got {got}")


def _compared(_: Choice, __: Variant, wanted: Wanted, value: str) -> Comparison:
    right = value == wanted.value
    return Comparison(np.array(right), float(right))


def _handed_in(_: Choice, value: str, __: Variant) -> Raw:
    return Raw("text", value)


MARKER = Marker(read_choice, _compared, _handed_in)
