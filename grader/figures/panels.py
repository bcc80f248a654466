# pyright: basic
"""The panels of a spatial arm's figure: its joint map, its workspace's section and its determinant."""

import re
import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import FuncNorm, PowerNorm
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.transforms import ScaledTranslation, Transform
from numpy.typing import NDArray

from ...solutions.expression import latex_name
from ...solutions.singularity import RegionalArm, Values
from ...solutions.workspace import LIMITS, SINGULAR, Section

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

# Dark solid, light dashed, ...: apart in colour, in grey and by pattern.
LINES = (
    ("#d7301f", "-"),
    ("#35c4f0", (0, (4, 1.6))),
    ("#f5a300", (0, (1, 1.2))),
    ("#d66bd0", (0, (5, 1.5, 1, 1.5))),
)
INK = "#1c1c1c"
PURPLE = "#7b2a9c"  # of curves that belong to no factor
WIDTHS = {
    (LIMITS, "boundary"): 1.4,
    (LIMITS, "inside"): 0.7,
    (SINGULAR, "boundary"): 1.8,
    (SINGULAR, "inside"): 0.9,
}
ROWS = ("v_x", "v_y", "v_z", r"\omega_x", r"\omega_y", r"\omega_z")


@dataclass(frozen=True, eq=False)
class JointMap:
    """sigma_min and det of the task block over a plane of two joints, with each factor's own zero curves."""

    part: RegionalArm
    free: tuple[int, int]
    spans: tuple[tuple[float, float], tuple[float, float]]
    held: Values
    sigma: Values
    det: Values | None
    curves: tuple[tuple[str, tuple[Values, ...]], ...]


def spatial_panels(drawn: "Figure", found: JointMap, cut: Section, formula: str | None) -> None:
    """Draws what a spatial arm's figure shows, the determinant if there is one under its `formula`."""
    wide = (cut.extent[1] - min(cut.extent[0], 0.0)) / (cut.extent[3] - cut.extent[2])
    widths = [1.0, min(max(0.62, wide), 0.9), 1.0][: 2 if found.det is None else 3]
    panels = drawn.subplots(1, len(widths), width_ratios=widths)
    norm = PowerNorm(0.5, vmin=0.0, vmax=max(float(found.sigma.max()), float(np.nanmax(cut.cells))))
    _draw_joint_map(panels[0], found, norm)
    draw_section(panels[1], found, cut, norm)
    if found.det is not None:
        _draw_det(panels[2], found, formula)


def _draw_joint_map(ax: "Axes", found: JointMap, norm: PowerNorm) -> None:
    image = ax.imshow(
        found.sigma,
        origin="lower",
        extent=(*found.spans[0], *found.spans[1]),
        aspect="auto",
        cmap="cividis",
        norm=norm,
    )
    sigma_bar(ax, image, found)
    handles = _draw_factors(ax, found)
    handles += _draw_limits(ax, found)
    _joint_axes(ax, found)
    ax.set_title(f"Dark: the {found.part.point} loses a direction")
    if handles:
        ax.legend(
            handles=handles,
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            bbox_transform=below(ax),
            handlelength=3.2,
        )


def _draw_factors(ax: "Axes", found: JointMap, *, plain: bool = False) -> list:
    handles = []
    for (name, lines), (colour, pattern) in zip(found.curves, LINES, strict=False):
        ink, halo = (INK, "white") if plain else (colour, "white" if pattern == "-" else "black")
        style = {"color": ink, "ls": pattern, "lw": 1.3 if plain else 2.2}
        effects = [withStroke(linewidth=style["lw"] + 1.2, foreground=halo)]
        for line in lines:
            ax.plot(*line.T, **style, path_effects=[] if plain else effects, zorder=3)
        handles.append(Line2D([], [], **style, label=_wrapped(typeset(name))))
    return handles


def _draw_limits(ax: "Axes", found: JointMap) -> list:
    """Hatching where a joint cannot go; a turn more or less of a revolute joint is the same place."""
    (left, right), (bottom, top) = found.spans
    shut_x, shut_y = (
        _shut(found.part, i, span) for i, span in zip(found.free, found.spans, strict=True)
    )
    boxes = [(a, b, bottom, top) for a, b in shut_x]
    open_x = np.array([left, *np.ravel(shut_x), right]).reshape(-1, 2)
    boxes += [(a, b, c, d) for a, b in open_x for c, d in shut_y if b - a > 1e-9]
    for a, b, c, d in boxes:
        ax.add_patch(
            Rectangle((a, c), b - a, d - c, fc="none", ec="white", hatch="////", lw=0, alpha=0.6)
        )
    frame = {"color": "white", "lw": 1.3}
    for a, b, c, d in boxes:
        for x in (x for x in (a, b) if (c, d) == (bottom, top) and left < x < right):
            ax.plot([x, x], [c, d], **frame)
        for y in (y for y in (c, d) if (c, d) != (bottom, top) and bottom < y < top):
            ax.plot([a, b], [y, y], **frame)
    return (
        [Patch(fc="#8a8a8a", ec="white", hatch="////", label="outside the joint limits")]
        if boxes
        else []
    )


