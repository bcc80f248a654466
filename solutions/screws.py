"""Chains from screws, the product of exponentials, and screws from chains."""

import numpy as np
from numpy.typing import ArrayLike

from .axes import PlacedJoint, along, assembled
from .chain import Array, Chain, ChainError, reals
from .jacobian import jacobian
from .kinematics import forward

UNIT = 1e-9


def from_screws(screws: ArrayLike, home: ArrayLike, kinds: str | None = None) -> Chain:
    """Chain T(q) = exp([S1] q1) ... exp([Sn] qn) home (Lynch and Park, eq. 4.14).

    `screws` (n, 6) are the joints' twists in base coordinates at q = 0, linear above angular, [v; w]: a revolute
    joint through the point p has |w| = 1 and v = p x w, a prismatic one w = 0 and |v| = 1. `home` (4, 4) is the tool
    at q = 0. `kinds` may be left out; given, it is checked. Raises ChainError.
    """
    rows = reals("screws", screws)
    if rows.ndim != 2 or rows.shape[0] == 0 or rows.shape[1] != 6:
        raise ChainError(f"screws takes shape (n, 6), got {rows.shape}")
    found = "".join("P" if np.linalg.norm(row[3:]) < UNIT else "R" for row in rows)
    if kinds is not None and kinds != found:
        raise ChainError(
            f"kinds takes {found!r}, as w = 0 in a prismatic screw only, got {kinds!r}"
        )
    tool = reals("home", home)
    if tool.shape != (4, 4):
        raise ChainError(f"home takes shape (4, 4), got {tool.shape}")
    joints = list[PlacedJoint]()
    point, rotation = np.zeros(3), np.eye(3)
    for i, row in enumerate(rows):
        frame = _axis(i, row, point, rotation)
        point, rotation = frame[:3, 3], frame[:3, :3]
        joints.append((found[i], frame))
    return assembled([*joints, tool])


def screws(chain: Chain) -> tuple[Array, Array]:
    """Screws (n, 6) [v; w] in base coordinates, and the tool (4, 4), both at q = 0."""
    zero = np.zeros(chain.n)
    home = forward(chain, zero)
    twists = jacobian(chain, zero).T.copy()
    twists[:, :3] += np.cross(
        home[:3, 3], twists[:, 3:]
    )  # from the tool's velocity to that of the base origin
    return twists, home


def _axis(i: int, screw: Array, near: Array, rotation: Array) -> Array:
    """Frame on the axis of a screw, at its point nearest to the axis before, turned as little as may be."""
    v, w = screw[:3], screw[3:]
    prismatic = np.linalg.norm(w) < UNIT
    size = float(np.linalg.norm(v if prismatic else w))
    if abs(size - 1) > UNIT:
        what = (
            "v of length 1 where w = 0"
            if prismatic
            else "w of length 1, or w = 0 for a prismatic joint"
        )
        raise ChainError(f"screw {i + 1} takes {what}, got length {size:.6g}")
    if prismatic:
        return along(v / size, near, rotation)
    z = w / size
    if abs(float(v @ z)) > UNIT * max(1.0, float(np.linalg.norm(v))):
        raise ChainError(
            f"screw {i + 1} takes v normal to w, as the joint has no pitch, got pitch {float(v @ z):.6g}"
        )
    foot = np.cross(z, v)
    return along(z, foot + z * (z @ (near - foot)), rotation)
