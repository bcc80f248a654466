"""Dimension lines beside what they measure, with the symbols of parameters."""

import numpy as np

from ...exercises.drawing import Dimension
from .arrows import arrowhead
from .labels import Label, symbol_of
from .markup import pairs
from .pose import DrawnArm
from .scene import Scene
from .vectors import Array, along_line, norm, quarter_turned, spaced, unit

INK = "#1b1f24"
ROOM = 18.0  # [px] that a dimension line needs to have its arrows inside


def draw_dimension(scene: Scene, arm: DrawnArm, dimension: Dimension) -> None:
    """Draws a dimension line; between points too close for it the arrows stand outside."""
    a = arm.view.points(np.array(dimension.start, dtype=np.float64))[:2]
    b = arm.view.points(np.array(dimension.end, dtype=np.float64))[:2]
    apart = norm(b - a)
    along = unit(b - a) if apart > 0.5 else np.array([1.0, 0.0])
    offset = _beside(scene, a, b, quarter_turned(along))
    start, end = a + offset, b + offset
    if apart >= ROOM:
        outward, line = along, np.stack([start, end])
    else:
        outward, line = -along, np.stack([start - 10.0 * along, end + 10.0 * along])

    feet: list[Array] = []
    for p in (a, b):
        foot = scene.emerging(p + 0.12 * offset, p + offset)
        feet.append(np.stack([foot, p + offset + 4 * unit(offset)]))
    lines = "".join(f"M{pairs(points, 'L')}" for points in (*feet, line))
    heads = arrowhead(start, -outward, 6.5, INK) + arrowhead(end, outward, 6.5, INK)
    svg = (
        f'<g class="dimension"><path d="{lines}" fill="none" stroke="#fff" stroke-width="2.8"/>'
        f'<path d="{lines}" fill="none" stroke="{INK}" stroke-width=".8"/>{heads}</g>'
    )
    scene.overlay(svg, line)
    for foot in feet:
        scene.mark(foot, 2.0)

    spots = along_line(line[0], line[1], (0.5, 0.33, 0.67, 0.17, 0.83))
    away = np.tile(unit(offset), (len(spots), 1))
    scene.labels.append(Label(*symbol_of(dimension.name), spots, away, INK, "dimension-label"))


def _beside(scene: Scene, a: Array, b: Array, side: Array) -> Array:
    """How far to move the dimension line from `a` to `b` (2,): to where it crosses least."""
    gaps = np.arange(16.0, 78.0, 4.0)
    offsets = np.column_stack([gaps, -gaps]).reshape(-1)
    measured = np.stack([a, b])
    ends = measured + offsets[:, None, None] * side
    steps = spaced(0, 1, int(norm(b - a)) + 2)[:, None]
    lines = ends[:, :1] + steps * (ends[:, 1:] - ends[:, :1])
    price = np.abs(offsets) + 3 * norm(b - a) * scene.ink_at(lines).mean(1)
    beyond = np.abs(ends[:, :, 0]) - scene.width / 2 + 10
    price += 20 * np.maximum(beyond, 0).sum(1)

    # The extension lines begin where they come out of the arm; one that never does has no room.
    steps = spaced(0.12, 1, 24)[:, None]
    ink = scene.ink_at(measured[:, None] + steps * offsets[:, None, None, None] * side)
    within = np.cumprod(ink > 0, axis=-1)
    crossed = np.where(within, 0.0, ink).mean(-1).sum(-1)
    price += 4 * np.abs(offsets) * crossed + 15 * within[..., -1].sum(-1)
    return float(offsets[np.argmin(price)]) * side
