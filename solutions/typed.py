"""Stand-in until the language lands."""

from collections.abc import Collection

from .expression import Expression, parse


def typed(text: str, names: Collection[str]) -> Expression:
    return parse(text, names)
