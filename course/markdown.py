"""HTML of the Markdown that our own sheets hold, with formulas as MathML."""

import re
from functools import lru_cache
from typing import Any

from .formulas import mathml

FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$]+)\$", re.DOTALL)
CODE = re.compile(r"(`[^`]*`)")
OPEN, CLOSE = "\ue000", "\ue001"  # private characters around the number of a formula


def markdown_html(text: str) -> str:
    """HTML of Markdown with tables, lists and our own markup; what stands between dollar signs becomes MathML.

    The text is an exercise's or our own, never a student's: its markup is kept.
    """
    formulas: list[str] = []

    def taken(match: re.Match[str]) -> str:
        shown = match[1] is not None
        formulas.append(mathml(match[1] or match[2], display="block" if shown else "inline"))
        return f"{OPEN}{len(formulas) - 1}{CLOSE}"

    pieces = [
        piece if piece.startswith("`") else FORMULA.sub(taken, piece) for piece in CODE.split(text)
    ]
    html = _renderer().render("".join(pieces))
    return re.sub(f"{OPEN}([0-9]+){CLOSE}", lambda match: formulas[int(match[1])], html)


@lru_cache(maxsize=1)
def _renderer() -> Any:
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark", {"html": True}).enable("table")
