"""What is marked by hand."""

from dataclasses import dataclass
from typing import Any

from .kind import Kind, ValueKindError, Variant
from .paper import Paper


@dataclass(frozen=True)
class Manual(Kind):
    """A sketch, derivation or argument, marked by hand: points and what earns them, line by line.

    With `on_paper`, nothing is expected in the file. Its value is text: the marker's key as
    reference.
    """

    rubric: tuple[tuple[float, str], ...]
    on_paper: bool = False

    @property
    def form(self) -> str:
        """Where it stands."""
        if self.on_paper:
            return "on paper"
        return "your text in quotes; it is marked by hand"

    @property
    def self_check(self) -> tuple[str, Any]:
        """Text."""
        return "text", None

    @property
    def asked_beside(self) -> str:
        """That a person marks it."""
        if self.on_paper:
            return "On paper, marked by hand."
        return "Marked by hand."

    @property
    def paper(self) -> Paper:
        """Lines for an argument or a sketch."""
        return Paper(lines=9)

    def declared(self, value: Any, v: Variant) -> str:
        """The marker's key."""
        if not isinstance(value, str):
            raise ValueKindError(f"takes text, the marker's key, got {type(value).__name__}")
        return value

    def pictured(self, value: str, v: Variant) -> None:
        """Nothing can be computed from what is marked by hand."""

    def matlab(self, stacked: str) -> tuple[str, str]:
        """Text, of several lines too."""
        return "''", "your text; ['first line' newline 'second line'] has two lines"


def is_on_paper(answer: Kind) -> bool:
    """Whether nothing is expected in the file."""
    return isinstance(answer, Manual) and answer.on_paper
