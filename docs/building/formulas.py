"""LaTeX on pages becomes MathML when the site is built, so that no script is needed to read it."""

import re
from typing import Any

from kinegrade.course.text.formulas import mathml
from kinegrade.course.text.markdown import PLACE, without_formulas
from mkdocs.structure.pages import Page

FENCED = re.compile(r"(^```.*?^```\s*?$|^``````.*?^``````\s*?$)", re.DOTALL | re.MULTILINE)
"""Blocks of code, in which a dollar sign is one."""
OPEN, CLOSE = "\ue000", "\ue001"
taken: dict[str, list[tuple[str, str]]] = {}
"""The formulas of each page between its two passes."""


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Takes formulas out, so that nothing in them is read as markup."""
    formulas: list[tuple[str, str]] = []
    pieces: list[str] = []
    for piece in FENCED.split(markdown):
        if piece.startswith("```"):
            pieces.append(piece)
            continue
        plain, found = without_formulas(piece)
        pieces.append(_numbered_from(len(formulas), plain))
        formulas += found
    taken[page.file.src_uri] = formulas
    return "".join(pieces)


def _numbered_from(start: int, text: str) -> str:
    return PLACE.sub(lambda place: f"{OPEN}{int(place[1]) + start}{CLOSE}", text)


def on_page_content(html: str, page: Page, **_: Any) -> str:
    """Puts MathML where formulas were."""
    shown = [mathml(latex, display=display) for latex, display in taken[page.file.src_uri]]
    return PLACE.sub(lambda place: shown[int(place[1])], html)
