# pyright: basic
"""The same Jacobian from what compiles formulas: numba, JAX and CasADi with a C compiler."""

import contextlib
import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from kinegrade.solutions.chain import Array, Chain
from kinegrade.solutions.program.quick import HEAD, source_of
from kinegrade.solutions.program.walk import trace

LOOP = """
void batch(long N, const double *q, double *out) {{
  casadi_int iw[{whole}];
  double w[{words}];
  for (long k = 0; k < N; k++) {{
    const double *arg[8] = {{q + k*{n}}};
    double *res[8] = {{out + k*6*{n}}};
    arm_jacobian(arg, res, iw, w, 0);
  }}
}}
"""

Batch = Callable[[Array], Array]


def numba_loop(chain: Chain) -> Batch:
    """Our own steps, compiled by numba, in a compiled loop over the batch."""
    import numba

    source = source_of(trace(chain, "base"), 1e300).removeprefix(HEAD)
    names: dict[str, object] = {}
    exec(HEAD + source.replace(", cache=True", ""), names)  # noqa: S102  written by ourselves
    fill = names["fill"]

    @numba.njit
    def loop(q: Array, out: Array) -> None:
        for k in range(len(q)):
            fill(q[k], out[k])

    def run(q: Array) -> Array:
        out = np.empty((len(q), 6, chain.n))
        loop(q, out)
        return out

    return run


def jax_batch(chain: Chain) -> Batch:
    """Transforms and cross products in jax.numpy, vmap and jit, float64 on the processor."""
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", val=True)
    fixed = jnp.asarray(chain.fixed)

    def one(q: "jax.Array") -> "jax.Array":
        T, axes, origins = fixed[0], [], []
        for i, kind in enumerate(chain.kinds):
            axes.append(T[:3, 2])
            origins.append(T[:3, 3])
            E = jnp.eye(4)
            if kind == "R":
                c, s = jnp.cos(q[i]), jnp.sin(q[i])
                E = E.at[:2, :2].set(jnp.array([[c, -s], [s, c]]))
            else:
                E = E.at[2, 3].set(q[i])
            T = T @ E @ fixed[i + 1]
        columns = []
        for kind, z, o in zip(chain.kinds, axes, origins, strict=True):
            turning = jnp.concatenate([jnp.cross(z, T[:3, 3] - o), z])
            columns.append(turning if kind == "R" else jnp.concatenate([z, jnp.zeros(3)]))
        return jnp.stack(columns, axis=1)

    compiled = jax.jit(jax.vmap(one))
    return lambda q: np.asarray(compiled(q))


def casadi_c(chain: Chain) -> tuple[Batch, Callable[[Array], Array]]:
    """CasADi's expression graph of J as C, compiled with -O3: in a loop in C, and one call.

    The batch's matrices are column by column, as CasADi has them. The single call goes through
    its buffers, which is its quickest way from Python.
    """
    import casadi as ca

    function = _casadi_function(ca, chain)
    folder = Path(tempfile.mkdtemp())
    with contextlib.chdir(folder):
        function.generate("arm_jacobian.c")
    source, library = folder / "arm_jacobian.c", folder / "arm_jacobian.so"
    with source.open("a", encoding="utf-8") as file:
        file.write(LOOP.format(n=chain.n, words=function.sz_w() + 1, whole=function.sz_iw() + 1))
    compiler = shutil.which("cc") or "cc"
    command = [compiler, "-O3", "-march=native", "-shared", "-fPIC", "-o", str(library)]
    subprocess.run([*command, str(source), "-lm"], check=True)
    loop = ctypes.CDLL(str(library)).batch

    def batch(q: Array) -> Array:
        out = np.empty((len(q), chain.n, 6))
        places = [ctypes.c_void_p(x.ctypes.data) for x in (q, out)]
        loop(ctypes.c_long(len(q)), *places)
        return out.mT

    external = ca.external("arm_jacobian", str(library))
    buffer, call = external.buffer()
    given, result = np.empty(chain.n), np.empty((chain.n, 6))
    buffer.set_arg(0, memoryview(given))
    buffer.set_res(0, memoryview(result))

    def one(q: Array, _alive: object = (external, buffer)) -> Array:
        given[:] = q
        call()
        return result.T.copy()

    return batch, one


def _casadi_function(ca: object, chain: Chain) -> object:
    q = ca.SX.sym("q", chain.n)
    T, axes, origins = ca.SX(chain.fixed[0]), [], []
    for i, kind in enumerate(chain.kinds):
        axes.append(T[:3, 2])
        origins.append(T[:3, 3])
        E = ca.SX.eye(4)
        if kind == "R":
            c, s = ca.cos(q[i]), ca.sin(q[i])
            E[0, 0], E[1, 1], E[1, 0], E[0, 1] = c, c, s, -s
        else:
            E[2, 3] = q[i]
        T = T @ E @ ca.SX(chain.fixed[i + 1])
    columns = []
    for kind, z, o in zip(chain.kinds, axes, origins, strict=True):
        turning = ca.vertcat(ca.cross(z, T[:3, 3] - o), z)
        columns.append(turning if kind == "R" else ca.vertcat(z, ca.SX.zeros(3)))
    J = ca.densify(ca.cse(ca.horzcat(*columns)))
    return ca.Function("arm_jacobian", [q], [J])
