# pyright: basic
"""The panel of the determinant over two joints: its sign tells postures apart."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import FuncNorm

from ...solutions.singularity import Values
from .joint_map import JointMap, sign_rule
from .joint_map_panel import draw_factors, joint_axes
from .panel_style import below, beside, wrapped

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROWS = ("v_x", "v_y", "v_z", r"\omega_x", r"\omega_y", r"\omega_z")
TICKS = (-1, -0.5, -0.1, 0, 0.1, 0.5, 1)
TICK_TEXTS = ("−1", "−0.5", "−0.1", "0", "0.1", "0.5", "1")
LABELLED = 0.15  # of the largest size: lobes that are flatter carry no sign
APART = 0.4  # of the panel's width: between two signs
BESIDE = 12  # samples to each side among which a lobe's sign stands near the top


def draw_determinant(ax: "Axes", found: JointMap, formula: str | None) -> None:
    """Draws the determinant over its largest size, with each lobe's sign, under its `formula`."""
    det = np.asarray(found.det) / np.abs(np.asarray(found.det)).max()
    image = ax.imshow(
        det,
        origin="lower",
        extent=(*found.spans[0], *found.spans[1]),
        aspect="auto",
        cmap="RdBu",
        norm=FuncNorm((_signed_root, _signed_square), vmin=-1.0, vmax=1.0),
    )
    bar = ax.figure.colorbar(image, cax=beside(ax))
    bar.set_ticks(TICKS, labels=TICK_TEXTS)
    bar.set_label(r"$\det\mathbf{A}\,/\,\max|\det\mathbf{A}|$, signed square-root scale")
    draw_factors(ax, found, plain=True)
    joint_axes(ax, found)
    for x, y, sign in _lobes(det, found):
        ax.text(x, y, sign, color="white", size=17, ha="center", va="center", clip_on=True)

    below_panel = {"transform": below(ax), "ha": "center", "va": "top"}
    ax.text(0.5, 0.0, _note(found), **below_panel, size=10, linespacing=1.3)
    title = r"Sign of $\det\mathbf{A}$ tells postures apart"
    if formula:
        title += f"\n{formula}"
    ax.set_title(title)


def _signed_root(value: Values) -> Values:
    return np.sign(value) * np.sqrt(np.abs(value))


def _signed_square(value: Values) -> Values:
    return np.sign(value) * value**2


def _note(found: JointMap) -> str:
    """Which rows the block A has, and across which curves the sign changes."""
    rows = ", ".join(f"${ROWS[row]}$" for row in found.part.rows)
    note = (
        f"$\\mathbf{{A}}$: rows {rows} of the {found.part.point}'s Jacobian;\n"
        r"white: $\det\mathbf{A}=0$"
    )
    rule = sign_rule(found).replace("det A", "it").rstrip(".")
    if rule:
        note += ";\n" + wrapped(rule, 56)
    return note


def _lobes(det: Values, found: JointMap) -> list[tuple[float, float, str]]:
    """Where each lobe of the determinant peaks, and its sign: red and blue are the same grey."""
    size = np.abs(det).round(4)
    across, up = np.meshgrid(np.linspace(0.06, 0.94, 31), np.linspace(0.06, 0.94, 31))
    places = np.column_stack([across.ravel(), up.ravel()])
    column, row = (places * len(det)).astype(int).T
    from_middle = np.linalg.norm(places - 0.5, axis=1)
    low, span = np.array(found.spans)[:, 0], np.diff(found.spans, axis=1)[:, 0]

    kept: list[Values] = []
    lobes = []
    # The highest first; of those equally high, the one nearest to the middle.
    for k in np.lexsort([from_middle, -size[row, column]]):
        if any(np.linalg.norm(places[k] - other) <= APART for other in kept):
            continue
        rows = slice(max(row[k] - BESIDE, 0), row[k] + BESIDE + 1)
        columns = slice(max(column[k] - BESIDE, 0), column[k] + BESIDE + 1)
        if size[row[k], column[k]] > max(LABELLED, 0.75 * size[rows, columns].max()):
            kept.append(places[k])
            sign = "+" if det[row[k], column[k]] > 0 else "−"
            x, y = (low + span * places[k]).tolist()
            lobes.append((x, y, sign))
    return lobes
