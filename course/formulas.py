# pyright: basic
"""LaTeX of drawn numbers, matrices and closed forms, and MathML of LaTeX for pages."""

import re
from functools import lru_cache
from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

COMMA = r",\; "


def number(value: float, decimals: int) -> str:
    """A number with that many decimals and no minus sign before zero."""
    text = f"{value:.{decimals}f}"
    return text[1:] if text.startswith("-") and not text.strip("-0.") else text


def matrix(values: ArrayLike, decimals: int) -> str:
    """LaTeX of numbers (n,), (m, n) or a stack (k, m, n) side by side; a vector is a column."""
    array = np.asarray(values, dtype=float)
    if array.ndim == 0:
        return number(float(array), decimals)
    if array.ndim == 3:
        return r",\quad ".join(matrix(part, decimals) for part in array)
    rows = array[:, None] if array.ndim == 1 else array
    body = r" \\ ".join(" & ".join(number(x, decimals) for x in row) for row in rows)
    return rf"\begin{{bmatrix}} {body} \end{{bmatrix}}"


def closed_form(expression: Any) -> str:
    """LaTeX of a sympy expression or matrix, with c_1 for cos q_1 and s_23 for sin(q_2 + q_3)."""
    immutable = expression.as_immutable() if hasattr(expression, "as_immutable") else expression
    return _printed(immutable)


@lru_cache(maxsize=1024)
def _printed(expression: Any) -> str:
    import sympy

    from ..solutions.symbolic import shorthand

    return sympy.latex(shorthand(expression), mat_str="bmatrix", mat_delim="")


def given_number(symbol: str, value: Any, units: Any) -> str:
    """LaTeX of one drawn number, vector or matrix with its unit; a matrix of several units has none."""
    kinds = list(dict.fromkeys(np.array(units).ravel().tolist()))
    unit = rf"\,{unit_latex(kinds[0])}" if len(kinds) == 1 and kinds[0] != "1" else ""
    if not isinstance(value, list):
        return rf"{symbol} = {value}{unit}"
    if isinstance(value[0], list):
        decimals = max(len(str(x).partition(".")[2]) for row in value for x in row)
        return rf"{symbol} = {matrix(value, decimals)}{unit}"
    if len(kinds) == 1:
        return rf"{symbol} = ({COMMA.join(map(str, value))}){unit}"
    inside = COMMA.join(_with_unit(x, unit) for x, unit in zip(value, units, strict=True))
    return rf"{symbol} = ({inside})"


def _with_unit(value: float, unit: str) -> str:
    return str(value) if unit == "1" else rf"{value}\,{unit_latex(unit)}"


def unit_latex(unit: str) -> str:
    """LaTeX of a unit such as m/rad or N m, with a thin space between two units."""
    spaced = unit.replace(" ", r"\,")
    return rf"\mathrm{{{spaced}}}"


def page_text(text: str) -> str:
    """HTML of one line of our own Markdown: MathML between dollar signs, code between backticks, all else escaped."""
    parts = re.split(r"(\$[^$]+\$|`[^`]+`)", text)
    return "".join(
        mathml(part[1:-1])
        if part.startswith("$")
        else f"<code>{escape(part[1:-1])}</code>"
        if part.startswith("`")
        else escape(part)
        for part in parts
    )


def mathml(latex: str, display: str = "inline") -> str:
    """MathML of a formula, inline or as a block."""
    from latex2mathml.converter import convert

    upright = re.sub(
        r"\\mathrm\{(\w)\}", r"\\text{\1}", latex
    )  # the converter sets a single letter, a unit, in italics
    return _bold(convert(upright, display=display))


def _bold(html: str) -> str:
    """Bold letters as characters of their own: browsers pass over mathvariant."""

    def letter(match: re.Match[str]) -> str:
        first = 0x1D400 - ord("A") if match[1].isupper() else 0x1D41A - ord("a")
        return f"<mi>{chr(ord(match[1]) + first)}</mi>"

    return re.sub(r'<mi mathvariant="bold">([A-Za-z])</mi>', letter, html)
