"""The straight-line program of a chain: one walk over its rows, traced once."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

from ..chain import Chain
from .links import Link, Walk, folds, from_base_to_tool, from_tool_to_base
from .tracer import Angle, Operation, Rows, Signed, Sum, Tracer, Value, Vector, negated, registers

Wanted = Literal["base", "tool", "pose", "frames"]
Outputs = tuple[Vector, tuple[int, ...]]
Way = Callable[[Tracer, Chain], Outputs]


@dataclass(frozen=True)
class Program:
    """Steps from q0 ..., cosines c0 ... and sines s0 ... of `angles` to `outputs` in `shape`.

    Angle i is the sum of its joint values plus `shifts`[i].
    """

    kinds: str
    angles: tuple[Sum, ...]
    shifts: tuple[float, ...]
    steps: tuple[Operation, ...]
    outputs: tuple[Value, ...]
    shape: tuple[int, ...]


def trace(chain: Chain, wanted: Wanted) -> Program:
    """Program of the Jacobian in the base or tool frame, of the tool's pose or of all axis frames.

    It is the shortest of the ways there are, with constant turns folded into the angles or not.
    """
    ways: dict[Wanted, tuple[Way, ...]] = {
        "base": (_base,),
        "tool": (_tool, _tool_by_cross),
        "pose": (_pose,),
        "frames": (_frames,),
    }
    programs = [_traced(chain, way, folds=False) for way in ways[wanted]]
    if folds(chain):
        programs += [_traced(chain, way, folds=True) for way in ways[wanted]]
    return min(programs, key=_cost)


def used_angles(program: Program) -> list[int]:
    """Indices of the angles whose cosine or sine the program reads."""
    read = set[str | float](registers(program.outputs))
    for step in program.steps:
        read |= {step.left, step.right}
    return [i for i in range(len(program.angles)) if f"c{i}" in read or f"s{i}" in read]


def _cost(program: Program) -> int:
    """Operations, those on angles included."""
    shifted = len(program.shifts) - program.shifts.count(0.0)
    return len(program.steps) + shifted


def _traced(chain: Chain, way: Way, *, folds: bool) -> Program:
    tracer = Tracer(folds=folds)
    values, shape = way(tracer, chain)
    outputs = tuple(_without_negative_zero(x) for x in values)
    angles = tuple(x.joints for x in tracer.angles)
    shifts = tuple(x.shift for x in tracer.angles)
    return Program(chain.kinds, angles, shifts, _live(tracer.steps, outputs), outputs, shape)


def _without_negative_zero(value: Value) -> Value:
    if isinstance(value, Signed):
        return value
    return value + 0.0


def _live(steps: Sequence[Operation], outputs: Sequence[Value]) -> tuple[Operation, ...]:
    """The steps that outputs need, each just before its first use: few values wait at any time."""
    made: dict[str | float, Operation] = {step.target: step for step in steps}
    ordered = dict[str | float, Operation]()
    # depth first on a stack of our own: a long arm is deeper than Python's
    waiting: list[str | float] = [*reversed(registers(outputs))]
    while waiting:
        register = waiting.pop()
        step = made.get(register)
        if step is None or register in ordered:
            continue

        operands = (step.right, step.left)
        missing = [x for x in operands if x in made and x not in ordered]
        if missing:
            waiting += [register, *missing]
        else:
            ordered[register] = step
    return tuple(ordered.values())


def _base(tracer: Tracer, chain: Chain) -> Outputs:
    walk = from_base_to_tool(tracer, chain)
    levers = _levers(tracer, walk)
    columns = [_column(tracer, link, p) for link, p in zip(walk.links, levers, strict=True)]
    return _by_rows(columns)


def _levers(tracer: Tracer, walk: Walk) -> list[Vector]:
    """The tool as seen from each joint, in axes of the joint's base.

    They are summed from the tool backwards, so that p - o_i holds no link that cancels.
    """
    p: Vector = [0.0, 0.0, 0.0]
    levers = list[Vector]()
    for link in reversed(walk.links):
        p = tracer.times(link.F, p)
        back = link.angle.opposite()
        if link.parallel:
            p = tracer.plus(_turned(tracer, link.offset, back), p)
        else:
            p = _turned(tracer, tracer.plus(link.offset, p), back)
        p = _slid(tracer, p, link)
        levers.append(p)
    return levers[::-1]


def _tool(tracer: Tracer, chain: Chain) -> Outputs:
    walk = from_tool_to_base(tracer, chain)
    # from the tool to each joint, in axes of its base
    p = tracer.product([walk.start], walk.links[0].base)[0]
    columns = list[Vector]()
    for link in walk.links:
        columns.append(_column(tracer, link, [negated(x) for x in p]))
        p = _slid(tracer, p, link)
        if link.parallel:
            p = tracer.plus(p, _turned(tracer, link.offset, link.angle.opposite()))
        else:
            p = tracer.plus(_turned(tracer, p, link.angle), link.offset)
        p = tracer.product([p], link.F)[0]
    return _by_rows(columns[::-1])


def _tool_by_cross(tracer: Tracer, chain: Chain) -> Outputs:
    """All in tool axes: shorter where links are many and axes few, as in the Stanford arm."""
    walk = from_tool_to_base(tracer, chain)
    columns = list[Vector]()
    for link, o in zip(walk.links, _origins(tracer, walk), strict=False):
        if link.kind == "R":
            columns.append([*tracer.cross(o, link.z), *link.z])
        else:
            columns.append([*link.z, 0.0, 0.0, 0.0])
    return _by_rows(columns[::-1])


def _column(tracer: Tracer, link: Link, lever: Vector) -> Vector:
    """Axis and moment of a joint; in the axes of its base z x lever = (-y, x, 0)."""
    if link.kind == "P":
        return [*link.z, 0.0, 0.0, 0.0]
    x, y, _ = lever
    return [*tracer.times(link.base, [negated(y), x, 0.0]), *link.z]


def _turned(tracer: Tracer, p: Vector, angle: Angle) -> Vector:
    """The vector Rz(-angle) p: as a row, p times Rz(angle)."""
    return tracer.turned([p], angle)[0]


def _slid(tracer: Tracer, p: Vector, link: Link) -> Vector:
    x, y, z = p
    return [x, y, tracer.add(z, link.along)]


def _by_rows(columns: list[Vector]) -> Outputs:
    entries = Vector()
    for row in range(6):
        entries += [column[row] for column in columns]
    return entries, (6, len(columns))


def _origins(tracer: Tracer, walk: Walk) -> list[Vector]:
    """Origins of the frames before each joint and of the last."""
    origins = [walk.start]
    for link in walk.links:
        along = [tracer.multiply(x, link.along) for x in link.z]
        R = tracer.turned(link.base, link.angle)
        step = tracer.plus(tracer.times(R, link.offset), along)
        origins.append(tracer.plus(origins[-1], step))
    return origins


def _pose(tracer: Tracer, chain: Chain) -> Outputs:
    walk = from_base_to_tool(tracer, chain)
    lever = _levers(tracer, walk)[0]
    arm = tracer.times(walk.links[0].base, lever)
    return _transform(walk.end, tracer.plus(walk.start, arm)), (4, 4)


def _frames(tracer: Tracer, chain: Chain) -> Outputs:
    walk = from_base_to_tool(tracer, chain)
    rotations = [tracer.turned(link.base, link.before) for link in walk.links]
    rotations.append(walk.end)
    entries = Vector()
    for R, o in zip(rotations, _origins(tracer, walk), strict=True):
        entries += _transform(R, o)
    return entries, (chain.n + 1, 4, 4)


def _transform(R: Rows, p: Vector) -> Vector:
    entries = Vector()
    for row, x in zip(R, p, strict=True):
        entries += [*row, x]
    return [*entries, 0.0, 0.0, 0.0, 1.0]
