"""Random chains: repeatable, in any pattern, and far from singular at zero."""

import numpy as np
import pytest
from kinegrade.solutions.chain import ChainError
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import frames
from kinegrade.solutions.random_chain import random_chain

PATTERNS = ["R", "P", "RRR", "PPP", "RRPRRR", "PRPRPR", "RRRRRR", "RPPPPP", "RRRRRRR", "RP" * 6]
every = pytest.mark.parametrize("pattern", PATTERNS)


@every
def test_a_random_chain_has_the_joints_of_its_pattern(pattern: str):
    chain = random_chain(pattern, np.random.default_rng(0))
    assert (chain.kinds, chain.n) == (pattern, len(pattern))


@every
def test_at_zero_its_jacobian_is_well_conditioned_at_the_rank_of_the_pattern(pattern: str):
    rank = min(6, pattern.count("R") + min(3, pattern.count("P")))
    for seed in range(10):
        chain = random_chain(pattern, np.random.default_rng(seed))
        values = np.linalg.svd(jacobian(chain, np.zeros(chain.n)), compute_uv=False)
        assert values[0] < 30 * values[rank - 1]
        assert (values[rank:] < 1e-12).all()


@every
def test_the_same_generator_gives_the_same_chain(pattern: str):
    one, other = (random_chain(pattern, np.random.default_rng(7)) for _ in range(2))
    np.testing.assert_array_equal(one.fixed, other.fixed)
    assert not np.array_equal(one.fixed, random_chain(pattern, np.random.default_rng(8)).fixed)


def test_neighbouring_axes_are_oblique_and_links_have_the_stated_lengths():
    reached = frames(random_chain("RPRRPR", np.random.default_rng(1)), np.zeros(6))
    z, p = reached[:-1, :3, 2], reached[:, :3, 3]
    cosines = (z[1:] * z[:-1]).sum(axis=-1)
    assert (np.abs(cosines) <= np.cos(np.pi / 6) + 1e-12).all()
    lengths = np.linalg.norm(np.diff(p, axis=0), axis=1)
    assert ((lengths > 0.2 - 1e-12) & (lengths < 0.8 + 1e-12)).all()


@pytest.mark.parametrize("pattern", ["", "RRX", "rr", "R R"])
def test_another_pattern_is_refused_with_a_sentence(pattern: str):
    with pytest.raises(
        ChainError, match=f"pattern takes one letter R or P for each joint, got '{pattern}'"
    ):
        random_chain(pattern, np.random.default_rng(0))
