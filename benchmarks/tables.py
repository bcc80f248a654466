# pyright: basic
"""The tables of the benchmark: Puma 560 against everything, every arm, and two uses.

Started by jacobian.py.
"""

import functools
import json
import os
import platform
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import compilers
import contenders
import numpy as np
import simulators
from jacobian import PEERS, ROOT
from kinegrade.solutions.chain import Array, Chain, elementary
from kinegrade.solutions.fast import fast
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.singularity import sigma_min

BATCH = 100_000
REDUCED = 10_000_000
GRID = 181
RANDOM = ("RRPRRR", "RRRRRR", "RRRRRRR", "PRPRPR")


@dataclass
class Contender:
    """`run` makes `count` Jacobians; `times` [ns] of one of them, one entry per round."""

    name: str
    count: int
    run: Callable[[], object]
    times: list[float] = field(default_factory=list)

    @property
    def median(self) -> float:
        return statistics.median(self.times)

    def over(self, other: "Contender") -> float:
        """How many times as long as the other one took: the median of the ratios of all rounds."""
        return statistics.median(self.ratios(other))

    def range_over(self, other: "Contender") -> str:
        """That median, with the range of the middle half of the rounds in brackets."""
        low, middle, high = statistics.quantiles(self.ratios(other), n=4, method="inclusive")
        return f"{middle:,.2f} ({low:,.2f}-{high:,.2f})"

    def ratios(self, other: "Contender") -> list[float]:
        """How many times as long as the other one took in each round."""
        return [mine / its for mine, its in zip(self.times, other.times, strict=True)]


def main() -> None:
    if sys.argv[1] == "reduction":
        print(json.dumps(reduction()))
        return
    print(machine())
    for table in (puma, arms, uses):
        print("\n" + "\n".join(table(int(sys.argv[1]))), flush=True)


def machine() -> str:
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    cpu = next(
        (line.partition(": ")[2] for line in lines if line.startswith("model name")),
        platform.processor(),
    )
    names = ", ".join(f"{name} {installed(name)}" for name in ("numpy", *PEERS))
    return f"{cpu}, one of {os.cpu_count()} cores, Python {platform.python_version()}, {names}"


