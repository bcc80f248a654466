"""Why an answer cannot be judged, in a sentence for the student."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...solutions.errors import KinegradeError
from ...solutions.expression import ExpressionError

UNANSWERED = "not answered"


class Unreadable(KinegradeError):
    """An answer that cannot be judged; the lines after the first are typed text with a caret under the place."""


def clip(value: Any) -> str:
    """Something a student typed, short enough for a sentence."""
    text = " ".join(str(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def misread(error: ExpressionError, where: str = "") -> Unreadable:
    """The sentence of a formula that cannot be read, and where in it."""
    return Unreadable(f"{where}{': ' * bool(where)}{error.message}\n{error.caret}")


def entries_named(chosen: NDArray[np.bool_], most: int) -> str:
    """The first places of some entries in words, and how many more there are."""
    places = [entry_name(tuple(map(int, where))) for where in np.argwhere(chosen)]
    more = f" and {len(places) - most} more" if len(places) > most else ""
    return "; ".join(places[:most]) + more


def entry_name(where: tuple[int, ...]) -> str:
    """Place of an entry (indices from 0) in words."""
    numbers = [i + 1 for i in where]
    if len(numbers) < 2:
        return f"entry {numbers[0]}" if numbers else ""
    matrix = f"matrix {numbers[-3]}, " if len(numbers) > 2 else ""
    return f"{matrix}row {numbers[-2]}, column {numbers[-1]}"
