"""The straight-line program of a chain: one walk over its rows, traced once."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from ..chain import Array, Chain, elementary, snapped_transforms
from ..rotation import inverse_transform
from .tracer import Angle, Operation, Rows, Signed, Sum, Tracer, Value, Vector, negated, rotation

Wanted = Literal["base", "tool", "pose", "frames"]


@dataclass(frozen=True)
class Program:
    """Steps from joint values q0 ..., cosines c0 ... and sines s0 ... of `angles` to `outputs` in `shape`.

    Angle i is the sum of its joint values plus `shifts`[i].
    """

    kinds: str
    angles: tuple[Sum, ...]
    shifts: tuple[float, ...]
    steps: tuple[Operation, ...]
    outputs: tuple[Value, ...]
    shape: tuple[int, ...]


class Link(NamedTuple):
    """A joint and the constant behind it, Rz(angle) Tz(along) [F offset], in the frame of rotation `base`.

    `angle` is the sum of the joint's own and of the parallel ones `before` it.
    """

    kind: str
    base: Rows
    before: Angle
    angle: Angle
    along: Value
    F: Rows
    offset: Vector
    parallel: bool


class Walk(NamedTuple):
    """C0 E1 C1 ... En Cn: the translation of C0, the links, and the rotation behind the last one."""

    start: Vector
    links: list[Link]
    end: Rows


Outputs = tuple[Vector, tuple[int, ...]]


def trace(chain: Chain, wanted: Wanted) -> Program:
    """Program of the Jacobian in the base or tool frame, of the tool's pose or of all axis frames."""
    ways = {
        "base": (_base,),
        "tool": (_tool, _tool_by_cross),
        "pose": (_pose,),
        "frames": (_frames,),
    }
    programs = [_traced(chain, way, folds=folds) for folds in (False, True) for way in ways[wanted]]
    return min(
        programs,
        key=lambda program: len(program.steps) + len(program.shifts) - program.shifts.count(0.0),
    )


def _traced(chain: Chain, way: Callable[[Tracer, Chain], Outputs], *, folds: bool) -> Program:
    tracer = Tracer(folds=folds)
    outputs, shape = way(tracer, chain)
    plain = tuple(
        x if isinstance(x, Signed) else x + 0.0 for x in outputs
    )  # no zero prints as -0.0
    angles, shifts = tuple(x.joints for x in tracer.angles), tuple(x.shift for x in tracer.angles)
    return Program(chain.kinds, angles, shifts, _live(tracer.steps, plain), plain, shape)


def _walk(tracer: Tracer, fixed: Array, kinds: str, joints: Sequence[tuple[int, int]]) -> Walk:
    """Walk E and C alternately; `joints` (sign, index) says which joint value each E takes."""
    base, before, links = rotation(fixed[0]), Angle(), list[Link]()
    for kind, (sign, joint), fixture in zip(kinds, joints, fixed[1:], strict=True):
        shift, C, behind = _folded(fixture) if tracer.folds else (0.0, fixture, 0.0)
        angle = before.plus(((sign, joint),) if kind == "R" else (), shift)
        along: Value = 0.0 if kind == "R" else Signed(f"q{joint}", sign < 0)
        # Rz(s) F = F Rz(+-s) where F keeps the axis: parallel axes share one angle, however they are offset
        F, parallel = rotation(C), not C[:2, 2].any()
        links.append(Link(kind, base, before, angle, along, F, _translation(C), parallel))
        base = tracer.product(base if parallel else tracer.turned(base, angle), F)
        before = (angle if C[2, 2] > 0 else angle.opposite()) if parallel else Angle(shift=behind)
    return Walk(_translation(fixed[0]), links, tracer.turned(base, before))


def _there(tracer: Tracer, chain: Chain) -> Walk:
    return _walk(tracer, chain.fixed, chain.kinds, [(1, joint) for joint in range(chain.n)])


def _back(tracer: Tracer, chain: Chain) -> Walk:
    """Walk the inverse chain, from the tool to the base: axes and points appear in tool coordinates."""
    fixed = inverse_transform(chain.fixed[::-1])
    return _walk(
        tracer, fixed, chain.kinds[::-1], [(-1, joint) for joint in reversed(range(chain.n))]
    )


def _base(tracer: Tracer, chain: Chain) -> Outputs:
    walk = _there(tracer, chain)
    levers = _levers(tracer, walk)
    return _by_rows([_column(tracer, link, p) for link, p in zip(walk.links, levers, strict=True)])


def _levers(tracer: Tracer, walk: Walk) -> list[Vector]:
    """The tool as seen from each joint, in axes of the joint's base.

    They are summed from the tool backwards, so that p - o_i holds no link that cancels.
    """
    p: Vector = [0.0, 0.0, 0.0]
    levers = list[Vector]()
    for link in reversed(walk.links):
        p = [tracer.dot(row, p) for row in link.F]
        if link.parallel:
            p = tracer.plus(tracer.turned([link.offset], link.angle.opposite())[0], p)
        else:
            p = tracer.turned([tracer.plus(link.offset, p)], link.angle.opposite())[0]
        p = [*p[:2], tracer.add(p[2], link.along)]
        levers.append(p)
    return levers[::-1]


