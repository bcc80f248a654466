"""HTML of the Markdown that our own sheets hold, with formulas as MathML."""

import re
from functools import lru_cache
from typing import Any

from .formulas import mathml

FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$]+)\$", re.DOTALL)
CODE = re.compile(r"(`[^`]*`)")
OPEN, CLOSE = "\ue000", "\ue001"  # private characters around the number of a formula


def markdown_html(text: str) -> str:
    """HTML of Markdown with tables, lists and our own markup, and MathML of its formulas.

    The text is an exercise's or our own, never a student's: its markup is kept.
    """
    formulas: list[str] = []

    def taken(match: re.Match[str]) -> str:
        """Keeps a formula out of the renderer's hands, which would see markup in it."""
        if match[1] is not None:
            formulas.append(mathml(match[1], display="block"))
        else:
            formulas.append(mathml(match[2], display="inline"))
        return f"{OPEN}{len(formulas) - 1}{CLOSE}"

    pieces: list[str] = []
    for piece in CODE.split(text):
        if piece.startswith("`"):
            pieces.append(piece)
        else:
            pieces.append(FORMULA.sub(taken, piece))
    html = _renderer().render("".join(pieces))
    return re.sub(f"{OPEN}([0-9]+){CLOSE}", lambda match: formulas[int(match[1])], html)


@lru_cache(maxsize=1)
def _renderer() -> Any:
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark", {"html": True}).enable("table")