def _shut(part: RegionalArm, joint: int, span: tuple[float, float]) -> list[tuple[float, float]]:
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
            angle_ticks(axis, found.spans[found.free.index(i)])
            axis.set_label_text(f"{name} [rad]")
        else:
            low, high = found.spans[found.free.index(i)]
            axis.set_ticks([tick for tick in axis.get_ticklocs() if low <= tick <= high])
            axis.set_label_text(f"{name} [m]")


def angle_ticks(axis: "Axis", span: tuple[float, float]) -> None:
    """Ticks an axis in radians at the right angles of `span`."""
    names = {0: "$0$", 1: r"$\pi/2$", 2: r"$\pi$", 3: r"$3\pi/2$", 4: r"$2\pi$"}
    halves = range(
        int(np.ceil(span[0] / (np.pi / 2) - 1e-9)), int(np.floor(span[1] / (np.pi / 2) + 1e-9)) + 1
    )
    texts = [names[k] if k >= 0 else f"$-{names[-k][1:]}" for k in halves]
    axis.set_ticks([k * np.pi / 2 for k in halves], texts)


def sigma_bar(ax: "Axes", image: "ScalarMappable", found: JointMap) -> None:
    """Draws the scale of an `image` of sigma_min beside it."""
    bar = ax.figure.colorbar(image, cax=ax.inset_axes((1.025, 0.0, 0.04, 1.0)))
    top = float(image.get_clim()[1] or 1.0)
    step = 10 ** np.floor(np.log10(top / 4))
    round_top = next(
        k * step for k in (50, 40, 30, 20, 15, 10, 8, 6, 5, 4, 3, 2, 1) if k * step <= top
    )
    bar.set_ticks([0.0, *(round_top * f for f in (0.01, 0.05, 0.2, 0.5, 1.0))], labels=None)
    bar.ax.yaxis.set_major_formatter(lambda v, _: f"{v:.3g}")
    bar.set_label(
        rf"$\sigma_{{\min}}(\mathbf{{A}})$ [{sigma_unit(found.part).strip('()')}], square-root scale"
    )


def draw_section(ax: "Axes", found: JointMap, cut: Section, norm: PowerNorm) -> None:
    """Draws the workspace's section: the best sigma_min in each cell, and the curves that bound and cross it."""
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
            handles=handles,
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            bbox_transform=below(ax),
            handlelength=2.6,
        )


def _draw_curves(ax: "Axes", found: JointMap, cut: Section) -> list:
    inks = {SINGULAR: PURPLE} | dict(
        zip((f.name for f in found.part.factors), (colour for colour, _ in LINES), strict=False)
    )
    handles: dict[str, Line2D] = {}
    drawn: dict[str, list[Values]] = {}
    size = max(cut.extent[1] - cut.extent[0], cut.extent[3] - cut.extent[2])
    for curve in cut.curves:
        name, style = short(curve.name), {"color": inks.get(curve.name, INK)}
        if np.ptp(curve.points, axis=0).max() < 0.005 * size:
            label = f"{name}: a point"
            handles[label] = Line2D(
                [], [], marker="o", ls="", mfc=style["color"], mec="white", ms=7, label=label
            )
            ax.plot(*curve.points[0], "o", ms=7, mfc=style["color"], mec="white", zorder=5)
            continue
        for place, there, pattern in (
            ("boundary", curve.boundary, "-"),
            ("inside", ~curve.boundary, (0, (3, 1.5))),
        ):
            width = WIDTHS.get((curve.name, place), 2.4)
            line = {**style, "lw": width, "ls": pattern, "label": f"{name}: {place}"}
            mask = there & _fresh(curve.points, drawn.setdefault(line["label"], []), 0.004 * size)
            if mask.any():
                ax.plot(
                    *np.where(mask[:, None], curve.points, np.nan).T,
                    **line,
                    zorder=3 if curve.name == LIMITS else 4,
                )
                handles[line["label"]] = Line2D([], [], **line)
                drawn[line["label"]].append(curve.points[mask])
    order = [*(short(f.name) for f in found.part.factors), short(SINGULAR), LIMITS]

    def rank(handle: Line2D) -> tuple[int, str]:
        name, _, where = str(handle.get_label()).partition(":")
        return order.index(name), where

    return sorted(handles.values(), key=rank)


