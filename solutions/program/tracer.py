"""Straight-line arithmetic, recorded as it is done: no zeros and ones, no product twice."""

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
        """The angle after another turn about the same axis."""
        return Angle(self.joints + joints, self.shift + shift)

    def opposite(self) -> "Angle":
        """The angle of the turn back."""
        reversed_joints = tuple((-sign, joint) for sign, joint in self.joints)
        return Angle(reversed_joints, -self.shift)


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
        """Product of two values; factors 0, 1 and -1 cost no step."""
        if not isinstance(a, Signed):
            return self._scaled(b, a) if isinstance(b, Signed) else a * b
        if not isinstance(b, Signed):
            return self._scaled(a, b)
        left, right = sorted((a.name, b.name))
        return Signed(self._step("multiply", left, right), a.negative != b.negative)

    def add(self, a: Value, b: Value) -> Value:
        """Sum of two values; zeros, and a value and its negative, cost no step."""
        if not isinstance(a, Signed) and not isinstance(b, Signed):
            return a + b
        if a == 0.0:
            return b
        if b == 0.0:
            return a
        if a == negated(b):
            return 0.0
        return self._sum(a, b)

    def dot(self, a: Iterable[Value], b: Iterable[Value]) -> Value:
        """Scalar product of two vectors."""
        total: Value = 0.0
        for x, y in zip(a, b, strict=True):
            total = self.add(total, self.multiply(x, y))
        return total

    def plus(self, a: Vector, b: Vector) -> Vector:
        """Sum of two vectors."""
        return [self.add(x, y) for x, y in zip(a, b, strict=True)]

    def cross(self, a: Vector, b: Vector) -> Vector:
        """Cross product a x b of vectors of three."""
        return [self._minor(a, b, 1, 2), self._minor(a, b, 2, 0), self._minor(a, b, 0, 1)]

    def times(self, rows: Rows, p: Vector) -> Vector:
        """Matrix times a column."""
        return [self.dot(row, p) for row in rows]

    def product(self, rows: Rows, F: Rows) -> Rows:
        """Matrix times a matrix."""
        columns = [list(column) for column in zip(*F, strict=True)]
        product = Rows()
        for row in rows:
            product.append(self.times(columns, row))
        return product

    def turned(self, rows: Rows, angle: Angle) -> Rows:
        """Rows times Rz(angle)."""
        if not angle.joints and not angle.shift:
            return rows
        if not angle.joints:
            return self.product(rows, rotation(elementary("Rz", angle.shift)))

        c, s = self._cosine_and_sine(angle)
        turned = Rows()
        for x, y, z in rows:
            turned.append([self.dot((x, y), (c, s)), self.dot((x, y), (negated(s), c)), z])
        return turned

    def _cosine_and_sine(self, angle: Angle) -> tuple[Signed, Signed]:
        """Registers of an angle, shared with the opposite one: the sine has the other sign."""
        opposite = angle.joints[0][0] < 0
        if opposite:
            angle = angle.opposite()
        if angle not in self.angles:
            self.angles.append(angle)
        index = self.angles.index(angle)
        return Signed(f"c{index}"), Signed(f"s{index}", opposite)

    def _minor(self, a: Vector, b: Vector, i: int, j: int) -> Value:
        return self.add(self.multiply(a[i], b[j]), negated(self.multiply(a[j], b[i])))

    def _sum(self, a: Value, b: Value) -> Signed:
        """Sum of two values of which none is zero and one at least a register."""
        (left, first), (right, second) = _split(a), _split(b)
        if first == second:
            left, right = sorted((left, right), key=str)
            return Signed(self._step("add", left, right), first)
        if first:
            left, right = right, left
        if ("subtract", right, left) in self.seen:
            return Signed(self.seen["subtract", right, left], negative=True)
        return Signed(self._step("subtract", left, right))

    def _scaled(self, register: Signed, factor: float) -> Value:
        if factor == 0:
            return 0.0
        negative = register.negative != (factor < 0)
        if abs(factor) == 1:
            return Signed(register.name, negative)
        return Signed(self._step("multiply", register.name, abs(factor)), negative)

    def _step(self, operation: Operator, left: str | float, right: str | float) -> str:
        key = (operation, left, right)
        if key not in self.seen:
            self.seen[key] = f"r{len(self.seen)}"
            self.steps.append(Operation(operation, left, right, self.seen[key]))
        return self.seen[key]


def negated(value: Value) -> Value:
    """The value with the other sign; no step is spent."""
    if isinstance(value, Signed):
        return Signed(value.name, not value.negative)
    return -value


def rotation(C: Array) -> Rows:
    """Rotation of a transform, as numbers to trace with."""
    return C[:3, :3].tolist()


def registers(values: Iterable[Value]) -> list[str]:
    """Names of the registers among values, in order."""
    return [x.name for x in values if isinstance(x, Signed)]


def _split(value: Value) -> tuple[str | float, bool]:
    """A register or number, and whether it is to be negated: a number carries its own sign."""
    if isinstance(value, Signed):
        return value
    return value, False
