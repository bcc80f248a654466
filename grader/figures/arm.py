"""The picture of an arm: joints, links, base, gripper, axes, frames and dimensions, as SVG."""

from ...exercises.drawing import Drawing
from .arrows import draw_axis, draw_sense, draw_triad
from .bodies import draw_base, draw_body, draw_gripper, draw_link
from .dimensions import draw_dimension
from .pose import pose
from .scene import Scene


def draw(drawing: Drawing, width: float = 420) -> str:
    """The SVG of an arm, `width` pixels wide: the same text for the same drawing.

    Raises:
        KinegradeError: `drawing.q` does not fit `drawing.chain`.
    """
    return compose(drawing, width).svg(drawing.caption, drawing.alt)


def compose(drawing: Drawing, width: float, around: float = 0.0) -> Scene:
    """The arm as a scene that can be looked into, or drawn into, before it is written.

    There is room for `around` pixels to every side of the tool point.

    Raises:
        KinegradeError: `drawing.q` does not fit `drawing.chain`.
    """
    arm, scene = pose(drawing, width, around), Scene(width)
    # What comes later finds its place beside what is there already.
    bodies = [draw_body(scene, joint) for joint in arm.joints]
    draw_base(scene, arm, bodies, arm.view.turn @ drawing.stands)
    for joint in arm.joints:
        draw_link(scene, arm, joint, bodies)
    tips = draw_gripper(scene, arm, bodies)
    for joint in arm.joints:
        draw_axis(scene, joint, bodies)
    for joint in arm.joints:
        draw_sense(scene, arm, joint, arrows=drawing.arrows)
    for triad in drawing.triads:
        draw_triad(scene, arm, triad, tips)
    for dimension in drawing.dimensions:
        draw_dimension(scene, arm, dimension)
    return scene
