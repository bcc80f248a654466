"""The walk along a chain: its links, each in the axes in which little is left to multiply."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..chain import Array, Chain, elementary, snapped_transforms
from ..rotation import inverse_transform
from .tracer import Angle, Rows, Signed, Tracer, Value, Vector, rotation


class Link(NamedTuple):
    """A joint and the constant behind it: Rz(angle) Tz(along) [F offset].

    It stands in a frame of rotation `base`. `angle` is the sum of the joint's own and of those of
    the parallel joints `before` it; `parallel` says that F keeps the axis.
    """

    kind: str
    base: Rows
    before: Angle
    angle: Angle
    along: Value
    F: Rows
    offset: Vector
    parallel: bool

    @property
    def z(self) -> Vector:
        """The axis of the joint."""
        return [row[2] for row in self.base]


class Walk(NamedTuple):
    """C0 E1 C1 ... En Cn: translation of C0, the links, and the rotation behind the last one."""

    start: Vector
    links: list[Link]
    end: Rows


def from_base_to_tool(tracer: Tracer, chain: Chain) -> Walk:
    """Walk along the chain: axes and points appear in base coordinates."""
    joints = [(1, joint) for joint in range(chain.n)]
    return _walk(tracer, chain.fixed, chain.kinds, joints)


def from_tool_to_base(tracer: Tracer, chain: Chain) -> Walk:
    """Walk along the inverse chain: axes and points appear in tool coordinates."""
    fixed = inverse_transform(chain.fixed[::-1])
    joints = [(-1, joint) for joint in reversed(range(chain.n))]
    return _walk(tracer, fixed, chain.kinds[::-1], joints)


def folded(C: Array) -> tuple[float, Array, float]:
    """C as Rz(first) D Rz(last) with more zeros in D: a dense rotation becomes one about x.

    Quarter turns stay in D, where they are exact, and so does all of C between parallel axes.
    """
    x, y = C[0, 2], C[1, 2]
    if not (x or y):
        return 0.0, C, 0.0

    first, turned = 0.0, C
    if x and y:
        first = float(np.arctan2(x, -y))
        turned = snapped_transforms(elementary("Rz", -first) @ C)
    # the row that only a last turn about z can have filled
    level = turned[1] if turned[0, 2] else turned[0]
    if not (level[0] and level[1]):
        return first, turned, 0.0
    last = float(np.arctan2(-level[1], level[0]))
    return first, snapped_transforms(turned @ elementary("Rz", -last)), last


def folds(chain: Chain) -> bool:
    """Whether any constant holds a turn to fold; where none does, that of no inverse does."""
    for C in chain.fixed:
        first, _, last = folded(C)
        if first or last:
            return True
    return False


def _walk(tracer: Tracer, fixed: Array, kinds: str, joints: Sequence[tuple[int, int]]) -> Walk:
    """Walk E and C alternately; `joints` (sign, index) says which joint value each E takes."""
    base, before = rotation(fixed[0]), Angle()
    links = list[Link]()
    for kind, (sign, joint), C in zip(kinds, joints, fixed[1:], strict=True):
        first, D, last = folded(C) if tracer.folds else (0.0, C, 0.0)

        along: Value = 0.0
        angle = before.plus((), first)
        if kind == "R":
            angle = before.plus(((sign, joint),), first)
        else:
            along = Signed(f"q{joint}", sign < 0)

        # Rz(s) F = F Rz(+-s) where F keeps the axis: parallel axes share one angle,
        # however they are offset
        F, parallel = rotation(D), not D[:2, 2].any()
        links.append(Link(kind, base, before, angle, along, F, _translation(D), parallel))
        if parallel:
            base = tracer.product(base, F)
            before = angle if D[2, 2] > 0 else angle.opposite()
        else:
            base = tracer.product(tracer.turned(base, angle), F)
            before = Angle(shift=last)
    return Walk(_translation(fixed[0]), links, tracer.turned(base, before))


def _translation(C: Array) -> Vector:
    return C[:3, 3].tolist()
