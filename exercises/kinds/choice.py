"""One of several lettered options."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .kind import Kind, ValueKindError, Variant
from .paper import Paper

LETTERS = "abcdefghijklmnopqrstuvwxyz"


@dataclass(frozen=True)
class Choice(Kind):
    """One of several `options`, lettered a, b, c ... in their order. Its value is the letter."""

    options: tuple[str, ...]

    @property
    def letters(self) -> str:
        """Valid answers."""
        return LETTERS[: len(self.options)]

    @property
    def form(self) -> str:
        """The letters."""
        return f"one of {', '.join(map(repr, self.letters))}"

    @property
    def self_check(self) -> tuple[str, Any]:
        """With the letters."""
        return "choice", self.letters

    @property
    def paper(self) -> Paper:
        """The letters."""
        return Paper(letters=self.letters)

    def declared(self, value: Any, v: Variant) -> str:
        """A letter."""
        if value not in [*self.letters]:
            raise ValueKindError(
                f"takes one of the letters {', '.join(self.letters)}, got {value!r}"
            )
        return value

    def pictured(self, value: str, v: Variant) -> NDArray[np.float64]:
        """The place of the letter."""
        return np.array(float(self.letters.index(value)))

    def matlab(self, stacked: str) -> tuple[str, str]:
        """Text."""
        return "''", f"one of {', '.join(self.letters)}"
