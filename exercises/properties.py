"""What makes an answer right where it is not unique: properties in place of a reference value."""

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..solutions.expression_array import POINTS, ExpressionArray, same_formulas, sample, sampled
from .exercise import Outcome

Array = NDArray[np.float64]
TURN = 2 * np.pi
MULTIPLE = (
    "It is the determinant times a constant: it is zero in the right postures, but the "
    "determinant itself is asked."
)
LARGEST_ANGLE = 1e4  # beyond it, whole turns can no longer be taken off without rounding


def parallel(
    value: ArrayLike, direction: ArrayLike, tolerance: float, *, sign: bool = False
) -> bool:
    """Whether a vector (n,) points along a direction (n,), at any length.

    With `sign`, it may not point against it. `tolerance` [rad] is the largest angle between them. A
    vector of zeros points nowhere.
    """
    a = np.asarray(value, dtype=float)
    b = np.asarray(direction, dtype=float)
    size = float(np.linalg.norm(a) * np.linalg.norm(b))
    if size < 1e-9:
        return False

    cosine = float(a @ b) / size
    if not sign:
        cosine = abs(cosine)
    angle = float(np.arccos(np.clip(cosine, -1, 1)))
    return angle <= tolerance


def is_guessable(direction: ArrayLike, angle: float = 0.05) -> bool:
    """Whether a direction (n,) is within `angle` [rad] of one that a guess may hit.

    The components of a guess are 0 and +-1.
    """
    wanted = np.asarray(direction, dtype=float)
    guesses = product((-1, 0, 1), repeat=len(wanted))
    return any(parallel(guess, wanted, angle) for guess in guesses)


def meets(J: ArrayLike, rates: ArrayLike, target: ArrayLike, allowed: ArrayLike) -> bool:
    """Whether joint rates (n,) give a velocity: |J rates - target| <= allowed, row by row of J."""
    misses = np.asarray(J) @ np.asarray(rates) - np.asarray(target)
    return bool((np.abs(misses) <= allowed).all())


def is_right_inverse(J: ArrayLike, X: ArrayLike, tolerance: float) -> bool:
    """Whether J X = I for J (m, n) and X (n, m)."""
    product = np.asarray(J) @ np.asarray(X)
    return bool(np.abs(product - np.eye(len(product))).max() <= tolerance)


def is_pseudoinverse(J: ArrayLike, X: ArrayLike, tolerance: float) -> bool:
    """Whether X (n, m) meets the four Penrose conditions for J (m, n).

    They are J X J = J, X J X = X, and that J X and X J are symmetric.
    """
    A, B = np.asarray(J, dtype=float), np.asarray(X, dtype=float)
    AB, BA = A @ B, B @ A
    size = max(1.0, np.abs(B).max())  # X J X - X grows with X
    misses = (A @ BA - A, (BA @ B - B) / size, AB - AB.T, BA - BA.T)
    return all(float(np.abs(miss).max()) <= tolerance for miss in misses)


def proportional(value: ExpressionArray, reference: ExpressionArray, names: Sequence[str]) -> bool:
    """Whether a formula is another one times a constant that is not zero.

    So is a determinant up to its sign.
    """
    values = sample(names, POINTS)
    own = np.broadcast_to(value.at(values), (POINTS, *value.shape)).ravel()
    wanted = np.broadcast_to(reference.at(values), (POINTS, *reference.shape)).ravel()
    if not np.isfinite(own).all() or not wanted.any():
        return False

    factor = float(own @ wanted) / float(wanted @ wanted)
    misses = np.abs(own - factor * wanted)
    return abs(factor) > 1e-9 and bool((misses <= 1e-8 * np.abs(own).max()).all())


def named_multiple(
    value: ExpressionArray, determinant: ExpressionArray, names: Sequence[str]
) -> Outcome | None:
    """Names a determinant that lacks a constant factor; the comparison says whether it is right."""
    if same_formulas(value, determinant, names).all():
        return None
    if not proportional(value, determinant, names):
        return None
    return Outcome(finding=MULTIPLE)


def without_zeros(value: ExpressionArray, right: ExpressionArray, names: Sequence[str]) -> Outcome:
    """The share of right formulas less one for each that should be zero and is not.

    A right zero earns nothing, so that zeros alone do not.
    """
    same = same_formulas(value, right, names)
    earning = np.array([bool(entry.names) for entry in right.entries]).reshape(right.shape)
    hits = int((same & earning).sum())
    wrong_zeros = int((~same & ~earning).sum())
    return Outcome(share=max(0, hits - wrong_zeros) / int(earning.sum()))


def up_to_full_turns(
    value: ExpressionArray, right: ExpressionArray, names: Sequence[str], angles: Sequence[int]
) -> Outcome:
    """Formulas (n,), of which those in the places `angles` may differ by full turns."""
    same = same_formulas(value, right, names)
    turns = (sampled(value, names) - sampled(right, names)) / TURN
    for i in angles:
        own = turns[:, i]
        is_finite = np.isfinite(own).all()
        same[i] = is_finite and np.abs(own - np.round(own)).max() < 1e-9
    return Outcome(right=same)


def listed(
    values: ArrayLike, wanted: ArrayLike, tolerance: float, *, periodic: bool = True
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which of the student's rows (m, n) are wanted, and which wanted rows (k, n) the student has.

    With `periodic`, angles a full turn apart are the same.
    """
    own = np.atleast_2d(np.asarray(values, dtype=float))
    all_wanted = np.atleast_2d(np.asarray(wanted, dtype=float))
    difference = own[:, None] - all_wanted[None]
    if periodic:
        difference = turned(difference)

    same: NDArray[np.bool_] = np.asarray((np.abs(difference) <= tolerance).all(axis=-1))  # (m, k)
    is_wanted = np.logical_or.reduce(same, axis=1)
    is_had = np.logical_or.reduce(same, axis=0)
    return np.asarray(is_wanted), np.asarray(is_had)


def turned(difference: ArrayLike) -> NDArray[np.float64]:
    """Differences of angles [rad] less whole turns, in [-pi, pi].

    They are infinite where the angles are too large to tell.
    """
    angle = np.asarray(difference, dtype=float)
    rest = angle - TURN * np.round(angle / TURN)
    return np.where(np.abs(angle) > LARGEST_ANGLE, np.inf, rest)


def list_share(
    values: ArrayLike,
    wanted: ArrayLike,
    tolerance: float,
    holds: Callable[[Array], bool] = lambda _: False,
) -> tuple[NDArray[np.bool_], float]:
    """Right entries (m, n) of a list of configurations, and the share of the points it earns.

    Each wrong one costs a right one. A configuration that is not in `wanted` may still be right
    when it `holds`.
    """
    own = np.asarray(values, dtype=float)
    right, hit = listed(own, wanted, tolerance)
    right = right | np.array([holds(row) for row in own])
    hits, wrong = int(hit.sum()), int((~right).sum())
    share = max(0, hits - wrong) / len(hit)
    return np.broadcast_to(right[:, None], own.shape), share


def listed_right(values: ArrayLike, wanted: ArrayLike, tolerance: float) -> Outcome:
    """The outcome of a list of configurations where all wanted ones are asked.

    Each wrong one costs one right one.
    """
    right, share = list_share(values, wanted, tolerance)
    return Outcome(right, share=share)
