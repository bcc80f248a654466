"""A descent from many places at once, to find a place from which one alone arrives."""

import math
from typing import cast

import numpy as np

from .chain import Array
from .descent import Outcome, Problem, descend
from .displacement import displacement
from .jacobian import jacobian
from .kinematics import forward
from .spread import spread

CROWD = 16  # places that go down together
STEPS = 40  # of a crowd
NEAR = 0.02  # error from which one alone is sure to arrive [rad, lengths of the arm]
WEIGHT = 0.02  # of the damping, per squared error
LONGEST = 0.7  # step of a joint [rad, lengths of the arm]
TURN = 2 * math.pi
WIDE = 4 * math.pi  # where a joint has no limits


def descend_from_many(
    problem: Problem, start: Array, starts: int, longest: float, iterations: int
) -> Outcome:
    """The first place that meets the pose, of `start` and others; else the closest reached."""
    limits = _finite(problem, start)
    others = spread(limits, max(starts - 1, 1))
    tried = 0
    best: Outcome | None = None
    closest = math.inf
    for first in range(0, starts, CROWD):
        crowd = others[first : first + CROWD]
        if first == 0:
            crowd = np.concatenate([start[None], crowd[:-1]])
        q, steps = _promising(problem, crowd)
        found = descend(problem, q, longest, iterations)
        tried += steps + found.tried
        error = float(np.linalg.norm(problem.error(found.q)))
        if error < closest:
            best, closest = found, error
        if found.stopped == "converged":
            break
    assert best is not None  # noqa: S101 - starts is 1 or more
    return best._replace(tried=tried)


def _finite(problem: Problem, start: Array) -> Array:
    """Limits (n, 2), a turn or a length of the arm around the start where there are none."""
    around = WIDE / 2 * problem.units
    low = np.where(np.isfinite(problem.low), problem.low, start - around)
    high = np.where(np.isfinite(problem.high), problem.high, start + around)
    return np.stack([low, high], axis=1)


def _promising(problem: Problem, q: Array) -> tuple[Array, int]:
    """The place (n,) that is closest after some steps of all of (m, n), and how many they were."""
    tried = 0
    error = _errors(problem, q)
    size = np.square(error).sum(axis=-1)
    while size.min() >= NEAR**2 and tried < STEPS:
        q = within(problem, q + _step(problem, q, error) * problem.units)
        error = _errors(problem, q)
        size = np.square(error).sum(axis=-1)
        tried += 1
    return q[size.argmin()], tried


def _step(problem: Problem, q: Array, error: Array) -> Array:
    """Damped steps (m, n) [rad, lengths of the arm], none of a joint longer than `LONGEST`."""
    J = _jacobians(problem, q)
    size = np.square(error).sum(axis=-1)
    damping = WEIGHT * np.minimum(size, 1.0)[:, None, None] * np.eye(J.shape[1])
    weights = cast("Array", np.linalg.inv(J @ J.mT + damping))
    step = cast("Array", np.einsum("mrn,mrs,ms->mn", J, weights, error))
    largest = np.abs(step).max(axis=-1, keepdims=True)
    return step * np.minimum(1.0, LONGEST / np.maximum(largest, LONGEST))


def _jacobians(problem: Problem, q: Array) -> Array:
    """The rows that count (m, rows, n) at each place (m, n), in lengths of the arm."""
    columns = jacobian(problem.chain, q) * problem.units
    columns[:, :3] /= problem.length
    return columns[:, problem.rows]


def _errors(problem: Problem, q: Array) -> Array:
    """What is missing (m, rows) at each place (m, n)."""
    missing = displacement(forward(problem.chain, q), problem.target)
    missing[:, :3] /= problem.length
    return missing[:, problem.rows]


def within(problem: Problem, q: Array) -> Array:
    """Joint values (m, n) within the limits: by a full turn where that gets there, else at them."""
    turns = np.array([kind == "R" for kind in problem.chain.kinds])
    down, up = q - TURN, q + TURN
    q = np.where(turns & (q > problem.high) & (down >= problem.low), down, q)
    q = np.where(turns & (q < problem.low) & (up <= problem.high), up, q)
    return np.clip(q, problem.low, problem.high)
