# pyright: basic
"""A traced program for one configuration, compiled by numba and kept on disk."""

from __future__ import annotations

import hashlib
import importlib.util
import os
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .source import angle_text, operation_text, written
from .walk import Program, used_angles

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..chain import Array

HEAD = """from math import cos, sin

from numba import njit
from numba.types import Array, boolean, float64
"""


def quick(program: Program, largest: float) -> Callable[[Array, Array], bool] | None:
    """Function of q (n,) that fills out (shape); None where numba is not installed.

    It leaves out as it is and returns False where the joint values together exceed `largest`, or
    are no numbers. Everything else comes out as from the plain program, to the last digit: numba
    calls the same sine and cosine, and neither changes the order of sums nor merges operations.
    """
    if importlib.util.find_spec("numba") is None:
        return None
    text = source_of(program, largest)
    try:
        return _kept(text)
    except OSError:  # nowhere to write
        names: dict[str, Any] = {}
        exec(text.replace(", cache=True", ""), names)  # noqa: S102  written by ourselves
        return names["fill"]


def source_of(program: Program, largest: float) -> str:
    """A module whose function `fill` is the program."""
    places = [", ".join(map(str, place)) for place in np.ndindex(program.shape)]
    total = " + ".join(f"abs(q{i})" for i in range(len(program.kinds)))
    lines = [f"q{i} = q[{i}]" for i in range(len(program.kinds))]
    lines += [f"if not {total} < {largest!r}:", "    return False"]
    for index in used_angles(program):
        lines += [f"a = {angle_text(program, index)}", f"c{index} = cos(a)", f"s{index} = sin(a)"]
    lines += [f"{step.target} = {operation_text(step)}" for step in program.steps]
    for place, value in zip(places, program.outputs, strict=True):
        lines.append(f"out[{place}] = {written(value)} + 0.0")  # no -0.0 in a result
    body = "\n".join(f"    {line}" for line in [*lines, "return True"])

    # q may be read-only, or a column; it is mostly neither
    out = f"float64[{', '.join([':'] * (len(program.shape) - 1) + ['::1'])}]"
    any_q = 'Array(float64, 1, "A", readonly=True)'
    signatures = f"[boolean(float64[::1], {out}), boolean({any_q}, {out})]"
    return f"{HEAD}\n\n@njit({signatures}, cache=True)\ndef fill(q, out):\n{body}\n"


def cache_folder() -> Path:
    """Where compiled programs are kept, for this user."""
    root = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(root) / "kinegrade" / f"numba-{version('numba')}"


def _kept(text: str) -> Callable[[Array, Array], bool]:
    """The function of a module in the cache, written there at first use."""
    name = f"program_{hashlib.sha256(text.encode()).hexdigest()[:24]}"
    path = cache_folder() / f"{name}.py"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        with tempfile.NamedTemporaryFile(
            "w", encoding="utf-8", dir=path.parent, suffix=".part", delete=False
        ) as part:
            part.write(text)
        Path(part.name).replace(path)

    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise OSError(path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # where numba looks for it when it loads what it has kept
    spec.loader.exec_module(module)
    return module.fill
