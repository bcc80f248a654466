"""Typst of formulas: a walk along their MathML. Nothing else writes markup that Typst evaluates."""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from xml.etree.ElementTree import Element

from ..language.speech import Language, language_spoken
from .mathml import FormulaError, is_upright, rows, side_by_side, tag, text, tree
from .spoken import spoken

ACCENTS = {
    "˙": "dot",
    "¨": "dot.double",
    "^": "hat",
    "~": "tilde",
    "→": "arrow",
    "¯": "macron",
    "―": "overline",
}
SPACES = {"0.167em": "thin", "0.222em": "med", "0.278em": "thick", "1em": "quad", "2em": "wide"}
STYLES = {
    "bold": "bold(upright({}))",
    "bold-italic": "bold({})",
    "italic": "italic({})",
    "normal": "upright({})",
    "double-struck": "bb({})",
}
FENCES = {"[": "]", "(": ")", "{": "}", "|": "|", "‖": "‖"}


@dataclass(frozen=True)
class Formula:
    """A formula as Typst's mathematics, and in words for those who cannot see it.

    `pieces` are the formulas that stand side by side in it, with wide spaces between them. `rows`
    are those of its tallest matrix.
    """

    typst: str
    alt: str
    pieces: tuple["Formula", ...] = ()
    rows: int = 0

    @property
    def breakable(self) -> bool:
        """Whether a line may end at any of its signs."""
        return not self.rows


def formula(latex: str) -> Formula:
    """A formula in LaTeX for Typst, in the words of the language spoken.

    Raises:
        FormulaError: it holds what is not known here; the sentence says what.
    """
    return _formula_in(language_spoken(), latex)


@lru_cache(maxsize=4096)
def _formula_in(_: Language, latex: str) -> Formula:
    root = tree(latex)
    try:
        pieces = [_formula(piece) for piece in side_by_side(root)]
        return replace(_formula(root), pieces=tuple(pieces))
    except FormulaError as error:
        raise FormulaError(f"{error} in ${latex}$") from None


def _formula(root: Element) -> Formula:
    heights = [len(rows(table)) for table in root.iterfind(".//{*}mtable")]
    return Formula(_set(root), spoken(root), rows=max(heights, default=0))


def _set(element: Element) -> str:
    """An element as Typst."""
    setter = SETTERS.get(tag(element))
    if setter is None:
        raise FormulaError(f"<{tag(element)}> is unknown")
    return setter(element)


def _row(element: Element) -> str:
    """Elements side by side: words of upright letters together, fences with what they hold."""
    return " ".join(_pieces(list(element)))


def _pieces(elements: Sequence[Element]) -> Iterator[str]:
    i = 0
    while i < len(elements):
        word = _upright_word(elements[i:])
        if len(word) > 1:
            yield _quoted("".join(map(text, word)))
            i += len(word)
            continue
        if _is_matrix(elements[i : i + 3]):
            yield _matrix(elements[i + 1], text(elements[i]))
            i += 3
            continue
        yield _set(elements[i])
        i += 1


def _upright_word(elements: Sequence[Element]) -> list[Element]:
    """The upright letters that elements start with, and the slash of a unit between them."""
    word: list[Element] = []
    for element in elements:
        slash = tag(element) == "mo" and text(element) == "/" and word
        if not is_upright(element) and not slash:
            break
        word.append(element)
    while word and not is_upright(word[-1]):
        word.pop()
    return word


def _is_matrix(elements: Sequence[Element]) -> bool:
    """Whether this is a table between two fences."""
    if [tag(element) for element in elements] != ["mo", "mtable", "mo"]:
        return False
    return FENCES.get(text(elements[0])) == text(elements[2])


def _group(element: Element) -> str:
    """A row; where it starts with a fence that stretches, its fences do."""
    inner = list(element)
    if len(inner) < 2 or _is_matrix(inner):
        return _row(element)
    first = inner[0]
    if first.get("fence") != "true" or first.get("form") != "prefix":
        return _row(element)
    return f"lr({_row(element)})"


