"""A drawing for others: as PNG or PDF, with the fonts of typst, or in the text of a page."""

from base64 import b64encode
from functools import cache
from threading import Lock
from typing import TYPE_CHECKING, cast

from ...solutions.errors import KinegradeError

if TYPE_CHECKING:
    from typst import Compiler

PAGE = b"""#set page(width: auto, height: auto, margin: 0pt, fill: white)
#image(bytes(sys.inputs.svg), format: "svg", width: float(sys.inputs.width) * 1pt)
"""

_one_at_a_time = Lock()  # a compiler refuses to be entered by two threads


@cache
def _compiler() -> "Compiler":
    from typst import Compiler

    return Compiler(ignore_system_fonts=True)


def png(svg: str, width: int) -> bytes:
    """A white-backed PNG, `width` pixels wide, with byte-identical output for identical input.

    Raises:
        KinegradeError: `width` is less than a pixel.
        typst.TypstError: `svg` cannot be read.
    """
    if width < 1:
        raise KinegradeError(f"width takes 1 pixel or more, got {width}")
    inputs = {"svg": svg, "width": str(width)}
    with _one_at_a_time:
        # At 72 pixels per inch a point is a pixel; a document of one page comes back as its bytes.
        drawn = _compiler().compile(PAGE, format="png", ppi=72.0, sys_inputs=inputs)
    return cast("bytes", drawn)


def pdf(svg: str, width: int) -> bytes:
    """A PDF of one page, `width` points wide, with byte-identical output for identical input.

    Raises:
        typst.TypstError: `svg` cannot be read.
    """
    inputs = {"svg": svg, "width": str(width)}
    with _one_at_a_time:
        drawn = _compiler().compile(PAGE, format="pdf", sys_inputs=inputs, timestamp=0)
    return cast("bytes", drawn)


def data_uri(svg: str) -> str:
    """An SVG on white as a data: URI, for pages and notebook cells that carry their pictures."""
    return "data:image/svg+xml;base64," + b64encode(on_white(svg).encode()).decode("ascii")


def on_white(svg: str) -> str:
    """An SVG with a white ground, which dark themes need."""
    return svg.replace("<svg ", '<svg style="background:#fff" ', 1)
