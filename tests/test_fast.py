"""Compiled single calls give the numbers of the plain ones, to the last digit, and refuse what those refuse."""

import math
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from kinegrade.solutions import fast as module
from kinegrade.solutions.chain import Chain, ChainError
from kinegrade.solutions.fast import fast, is_fast
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.program import quick as quick_module
from kinegrade.solutions.program.emit import LARGE, single
from kinegrade.solutions.program.quick import HEAD, cache_folder, quick, source_of
from kinegrade.solutions.program.walk import trace
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS


@pytest.fixture(scope="module", autouse=True)
def _cache(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def twin(chain: Chain) -> Chain:
    """The same arm without any program."""
    return Chain(chain.fixed, chain.kinds)


def interpreted(program):
    """The function that numba would compile, run by Python."""
    text = source_of(program, LARGE).removeprefix(HEAD)
    names = {"cos": math.cos, "sin": math.sin}
    exec(text.partition("cache=True)")[2], names)  # noqa: S102  written by ourselves
    return names["fill"]


def chains():
    rng = np.random.default_rng(1)
    for name, robot in ROBOTS.items():
        yield name, robot.chain()
    for i in range(50):
        pattern = "".join(rng.choice(["R", "R", "P"], rng.integers(1, 9)))
        yield f"{pattern} {i}", random_chain(pattern, rng)


CHAINS = dict(chains())


@pytest.mark.parametrize("name", CHAINS)
def test_the_source_for_numba_is_the_plain_program(name):
    chain = CHAINS[name]
    rng = np.random.default_rng(2)
    for wanted in ("base", "tool", "pose", "frames"):
        program = trace(chain, wanted)
        fill, plain = interpreted(program), single(program)
        for q in (*rng.uniform(-3, 3, (3, chain.n)), np.zeros(chain.n)):
            out = np.full(program.shape, np.nan)
            assert fill(q, out)
            np.testing.assert_array_equal(out, plain(q.tolist()))
            assert not (np.signbit(out) & (out == 0)).any()
        for q in (np.full(chain.n, np.nan), np.full(chain.n, 1e6)):
            assert not fill(q, np.empty(program.shape))


@pytest.fixture(scope="module")
def arm() -> Chain:
    return fast(twin(ROBOTS["stanford"].chain()))


def test_numba_gives_the_same_numbers(arm):
    plain = twin(arm)
    assert is_fast(arm)
    assert not is_fast(plain)
    for q in np.random.default_rng(3).uniform(-3, 3, (200, 6)):
        for call in (jacobian, forward, frames):
            np.testing.assert_allclose(call(arm, q), call(plain, q), rtol=0, atol=1e-15)
        np.testing.assert_allclose(jacobian(arm, q, "tool"), jacobian(plain, q, "tool"), rtol=0, atol=1e-15)  # fmt: skip
    assert arm.compiled["base"].quick is not None


@pytest.mark.parametrize(
    "q",
    [
        np.arange(12.0)[::2],
        np.array([1e9, 0, 0.4, -1e6, 3, 1]),
        [0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
        np.arange(6),
        np.zeros(6),
        np.ones((3, 6)),
        np.ones((20, 6)),
    ],
    ids=["a column", "large", "a list", "whole numbers", "zero", "a few", "a batch"],
)
def test_any_q_is_taken(arm, q):
    np.testing.assert_allclose(jacobian(arm, q), jacobian(twin(arm), q), rtol=0, atol=1e-15)


def test_a_read_only_q_is_taken(arm):
    q = np.linspace(0, 1, 6)
    q.flags.writeable = False
    np.testing.assert_array_equal(jacobian(arm, q), jacobian(twin(arm), q.copy()))


@pytest.mark.parametrize("q", [np.full(6, np.nan), np.zeros(5), np.full(6, np.inf)])
def test_what_is_refused_stays_refused(arm, q):
    with pytest.raises(ChainError):
        jacobian(arm, q)


def test_a_result_is_nobody_elses(arm):
    first = jacobian(arm, np.zeros(6))
    kept = first.copy()
    jacobian(arm, np.ones(6))
    np.testing.assert_array_equal(first, kept)


def test_the_compiled_code_is_kept_for_the_next_process(arm):
    jacobian(arm, np.zeros(6))
    kept = list(cache_folder().rglob("*.nbc"))
    assert kept
    code = (
        "import numpy as np;from kinegrade.solutions.fast import fast;"
        "from kinegrade.solutions.robots import ROBOTS;from kinegrade.solutions.jacobian import jacobian;"
        "a=fast(ROBOTS['stanford'].chain());print(jacobian(a,np.ones(6))[2].tolist(),"
        "sum(a.compiled['base'].quick.stats.cache_hits.values()))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    row, _, hits = run.stdout.rpartition(" ")
    assert row == str(jacobian(arm, np.ones(6))[2].tolist())
    assert int(hits) == 2


def test_where_nothing_can_be_written_it_compiles_all_the_same(monkeypatch):
    def refuses(_):
        raise OSError

    monkeypatch.setattr(quick_module, "_kept", refuses)
    program = trace(ROBOTS["planar_2r"].chain(), "base")
    out = np.empty(program.shape)
    assert quick(program, LARGE)(np.array([0.3, 0.4]), out)
    np.testing.assert_array_equal(out, jacobian(ROBOTS["planar_2r"].chain(), [0.3, 0.4]))


def test_without_numba_nothing_changes(monkeypatch):
    monkeypatch.setattr(module, "find_spec", lambda _: None)
    monkeypatch.setattr(quick_module, "importlib", SimpleNamespace(util=SimpleNamespace(find_spec=lambda _: None)))  # fmt: skip
    chain = fast(twin(ROBOTS["ur5"].chain()))
    assert not is_fast(chain)
    np.testing.assert_array_equal(jacobian(chain, np.ones(6)), jacobian(ROBOTS["ur5"].chain(), np.ones(6)))  # fmt: skip
    assert quick(trace(chain, "base"), LARGE) is None
