"""From where an arm is seen, and how large: what fills the picture."""

from dataclasses import dataclass

import numpy as np

from ...exercises.drawing import Drawing
from ...solutions.kinematics import forward
from .plane import view_of
from .vectors import Array, cross, norm

USUAL_WIDTH = 420.0  # [px] of a picture, for which rooms and radii are given
FORESHORTENED = 0.45  # of its length, at which an arm seen end on is taken to appear
UPRIGHT = (0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class View:
    """From base coordinates [m] to camera coordinates [px]."""

    turn: Array
    scale: float
    shift: Array

    def points(self, p: Array) -> Array:
        """Camera coordinates (..., 3) of points (..., 3)."""
        return p @ self.turn.T * self.scale + self.shift


@dataclass(frozen=True, eq=False)
class _Spot:
    """A place (3,) in base coordinates [m], and the room from `low` to `high` (3,) for it [px]."""

    place: Array
    low: Array
    high: Array


def looked_at(drawing: Drawing) -> Array:
    """The rotation (3, 3) from base to camera coordinates from which a drawing is seen.

    Raises:
        KinegradeError: `drawing.q` does not fit `drawing.chain`.
    """
    view = drawing.view
    if view is None:
        view = view_of(drawing.chain, np.asarray(drawing.q, dtype=np.float64))
    return camera(*view)


def camera(azimuth: float, elevation: float) -> Array:
    """The rotation (3, 3) from base to camera coordinates, for angles in degrees."""
    az, el = np.radians([azimuth, elevation])
    towards = np.array([np.cos(el) * np.cos(az), np.cos(el) * np.sin(az), np.sin(el)])
    right = np.array([-np.sin(az), np.cos(az), 0.0])
    return np.stack([right, -cross(towards, right), towards])


def fitted(drawing: Drawing, points: Array, turn: Array, width: float, around: float = 0.0) -> View:
    """The view in which an arm through `points` (k, 3) fills the picture, with what is round it.

    `turn` (3, 3) is the rotation to camera coordinates, `width` that of the picture [px], and
    `around` the room to every side of the tool [px].
    """
    spots = _spots(drawing, points, turn)
    tool = forward(drawing.chain, np.asarray(drawing.q, dtype=np.float64))[:3, 3]
    reach = around * USUAL_WIDTH / width
    spots.append(_Spot(tool, np.full(3, -reach), np.full(3, reach)))
    size = width / USUAL_WIDTH
    at = np.array([turn @ spot.place for spot in spots])
    low = np.array([spot.low for spot in spots]) * size
    high = np.array([spot.high for spot in spots]) * size
    scale = _largest_scale(at, low, high, width)
    middle = ((at * scale + low).min(0) + (at * scale + high).max(0)) / 2
    return View(turn, scale, np.array([-middle[0], -middle[1], 0.0]))


def _spots(drawing: Drawing, points: Array, turn: Array) -> list[_Spot]:
    """The points, the base plate, the triads and the dimensions, with the room that each takes."""
    spots = [_Spot(p, np.full(3, -30.0), np.full(3, 30.0)) for p in points]
    if drawing.stands == UPRIGHT:
        plate = _Spot(np.zeros(3), np.array([-44.0, -18.0, 0.0]), np.array([44.0, 34.0, 0.0]))
    else:
        plate = _Spot(np.zeros(3), np.array([-44.0, -44.0, 0.0]), np.array([44.0, 44.0, 0.0]))
    spots.append(plate)

    for triad in drawing.triads:
        tips = 54.0 * (turn @ triad.pose[:3, :3]).T
        spots.append(_Spot(triad.pose[:3, 3], tips.min(0) - 6, tips.max(0) + 6))
    for dimension in drawing.dimensions:
        ends = (dimension.start, dimension.end)
        spots += [_Spot(np.array(end), np.full(3, -34.0), np.full(3, 34.0)) for end in ends]
    return spots


def _largest_scale(at: Array, low: Array, high: Array, width: float) -> float:
    """The largest scale [px/m] at which every spot and its room are inside of the picture.

    `at` (k, 3) are the spots in camera directions [m], `low` and `high` (k, 3) their rooms [px].
    """
    extent = norm(at.max(0) - at.min(0))
    # What an arm reaches towards the viewer takes no room: folded, or end on, it is drawn larger.
    seen = max(norm(at[:, :2].max(0) - at[:, :2].min(0)), FORESHORTENED * extent)
    scale = 0.8 * width / seen if extent else 1.0
    rooms = (width - 24.0 * width / USUAL_WIDTH, 1.05 * width)  # across and down
    for k, room in enumerate(rooms):
        apart = at[:, None, k] - at[None, :, k]
        # Never smaller than a tenth of the picture, whatever stands round the arm.
        spare = np.maximum(room - high[:, None, k] + low[None, :, k], 0.1 * width)
        far = apart > 1e-9 * extent
        scale = min(scale, float(np.min(spare[far] / apart[far], initial=np.inf)))
    return scale
