"""How far the tool gets: distances that it attains, and a bound on what it might miss.

Along one joint the squared distance is a trigonometric polynomial of second order (a parabola for a
slide), so that its best value within the limits is known. Climbs from many places, joint by
joint, end at the best distances. Boxes of joint values, halved where they may hold a better one,
then bound how much better one could be: over a box the squared distance is below its value at the
centre, plus what its slope and the largest second derivatives give.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from .jacobian import jacobian
from .kinematics import forward
from .singularity import Parameters, RegionalArm, Values, arm
from .spread import spread

if TYPE_CHECKING:
    from .robots import Robot

STARTS = 512
KEPT = 24  # of the starts, after the first sweeps
FIRST_SWEEPS = 4
SWEEPS = 60
LINE = 49  # places along one joint that are compared before the best of them is refined
REFINED = 4  # Newton steps
BOXES = 60_000  # that are looked at before the bound is what it is
ENOUGH = 1e-6  # of the largest distance: a bound this tight is not sharpened

From = Literal["axis 1", "base"]


class Reach(NamedTuple):
    """The smallest and the largest distance [m] that the tool attains, and what may be missing.

    No configuration within the joint limits comes nearer than `near - error` or gets farther than
    `far + error` [m].
    """

    near: float
    far: float
    error: float


class _Distance(NamedTuple):
    """The squared distance of the tool of an arm, from axis 1 or from the base origin."""

    part: RegionalArm
    origin: Values
    across: Values  # (3, 3), the projection on the directions that count

    def squared(self, q: Values) -> Values:
        return np.square(self.offset(q)).sum(axis=-1)

    def offset(self, q: Values) -> Values:
        return (forward(self.part.chain, q)[..., :3, 3] - self.origin) @ self.across

    def slope(self, q: Values) -> Values:
        """The gradient (..., n) of the squared distance."""
        J = jacobian(self.part.chain, q)[..., :3, :]
        return 2 * np.einsum("...x,...xn->...n", self.offset(q), J)


def reach(
    robot: "Robot", parameters: Parameters = None, *, of: From = "axis 1"
) -> tuple[float, float]:
    """The smallest and largest distance [m] of the tool within the joint limits, as attained.

    It is measured from axis 1 or from the base origin. For an arm with a wrist it is the wrist
    centre's. `bounded_reach` says how much may be missing.
    """
    distance = _distance(arm(robot, parameters), of)
    near, far = _attained(distance, _free(distance))
    return float(np.sqrt(near)), float(np.sqrt(far))


def bounded_reach(robot: "Robot", parameters: Parameters = None, *, of: From = "axis 1") -> Reach:
    """The reach, and a bound on what may be missing.

    The bound is about 1e-5 of the arm's length where up to three joints change the distance. For
    more it is hardly better than the lengths of all links together.
    """
    distance = _distance(arm(robot, parameters), of)
    free = _free(distance)
    near, far = _attained(distance, free)
    farther, nearer = far, near
    if free:
        farther = min(_bound(distance, free, far, 1.0), _stretched(distance, of) ** 2)
        nearer = -_bound(distance, free, -near, -1.0)

    least, largest = np.sqrt(near), np.sqrt(far)
    above = np.sqrt(max(farther, far)) - largest
    below = least - np.sqrt(max(min(nearer, near), 0.0))
    return Reach(float(least), float(largest), float(max(above, below)))


def _attained(distance: _Distance, free: list[int]) -> tuple[float, float]:
    """The smallest and the largest squared distance found."""
    far = _best(distance.squared, distance.part, free)
    near = -_best(lambda q: -distance.squared(q), distance.part, free)
    return max(near, 0.0), far


def _stretched(distance: _Distance, of: From) -> float:
    """The lengths of all links and strokes together [m], farther than which no tool gets."""
    chain = distance.part.chain
    links = np.linalg.norm(chain.fixed[:, :3, 3], axis=-1)
    strokes = [
        float(np.abs(limits).max())
        for limits, kind in zip(distance.part.limits, chain.kinds, strict=True)
        if kind == "P"
    ]
    first = 0 if of == "base" else 1
    return float(links[first:].sum()) + sum(strokes)


def _distance(part: RegionalArm, of: From) -> _Distance:
    if of == "base":
        return _Distance(part, np.zeros(3), np.eye(3))
    first = part.chain.fixed[0]
    z = first[:3, 2]
    return _Distance(part, first[:3, 3], np.eye(3) - np.outer(z, z))


def _free(distance: _Distance) -> list[int]:
    """The joints that change the distance."""
    q = spread(distance.part.limits, 64)
    squared = distance.squared(q)
    found: list[int] = []
    for i in range(distance.part.chain.n):
        turned = q.copy()
        turned[:, i] = q[::-1, i]
        if np.abs(distance.squared(turned) - squared).max() > 1e-12 * squared.max():
            found.append(i)
    return found


def _best(value: Callable[[Values], Values], part: RegionalArm, free: list[int]) -> float:
    """The largest value that climbs along one joint after the other come to."""
    q = spread(part.limits, STARTS)
    for sweep in range(SWEEPS):
        if sweep == FIRST_SWEEPS:
            order = np.argsort(value(q))
            q = q[order[-KEPT:]]
        for i in free:
            q[:, i] = _best_along(value, part, q, i)
    return float(value(q).max())


def _best_along(
    value: Callable[[Values], Values], part: RegionalArm, q: Values, joint: int
) -> Values:
    """The best value (m,) of one joint within its limits, the others standing as in q (m, n)."""
    low, high = part.limits[joint]
    turns = part.chain.kinds[joint] == "R"
    basis, nodes = _sliding, _line(low, high, 3)
    if turns:
        basis, nodes = _turning, _line(0.0, 1.6 * np.pi, 5)

    there = np.repeat(q[:, None], len(nodes), axis=1)
    there[..., joint] = nodes
    weights = np.linalg.solve(basis(nodes)[0], value(there).T).astype(np.float64)

    line = _line(low, high, LINE)
    best = line[(basis(line)[0] @ weights).argmax(axis=0)]
    return _refined(basis, weights, best, (low, high))


def _line(low: float, high: float, count: int) -> Values:
    return np.linspace(low, high, count, dtype=np.float64)


Basis = Callable[[Values], tuple[Values, Values, Values]]


def _turning(x: Values) -> tuple[Values, Values, Values]:
    """Functions (..., 5) that the squared distance is made of along a turning joint.

    With their first and second derivatives.
    """
    c, s, c2, s2 = np.cos(x), np.sin(x), np.cos(2 * x), np.sin(2 * x)
    zero = np.zeros_like(x)
    values = np.stack([zero + 1, c, s, c2, s2], axis=-1)
    first = np.stack([zero, -s, c, -2 * s2, 2 * c2], axis=-1)
    second = np.stack([zero, -c, -s, -4 * c2, -4 * s2], axis=-1)
    return values, first, second


def _sliding(x: Values) -> tuple[Values, Values, Values]:
    """The same (..., 3) along a slide."""
    zero = np.zeros_like(x)
    values = np.stack([zero + 1, x, x**2], axis=-1)
    first = np.stack([zero, zero + 1, 2 * x], axis=-1)
    second = np.stack([zero, zero, zero + 2], axis=-1)
    return values, first, second


def _refined(basis: Basis, weights: Values, best: Values, limits: tuple[float, float]) -> Values:
    """The best places (m,), after Newton steps that do not leave the limits or climb down."""
    for _ in range(REFINED):
        values, first, second = basis(best)
        slope = np.einsum("mk,km->m", first, weights)
        bend = np.einsum("mk,km->m", second, weights)
        bends_down = bend < 0
        step = np.divide(-slope, bend, out=np.zeros_like(slope), where=bends_down)
        tried = np.clip(best + step, *limits)

        before = np.einsum("mk,km->m", values, weights)
        after = np.einsum("mk,km->m", basis(tried)[0], weights)
        best = np.where(after >= before, tried, best)
    return best


def _bound(distance: _Distance, free: list[int], best: float, sign: float) -> float:
    """What `sign` times the squared distance does not exceed anywhere within the limits."""
    part = distance.part
    limits = np.asarray(part.limits, dtype=np.float64)[free]
    centre = limits.mean(axis=1)[None]
    half = ((limits[:, 1] - limits[:, 0]) / 2)[None]
    levers = _levers(part, free)
    largest = (
        np.sqrt(max(abs(best), distance.squared(spread(part.limits, 64)).max())) + levers.sum()
    )
    bends = 2 * (np.outer(levers, levers) + largest * np.minimum.outer(levers, levers))

    margin = ENOUGH * largest**2
    looked_at = 0
    while len(centre):
        looked_at += len(centre)
        q = np.zeros((len(centre), part.chain.n))
        q[:, free] = centre
        above = sign * distance.squared(q)
        above += (np.abs(distance.slope(q)[:, free]) * half).sum(axis=1)
        above += 0.5 * np.einsum("mi,ij,mj->m", half, bends, half)
        left = above > best + margin
        if not left.any():
            break
        if looked_at > BOXES:
            return float(above.max())
        centre, half = _halved(centre[left], half[left], levers)
    return best + margin


def _halved(centre: Values, half: Values, levers: Values) -> tuple[Values, Values]:
    """Two boxes for each, cut across the joint that moves the tool most within it."""
    rows = np.arange(len(half))
    widest = (half * levers).argmax(axis=1)
    half = half.copy()
    half[rows, widest] /= 2
    shift = np.zeros_like(half)
    shift[rows, widest] = half[rows, widest]
    return np.concatenate([centre - shift, centre + shift]), np.concatenate([half, half])


def _levers(part: RegionalArm, free: list[int]) -> Values:
    """The most that the tool moves per unit of each free joint [m/rad], 1 for a slide."""
    chain = part.chain
    found = np.ones(chain.n)
    lever = 0.0
    for i in range(chain.n - 1, -1, -1):
        lever += float(np.linalg.norm(chain.fixed[i + 1][:3, 3]))
        if chain.kinds[i] == "P":
            lever += float(np.abs(part.limits[i]).max())
        else:
            found[i] = lever
    return found[free]
