"""PDF from data by Typst: with fonts of its own, the same bytes every time, for every reader."""

import json
from functools import cache
from importlib.resources import files
from threading import Lock
from typing import TYPE_CHECKING, Any, cast

from ...solutions.errors import KinegradeError
from .document import Data

if TYPE_CHECKING:
    from typst import Compiler

TEMPLATE = "sheet.typ"
ACCESSIBLE = ["ua-1"]
"""PDF/UA-1, for which Typst refuses a formula or a figure without a description."""


class TypesettingError(KinegradeError):
    """A document that Typst refuses."""


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
        TypesettingError: the data cannot be set.
    """
    return cast("bytes", _compiled(data, format="pdf", timestamp=0, pdf_standards=ACCESSIBLE))


def pages(data: Data, ppi: float = 72.0) -> list[bytes]:
    """The pages of a document as PNG, to be looked at.

    Raises:
        TypesettingError: the data cannot be set.
    """
    drawn: Any = _compiled(data, format="png", ppi=ppi)
    if isinstance(drawn, bytes):  # a single page
        return [drawn]
    return drawn


def _compiled(data: Data, **options: Any) -> Any:
    from typst import TypstError

    inputs = {"data": json.dumps(data, ensure_ascii=False)}
    with _one_at_a_time:
        try:
            return _compiler().compile(_template(), sys_inputs=inputs, **options)
        except TypstError as error:
            raise TypesettingError(
                f"sheet {data['title']} of {data['student']} cannot be set: {error}"
            ) from error