def _tool(tracer: Tracer, chain: Chain) -> Outputs:
    walk = _back(tracer, chain)
    p = tracer.product([walk.start], walk.links[0].base)[
        0
    ]  # from the tool to each joint, in axes of its base
    columns = list[Vector]()
    for link in walk.links:
        columns.append(_column(tracer, link, [negated(x) for x in p]))
        p = [*p[:2], tracer.add(p[2], link.along)]
        if link.parallel:
            p = tracer.plus(p, tracer.turned([link.offset], link.angle.opposite())[0])
        else:
            p = tracer.plus(tracer.turned([p], link.angle)[0], link.offset)
        p = tracer.product([p], link.F)[0]
    return _by_rows(columns[::-1])


def _tool_by_cross(tracer: Tracer, chain: Chain) -> Outputs:
    """All in tool axes: shorter where links are many and axes few, as in the Stanford arm."""
    walk, columns = _back(tracer, chain), list[Vector]()
    for link, o in zip(walk.links, _origins(tracer, walk), strict=False):
        z = [row[2] for row in link.base]
        columns.append([*tracer.cross(o, z), *z] if link.kind == "R" else [*z, 0.0, 0.0, 0.0])
    return _by_rows(columns[::-1])


def _column(tracer: Tracer, link: Link, lever: Vector) -> Vector:
    """Axis and moment of a joint; in the axes of its base z x lever = (-y, x, 0)."""
    z = [row[2] for row in link.base]
    if link.kind == "P":
        return [*z, 0.0, 0.0, 0.0]
    return [*(tracer.dot(row[:2], (negated(lever[1]), lever[0])) for row in link.base), *z]


def _by_rows(columns: list[Vector]) -> Outputs:
    return [column[row] for row in range(6) for column in columns], (6, len(columns))


def _origins(tracer: Tracer, walk: Walk) -> list[Vector]:
    """Origins of the frames before each joint and of the last."""
    origins = [walk.start]
    for link in walk.links:
        along = [tracer.multiply(row[2], link.along) for row in link.base]
        R = tracer.turned(link.base, link.angle)
        step = tracer.plus([tracer.dot(row, link.offset) for row in R], along)
        origins.append(tracer.plus(origins[-1], step))
    return origins


def _pose(tracer: Tracer, chain: Chain) -> Outputs:
    walk = _there(tracer, chain)
    lever = _levers(tracer, walk)[0]
    p = tracer.plus(walk.start, [tracer.dot(row, lever) for row in walk.links[0].base])
    return _transform(walk.end, p), (4, 4)


def _frames(tracer: Tracer, chain: Chain) -> Outputs:
    walk = _there(tracer, chain)
    rotations = [*(tracer.turned(link.base, link.before) for link in walk.links), walk.end]
    poses = [_transform(R, o) for R, o in zip(rotations, _origins(tracer, walk), strict=True)]
    return [x for pose in poses for x in pose], (chain.n + 1, 4, 4)


def _transform(R: Rows, p: Vector) -> Vector:
    return [x for row, t in zip(R, p, strict=True) for x in (*row, t)] + [0.0, 0.0, 0.0, 1.0]


def _live(steps: Sequence[Operation], outputs: Iterable[Value]) -> tuple[Operation, ...]:
    """The steps that outputs need, each just before its first use: so that few values wait at any time."""
    made: dict[str | float, Operation] = {step.target: step for step in steps}
    waiting = list[str | float]()
    waiting += [x.name for x in outputs if isinstance(x, Signed)][::-1]
    ordered = dict[str | float, Operation]()
    while waiting:
        step = made.get(waiting[-1])
        missing = (
            [x for x in (step.right, step.left) if x in made and x not in ordered] if step else []
        )
        waiting += missing
        if not missing:
            waiting.pop()
            if step:
                ordered.setdefault(step.target, step)
    return tuple(ordered.values())


def _folded(C: Array) -> tuple[float, Array, float]:
    """C as Rz(first) D Rz(last) with more zeros in D: a dense rotation becomes one about x.

    Quarter turns stay in D, where they are exact, and so does all of C between parallel axes.
    """
    x, y = C[0, 2], C[1, 2]
    first = float(np.arctan2(x, -y)) if x and y else 0.0
    D = snapped_transforms(elementary("Rz", -first) @ C)
    level = D[1] if D[0, 2] else D[0]  # the row that only a last turn about z can have filled
    last = float(np.arctan2(-level[1], level[0])) if (x or y) and level[0] and level[1] else 0.0
    return first, snapped_transforms(D @ elementary("Rz", -last)), last


def _translation(C: Array) -> Vector:
    return [float(x) for x in C[:3, 3]]
