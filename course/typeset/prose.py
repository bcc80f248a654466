# pyright: basic
"""Markdown with LaTeX as blocks of data, which a Typst template sets; text in them stays text."""

from collections.abc import Iterator
from typing import Any

from ..text.markdown import PLACE, renderer, without_formulas
from .formula import Formula, formula
from .mathml import FormulaError

Block = dict[str, Any]
"""A paragraph, list or table: its kind, and what stands in it."""
Inline = Any
"""Text, or a formula, code, or emphasized text."""
TALL = 2  # rows that a matrix within a line may have
ENDS = tuple(".,;:")
EMPHASIS = {"strong_open": "strong", "em_open": "emph"}


def prose(markdown: str) -> list[Block]:
    """The blocks of a text of ours.

    Raises:
        FormulaError: it holds a formula or markup that cannot be set.
    """
    plain, formulas = without_formulas(markdown)
    tokens = renderer().parse(plain)
    return _Reader(tokens, formulas).blocks("")


def line(markdown: str) -> list[Inline]:
    """The inline content of a text of one paragraph.

    Raises:
        FormulaError: as `prose`, or there is more than one paragraph.
    """
    blocks = prose(markdown)
    if not blocks:
        return []
    if len(blocks) > 1 or blocks[0]["kind"] != "paragraph":
        raise FormulaError(f"one paragraph is expected, got {len(blocks)} blocks: {markdown[:60]}")
    return blocks[0]["inline"]


class _Reader:
    """Tokens of a renderer, read once from the first to the last."""

    def __init__(self, tokens: list[Any], formulas: list[tuple[str, str]]) -> None:
        self._tokens = iter(tokens)
        self._formulas = formulas

    def blocks(self, end: str) -> list[Block]:
        """All blocks up to the token that ends them."""
        found: list[Block] = []
        for token in self._tokens:
            if token.type == end:
                break
            found += self._block(token)
        return found

    def _block(self, token: Any) -> Iterator[Block]:
        if token.type == "paragraph_open":
            yield from self._paragraph()
        elif token.type in ("bullet_list_open", "ordered_list_open"):
            yield self._list(token.type)
        elif token.type == "table_open":
            yield self._table()
        else:
            raise FormulaError(f"this is no paragraph, list or table: {token.content[:60]}")

    def _paragraph(self) -> Iterator[Block]:
        """A paragraph; formulas that stand by themselves are blocks between its parts."""
        inline = _with_points(self._inline("paragraph_close"))
        sentence: list[Inline] = []
        for piece in inline:
            if not _is_block(piece):
                sentence.append(piece)
                continue
            if _says_something(sentence):
                yield {"kind": "paragraph", "inline": sentence}
            yield {"kind": "formula", **piece}
            sentence = []
        if _says_something(sentence):
            yield {"kind": "paragraph", "inline": sentence}

    def _list(self, opened: str) -> Block:
        """Items, each of them blocks."""
        closed = opened.replace("open", "close")
        items: list[list[Block]] = []
        for token in self._tokens:
            if token.type == closed:
                break
            items.append(self.blocks("list_item_close"))
        return {"kind": "list", "numbered": opened.startswith("ordered"), "items": items}

    def _table(self) -> Block:
        """The cells of the heading, and those of all rows."""
        lines: list[list[list[Inline]]] = []
        for token in self._tokens:
            if token.type == "table_close":
                break
            if token.type == "tr_open":
                lines.append([])
            elif token.type in ("th_open", "td_open"):
                lines[-1].append(self._inline(token.type.replace("open", "close")))
        heading, *rows = lines
        return {"kind": "table", "heading": heading, "rows": rows}

    def _inline(self, closed: str) -> list[Inline]:
        """The content of the next token, up to the one that closes it."""
        content: list[Inline] = []
        for token in self._tokens:
            if token.type == closed:
                break
            content += self._pieces(iter(token.children or ()), "")
        return content

    def _pieces(self, tokens: Iterator[Any], end: str) -> Iterator[Inline]:
        for token in tokens:
            if token.type == end:
                return
            if token.type == "text":
                yield from self._text(token.content)
            elif token.type in ("softbreak", "hardbreak"):
                yield " "
            elif token.type == "code_inline":
                yield {"code": token.content}
            elif token.type in EMPHASIS:
                closed = token.type.replace("open", "close")
                yield {EMPHASIS[token.type]: [*self._pieces(tokens, closed)]}
            else:
                raise FormulaError(f"this markup cannot be set: {token.type} {token.content[:60]}")

    def _text(self, content: str) -> Iterator[Inline]:
        """Text, and the formulas that were taken out of it."""
        for i, piece in enumerate(PLACE.split(content)):
            if i % 2 == 0:
                if piece:
                    yield piece
                continue
            latex, display = self._formulas[int(piece)]
            found = formula(latex)
            stands_alone = display == "block" or found.rows > TALL
            yield {**formula_data(found), "block": stands_alone}


def formula_data(one: Formula) -> dict[str, Any]:
    """A formula for the template."""
    pieces = [formula_data(piece) for piece in one.pieces]
    return {"math": one.typst, "alt": one.alt, "breakable": one.breakable, "pieces": pieces}


def _is_block(piece: Inline) -> bool:
    return isinstance(piece, dict) and piece.get("block", False)


def _with_points(inline: list[Inline]) -> list[Inline]:
    """The same, with the point or comma behind a formula that stands by itself taken into it."""
    found: list[Inline] = [""]
    for piece in inline:
        before = found[-1]
        if _is_block(before) and isinstance(piece, str) and piece[:1] in ENDS:
            found[-1] = {**before, "math": f"{before['math']} \\{piece[0]}", "pieces": []}
            found.append(piece[1:].lstrip())
        else:
            found.append(piece)
    return found[1:]


def _says_something(sentence: list[Inline]) -> bool:
    return any(not isinstance(piece, str) or piece.strip() for piece in sentence)
