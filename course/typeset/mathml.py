"""A formula in LaTeX as a tree of MathML, in which nothing is left that could not be read."""

import re
from collections.abc import Sequence
from xml.etree.ElementTree import Element, fromstring

from ...solutions.errors import KinegradeError

WIDE = "1em"  # of a space between two formulas


class FormulaError(KinegradeError):
    """A formula that cannot be set."""


def tree(latex: str) -> Element:
    """The MathML of a formula.

    Raises:
        FormulaError: a command is unknown, or the formula cannot be read; the sentence says which.
    """
    from latex2mathml.converter import convert

    # The converter sets a single upright letter, which is a unit, in italics.
    upright = re.sub(r"\\mathrm\{(\w)\}", r"\\text{\1}", latex)
    try:
        root = fromstring(convert(upright))  # noqa: S314 - the converter's own output
    except Exception as error:
        name = type(error).__name__
        raise FormulaError(f"${latex}$ cannot be read as LaTeX: {name}") from error

    for element in root.iter():
        unread = re.search(r"\\[A-Za-z]+|\\.", element.text or "")
        if unread and tag(element) != "mtext":
            raise FormulaError(f"the command {unread[0]} in ${latex}$ is unknown")
    return root


def tag(element: Element) -> str:
    """The name of an element, without its namespace."""
    return element.tag.rpartition("}")[2]


def text(element: Element) -> str:
    """The characters of an element itself."""
    return element.text or ""


def rows(table: Element) -> Sequence[Sequence[Element]]:
    """The cells of a table, row by row."""
    return [list(row) for row in table]


def is_upright(element: Element) -> bool:
    """Whether it is an upright letter, such as one of a unit."""
    return tag(element) == "mi" and element.get("mathvariant") == "normal"


def side_by_side(root: Element) -> list[Element]:
    """The formulas in one that stand side by side, with wide spaces between them.

    The comma between two stays with the first.
    """
    row = root
    while len(row) == 1 and tag(row[0]) in ("mrow", "mstyle"):
        row = row[0]
    pieces = [Element("math")]
    for element in row:
        if tag(element) == "mspace" and element.get("width") == WIDE:
            pieces.append(Element("math"))
        else:
            pieces[-1].append(element)
    return [piece for piece in pieces if len(piece)]
