"""A sentence with {names} in it, as a pattern that finds what stood in their places."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

PLACE = re.compile(r"\{([a-z]\w*)\}", re.ASCII)
"""A place in a sentence; braces of LaTeX that look like one match themselves."""
SHORT = 3  # letters and signs of what joins two places: and, or


@dataclass(frozen=True)
class Pattern:
    """A sentence and what it is in another language, with the same places in any order."""

    sentence: str
    translation: str

    @property
    def places(self) -> list[str]:
        """The names of its places, in their order."""
        return PLACE.findall(self.sentence)

    @property
    def start(self) -> str:
        """Its first word, where that is fixed; else nothing."""
        word, blank, _ = PLACE.split(self.sentence)[0].partition(" ")
        return word if blank else ""

    @property
    def is_joint(self) -> bool:
        """Whether it is little more than its places, as "{one} and {other}"."""
        return len(PLACE.sub("", self.sentence).replace(" ", "")) <= SHORT

    @property
    def fixed(self) -> int:
        """How many characters are fixed: the more, the more a match means."""
        return len(PLACE.sub("", self.sentence))

    @cached_property
    def _expression(self) -> re.Pattern[str]:
        expression = ""
        seen: set[str] = set()
        for i, piece in enumerate(PLACE.split(self.sentence)):
            if i % 2 == 0:
                expression += re.escape(piece)
            elif piece in seen:
                expression += f"(?P={piece})"
            else:
                seen.add(piece)
                expression += f"(?P<{piece}>.+?)"
        return re.compile(expression, re.DOTALL)

    def values(self, text: str) -> dict[str, str] | None:
        """What stands in the places of a text; None where it is another sentence."""
        found = self._expression.fullmatch(text)
        return None if found is None else found.groupdict()

    def told(self, values: dict[str, str], of: Callable[[str], str]) -> str:
        """The translation with the values in its places, each told by `of`."""
        return PLACE.sub(lambda place: of(values[place[1]]), self.translation)
