"""From a traced program to functions: plain math for one configuration, rows in place for batches."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .chain import Array, Chain
from .program import Program, Signed, Sum, Wanted, trace

BLOCK = 2048  # configurations per block: the rows of one block stay in the cache
SYMBOLS = {"multiply": "*", "add": "+", "subtract": "-"}


Trig = Callable[[Array, Array, Array], None]  # angle in, cosine and sine out


@dataclass(frozen=True)
class Compiled:
    """`single` takes n floats; `rows` takes (N, n) and fills (N, outputs)."""

    shape: tuple[int, ...]
    single: Callable[[list[float]], Array]
    rows: Callable[[Array, Array], None]


def evaluate(chain: Chain, wanted: Wanted, q: Array, out: Array | None = None) -> Array:
    """Values of shape (..., *shape) of a program of the chain at validated q (..., n), in `out` if given."""
    functions = compiled(chain, wanted)
    if q.ndim == 1 and out is None:
        return functions.single(q.tolist())
    shape = (*q.shape[:-1], *functions.shape)
    result = np.empty(shape) if out is None else out
    functions.rows(q.reshape(-1, chain.n), result.reshape(-1, math.prod(functions.shape)))
    return result


def compiled(chain: Chain, wanted: Wanted) -> Compiled:
    """Functions of one program of the chain, made at first use and kept on the chain."""
    functions = chain.compiled.get(wanted)
    if functions is None:
        program = trace(chain, wanted)
        # two threads may both compile; setdefault lets one result win
        functions = chain.compiled.setdefault(wanted, Compiled(program.shape, single(program), rows(program)))
    return functions


def single(program: Program) -> Callable[[list[float]], Array]:
    """Function of one configuration in plain float arithmetic."""
    lines = [f"  {', '.join(f'q{i}' for i in range(len(program.kinds)))}, = q"]
    for index in used_angles(program):
        angle = "".join(f"{'+' if sign > 0 else '-'}q{joint}" for sign, joint in program.angles[index])
        lines += [f"  a = {angle}", f"  c{index} = cos(a)", f"  s{index} = sin(a)"]
    lines += [f"  {s.target} = {s.left} {SYMBOLS[s.operation]} {s.right}" for s in program.steps]
    outputs = [f"{'-' * x.negative}{x.name}" if isinstance(x, Signed) else repr(x) for x in program.outputs]
    lines += [f"  return array(({', '.join(outputs)},)).reshape({program.shape})"]
    names = {"cos": math.cos, "sin": math.sin, "array": np.array}
    return _function("single(q)", lines, names)


def rows(program: Program, trig: Trig | None = None) -> Callable[[Array, Array], None]:
    """Function of a batch q (N, n) that fills out (N, outputs), one block of rows at a time."""
    kernel, buffers = _kernel(program)
    angles = [(index, program.angles[index]) for index in used_angles(program)]
    constants = [(i, x) for i, x in enumerate(program.outputs) if isinstance(x, float)]
    turn = trig or half_angle

    def fill(q: Array, out: Array) -> None:
        # every call has its own buffers, so that threads may share a chain
        width = min(BLOCK, len(q))
        columns, values = np.empty((q.shape[1], width)), np.empty((out.shape[1], width))
        scratch, cosines = np.empty((buffers, width)), np.empty((len(program.angles), width))
        sines = np.empty_like(cosines)
        for index, constant in constants:
            values[index] = constant
        for start in range(0, len(q), BLOCK):
            m = min(BLOCK, len(q) - start)
            columns[:, :m] = q[start : start + m].T
            for index, angle in angles:
                turn(_sum(angle, columns[:, :m], sines[index, :m]), cosines[index, :m], sines[index, :m])
            kernel(columns[:, :m], cosines[:, :m], sines[:, :m], values[:, :m], scratch[:, :m])
            out[start : start + m] = values[:, :m].T

    return fill


def half_angle(angle: Array, cosine: Array, sine: Array) -> None:
    """Cosine and sine from t = tan(angle / 2), to 5e-16: numpy's tan costs a fifth of its sin."""
    t = np.tan(angle * 0.5)
    np.multiply(t, t, cosine)
    np.add(cosine, 1.0, cosine)
    np.divide(2.0, cosine, cosine)
    np.multiply(t, cosine, sine)
    np.subtract(cosine, 1.0, cosine)


def direct(angle: Array, cosine: Array, sine: Array) -> None:
    """Cosine and sine from numpy's own functions."""
    np.cos(angle, cosine)
    np.sin(angle, sine)


def used_angles(program: Program) -> list[int]:
    """Indices of the angles whose cosine or sine the program reads."""
    read = {x for step in program.steps for x in (step.left, step.right)}
    read |= {x.name for x in program.outputs if isinstance(x, Signed)}
    return [i for i in range(len(program.angles)) if f"c{i}" in read or f"s{i}" in read]


def _sum(angle: Sum, columns: Array, spare: Array) -> Array:
    (sign, joint), *others = angle  # the first sign is positive: the trace sees to it
    if not others:
        return columns[joint]
    np.copyto(spare, columns[joint])
    for sign, joint in others:
        (np.add if sign > 0 else np.subtract)(spare, columns[joint], spare)
    return spare


def _kernel(program: Program) -> tuple[Callable[..., None], int]:
    """In-place numpy calls of the steps; scratch rows are used again as soon as their value is dead."""
    where, last = _places(program), _last_uses(program)
    free, count, lines = list[str](), 0, list[str]()
    for i, step in enumerate(program.steps):
        left, right = (where.get(x, _operand(x)) for x in (step.left, step.right))
        for x in {step.left, step.right}:
            if last[x] == i and where.get(x, "").startswith("scratch"):
                free.append(where[x])
        if step.target not in where:
            if not free:
                free.append(f"scratch[{count}]")
                count += 1
            where[step.target] = free.pop()
        lines.append(f"  {step.operation}({left}, {right}, {where[step.target]})")
    for i, x in enumerate(program.outputs):
        if isinstance(x, Signed) and where.get(x.name) != f"out[{i}]":
            lines.append(f"  {'negative' if x.negative else 'copy'}({where.get(x.name, _operand(x.name))}, out[{i}])")
    names = {"multiply": np.multiply, "add": np.add, "subtract": np.subtract}
    names |= {"negative": np.negative, "copy": np.positive}
    return _function("kernel(q, c, s, out, scratch)", lines or ["  pass"], names), count


def _places(program: Program) -> dict[str | float, str]:
    """Registers that are written straight into their output row."""
    places = dict[str | float, str]()
    for i, x in enumerate(program.outputs):
        if isinstance(x, Signed) and not x.negative and x.name.startswith("r"):
            places.setdefault(x.name, f"out[{i}]")
    return places


def _last_uses(program: Program) -> dict[str | float, int]:
    last = dict[str | float, int]()
    for i, step in enumerate(program.steps):
        last |= {step.left: i, step.right: i}
    return last | {x.name: len(program.steps) for x in program.outputs if isinstance(x, Signed)}


def _operand(x: str | float) -> str:
    return f"{x[0]}[{x[1:]}]" if isinstance(x, str) else repr(x)


def _function(signature: str, lines: list[str], names: dict[str, Any]) -> Callable[..., Any]:
    source = "\n".join([f"def {signature}:", *lines])
    exec(source, names)  # noqa: S102  only float literals and register names can occur in it
    return names[signature.partition("(")[0]]
