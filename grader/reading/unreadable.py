"""Why an answer cannot be judged, in a sentence for the student."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.errors import KinegradeError
from ...solutions.expression import ExpressionError

UNANSWERED = "not answered"


class Unreadable(KinegradeError):
    """An answer that cannot be judged.

    The lines after the first are typed text with a caret under the place.
    """


def clip(value: Any) -> str:
    """Something a student typed, short enough for a sentence."""
    text = " ".join(str(value).split())
    if len(text) <= 60:
        return text
    return text[:57] + "..."


def misread(error: ExpressionError, where: str = "") -> Unreadable:
    """The sentence of a formula that cannot be read, and where in it."""
    place = f"{where}: " if where else ""
    return Unreadable(f"{place}{error.message}\n{error.caret}")


def entries_named(chosen: NDArray[np.bool_], most: int) -> str:
    """The first places of some entries in words, and how many more there are."""
    places = np.argwhere(chosen)
    named = "; ".join(entry_name(tuple(map(int, place))) for place in places[:most])
    left = len(places) - most
    return f"{named} and {left} more" if left > 0 else named


def entry_name(where: tuple[int, ...]) -> str:
    """Place of an entry (indices from 0) in words."""
    if not where:
        return ""
    if len(where) == 1:
        return f"entry {where[0] + 1}"
    place = f"row {where[-2] + 1}, column {where[-1] + 1}"
    if len(where) == 2:
        return place
    return f"matrix {where[-3] + 1}, {place}"
