"""A traced program for batches: numpy calls in place on rows, a block of configurations a time."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..chain import Array
from .source import function_of
from .tracer import Signed, registers
from .walk import Program, used_angles

# configurations per block: a numpy call costs as much as 1000 products, 16384 rows leave the cache
BLOCK = 6144
# numbers between rows: at a distance of a power of two they would share a few lines of the cache
PAD = 8

# angle in, cosine and sine out; the sine may take the angle's place
Trig = Callable[[Array, Array, Array], None]


class Kernel(NamedTuple):
    """`run` takes a block of q, cosines, sines, and each row of them, of scratch and of outputs."""

    run: Callable[..., None]
    angles: int
    scratch: int


def half_angle(angle: Array, cosine: Array, sine: Array) -> None:
    """Cosine and sine from t = tan(angle / 2), to 4e-16 at every finite angle.

    numpy's tan costs a sixth of its sin with AVX-512, and little more than one sin without.
    Near +-pi, where t grows beyond bounds, nothing is lost: with a relative error e of t the cosine
    is wrong by sin(angle)^2 e and the sine by sin(angle) cos(angle) e, never by more than e.
    numpy's tan has e < 4e-16 wherever the angle lies, and no float is so near to pi / 2 that t^2
    overflows; so there is nothing to reduce beforehand.
    """
    np.multiply(angle, 0.5, sine)
    np.tan(sine, sine)
    np.multiply(sine, sine, cosine)
    np.add(cosine, 1.0, cosine)
    np.divide(2.0, cosine, cosine)
    np.multiply(sine, cosine, sine)
    np.subtract(cosine, 1.0, cosine)


def direct(angle: Array, cosine: Array, sine: Array) -> None:
    """Cosine and sine from numpy's own functions."""
    np.cos(angle, cosine)
    np.sin(angle, sine)


