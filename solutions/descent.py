"""The descent to a pose: damped steps, held at the limits, and a way past saddles."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .chain import Array, Chain
from .derivatives import hessian
from .displacement import displacement
from .jacobian import jacobian
from .kinematics import forward
from .velocity import damped_inverse

# slope of the error, per unit of it: below, what a step gains is lost in rounding
STATIONARY = 1e-7
WORTH = 1e-4  # share of the predicted gain that a step has to bring
FIRST_WEIGHT = 0.1  # of the damping
LIGHTEST = 1e-8  # weight below which the damping is not felt
STIFFEST = 1e8  # weight of the damping at which even a tiny step brings nothing
SHARES = (1.0, -1.0, 0.1, -0.1, 0.01, -0.01)  # of the longest step, tried to leave a saddle

Stop = Literal["converged", "joint limits", "local minimum", "rounding", "iterations"]


class Outcome(NamedTuple):
    """Joint values (n,), why the descent went no further, and how many steps were tried."""

    q: Array
    stopped: Stop
    tried: int


@dataclass(frozen=True, eq=False)
class Problem:
    """A pose to reach between limits, in lengths of the arm.

    Lengths are divided by `length`, so that metres and radians weigh alike and no unit decides.

    Attributes:
        chain: The arm of n joints.
        target: Wanted tool transform (4, 4).
        rows: The rows of a displacement that count.
        low: Lowest joint values (n,) [rad, m].
        high: Highest joint values (n,) [rad, m].
        length: Length of the arm [m].
        position_tolerance: [m].
        rotation_tolerance: [rad].
    """

    chain: Chain
    target: Array
    rows: NDArray[np.int_]
    low: Array
    high: Array
    length: float
    position_tolerance: float
    rotation_tolerance: float

    def error(self, q: Array) -> Array:
        """Displacement (m,) from the pose at q to the target, in the rows that count."""
        du = displacement(forward(self.chain, q), self.target)
        du[:3] /= self.length
        return du[self.rows]

    def jacobian(self, q: Array) -> Array:
        """Jacobian (m, n) of those rows."""
        J = jacobian(self.chain, q) * self.units
        J[:3] /= self.length
        return J[self.rows]

    def curvature(self, q: Array, J: Array, error: Array) -> Array:
        """Second derivatives (n, n) of half the squared error.

        They are right to first order in the angle of its rotation.
        """
        H = hessian(self.chain, q) * self.units[:, None] * self.units
        H[:3] /= self.length
        bend = np.tensordot(error, H[self.rows], 1)
        return J.T @ J - (bend + bend.T) / 2

    def sizes(self, error: Array) -> tuple[float, float]:
        """Errors in position [m] and rotation [rad]."""
        linear = self.rows < 3
        position = float(np.linalg.norm(error[linear])) * self.length
        rotation = float(np.linalg.norm(error[~linear]))
        return position, rotation

    def is_met(self, error: Array) -> bool:
        """Whether both errors are within their tolerances."""
        position, rotation = self.sizes(error)
        return position <= self.position_tolerance and rotation <= self.rotation_tolerance

    def blocked(self, q: Array, slope: Array) -> NDArray[np.bool_]:
        """Joints at a limit that would have to pass it to come closer."""
        return ((q <= self.low) & (slope < 0)) | ((q >= self.high) & (slope > 0))

    def moved(self, q: Array, step: Array) -> Array:
        """Joint values after a step in radians and lengths of the arm, stopped at the limits."""
        return np.clip(q + step * self.units, self.low, self.high)

    @cached_property
    def units(self) -> Array:
        """A step of one in [rad, m] (n,): slides move by lengths of the arm."""
        return np.array([1.0 if kind == "R" else self.length for kind in self.chain.kinds])


class _Place(NamedTuple):
    """Joint values with their error and what a step from them goes by."""

    q: Array
    error: Array
    J: Array
    slope: Array
    free: NDArray[np.bool_]

    @property
    def size(self) -> float:
        return float(np.linalg.norm(self.error))

    @property
    def is_stationary(self) -> bool:
        return bool(np.linalg.norm(self.slope[self.free]) <= STATIONARY * self.size)


def descend(problem: Problem, q: Array, longest: float, iterations: int) -> Outcome:
    """The closest that is reached from q (n,) by at most so many steps.

    No joint moves more than `longest` [rad, lengths of the arm] in one of them.
    """
    error, weight = problem.error(q), FIRST_WEIGHT
    for tried in range(iterations + 1):
        if problem.is_met(error):
            return Outcome(q, "converged", tried)
        if weight > STIFFEST:
            return Outcome(q, "rounding", tried)

        here = _place(problem, q, error)
        beyond = None
        if here.is_stationary:
            beyond = _past_the_saddle(problem, here, longest)
            if beyond is None:
                return Outcome(q, "local minimum" if here.free.all() else "joint limits", tried)

        if tried == iterations:
            break
        if beyond is not None:
            q, error = beyond
        else:
            q, error, weight = _tried(problem, here, weight, longest)
    return Outcome(q, "iterations", iterations)


def _place(problem: Problem, q: Array, error: Array) -> _Place:
    J = problem.jacobian(q)
    slope = J.T @ error
    return _Place(q, error, J, slope, ~problem.blocked(q, slope))


def _tried(
    problem: Problem, here: _Place, weight: float, longest: float
) -> tuple[Array, Array, float]:
    """Joint values and error after a step, or before it if it was not worth it; the next weight."""
    size = here.size
    step = _step(problem, here, math.sqrt(weight) * size, longest)
    trial = problem.moved(here.q, step)
    missing = problem.error(trial)

    predicted = size**2 - float(np.sum((here.error - here.J @ step) ** 2))
    gain = 0.0
    if predicted > 0:
        gain = (size**2 - float(missing @ missing)) / predicted
    weight = _next_weight(weight, gain)

    if gain > WORTH:
        return trial, missing, weight
    return here.q, here.error, weight


def _next_weight(weight: float, gain: float) -> float:
    """Less damping where the last step brought what was predicted, more where it did not."""
    if gain > 0.75:
        return max(weight / 4, LIGHTEST)
    if gain < 0.25:
        return weight * 4
    return weight


def _step(problem: Problem, here: _Place, damping: float, longest: float) -> Array:
    """Damped step (n,); joints that it would carry past a limit stop there, the others make up."""
    lowest = (problem.low - here.q) / problem.units
    highest = (problem.high - here.q) / problem.units
    step, left = np.zeros(problem.chain.n), here.free.copy()
    J = here.J

    # the error is shortened before the step is, so that its direction stays
    whole = damped_inverse(J[:, left], damping) @ here.error
    wanted = here.error * min(1.0, longest / max(float(np.abs(whole).max()), longest))
    while left.any():
        step[left] = damped_inverse(J[:, left], damping) @ (wanted - J[:, ~left] @ step[~left])
        past = left & ((step < lowest) | (step > highest))
        step = np.clip(step, lowest, highest)
        left &= ~past
        if not past.any():
            break
    return np.clip(step, -longest, longest)


def _past_the_saddle(problem: Problem, here: _Place, longest: float) -> tuple[Array, Array] | None:
    """A way on where the error has no slope but bends down, as for an arm stretched away."""
    reach = np.diag(np.where(here.free, longest, 0.0))
    curvature = problem.curvature(here.q, here.J, here.error)
    curvatures, directions = np.linalg.eigh(reach @ curvature @ reach)
    if curvatures[0] >= 0:
        return None

    steepest = reach @ directions[:, 0]
    for share in SHARES:
        trial = problem.moved(here.q, share * steepest)
        missing = problem.error(trial)
        if missing @ missing < (1 - 1e-9) * (here.error @ here.error):
            return trial, missing
    return None
