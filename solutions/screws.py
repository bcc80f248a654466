"""Chains from screws, the product of exponentials, and screws from chains."""

import numpy as np
from numpy.typing import ArrayLike

from .axes import PlacedJoint, along, assembled
from .chain import Array, Chain, ChainError, reals
from .jacobian import jacobian
from .kinematics import forward

UNIT = 1e-9  # how far a length may be from 1, and how short a vector counts as 0


def from_screws(screws: ArrayLike, home: ArrayLike, kinds: str | None = None) -> Chain:
    """Chain T(q) = exp([S1] q1) ... exp([Sn] qn) home (Lynch and Park, eq. 4.14).

    `screws` (n, 6) are the joints' twists in base coordinates at q = 0, linear above angular,
    [v; w]: a revolute joint through the point p has |w| = 1 and v = p x w, a prismatic one w = 0
    and |v| = 1. `home` (4, 4) is the tool at q = 0. `kinds` may be left out; given, it is checked.
    Raises ChainError.
    """
    rows = reals("screws", screws)
    if rows.ndim != 2 or rows.shape[0] == 0 or rows.shape[1] != 6:
        raise ChainError(f"screws takes shape (n, 6), got {rows.shape}")

    found = "".join(_kind(row) for row in rows)
    if kinds is not None and kinds != found:
        raise ChainError(
            f"kinds takes {found!r}, as w = 0 in a prismatic screw only, got {kinds!r}"
        )

    tool = reals("home", home)
    if tool.shape != (4, 4):
        raise ChainError(f"home takes shape (4, 4), got {tool.shape}")

    moves = list[Array | PlacedJoint]()
    frame = np.eye(4)
    for i, (kind, row) in enumerate(zip(found, rows, strict=True), 1):
        frame = _axis_frame(f"screw {i}", kind, row, frame)
        moves.append((kind, frame))
    moves.append(tool)
    return assembled(moves)


def screws(chain: Chain) -> tuple[Array, Array]:
    """Screws (n, 6) [v; w] in base coordinates, and the tool (4, 4), both at q = 0."""
    zero = np.zeros(chain.n)
    home = forward(chain, zero)
    twists = jacobian(chain, zero).T.copy()
    # from the tool's velocity to that of the base origin
    twists[:, :3] += np.cross(home[:3, 3], twists[:, 3:])
    return twists, home


def _kind(screw: Array) -> str:
    if np.linalg.norm(screw[3:]) < UNIT:
        return "P"
    return "R"


def _axis_frame(name: str, kind: str, screw: Array, before: Array) -> Array:
    """Frame (4, 4) on the axis of a screw, near the frame (4, 4) of the axis before it.

    Its origin is the nearest point of the axis, and it is turned as little as may be.
    """
    v, w = screw[:3], screw[3:]
    rotation, near = before[:3, :3], before[:3, 3]
    if kind == "P":
        length = _unit_length(name, v, "v of length 1 where w = 0")
        return along(v / length, near, rotation)

    length = _unit_length(name, w, "w of length 1, or w = 0 for a prismatic joint")
    z = w / length
    pitch = float(v @ z)
    if abs(pitch) > UNIT * max(1.0, float(np.linalg.norm(v))):
        raise ChainError(
            f"{name} takes v normal to w, as the joint has no pitch, got pitch {pitch:.6g}"
        )

    foot = np.cross(z, v)  # the point of the axis nearest to the base origin
    return along(z, foot + z * (z @ (near - foot)), rotation)


def _unit_length(name: str, vector: Array, expected: str) -> float:
    """Length of a vector that is to have length 1."""
    length = float(np.linalg.norm(vector))
    if abs(length - 1) > UNIT:
        raise ChainError(f"{name} takes {expected}, got length {length:.6g}")
    return length
