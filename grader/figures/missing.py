"""What stands where a figure could not be drawn: a framed sentence, as SVG."""

from .markup import px, text_xml
from .scene import FONTS

HEIGHT = 64.0  # [px]
SIZE = 15.0  # [px] of the letters


def missing(sentence: str, width: float) -> str:
    """A sentence in a frame `width` pixels wide, in the place of a figure."""
    frame = (
        f'<rect x="1" y="1" width="{px(width - 2)}" height="{px(HEIGHT - 2)}" rx="6" fill="#fff"'
        ' stroke="#7d8896" stroke-dasharray="5 4"/>'
    )
    place = f'x="{px(width / 2)}" y="{px(HEIGHT / 2 + 0.3 * SIZE)}" text-anchor="middle"'
    words = f'<text {place} font-size="{px(SIZE)}" fill="#39404a">{text_xml(sentence)}</text>'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {px(width)} {px(HEIGHT)}"'
        f' width="{px(width)}" height="{px(HEIGHT)}" role="img">'
        f'<title>{text_xml(sentence)}</title><g font-family="{FONTS}">{frame}{words}</g></svg>\n'
    )
