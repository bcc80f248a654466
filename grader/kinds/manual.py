"""Text that a person marks: it is read, and compared with nothing."""

import numpy as np

from ...exercises.answers import Manual, Variant
from ..collecting.wire import Raw
from ..reading.arrays import flat_texts
from ..reading.unreadable import Unreadable
from .marker import Comparison, Marker, Wanted

MOST_TEXT = 20_000  # characters of an argument in words


def read_text(_: Manual, raw: Raw, __: Variant) -> str:
    """The text; a list of texts as its lines.

    Raises:
        Unreadable: it is no text, or a very long one.
    """
    if raw.kind != "text":
        raise Unreadable("takes text in quotes")
    text = raw.value
    if not isinstance(text, str):
        lines, _shape = flat_texts(text)
        text = "\n".join(lines)
    if len(text) > MOST_TEXT:
        raise Unreadable(f"takes up to {MOST_TEXT} characters, got {len(text)}")
    return text


def _compared(_: Manual, __: Variant, ___: Wanted, ____: str) -> Comparison:
    """No program marks it."""
    return Comparison(np.zeros((), dtype=bool), 0.0)


def _handed_in(_: Manual, value: str, __: Variant) -> Raw:
    return Raw("text", value)


MARKER = Marker(read_text, _compared, _handed_in)