def rows(program: Program, trig: Trig = half_angle) -> Callable[[Array, Array], None]:
    """Function of a batch q (N, n) that fills C-contiguous out (N, outputs), a block at a time."""
    kernel, outputs = _kernel(program, trig), len(program.outputs)
    slides = [i for i, kind in enumerate(program.kinds) if kind == "P"]
    constants = [(i, x) for i, x in enumerate(program.outputs) if isinstance(x, float)]

    def fill(q: Array, out: Array) -> None:
        # every call has its own rows, so that threads may share a chain
        width = max(1, min(BLOCK, len(q)))
        memory = np.empty((2 * kernel.angles + kernel.scratch, width + PAD))
        # neighbours in the output stand side by side: moved as one complex number they cost half
        pairs = np.empty((outputs // 2, width + PAD, 2))
        values = [pairs[i // 2, :, i % 2] for i in range(outputs)]
        for index, constant in constants:
            values[index][:] = constant

        result, moved = out.view(np.complex128), pairs.view(np.complex128)[..., 0].T
        views, m = list[Array](), 0
        for start in range(0, len(q), width):
            block = q[start : start + width]
            # a view costs as much as 300 products: made for whole blocks, and for the last
            if len(block) != m:
                m = len(block)
                views = _views(memory[:, :m], kernel.angles)
                views += [row[:m] for row in values]
            kernel.run(block, *views)
            here = result[start : start + m]
            here[...] = moved[:m]
            # no -0.0 in a result: only where a sine or a slide is zero can a product be
            cosines = memory[: kernel.angles, :m]
            if not (cosines.max(initial=-1.0) < 1.0 and (not slides or block[:, slides].all())):
                here += 0.0

    return fill


def _views(part: Array, angles: int) -> list[Array]:
    """Cosines and sines as blocks, which one call turns, and every row by itself, scratch too."""
    return [part[:angles], part[angles : 2 * angles], *part]


def _kernel(program: Program, trig: Trig) -> Kernel:
    """Calls in order: the angles into the sines' rows, their cosines and sines, steps, outputs."""
    angles = used_angles(program)
    lines = _sums(program, angles)
    if angles:
        lines.append("  turn(sines, cosines, sines)")
    steps, scratch = _steps(program)
    lines += [*steps, "  pass"]

    names = ["q", "cosines", "sines"]
    names += [f"c{i}" for i in angles]
    names += [f"s{i}" for i in angles]
    names += [f"x{i}" for i in range(scratch)]
    names += [f"o{i}" for i in range(len(program.outputs))]
    functions = {
        "multiply": np.multiply,
        "add": np.add,
        "subtract": np.subtract,
        "copy": np.positive,
        "turn": trig,
    }
    run = function_of(f"kernel({', '.join(names)})", lines, functions)
    return Kernel(run, len(angles), scratch)


def _sums(program: Program, angles: list[int]) -> list[str]:
    """Calls that sum the joint values of each angle, and its shift, in the row of its sine."""
    lines = list[str]()
    for index in angles:
        # the first sign is positive: the trace sees to it
        (_, first), *others = program.angles[index]
        terms = list[tuple[str, str]]()
        for sign, joint in others:
            operation = "add" if sign > 0 else "subtract"
            terms.append((operation, f"q[:, {joint}]"))
        if program.shifts[index]:
            terms.append(("add", repr(program.shifts[index])))

        total = f"q[:, {first}]"
        if not terms:
            lines.append(f"  copy({total}, s{index})")
        for operation, term in terms:
            lines.append(f"  {operation}({total}, {term}, s{index})")
            total = f"s{index}"
    return lines


class _Scratch:
    """Rows x0, x1 ... for values in between, used again as soon as their value is dead."""

    def __init__(self) -> None:
        self.free: list[str] = []
        self.count = 0

    def take(self) -> str:
        if self.free:
            return self.free.pop()
        self.count += 1
        return f"x{self.count - 1}"

    def release(self, row: str) -> None:
        """Only rows of scratch are used again: outputs, joint values, cosines and sines stay."""
        if row.startswith("x"):
            self.free.append(row)


def _steps(program: Program) -> tuple[list[str], int]:
    """Calls of the steps and outputs, and how many scratch rows they need."""
    where, last = _places(program), _last_uses(program)
    scratch = _Scratch()
    lines = list[str]()
    for i, step in enumerate(program.steps):
        left = where.get(step.left, str(step.left))
        right = where.get(step.right, str(step.right))
        # before the result gets its row: it may take that of an operand which dies here
        if last[step.left] == i:
            scratch.release(left)
        if last[step.right] == i and right != left:
            scratch.release(right)

        if step.target not in where:
            where[step.target] = scratch.take()
        lines.append(f"  {step.operation}({left}, {right}, {where[step.target]})")
    return lines + _output_calls(program, where), scratch.count


def _output_calls(program: Program, where: dict[str | float, str]) -> list[str]:
    """Calls that fill the output rows which no step has filled; those of constants are filled."""
    lines = list[str]()
    for i, x in enumerate(program.outputs):
        if not isinstance(x, Signed) or where.get(x.name) == f"o{i}":
            continue
        source = where.get(x.name, x.name)
        if x.negative:
            lines.append(f"  subtract(0.0, {source}, o{i})")  # -x would be -0.0 where x is 0.0
        else:
            lines.append(f"  copy({source}, o{i})")
    return lines


def _places(program: Program) -> dict[str | float, str]:
    """Joint values, read where they stand, and registers written straight into an output row."""
    places = dict[str | float, str]()
    for joint in range(len(program.kinds)):
        places[f"q{joint}"] = f"q[:, {joint}]"
    for i, x in enumerate(program.outputs):
        if isinstance(x, Signed) and not x.negative and x.name.startswith("r"):
            places.setdefault(x.name, f"o{i}")
    return places


def _last_uses(program: Program) -> dict[str | float, int]:
    """The last step that reads each operand; outputs are read after all of them."""
    last = dict[str | float, int]()
    for i, step in enumerate(program.steps):
        last[step.left] = last[step.right] = i
    for name in registers(program.outputs):
        last[name] = len(program.steps)
    return last
