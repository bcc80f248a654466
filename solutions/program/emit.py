"""From a traced program to functions: plain math for one configuration, rows in place for batches."""

import math
import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..chain import Array, Chain
from .tracer import Signed
from .walk import Program, Wanted, trace

DOUBLE = np.dtype(np.float64)
BLOCK = 6144  # configurations per block: a numpy call costs as much as 1000 products, 16384 rows leave the cache
PAD = 8  # numbers between rows: at a distance of a power of two they would all share a few lines of the cache
FEW = 12  # up to so many configurations, plain math one by one is faster than rows
SYMBOLS = {"multiply": "*", "add": "+", "subtract": "-"}

Trig = Callable[
    [Array, Array, Array], None
]  # angle in, cosine and sine out; the sine may take the angle's place


@dataclass(frozen=True)
class Compiled:
    """`single` takes n floats; `rows` takes (N, n) and fills (N, outputs)."""

    shape: tuple[int, ...]
    single: Callable[[list[float]], Array]
    rows: Callable[[Array, Array], None]


class Kernel(NamedTuple):
    """`run` takes a block of q, the cosines, the sines and every row of them, of the outputs and of scratch."""

    run: Callable[..., None]
    angles: int
    scratch: int


def evaluate(chain: Chain, wanted: Wanted, q: Array, out: Array | None = None) -> Array:
    """Values of shape (..., *shape) of a program of the chain at validated q (..., n), in `out` if given."""
    functions: Compiled = chain.compiled.get(wanted) or compiled(chain, wanted)
    if q.ndim == 1 and out is None:
        return functions.single(q.tolist())
    result = np.empty((*q.shape[:-1], *functions.shape)) if out is None else out
    batch = q.reshape(-1, chain.n)
    if len(batch) > FEW:
        functions.rows(batch, result.reshape(-1, math.prod(functions.shape)))
    else:
        for place, values in zip(result.reshape(-1, *functions.shape), batch.tolist(), strict=True):
            place[...] = functions.single(values)
    return result


def plain(chain: Chain, wanted: Wanted, q: ArrayLike) -> Array | None:
    """Value at one configuration that is a finite float64 array (n,), once the program is compiled; else None.

    The plain call of an iteration: what would be None may be right or wrong, and is looked at with more care.
    """
    if type(q) is not np.ndarray or q.dtype is not DOUBLE or q.ndim != 1:
        return None
    functions: Compiled | None = chain.compiled.get(wanted)
    values = q.tolist()
    if functions is None or len(values) != len(chain.kinds) or not math.isfinite(sum(values)):
        return None
    return functions.single(values)


def compiled(chain: Chain, wanted: Wanted) -> Compiled:
    """Functions of one program of the chain, made at first use and kept on the chain."""
    functions = chain.compiled.get(wanted)
    if functions is None:
        program = trace(chain, wanted)
        # two threads may both compile; setdefault lets one result win
        functions = chain.compiled.setdefault(
            wanted, Compiled(program.shape, single(program), rows(program))
        )
    return functions


def single(program: Program) -> Callable[[list[float]], Array]:
    """Function of one configuration in plain float arithmetic."""
    lines = [f"  {', '.join(f'q{i}' for i in range(len(program.kinds)))}, = q"]
    for index in used_angles(program):
        angle = "".join(
            f"{'+' if sign > 0 else '-'}q{joint}" for sign, joint in program.angles[index]
        )
        shift = f" + {program.shifts[index]!r}" if program.shifts[index] else ""
        lines += [f"  a = {angle}{shift}", f"  c{index} = cos(a)", f"  s{index} = sin(a)"]
    lines += [f"  {s.target} = {s.left} {SYMBOLS[s.operation]} {s.right}" for s in program.steps]
    outputs = [
        f"{'-' * x.negative}{x.name}" if isinstance(x, Signed) else repr(x) for x in program.outputs
    ]
    # packing floats into an empty array costs half of np.array(...).reshape(...)
    lines += [
        f"  out = empty({program.shape})",
        f"  pack(out, 0, {', '.join(outputs)})",
        "  return out",
    ]
    pack = struct.Struct(f"{len(outputs)}d").pack_into
    return _function(
        "single(q)", lines, {"cos": math.cos, "sin": math.sin, "empty": np.empty, "pack": pack}
    )


