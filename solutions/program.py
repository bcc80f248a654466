"""The straight-line program of a chain: one walk over its rows, traced once."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from .chain import Array, Chain

Wanted = Literal["base", "tool", "pose", "frames"]
Operation = Literal["multiply", "add", "subtract"]


class Signed(NamedTuple):
    """A register, or its negative: signs cost nothing until an output needs one."""

    name: str
    negative: bool = False


Value = float | Signed
Vector = list[Value]
Sum = tuple[tuple[int, int], ...]  # (sign, joint): the angle of merged parallel axes


class Step(NamedTuple):
    """`target` = `left` operation `right`; operands are registers or floats."""

    operation: Operation
    left: str | float
    right: str | float
    target: str


@dataclass(frozen=True)
class Program:
    """Steps from joint values q0 ..., cosines c0 ... and sines s0 ... of `angles` to `outputs` in `shape`."""

    kinds: str
    angles: tuple[Sum, ...]
    steps: tuple[Step, ...]
    outputs: tuple[Value, ...]
    shape: tuple[int, ...]


class Tracer:
    """Records products and sums; zeros and ones vanish, equal products are shared."""

    def __init__(self) -> None:
        self.steps: list[Step] = []
        self.angles: list[Sum] = []
        self.seen: dict[tuple[str, str | float, str | float], str] = {}

    def multiply(self, a: Value, b: Value) -> Value:
        if isinstance(a, Signed) and isinstance(b, Signed):
            left, right = sorted((a.name, b.name))
            return Signed(self._step("multiply", left, right), a.negative != b.negative)
        if isinstance(a, Signed):
            return self.multiply(b, a)
        if not isinstance(b, Signed) or a == 0:
            return 0.0 if isinstance(b, Signed) else a * b
        name = b.name if abs(a) == 1 else self._step("multiply", b.name, abs(a))
        return Signed(name, b.negative != (a < 0))

    def add(self, a: Value, b: Value) -> Value:
        if not isinstance(a, Signed) and not isinstance(b, Signed):
            return a + b
        if 0.0 in (a, b):
            return b if a == 0.0 else a
        if a == negated(b):
            return 0.0
        (left, first), (right, second) = _split(a), _split(b)
        if first == second:
            return Signed(self._step("add", *sorted((left, right), key=str)), first)
        if first:
            left, right = right, left
        if ("subtract", right, left) in self.seen:
            return Signed(self.seen["subtract", right, left], negative=True)
        return Signed(self._step("subtract", left, right))

    def dot(self, a: Iterable[Value], b: Iterable[Value]) -> Value:
        total: Value = 0.0
        for x, y in zip(a, b, strict=True):
            total = self.add(total, self.multiply(x, y))
        return total

    def plus(self, a: Vector, b: Vector) -> Vector:
        return [self.add(x, y) for x, y in zip(a, b, strict=True)]

    def cross(self, a: Vector, b: Vector) -> Vector:
        pairs = ((1, 2), (2, 0), (0, 1))
        return [self.add(self.multiply(a[i], b[j]), negated(self.multiply(a[j], b[i]))) for i, j in pairs]

    def turned(self, base: list[Vector], angle: Sum) -> list[Vector]:
        """Rows of base Rz(angle)."""
        if not angle:
            return base
        flip = angle[0][0] < 0
        angle = tuple((-sign, joint) for sign, joint in angle) if flip else angle
        if angle not in self.angles:
            self.angles.append(angle)
        index = self.angles.index(angle)
        c, s = Signed(f"c{index}"), Signed(f"s{index}", flip)
        return [[self.dot(r[:2], (c, s)), self.dot(r[:2], (negated(s), c)), r[2]] for r in base]

    def _step(self, operation: Operation, left: str | float, right: str | float) -> str:
        key = (operation, left, right)
        if key not in self.seen:
            self.seen[key] = f"r{len(self.seen)}"
            self.steps.append(Step(operation, left, right, self.seen[key]))
        return self.seen[key]


@dataclass(frozen=True)
class Walk:
    """Rotations and origins of the frames before each joint and of the last, and the links between them."""

    rotations: list[list[Vector]]
    origins: list[Vector]
    links: list[Vector]


def negated(value: Value) -> Value:
    """The value with the other sign; no step is spent."""
    return Signed(value.name, not value.negative) if isinstance(value, Signed) else -value


def trace(chain: Chain, wanted: Wanted) -> Program:
    """Program of the Jacobian in the base or tool frame, of the tool's pose or of all axis frames."""
    tracer = Tracer()
    if wanted == "tool":
        outputs, shape = _seen_from_tool(tracer, chain), (6, chain.n)
    else:
        walk = _walk(tracer, chain.fixed, chain.kinds, [(1, joint) for joint in range(chain.n)])
        if wanted == "base":
            outputs, shape = _seen_from_base(tracer, chain.kinds, walk), (6, chain.n)
        elif wanted == "pose":
            outputs, shape = _pose(walk.rotations[-1], walk.origins[-1]), (4, 4)
        else:
            poses = [_pose(R, o) for R, o in zip(walk.rotations, walk.origins, strict=True)]
            outputs, shape = [x for pose in poses for x in pose], (chain.n + 1, 4, 4)
    plain = tuple(x if isinstance(x, Signed) else x + 0.0 for x in outputs)  # no zero prints as -0.0
    return Program(chain.kinds, tuple(tracer.angles), _live(tracer.steps, plain), plain, shape)


