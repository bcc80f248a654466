"""What a figure of an arm shows, as data: the exercise says it, the grader's projector draws it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..solutions.chain import Chain

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Dimension:
    """A dimension line between two points in base coordinates [m], with a parameter's symbol."""

    start: Point
    end: Point
    name: str


@dataclass(frozen=True, eq=False)
class Triad:
    """A frame drawn as three labelled arrows.

    `pose` is (4, 4) in base coordinates, `label` the subscript.
    """

    pose: "NDArray[np.float64]"
    label: str


@dataclass(frozen=True, eq=False)
class Drawing:
    """An arm at one configuration `q` [rad, m], seen from `view` (azimuth, elevation) in degrees.

    Without a `view` an arm in space is seen from the front, a planar one flat, along its axes. With
    `arrows`, each joint carries an arrow in its positive sense; seen flat, it starts where the
    joint's angle is zero. The arm stands off its base plate along `stands`, in base axes: on a wall
    or a ceiling, that is not z.
    """

    chain: "Chain"
    q: tuple[float, ...]
    caption: str
    alt: str
    triads: tuple[Triad, ...] = ()
    dimensions: tuple[Dimension, ...] = ()
    arrows: bool = True
    view: tuple[float, float] | None = None
    stands: Point = (0.0, 0.0, 1.0)


def point(position: "NDArray[np.float64]") -> Point:
    """The tuple of a position (3,)."""
    x, y, z = (float(value) for value in position)
    return x, y, z
