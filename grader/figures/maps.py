# pyright: basic
"""Figures of where a robot is singular and where its tool gets, with the finding in words."""

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from ...solutions.reach import bounded_reach
from ...solutions.singularity import (
    Parameters,
    RegionalArm,
    Values,
    arm,
    sigma_min,
    task_block,
    zero_set,
)
from ...solutions.workspace import Section
from .amounts import typeset_amounts
from .description import description
from .determinant_formula import determinant_formula
from .formats import FigureError, suffix_of
from .joint_map import JointMap
from .panels import singular_panels, spatial_panels, workspace_panel
from .plain_style import blank, plain_style, settled, written
from .planar_panels import planar_panels, planar_singular_panels, ring_panel
from .section_cells import section_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

    from ...solutions.robots import Robot

    Panels = Callable[[Figure, JointMap, Section, str | None], None]

__all__ = ["FigureError", "describe", "figure", "joint_map", "picture"]

SAMPLES = 181  # per axis of a joint map
WIDE = 12  # inches of a figure whose title and lengths stand in one line
LENGTH = 1.4  # inches that a length takes
# Panels by kind, with width and height in inches: of an arm in space, and of a planar one.
SPATIAL: "dict[str, tuple[Panels, float, float]]" = {
    "": (spatial_panels, 12, 5.5),
    "workspace": (workspace_panel, 6, 5.5),
    "singularities": (singular_panels, 9, 5.5),
}
PLANAR: "dict[str, tuple[Panels, float, float]]" = {
    "": (planar_panels, 12, 4.7),
    "workspace": (ring_panel, 6, 5.2),
    "singularities": (planar_singular_panels, 9, 5.3),
}


def figure(robot: "Robot", parameters: Parameters = None, kind: str = "") -> "Figure":
    """The robot's singularities and workspace in two or three panels, or one `kind` of them.

    Raises:
        FigureError: the robot has a single joint.
    """
    values = robot.values(parameters)
    with plain_style():
        found, cut = _found(robot, tuple(values.items()))
        planar = found.part.chain.kinds == "RR" and cut.axes == ("x", "y")
        draw_panels, width, height = (PLANAR if planar else SPATIAL)[kind]
        drawn = blank(width, height)

        draw_panels(drawn, found, cut, determinant_formula(robot, found, parameters))
        drawn.suptitle(_title(robot.title, typeset_amounts(values), width), fontsize=13)
        return settled(drawn)


def _title(title: str, amounts: list[str], width: float) -> str:
    """The title with the lengths, which are on lines of their own where the figure is narrow."""
    if width >= WIDE:
        return f"{title}  ({',  '.join(amounts)})"
    fitting = int(width / LENGTH)
    starts = range(0, len(amounts), fitting)
    rows = [",  ".join(amounts[start : start + fitting]) for start in starts]
    listed = ",\n".join(rows)
    return f"{title}\n({listed})"


def picture(robot: "Robot", suffix: str, parameters: Parameters = None, kind: str = "") -> bytes:
    """The figure as a file that ends in .png, .svg or .pdf, the same bytes every time.

    Raises:
        FigureError: another suffix, or a robot of a single joint.
    """
    ending = suffix_of(suffix)
    return written(figure(robot, parameters, kind), ending)


def describe(robot: "Robot", parameters: Parameters = None) -> str:
    """The figure in words: what is singular and where, how far the tool gets, what bounds that.

    Raises:
        FigureError: the robot has a single joint.
    """
    values = robot.values(parameters)
    found, cut = _found(robot, tuple(values.items()))
    return description(robot.title, values, found, cut, bounded_reach(robot, parameters))


def joint_map(robot: "Robot", parameters: Parameters = None) -> JointMap:
    """The map over q2 and q3 (of a two-joint arm: q1 and q2), the other joints held.

    Raises:
        FigureError: the robot has a single joint.
    """
    part = arm(robot, parameters)
    n = part.chain.n
    if n < 2:
        raise FigureError(
            f"A joint map takes a robot of two joints or more, got {robot.name} with {n}."
        )
    free = (0, 1) if n == 2 else (1, 2)
    spans = (_span(part, free[0]), _span(part, free[1]))
    held = _held(part)

    q = np.broadcast_to(held, (SAMPLES, SAMPLES, n)).copy()
    q[..., free[0]], q[..., free[1]] = np.meshgrid(_middles(spans[0]), _middles(spans[1]))
    block = task_block(part, q)
    square = block.shape[-1] == block.shape[-2]
    det = np.linalg.det(block) if square else None

    at = np.concatenate([held, np.zeros(robot.n - n)])
    curves = []
    for factor in part.factors:
        lines = zero_set(robot, factor.name, parameters, free=free, at=at, ranges=spans)
        if lines:  # a wrist has no line on a map of shoulder and elbow
            curves.append((factor.name, lines))
    return JointMap(part, free, spans, held, sigma_min(block), det, tuple(curves))


@lru_cache(maxsize=8)
def _found(robot: "Robot", values: tuple[tuple[str, float], ...]) -> tuple[JointMap, Section]:
    """Both halves of a figure, kept for its description and its other formats."""
    return joint_map(robot, dict(values)), section_of(robot, dict(values))


def _span(part: RegionalArm, joint: int) -> tuple[float, float]:
    """What a map shows of a joint: a full turn, or the stroke with zero and a margin."""
    if part.chain.kinds[joint] == "R":
        return -np.pi, np.pi
    low, high = part.limits[joint]
    margin = 0.08 * (high - low)
    return min(low, 0.0) - margin, max(high, 0.0) + margin


def _held(part: RegionalArm) -> Values:
    """The configuration (n,) in which a map holds the joints that do not vary."""
    if part.chain.n <= 3:
        return np.zeros(part.chain.n)
    # Off zero, where a wrist is singular whatever the arm does.
    held = np.array([low + 0.62 * (high - low) for low, high in part.limits])
    held[0] = 0.0
    return held


def _middles(span: tuple[float, float]) -> Values:
    """The middles of the samples along an axis of a map."""
    low, high = span
    return low + (high - low) * (np.arange(SAMPLES) + 0.5) / SAMPLES
