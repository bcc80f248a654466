"""Where a Jacobian block loses rank: its singular values, and the zero set of each factor of its determinant."""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

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
        points, horizontal, vertical = _crossings(lambda a, b: field(a, b) + shift, x, y, values)
    lines = _join(_links(values, horizontal, vertical), len(points))
    low, high = np.array([across[0], up[0]]), np.array([across[1], up[1]])
    return tuple(piece for line in lines for piece in _inside(points[line], low, high))


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


def _bisect(field: Callable[[Values], Values], low: Values, high: Values) -> Values:
    rising = field(high) >= 0
    for _ in range(54):
        middle = (low + high) / 2
        above = (field(middle) >= 0) == rising
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return (low + high) / 2


def _crossings(
    field: ScalarField, x: Values, y: Values, values: Values
) -> tuple[Values, NDArray[np.intp], NDArray[np.intp]]:
    """Roots (k, 2) on the edges of the grid, and for every edge along x and along y its root or -1."""
    positive, size = values >= 0, np.abs(values)
    tables = (np.full((len(x) - 1, len(y)), -1), np.full((len(x), len(y) - 1), -1))
    i, j = np.nonzero(positive[1:] != positive[:-1])
    along_x = np.column_stack([_bisect(lambda a: field(a, y[j]), x[i], x[i + 1]), y[j]])
    m, n = np.nonzero(positive[:, 1:] != positive[:, :-1])
    along_y = np.column_stack([x[m], _bisect(lambda b: field(x[m], b), y[n], y[n + 1])])
    points = np.concatenate([along_x, along_y])
    ends = np.concatenate(
        [np.maximum(size[i, j], size[i + 1, j]), np.maximum(size[m, n], size[m, n + 1])]
    )
    # A pole changes sign too (tan), but its "root" is huge.
    true = np.abs(field(points[:, 0], points[:, 1])) <= ends
    numbers = np.where(true, np.arange(len(points)), -1)
    tables[0][i, j], tables[1][m, n] = numbers[: len(i)], numbers[len(i) :]
    return points, *tables


def _links(
    values: Values, horizontal: NDArray[np.intp], vertical: NDArray[np.intp]
) -> list[tuple[int, int]]:
    """Pairs of roots that a curve joins inside one cell of the grid."""
    edges = np.stack([horizontal[:, :-1], vertical[1:], horizontal[:, 1:], vertical[:-1]], axis=-1)
    pairs: list[tuple[int, int]] = []
    for i, j in np.argwhere((edges >= 0).sum(axis=-1) >= 2):
        south, east, north, west = (int(edge) for edge in edges[i, j])
        found = [edge for edge in (south, east, north, west) if edge >= 0]
        if len(found) == 2:
            pairs.append((found[0], found[1]))
        elif len(found) == 4:
            a, b, c, d = values[i, j], values[i + 1, j], values[i + 1, j + 1], values[i, j + 1]
            saddle = (a * c - b * d) / (a + c - b - d)
            if abs(saddle) < 0.05 * max(abs(a), abs(b), abs(c), abs(d)):
                pairs += [(south, north), (east, west)]
            elif (saddle > 0) == (a > 0):
                pairs += [(south, east), (north, west)]
            else:
                pairs += [(south, west), (north, east)]
    return pairs


def _join(pairs: Sequence[tuple[int, int]], count: int) -> list[list[int]]:
    """Links joined to lines of roots; a closed line repeats its first root."""
    near: defaultdict[int, list[int]] = defaultdict(list)
    for a, b in pairs:
        near[a].append(b)
        near[b].append(a)
    lines: list[list[int]] = []
    ends = [a for a in range(count) if len(near[a]) == 1]
    for start in ends + list(near):  # open lines first, then what is left is closed
        line = [start]
        while near[line[-1]]:
            following = near[line[-1]].pop()
            near[following].remove(line[-1])
            line.append(following)
        if len(line) > 1:
            lines.append(line)
    return lines


def _inside(points: Values, low: Values, high: Values) -> list[Values]:
    """The pieces of a line inside a rectangle, whose sides are grid lines and so carry points of it."""
    slack = 1e-9 * (high - low)
    kept = ((points >= low - slack) & (points <= high + slack)).all(axis=1)
    cuts = np.flatnonzero(np.diff(kept)) + 1
    pieces = np.split(np.clip(points, low, high), cuts)
    return [
        piece
        for piece, keep in zip(pieces, np.split(kept, cuts), strict=True)
        if keep[0] and len(piece) > 1
    ]
