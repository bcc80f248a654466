# pyright: basic
"""Other ways to the same Jacobians: the numpy of textbooks, C from our trace, and the peers."""

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from kinegrade.solutions.chain import Array, Chain
from kinegrade.solutions.program.source import SYMBOLS
from kinegrade.solutions.program.tracer import Signed
from kinegrade.solutions.program.walk import Program, trace, used_angles

Batch = Callable[[Array], Array]  # q (N, n) -> (N, 6, n)
Single = Callable[[Array], Array]  # q (n,) -> (6, n)
STRICT = ("-O3", "-march=native")
FAST = (*STRICT, "-ffast-math")  # lets gcc call the vector sines of glibc


def joint_motions(kind: str, q: Array) -> Array:
    """E (N, 4, 4) of one joint."""
    E = np.zeros((len(q), 4, 4))
    E[:, 2, 2] = E[:, 3, 3] = 1.0
    if kind == "R":
        E[:, 0, 0] = E[:, 1, 1] = np.cos(q)
        E[:, 1, 0] = np.sin(q)
        E[:, 0, 1] = -E[:, 1, 0]
    else:
        E[:, 0, 0] = E[:, 1, 1] = 1.0
        E[:, 2, 3] = q
    return E


def textbook(chain: Chain, q: Array) -> Array:
    """Transforms by matmul, columns by cross."""
    T, axes, origins = np.broadcast_to(chain.fixed[0], (len(q), 4, 4)), [], []
    for i, kind in enumerate(chain.kinds):
        axes.append(T[:, :3, 2])
        origins.append(T[:, :3, 3])
        T = T @ joint_motions(kind, q[:, i]) @ chain.fixed[i + 1]
    J = np.zeros((len(q), 6, chain.n))
    for i, (kind, z, o) in enumerate(zip(chain.kinds, axes, origins, strict=True)):
        J[:, :3, i] = np.cross(z, T[:, :3, 3] - o) if kind == "R" else z
        J[:, 3:, i] = z if kind == "R" else 0.0
    return J


def einsum(chain: Chain, q: Array) -> Array:
    """The same with einsum in the place of matmul and cross."""
    epsilon = np.zeros((3, 3, 3))
    epsilon[[0, 1, 2], [1, 2, 0], [2, 0, 1]] = 1.0
    epsilon[[0, 2, 1], [2, 1, 0], [1, 0, 2]] = -1.0
    T, axes, origins = np.broadcast_to(chain.fixed[0], (len(q), 4, 4)), [], []
    for i, kind in enumerate(chain.kinds):
        axes.append(T[:, :3, 2])
        origins.append(T[:, :3, 3])
        T = np.einsum(
            "nij,njk,kl->nil", T, joint_motions(kind, q[:, i]), chain.fixed[i + 1], optimize=True
        )
    z, levers = np.stack(axes, axis=-1), T[:, :3, 3, None] - np.stack(origins, axis=-1)
    turns = np.array([kind == "R" for kind in chain.kinds])
    moments = np.einsum("ijk,njc,nkc->nic", epsilon, z, levers, optimize=True)
    return np.concatenate([np.where(turns, moments, z), np.where(turns, z, 0.0)], axis=1)


def in_c(
    chain: Chain, flags: tuple[str, ...], *, rows: bool
) -> Callable[[Array, Array], None] | None:
    """The traced program in C, or None without a C compiler.

    Takes q (n, N) and fills out (6 n, N) if `rows`, else q (N, n) and out (N, 6 n), all contiguous.
    """
    compiler = shutil.which("cc")
    if compiler is None:
        return None
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "jacobian.c", Path(folder) / "jacobian.so"
        source.write_text(c_source(trace(chain, "base"), rows=rows), encoding="utf-8")
        subprocess.run(
            [compiler, *flags, "-shared", "-fPIC", "-o", library, source, "-lm"], check=True
        )
        function = ctypes.CDLL(str(library)).jacobian

    def run(q: Array, out: Array) -> None:
        count = q.shape[-1] if rows else len(q)
        function(
            ctypes.c_long(count), ctypes.c_void_p(q.ctypes.data), ctypes.c_void_p(out.ctypes.data)
        )

    return run


