"""The nearest valid name to one that is not known."""

from collections.abc import Iterable

from ...solutions.errors import did_you_mean


def hint(name: str, known: Iterable[str]) -> str:
    """The question for the nearest valid name in brackets, or nothing."""
    question = did_you_mean(name, known)
    return f" ({question})" if question else ""
