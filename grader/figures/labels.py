"""Labels: what they say and how wide they are."""

import re
import unicodedata
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ...solutions.expression import latex_name
from .vectors import Array

SIZE = 16.0  # [px] of a symbol
SUB = 11.0  # [px] of a subscript
NARROW = frozenset("fijlrtI'.,()[]-")
WIDE = frozenset("mwMW@%")
SYMBOL = re.compile(r"(?:\\mathrm\{(\w+)\}|(\\?)(\w+?))(?:_\{?(\d+)\}?)?")


@dataclass(frozen=True, eq=False)
class Label:
    """A symbol that stands near one of its anchors.

    Attributes:
        symbol: Printed in italics.
        subscript: Printed after it, smaller.
        anchors: Points (k, 2), best first [px].
        away: The direction (k, 2) in which it shall stand from each, if possible.
        colour: As #rrggbb.
        css: The classes of its element.
        owner: Points (m, 2) that a reader could take it to belong to: it stands nearer to its own
            than to another's.
    """

    symbol: str
    subscript: str
    anchors: Array
    away: Array
    colour: str
    css: str
    owner: Array = field(default_factory=lambda: np.zeros((0, 2)))

    @cached_property
    def size(self) -> Array:
        """Estimated width and height [px]."""
        width = text_width(self.symbol, SIZE) + text_width(self.subscript, SUB)
        return np.array([width, SIZE])


@dataclass(frozen=True, eq=False)
class Placed:
    """A label with its `centre` (2,) and the anchor it belongs to [px]."""

    label: Label
    centre: Array
    anchor: Array

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom [px]."""
        low = self.centre - self.label.size / 2
        high = self.centre + self.label.size / 2
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def symbol_of(name: str) -> tuple[str, str]:
    r"""A parameter's letter and its subscript.

    "a1" is a with 1, "alpha2" the Greek letter with 2, "L" just L.
    """
    match = SYMBOL.fullmatch(latex_name(name))
    if match is None:
        return name, ""
    word, greek, letter, subscript = match.groups(default="")
    if greek:
        return unicodedata.lookup(f"GREEK SMALL LETTER {letter.upper()}"), subscript
    return word or letter, subscript


def text_width(text: str, size: float) -> float:
    """An estimate on the safe side of a text's width [px]."""
    return size * sum(map(_character_width, text))


def _character_width(character: str) -> float:
    """The width of a character over the size of its font."""
    if character in NARROW:
        return 0.36
    if character in WIDE:
        return 0.92
    return 0.7 if character.isupper() else 0.53
