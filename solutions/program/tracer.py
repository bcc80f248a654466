"""Straight-line arithmetic, recorded as it is done: zeros and ones vanish, equal products are shared."""

from collections.abc import Iterable
from typing import Literal, NamedTuple

from ..chain import Array, elementary

Operator = Literal["multiply", "add", "subtract"]


class Signed(NamedTuple):
    """A register, or its negative: signs cost nothing until an output needs one."""

    name: str
    negative: bool = False


Value = float | Signed
Vector = list[Value]
Rows = list[Vector]
Sum = tuple[tuple[int, int], ...]  # (sign, joint)


class Angle(NamedTuple):
    """Angle of merged parallel axes: a sum of joint values and a constant `shift` [rad]."""

    joints: Sum = ()
    shift: float = 0.0

    def plus(self, joints: Sum, shift: float) -> "Angle":
        return Angle(self.joints + joints, self.shift + shift)

    def opposite(self) -> "Angle":
        return Angle(tuple((-sign, joint) for sign, joint in self.joints), -self.shift)


class Operation(NamedTuple):
    """`target` = `left` operation `right`; operands are registers or floats."""

    operation: Operator
    left: str | float
    right: str | float
    target: str


class Tracer:
    """Records products and sums; zeros and ones vanish, equal products are shared.

    If it `folds`, constant turns about the axes of joints become shifts of their angles.
    """

    def __init__(self, *, folds: bool = False) -> None:
        self.folds = folds
        self.steps: list[Operation] = []
        self.angles: list[Angle] = []
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
        return [
            self.add(self.multiply(a[i], b[j]), negated(self.multiply(a[j], b[i])))
            for i, j in pairs
        ]

    def product(self, rows: Rows, F: Rows) -> Rows:
        columns = [list(column) for column in zip(*F, strict=True)]
        return [[self.dot(row, column) for column in columns] for row in rows]

    def turned(self, rows: Rows, angle: Angle) -> Rows:
        """Rows times Rz(angle)."""
        if not angle.joints:
            return (
                self.product(rows, rotation(elementary("Rz", angle.shift))) if angle.shift else rows
            )
        flip = angle.joints[0][0] < 0
        angle = angle.opposite() if flip else angle
        if angle not in self.angles:
            self.angles.append(angle)
        index = self.angles.index(angle)
        c, s = Signed(f"c{index}"), Signed(f"s{index}", flip)
        return [[self.dot(r[:2], (c, s)), self.dot(r[:2], (negated(s), c)), r[2]] for r in rows]

    def _step(self, operation: Operator, left: str | float, right: str | float) -> str:
        key = (operation, left, right)
        if key not in self.seen:
            self.seen[key] = f"r{len(self.seen)}"
            self.steps.append(Operation(operation, left, right, self.seen[key]))
        return self.seen[key]


def negated(value: Value) -> Value:
    """The value with the other sign; no step is spent."""
    return Signed(value.name, not value.negative) if isinstance(value, Signed) else -value


def rotation(C: Array) -> Rows:
    """Rotation of a transform, as numbers to trace with."""
    return [[float(x) for x in row] for row in C[:3, :3]]


def _split(value: Value) -> tuple[str | float, bool]:
    return value if isinstance(value, Signed) else (value, False)
