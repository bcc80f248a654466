# pyright: basic
"""The panel of a joint map: sigma_min over two joints, where it is zero, what limits forbid."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.patheffects import withStroke

from ...solutions.expression import latex_name
from ...solutions.singularity import RegionalArm
from .joint_map import JointMap
from .panel_style import INK, LINES, angle_ticks, legend_below, sigma_bar, typeset, wrapped

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.colors import PowerNorm

EDGE = {"color": "white", "lw": 1.3}  # of a hatched box


def draw_joint_map(ax: "Axes", found: JointMap, norm: "PowerNorm") -> None:
    """Draws sigma_min over the two joints, with the factors' curves and the joint limits."""
    image = ax.imshow(
        found.sigma,
        origin="lower",
        extent=(*found.spans[0], *found.spans[1]),
        aspect="auto",
        cmap="cividis",
        norm=norm,
    )
    sigma_bar(ax, image, found)
    handles = [*draw_factors(ax, found), *_draw_limits(ax, found)]
    joint_axes(ax, found)
    ax.set_title(f"Dark: the {found.part.point} loses a direction")
    legend_below(ax, handles, 3.2)


def draw_factors(ax: "Axes", found: JointMap, *, plain: bool = False) -> list[Line2D]:
    """Draws each factor's curves in its own pattern and returns what a legend says of them.

    `plain` curves are thin and dark, without a halo, for a panel that has colours of its own.
    """
    handles = []
    for (name, lines), (colour, pattern) in zip(found.curves, LINES, strict=False):
        if plain:
            style, effects = {"color": INK, "ls": pattern, "lw": 1.3}, []
        else:
            style = {"color": colour, "ls": pattern, "lw": 2.2}
            halo = "white" if pattern == "-" else "black"
            effects = [withStroke(linewidth=style["lw"] + 1.2, foreground=halo)]
        for line in lines:
            ax.plot(*line.T, **style, path_effects=effects, zorder=3)
        handles.append(Line2D([], [], **style, label=wrapped(typeset(name))))
    return handles


def joint_axes(ax: "Axes", found: JointMap) -> None:
    """Names and ticks the axes of a panel over the two joints."""
    ax.set_xlim(found.spans[0])
    ax.set_ylim(found.spans[1])
    for joint, span, axis in zip(found.free, found.spans, (ax.xaxis, ax.yaxis), strict=True):
        symbol = latex_name(f"q{joint + 1}")
        if found.part.chain.kinds[joint] == "R":
            angle_ticks(axis, span)
            axis.set_label_text(f"${symbol}$ [rad]")
        else:
            low, high = span
            axis.set_ticks([tick for tick in axis.get_ticklocs() if low <= tick <= high])
            axis.set_label_text(f"${symbol}$ [m]")


def _draw_limits(ax: "Axes", found: JointMap) -> list[Patch]:
    """Hatches what a joint cannot reach; returns what a legend says of it."""
    (left, right), (bottom, top) = found.spans
    shut_x = _shut(found.part, found.free[0], found.spans[0])
    shut_y = _shut(found.part, found.free[1], found.spans[1])

    # Strips of full height, and between them what the other joint cannot reach.
    boxes = [(a, b, bottom, top) for a, b in shut_x]
    for a, b in np.array([left, *np.ravel(shut_x), right]).reshape(-1, 2):
        if b - a > 1e-9:
            boxes += [(a, b, c, d) for c, d in shut_y]
    if not boxes:
        return []

    _draw_boxes(ax, boxes, found.spans)
    return [Patch(fc="#8a8a8a", ec="white", hatch="////", label="outside the joint limits")]


def _draw_boxes(
    ax: "Axes",
    boxes: "Sequence[tuple[float, float, float, float]]",
    spans: tuple[tuple[float, float], tuple[float, float]],
) -> None:
    """Hatches boxes (left, right, bottom, top), with a line where one ends inside the panel."""
    (left, right), (bottom, top) = spans
    for a, b, c, d in boxes:
        hatched = Rectangle(
            (a, c), b - a, d - c, fc="none", ec="white", hatch="////", lw=0, alpha=0.6
        )
        ax.add_patch(hatched)
    for a, b, c, d in boxes:
        if (c, d) == (bottom, top):
            for x in (a, b):
                if left < x < right:
                    ax.plot([x, x], [c, d], **EDGE)
        else:
            for y in (c, d):
                if bottom < y < top:
                    ax.plot([a, b], [y, y], **EDGE)


def _shut(part: RegionalArm, joint: int, span: tuple[float, float]) -> list[tuple[float, float]]:
    """The intervals of a map's axis that a joint cannot reach.

    A turn more or less of a revolute joint is the same place.
    """
    low, high = part.limits[joint]
    turns = (-1, 0, 1) if part.chain.kinds[joint] == "R" else (0,)
    reached, shut = span[0], []
    for turn in turns:
        start, end = low + 2 * np.pi * turn, high + 2 * np.pi * turn
        if start > reached + 1e-9 and reached < span[1]:
            shut.append((reached, min(start, span[1])))
        reached = max(reached, end)
    if reached < span[1] - 1e-9:
        shut.append((reached, span[1]))
    return shut