def c_source(program: Program, *, rows: bool) -> str:
    """C for batches, in blocks that stay in the cache.

    Sines and cosines have loops of their own, which gcc can vectorise.
    """
    n, outputs = len(program.kinds), len(program.outputs)
    joints = [f"q[{j}*N+b+k]" if rows else f"q[(b+k)*{n}+{j}]" for j in range(n)]
    loop = "  for (long k = 0; k < m; k++)"
    turns, reads = (
        list[str](),
        [f"double q{j} = {joints[j]};" for j in range(n) if program.kinds[j] == "P"],
    )
    for i in used_angles(program):
        angle = "".join(f"{'+' if sign > 0 else '-'}{joints[j]}" for sign, j in program.angles[i])
        angle += f" + {program.shifts[i]!r}" * bool(program.shifts[i])
        turns += [f"{loop} C[{i}][k] = cos({angle});", f"{loop} S[{i}][k] = sin({angle});"]
        reads += [f"double c{i} = C[{i}][k], s{i} = S[{i}][k];"]
    steps = [
        f"double {s.target} = {s.left} {SYMBOLS[s.operation]} {s.right};" for s in program.steps
    ]
    values = [
        f"{'-' * x.negative}{x.name}" if isinstance(x, Signed) else repr(x) for x in program.outputs
    ]
    places = [f"out[{i}*N+b+k]" if rows else f"out[(b+k)*{outputs}+{i}]" for i in range(outputs)]
    writes = [f"{place} = {value};" for place, value in zip(places, values, strict=True)]
    body = "\n    ".join([*reads, *steps, *writes])
    return f"""#include <math.h>
static double C[{len(program.angles) + 1}][512], S[{len(program.angles) + 1}][512];
void jacobian(long N, const double *restrict q, double *restrict out) {{
  for (long b = 0; b < N; b += 512) {{
    long m = N - b < 512 ? N - b : 512;
    {chr(10).join(turns)}
    {loop} {{
    {body}
    }}
  }}
}}
"""


def pinocchio(chain: Chain) -> Batch:
    """computeJointJacobians and getFrameJacobian in a Python loop, copied out."""
    import pinocchio as pin

    model, parent = pin.Model(), 0
    for i, kind in enumerate(chain.kinds):
        joint = pin.JointModelRZ() if kind == "R" else pin.JointModelPZ()
        parent = model.addJoint(parent, joint, pin.SE3(chain.fixed[i]), f"joint{i + 1}")
    tool = model.addFrame(
        pin.Frame("tool", parent, 0, pin.SE3(chain.fixed[-1]), pin.FrameType.OP_FRAME)
    )
    data, axes = model.createData(), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def run(q: Array) -> Array:
        J = np.empty((len(q), 6, chain.n))
        for k, row in enumerate(q):
            pin.computeJointJacobians(model, data, row)
            J[k] = pin.getFrameJacobian(model, data, tool, axes)
        return J

    return run


def toolbox_ets(chain: Chain) -> Single:
    """roboticstoolbox's elementary transform sequence, whose jacob0 is written in C."""
    import roboticstoolbox as rtb
    from spatialmath import SE3

    ets = rtb.ETS()
    for C, kind in zip(chain.fixed, chain.kinds, strict=False):
        ets = (ets if np.array_equal(C, np.eye(4)) else ets * rtb.ET.SE3(SE3(C))) * getattr(
            rtb.ET, "Rz" if kind == "R" else "tz"
        )()
    last = chain.fixed[-1]
    ets = ets if np.array_equal(last, np.eye(4)) else ets * rtb.ET.SE3(SE3(last))
    return ets.jacob0


def toolbox_puma(chain: Chain) -> Single:
    """roboticstoolbox's own Puma 560 by Denavit-Hartenberg rows, in Python."""
    import roboticstoolbox as rtb

    return rtb.models.DH.Puma560().jacob0


def modern_robotics(chain: Chain) -> Single:
    """JacobianSpace, moved from the base's origin to the tool by our own forward kinematics."""
    import modern_robotics as mr
    from kinegrade.solutions.kinematics import forward, frames

    axes = frames(chain, np.zeros(chain.n))[:-1]
    z, o = axes[:, :3, 2], axes[:, :3, 3]
    turns = np.array([kind == "R" for kind in chain.kinds])[:, None]
    screws = np.concatenate([np.where(turns, z, 0.0), np.where(turns, np.cross(o, z), z)], axis=1).T

    def jacobian(q: Array) -> Array:
        J = mr.JacobianSpace(screws, q)
        return np.concatenate([J[3:] + np.cross(J[:3], forward(chain, q)[:3, 3], axis=0), J[:3]])

    return jacobian


def kinpy(chain: Chain) -> Single:
    """A serial chain read from a URDF that is written from ours."""
    import kinpy

    names = ["base", *(f"link{i}" for i in range(1, chain.n + 1)), "tool"]
    joints = list[str]()
    for i, C in enumerate(chain.fixed):
        kind = "fixed"
        if i < chain.n:
            kind = {"R": "continuous", "P": "prismatic"}[chain.kinds[i]]
        R = C[:3, :3]
        rpy = (
            np.arctan2(R[2, 1], R[2, 2]),
            np.arctan2(-R[2, 0], np.hypot(R[2, 1], R[2, 2])),
            np.arctan2(R[1, 0], R[0, 0]),
        )
        xyz_text = " ".join(map(repr, C[:3, 3].tolist()))
        rpy_text = " ".join(repr(float(angle)) for angle in rpy)
        joints.append(
            f'<joint name="j{i}" type="{kind}">'
            f'<parent link="{names[i]}"/><child link="{names[i + 1]}"/>'
            f'<origin xyz="{xyz_text}" rpy="{rpy_text}"/>'
            '<axis xyz="0 0 1"/><limit lower="-9" upper="9" effort="1" velocity="1"/></joint>'
        )
    links = "".join(f'<link name="{name}"/>' for name in names)
    urdf = f'<robot name="arm">{links}{"".join(joints)}</robot>'
    return kinpy.build_serial_chain_from_urdf(urdf.encode(), "tool", "base").jacobian
