"""Numbers, colours and words of a drawing as SVG."""

import re
from html import escape

import numpy as np

from .labels import SIZE, SUB, Placed
from .vectors import Array, norm, quarter_turned, unit

LIGHT = np.array([-0.42, -0.55, 0.72])  # near enough a unit vector: from above, from the left
ILLEGAL_IN_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
FAR = 13.0  # [px] between a label and its anchor, from which on a line leads there


def px(value: float) -> str:
    """A coordinate with one decimal and no needless zero."""
    text = f"{value:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


def pair(p: Array) -> str:
    """The first two coordinates of `p`."""
    return f"{px(p[0])} {px(p[1])}"


def pairs(points: Array, between: str) -> str:
    """The first two coordinates of each of `points` (k, 2 or 3)."""
    return between.join(pair(p) for p in points)


def arrow_corners(tip: Array, along: Array, size: float) -> str:
    """The corners of an arrowhead with its point at `tip` (2,), `size` pixels long."""
    u = unit(along)
    foot, side = tip - size * u, 0.36 * size * quarter_turned(u)
    return pairs(np.stack([tip, foot + side, foot - side]), " ")


def text_xml(text: str) -> str:
    """`text` escaped for XML, characters that XML cannot carry replaced."""
    return escape(ILLEGAL_IN_XML.sub("\ufffd", text))


def shade(colour: str, normal: Array) -> str:
    """`colour` (#rrggbb) as lit on a surface with that unit normal."""
    return tint(colour, 0.6 + 0.55 * max(0.0, float(LIGHT @ normal)))


def tint(colour: str, factor: float) -> str:
    """`colour` (#rrggbb) darkened by a factor below 1, lightened towards white by one up to 2."""
    text = "#"
    for i in (1, 3, 5):
        part = int(colour[i : i + 2], 16)
        changed = part * factor
        if factor >= 1:
            changed = part + (255 - part) * (factor - 1)
        text += f"{round(changed):02x}"
    return text


def leader_svg(placed: Placed) -> str:
    """A thin line to the anchor of a label that had to stand far from it; empty for any other."""
    left, top, right, bottom = placed.box
    x, y = placed.anchor
    near = np.array([np.clip(x, left, right), np.clip(y, top, bottom)])
    if norm(near - placed.anchor) < FAR:
        return ""
    line = f'd="M{pair(near)}L{pair(placed.anchor)}"'
    return f'<path class="leader" {line} stroke="{placed.label.colour}" stroke-width=".6"/>'


def label_svg(placed: Placed) -> str:
    """A label with a white halo."""
    label, (x, y) = placed.label, placed.centre
    words = f'<tspan font-style="italic">{text_xml(label.symbol)}</tspan>'
    if label.subscript:
        words += f'<tspan dy="3.6" font-size="{px(SUB)}">{text_xml(label.subscript)}</tspan>'
    place = f'x="{px(x)}" y="{px(y + 0.24 * SIZE)}"'
    text = f'<text {place} font-size="{px(SIZE)}" text-anchor="middle"'
    # The halo is a text of its own: paint-order is not understood everywhere.
    return (
        f'<g class="label {label.css}">'
        f'{text} fill="#fff" stroke="#fff" stroke-width="3.4">{words}</text>'
        f'{text} fill="{label.colour}">{words}</text></g>'
    )
