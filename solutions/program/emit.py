"""From a traced program to functions: plain math for one configuration, rows for batches."""

import math
import struct
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..chain import Array, Chain
from .quick import quick
from .rows import BLOCK, direct, half_angle, rows
from .source import SYMBOLS, angle_text, function_of, operation_text, written
from .walk import Program, Wanted, trace, used_angles

__all__ = [
    "BLOCK",
    "FEW",
    "SYMBOLS",
    "Compiled",
    "compiled",
    "direct",
    "evaluate",
    "half_angle",
    "plain",
    "rows",
    "single",
    "used_angles",
]

DOUBLE = np.dtype(np.float64)
FEW = 12  # up to so many configurations, plain math one by one is faster than rows
# angles up to this many radians are added as they are: the sum is rounded to 7e-15
LARGE = 64.0
COMPILES = "numba"  # a chain with this among its programs has them compiled


@dataclass(frozen=True)
class Compiled:
    """`single` takes n floats; `rows` takes (N, n) and fills (N, outputs).

    `quick`, where numba compiles, takes (n,) and fills an array of that shape; False if it did not.
    """

    program: Program
    shape: tuple[int, ...]
    single: Callable[[list[float]], Array]
    quick: Callable[[Array, Array], bool] | None = None

    @cached_property
    def rows(self) -> Callable[[Array, Array], None]:
        """Made when the first batch comes: most chains never see one."""
        return rows(self.program)


def evaluate(chain: Chain, wanted: Wanted, q: Array, out: Array | None = None) -> Array:
    """Values (..., *shape) of a program of the chain at validated q (..., n), in `out` if given."""
    functions: Compiled = chain.compiled.get(wanted) or compiled(chain, wanted)
    q = within_turns(chain, q)
    if q.ndim == 1 and out is None:
        return functions.single(q.tolist())

    result = out
    if result is None:
        result = np.empty((*q.shape[:-1], *functions.shape))
    batch = q.reshape(-1, chain.n)
    if len(batch) > FEW:
        functions.rows(batch, result.reshape(-1, math.prod(functions.shape)))
    else:
        for place, values in zip(result.reshape(-1, *functions.shape), batch.tolist(), strict=True):
            place[...] = functions.single(values)
    return result


def plain(chain: Chain, wanted: Wanted, q: ArrayLike) -> Array | None:
    """Value at one configuration, a finite float64 array (n,), of a program compiled; else None.

    The plain call of an iteration: what would be None may be right or wrong, and is looked at with
    more care.
    """
    if type(q) is not np.ndarray or q.dtype is not DOUBLE or q.ndim != 1:
        return None
    functions: Compiled | None = chain.compiled.get(wanted)
    if functions is None or len(q) != len(chain.kinds):
        return None
    if functions.quick is not None:
        result = np.empty(functions.shape)
        return result if functions.quick(q, result) else None
    values = q.tolist()
    if not sum(map(abs, values)) < LARGE:  # also where one is not a number
        return None
    return functions.single(values)


def within_turns(chain: Chain, q: Array) -> Array:
    """The same configurations (..., n) with large angles brought within half a turn of zero.

    Sums of large angles would be rounded before their cosine is taken. Sine and cosine of one angle
    are exact to the last digit, however large it is.
    """
    if not q.size or (q.max() < LARGE and q.min() > -LARGE):
        return q
    turns = [i for i, kind in enumerate(chain.kinds) if kind == "R"]
    angles = q[..., turns]
    reduced = q.copy()
    reduced[..., turns] = np.where(
        np.abs(angles) < LARGE, angles, np.arctan2(np.sin(angles), np.cos(angles))
    )
    return reduced


def compiled(chain: Chain, wanted: Wanted) -> Compiled:
    """Functions of one program of the chain, made at first use and kept on the chain."""
    functions = chain.compiled.get(wanted)
    if functions is None:
        program = trace(chain, wanted)
        compiled_one = quick(program, LARGE) if COMPILES in chain.compiled else None
        functions = Compiled(program, program.shape, single(program), compiled_one)
        # two threads may both compile; setdefault lets one result win
        functions = chain.compiled.setdefault(wanted, functions)
    return functions


def single(program: Program) -> Callable[[list[float]], Array]:
    """Function of one configuration in plain float arithmetic."""
    joints = ", ".join(f"q{i}" for i in range(len(program.kinds)))
    lines = [f"  {joints}, = q"]
    for index in used_angles(program):
        lines.append(f"  a = {angle_text(program, index)}")
        lines.append(f"  c{index} = cos(a)")
        lines.append(f"  s{index} = sin(a)")
    lines += [f"  {s.target} = {operation_text(s)}" for s in program.steps]

    # packing floats into an empty array costs half of np.array(...).reshape(...)
    outputs = ", ".join(written(x) for x in program.outputs)
    lines.append(f"  out = empty({program.shape})")
    lines.append(f"  pack(out, 0, {outputs})")

    # no -0.0 in a result: only where one of these is zero can a product be
    factors = [f"s{index}" for index in used_angles(program)]
    factors += [f"q{i}" for i, kind in enumerate(program.kinds) if kind == "P"]
    lines.append(f"  if {' and '.join(factors) or True}:")
    lines.append("    return out")
    lines.append("  return out + 0.0")
    pack = struct.Struct(f"{len(program.outputs)}d").pack_into
    names = {"cos": math.cos, "sin": math.sin, "empty": np.empty, "pack": pack}
    return function_of("single(q)", lines, names)
