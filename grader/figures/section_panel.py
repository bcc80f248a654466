# pyright: basic
"""The panel of a workspace's section: how well the tool moves in each cell, and its curves."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from ...solutions.singularity import RegionalArm, Values
from ...solutions.workspace import LIMITS, SINGULAR, Curve, Section
from .joint_map import JointMap, short
from .panel_style import INK, LINES, legend_below
from .section_cells import shown_cells

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.colors import PowerNorm

PURPLE = "#7b2a9c"  # of curves that belong to no factor
PATTERNS = {"boundary": "-", "inside": (0, (3, 1.5))}
WIDTHS = {
    (LIMITS, "boundary"): 1.4,
    (LIMITS, "inside"): 0.7,
    (SINGULAR, "boundary"): 1.8,
    (SINGULAR, "inside"): 0.9,
}
WIDTH = 2.4  # of a factor's curves
LABELS = {
    "r": "distance $r$ from axis 1 [m]",
    "z": "height $z$ along axis 1 [m]",
    "x": "$x$ [m]",
    "y": "$y$ [m]",
}


def draw_section(ax: "Axes", found: JointMap, cut: Section, norm: "PowerNorm") -> None:
    """Draws the best sigma_min in each cell, and the curves that bound and cross the workspace."""
    ax.imshow(shown_cells(cut), origin="lower", extent=cut.extent, cmap="cividis", norm=norm)
    handles = _draw_curves(ax, found.part, cut)
    left, right, bottom, top = cut.extent
    pad = 0.04 * (top - bottom)
    if cut.axes == ("r", "z"):
        ax.axvline(0.0, color=INK, lw=0.9, ls=(0, (8, 2, 2, 2)), zorder=1)
        left = 0.0
    ax.set_xlim(left - pad, right + pad)
    ax.set_ylim(bottom - pad, top + pad)
    ax.set_xlabel(LABELS[cut.axes[0]])
    ax.set_ylabel(LABELS[cut.axes[1]])
    ax.set_title(f"Section of the {found.part.point}'s workspace")
    legend_below(ax, handles, 2.6)


def _draw_curves(ax: "Axes", part: RegionalArm, cut: Section) -> list[Line2D]:
    """Draws the curves of a section; what a legend says of them is in the factors' order."""
    inks = {SINGULAR: PURPLE}
    for factor, (colour, _) in zip(part.factors, LINES, strict=False):
        inks[factor.name] = colour
    size = max(cut.extent[1] - cut.extent[0], cut.extent[3] - cut.extent[2])

    handles: dict[str, Line2D] = {}
    drawn: dict[str, list[Values]] = {}  # what already has a label, so that none is drawn twice
    for curve in cut.curves:
        ink = inks.get(curve.name, INK)
        if np.ptp(curve.points, axis=0).max() < 0.005 * size:
            handle = _draw_point(ax, curve, ink)
            handles[str(handle.get_label())] = handle
        else:
            _draw_curve(ax, curve, ink, 0.004 * size, handles, drawn)

    names = [short(factor.name) for factor in part.factors]
    names += [short(SINGULAR), LIMITS]
    return [handles[label] for label in sorted(handles, key=lambda label: _rank(label, names))]


def _rank(label: str, names: "Sequence[str]") -> tuple[int, str]:
    """Where a label such as "elbow: inside" stands in a legend."""
    name, _, place = label.partition(":")
    return names.index(name), place


def _draw_point(ax: "Axes", curve: Curve, ink: str) -> Line2D:
    """Draws a curve that is no longer than a point."""
    style = {"ms": 7, "mfc": ink, "mec": "white"}
    ax.plot(*curve.points[0], "o", **style, zorder=5)
    return Line2D([], [], marker="o", ls="", **style, label=f"{short(curve.name)}: a point")


def _draw_curve(
    ax: "Axes",
    curve: Curve,
    ink: str,
    near: float,
    handles: dict[str, Line2D],
    drawn: dict[str, list[Values]],
) -> None:
    """Draws the parts of a curve that bound the workspace and those inside, each in its pattern.

    `handles` and `drawn` take in, by label, what is drawn. Lines closer than `near` look like one.
    """
    for place, there in (("boundary", curve.boundary), ("inside", ~curve.boundary)):
        label = f"{short(curve.name)}: {place}"
        before = drawn.setdefault(label, [])
        shown = there & _fresh(curve.points, before, near)
        if not shown.any():
            continue
        width = WIDTHS.get((curve.name, place), WIDTH)
        style = {"color": ink, "lw": width, "ls": PATTERNS[place], "label": label}
        level = 3 if curve.name == LIMITS else 4
        gapped = np.where(shown[:, None], curve.points, np.nan)
        ax.plot(*gapped.T, **style, zorder=level)
        handles[label] = Line2D([], [], **style)
        before.append(curve.points[shown])


def _fresh(points: Values, drawn: "Sequence[Values]", near: float) -> NDArray[np.bool_]:
    """Where a curve runs over neither itself nor one already drawn: doubled dashes look solid."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    gaps = np.linalg.norm(points[:, None] - points, axis=-1)
    # Neighbours along the curve are close, too, and do not count.
    earlier = along[:, None] - along > 4 * near
    fresh = ~((gaps < near) & earlier).any(axis=1)
    for other in drawn:
        fresh &= (np.linalg.norm(points[:, None] - other, axis=-1) > near).all(axis=1)
    return fresh
