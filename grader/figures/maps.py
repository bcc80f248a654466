# pyright: basic
"""Figures of where a robot is singular and where its tool gets, with the finding in words."""

from functools import lru_cache
from io import BytesIO
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ...solutions.errors import KinegradeError
from ...solutions.expression import latex_name
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
from ...solutions.workspace import Section, section
from .description import description
from .determinant_formula import determinant_formula
from .joint_map import JointMap
from .panels import spatial_panels
from .planar_panels import planar_panels

if TYPE_CHECKING:
    from ...solutions.robots import Robot

SAMPLES = 181  # per axis of a joint map
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


class FigureError(KinegradeError):
    """A figure that cannot be drawn."""


def figure(robot: "Robot", parameters: Parameters = None) -> Figure:
    """The robot's singularities and workspace in two or three panels, 12 inches wide.

    Raises:
        FigureError: the robot has a single joint.
    """
    values = robot.values(parameters)
    with mpl.rc_context(STYLE):
        found, cut = _found(robot, tuple(values.items()))
        planar = found.part.chain.kinds == "RR" and cut.axes == ("x", "y")
        draw_panels = planar_panels if planar else spatial_panels
        height = 4.7 if planar else 5.5
        drawn = Figure(figsize=(12, height), dpi=100, layout="constrained")
        FigureCanvasAgg(drawn)

        draw_panels(drawn, found, cut, determinant_formula(robot, found, parameters))
        lengths = [f"${latex_name(name)}={value:.5g}$" for name, value in values.items()]
        drawn.suptitle(f"{robot.title}  ({',  '.join(lengths)} m)", fontsize=13)

        # Ticks and layout settle here, inside the style; later draws repeat them.
        drawn.draw_without_rendering()
        drawn.set_layout_engine("none")
    return drawn


def picture(robot: "Robot", suffix: str, parameters: Parameters = None) -> bytes:
    """The figure as a file that ends in .png, .svg or .pdf, the same bytes every time.

    Raises:
        FigureError: another suffix, or a robot of a single joint.
    """
    kind = suffix.lower()
    if kind not in UNDATED:
        raise FigureError(f"A figure takes a name in .png, .svg or .pdf, got one in {suffix!r}.")
    drawn = figure(robot, parameters)
    file = BytesIO()
    with mpl.rc_context(STYLE):
        drawn.savefig(file, format=kind[1:], metadata=UNDATED[kind])
    return file.getvalue()


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
    return joint_map(robot, dict(values)), section(robot, dict(values))


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
