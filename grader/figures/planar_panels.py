# pyright: basic
"""The panels of a planar arm's figure: ring, postures with velocity ellipses, singular values."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import PowerNorm, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Ellipse

from ...solutions.kinematics import frames
from ...solutions.singularity import Values, singular_values, task_block
from ...solutions.workspace import LIMITS, Section, meridian
from .joint_map import JointMap
from .joint_map_panel import draw_joint_map
from .panel_style import INK, LINES, angle_ticks, below, legend_below, sigma_bar, typeset
from .section_panel import draw_section

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Bend of each drawn posture from the stretched arm [rad], and the bearing of its tool [rad].
POSTURES = (
    (1.9, 3 * np.pi / 4),
    (1.1, np.pi / 4),
    (0.45, -np.pi / 4),
    (0.05, -3 * np.pi / 4),
)
ELLIPSE = 3  # velocity ellipses are drawn at one third
BLUE = "#2d5f9a"
RED = LINES[0][0]
NEARLY_SINGULAR = 0.15  # of the largest singular value


def planar_panels(drawn: "Figure", found: JointMap, cut: Section, formula: str | None) -> None:
    """Draws what a planar arm's figure shows, the determinant's `formula` above the curves."""
    ring, postures, curves = drawn.subplots(1, 3, width_ratios=[1.0, 1.0, 1.0])
    _draw_ring(ring, found, cut)
    _draw_postures(postures, found)
    _draw_singular_values(curves, found, formula)


def ring_panel(drawn: "Figure", found: JointMap, cut: Section, _: str | None) -> None:
    """Draws the workspace of a planar arm alone."""
    _draw_ring(drawn.subplots(), found, cut)


def planar_singular_panels(
    drawn: "Figure", found: JointMap, _: Section, formula: str | None
) -> None:
    """Draws where a planar arm is singular: the joint map, and the singular values over q2."""
    drawn.set_layout_engine("constrained", rect=(0.0, 0.05, 1.0, 0.95))
    left, right = drawn.subplots(1, 2)
    norm = PowerNorm(0.5, vmin=0.0, vmax=float(found.sigma.max()))
    draw_joint_map(left, found, norm)
    left.set_box_aspect(1.0)
    _draw_singular_values(right, found, formula)


def _draw_ring(ax: "Axes", found: JointMap, cut: Section) -> None:
    """The workspace; where it is bounded by singular curves alone, a legend with their radii."""
    norm = PowerNorm(0.5, vmin=0.0, vmax=float(found.sigma.max()))
    draw_section(ax, found, cut, norm)
    sigma_bar(ax, ax.images[0], found)
    if not cut.curves or any(
        curve.name == LIMITS or not curve.boundary.all() for curve in cut.curves
    ):
        ax.set_title("Workspace within the joint limits")
        return
    ax.set_title("Workspace: a ring, singular on its rims")
    if len(found.curves) == 1:
        radii = {f"{np.hypot(*curve.points[0]):.3g} m" for curve in cut.curves}
        name = typeset(found.curves[0][0])
        label = f"{name}:\nradius {' and '.join(sorted(radii))}"
        legend_below(ax, [Line2D([], [], color=RED, lw=2.4, label=label)], 2.6)


def _draw_postures(ax: "Axes", found: JointMap) -> None:
    """The arm at four bends, each with the velocities of its tool at unit joint rates."""
    sweep = np.column_stack([np.zeros(720), np.linspace(-np.pi, np.pi, 720, endpoint=False)])
    radius = meridian(found.part.chain, sweep)[:, 0]
    stretched, far, near = sweep[radius.argmax(), 1], radius.max(), radius.min()
    for edge in (near, far):
        ax.add_patch(Circle((0, 0), edge, fill=False, ec="#777777", ls=(0, (5, 3)), lw=0.9))
    for bend, bearing in POSTURES:
        q = np.array([0.0, stretched + bend])
        poses = frames(found.part.chain, q)
        x, y = poses[-1, :2, 3]
        sense = np.sign(poses[0, 2, 2])  # about an axis that points down, a turn goes the other way
        q[0] = sense * (bearing - np.arctan2(y, x))
        corner = far * np.array([0.86, 1.22]) * np.sign([np.cos(bearing), np.sin(bearing)])
        _draw_posture(ax, found, q, corner)

    reach = (-1.4 * far, 1.4 * far)
    ax.set_aspect("equal")
    ax.set(xlim=reach, ylim=reach, xlabel="$x$ [m]", ylabel="$y$ [m]")
    ax.set_title(f"Velocity ellipses, drawn 1 : {ELLIPSE}")


def _draw_posture(ax: "Axes", found: JointMap, q: Values, corner: Values) -> None:
    """The arm at `q` with its velocity ellipse, and its sigma_min written at `corner` (2,)."""
    joints = frames(found.part.chain, q)[:, :2, 3]
    u, sigma, _ = np.linalg.svd(task_block(found.part, q))
    ink = RED if sigma[1] < NEARLY_SINGULAR * sigma[0] else BLUE
    ax.plot(*joints.T, color="#5f6b78", lw=5, solid_capstyle="round", zorder=2)
    ax.plot(*joints[:-1].T, "o", ms=8, mfc="#e8a33d", mec=INK, mew=0.8, zorder=4)

    width, height = 2 * sigma / ELLIPSE
    turn = np.degrees(np.arctan2(u[1, 0], u[0, 0]))
    paint = {"fc": (*to_rgb(ink), 0.25), "ec": ink, "lw": 1.6}
    ax.add_patch(Ellipse(joints[-1], width, height, angle=turn, **paint, zorder=3))
    ax.plot(*joints[-1], "o", ms=3, color=INK, zorder=5)
    text = rf"$\sigma_{{\min}}={sigma[1]:.2f}$ m"
    ax.annotate(text, tuple(corner), ha="center", va="center", color=ink)


def _draw_singular_values(ax: "Axes", found: JointMap, formula: str | None) -> None:
    """Both singular values and the determinant over q2, grey where it is zero."""
    q = np.column_stack([np.zeros(721), np.linspace(-np.pi, np.pi, 721)])
    block = task_block(found.part, q)
    largest, smallest = singular_values(block).T
    det = np.linalg.det(block)
    for _, lines in found.curves:
        for line in lines:
            ax.axvline(line[0, 1], color="#d7d7d7", lw=5, zorder=0)
    ax.axhline(0.0, color=INK, lw=0.8)
    ax.plot(q[:, 1], largest, color=BLUE, ls=(0, (5, 2)), lw=1.8, label=r"$\sigma_{\max}$ [m]")
    ax.plot(q[:, 1], smallest, color=RED, lw=2.2, label=r"$\sigma_{\min}$ [m]")
    ax.plot(q[:, 1], det, color=INK, ls=":", lw=1.8, label=r"$\det\mathbf{A}$ [m$^2$]")
    ax.set_xlim(-np.pi, np.pi)
    angle_ticks(ax.xaxis, (-np.pi, np.pi))
    ax.set_xlabel("$q_2$ [rad]")
    ax.set_title(formula or "Singular values over $q_2$")
    ax.set_box_aspect(1.0)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=below(ax), ncols=3)
