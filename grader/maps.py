# pyright: basic
"""Figures of where a robot is singular and where its tool gets, with the finding in words."""

import os
import re
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import FuncNorm, PowerNorm, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Ellipse, Patch, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.transforms import ScaledTranslation, Transform
from numpy.typing import NDArray

from ..solutions.errors import KinegradeError
from ..solutions.expression import latex_name
from ..solutions.kinematics import frames
from ..solutions.singularity import Arm, arm, factor_values, sigma_min, singular_values, task_block, zero_set
from ..solutions.workspace import LIMITS, Section, meridian, reach, section

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.cm import ScalarMappable

    from ..solutions.robots import Robot

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
# Dark solid, light dashed, ...: apart in colour, in grey and by pattern.
LINES = (("#d7301f", "-"), ("#35c4f0", (0, (4, 1.6))), ("#f5a300", (0, (1, 1.2))), ("#d66bd0", (0, (5, 1.5, 1, 1.5))))
INK = "#1c1c1c"
ROWS = ("v_x", "v_y", "v_z", r"\omega_x", r"\omega_y", r"\omega_z")
BENDS = (1.9, 1.1, 0.45, 0.05)  # of the drawn postures, from the stretched arm [rad]
ELLIPSE = 3  # velocity ellipses are drawn at one third

Parameters = Mapping[str, float] | None
Values = NDArray[np.float64]


class FigureError(KinegradeError):
    """A figure that cannot be drawn or written."""


@dataclass(frozen=True, eq=False)
class JointMap:
    """sigma_min and det of the task block over a plane of two joints, with each factor's own zero curves."""

    part: Arm
    free: tuple[int, int]
    spans: tuple[tuple[float, float], tuple[float, float]]
    held: Values
    sigma: Values
    det: Values | None
    curves: tuple[tuple[str, tuple[Values, ...]], ...]


def figure(robot: "Robot", parameters: Parameters = None) -> Figure:
    """The robot's singularities and workspace: three panels, 12 inches wide."""
    with mpl.rc_context(STYLE):
        found, cut = _found(robot, tuple(robot.values(parameters).items()))
        flat = found.part.chain.kinds == "RR" and cut.axes == ("x", "y")
        drawn = Figure(figsize=(12, 4.7 if flat else 5.5), dpi=100, layout="constrained")
        FigureCanvasAgg(drawn)
        (_planar_panels if flat else _spatial_panels)(drawn, robot, found, cut)
        values = ",  ".join(f"${latex_name(n)}={v:.5g}$" for n, v in robot.values(parameters).items())
        drawn.suptitle(f"{robot.title}  ({values} m)", fontsize=13)
        # Ticks and layout settle here, inside the style; later draws repeat them.
        drawn.draw_without_rendering()
        drawn.set_layout_engine("none")
    return drawn