def installed(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def puma(rounds: int) -> list[str]:
    """Every contender on the Puma 560."""
    chain = ROBOTS["puma560"].chain()
    q = np.random.default_rng(0).uniform(-np.pi, np.pi, (BATCH, chain.n))
    compared = [
        *ours(chain, q),
        textbook(chain, q),
        einsum(chain, q),
        *in_c(chain, q),
        *compiled(chain, q),
        *loops(chain, q),
    ]
    alternate(compared, rounds)
    batch, single = (
        next(c for c in compared if c.name.startswith(f"ours, {x}")) for x in ("batch", "single")
    )
    rows = [
        f"| {c.name} | {c.median:,.0f} | {c.range_over(batch)} | {c.range_over(single)} |"
        for c in compared
    ]
    return [
        "| Puma 560, base frame | ns each | times our batch | times our single call |",
        "|---|--:|--:|--:|",
        *rows,
    ]


def arms(rounds: int) -> list[str]:
    """Every golden arm and a few random chains, against textbook numpy and C."""
    rng = np.random.default_rng(1)
    chains = golden() | {f"random {kinds}": random_chain(kinds, rng) for kinds in RANDOM}
    lines = [
        "| arm, batch | joints | ours, ns each | textbook / ours | ours / C rows |",
        "|---|--:|--:|--:|--:|",
    ]
    for name, chain in chains.items():
        q = rng.uniform(-np.pi, np.pi, (BATCH, chain.n))
        compared = [ours(chain, q)[0], textbook(chain, q), *in_c(chain, q)[1:2]]
        alternate(compared, rounds)
        mine, everyone, *c = compared
        ratio = f"{mine.over(c[0]):.1f}" if c else "no cc"
        lines.append(
            f"| {name} | {chain.n} | {mine.median:.0f} | {everyone.over(mine):.1f} | {ratio} |"
        )
    return lines


def uses(rounds: int) -> list[str]:
    """A map of the smallest singular value, and a reduction in blocks in a process of its own."""
    chain = ROBOTS["puma560"].chain()
    q = np.zeros((GRID, GRID, chain.n))
    q[..., 1], q[..., 2] = np.meshgrid(*[np.linspace(-np.pi, np.pi, GRID)] * 2)
    drawn = Contender("map", 1, lambda: sigma_min(jacobian(chain, q)[..., :3, :3]))
    alternate([drawn], rounds)
    command = [sys.executable, __file__, "reduction"]
    reduced = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    map_of = f"smallest singular value of the Puma's 3 x 3 block, {GRID} x {GRID} map"
    largest_of = f"largest entry of J over {REDUCED:,} configurations, `out=` in blocks"
    return [
        "| use | |",
        "|---|--:|",
        f"| {map_of} | {drawn.median / 1e9:.3f} s |",
        f"| {largest_of} | {reduced['seconds']:.1f} s |",
        f"| peak memory of that process | {reduced['memory']} |",
    ]


def reduction() -> dict[str, float | str]:
    chain, rng = ROBOTS["puma560"].chain(), np.random.default_rng(2)
    out, largest, start = np.empty((BATCH, 6, chain.n)), 0.0, time.perf_counter()
    for _ in range(REDUCED // BATCH):
        J = jacobian(chain, rng.uniform(-np.pi, np.pi, (BATCH, chain.n)), out=out)
        largest = max(largest, float(J.max()), -float(J.min()))
    seconds = time.perf_counter() - start
    # ru_maxrss would count what the parent process held before this one was started
    status = Path("/proc/self/status")
    lines = status.read_text(encoding="utf-8").splitlines() if status.exists() else []
    kilobytes = [int(line.split()[1]) for line in lines if line.startswith("VmHWM:")]
    memory = f"{kilobytes[0] / 1024:.0f} MB" if kilobytes else "not measured"
    return {"seconds": seconds, "memory": memory, "largest": largest}


def ours(chain: Chain, q: Array) -> list[Contender]:
    out = np.empty((len(q), 6, chain.n))
    quicker = fast(Chain(chain.fixed, chain.kinds))
    return [
        Contender(
            f"ours, batch of {len(q):,}, contiguous result", len(q), lambda: jacobian(chain, q)
        ),
        Contender("ours, the same with `out=`", len(q), lambda: jacobian(chain, q, out=out)),
        Contender("ours, batch of 1,000", 1000, lambda: jacobian(chain, q[:1000])),
        one_by_one("ours, single call", functools.partial(jacobian, chain), q[:2000]),
        one_by_one("ours, single call, `fast`", functools.partial(jacobian, quicker), q[:10_000]),
    ]


def textbook(chain: Chain, q: Array) -> Contender:
    check("textbook", chain, q, contenders.textbook(chain, q[:100]))
    return Contender("numpy, matmul and cross", len(q), lambda: contenders.textbook(chain, q))


def einsum(chain: Chain, q: Array) -> Contender:
    check("einsum", chain, q, contenders.einsum(chain, q[:100]))
    return Contender("numpy, einsum", len(q), lambda: contenders.einsum(chain, q))


def in_c(chain: Chain, q: Array) -> list[Contender]:
    """C from our trace: rows with scalar and with vector sines, then with the result as ours."""
    made = list[Contender]()
    for name, flags, rows in (
        ("C, structure of arrays", contenders.STRICT, True),
        ("C, structure of arrays", contenders.FAST, True),
        ("C, contiguous result", contenders.FAST, False),
    ):
        run = contenders.in_c(chain, flags, rows=rows)
        if run is None:
            continue
        given = np.ascontiguousarray(q.T) if rows else q
        out = np.empty((6 * chain.n, len(q)) if rows else (len(q), 6 * chain.n))
        run(given, out)
        check(name, chain, q, (out.T if rows else out).reshape(-1, 6, chain.n))
        made.append(
            Contender(f"{name}, `cc {' '.join(flags)}`", len(q), functools.partial(run, given, out))
        )
    return made


def compiled(chain: Chain, q: Array) -> list[Contender]:
    """What compiles formulas; those that are not installed are left out."""
    made = list[Contender]()

    def batch(name: str, function: contenders.Batch) -> None:
        check(name, chain, q, function(q[:100]))
        made.append(Contender(name, len(q), lambda: function(q)))

    def casadi() -> None:
        mapped, one = compilers.casadi_c(chain)
        batch("CasADi, its C, `cc -O3`, in a loop", mapped)
        made.append(one_by_one("CasADi, the same, single call by `buffer`", one, q[:2000]))

    for add in (
        lambda: batch("numba, our steps in a loop", compilers.numba_loop(chain)),
        lambda: batch("JAX, `jit(vmap)`, float64", compilers.jax_batch(chain)),
        casadi,
    ):
        try:
            add()
        except ImportError as error:
            print(f"left out: {error}", file=sys.stderr)
    return made


def loops(chain: Chain, q: Array) -> list[Contender]:
    """The peers, one configuration after the other; those that are not installed are left out."""
    made = list[Contender]()
    try:
        loop = contenders.pinocchio(chain)
        check("Pinocchio", chain, q, loop(q[:100]))
        made.append(
            Contender("Pinocchio, Python loop with copy-out", 20_000, lambda: loop(q[:20_000]))
        )
    except ImportError as error:
        print(f"Pinocchio is left out: {error}", file=sys.stderr)
    for name, function, count in (
        ("MuJoCo, `mj_jacSite`", simulators.mujoco, 2000),
        ("Drake, `CalcJacobianSpatialVelocity`", simulators.drake, 2000),
        ("KDL, `ChainJntToJacSolver`", simulators.kdl, 500),
        ("roboticstoolbox, `ETS.jacob0` (C)", contenders.toolbox_ets, 2000),
        ("roboticstoolbox, `DHRobot.jacob0`", contenders.toolbox_puma, 100),
        ("modern_robotics, `JacobianSpace`", contenders.modern_robotics, 50),
        ("kinpy, `jacobian`", contenders.kinpy, 50),
    ):
        try:
            run = function(chain)
        except ImportError as error:
            print(f"{name} is left out: {error}", file=sys.stderr)
            continue
        check(name, chain, q, np.array([run(row) for row in q[:20]]))
        made.append(one_by_one(name, run, q[:count]))
    return made


def one_by_one(name: str, function: contenders.Single, q: Array) -> Contender:
    """Single calls; what becomes of their results is nobody's time."""
    rows = list(q)

    def run() -> None:
        for row in rows:
            function(row)

    return Contender(name, len(rows), run)


def golden() -> dict[str, Chain]:
    """Chains of the arms of the literature that the tests are held against."""
    chains = dict[str, Chain]()
    for path in sorted((ROOT / "tests" / "data" / "golden").glob("*.json")):
        arm = json.loads(path.read_text(encoding="utf-8"))
        pre, kinds = np.array(arm["pre_matrices"], dtype=np.float64), "".join(arm["kinds"])
        turns = [
            elementary("Rz" if kind == "R" else "Tz", x)
            for kind, x in zip(kinds, arm["offsets"], strict=True)
        ]
        behind = [*pre[1:], np.array(arm["tool_matrix"], dtype=np.float64)]
        chains[path.stem] = Chain(
            np.stack([pre[0], *(a @ b for a, b in zip(turns, behind, strict=True))]), kinds
        )
    return chains


def check(name: str, chain: Chain, q: Array, J: Array) -> None:
    error = np.abs(J - jacobian(chain, q[: len(J)])).max()
    if not error < 1e-9:
        sys.exit(f"{name} gives other Jacobians: they differ by {error:.1e}")


def alternate(compared: list[Contender], rounds: int) -> None:
    """One round of everything, then the next: what slows the machine down slows all."""
    for c in compared:
        c.run()
    for _ in range(rounds):
        for c in compared:
            start = time.perf_counter()
            c.run()
            c.times.append((time.perf_counter() - start) / c.count * 1e9)


if __name__ == "__main__":
    main()