def _letter(element: Element) -> str:
    """A variable, or the name of a function."""
    name = text(element)
    if len(name) > 1:
        return f"op({_quoted(name)})"
    return _styled(element, _character(name))


def _number(element: Element) -> str:
    number = text(element)
    if not re.fullmatch(r"[0-9.]+", number):
        number = _quoted(number)
    return _styled(element, number)


def _styled(element: Element, shown: str) -> str:
    variant = element.get("mathvariant")
    if variant is None:
        return shown
    if variant not in STYLES:
        raise FormulaError(f"the letters {variant!r} are unknown")
    return STYLES[variant].format(shown)


def _operator(element: Element) -> str:
    sign = text(element)
    if len(sign) > 1:
        return f"op({_quoted(sign)})"
    return _character(sign)


def _character(sign: str) -> str:
    """One character, which stands for itself."""
    if sign.isascii() and not sign.isalnum():
        return f"\\{sign}"
    return sign


def _quoted(words: str) -> str:
    plain = words.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
    return f'"{plain}"'


def _text(element: Element) -> str:
    return _quoted(text(element))


def _space(element: Element) -> str:
    width = element.get("width", "")
    if width in SPACES:
        return SPACES[width]
    if re.fullmatch(r"-?[0-9.]+em", width):
        return f"#h({width})"
    raise FormulaError(f"a space of {width!r} is unknown")


def _script(*places: str) -> Callable[[Element], str]:
    """A base with what stands at these places of it: b below, t above."""

    def script(element: Element) -> str:
        base, *others = element
        attached = [f"{place}: {_set(x)}" for place, x in zip(places, others, strict=True)]
        return f"attach({_set(base)}, {', '.join(attached)})"

    return script


def _over(element: Element) -> str:
    base, above = element
    accent = ACCENTS.get(text(above))
    if tag(above) == "mo" and accent is not None:
        return f"{accent}({_set(base)})"
    return f"attach(limits({_set(base)}), t: {_set(above)})"


def _under(element: Element) -> str:
    base, below = element
    if text(below) == "⏟":
        return f"underbrace({_set(base)})"
    return f"attach(limits({_set(base)}), b: {_set(below)})"


def _under_over(element: Element) -> str:
    base, below, above = element
    return f"attach(limits({_set(base)}), b: {_set(below)}, t: {_set(above)})"


def _fraction(element: Element) -> str:
    above, below = element
    return f"frac({_set(above)}, {_set(below)})"


def _root(element: Element) -> str:
    radicand, index = element
    return f"root({_set(index)}, {_set(radicand)})"


def _square_root(element: Element) -> str:
    return f"sqrt({_row(element)})"


def _table(element: Element) -> str:
    return _matrix(element, "")


def _matrix(table: Element, fence: str) -> str:
    lines: list[str] = []
    for row in rows(table):
        cells = [_row(cell) or '""' for cell in row]
        lines.append(", ".join(cells))
    delimiter = f'"{fence}"' if fence else "#none"
    side = "#right" if _is_numeric(table) else "#center"
    return f"mat(delim: {delimiter}, align: {side}, {'; '.join(lines)})"


def _is_numeric(table: Element) -> bool:
    """Whether there are numbers in it alone, which stand below each other by their last digits."""
    for row in rows(table):
        for cell in row:
            for element in cell.iter():
                if tag(element) == "mi" or (tag(element) == "mo" and text(element) != "−"):
                    return False
    return True


SETTERS: dict[str, Callable[[Element], str]] = {
    "math": _row,
    "mrow": _group,
    "mstyle": _row,
    "mpadded": _row,
    "mi": _letter,
    "mn": _number,
    "mo": _operator,
    "mtext": _text,
    "mspace": _space,
    "msub": _script("b"),
    "msup": _script("t"),
    "msubsup": _script("b", "t"),
    "mover": _over,
    "munder": _under,
    "munderover": _under_over,
    "mfrac": _fraction,
    "msqrt": _square_root,
    "mroot": _root,
    "mtable": _table,
}
"""What sets each element of MathML."""
