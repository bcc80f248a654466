"""Joint values for a pose: J dq = du of S0, eq. 4.13, repeated until the pose is met or nothing comes closer."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Integral, Real
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .chain import Array, Chain, ChainError, one_configuration, reals
from .derivatives import hessian
from .jacobian import jacobian
from .kinematics import forward
from .limits import are_outside
from .rotation import rotation_vector, rotations
from .velocity import chosen_rows, damped_inverse

STATIONARY = (
    1e-7  # slope of the error, per unit of it: below, what a step gains is lost in rounding
)
WORTH = 1e-4  # share of the predicted gain that a step has to bring
STIFFEST = 1e8  # weight of the damping at which even a tiny step brings nothing

Stop = Literal["converged", "joint limits", "local minimum", "rounding", "iterations"]
REASONS: dict[Stop, str] = {
    "converged": "the pose is met",
    "joint limits": "no motion within the limits comes closer",
    "local minimum": "no small motion comes closer: the pose is out of reach, or lies behind a singular one",
    "rounding": "the tolerances are finer than the arithmetic",
    "iterations": "it was still coming closer when the iterations ran out",
}


@dataclass(frozen=True, eq=False)
class Solution:
    """The best joint values that were found, and an honest account of them.

    Attributes:
        q: Joint values (n,) [rad, m], within the limits.
        stopped: "converged", or why it went no further: a key of `REASONS`.
        iterations: Steps that were tried.
        position_error: Distance to the wanted position in the chosen rows [m].
        rotation_error: Length of the rotation vector to the wanted rotation in the chosen rows [rad].
        held: Joints, counted from 1, that stand at a limit and would have to pass it.
    """

    q: Array
    stopped: Stop
    iterations: int
    position_error: float
    rotation_error: float
    held: tuple[int, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether both errors are within their tolerances."""
        return self.stopped == "converged"

    def __str__(self) -> str:
        """A sentence for people."""
        joints = f" (joints at a limit: {', '.join(map(str, self.held))})" if self.held else ""
        return (
            f"{'Converged' if self.converged else 'Not converged'} after {self.iterations} iterations: "
            f"{REASONS[self.stopped]}{joints}; position error {self.position_error:.3g} m, "
            f"rotation error {self.rotation_error:.3g} rad."
        )


@dataclass(frozen=True, eq=False)
class _Problem:
    """Lengths are divided by `length`, so that metres and radians weigh alike and no unit decides."""

    chain: Chain
    target: Array
    rows: NDArray[np.int_]
    low: Array
    high: Array
    length: float
    tolerances: tuple[float, float]

    def error(self, q: Array) -> Array:
        du = displacement(forward(self.chain, q), self.target)
        du[:3] /= self.length
        return du[self.rows]

    def jacobian(self, q: Array) -> Array:
        J = jacobian(self.chain, q) * self.units
        J[:3] /= self.length
        return J[self.rows]

    def curvature(self, q: Array, J: Array, error: Array) -> Array:
        """Second derivatives (n, n) of half the squared error, to first order in the angle of its rotation."""
        H = hessian(self.chain, q) * self.units[:, None] * self.units
        H[:3] /= self.length
        bend = np.tensordot(error, H[self.rows], 1)
        return J.T @ J - (bend + bend.T) / 2

    def sizes(self, error: Array) -> tuple[float, float]:
        """Errors in position [m] and rotation [rad]."""
        linear = self.rows < 3
        return float(np.linalg.norm(error[linear])) * self.length, float(
            np.linalg.norm(error[~linear])
        )

    def is_met(self, error: Array) -> bool:
        return all(
            size <= limit for size, limit in zip(self.sizes(error), self.tolerances, strict=True)
        )

    def blocked(self, q: Array, slope: Array) -> NDArray[np.bool_]:
        """Joints at a limit that would have to pass it to come closer."""
        return ((q <= self.low) & (slope < 0)) | ((q >= self.high) & (slope > 0))

    @cached_property
    def units(self) -> Array:
        return np.array([1.0 if kind == "R" else self.length for kind in self.chain.kinds])


