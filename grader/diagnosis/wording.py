"""Sentences on several mistakes that come to the same."""

from collections.abc import Sequence

from .bank import Rules
from .mistake import Mistake

MOST = 3  # alternatives that are named


def either(mistakes: Sequence[Mistake]) -> str:
    """What is said of mistakes of which any one explains an answer, the likeliest first."""
    first, *others = mistakes
    if not others:
        return first.sentence
    clauses = ", or ".join(mistake.clause for mistake in mistakes[:MOST])
    more = "; other mistakes come to the same" if len(mistakes) > MOST else ""
    return f"Either {clauses}{more}."


def with_one_entry(mistakes: Sequence[Mistake], place: str) -> str:
    """What is said of an answer with one of these mistakes and one more wrong entry."""
    return f"But for {place} it fits one mistake. {either(mistakes)}"


def two_mistakes(pairs: Sequence[Rules]) -> str:
    """What is said of pairs of which any one explains an answer; nothing if they are too many."""
    if not pairs:
        return ""
    common = set(pairs[0]).intersection(*pairs)
    if len(pairs) == 1:
        one, other = pairs[0]
        return f"It is consistent with two mistakes: {one.clause}; and {other.clause}."
    if common:
        (shared,) = common
        return f"It is consistent with two mistakes, one of which: {shared.clause}."
    if len(pairs) > MOST:
        return ""
    said = "; or ".join(f"{one.clause}, and {other.clause}" for one, other in pairs)
    return f"It is consistent with two mistakes: {said}."