def half_angle(angle: Array, cosine: Array, sine: Array) -> None:
    """Cosine and sine from t = tan(angle / 2), to 4e-16 at every finite angle.

    numpy's tan costs a sixth of its sin with AVX-512, and little more than one sin without.
    Near +-pi, where t grows beyond bounds, nothing is lost: with a relative error e of t the cosine is wrong by
    sin(angle)^2 e and the sine by sin(angle) cos(angle) e, never by more than e. numpy's tan has e < 4e-16 wherever
    the angle lies, and no float is so near to pi / 2 that t^2 overflows; so there is nothing to reduce beforehand.
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
    """Function of a batch q (N, n) that fills C-contiguous out (N, outputs), one block of rows at a time."""
    kernel, outputs = _kernel(program, trig), len(program.outputs)
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
            if (
                len(block) != m
            ):  # a view costs as much as 300 products: made for whole blocks, and for the last
                m = len(block)
                part = memory[:, :m]
                cosines, sines = part[: kernel.angles], part[kernel.angles : 2 * kernel.angles]
                views = [cosines, sines, *part, *(row[:m] for row in values)]
            kernel.run(block, *views)
            result[start : start + m] = moved[:m]

    return fill


def used_angles(program: Program) -> list[int]:
    """Indices of the angles whose cosine or sine the program reads."""
    read = {x for step in program.steps for x in (step.left, step.right)}
    read |= {x.name for x in program.outputs if isinstance(x, Signed)}
    return [i for i in range(len(program.angles)) if f"c{i}" in read or f"s{i}" in read]


def _kernel(program: Program, trig: Trig) -> Kernel:
    """In-place numpy calls: the angles into the sines' rows, their cosines and sines, the steps, the outputs."""
    angles, (steps, scratch) = used_angles(program), _steps(program)
    lines = _sums(program, angles)
    lines += ["  turn(sines, cosines, sines)"] * bool(angles)
    names = [f"{letter}{i}" for letter in "cs" for i in angles] + [f"x{i}" for i in range(scratch)]
    names += [f"o{i}" for i in range(len(program.outputs))]
    functions = {"multiply": np.multiply, "add": np.add, "subtract": np.subtract, "turn": trig}
    functions |= {"negative": np.negative, "copy": np.positive}
    signature = f"kernel(q, cosines, sines, {', '.join(names)})"
    return Kernel(_function(signature, [*lines, *steps, "  pass"], functions), len(angles), scratch)


def _sums(program: Program, angles: list[int]) -> list[str]:
    lines = list[str]()
    for index in angles:
        (_, joint), *others = program.angles[
            index
        ]  # the first sign is positive: the trace sees to it
        total = f"q[:, {joint}]"
        terms = [("add" if sign > 0 else "subtract", f"q[:, {other}]") for sign, other in others]
        terms += [("add", repr(program.shifts[index]))] * bool(program.shifts[index])
        for operation, term in terms:
            lines.append(f"  {operation}({total}, {term}, s{index})")
            total = f"s{index}"
        if not terms:
            lines.append(f"  copy({total}, s{index})")
    return lines


def _steps(program: Program) -> tuple[list[str], int]:
    """Calls of the steps and outputs; scratch rows are used again as soon as their value is dead."""
    where, last = _places(program), _last_uses(program)
    free, count, lines = list[str](), 0, list[str]()
    for i, step in enumerate(program.steps):
        left, right = (where.get(x, str(x)) for x in (step.left, step.right))
        for x in {step.left, step.right}:
            if last[x] == i and where.get(x, "").startswith("x"):
                free.append(where[x])
        if step.target not in where:
            if not free:
                free.append(f"x{count}")
                count += 1
            where[step.target] = free.pop()
        lines.append(f"  {step.operation}({left}, {right}, {where[step.target]})")
    for i, x in enumerate(program.outputs):
        if isinstance(x, Signed) and where.get(x.name) != f"o{i}":
            lines.append(
                f"  {'negative' if x.negative else 'copy'}({where.get(x.name, x.name)}, o{i})"
            )
    return lines, count


def _places(program: Program) -> dict[str | float, str]:
    """Joint values, read where they stand, and registers that are written straight into their output row."""
    places: dict[str | float, str] = {
        f"q{joint}": f"q[:, {joint}]" for joint in range(len(program.kinds))
    }
    for i, x in enumerate(program.outputs):
        if isinstance(x, Signed) and not x.negative and x.name.startswith("r"):
            places.setdefault(x.name, f"o{i}")
    return places


def _last_uses(program: Program) -> dict[str | float, int]:
    last = dict[str | float, int]()
    for i, step in enumerate(program.steps):
        last |= {step.left: i, step.right: i}
    return last | {x.name: len(program.steps) for x in program.outputs if isinstance(x, Signed)}


def _function(signature: str, lines: list[str], names: dict[str, Any]) -> Callable[..., Any]:
    source = "\n".join([f"def {signature}:", *lines])
    exec(source, names)  # noqa: S102  only float literals and register names can occur in it
    return names[signature.partition("(")[0]]
