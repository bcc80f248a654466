"""Tables of the same arm with frames placed otherwise are told from tables of another arm."""

from itertools import pairwise

import numpy as np
import pytest
from kinegrade.solutions.chain import ChainError, from_modified, from_standard
from kinegrade.solutions.equivalence import Difference, Equivalence, Given, equivalence
from kinegrade.solutions.kinematics import forward, frames
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS

FREE = Given(base=False, tool=False, senses=False, zero=False)
ARMS = {
    **{name: ROBOTS[name].chain() for name in ROBOTS},
    "RRR oblique": random_chain("RRR", np.random.default_rng(1)),
    "PRR oblique": random_chain("PRR", np.random.default_rng(2)),
    "PRR nearly square": random_chain("PRR", np.random.default_rng(1)),
    "RPRP oblique": random_chain("RPRP", np.random.default_rng(3)),
    "PPP": random_chain("PPP", np.random.default_rng(4)),
}


def frame(x, z, origin):
    result = np.eye(4)
    result[:3, 0], result[:3, 1], result[:3, 2], result[:3, 3] = x, np.cross(z, x), z, origin
    return result


def across(z, rng):
    x = np.cross(z, rng.normal(size=3))
    return x / np.linalg.norm(x)


def placed_otherwise(chain, rng, *, convention):
    """A chain of another legitimate table of the same arm, and its rows, base and tool."""
    n = chain.n
    turned, slid = rng.uniform(-3, 3, n), rng.uniform(-0.5, 0.5, n)
    home = np.where(np.array(list(chain.kinds)) == "R", turned, slid)
    axes = frames(chain, home)
    signs = rng.choice([-1.0, 1.0], n)
    z = [sign * axis[:3, 2] for sign, axis in zip(signs, axes[:-1], strict=True)]
    p = [axis[:3, 3].copy() for axis in axes[:-1]]
    for i, kind in enumerate(chain.kinds):
        if kind == "P":  # a slide has no place
            p[i] = p[i] + rng.normal(0, 0.5, 3)
    normals = [common_normal(z[i], p[i], z[i + 1], p[i + 1], rng) for i in range(n - 1)]
    on_first = frame(across(z[0], rng), z[0], p[0] + rng.uniform(-1, 1) * z[0])
    on_last = p[-1] + rng.uniform(-1, 1) * z[-1]
    if convention == "standard":
        inner = [frame(x, z[i + 1], foot) for i, (x, _, foot) in enumerate(normals)]
        last = frame(across(z[-1], rng), z[-1] * rng.choice([-1, 1]), on_last)
        placed, build = [on_first, *inner, last], from_standard
    else:
        inner = [frame(x, z[i], foot) for i, (x, foot, _) in enumerate(normals)]
        placed, build = [on_first, *inner, frame(across(z[-1], rng), z[-1], on_last)], from_modified
    rows = np.array([row_between(*pair, convention) for pair in pairwise(placed)])
    tool = np.linalg.inv(placed[-1]) @ axes[-1]
    return build(rows, chain.kinds, placed[0], tool), rows, placed[0], tool


def common_normal(z, p, other_z, other_p, rng):
    """Direction of the common normal of two axes, and its feet on both."""
    normal, between = np.cross(z, other_z), other_p - p
    if np.linalg.norm(normal) > 1e-9:
        x = normal / np.linalg.norm(normal) * rng.choice([-1, 1])
        along = np.linalg.solve(np.column_stack([z, -other_z, x]), between)
        return x, p + along[0] * z, other_p + along[1] * other_z
    apart = between - (between @ z) * z
    foot = p + rng.uniform(-1, 1) * z
    if np.linalg.norm(apart) > 1e-9:
        return apart / np.linalg.norm(apart) * rng.choice([-1, 1]), foot, foot + apart
    return across(z, rng), foot, foot


