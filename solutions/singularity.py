"""Where a Jacobian block loses rank.

Its singular values tell, and the zero set of each factor of its determinant.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import Chain
from .contours import Lines, Values, trace
from .errors import KinegradeError
from .expression import parse
from .jacobian import jacobian
from .kinematics import frames

if TYPE_CHECKING:
    from .robots import Factor, Robot

__all__ = [
    "RANK_TOLERANCE",
    "Parameters",
    "RegionalArm",
    "SingularityError",
    "Values",
    "arm",
    "factor_values",
    "manipulability",
    "rank",
    "sigma_min",
    "singular_values",
    "task_block",
    "trace",
    "zero_set",
]

RANK_TOLERANCE = 1e-9
WRIST = {"q4", "q5", "q6"}

Parameters = Mapping[str, float] | None
Ranges = Sequence[tuple[float, float]]


class SingularityError(KinegradeError):
    """A block, a factor or a plane of joints that does not exist."""


@dataclass(frozen=True, eq=False)
class RegionalArm:
    """The joints whose singularities are drawn.

    They are a whole short robot, or the three joints that carry a wrist centre.

    Attributes:
        chain: Those joints; its tool is the `point`.
        rows: Rows of the Jacobian that form the task block.
        limits: One pair per joint [rad or m].
        factors: The factors of the block's determinant.
        point: "tool" or "wrist centre".
    """

    chain: Chain
    rows: tuple[int, ...]
    limits: tuple[tuple[float, float], ...]
    factors: tuple["Factor", ...]
    point: str


def singular_values(block: ArrayLike) -> Values:
    """The singular values (..., k), largest first, of a block (..., m, n) with k = min(m, n).

    Raises:
        SingularityError: The block is no finite matrix or stack of matrices.
    """
    matrix = np.asarray(block, dtype=np.float64)
    if matrix.ndim < 2:
        raise SingularityError(
            f"A block takes finite numbers of shape (..., m, n), got shape {matrix.shape}."
        )
    if not np.isfinite(matrix).all():
        raise SingularityError("A block takes finite numbers, got NaN or infinity.")
    return np.linalg.svd(matrix, compute_uv=False).astype(np.float64, copy=False)


def sigma_min(block: ArrayLike) -> Values:
    """The smallest singular value (...) of a block (..., m, n).

    It is the gain of the hardest direction.

    Raises:
        SingularityError: The block is no finite matrix or stack of matrices.
    """
    return singular_values(block)[..., -1]


def rank(block: ArrayLike, tolerance: float = RANK_TOLERANCE) -> NDArray[np.intp]:
    """The rank (...) of a block (..., m, n): singular values above `tolerance` times the largest.

    Raises:
        SingularityError: The block is no finite matrix or stack of matrices.
    """
    values = singular_values(block)
    return np.count_nonzero(values > tolerance * values[..., :1], axis=-1)


def manipulability(block: ArrayLike) -> Values:
    """Yoshikawa's measure sqrt(det(J J^T)) (...), the product of the singular values.

    Raises:
        SingularityError: The block has more rows than columns, where the measure is zero
            everywhere, or is no finite matrix or stack of matrices.
    """
    values = singular_values(block)
    rows, columns = np.shape(block)[-2:]
    if rows > columns:
        raise SingularityError(
            "Manipulability takes a block with at most as many rows as columns, "
            f"got {rows} x {columns}: choose task rows."
        )
    return values.prod(axis=-1)


def arm(robot: "Robot", parameters: Parameters = None) -> RegionalArm:
    """The joints that carry the wrist centre, or the whole robot.

    There is a wrist centre if the last three of six axes meet in a point.
    """
    chain = robot.chain(parameters)
    centre = _wrist_centre(chain)
    if centre is None:
        return RegionalArm(chain, robot.task_rows, robot.limits, robot.factors, "tool")
    tool = chain.fixed[3].copy()
    tool[:3, 3] += centre * tool[:3, 2]
    carried = Chain(np.concatenate([chain.fixed[:3], tool[None]]), chain.kinds[:3])
    factors = list["Factor"]()
    for factor in robot.factors:
        joints = WRIST & parse(factor.expression, robot.names).names
        if not joints:
            factors.append(factor)
    return RegionalArm(carried, (0, 1, 2), robot.limits[:3], tuple(factors), "wrist centre")


def task_block(of: RegionalArm, q: ArrayLike) -> Values:
    """The task rows (..., m, n) of the Jacobian of an arm at q (..., n), base frame."""
    return jacobian(of.chain, q)[..., of.rows, :]


def factor_values(robot: "Robot", parameters: Parameters, q: ArrayLike) -> dict[str, Values]:
    """The value (...) of every factor of det J at q (..., n), by the factor's name.

    Raises:
        SingularityError: q is of another shape.
    """
    configurations = np.asarray(q, dtype=np.float64)
    if configurations.shape[-1:] != (robot.n,):
        raise SingularityError(
            f"q takes shape (..., {robot.n}) for {robot.name}, got {configurations.shape}."
        )
    joints = [configurations[..., i] for i in range(robot.n)]
    values = _named(robot, parameters, joints)
    shape = configurations.shape[:-1]
    return {f.name: _evaluate(robot, f, values, shape) for f in robot.factors}


def zero_set(
    robot: "Robot",
    factor: str,
    parameters: Parameters = None,
    *,
    free: tuple[int, int] = (1, 2),
    at: ArrayLike | None = None,
    ranges: Ranges | None = None,
    count: int = 361,
) -> Lines:
    """The curves, each (m, 2), on which a factor of det J vanishes in a plane of two joints.

    Every point is a root found along a grid line of the plane, to about 1e-12 of the range. Each
    factor is traced by itself: where two nearly coincide, their product does not change sign
    between grid lines.

    Args:
        robot: A robot with factors.
        factor: The name of one of them.
        parameters: Values that differ from the robot's defaults [m].
        free: Indices (from 0) of the two joints that span the plane.
        at: The configuration (n,) that holds the other joints; zero by default.
        ranges: The plane's two ranges [rad or m]; by default (-pi, pi), for a slide its limits.
        count: Grid lines per joint.

    Raises:
        SingularityError: No such factor, or no such plane.
    """
    named = {f.name: f for f in robot.factors}
    if factor not in named:
        raise SingularityError(
            f"{robot.name} takes one of the factors {sorted(named)}, got {factor!r}."
        )
    if len(set(free)) != 2 or not set(free) <= set(range(robot.n)):
        raise SingularityError(
            f"A plane takes two different joints of 0 to {robot.n - 1}, got {free}."
        )
    fixed = np.zeros(robot.n)
    if at is not None:
        fixed = np.asarray(at, dtype=np.float64)
    if not ranges:
        ranges = [_range(robot, joint) for joint in free]

    def field(x: Values, y: Values) -> Values:
        q: list[Values] = [np.float64(value) + 0 * x for value in fixed]
        q[free[0]], q[free[1]] = x, y
        return _evaluate(robot, named[factor], _named(robot, parameters, q), x.shape)

    return trace(field, ranges[0], ranges[1], count)


def _wrist_centre(chain: Chain) -> float | None:
    """Where axes 5 and 6 meet axis 4, measured along axis 4 [m].

    None if they do not meet in one point.
    """
    if chain.n != 6 or chain.kinds[3:] != "RRR":
        return None
    F = frames(chain, np.zeros(6))
    near = 1e-9 * float(np.abs(chain.fixed[:, :3, 3]).max())
    meetings: list[Values] = []
    for first, second in ((3, 4), (4, 5)):
        meeting = _meeting(F[first], F[second], near)
        if meeting is None:
            return None
        meetings.append(meeting)
    if np.abs(meetings[0] - meetings[1]).max() > near:
        return None
    return float((meetings[0] - F[3, :3, 3]) @ F[3, :3, 2])


def _meeting(first: Values, second: Values, near: float) -> Values | None:
    """The point (3,) where the z axes of two frames (4, 4) meet; None if parallel or apart."""
    z, w = first[:3, 2], second[:3, 2]
    gap = second[:3, 3] - first[:3, 3]
    normal = np.cross(z, w)
    if normal @ normal < 1e-12 or abs(gap @ normal) > near:
        return None
    return first[:3, 3] + z * (np.cross(gap, w) @ normal) / (normal @ normal)


def _range(robot: "Robot", joint: int) -> tuple[float, float]:
    """A full turn, or the limits of a slide."""
    if robot.kinds[joint] == "R":
        return (-np.pi, np.pi)
    return robot.limits[joint]


def _named(robot: "Robot", parameters: Parameters, q: Sequence[Values]) -> dict[str, ArrayLike]:
    joints = {f"q{i + 1}": value for i, value in enumerate(q)}
    return {**robot.parameters, **(parameters or {}), **joints}


def _evaluate(
    robot: "Robot", factor: "Factor", values: Mapping[str, ArrayLike], shape: tuple[int, ...]
) -> Values:
    found = parse(factor.expression, robot.names).at(values)
    return np.broadcast_to(np.asarray(found, dtype=np.float64), shape)