def _fresh(points: Values, drawn: list[Values], near: float) -> NDArray[np.bool_]:
    """Where a curve does not run over itself or over one already drawn: doubled dashes look solid."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    gaps = np.linalg.norm(points[:, None] - points, axis=-1)
    fresh = ~((gaps < near) & (along[:, None] - along > 4 * near)).any(axis=1)
    for other in drawn:
        fresh &= (np.linalg.norm(points[:, None] - other, axis=-1) > near).all(axis=1)
    return fresh


def _draw_det(ax: "Axes", found: JointMap, formula: str | None) -> None:
    det = np.asarray(found.det) / np.abs(np.asarray(found.det)).max()
    image = ax.imshow(
        det,
        origin="lower",
        extent=(*found.spans[0], *found.spans[1]),
        aspect="auto",
        cmap="RdBu",
        norm=FuncNorm(
            (lambda v: np.sign(v) * np.sqrt(np.abs(v)), lambda v: np.sign(v) * v**2),
            vmin=-1.0,
            vmax=1.0,
        ),
    )
    bar = ax.figure.colorbar(image, cax=ax.inset_axes((1.025, 0.0, 0.04, 1.0)))
    bar.set_ticks(
        [-1, -0.5, -0.1, 0, 0.1, 0.5, 1], labels=["−1", "−0.5", "−0.1", "0", "0.1", "0.5", "1"]
    )
    bar.set_label(r"$\det\mathbf{A}\,/\,\max|\det\mathbf{A}|$, signed square-root scale")
    _draw_factors(ax, found, plain=True)
    _joint_axes(ax, found)
    for x, y, sign in _lobes(det, found):
        ax.text(x, y, sign, color="white", size=17, ha="center", va="center", clip_on=True)
    rows = ", ".join(f"${ROWS[row]}$" for row in found.part.rows)
    note = f"$\\mathbf{{A}}$: rows {rows} of the {found.part.point}'s Jacobian;\nwhite: $\\det\\mathbf{{A}}=0$"
    rule = sign_rule(found).replace("det A", "it").rstrip(".")
    note += ";\n" + _wrapped(rule, 56) if rule else ""
    ax.text(0.5, 0.0, note, transform=below(ax), ha="center", va="top", size=10, linespacing=1.3)
    ax.set_title(
        r"Sign of $\det\mathbf{A}$ tells postures apart" + (f"\n{formula}" if formula else "")
    )


def _lobes(det: Values, found: JointMap) -> list[tuple[float, float, str]]:
    """Where each lobe of the determinant peaks, and its sign: red and blue are the same grey."""
    size = np.abs(det).round(4)
    across, up = np.meshgrid(np.linspace(0.06, 0.94, 31), np.linspace(0.06, 0.94, 31))
    places = np.column_stack([across.ravel(), up.ravel()])
    column, row = (places * len(det)).astype(int).T
    middle = np.linalg.norm(places - 0.5, axis=1)
    kept: list[int] = []
    for k in np.lexsort([middle, -size[row, column]]):
        apart = all(np.linalg.norm(places[k] - places[other]) > 0.4 for other in kept)
        window = size[max(row[k] - 12, 0) : row[k] + 13, max(column[k] - 12, 0) : column[k] + 13]
        if apart and size[row[k], column[k]] > max(0.15, 0.75 * window.max()):
            kept.append(int(k))
    low, span = np.array(found.spans)[:, 0], np.diff(found.spans, axis=1)[:, 0]
    return [
        (*(low + span * places[k]).tolist(), "+" if det[row[k], column[k]] > 0 else "−")
        for k in kept
    ]


def below(ax: "Axes") -> Transform:
    """Coordinates whose zero lies under the axis label, however high the panel is."""
    return ax.transAxes + ScaledTranslation(0.0, -40 / 72, ax.figure.dpi_scale_trans)


def _wrapped(text: str, width: int = 46) -> str:
    return "\n".join(textwrap.wrap(text, width))


def typeset(name: str) -> str:
    """A factor's name with lengths in mathematics: |d2| as its symbol with a subscript."""
    return re.sub(r"\|(\w+)\|", lambda found: f"$|{latex_name(found[1])}|$", name)


def short(name: str) -> str:
    """A factor's name without what it means: "elbow" of "elbow: arm straight or folded"."""
    return name.partition(":")[0]


def sign_rule(found: JointMap) -> str:
    """The sentence on where the determinant changes sign on a map; empty if it never does."""
    names = {name for name, _ in found.curves}
    factors = [f for f in found.part.factors if f.name in names]
    crossed, touched = ([short(f.name) for f in factors if f.power % 2 == odd] for odd in (1, 0))
    if not crossed:
        return ""
    rule = f"det A changes sign across {' and '.join(crossed)}"
    return f"{rule}, but not across {' and '.join(touched)}." if touched else f"{rule}."


def sigma_unit(part: RegionalArm) -> str:
    """The unit of the block's singular values."""
    if max(part.rows) > 2:
        return "(mixed units)"
    return "m/s per unit joint rate" if "P" in part.chain.kinds else "m"
