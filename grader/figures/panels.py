# pyright: basic
"""The panels of a spatial arm's figure: joint map, section of the workspace, determinant."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import PowerNorm

from ...solutions.workspace import Section
from .determinant_panel import draw_determinant
from .joint_map import JointMap
from .joint_map_panel import draw_joint_map
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

    # One scale for both panels, so that the same colour means the same number.
    largest = max(float(found.sigma.max()), float(np.nanmax(cut.cells)))
    norm = PowerNorm(0.5, vmin=0.0, vmax=largest)
    draw_joint_map(panels[0], found, norm)
    draw_section(panels[1], found, cut, norm)
    if found.det is not None:
        draw_determinant(panels[2], found, formula)
