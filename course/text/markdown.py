"""The Markdown that our own sheets hold: its formulas taken out, and HTML of it with MathML."""

import re
from functools import lru_cache
from typing import Any

from .formulas import mathml

FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$]+)\$", re.DOTALL)
CODE = re.compile(r"(`[^`]*`)")
OPEN, CLOSE = "\ue000", "\ue001"  # private characters around the number of a formula
PLACE = re.compile(f"{OPEN}([0-9]+){CLOSE}")
"""Where a formula was taken out, with its number."""


def markdown_html(text: str) -> str:
    """HTML of Markdown with tables, lists and our own markup, and MathML of its formulas.

    The text is an exercise's or our own, never a student's: its markup is kept.
    """
    plain, formulas = without_formulas(text)
    shown = [mathml(latex, display=display) for latex, display in formulas]
    return PLACE.sub(lambda match: shown[int(match[1])], _rendered(plain))


def without_formulas(text: str) -> tuple[str, list[tuple[str, str]]]:
    """Markdown with places for its formulas, out of the hands of who would see markup in them.

    Each formula is LaTeX and "block" or "inline".
    """
    formulas: list[tuple[str, str]] = []

    def taken(match: re.Match[str]) -> str:
        if match[1] is not None:
            formulas.append((match[1], "block"))
        else:
            formulas.append((match[2], "inline"))
        return f"{OPEN}{len(formulas) - 1}{CLOSE}"

    pieces: list[str] = []
    for piece in CODE.split(text):
        if piece.startswith("`"):
            pieces.append(piece)
        else:
            pieces.append(FORMULA.sub(taken, piece))
    return "".join(pieces), formulas


@lru_cache(maxsize=512)
def _rendered(plain: str) -> str:
    """HTML of a text without its formulas, which hold the numbers: many students have the same."""
    html: str = renderer().render(plain)
    return html


@lru_cache(maxsize=1)
def renderer() -> Any:
    """CommonMark with tables and our own HTML."""
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark", {"html": True}).enable("table")