def _walk(tracer: Tracer, fixed: Array, kinds: str, joints: Sequence[tuple[int, int]]) -> Walk:
    """Walk E and C alternately; `joints` (sign, index) says which joint value each E takes."""
    base, p, angle = _rotation(fixed[0]), _translation(fixed[0]), Sum()
    rotations, origins, links = [tracer.turned(base, angle)], [p], list[Vector]()
    for kind, (sign, joint), C in zip(kinds, joints, fixed[1:], strict=True):
        along: Vector = [0.0, 0.0, 0.0]
        if kind == "R":
            angle = (*angle, (sign, joint))
        else:
            along = [tracer.multiply(row[2], Signed(f"q{joint}", sign < 0)) for row in rotations[-1]]
        R, F, offset = tracer.turned(base, angle), _rotation(C), _translation(C)
        links.append(tracer.plus([tracer.dot(row, offset) for row in R], along))
        p = tracer.plus(p, links[-1])
        # Rz(s) F = F Rz(+-s) where F keeps the axis: parallel axes share one angle, however they are offset
        parallel = not C[:2, 2].any()
        columns = list(zip(*F, strict=True))
        base = [[tracer.dot(row, column) for column in columns] for row in (base if parallel else R)]
        angle = tuple((s if C[2, 2] > 0 else -s, j) for s, j in angle) if parallel else ()
        rotations.append(tracer.turned(base, angle))
        origins.append(p)
    return Walk(rotations, origins, links)


def _seen_from_base(tracer: Tracer, kinds: str, walk: Walk) -> Vector:
    lever: Vector = [0.0, 0.0, 0.0]
    columns = list[Vector]()
    # summed from the tool backwards, so that p - o_i holds no link that cancels
    for kind, R, link in reversed(list(zip(kinds, walk.rotations[:-1], walk.links, strict=True))):
        lever = tracer.plus(link, lever)
        columns.append(_column(tracer, kind, [row[2] for row in R], lever))
    return [column[row] for row in range(6) for column in reversed(columns)]


def _seen_from_tool(tracer: Tracer, chain: Chain) -> Vector:
    """Walk the inverse chain, from the tool to the base: axes and points appear in tool coordinates."""
    backwards = [(-1, joint) for joint in reversed(range(chain.n))]
    walk = _walk(tracer, np.array([_inverse(C) for C in chain.fixed[::-1]]), chain.kinds[::-1], backwards)
    axes = zip(reversed(chain.kinds), walk.rotations[:-1], walk.origins[:-1], strict=True)
    columns = [_column(tracer, kind, [row[2] for row in R], [negated(x) for x in o]) for kind, R, o in axes]
    return [column[row] for row in range(6) for column in reversed(columns)]


def _column(tracer: Tracer, kind: str, z: Vector, lever: Vector) -> Vector:
    return [*tracer.cross(z, lever), *z] if kind == "R" else [*z, 0.0, 0.0, 0.0]


def _pose(R: list[Vector], p: Vector) -> Vector:
    return [x for row, t in zip(R, p, strict=True) for x in (*row, t)] + [0.0, 0.0, 0.0, 1.0]


def _live(steps: Sequence[Step], outputs: Iterable[Value]) -> tuple[Step, ...]:
    needed: set[str | float] = {x.name for x in outputs if isinstance(x, Signed)}
    kept = list[Step]()
    for step in reversed(steps):
        if step.target in needed:
            kept.append(step)
            needed |= {step.left, step.right}
    return tuple(reversed(kept))


def _split(value: Value) -> tuple[str | float, bool]:
    return value if isinstance(value, Signed) else (value, False)


def _rotation(C: Array) -> list[Vector]:
    return [[float(x) for x in row] for row in C[:3, :3]]


def _translation(C: Array) -> Vector:
    return [float(x) for x in C[:3, 3]]


def _inverse(C: Array) -> Array:
    inverse = np.eye(4)
    inverse[:3, :3] = C[:3, :3].T
    inverse[:3, 3] = -C[:3, :3].T @ C[:3, 3]
    return inverse
