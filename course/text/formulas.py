# pyright: basic
"""LaTeX of drawn numbers, matrices and closed forms, and MathML of LaTeX for pages."""

import re
import unicodedata
from functools import lru_cache
from html import escape, unescape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

COMMA = r",\; "


def number(value: float, decimals: int) -> str:
    """A number with that many decimals and no minus sign before zero."""
    text = f"{value:.{decimals}f}"
    if not text.strip("-0."):
        return text.removeprefix("-")
    return text


def matrix(values: ArrayLike, decimals: int) -> str:
    """LaTeX of numbers (n,), (m, n) or a stack (k, m, n) side by side; a vector is a column."""
    array = np.asarray(values, dtype=float)
    if array.ndim == 0:
        return number(float(array), decimals)
    if array.ndim == 3:
        return r",\quad ".join(matrix(part, decimals) for part in array)
    if array.ndim == 1:
        array = array[:, None]
    rows: list[str] = []
    for row in array:
        entries = [number(x, decimals) for x in row]
        rows.append(" & ".join(entries))
    body = r" \\ ".join(rows)
    return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"


def closed_form(expression: Any) -> str:
    """LaTeX of a sympy expression or matrix, with c_1 for cos q_1 and s_23 for sin(q_2 + q_3)."""
    if hasattr(expression, "as_immutable"):  # a matrix; only an immutable one can be looked up
        expression = expression.as_immutable()
    return _printed(expression)


@lru_cache(maxsize=1024)
def _printed(expression: Any) -> str:
    import sympy

    from ...solutions.symbolic import shorthand

    return sympy.latex(shorthand(expression), mat_str="bmatrix", mat_delim="")


def given_number(symbol: str, value: Any, units: Any) -> str:
    """LaTeX of one drawn number, vector or matrix with its unit.

    Args:
        symbol: LaTeX of its name.
        value: a number, or numbers in lists.
        units: one unit, or one for each number, nested alike; a matrix of several units shows none.
    """
    different = set(np.array(units).ravel().tolist())
    if isinstance(value, list) and not isinstance(value[0], list) and len(different) > 1:
        entries = [_with_unit(x, unit) for x, unit in zip(value, units, strict=True)]
        return rf"{symbol} = ({COMMA.join(entries)})"

    shown = _shown(value)
    if len(different) == 1:
        shown = _with_unit(shown, different.pop())
    return rf"{symbol} = {shown}"


def _shown(value: Any) -> str:
    """LaTeX of a number, a vector in parentheses or a matrix, to the digits that were drawn."""
    if not isinstance(value, list):
        return str(value)
    if not isinstance(value[0], list):
        return f"({COMMA.join(map(str, value))})"
    decimals = 0
    for row in value:
        for entry in row:
            _, _, behind_the_point = str(entry).partition(".")
            decimals = max(decimals, len(behind_the_point))
    return matrix(value, decimals)


def _with_unit(shown: Any, unit: str) -> str:
    if unit == "1":
        return str(shown)
    return rf"{shown}\,{unit_latex(unit)}"


def unit_latex(unit: str) -> str:
    """LaTeX of a unit such as m/rad or N m, with a thin space between two units."""
    spaced = unit.replace(" ", r"\,")
    return rf"\mathrm{{{spaced}}}"


def page_text(text: str) -> str:
    """HTML of one line of our own Markdown.

    What stands between dollar signs becomes MathML, between backticks code; all else is escaped.
    """
    pieces: list[str] = []
    for piece in re.split(r"(\$[^$]+\$|`[^`]+`)", text):
        if piece.startswith("$"):
            pieces.append(mathml(piece[1:-1]))
        elif piece.startswith("`"):
            pieces.append(f"<code>{escape(piece[1:-1])}</code>")
        else:
            pieces.append(escape(piece))
    return "".join(pieces)


@lru_cache(maxsize=4096)
def mathml(latex: str, display: str = "inline") -> str:
    """MathML of a formula, inline or as a block."""
    from latex2mathml.converter import convert

    # The converter sets a single upright letter, which is a unit, in italics.
    upright = re.sub(r"\\mathrm\{(\w)\}", r"\\text{\1}", latex)
    return _bold(convert(upright, display=display))


def _bold(html: str) -> str:
    """Bold letters as characters of their own: browsers pass over mathvariant."""
    return re.sub(r'<mi mathvariant="(bold|bold-italic)">([A-Za-z]|&#x\w+;)</mi>', _letter, html)


def _letter(match: re.Match[str]) -> str:
    """A GREEK SMALL LETTER OMEGA, say, as MATHEMATICAL BOLD ITALIC SMALL OMEGA."""
    style = match[1].replace("-", " ").upper()
    name = unicodedata.name(unescape(match[2]), "")
    letter = re.fullmatch(r"(?:LATIN|GREEK) (SMALL|CAPITAL) LETTER (.+)", name)
    if letter is None:
        return match[0]
    bold = unicodedata.lookup(f"MATHEMATICAL {style} {letter[1]} {letter[2]}")
    return f"<mi>{bold}</mi>"
