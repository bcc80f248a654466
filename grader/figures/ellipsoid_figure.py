"""The ellipsoids of the tool's velocity and force on a drawn arm, as the viewer sees them."""

from dataclasses import dataclass

import numpy as np

from ...exercises.drawing import Drawing
from ...solutions.chain import Chain
from ...solutions.ellipsoids import Ellipsoid, force_ellipsoid, velocity_ellipsoid
from ...solutions.jacobian import jacobian
from .arm import compose
from .labels import Label
from .markup import pairs
from .plane import normal
from .pose import pose
from .scene import Scene
from .vectors import Array, norm, spaced, square_to, unit

VELOCITY = "#2d5f9a"
FORCE = "#a8480a"
AXIS = "#1b1f24"
LARGEST = {VELOCITY: 88.0, FORCE: 66.0}  # [px] of the longest half axis
NEVER_SHORTER = 1e-6  # of the longest: a force that nothing bounds is drawn as a line
LOST = 1e-9  # of the longest half axis, below which a direction counts as lost


@dataclass(frozen=True, eq=False)
class _Seen:
    """An ellipsoid about a point of the page: half axes (3, k), camera directions [px]."""

    axes: Array
    colour: str
    name: str


def draw_ellipsoids(drawing: Drawing, width: float) -> str:
    """The SVG of an arm with both ellipsoids about its tool, each at a scale of its own.

    The half axes of the velocity carry their names, the longest first.

    Raises:
        KinegradeError: `drawing.q` does not fit `drawing.chain`.
    """
    q = np.asarray(drawing.q, dtype=np.float64)
    block, plane = _block(drawing.chain, q)
    room = LARGEST[VELOCITY] + 14
    scene = compose(drawing, width, room)
    arm = pose(drawing, width, room)
    turn = arm.view.turn @ plane

    velocity = _seen(velocity_ellipsoid(block), turn, VELOCITY, "v")
    force = _seen(_bounded(force_ellipsoid(block)), turn, FORCE, "f")
    for one in (velocity, force):
        _draw_outline(scene, arm.end[:2], one)
    _draw_axes(scene, arm.end[:2], velocity)
    return scene.svg(drawing.caption, drawing.alt)


def ellipsoid_words(chain: Chain, q: Array) -> str:
    """The half axes of the velocity ellipsoid, what it loses, and what the force has of it."""
    block, _ = _block(chain, q)
    lengths = velocity_ellipsoid(block).lengths
    rates = "1 rad/s"
    if "P" in chain.kinds:
        rates = "1 (rad/s, m/s)"
    listed = ", ".join(f"{value:.3g}" for value in np.where(lengths > LOST, lengths, 0.0))
    words = f"With joint rates of length {rates} the velocity has half axes of {listed} m/s"
    lost = int((lengths <= LOST * lengths[0]).sum())
    if lost:
        directions = "a direction" if lost == 1 else f"{lost} directions"
        return f"{words}: {directions} of motion is lost, and forces along it need no torque."
    return f"{words}; the force ellipsoid has the same axes, with inverted lengths."


def _block(chain: Chain, q: Array) -> tuple[Array, Array]:
    """The linear rows (m, n) of the tool, and the directions (3, m) they stand for.

    Of a planar arm these are two directions of its plane.
    """
    linear = jacobian(chain, q)[:3]
    along = normal(chain, q)
    if along is None:
        return linear, np.eye(3)
    plane = np.column_stack(square_to(along))
    return plane.T @ linear, plane


def _bounded(ellipsoid: Ellipsoid) -> Ellipsoid:
    """The same with a length in place of an infinite one, so long that the others vanish."""
    shortest = float(ellipsoid.lengths.min())
    lengths = np.minimum(ellipsoid.lengths, shortest / NEVER_SHORTER)
    return Ellipsoid(ellipsoid.axes, lengths)


def _seen(ellipsoid: Ellipsoid, turn: Array, colour: str, name: str) -> _Seen:
    longest = max(float(ellipsoid.lengths.max()), 1e-12)
    axes = turn @ ellipsoid.axes * (ellipsoid.lengths * LARGEST[colour] / longest)
    return _Seen(axes, colour, name)


def _draw_outline(scene: Scene, at: Array, one: _Seen) -> None:
    """Draws the ellipse that an ellipsoid covers on the page, and names it."""
    across, lengths, _ = np.linalg.svd(one.axes[:2])
    angles = spaced(0.0, 2 * np.pi, 73)
    circle = np.stack([np.cos(angles), np.sin(angles)])
    outline = at + (across @ (np.maximum(lengths, 0.4)[:, None] * circle)).T
    dashes, fill = "none", f'fill="{one.colour}" fill-opacity=".2"'
    if one.colour == FORCE:
        dashes, fill = "5 3", 'fill="none"'
    path = f'<path d="M{pairs(outline, "L")}Z"'
    stroke = f'stroke="{one.colour}" stroke-width="1.6" stroke-dasharray="{dashes}"'
    scene.overlay(f'<g class="ellipsoid">{path} {fill} {stroke}/></g>', outline, 2.0)

    spots = outline[[9, 27, 45, 63, 0, 36]]
    away = np.array([unit(spot - at) for spot in spots])
    scene.labels.append(Label(one.name, "", spots, away, one.colour, "ellipsoid-label"))


def _draw_axes(scene: Scene, at: Array, velocity: _Seen) -> None:
    """Draws the half axes of the velocity ellipsoid to both sides, and names them."""
    for k, half in enumerate(velocity.axes.T):
        line = np.stack([at - half[:2], at + half[:2]])
        path = f'<path d="M{pairs(line, "L")}" stroke="{AXIS}" stroke-width=".9"/>'
        scene.overlay(f'<g class="half-axis">{path}</g>', line, 2.0)
        away = np.stack([unit(half[:2]), -unit(half[:2])])
        if norm(half[:2]) < 1:
            away = np.array([[1.0, 0.0], [-1.0, 0.0]])
        scene.labels.append(Label("σ", str(k + 1), line[::-1], away, AXIS, "half-axis-label"))
