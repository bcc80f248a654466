# pyright: basic
"""The panels of a planar arm's figure: its ring, its postures with velocity ellipses and its singular values."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import PowerNorm, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Ellipse

from ...solutions.kinematics import frames
from ...solutions.singularity import singular_values, task_block
from ...solutions.workspace import LIMITS, Section, meridian
from .panels import INK, LINES, JointMap, angle_ticks, below, draw_section, sigma_bar, typeset

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BENDS = (1.9, 1.1, 0.45, 0.05)  # of the drawn postures, from the stretched arm [rad]
ELLIPSE = 3  # velocity ellipses are drawn at one third


def planar_panels(drawn: "Figure", found: JointMap, cut: Section, formula: str | None) -> None:
    """Draws what a planar arm's figure shows, its determinant's `formula` above its singular values."""
    ring, postures, curves = drawn.subplots(1, 3, width_ratios=[1.0, 1.0, 1.0])
    norm = PowerNorm(0.5, vmin=0.0, vmax=float(found.sigma.max()))
    draw_section(ring, found, cut, norm)
    sigma_bar(ring, ring.images[0], found)
    whole = bool(cut.curves) and all(
        curve.name != LIMITS and curve.boundary.all() for curve in cut.curves
    )
    ring.set_title(
        "Workspace: a ring, singular on its rims" if whole else "Workspace within the joint limits"
    )
    if whole and len(found.curves) == 1:
        radii = sorted({f"{np.hypot(*curve.points[0]):.3g} m" for curve in cut.curves})
        label = f"{typeset(found.curves[0][0])}:\nradius {' and '.join(radii)}"
        rim = Line2D([], [], color=LINES[0][0], lw=2.4, label=label)
        place = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "bbox_transform": below(ring)}
        ring.legend(handles=[rim], **place, handlelength=2.6)
    _draw_postures(postures, found)
    _draw_singular_values(curves, found, formula)


def _draw_postures(ax: "Axes", found: JointMap) -> None:
    """The arm at four bends, each with the velocities of its tool at unit joint rates."""
    chain = found.part.chain
    sweep = np.column_stack([np.zeros(720), np.linspace(-np.pi, np.pi, 720, endpoint=False)])
    radius = meridian(chain, sweep)[:, 0]
    stretched, far, near = sweep[radius.argmax(), 1], radius.max(), radius.min()
    for edge in (near, far):
        ax.add_patch(Circle((0, 0), edge, fill=False, ec="#777777", ls=(0, (5, 3)), lw=0.9))
    for bend, bearing in zip(BENDS, (3, 1, -1, -3), strict=True):
        q = np.array([0.0, stretched + bend])
        tool = frames(chain, q)[-1, :2, 3]
        q[0] = bearing * np.pi / 4 - np.arctan2(tool[1], tool[0])
        joints = frames(chain, q)[:, :2, 3]
        u, sigma, _ = np.linalg.svd(task_block(found.part, q))
        ink = LINES[0][0] if sigma[1] < 0.15 * sigma[0] else "#2d5f9a"
        turn = np.degrees(np.arctan2(u[1, 0], u[0, 0]))
        ax.plot(*joints.T, color="#5f6b78", lw=5, solid_capstyle="round", zorder=2)
        ax.plot(*joints[:-1].T, "o", ms=8, mfc="#e8a33d", mec=INK, mew=0.8, zorder=4)
        size = 2 * sigma / ELLIPSE
        ax.add_patch(
            Ellipse(
                joints[-1], *size, angle=turn, fc=(*to_rgb(ink), 0.25), ec=ink, lw=1.6, zorder=3
            )
        )
        ax.plot(*joints[-1], "o", ms=3, color=INK, zorder=5)
        ax.annotate(
            rf"$\sigma_{{\min}}={sigma[1]:.2f}$ m",
            far
            * np.array([0.86, 1.22])
            * np.sign([np.cos(bearing * np.pi / 4), np.sin(bearing * np.pi / 4)]),
            ha="center",
            va="center",
            color=ink,
        )
    ax.set_aspect("equal")
    ax.set(
        xlim=(-1.4 * far, 1.4 * far),
        ylim=(-1.4 * far, 1.4 * far),
        xlabel="$x$ [m]",
        ylabel="$y$ [m]",
    )
    ax.set_title(f"Velocity ellipses, drawn 1 : {ELLIPSE}")


def _draw_singular_values(ax: "Axes", found: JointMap, formula: str | None) -> None:
    q = np.column_stack([np.zeros(721), np.linspace(-np.pi, np.pi, 721)])
    block = task_block(found.part, q)
    largest, smallest = singular_values(block).T
    for _, lines in found.curves:
        for line in lines:
            ax.axvline(line[0, 1], color="#d7d7d7", lw=5, zorder=0)
    ax.axhline(0.0, color=INK, lw=0.8)
    ax.plot(q[:, 1], largest, color="#2d5f9a", ls=(0, (5, 2)), lw=1.8, label=r"$\sigma_{\max}$ [m]")
    ax.plot(q[:, 1], smallest, color=LINES[0][0], lw=2.2, label=r"$\sigma_{\min}$ [m]")
    ax.plot(
        q[:, 1], np.linalg.det(block), color=INK, ls=":", lw=1.8, label=r"$\det\mathbf{A}$ [m$^2$]"
    )
    ax.set_xlim(-np.pi, np.pi)
    angle_ticks(ax.xaxis, (-np.pi, np.pi))
    ax.set_xlabel("$q_2$ [rad]")
    ax.set_title(formula or "Singular values over $q_2$")
    ax.set_box_aspect(1.0)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=below(ax), ncols=3)
