"""Where a Jacobian block loses rank: its singular values, and the zero set of each factor of its determinant."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import Chain
from .errors import KinegradeError
from .expression import parse
from .jacobian import jacobian
from .kinematics import frames

if TYPE_CHECKING:
    from .robots import Factor, Robot

RANK_TOLERANCE = 1e-9

Values = NDArray[np.float64]
Parameters = Mapping[str, float] | None
Ranges = Sequence[tuple[float, float]]
Lines = tuple[Values, ...]
ScalarField = Callable[[Values, Values], Values]


class SingularityError(KinegradeError):
    """A block, a factor or a plane of joints that does not exist."""


@dataclass(frozen=True, eq=False)
class RegionalArm:
    """The joints whose singularities are drawn: a whole short robot, or the three that carry a wrist centre.

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
    if matrix.ndim < 2 or not np.isfinite(matrix).all():
        raise SingularityError(
            f"A block takes finite numbers of shape (..., m, n), got shape {matrix.shape}."
            if matrix.ndim < 2
            else "A block takes finite numbers, got NaN or infinity."
        )
    return np.linalg.svd(matrix, compute_uv=False).astype(np.float64, copy=False)


def sigma_min(block: ArrayLike) -> Values:
    """The smallest singular value (...) of a block (..., m, n): the gain of the hardest direction."""
    return singular_values(block)[..., -1]


def rank(block: ArrayLike, tolerance: float = RANK_TOLERANCE) -> NDArray[np.intp]:
    """The rank (...) of a block: singular values above `tolerance` times the largest one."""
    values = singular_values(block)
    return np.count_nonzero(values > tolerance * values[..., :1], axis=-1)


def manipulability(block: ArrayLike) -> Values:
    """Yoshikawa's measure sqrt(det(J J^T)) (...), the product of the singular values.

    Raises:
        SingularityError: The block has more rows than columns, where the measure is zero everywhere.
    """
    values = singular_values(block)
    rows, columns = np.shape(block)[-2:]
    if rows > columns:
        raise SingularityError(
            f"Manipulability takes a block with at most as many rows as columns, got {rows} x {columns}: "
            "choose task rows."
        )
    return values.prod(axis=-1)


def arm(robot: "Robot", parameters: Parameters = None) -> RegionalArm:
    """The joints that carry the wrist centre if the last three axes meet in a point, else the whole robot."""
    chain = robot.chain(parameters)
    centre = _wrist_centre(chain)
    if centre is None:
        return RegionalArm(chain, robot.task_rows, robot.limits, robot.factors, "tool")
    tool = chain.fixed[3].copy()
    tool[:3, 3] += centre * tool[:3, 2]
    carried = Chain(np.concatenate([chain.fixed[:3], tool[None]]), chain.kinds[:3])
    wrist = {"q4", "q5", "q6"}
    factors = tuple(f for f in robot.factors if not wrist & parse(f.expression, robot.names).names)
    return RegionalArm(carried, (0, 1, 2), robot.limits[:3], factors, "wrist centre")


def task_block(of: RegionalArm, q: ArrayLike) -> Values:
    """The task rows (..., m, n) of the Jacobian of an arm at q (..., n), base frame."""
    return jacobian(of.chain, q)[..., of.rows, :]


