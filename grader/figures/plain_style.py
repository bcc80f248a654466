# pyright: basic
"""The style of figures, whatever stands in a user's matplotlibrc, and figures as files."""

from collections.abc import Generator
from contextlib import contextmanager
from io import BytesIO
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

STYLE: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 11,
    "axes.titlesize": 12,
    "legend.fontsize": 10,
    "legend.frameon": False,
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "kinegrade",
    "svg.fonttype": "path",
}
# What would differ between two writings of the same figure, by suffix.
UNDATED = {".png": {"Software": None}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}


@contextmanager
def plain_style() -> Generator[None]:
    """Our style on matplotlib's own defaults; a user's settings are back afterwards."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(STYLE)
        yield


def blank(width: float, height: float) -> Figure:
    """An empty figure of so many inches, to be drawn on inside of our style."""
    drawn = Figure(figsize=(width, height), dpi=100, layout="constrained")
    FigureCanvasAgg(drawn)
    return drawn


def settled(drawn: Figure) -> Figure:
    """The figure with ticks and layout fixed inside of our style; later draws repeat them."""
    drawn.draw_without_rendering()
    drawn.set_layout_engine("none")
    return drawn


def written(drawn: Figure, suffix: str) -> bytes:
    """The figure as a file of that suffix, the same bytes every time."""
    file = BytesIO()
    with plain_style():
        drawn.savefig(file, format=suffix[1:], metadata=UNDATED[suffix])
    return file.getvalue()
