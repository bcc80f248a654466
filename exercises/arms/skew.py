"""Two revolute joints and a slide on skew axes, given by points and directions, at one moment."""

import numpy as np

from ...solutions.axes import along, assembled
from ..answers import Variant
from ..arm import Array
from ..calculations.columns import columns
from ..contract.introduction import WORDS
from ..contract.names import Function
from ..drawing import Drawing, Triad

WHOLE = (  # their lengths are, too; no number of one is so small that it hardly matters
    (1, 2, 2),
    (2, 3, 6),
    (4, 4, 7),
    (6, 6, 7),
    (6, 10, 15),
    (8, 9, 12),
    (8, 11, 16),
    (9, 12, 20),
    (12, 15, 16),
)
POINTS = ("p1", "p2", "p3", "p")
DIRECTIONS = ("w1", "w2", "w3")


def direction(rng: np.random.Generator) -> list[int]:
    """A vector of whole numbers whose length is whole."""
    sizes = rng.permutation(WHOLE[int(rng.integers(len(WHOLE)))])
    return (sizes * rng.choice([-1, 1], 3)).tolist()


def outward(rng: np.random.Generator) -> dict[str, list[float]]:
    """Points on the axes and the tool point, each further out: no lever arm is short."""
    octant = [*rng.choice([-1, 1], 2), 1]
    points = np.cumsum(rng.integers(30, 90, (4, 3)), axis=0) * octant / 100
    return dict(zip(POINTS, points.round(2).tolist(), strict=True))


def directions(v: Variant) -> Array:
    """The directions of axes 1, 2, 3 as they are printed, one a row (3, 3)."""
    return np.array([v["w1"], v["w2"], v["w3"]], dtype=float)


def axes(v: Variant) -> Array:
    """The unit vectors along them, one a row (3, 3)."""
    return directions(v) / np.linalg.norm(directions(v), axis=1, keepdims=True)


def path(v: Variant) -> Array:
    """The base origin, the points on the axes and the tool point, one a row (5, 3)."""
    return np.array([np.zeros(3), v["p1"], v["p2"], v["p3"], v["p"]])


def levers(v: Variant) -> Array:
    """The lever arms from each axis to the tool point, one a row (3, 3)."""
    return path(v)[4] - path(v)[1:4]


def whole(v: Variant, kinds: str = "", z: Function = axes, lever: Function = levers) -> Array:
    """The Jacobian (6, 3) with these types of joints, axes and lever arms, right by default."""
    return columns(z(v), lever(v), kinds or v["kinds"])


def turning_parts(v: Variant, z: Function = axes, lever: Function = levers) -> Array:
    """The linear parts (3, 2) of the revolute joints with these axes and lever arms."""
    return whole(v, z=z, lever=lever)[:3, revolute(v)]


def sliding_column(v: Variant, kinds: str = "", z: Function = axes) -> Array:
    """The column (6,) of the prismatic joint with these types of joints and axes."""
    return whole(v, kinds, z)[:, slides(v)]


def revolute(v: Variant) -> list[int]:
    """Places of the revolute joints, from 0."""
    return [i for i, kind in enumerate(v["kinds"]) if kind == "R"]


def slides(v: Variant) -> int:
    """Place of the prismatic joint, from 0."""
    return v["kinds"].index("P")


def drawn(v: Variant) -> Drawing:
    """The arm as it stands, with any x axes across the joint axes."""
    joints = zip(v["kinds"], map(along, axes(v), path(v)[1:4]), strict=True)
    words = ", ".join(WORDS[kind] for kind in v["kinds"])
    return Drawing(
        assembled([*joints, along(axes(v)[2], path(v)[4])]),
        (0.0, 0.0, 0.0),
        "The arm at this moment, with the base frame and the positive sense of each joint.",
        (
            f"Arm with three joints ({words}) on axes that are skew to the base axes, "
            "drawn as it stands at this moment."
        ),
        (Triad(np.eye(4), "0"),),
        view=(float(np.degrees(np.arctan2(v["p"][1], v["p"][0]))) - 80, 22.0),  # across the arm
    )
