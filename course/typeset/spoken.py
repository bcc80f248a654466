"""Formulas in words, in the language spoken, for readers who listen: a walk along their MathML."""

from collections.abc import Callable, Sequence
from unicodedata import normalize
from xml.etree.ElementTree import Element

from ..language.speech import later, phrase
from .mathml import rows, tag, text

PRIME = "′"
WORDS = {
    "−": later("minus"),
    "×": later("times"),
    "·": later("times"),
    "⋅": later("times"),
    "⋯": later("and so on"),
    "…": later("and so on"),
    "=": later("equals"),
    "+": later("plus"),
    "/": later("per"),
    "˙": later("dot"),
    "¨": later("double dot"),
    "^": later("hat"),
    "~": later("tilde"),
    "→": later("arrow"),
    "¯": later("bar"),
    "―": later("bar"),
    PRIME: later("prime"),
    "⏟": later("brace"),
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
    word = WORDS.get(text(element))
    return phrase(word) if word else plain


def _space(element: Element) -> str:
    return ", " if element.get("width") == "1em" else ""


def _sub(element: Element) -> str:
    base, below = element
    return phrase("{base} sub {below}", base=spoken(base), below=spoken(below))


def _sup(element: Element) -> str:
    base, above = element
    if text(above) == PRIME:
        return f"{spoken(base)} {spoken(above)}"
    if text(above) == "2" and not _is_bold(base):
        return phrase("{base} squared", base=spoken(base))
    return phrase("{base} super {above}", base=spoken(base), above=spoken(above))


def _is_bold(base: Element) -> bool:
    """Whether it is a vector or a matrix, on which a number is an index."""
    return any("bold" in element.get("mathvariant", "") for element in base.iter())


def _sub_sup(element: Element) -> str:
    base, below, above = element
    return phrase(
        "{base} sub {below} super {above}",
        base=spoken(base),
        below=spoken(below),
        above=spoken(above),
    )


def _fraction(element: Element) -> str:
    above, below = element
    return phrase("({above}) over ({below})", above=spoken(above), below=spoken(below))


def _square_root(element: Element) -> str:
    return phrase("the square root of ({radicand})", radicand=_row(element))


def _root(element: Element) -> str:
    radicand, index = element
    return phrase(
        "the root {index} of ({radicand})", index=spoken(index), radicand=spoken(radicand)
    )


def _matrix(table: Element) -> str:
    """Its size, then row by row."""
    cells = rows(table)
    said: list[str] = []
    for number, row in enumerate(cells, 1):
        entries = ", ".join(spoken(cell) for cell in row)
        said.append(phrase("row {number}: {entries}", number=number, entries=entries))
    columns = max(len(row) for row in cells)
    size = phrase("{rows} by {columns} matrix", rows=len(cells), columns=columns)
    return f"{size}, {'; '.join(said)};"


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
