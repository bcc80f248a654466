"""PDF from data by Typst: with fonts of its own, the same bytes every time, for every reader."""

import json
from functools import cache
from importlib.resources import files
from threading import Lock
from typing import TYPE_CHECKING, Any, cast

from .document import Data

if TYPE_CHECKING:
    from typst import Compiler

TEMPLATE = "sheet.typ"
ACCESSIBLE = ["ua-1"]
"""PDF/UA-1, for which Typst refuses a formula or a figure without a description."""

_one_at_a_time = Lock()  # a compiler refuses to be entered by two threads


@cache
def _compiler() -> "Compiler":
    from typst import Compiler

    return Compiler(ignore_system_fonts=True)


@cache
def _template() -> bytes:
    return files("kinegrade.course.typeset").joinpath(TEMPLATE).read_bytes()


def pdf(data: Data) -> bytes:
    """A document as PDF.

    Raises:
        typst.TypstError: the data cannot be set.
    """
    return cast("bytes", _compiled(data, format="pdf", timestamp=0, pdf_standards=ACCESSIBLE))


def pages(data: Data, ppi: float = 72.0) -> list[bytes]:
    """The pages of a document as PNG, to be looked at."""
    drawn = _compiled(data, format="png", ppi=ppi)
    return drawn if isinstance(drawn, list) else [cast("bytes", drawn)]


def _compiled(data: Data, **options: Any) -> Any:
    inputs = {"data": json.dumps(data, ensure_ascii=False)}
    with _one_at_a_time:
        return _compiler().compile(_template(), sys_inputs=inputs, **options)