def inverse_kinematics(
    chain: Chain,
    target: ArrayLike,
    start: ArrayLike,
    *,
    limits: ArrayLike | None = None,
    rows: slice | Sequence[int] = slice(None),
    position_tolerance: float | None = None,
    rotation_tolerance: float = 1e-9,
    longest_step: float = 0.3,
    iterations: int = 200,
) -> Solution:
    """Joint values near `start` at which the tool has the pose `target` (4, 4), or the closest that was reached.

    Every step solves J dq = du (S0, eq. 4.13) by damped least squares, with the position and the small rotation vector
    that are still missing as du (eq. 4.11). The damping is proportional to the error (Yamashita and Fukushima, 2001):
    steps stay bounded near singular configurations, and the last ones are Newton's. No step increases the error.

    Args:
        chain: An arm of n joints.
        target: The wanted tool transform in base coordinates.
        start: Joint values (n,) within the limits.
        limits: Pairs (n, 2) of lowest and highest joint values [rad, m], infinite ones included; none by default.
        rows: The rows of du that count, in base axes: slice(0, 3) asks for the position alone.
        position_tolerance: [m]; by default 1e-9 of the length of the arm.
        rotation_tolerance: [rad].
        longest_step: The most that a joint moves in one step [rad, lengths of the arm].
        iterations: The most steps that are tried.

    Raises:
        ChainError: An argument of the wrong form, or a start outside the limits. That no solution is found is no
            error: `Solution.stopped` says why.
    """
    q = one_configuration(chain.n, start, "start")
    low, high = _limits(limits, q)
    q = np.clip(q, low, high)
    wanted = _pose(target)
    length = _length(chain, wanted, q, np.concatenate([low, high]))
    tolerance = 1e-9 * length if position_tolerance is None else position_tolerance
    numbers = {
        "position_tolerance": tolerance,
        "rotation_tolerance": rotation_tolerance,
        "longest_step": longest_step,
    }
    for name, value in numbers.items():
        if not isinstance(value, Real) or not 0 < value < math.inf:
            raise ChainError(f"{name} takes a finite number above 0, got {value!r}")
    if not isinstance(iterations, Integral) or iterations < 0:
        raise ChainError(f"iterations takes a whole number from 0, got {iterations!r}")
    problem = _Problem(
        chain, wanted, chosen_rows(rows), low, high, length, (tolerance, rotation_tolerance)
    )
    return _descend(problem, q, longest_step, iterations)


def displacement(reached: ArrayLike, desired: ArrayLike) -> Array:
    """Displacements du (..., 6) from reached to desired transforms (..., 4, 4): dp [m] above rotation vectors dw [rad].

    Both are in base axes, with R_desired = R(dw) R_reached (S0, eq. 4.11 and 4.13). Raises ChainError.
    """
    a, b = reals("reached", reached), reals("desired", desired)
    for name, T in (("reached", a), ("desired", b)):
        if T.shape[-2:] != (4, 4):
            raise ChainError(f"{name} takes shape (..., 4, 4), got {T.shape}")
    try:
        np.broadcast_shapes(a.shape, b.shape)
    except ValueError:
        raise ChainError(
            f"desired takes a batch that fits {a.shape[:-2]}, got {b.shape[:-2]}"
        ) from None
    dw = rotation_vector(b[..., :3, :3] @ a[..., :3, :3].mT)
    dp = np.broadcast_to(b[..., :3, 3] - a[..., :3, 3], dw.shape)
    return np.concatenate([dp, dw], axis=-1)


def _descend(problem: _Problem, q: Array, longest: float, iterations: int) -> Solution:
    error, weight = problem.error(q), 0.1
    for tried in range(iterations + 1):
        if problem.is_met(error):
            return _solution(problem, q, "converged", tried)
        if weight > STIFFEST:
            return _solution(problem, q, "rounding", tried)
        J, size = problem.jacobian(q), float(np.linalg.norm(error))
        slope = J.T @ error
        free = ~problem.blocked(q, slope)
        if np.linalg.norm(slope[free]) <= STATIONARY * size:
            beyond = _past_the_saddle(problem, q, J, error, np.where(free, longest, 0.0))
            if beyond is None:
                return _solution(
                    problem, q, "local minimum" if free.all() else "joint limits", tried
                )
            if tried == iterations:
                break
            q, error = beyond
            continue
        if tried == iterations:
            break
        step = _step(problem, q, J, error, free, math.sqrt(weight) * size, longest)
        trial = np.clip(q + step * problem.units, problem.low, problem.high)
        missing = problem.error(trial)
        predicted = size**2 - float(np.sum((error - J @ step) ** 2))
        gain = (size**2 - float(missing @ missing)) / predicted if predicted > 0 else 0.0
        weight = max(weight / 4, 1e-8) if gain > 0.75 else weight * 4 if gain < 0.25 else weight
        if gain > WORTH:
            q, error = trial, missing
    return _solution(problem, q, "iterations", iterations)


