# pyright: basic
"""What panels share: line styles, ticks in radians, a scale of sigma_min, a legend below."""

import re
import textwrap
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.transforms import ScaledTranslation, Transform

from ...solutions.expression import latex_name
from .joint_map import JointMap, sigma_unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.cm import ScalarMappable

# Dark solid, light dashed, ...: apart in colour, in grey and by pattern.
LINES = (
    ("#d7301f", "-"),
    ("#35c4f0", (0, (4, 1.6))),
    ("#f5a300", (0, (1, 1.2))),
    ("#d66bd0", (0, (5, 1.5, 1, 1.5))),
)
INK = "#1c1c1c"
RIGHT_ANGLES = ("$0$", r"$\pi/2$", r"$\pi$", r"$3\pi/2$", r"$2\pi$")
SHARES = (0.01, 0.05, 0.2, 0.5, 1.0)  # a square root is steep at its foot
ROUND = (50, 40, 30, 20, 15, 10, 8, 6, 5, 4, 3, 2, 1)  # numbers that are read with ease


def angle_ticks(axis: "Axis", span: tuple[float, float]) -> None:
    """Ticks an axis in radians at the right angles of `span`."""
    first = int(np.ceil(span[0] / (np.pi / 2) - 1e-9))
    last = int(np.floor(span[1] / (np.pi / 2) + 1e-9))
    places, texts = [], []
    for k in range(first, last + 1):
        text = RIGHT_ANGLES[abs(k)]
        if k < 0:
            text = f"$-{text[1:]}"
        places.append(k * np.pi / 2)
        texts.append(text)
    axis.set_ticks(places, texts)


def sigma_bar(
    ax: "Axes", image: "ScalarMappable", found: JointMap, shares: tuple[float, ...] = SHARES
) -> None:
    """Draws the scale of an `image` of sigma_min beside it, ticked at `shares` of its top."""
    bar = ax.figure.colorbar(image, cax=beside(ax))
    top = float(image.get_clim()[1] or 1.0)
    step = 10 ** np.floor(np.log10(top / 4))
    round_top = max(k * step for k in ROUND if k * step <= top)
    bar.set_ticks([0.0, *(round_top * share for share in shares)], labels=None)
    bar.ax.yaxis.set_major_formatter(lambda value, _: f"{value:.3g}")
    unit = sigma_unit(found.part).strip("()")
    bar.set_label(rf"$\sigma_{{\min}}(\mathbf{{A}})$ [{unit}], square-root scale")


def beside(ax: "Axes") -> "Axes":
    """The place of a panel's scale, to its right."""
    return ax.inset_axes((1.025, 0.0, 0.04, 1.0))


def below(ax: "Axes") -> Transform:
    """Coordinates whose zero lies under the axis label, however high the panel is."""
    return ax.transAxes + ScaledTranslation(0.0, -40 / 72, ax.figure.dpi_scale_trans)


def legend_below(ax: "Axes", handles: "Sequence[Artist]", handle_length: float) -> None:
    """Draws a legend under a panel, if there is anything to put into it."""
    if handles:
        ax.legend(
            handles=handles,
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            bbox_transform=below(ax),
            handlelength=handle_length,
        )


def wrapped(text: str, width: int = 46) -> str:
    """`text` broken into lines of at most `width` characters."""
    return "\n".join(textwrap.wrap(text, width))


def typeset(name: str) -> str:
    """A factor's name with lengths in mathematics: |d2| as its symbol with a subscript."""
    return re.sub(r"\|(\w+)\|", lambda length: f"$|{latex_name(length[1])}|$", name)
