"""The one base exception, and the question that helps with a name that nobody knows."""

import difflib
from collections.abc import Iterable


class KinegradeError(Exception):
    """A sentence for the instructor: what, where, and what would be right."""


def nearest(name: str, known: Iterable[str], cutoff: float = 0.6) -> str:
    """The known name that is spelled most like this one; empty where none comes near.

    `cutoff` in [0, 1] is how alike the two must be, as `difflib` measures it.
    """
    found = difflib.get_close_matches(name, list(known), 1, cutoff=cutoff)
    if not found:
        return ""
    return found[0]


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """A question with the nearest known name, such as "did you mean 'q1'?"; empty without one."""
    near = nearest(name, known)
    if not near:
        return ""
    return f"did you mean {near!r}?"