def factor_values(robot: "Robot", parameters: Parameters, q: ArrayLike) -> dict[str, Values]:
    """The value (...) of every factor of det J at q (..., n), by the factor's name."""
    configurations = np.asarray(q, dtype=np.float64)
    if configurations.shape[-1:] != (robot.n,):
        raise SingularityError(
            f"q takes shape (..., {robot.n}) for {robot.name}, got {configurations.shape}."
        )
    values = _named(robot, parameters, [configurations[..., i] for i in range(robot.n)])
    return {f.name: _evaluate(robot, f, values, configurations.shape[:-1]) for f in robot.factors}


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
    """The curves, each (m, 2), on which one named factor of det J vanishes in a plane of two joints.

    Every point is a root found along a grid line of the plane, to about 1e-12 of the range. Each factor is
    traced by itself: where two nearly coincide, their product does not change sign between grid lines.

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
    fixed = np.zeros(robot.n) if at is None else np.asarray(at, dtype=np.float64)

    def field(x: Values, y: Values) -> Values:
        q: list[Values] = [np.float64(value) + 0 * x for value in fixed]
        q[free[0]], q[free[1]] = x, y
        return _evaluate(robot, named[factor], _named(robot, parameters, q), x.shape)

    spans = ranges or [(-np.pi, np.pi) if robot.kinds[i] == "R" else robot.limits[i] for i in free]
    return trace(field, spans[0], spans[1], count)


def trace(
    field: ScalarField, across: tuple[float, float], up: tuple[float, float], count: int = 361
) -> Lines:
    """The zero curves, each (m, 2), of a scalar field that changes sign across them, inside a rectangle."""
    x, y = _grid_lines(*across, count), _grid_lines(*up, count)
    with np.errstate(divide="ignore", invalid="ignore"):
        values = field(*np.meshgrid(x, y, indexing="ij"))
        # A zero along a whole grid line is rounding noise of either sign; this shift makes it one sign.
        shift = 1e-13 * float(np.median(np.abs(values)))
        values = values + shift
        lines = _contours(values)
        if not lines:
            return ()
        points = _roots(lambda a, b: field(a, b) + shift, x, y, values, np.concatenate(lines))
    ends = np.cumsum([len(line) for line in lines])
    low, high = np.array([across[0], up[0]]), np.array([across[1], up[1]])
    traced = np.split(points, ends[:-1])
    return tuple(piece for line in traced for piece in _inside(line, low, high))


def _wrist_centre(chain: Chain) -> float | None:
    """Where axes 5 and 6 meet axis 4, measured along axis 4 [m]; None if they do not meet in one point."""
    if chain.n != 6 or chain.kinds[3:] != "RRR":
        return None
    F = frames(chain, np.zeros(6))
    near = 1e-9 * float(np.abs(chain.fixed[:, :3, 3]).max())
    meetings: list[Values] = []
    for first, second in ((3, 4), (4, 5)):
        z, w = F[first, :3, 2], F[second, :3, 2]
        gap = F[second, :3, 3] - F[first, :3, 3]
        normal = np.cross(z, w)
        if normal @ normal < 1e-12 or abs(gap @ normal) > near:
            return None
        meetings.append(F[first, :3, 3] + z * (np.cross(gap, w) @ normal) / (normal @ normal))
    if np.abs(meetings[0] - meetings[1]).max() > near:
        return None
    return float((meetings[0] - F[3, :3, 3]) @ F[3, :3, 2])


def _named(robot: "Robot", parameters: Parameters, q: Sequence[Values]) -> dict[str, ArrayLike]:
    joints = {f"q{i + 1}": value for i, value in enumerate(q)}
    return {**robot.parameters, **(parameters or {}), **joints}


def _evaluate(
    robot: "Robot", factor: "Factor", values: Mapping[str, ArrayLike], shape: tuple[int, ...]
) -> Values:
    found = parse(factor.expression, robot.names).at(values)
    return np.broadcast_to(np.asarray(found, dtype=np.float64), shape)


def _grid_lines(low: float, high: float, count: int) -> Values:
    # One line outside on each side: a zero on the rim itself (q2 = pi) is then crossed, not touched. The inner
    # lines avoid round numbers, where curves like to meet.
    step = (high - low) / (count - 1)
    inner = low + step * (np.arange(1, count) - 0.382)
    return np.concatenate([[low - 0.4 * step, low], inner, [high, high + 0.4 * step]])


def _contours(values: Values) -> list[Values]:
    """Lines (m, 2) between the nodes of either sign, in numbers of grid lines along x and y.

    Their points are on the edges between nodes, in the middle third. A closed line repeats its first.
    """
    from contourpy import LineType, contour_generator

    # The sign keeps points off the nodes; the value decides which corners of a saddle are joined.
    heights = np.where(values >= 0, 1.0, -1.0) + values / np.abs(values).max()
    contours = contour_generator(z=heights.T, line_type=LineType.Separate)
    return cast("list[Values]", contours.lines(0.0))


def _roots(field: ScalarField, x: Values, y: Values, values: Values, places: Values) -> Values:
    """The roots (m, 2) on the edges of the grid where `places` (m, 2) are; NaN for a pole."""
    first = np.floor(places + 1e-9).astype(int)  # an edge keeps to a grid line only to rounding
    last = np.ceil(places - 1e-9).astype(int)
    low, high = (np.column_stack([x[i], y[j]]) for i, j in (first.T, last.T))
    rising = values[tuple(last.T)] >= 0
    for _ in range(54):
        middle = (low + high) / 2
        above = ((field(*middle.T) >= 0) == rising)[:, None]
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    roots = (low + high) / 2
    size = np.abs(values)
    # A pole changes sign too (tan), but its "root" is huge.
    larger = np.maximum(size[tuple(first.T)], size[tuple(last.T)])
    true = np.abs(field(*roots.T)) <= larger
    return np.where(true[:, None], roots, np.nan)


def _inside(points: Values, low: Values, high: Values) -> list[Values]:
    """The pieces without NaN of a line in a rectangle, whose sides are grid lines and carry points."""
    slack = 1e-9 * (high - low)
    kept = ((points >= low - slack) & (points <= high + slack)).all(axis=1)
    cuts = np.flatnonzero(np.diff(kept)) + 1
    pieces = np.split(np.clip(points, low, high), cuts)
    return [
        piece
        for piece, keep in zip(pieces, np.split(kept, cuts), strict=True)
        if keep[0] and len(piece) > 1
    ]
