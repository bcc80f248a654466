r"""A part's docstring: question, hints and worked solution, with places for what is computed.

    The angular velocity of the hand, in rad/s             the question, up to the first blank line

    - Which joints turn?                                   hints

    Every revolute joint turns the hand about its axis:    paragraphs of the solution;
    $$\boldsymbol\omega = <omega>$$                        a last line of this form shows a value
    The sense is <sense>.                                  a value that is text may stand anywhere

A value is that of the part itself, of an earlier one, of a drawn number, or of one of the part's
`shows`.
"""

import inspect
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from itertools import chain
from typing import Any, cast

from ...solutions.condition import Condition, condition_sympy
from ...solutions.expression import Expression
from ...solutions.expression_array import ExpressionArray
from ...solutions.table import COLUMNS, Table
from ..exercise import ExerciseError, Step

PLACE = re.compile(r"<([A-Za-z_]\w*)>")
SHOWN = re.compile(r"\$\$(.*)<([A-Za-z_]\w*)>\s*\$\$")
Value = Callable[[str], Any]
"""What stands in the place of a name."""


@dataclass(frozen=True)
class Paragraph:
    """Text of a worked solution and, below it, the value of a name behind a LaTeX symbol."""

    text: str
    symbol: str = ""
    shown: str = ""

    @property
    def places(self) -> list[str]:
        """Names whose values stand in it."""
        names = PLACE.findall(self.text + self.symbol)
        if self.shown:
            names.append(self.shown)
        return names


@dataclass(frozen=True)
class Docstring:
    """What a part's docstring says."""

    question: str
    hints: tuple[str, ...]
    solution: tuple[Paragraph, ...]


def read_docstring(text: str) -> Docstring:
    """Question, hints and paragraphs of the solution, each without its line breaks."""
    blocks = re.split(r"\n\s*\n", inspect.cleandoc(text).strip())
    hints: list[str] = []
    solution: list[Paragraph] = []
    for block in blocks[1:]:
        if block.startswith("- "):
            listed = re.split(r"^- ", block, flags=re.MULTILINE)[1:]
            hints += map(_joined, listed)
        else:
            solution.append(_paragraph(block))
    return Docstring(_joined(blocks[0]), tuple(hints), tuple(solution))


def _paragraph(block: str) -> Paragraph:
    *lines, last = block.splitlines()
    shown = SHOWN.fullmatch(last.strip())
    if shown is None:
        return Paragraph(_joined(block))
    symbol = shown[1].strip().removesuffix("=").strip()
    return Paragraph(_joined("\n".join(lines)), symbol, shown[2])


def _joined(text: str) -> str:
    return " ".join(text.split())


def steps(
    paragraphs: tuple[Paragraph, ...], value: Value, given: Mapping[str, Any]
) -> Iterator[Step]:
    """The worked solution with its values.

    Those of the drawn numbers in `given` are shown as the sheet prints them.

    Raises:
        ExerciseError: a value cannot stand in its place.
    """
    for paragraph in paragraphs:
        text = _filled(paragraph.text, value)
        shown = paragraph.shown
        if not shown:
            yield Step(text)
            continue

        decimals: int | None = None
        if shown in given:
            decimals = digits(given[shown])
        yield from _displayed(text, _filled(paragraph.symbol, value), value(shown), decimals)


def digits(printed: Any) -> int:
    """The most decimals of any number in a drawn value."""
    if isinstance(printed, list):
        items = cast("list[Any]", printed)
        return max(map(digits, items), default=0)
    return len(str(printed).partition(".")[2])


def _filled(text: str, value: Value) -> str:
    return PLACE.sub(lambda match: _as_text(match[1], value(match[1])), text)


def _as_text(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, int | float):
        return f"{value:g}"
    raise ExerciseError(
        f"<{name}> stands in a text, which takes text or a number, got {type(value).__name__}"
    )


def _displayed(text: str, symbol: str, value: Any, decimals: int | None) -> Iterator[Step]:
    """A step that shows formulas or numbers; conditions, one below the other."""
    if isinstance(value, tuple):
        yield Step(text)
        for condition in cast("tuple[Condition, ...]", value):
            yield Step("", symbol, condition_sympy(condition))
        return

    formula = formula_of(value)
    if formula is not None:
        yield Step(text, symbol, formula)
    else:
        yield Step(text, symbol, numbers=value, decimals=decimals)


def formula_of(value: Any) -> Any:
    """Sympy of formulas, of a table or of sympy itself; None for numbers."""
    if isinstance(value, Table):
        sympy: Any = import_module("sympy")
        # row by row, as sympy takes a matrix of this shape
        cells = [cell.sympy() for cell in chain.from_iterable(value.rows)]
        return sympy.Matrix(len(value.rows), len(COLUMNS), cells)
    if isinstance(value, Expression | ExpressionArray):
        return value.sympy()
    return value if hasattr(value, "free_symbols") else None