def save(robot: "Robot", path: Path, parameters: Parameters = None) -> None:
    """Writes the figure as .png, .svg or .pdf, the same bytes every time, and never half a file.

    Raises:
        FigureError: Another suffix.
    """
    suffix = path.suffix.lower()
    if suffix not in {".png", ".svg", ".pdf"}:
        raise FigureError(f"A figure takes a name in .png, .svg or .pdf, got {path.name!r}.")
    dates = {".png": {"Software": None}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    unfinished = path.with_name(f".{path.name}.{os.getpid()}.part")
    drawn = figure(robot, parameters)
    try:
        with mpl.rc_context(STYLE):
            drawn.savefig(unfinished, format=suffix[1:], metadata=dates[suffix])
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def joint_map(robot: "Robot", parameters: Parameters = None) -> JointMap:
    """The map over q2 and q3 (of a two-joint arm: q1 and q2), the other joints held."""
    part = arm(robot, parameters)
    n = part.chain.n
    if n < 2:
        raise FigureError(f"A joint map takes a robot of two joints or more, got {robot.name} with {n}.")
    free = (0, 1) if n == 2 else (1, 2)
    spans = (_span(part, free[0]), _span(part, free[1]))
    # Held joints stay off zero, where a wrist is singular whatever the arm does.
    held = np.array([low + 0.62 * (high - low) for low, high in part.limits]) if n > 3 else np.zeros(n)
    held[0] = 0.0
    q = np.broadcast_to(held, (SAMPLES, SAMPLES, n)).copy()
    x, y = (low + (high - low) * (np.arange(SAMPLES) + 0.5) / SAMPLES for low, high in spans)
    q[..., free[0]], q[..., free[1]] = np.meshgrid(x, y)
    block = task_block(part, q)
    det = np.linalg.det(block) if block.shape[-1] == block.shape[-2] else None
    at = np.concatenate([held, np.zeros(robot.n - n)])
    curves = tuple(
        (factor.name, zero_set(robot, factor.name, parameters, free=free, at=at, ranges=spans))
        for factor in part.factors
    )
    return JointMap(part, free, spans, held, sigma_min(block), det, curves)


@lru_cache(maxsize=8)
def _found(robot: "Robot", values: tuple[tuple[str, float], ...]) -> tuple[JointMap, Section]:
    """Both halves of a figure, kept for its description and its other formats."""
    return joint_map(robot, dict(values)), section(robot, dict(values))


def _span(part: Arm, joint: int) -> tuple[float, float]:
    low, high = part.limits[joint]
    if part.chain.kinds[joint] == "R":
        return -np.pi, np.pi
    margin = 0.08 * (high - low)
    return min(low, 0.0) - margin, max(high, 0.0) + margin


def _spatial_panels(drawn: Figure, robot: "Robot", found: JointMap, cut: Section) -> None:
    wide = (cut.extent[1] - min(cut.extent[0], 0.0)) / (cut.extent[3] - cut.extent[2])
    widths = [1.0, min(max(0.62, wide), 0.9), 1.0][: 2 if found.det is None else 3]
    panels = drawn.subplots(1, len(widths), width_ratios=widths)
    norm = PowerNorm(0.5, vmin=0.0, vmax=max(float(found.sigma.max()), float(np.nanmax(cut.cells))))
    _draw_joint_map(panels[0], found, norm)
    _draw_section(panels[1], found, cut, norm)
    if found.det is not None:
        _draw_det(panels[2], robot, found)


def _draw_joint_map(ax: "Axes", found: JointMap, norm: PowerNorm) -> None:
    image = ax.imshow(
        found.sigma,
        origin="lower",
        extent=(*found.spans[0], *found.spans[1]),
        aspect="auto",
        cmap="cividis",
        norm=norm,
    )
    _sigma_bar(ax, image, found)
    handles = _draw_factors(ax, found)
    handles += _draw_limits(ax, found)
    _joint_axes(ax, found)
    ax.set_title(f"Dark: the {found.part.point} loses a direction")
    if handles:
        ax.legend(
            handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=_below(ax), handlelength=3.2
        )


def _draw_factors(ax: "Axes", found: JointMap, *, plain: bool = False) -> list:
    handles = []
    for (name, lines), (colour, pattern) in zip(found.curves, LINES, strict=False):
        ink, halo = (INK, "white") if plain else (colour, "white" if pattern == "-" else "black")
        style = {"color": ink, "ls": pattern, "lw": 1.3 if plain else 2.2}
        effects = [withStroke(linewidth=style["lw"] + 1.2, foreground=halo)]
        for line in lines:
            ax.plot(*line.T, **style, path_effects=[] if plain else effects, zorder=3)
        handles.append(Line2D([], [], **style, label=_wrapped(name)))
    return handles


def _draw_limits(ax: "Axes", found: JointMap) -> list:
    """Hatching where a joint cannot go; a turn more or less of a revolute joint is the same place."""
    (left, right), (bottom, top) = found.spans
    shut_x, shut_y = (_shut(found.part, i, span) for i, span in zip(found.free, found.spans, strict=True))
    boxes = [(a, b, bottom, top) for a, b in shut_x]
    open_x = np.array([left, *np.ravel(shut_x), right]).reshape(-1, 2)
    boxes += [(a, b, c, d) for a, b in open_x for c, d in shut_y if b - a > 1e-9]
    for a, b, c, d in boxes:
        ax.add_patch(Rectangle((a, c), b - a, d - c, fc="none", ec="white", hatch="////", lw=0, alpha=0.6))
    frame = {"color": "white", "lw": 1.3}
    for a, b, c, d in boxes:
        for x in (x for x in (a, b) if (c, d) == (bottom, top) and left < x < right):
            ax.plot([x, x], [c, d], **frame)
        for y in (y for y in (c, d) if (c, d) != (bottom, top) and bottom < y < top):
            ax.plot([a, b], [y, y], **frame)
    return [Patch(fc="#8a8a8a", ec="white", hatch="////", label="outside the joint limits")] if boxes else []


def _shut(part: Arm, joint: int, span: tuple[float, float]) -> list[tuple[float, float]]:
    """The intervals of a map's axis that a joint cannot reach."""
    low, high = part.limits[joint]
    turns = (-1, 0, 1) if part.chain.kinds[joint] == "R" else (0,)
    reached, shut = span[0], []
    for turn in turns:
        start, end = low + 2 * np.pi * turn, high + 2 * np.pi * turn
        if start > reached + 1e-9 and reached < span[1]:
            shut.append((reached, min(start, span[1])))
        reached = max(reached, end)
    return [*shut, (reached, span[1])] if reached < span[1] - 1e-9 else shut


def _joint_axes(ax: "Axes", found: JointMap) -> None:
    ax.set_xlim(found.spans[0])
    ax.set_ylim(found.spans[1])
    for i, axis in zip(found.free, (ax.xaxis, ax.yaxis), strict=True):
        name = f"${latex_name(f'q{i + 1}')}$"
        if found.part.chain.kinds[i] == "R":
            _angle_ticks(axis, found.spans[found.free.index(i)])
            axis.set_label_text(f"{name} [rad]")
        else:
            axis.set_label_text(f"{name} [m]")


def _angle_ticks(axis: "Axis", span: tuple[float, float]) -> None:
    names = {0: "$0$", 1: r"$\pi/2$", 2: r"$\pi$", 3: r"$3\pi/2$", 4: r"$2\pi$"}
    halves = range(int(np.ceil(span[0] / (np.pi / 2) - 1e-9)), int(np.floor(span[1] / (np.pi / 2) + 1e-9)) + 1)
    texts = [names[k] if k >= 0 else f"$-{names[-k][1:]}" for k in halves]
    axis.set_ticks([k * np.pi / 2 for k in halves], texts)


def _sigma_bar(ax: "Axes", image: "ScalarMappable", found: JointMap) -> None:
    bar = ax.figure.colorbar(image, cax=ax.inset_axes((1.025, 0.0, 0.04, 1.0)))
    top = float(image.get_clim()[1] or 1.0)
    step = 10 ** np.floor(np.log10(top / 4))
    round_top = next(k * step for k in (50, 40, 30, 20, 15, 10, 8, 6, 5, 4, 3, 2, 1) if k * step <= top)
    bar.set_ticks([0.0, *(round_top * f for f in (0.01, 0.05, 0.2, 0.5, 1.0))], labels=None)
    bar.ax.yaxis.set_major_formatter(lambda v, _: f"{v:.3g}")
    bar.set_label(rf"$\sigma_{{\min}}(\mathbf{{A}})$ [{_unit(found.part).strip('()')}], square-root scale")


def _draw_section(ax: "Axes", found: JointMap, cut: Section, norm: PowerNorm) -> None:
    ax.imshow(cut.cells, origin="lower", extent=cut.extent, cmap="cividis", norm=norm)
    handles = _draw_curves(ax, found, cut)
    left, right, bottom, top = cut.extent
    pad = 0.04 * (top - bottom)
    if cut.axes == ("r", "z"):
        ax.axvline(0.0, color=INK, lw=0.9, ls=(0, (8, 2, 2, 2)), zorder=1)
        left = 0.0
    ax.set_xlim(left - pad, right + pad)
    ax.set_ylim(bottom - pad, top + pad)
    ax.set_xlabel("distance $r$ from axis 1 [m]" if cut.axes[0] == "r" else "$x$ [m]")
    ax.set_ylabel("height $z$ along axis 1 [m]" if cut.axes[1] == "z" else "$y$ [m]")
    ax.set_title(f"Section of the {found.part.point}'s workspace")
    if handles:
        ax.legend(
            handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=_below(ax), handlelength=2.6
        )


def _draw_curves(ax: "Axes", found: JointMap, cut: Section) -> list:
    inks = dict(zip((f.name for f in found.part.factors), (colour for colour, _ in LINES), strict=False))
    handles: dict[str, Line2D] = {}
    drawn: dict[str, list[Values]] = {}
    size = max(cut.extent[1] - cut.extent[0], cut.extent[3] - cut.extent[2])
    for curve in cut.curves:
        short, style = _short(curve.name), {"color": inks.get(curve.name, INK)}
        if np.ptp(curve.points, axis=0).max() < 0.005 * size:
            label = f"{short}: a point"
            handles[label] = Line2D([], [], marker="o", ls="", mfc=style["color"], mec="white", ms=7, label=label)
            ax.plot(*curve.points[0], "o", ms=7, mfc=style["color"], mec="white", zorder=5)
            continue
        for place, there, pattern in (("boundary", curve.boundary, "-"), ("inside", ~curve.boundary, (0, (3, 1.5)))):
            width = 2.4 if curve.name != LIMITS else 1.4 if place == "boundary" else 0.7
            line = {**style, "lw": width, "ls": pattern, "label": f"{short}: {place}"}
            mask = there & _fresh(curve.points, drawn.setdefault(line["label"], []), 0.004 * size)
            if mask.any():
                ax.plot(
                    *np.where(mask[:, None], curve.points, np.nan).T, **line, zorder=3 if curve.name == LIMITS else 4
                )
                handles[line["label"]] = Line2D([], [], **line)
                drawn[line["label"]].append(curve.points[mask])
    order = [_short(f.name) for f in found.part.factors] + [LIMITS]
    return sorted(handles.values(), key=lambda handle: order.index(_short(str(handle.get_label()))))


def _fresh(points: Values, drawn: list[Values], near: float) -> NDArray[np.bool_]:
    """Where a curve does not run over itself or over one already drawn: doubled dashes look solid."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    gaps = np.linalg.norm(points[:, None] - points, axis=-1)
    fresh = ~((gaps < near) & (along[:, None] - along > 4 * near)).any(axis=1)
    for other in drawn:
        fresh &= (np.linalg.norm(points[:, None] - other, axis=-1) > near).all(axis=1)
    return fresh


def _short(name: str) -> str:
    return name.partition(":")[0]


def _wrapped(text: str, width: int = 46) -> str:
    return "\n".join(textwrap.wrap(text, width))


def _draw_det(ax: "Axes", robot: "Robot", found: JointMap) -> None:
    det = np.asarray(found.det) / np.abs(np.asarray(found.det)).max()
    image = ax.imshow(
        det,
        origin="lower",
        extent=(*found.spans[0], *found.spans[1]),
        aspect="auto",
        cmap="RdBu",
        norm=FuncNorm((lambda v: np.sign(v) * np.sqrt(np.abs(v)), lambda v: np.sign(v) * v**2), vmin=-1.0, vmax=1.0),
    )
    bar = ax.figure.colorbar(image, cax=ax.inset_axes((1.025, 0.0, 0.04, 1.0)))
    bar.set_ticks([-1, -0.5, -0.1, 0, 0.1, 0.5, 1], labels=["−1", "−0.5", "−0.1", "0", "0.1", "0.5", "1"])
    bar.set_label(r"$\det\mathbf{A}\,/\,\max|\det\mathbf{A}|$, signed square-root scale")
    _draw_factors(ax, found, plain=True)
    _joint_axes(ax, found)
    for x, y, sign in _lobes(det, found):
        ax.text(x, y, sign, color="white", size=17, ha="center", va="center", clip_on=True)
    rows = ", ".join(f"${ROWS[row]}$" for row in found.part.rows)
    note = f"$\\mathbf{{A}}$: rows {rows} of the {found.part.point}'s Jacobian;\nwhite: $\\det\\mathbf{{A}}=0$"
    rule = _sign_rule(found.part).replace("det A", "it").rstrip(".")
    note += ";\n" + _wrapped(rule, 56) if rule else ""
    ax.text(0.5, 0.0, note, transform=_below(ax), ha="center", va="top", size=10, linespacing=1.3)
    formula = _formula(robot, found)
    ax.set_title(r"Sign of $\det\mathbf{A}$ tells postures apart" + (f"\n{formula}" if formula else ""))


def _below(ax: "Axes") -> Transform:
    """Coordinates whose zero lies under the axis label, however high the panel is."""
    return ax.transAxes + ScaledTranslation(0.0, -40 / 72, ax.figure.dpi_scale_trans)


def _lobes(det: Values, found: JointMap) -> list[tuple[float, float, str]]:
    """Where each lobe of the determinant peaks, and its sign: red and blue are the same grey."""
    size = np.abs(det).round(4)
    across, up = np.meshgrid(np.linspace(0.06, 0.94, 31), np.linspace(0.06, 0.94, 31))
    places = np.column_stack([across.ravel(), up.ravel()])
    column, row = (places * SAMPLES).astype(int).T
    middle = np.linalg.norm(places - 0.5, axis=1)
    kept: list[int] = []
    for k in np.lexsort([middle, -size[row, column]]):
        apart = all(np.linalg.norm(places[k] - places[other]) > 0.4 for other in kept)
        window = size[max(row[k] - 12, 0) : row[k] + 13, max(column[k] - 12, 0) : column[k] + 13]
        if apart and size[row[k], column[k]] > max(0.15, 0.75 * window.max()):
            kept.append(int(k))
    low, span = np.array(found.spans)[:, 0], np.diff(found.spans, axis=1)[:, 0]
    return [(*(low + span * places[k]).tolist(), "+" if det[row[k], column[k]] > 0 else "−") for k in kept]


def _planar_panels(drawn: Figure, robot: "Robot", found: JointMap, cut: Section) -> None:
    ring, postures, curves = drawn.subplots(1, 3, width_ratios=[1.0, 1.0, 1.0])
    norm = PowerNorm(0.5, vmin=0.0, vmax=float(found.sigma.max()))
    _draw_section(ring, found, cut, norm)
    _sigma_bar(ring, ring.images[0], found)
    radii = sorted({f"{np.hypot(*curve.points[0]):.3g} m" for curve in cut.curves})
    whole = bool(cut.curves) and all(curve.name != LIMITS and curve.boundary.all() for curve in cut.curves)
    ring.set_title("Workspace: a ring, singular on its rims" if whole else "Workspace within the joint limits")
    if whole and len(found.curves) == 1:
        radii = sorted({f"{np.hypot(*curve.points[0]):.3g} m" for curve in cut.curves})
        label = f"{found.curves[0][0]}:\nradius {' and '.join(radii)}"
        rim = Line2D([], [], color=LINES[0][0], lw=2.4, label=label)
        place = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "bbox_transform": _below(ring)}
        ring.legend(handles=[rim], **place, handlelength=2.6)
    _draw_postures(postures, found)
    _draw_singular_values(curves, robot, found)


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
        ax.add_patch(Ellipse(joints[-1], *size, angle=turn, fc=(*to_rgb(ink), 0.25), ec=ink, lw=1.6, zorder=3))
        ax.plot(*joints[-1], "o", ms=3, color=INK, zorder=5)
        ax.annotate(
            rf"$\sigma_{{\min}}={sigma[1]:.2f}$ m",
            far * np.array([0.86, 1.22]) * np.sign([np.cos(bearing * np.pi / 4), np.sin(bearing * np.pi / 4)]),
            ha="center",
            va="center",
            color=ink,
        )
    ax.set_aspect("equal")
    ax.set(xlim=(-1.4 * far, 1.4 * far), ylim=(-1.4 * far, 1.4 * far), xlabel="$x$ [m]", ylabel="$y$ [m]")
    ax.set_title(f"Velocity ellipses, drawn 1 : {ELLIPSE}")


def _draw_singular_values(ax: "Axes", robot: "Robot", found: JointMap) -> None:
    q = np.column_stack([np.zeros(721), np.linspace(-np.pi, np.pi, 721)])
    block = task_block(found.part, q)
    largest, smallest = singular_values(block).T
    for _, lines in found.curves:
        for line in lines:
            ax.axvline(line[0, 1], color="#d7d7d7", lw=5, zorder=0)
    ax.axhline(0.0, color=INK, lw=0.8)
    ax.plot(q[:, 1], largest, color="#2d5f9a", ls=(0, (5, 2)), lw=1.8, label=r"$\sigma_{\max}$ [m]")
    ax.plot(q[:, 1], smallest, color=LINES[0][0], lw=2.2, label=r"$\sigma_{\min}$ [m]")
    ax.plot(q[:, 1], np.linalg.det(block), color=INK, ls=":", lw=1.8, label=r"$\det\mathbf{A}$ [m$^2$]")
    ax.set_xlim(-np.pi, np.pi)
    _angle_ticks(ax.xaxis, (-np.pi, np.pi))
    ax.set_xlabel("$q_2$ [rad]")
    ax.set_title(_formula(robot, found) or "Singular values over $q_2$")
    ax.set_box_aspect(1.0)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), bbox_transform=_below(ax), ncols=3)


def _formula(robot: "Robot", found: JointMap) -> str | None:
    """The determinant as the product of its factors; its constant is found as a monomial of the parameters."""
    part, n = found.part, found.part.chain.n
    texts = [_shorthand(f.expression, f.power) for f in part.factors]
    if found.det is None or n > 3 or not texts or None in texts:
        return None
    q = np.array([[0.3, 0.7, 0.4], [0.3, -1.1, 1.3]])[:, :n]

    def constant(values: Mapping[str, float]) -> Values:
        named = factor_values(robot, values, np.pad(q, ((0, 0), (0, robot.n - n))))
        product = np.prod([named[f.name] ** f.power for f in part.factors], axis=0)
        return np.linalg.det(task_block(arm(robot, values), q)) / product

    base = constant({})
    powers = {name: float(np.log2(constant({name: 2 * v})[0] / base[0])) for name, v in robot.parameters.items()}
    unit = base[0] / np.prod([robot.parameters[name] ** power for name, power in powers.items()])
    found_all = np.allclose([base[1] / base[0], abs(unit), *powers.values()], [1, 1, *map(round, powers.values())])
    if not found_all:
        return None
    lengths = [
        latex_name(name) + (f"^{power:.0f}" if power > 1.5 else "") for name, power in powers.items() if power > 0.5
    ]
    sign = "-" if unit < 0 else ""
    product = r"\,".join([*lengths, *map(str, texts)])
    return rf"$\det\mathbf{{A}}={sign}{product}$"


def _shorthand(expression: str, power: int) -> str | None:
    """A sum of products in the course's shorthand, s_23 for sin(q2 + q3); None for any other expression."""
    text = re.sub(r"(sin|cos)\(([q0-9 +]+)\)", lambda m: f"{m[1][0]}_{{{re.sub('[q +]', '', m[2])}}}", expression)
    if re.search(r"[(/^]|\*\*", text):
        return None
    terms = [r"\,".join(_symbol(s) for s in term.split("*")) for term in re.split(r"(?= [+-] )", text)]
    text = "".join(terms) if len(terms) == 1 else f"({''.join(terms)})"
    return text if power == 1 else f"{text}^{power}"


def _symbol(text: str) -> str:
    sign, name = re.findall(r"^(\s*[+-]?\s*)(.*?)\s*$", text)[0]
    return sign.strip() + (name if "{" in name else latex_name(name))


def describe(robot: "Robot", parameters: Parameters = None) -> str:
    """The figure in words: what is singular and where, how far the tool gets, and what bounds its workspace."""
    found, cut = _found(robot, tuple(robot.values(parameters).items()))
    part, point = found.part, found.part.point
    values = ", ".join(f"{name} = {value:.5g} m" for name, value in robot.values(parameters).items())
    first, second = (f"q{i + 1}" for i in found.free)
    near, far = (0.0 if value < 1e-9 else value for value in reach(robot, parameters))
    where = "; ".join(f"{name} ({_where(found, lines)})" for name, lines in found.curves)
    bound = f"{np.nanmax(cut.cells):.3g} {_unit(part)}"
    sentences = [
        f"Singularities and workspace: {robot.title} ({values}).",
        f"Over {first} and {second}, the smallest singular value of the {point}'s Jacobian block is at most {bound}.",
        f"It falls to zero, where the {point} loses a direction, on: {where}." if where else "",
        _sign_rule(part) if found.det is not None else "",
        f"Within the joint limits the {point} gets from {near:.3g} m to {far:.3g} m away from axis 1.",
        _walls(part, cut),
    ]
    return " ".join(sentence for sentence in sentences if sentence)


def _sign_rule(part: Arm) -> str:
    crossed, touched = ([_short(f.name) for f in part.factors if f.power % 2 == odd] for odd in (1, 0))
    if not crossed:
        return ""
    rule = f"det A changes sign across {' and '.join(crossed)}"
    return f"{rule}, but not across {' and '.join(touched)}." if touched else f"{rule}."


def _where(found: JointMap, lines: tuple[Values, ...]) -> str:
    """The values of a joint on straight lines along the map; else how far a curve runs."""
    for k, joint in ((1, found.free[1]), (0, found.free[0])):
        if lines and all(np.ptp(line[:, k]) < 1e-6 for line in lines):
            values = {
                _value(found.part, joint, float(line[0, k])): None for line in sorted(lines, key=lambda v: abs(v[0, k]))
            }
            return f"q{joint + 1} = " + " and ".join(values)
    return "a curve across the map" if lines else "nowhere on the map"


def _value(part: Arm, joint: int, value: float) -> str:
    turn = part.chain.kinds[joint] == "R" and abs(abs(value) - np.pi) < 1e-9
    value = 0.0 if abs(value) < 1e-9 else np.pi if turn else value
    return f"{np.degrees(value):.4g}°" if part.chain.kinds[joint] == "R" else f"{value:.3g} m"


def _walls(part: Arm, cut: Section) -> str:
    names = [_short(f.name) for f in part.factors] + [LIMITS]
    bounding = {_short(curve.name) for curve in cut.curves if curve.boundary.any()}
    crossing = {_short(curve.name) for curve in cut.curves if (~curve.boundary).any() and curve.name != LIMITS}
    away = set(names[:-1]) - {_short(curve.name) for curve in cut.curves} if cut.curves else set()
    texts = [
        ("Its workspace is bounded by the images of: ", bounding),
        ("Singular inside the workspace: ", crossing),
        ("Out of the joint limits' reach: ", away),
    ]
    return " ".join(f"{text}{', '.join(n for n in names if n in chosen)}." for text, chosen in texts if chosen)


def _unit(part: Arm) -> str:
    if max(part.rows) > 2:
        return "(mixed units)"
    return "m/s per unit joint rate" if "P" in part.chain.kinds else "m"
