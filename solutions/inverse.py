"""Joint values for a pose: J dq = du of S0, eq. 4.13, until it is met or nothing comes closer."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Integral, Real

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError, one_configuration, reals
from .descent import Outcome, Problem, Stop, descend
from .displacement import displacement
from .kinematics import forward
from .limits import are_outside
from .many_starts import descend_from_many
from .rotation import rotations
from .velocity import chosen_rows

__all__ = ["REASONS", "Solution", "Stop", "displacement", "inverse_kinematics"]

REASONS: dict[Stop, str] = {
    "converged": "the pose is met",
    "joint limits": "no motion within the limits comes closer",
    "local minimum": (
        "no small motion comes closer: the pose is out of reach, or lies behind a singular one"
    ),
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
        rotation_error: Length of the rotation vector that is missing in the chosen rows [rad].
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
        outcome = "Converged" if self.converged else "Not converged"
        joints = ""
        if self.held:
            joints = f" (joints at a limit: {', '.join(map(str, self.held))})"
        return (
            f"{outcome} after {self.iterations} iterations: {REASONS[self.stopped]}{joints}; "
            f"position error {self.position_error:.3g} m, "
            f"rotation error {self.rotation_error:.3g} rad."
        )


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
    starts: int = 1,
) -> Solution:
    """Joint values near `start` at which the tool has the pose `target`, or the closest reached.

    Every step solves J dq = du (S0, eq. 4.13) by damped least squares, with the position and the
    small rotation vector that are still missing as du (eq. 4.11). The damping is proportional to
    the error (Yamashita and Fukushima, 2001): steps stay bounded near singular configurations, and
    the last ones are Newton's. No step increases the error.

    Args:
        chain: An arm of n joints.
        target: The wanted tool transform (4, 4) in base coordinates.
        start: Joint values (n,) within the limits.
        limits: Pairs (n, 2) of lowest and highest joint values [rad, m], infinite ones included;
            none by default.
        rows: The rows of du that count, in base axes: slice(0, 3) asks for the position alone.
        position_tolerance: [m]; by default 1e-9 of the length of the arm.
        rotation_tolerance: [rad].
        longest_step: The most that a joint moves in one step [rad, lengths of the arm].
        iterations: The most steps that are tried from one place.
        starts: Places to start from, of which `start` is the first. With more than one, others are
            spread over the limits and go down together, and a joint that passes a limit goes on a
            full turn away where that is within: the result may be far from `start`. With 100,
            nearly every pose within reach is met.

    Raises:
        ChainError: An argument of the wrong form, or a start outside the limits. That no solution
            is found is no error: `Solution.stopped` says why.
    """
    q = one_configuration(chain.n, start, "start")
    low, high = _limits(limits, q)
    q = np.clip(q, low, high)
    wanted = pose_of(target)
    length = _length(chain, wanted, q, np.concatenate([low, high]))
    if position_tolerance is None:
        position_tolerance = 1e-9 * length

    _check_positive("position_tolerance", position_tolerance)
    _check_positive("rotation_tolerance", rotation_tolerance)
    _check_positive("longest_step", longest_step)
    if not isinstance(iterations, Integral) or iterations < 0:
        raise ChainError(f"iterations takes a whole number from 0, got {iterations!r}")

    if not isinstance(starts, Integral) or starts < 1:
        raise ChainError(f"starts takes a whole number from 1, got {starts!r}")

    problem = Problem(
        chain=chain,
        target=wanted,
        rows=chosen_rows(rows),
        low=low,
        high=high,
        length=length,
        position_tolerance=position_tolerance,
        rotation_tolerance=rotation_tolerance,
    )
    if starts == 1:
        outcome = descend(problem, q, longest_step, iterations)
    else:
        outcome = descend_from_many(problem, q, int(starts), longest_step, iterations)
    return _solution(problem, outcome)


def _solution(problem: Problem, outcome: Outcome) -> Solution:
    q, stopped, tried = outcome
    error = problem.error(q)
    held = list[int]()
    if stopped != "converged":
        slope = problem.jacobian(q).T @ error
        held = np.flatnonzero(problem.blocked(q, slope)).tolist()
    joints = tuple(i + 1 for i in held)
    q.flags.writeable = False
    return Solution(q, stopped, tried, *problem.sizes(error), joints)


def _limits(limits: ArrayLike | None, start: Array) -> tuple[Array, Array]:
    """Lowest and highest joint values (n,), infinite where none are given."""
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


def pose_of(target: ArrayLike) -> Array:
    """The pose (4, 4) that is wanted; ChainError says what is wrong with other input."""
    T = reals("target", target)
    if T.shape != (4, 4):
        raise ChainError(f"target takes one transform (4, 4), got shape {T.shape}")
    if (T[3] != (0.0, 0.0, 0.0, 1.0)).any():
        raise ChainError(f"target takes the last row [0 0 0 1], got {T[3].tolist()}")
    _ = rotations("target", T[:3, :3])
    return T


def _length(chain: Chain, target: Array, start: Array, limits: Array) -> float:
    """Length of the arm [m]: its links and the strokes of its slides; else the way to target."""
    links = np.linalg.norm(chain.fixed[1:, :3, 3], axis=-1).sum()
    slides = np.array([kind == "P" for kind in chain.kinds])
    values = np.abs(np.stack([start, *np.split(limits, 2)]))[:, slides]
    strokes = np.max(values, axis=0, where=np.isfinite(values), initial=0.0)
    length = float(links + strokes.sum())
    way = float(np.linalg.norm(target[:3, 3] - forward(chain, start)[:3, 3]))
    return length or way or 1.0


def _check_positive(name: str, value: float) -> None:
    if not isinstance(value, Real) or not 0 < value < math.inf:
        raise ChainError(f"{name} takes a finite number above 0, got {value!r}")
