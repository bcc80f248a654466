"""All postures that bring the tool to a pose, in closed form."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .chain import Array, Chain, ChainError
from .displacement import displacement
from .inverse import pose_of
from .jacobian import jacobian
from .kinematics import forward
from .limits import are_outside
from .pieper import Axes, Solver, axes_of, displacement_to, solver_of
from .velocity import pseudoinverse

MET = 1e-9  # [of the arm's length, rad]
SAME = 1e-6  # postures this near are one [rad, of the arm's length]
SINGULAR = 1e-6  # smallest singular value over the largest, lengths in shares of the arm's


@dataclass(frozen=True, eq=False)
class Postures:
    """All postures for a pose.

    Attributes:
        q: Joint values (k, 6) [rad, m], at most eight postures; angles are within half a turn, or,
            with limits, within those.
        singular: For each posture, the joints (from 1) that may move together while the tool stands
            still: of the endless many postures there it is one.
    """

    q: Array
    singular: tuple[tuple[int, ...], ...]

    def __str__(self) -> str:
        """A sentence for people."""
        if not len(self.q):
            return "No posture brings the tool there."
        sentence = f"{len(self.q)} postures bring the tool there."
        if len(self.q) == 1:
            sentence = "One posture brings the tool there."
        for number, joints in enumerate(self.singular, 1):
            if joints:
                names = " and ".join(f"q{i}" for i in joints)
                sentence += (
                    f" Posture {number} is singular: {names} may move while the tool stands still,"
                    " so that it stands for endless many."
                )
        return sentence


def all_postures(chain: Chain, pose: ArrayLike, *, limits: ArrayLike | None = None) -> Postures:
    """All joint values at which the tool has a pose (4, 4), of arms that have a closed form.

    Those are arms of six joints with a spherical wrist, whose axes 2 and 3 are parallel (Puma) or
    axes 1 and 2 meet (Stanford), and arms whose axes 2, 3 and 4 are parallel and axes 5 and 6 meet
    (UR5); after Pieper (1968). Every posture is tried in `forward`: its pose is right to 1e-9 of
    the arm's length and 1e-9 rad. With `limits` (6, 2) [rad, m] those that no full turn brings
    within them are left out. `inverse_kinematics` finds postures of all other arms, one by one.

    Raises:
        ChainError: An arm of another kind, or an argument of the wrong form.
    """
    target = pose_of(pose)
    axes = axes_of(chain) if chain.n == 6 else None
    solver = solver_of(axes) if axes is not None else None
    if axes is None or solver is None:
        raise ChainError(
            "all_postures takes six joints with a spherical wrist, and axes 2 and 3 parallel or "
            "axes 1 and 2 meeting, or with axes 2, 3 and 4 parallel and axes 5 and 6 meeting; "
            "inverse_kinematics takes any arm"
        )
    bounds = _bounds(chain, limits)
    found = list[Array]()
    for q in _met(chain, axes, solver, target):
        within = _within(chain, bounds, q)
        if within is not None and not any(_same(chain, axes, within, other) for other in found):
            found.append(within)
    q = np.array(found).reshape(-1, chain.n)
    q.flags.writeable = False
    return Postures(q, tuple(_loose(chain, axes, posture) for posture in q))


def _met(chain: Chain, axes: Axes, solver: Solver, target: Array) -> list[Array]:
    """The solutions, sharpened by a step of Newton's, whose pose is the wanted one."""
    met = list[Array]()
    for values in solver(displacement_to(chain, target)):
        q = np.array(values)
        error = _error(chain, axes, q, target)
        if error < SAME:
            du = displacement(forward(chain, q), target)
            sharper = q + pseudoinverse(jacobian(chain, q)) @ du
            if _error(chain, axes, sharper, target) < error:
                q = sharper
        if _error(chain, axes, q, target) <= MET:
            met.append(q)
    return met


def _error(chain: Chain, axes: Axes, q: Array, target: Array) -> float:
    du = displacement(forward(chain, q), target)
    return float(max(np.linalg.norm(du[:3]) / axes.length, np.linalg.norm(du[3:])))


def _bounds(chain: Chain, limits: ArrayLike | None) -> Array | None:
    if limits is None:
        return None
    bounds = np.asarray(limits, dtype=np.float64)
    if bounds.shape != (chain.n, 2) or not (bounds[:, 0] <= bounds[:, 1]).all():
        raise ChainError(
            f"limits takes {chain.n} pairs of a lowest and a highest value, got {bounds.tolist()}"
        )
    return bounds


def _within(chain: Chain, bounds: Array | None, q: Array) -> Array | None:
    """The same posture with angles within half a turn or within the limits; None if not there."""
    turns = np.array([kind == "R" for kind in chain.kinds])
    q = np.where(turns, np.pi - (np.pi - q) % (2 * np.pi), q)
    if bounds is None:
        return q
    outside = are_outside(bounds, q) & turns & np.isfinite(bounds).all(axis=1)
    up = np.ceil((bounds[:, 0] - q) / (2 * np.pi), where=outside, out=np.zeros_like(q))
    q = q + 2 * np.pi * up
    return None if are_outside(bounds, q).any() else q


def _same(chain: Chain, axes: Axes, q: Array, other: Array) -> bool:
    gap = q - other
    turns = np.array([kind == "R" for kind in chain.kinds])
    gap = np.where(turns, np.remainder(gap + np.pi, 2 * np.pi) - np.pi, gap / axes.length)
    return bool(np.abs(gap).max() < SAME)


def _loose(chain: Chain, axes: Axes, q: Array) -> tuple[int, ...]:
    """The joints that may move together while the tool stands still; none where it is regular."""
    J = jacobian(chain, q).copy()
    J[:3] /= axes.length
    _, sigma, rows = np.linalg.svd(J)
    if sigma[-1] > SINGULAR * sigma[0]:
        return ()
    return tuple(int(i) + 1 for i in np.flatnonzero(np.abs(rows[-1]) > 1e-4))