def _step(
    problem: _Problem,
    q: Array,
    J: Array,
    error: Array,
    free: NDArray[np.bool_],
    damping: float,
    longest: float,
) -> Array:
    """Damped step; joints that it would carry past a limit stop there, and the others make up for them."""
    lowest, highest = (problem.low - q) / problem.units, (problem.high - q) / problem.units
    step, left = np.zeros(problem.chain.n), free.copy()
    whole = damped_inverse(J[:, left], damping) @ error
    wanted = error * min(1.0, longest / max(float(np.abs(whole).max()), longest))
    while left.any():
        step[left] = damped_inverse(J[:, left], damping) @ (wanted - J[:, ~left] @ step[~left])
        past = left & ((step < lowest) | (step > highest))
        step = np.clip(step, lowest, highest)
        left &= ~past
        if not past.any():
            break
    return np.clip(step, -longest, longest)


def _past_the_saddle(
    problem: _Problem, q: Array, J: Array, error: Array, longest: Array
) -> tuple[Array, Array] | None:
    """A way on where the error has no slope but bends down, as for an arm stretched away from its goal."""
    reach = np.diag(longest)
    curvatures, directions = np.linalg.eigh(reach @ problem.curvature(q, J, error) @ reach)
    if curvatures[0] >= 0:
        return None
    for share in (1.0, -1.0, 0.1, -0.1, 0.01, -0.01):
        trial = np.clip(
            q + share * (reach @ directions[:, 0]) * problem.units, problem.low, problem.high
        )
        missing = problem.error(trial)
        if missing @ missing < (1 - 1e-9) * (error @ error):
            return trial, missing
    return None


def _solution(problem: _Problem, q: Array, stopped: Stop, tried: int) -> Solution:
    error = problem.error(q)
    held = (
        problem.blocked(q, problem.jacobian(q).T @ error)
        if stopped != "converged"
        else np.zeros(len(q), dtype=bool)
    )
    joints = tuple(int(i) + 1 for i in np.flatnonzero(held))
    q.flags.writeable = False
    return Solution(q, stopped, tried, *problem.sizes(error), joints)


def _limits(limits: ArrayLike | None, start: Array) -> tuple[Array, Array]:
    if limits is None:
        return np.full(start.shape, -np.inf), np.full(start.shape, np.inf)
    try:
        pairs = np.asarray(limits, dtype=np.float64)
    except (TypeError, ValueError):
        raise ChainError(f"limits takes pairs of numbers, got {limits!r}") from None
    if pairs.shape != (len(start), 2) or not (pairs[:, 0] <= pairs[:, 1]).all():
        raise ChainError(
            f"limits takes {len(start)} pairs of a lowest and a highest value, got {pairs.tolist()}"
        )
    low, high = pairs.T
    beyond = np.flatnonzero(are_outside(pairs, start))
    if beyond.size:
        i = int(beyond[0])
        raise ChainError(f"start takes q{i + 1} from {low[i]:g} to {high[i]:g}, got {start[i]:g}")
    return low, high


def _pose(target: ArrayLike) -> Array:
    T = reals("target", target)
    if T.shape != (4, 4):
        raise ChainError(f"target takes one transform (4, 4), got shape {T.shape}")
    if (T[3] != (0.0, 0.0, 0.0, 1.0)).any():
        raise ChainError(f"target takes the last row [0 0 0 1], got {T[3].tolist()}")
    _ = rotations("target", T[:3, :3])
    return T


def _length(chain: Chain, target: Array, start: Array, limits: Array) -> float:
    """Length of the arm: its links and the strokes of its slides; if it has none, the way to the target."""
    slides = np.array([kind == "P" for kind in chain.kinds])
    strokes = np.abs(np.stack([start, *np.split(limits, 2)]))[:, slides]
    links = np.linalg.norm(chain.fixed[1:, :3, 3], axis=-1).sum()
    length = float(links + np.max(strokes, axis=0, where=np.isfinite(strokes), initial=0.0).sum())
    way = float(np.linalg.norm(target[:3, 3] - forward(chain, start)[:3, 3]))
    return length or way or 1.0
