"""The plane that a planar arm never leaves, and from where it is seen flat."""

from math import asin, atan2, degrees

import numpy as np

from ...solutions.chain import Chain
from ...solutions.kinematics import frames
from .vectors import Array, norm

PARALLEL = 1e-6
USUAL = (-55.0, 22.0)  # azimuth and elevation of an arm in space, in degrees
FROM_ABOVE = (-90.0, 90.0)


def normal(chain: Chain, q: Array) -> Array | None:
    """The unit vector (3,) square to the plane of an arm, along its first revolute axis.

    All revolute axes run along it, all slides square to it, and base, joints and tool lie in one
    plane; None of any other arm.
    """
    poses = frames(chain, q)
    axes = poses[:-1, :3, 2]
    turning = np.array([kind == "R" for kind in chain.kinds])
    if not turning.any():
        return None
    along = axes[turning][0]
    if np.abs(np.cross(axes[turning], along)).max() > PARALLEL:
        return None
    heights = poses[:, :3, 3] @ along
    size = max(norm(position) for position in poses[:, :3, 3])
    if np.abs(heights).max() > PARALLEL * size:
        return None
    if np.abs(axes[~turning] @ along).max(initial=0.0) > PARALLEL:
        return None
    return along


def view_of(chain: Chain, q: Array) -> tuple[float, float]:
    """Azimuth and elevation, in degrees, from which an arm at `q` (n,) is seen best.

    A planar arm is seen along its axes, one that lies flat from above; any other from the front.
    """
    along = normal(chain, q)
    if along is None:
        return USUAL
    x, y, z = along.tolist()
    if abs(z) > 1 - PARALLEL:
        return FROM_ABOVE
    azimuth, elevation = degrees(atan2(y, x)), degrees(asin(z))
    if abs((azimuth - USUAL[0] + 180) % 360 - 180) > 90:  # seen from the other side
        azimuth, elevation = azimuth + 180, -elevation
    return azimuth, elevation