def row_between(a, b, convention):
    """theta, d, a, alpha that lead from one frame to the next."""
    T = np.linalg.inv(a) @ b
    if convention == "standard":
        theta, alpha = np.arctan2(T[1, 0], T[0, 0]), np.arctan2(T[2, 1], T[2, 2])
        x = np.array([np.cos(theta), np.sin(theta), 0])
        return theta, T[2, 3], x @ T[:3, 3], alpha
    theta, alpha = np.arctan2(-T[0, 1], T[0, 0]), np.arctan2(-T[1, 2], T[2, 2])
    return theta, T[1:3, 3] @ [-np.sin(alpha), np.cos(alpha)], T[0, 3], alpha


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("name", ARMS)
def test_frames_placed_otherwise_are_the_same_arm(name, convention):
    chain, rng = ARMS[name], np.random.default_rng(0)
    for _ in range(8):
        other, *_ = placed_otherwise(chain, rng, convention=convention)
        found = equivalence(chain, other, FREE)
        assert isinstance(found, Equivalence), found
        q = rng.uniform(-2, 2, (5, chain.n))
        ours = found.base @ forward(chain, q) @ found.tool
        np.testing.assert_allclose(forward(other, found.signs * q + found.offsets), ours, atol=1e-9)


@pytest.mark.parametrize("name", ARMS)
def test_with_base_and_tool_given_they_are_the_identity(name):
    chain, rng = ARMS[name], np.random.default_rng(1)
    for _ in range(4):
        other, *_ = placed_otherwise(chain, rng, convention="standard")
        found = equivalence(chain, other, Given(senses=False, zero=False))
        assert isinstance(found, Equivalence), found
        np.testing.assert_allclose(found.base, np.eye(4), atol=1e-12)
        np.testing.assert_allclose(found.tool, np.eye(4), atol=1e-9)


@pytest.mark.parametrize("name", ARMS)
def test_an_arm_is_its_own_equivalent_with_everything_given(name):
    found = equivalence(ARMS[name], ARMS[name])
    assert isinstance(found, Equivalence), found
    np.testing.assert_allclose(found.offsets, 0, atol=1e-9)
    assert (found.signs == 1).all()


def edited(rows, kinds, base, tool, i, column, value):
    changed = rows.copy()
    changed[i, column] = value
    return from_standard(changed, kinds, base, tool)


@pytest.mark.parametrize(
    "name", ["rrt_offset", "stanford", "articulated_6r", "puma560", "RRR oblique"]
)
def test_a_wrong_cell_makes_another_arm_of_it(name):
    """A twist, and a distance between axes, belong to the arm however frames are placed."""
    chain, rng = ARMS[name], np.random.default_rng(2)
    _, rows, base, tool = placed_otherwise(chain, rng, convention="standard")
    for i in range(chain.n - 1):
        other = edited(rows, chain.kinds, base, tool, i, 3, rows[i, 3] + 0.3)
        found = equivalence(chain, other, FREE)
        assert isinstance(found, Difference)
        assert found.axis <= i + 2


def test_another_sense_is_wrong_where_senses_are_given():
    rows = [[0, 0, 0, np.pi / 2], [0, 0, 1, 0], [0, 0, 0.5, 0]]
    flipped = [[0, 0, 0, -np.pi / 2], [0, 0, 1, 0], [0, 0, 0.5, 0]]
    arm, other = from_standard(rows, "RRR"), from_standard(flipped, "RRR")
    assert isinstance(equivalence(arm, other, Given(tool=False)), Difference)
    found = equivalence(arm, other, Given(tool=False, senses=False))
    assert isinstance(found, Equivalence)
    assert found.signs.tolist() == [1, -1, -1]


def test_other_joint_values_at_home_are_wrong_where_the_zero_is_given():
    rows = [[0, 0, 1, 0], [0, 0, 0.5, 0]]
    turned = [[0.3, 0, 1, 0], [0, 0, 0.5, 0]]
    arm, other = from_standard(rows, "RR"), from_standard(turned, "RR")
    found = equivalence(arm, other, Given(zero=False))
    assert isinstance(found, Equivalence)
    np.testing.assert_allclose(found.offsets, [-0.3, 0], atol=1e-12)
    refused = equivalence(arm, other)
    assert isinstance(refused, Difference)
    assert refused.reason == "the home pose has other joint values"


@pytest.mark.parametrize("name", ARMS)
def test_three_decimals_are_close_enough(name):
    chain, rng = ARMS[name], np.random.default_rng(3)
    _, rows, base, tool = placed_otherwise(chain, rng, convention="standard")
    other = from_standard(np.round(rows, 3), chain.kinds, base, tool)
    assert isinstance(equivalence(chain, other, FREE, angle=2e-3, length=3e-3), Equivalence)


def test_other_joints_are_refused():
    with pytest.raises(ChainError, match="chains of the same joints, got 'RR' and 'RRR'"):
        equivalence(ARMS["planar_2r"], ARMS["planar_3r"])
