"""A figure of a robot as a file: maps of its workspace, or the arm at a posture."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .formats import suffix_of
from .raster import on_white, pdf, png
from .robot_postures import PostureFigure, ellipsoids, posture, usual_posture

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ...solutions.robot import Robot
    from ...solutions.singularity import Parameters

MAPS = ("workspace", "singularities")
POSTURES: dict[str, Callable[..., PostureFigure]] = {"ellipsoids": ellipsoids, "posture": posture}
KINDS = (*MAPS, *POSTURES)
PNG_WIDTH = 960  # [px]: a drawn arm is as sharp on a dense screen
PDF_WIDTH = 360  # [pt]: five inches


@dataclass(frozen=True)
class RobotFigure:
    """The bytes of a figure's file, and what it shows in words."""

    data: bytes
    words: str


def robot_figure(
    robot: "Robot",
    kind: str,
    suffix: str,
    parameters: "Parameters" = None,
    q: "ArrayLike | None" = None,
) -> RobotFigure:
    """A figure of one of the KINDS, or with an empty kind workspace and singularities together.

    It ends in .png, .svg or .pdf, with the same bytes every time. Where a kind shows a posture,
    that is `q` (n,) [rad, m], or a usual one.

    Raises:
        FigureError: another suffix, or a map of a robot with a single joint.
        KinegradeError: q is no configuration of the robot, or a length is none of its own.
    """
    ending = suffix_of(suffix)
    if kind not in POSTURES:
        from .maps import describe, picture

        return RobotFigure(picture(robot, ending, parameters, kind), describe(robot, parameters))
    if q is None:
        q = usual_posture(robot)
    shown = POSTURES[kind](robot, parameters, q)
    return RobotFigure(_file(shown.svg, ending), shown.words)


def _file(svg: str, suffix: str) -> bytes:
    """A drawn arm as a file."""
    if suffix == ".png":
        return png(svg, PNG_WIDTH)
    if suffix == ".pdf":
        return pdf(svg, PDF_WIDTH)
    return on_white(svg).encode()
