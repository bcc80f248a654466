"""What an answer says of the drawn arm's motion, beside what the arm does: vectors, as data.

An answer is taken for the arm's Jacobian, one block of it, its axes, a twist or its frames where
the reference is just that of the drawn arm: no exercise has to say so.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...exercises.drawing import Drawing
from ...solutions.jacobian import jacobian
from ...solutions.kinematics import frames
from ...solutions.tokens import LARGEST
from .vectors import Array

SAME = 1e-7  # of two numbers that are computed in two ways
NAMES = "xyz"


@dataclass(frozen=True, eq=False)
class Vector:
    """One thing that moves or points: own and reference, each from a place on the arm.

    Attributes:
        symbol: What it is called, such as v or z.
        index: The number behind it, of a joint, or "".
        at: Where the reference one starts (3,), in base axes [m].
        reference: Of the arm (3,).
        own_at: Where the own one starts (3,).
        own: What the answer says (3,).
    """

    symbol: str
    index: str
    at: Array
    reference: Array
    own_at: Array
    own: Array


@dataclass(frozen=True, eq=False)
class Motion:
    """A drawing of an arm with the vectors in which an answer differs from it."""

    drawing: Drawing
    vectors: tuple[Vector, ...]


def motion(
    drawings: Sequence[Drawing],
    reference: Any,
    own: Any,
    *,
    angular_first: bool,
    given: Mapping[str, Any],
) -> Motion | None:
    """The motion that a wrong answer says of the first drawn arm whose motion is asked; else None.

    Args:
        drawings: of the exercise, at the student's q.
        reference: the right answer.
        own: the student's, of the same shape.
        angular_first: whether angular rows stand above linear ones.
        given: drawn numbers by name; a twist is recognized by the joint rates among them.
    """
    right, answer = np.asarray(reference, dtype=float), np.asarray(own, dtype=float)
    if answer.shape != right.shape or not (np.abs(answer) <= LARGEST).all():
        return None
    for drawing in drawings:
        vectors = tuple(_vectors(drawing, right, answer, angular_first, given))
        wrong = [vector for vector in vectors if _differs(vector)]
        if wrong:
            # Of a Jacobian, only the velocities or else only the axes: both are too much at once.
            first = [vector for vector in wrong if vector.index == "" or _is_like(vector, wrong[0])]
            return Motion(drawing, tuple(first))
    return None


def _is_like(one: Vector, other: Vector) -> bool:
    return one.symbol == other.symbol


def _vectors(
    drawing: Drawing, right: Array, own: Array, angular_first: bool, given: Mapping[str, Any]
) -> Iterator[Vector]:
    """All vectors of an answer that is one of the arm's own; none of any other."""
    q = np.asarray(drawing.q)
    poses = frames(drawing.chain, q)
    J = jacobian(drawing.chain, q)
    if angular_first:
        right, own = (_linear_first(array) for array in (right, own))
    if _same(right, J):
        yield from _columns("v", poses, right[:3], own[:3])
        yield from _axes("ω", poses, right[3:], own[3:])
    elif _same(right, J[:3]):
        yield from _columns("v", poses, right, own)
    elif _same(right, J[3:]) or _same(right, poses[:-1, :3, 2].T):
        yield from _axes("z", poses, right, own)
    elif right.shape == (6,) and _is_twist(right, J, given):
        tool = poses[-1, :3, 3]
        yield Vector("v", "", tool, right[:3], tool, own[:3])
        yield Vector("ω", "", tool, right[3:], tool, own[3:])
    elif _same(right, poses[-1]):
        yield from _frame("", right, own)


def _linear_first(array: Array) -> Array:
    if array.shape[:1] != (6,):
        return array
    return np.concatenate([array[3:], array[:3]])


def _same(one: Array, other: Array) -> bool:
    return one.shape == other.shape and bool(np.abs(one - other).max() < SAME)


def _is_twist(right: Array, J: Array, given: Mapping[str, Any]) -> bool:
    """Whether a vector is J times joint rates that were drawn."""
    for number in given.values():
        try:
            rates = np.asarray(number, dtype=float)
        except (TypeError, ValueError):  # a choice of form, or a table of text
            continue
        if rates.shape == J.shape[1:] and _same(right, J @ rates):
            return True
    return False


def _columns(symbol: str, poses: Array, right: Array, own: Array) -> Iterator[Vector]:
    """What each joint does to the tool point."""
    tool = poses[-1, :3, 3]
    for i in range(right.shape[1]):
        yield Vector(symbol, str(i + 1), tool, right[:, i], tool, own[:, i])


def _axes(symbol: str, poses: Array, right: Array, own: Array) -> Iterator[Vector]:
    """About what each joint turns, at the joint."""
    for i in range(right.shape[1]):
        at = poses[i, :3, 3]
        yield Vector(symbol, str(i + 1), at, right[:, i], at, own[:, i])


def _frame(index: str, right: Array, own: Array) -> Iterator[Vector]:
    """The axes of a frame where it is, and where the answer has it."""
    for k, name in enumerate(NAMES):
        yield Vector(name, index, right[:3, 3], right[:3, k], own[:3, 3], own[:3, k])


def _differs(vector: Vector) -> bool:
    """Whether it can be seen that own and reference are not the same."""
    size = max(float(np.abs(vector.reference).max()), float(np.abs(vector.own).max()), 1e-9)
    apart = np.abs(vector.reference - vector.own).max() > 0.03 * size
    return bool(apart or np.abs(vector.at - vector.own_at).max() > SAME)
