# pyright: basic
"""The panels of a spatial arm's figure: joint map, section of the workspace, determinant."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import PowerNorm

from ...solutions.workspace import Section
from .determinant_panel import draw_determinant
from .joint_map import JointMap
from .joint_map_panel import draw_joint_map
from .panel_style import SHARES, sigma_bar
from .section_panel import draw_section

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def spatial_panels(drawn: "Figure", found: JointMap, cut: Section, formula: str | None) -> None:
    """Draws what a spatial arm's figure shows, the determinant, if any, under its `formula`."""
    left, right, bottom, top = cut.extent
    shape = (right - min(left, 0.0)) / (top - bottom)
    widths = [1.0, min(max(0.62, shape), 0.9)]
    if found.det is not None:
        widths.append(1.0)
    panels = drawn.subplots(1, len(widths), width_ratios=widths)

    norm = _norm(found, cut)
    draw_joint_map(panels[0], found, norm)
    draw_section(panels[1], found, cut, norm)
    if found.det is not None:
        draw_determinant(panels[2], found, formula)


def singular_panels(drawn: "Figure", found: JointMap, cut: Section, formula: str | None) -> None:
    """Draws where a spatial arm is singular: the joint map, and the determinant, if any."""
    if found.det is None:
        draw_joint_map(drawn.subplots(), found, _norm(found, cut))
        return
    left, right = drawn.subplots(1, 2)
    draw_joint_map(left, found, _norm(found, cut))
    draw_determinant(right, found, formula)


def workspace_panel(drawn: "Figure", found: JointMap, cut: Section, _: str | None) -> None:
    """Draws the section of a spatial arm's workspace with the scale of its colours."""
    panel = drawn.subplots()
    draw_section(panel, found, cut, _norm(found, cut))
    left, right, bottom, top = cut.extent
    shares = SHARES
    if top - bottom < 0.5 * (right - min(left, 0.0)):
        shares = SHARES[1:]  # on a low panel the first two would overlap
    sigma_bar(panel, panel.images[0], found, shares)
    # A low panel is as wide as the figure, and its ticks are not foreseen.
    drawn.set_layout_engine("constrained", rect=(0.05, 0.0, 0.95, 1.0))


def _norm(found: JointMap, cut: Section) -> PowerNorm:
    """One scale for all panels, so that the same colour means the same number."""
    largest = max(float(found.sigma.max()), float(np.nanmax(cut.cells)))
    return PowerNorm(0.5, vmin=0.0, vmax=largest)
