"""PNG from SVG with the fonts that come in the typst wheel, so that every machine draws the same bytes."""

from base64 import b64encode
from functools import cache
from threading import Lock
from typing import TYPE_CHECKING

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
        ValueError: `width` is no positive whole number.
        typst.TypstError: `svg` cannot be read.
    """
    if width < 1:
        raise ValueError(f"png takes a width of at least 1 pixel, got {width}")
    with _one_at_a_time:
        # At 72 pixels per inch a point is a pixel.
        drawn = _compiler().compile(PAGE, format="png", ppi=72.0, sys_inputs={"svg": svg, "width": str(width)})
    assert isinstance(drawn, bytes), "one page makes one PNG"  # noqa: S101 (the type of several pages)
    return drawn


def data_uri(png: bytes) -> str:
    """`png` as a data: URI, for pages and notebook cells that carry their pictures."""
    return "data:image/png;base64," + b64encode(png).decode("ascii")
