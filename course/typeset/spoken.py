"""Formulas in words, for readers who listen: a walk along their MathML."""

from collections.abc import Callable, Sequence
from unicodedata import normalize
from xml.etree.ElementTree import Element

from .mathml import rows, tag, text

WORDS = {
    "−": "minus",
    "×": "times",
    "·": "times",
    "⋅": "times",
    "⋯": "and so on",
    "…": "and so on",
    "=": "equals",
    "+": "plus",
    "/": "per",
    "˙": "dot",
    "¨": "double dot",
    "^": "hat",
    "~": "tilde",
    "→": "arrow",
    "¯": "bar",
    "―": "bar",
    "′": "prime",
    "⏟": "brace",
}
"""What a sign is called; others are read as they stand."""


def spoken(element: Element) -> str:
    """An element in words, one blank between two."""
    speaker = SPEAKERS.get(tag(element), _row)
    return " ".join(speaker(element).split())


def _row(element: Element) -> str:
    """What is in it, one behind the other."""
    words: list[str] = []
    for inner in _without_brackets(list(element)):
        said = spoken(inner)
        upright = inner.get("mathvariant") == "normal"
        if upright and words and words[-1].startswith("\0"):
            words[-1] += said  # letters of one word
        else:
            words.append(f"\0{said}" if upright else said)
    return " ".join(words).replace("\0", "")


def _without_brackets(elements: Sequence[Element]) -> list[Element]:
    """Elements without the brackets of a matrix, which is called one."""
    kept: list[Element] = []
    for i, element in enumerate(elements):
        beside = elements[max(i - 1, 0) : i + 2]
        is_bracket = tag(element) == "mo" and text(element) in "[]"
        if is_bracket and any(tag(other) == "mtable" for other in beside):
            continue
        kept.append(element)
    return kept


def _leaf(element: Element) -> str:
    plain = normalize("NFKC", text(element))  # a bold letter may be a character of its own
    return WORDS.get(text(element), plain)


def _space(element: Element) -> str:
    return ", " if element.get("width") == "1em" else ""


def _sub(element: Element) -> str:
    base, below = element
    return f"{spoken(base)} sub {spoken(below)}"


def _sup(element: Element) -> str:
    base, above = element
    said = spoken(above)
    if said == "prime":
        return f"{spoken(base)} prime"
    if said == "2" and not _is_bold(base):
        return f"{spoken(base)} squared"
    return f"{spoken(base)} super {said}"


def _is_bold(base: Element) -> bool:
    """Whether it is a vector or a matrix, on which a number is an index."""
    return any("bold" in element.get("mathvariant", "") for element in base.iter())


def _sub_sup(element: Element) -> str:
    base, below, above = element
    return f"{spoken(base)} sub {spoken(below)} super {spoken(above)}"


def _fraction(element: Element) -> str:
    above, below = element
    return f"({spoken(above)}) over ({spoken(below)})"


def _square_root(element: Element) -> str:
    return f"the square root of ({_row(element)})"


def _root(element: Element) -> str:
    radicand, index = element
    return f"the root {spoken(index)} of ({spoken(radicand)})"


def _matrix(table: Element) -> str:
    """Its size, then row by row."""
    cells = rows(table)
    said: list[str] = []
    for number, row in enumerate(cells, 1):
        entries = ", ".join(spoken(cell) for cell in row)
        said.append(f"row {number}: {entries}")
    columns = max(len(row) for row in cells)
    return f"{len(cells)} by {columns} matrix, {'; '.join(said)};"


SPEAKERS: dict[str, Callable[[Element], str]] = {
    "mi": _leaf,
    "mn": _leaf,
    "mo": _leaf,
    "mtext": text,
    "mspace": _space,
    "msub": _sub,
    "msup": _sup,
    "msubsup": _sub_sup,
    "mfrac": _fraction,
    "msqrt": _square_root,
    "mroot": _root,
    "mtable": _matrix,
}
"""What reads each element of MathML; any other is read from left to right."""
