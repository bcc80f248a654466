"""Postures that bring the tool to wanted points of a section, within the joint limits."""

import numpy as np
from numpy.typing import ArrayLike

from ..chain import Chain
from ..jacobian import jacobian
from ..kinematics import forward
from ..singularity import RegionalArm, Values

STEPS = 14
LONGEST = 0.1  # of a joint's range, in one step


def approached(
    part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str], q: Values, wanted: Values
) -> tuple[Values, Values]:
    """Joint values (m, k) of the free joints that start at `q`, and what is missing to the points.

    Damped Gauss-Newton steps; a joint at its limit that would leave it is held there for the step.
    The joints that are not free stand at zero. What is missing is of shape (m, 2) [m].
    """
    low, high = inner_limits(part, free)
    ranges = high - low
    q = np.clip(q, low, high)
    for _ in range(STEPS):
        gap, gain = _gap(part, free, axes, q, wanted)
        gain *= ranges  # steps are shares of the joints' ranges, whatever their units
        step = _solved(gain, gap)
        stuck = ((q <= low) & (step < 0)) | ((q >= high) & (step > 0))
        without_stuck = _solved(np.where(stuck[:, None], 0.0, gain), gap)
        step = np.where(stuck.any(axis=1, keepdims=True), without_stuck, step)
        q = np.clip(q + np.clip(step, -LONGEST, LONGEST) * ranges, low, high)
    gap, _ = _gap(part, free, axes, q, wanted)
    return q, gap


def inner_limits(part: RegionalArm, free: tuple[int, ...]) -> tuple[Values, Values]:
    """Limits (k,) of the free joints, a hair inside: on axis 1 itself r has no derivative."""
    low, high = np.transpose([part.limits[i] for i in free])
    margin = 1e-6 * (high - low)
    return low + margin, high - margin


def in_axis_frame(chain: Chain, q: ArrayLike) -> Values:
    """The tool (..., 3) [m] in the frame of axis 1, slid along it until level with the base."""
    origin, rotation = chain.fixed[0][:3, 3], chain.fixed[0][:3, :3]
    foot = origin - rotation[:, 2] * (rotation[:, 2] @ origin)
    return (forward(chain, q)[..., :3, 3] - foot) @ rotation


def projected(p: Values, axes: tuple[str, str]) -> Values:
    """Coordinates (..., 2) in the section of points (..., 3) in the frame of axis 1."""
    if axes == ("x", "y"):
        return p[..., :2]
    return np.stack([np.hypot(p[..., 0], p[..., 1]), p[..., 2]], axis=-1)


def configurations(n: int, free: tuple[int, ...], values: Values) -> Values:
    """Configurations (..., n) with these values (..., k) of the free joints, the others at zero."""
    q = np.zeros((*values.shape[:-1], n))
    q[..., free] = values
    return q


def _gap(
    part: RegionalArm, free: tuple[int, ...], axes: tuple[str, str], q: Values, wanted: Values
) -> tuple[Values, Values]:
    """What is missing (m, 2) to the wanted points, and the points' derivative (m, 2, k) by q."""
    full = configurations(part.chain.n, free, q)
    p = in_axis_frame(part.chain, full)
    at = projected(p, axes)
    to_axis_frame = part.chain.fixed[0][:3, :3].T
    velocity = to_axis_frame @ jacobian(part.chain, full)[:, :3][:, :, list(free)]
    if axes == ("x", "y"):
        return wanted - at, velocity[:, :2]

    # r = hypot(x, y), so that r dr = x dx + y dy
    r = np.maximum(at[:, :1], 1e-12)
    outward = (p[:, :2, None] * velocity[:, :2]).sum(axis=1) / r
    return wanted - at, np.stack([outward, velocity[:, 2]], axis=1)


def _solved(gain: Values, gap: Values) -> Values:
    """Damped least squares, which a singular gain does not upset."""
    transposed = np.swapaxes(gain, 1, 2)
    square = transposed @ gain
    size = np.trace(square, axis1=1, axis2=2) + np.finfo(np.float64).tiny
    square += 1e-9 * size[:, None, None] * np.eye(gain.shape[-1])
    pulled = transposed @ gap[..., None]
    return np.asarray(np.linalg.solve(square, pulled)[..., 0], dtype=np.float64)
