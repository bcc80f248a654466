"""All postures in closed form, tried in forward kinematics; the one that a pose was made with is always among them."""

import numpy as np
import pytest
from kinegrade.solutions.chain import Chain, ChainError, elementary, from_standard, steps_transform
from kinegrade.solutions.inverse import inverse_kinematics
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.limits import are_outside
from kinegrade.solutions.postures import Postures, all_postures
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.rotation import rotation_vector

HALF = np.pi / 2
SOLVED = ("puma560", "ur5", "stanford", "stanford_spong", "articulated_6r")


def assert_all_met(chain: Chain, pose: np.ndarray, found: Postures) -> None:
    length = np.linalg.norm(chain.fixed[:, :3, 3], axis=-1).sum()
    reached = forward(chain, found.q)
    assert np.linalg.norm(reached[:, :3, 3] - pose[:3, 3], axis=-1).max() <= 1e-9 * length
    assert (
        np.linalg.norm(rotation_vector(reached[:, :3, :3] @ pose[:3, :3].T), axis=-1).max() <= 1e-9
    )


def is_among(chain: Chain, found: Postures, q: np.ndarray) -> bool:
    gap = found.q - q
    turns = np.array(list(chain.kinds)) == "R"
    gap[:, turns] = np.remainder(gap[:, turns] + np.pi, 2 * np.pi) - np.pi
    return bool((np.abs(gap).max(axis=1) < 1e-6).any())


@pytest.mark.parametrize("name", SOLVED)
def test_of_200_random_poses_all_postures_are_found(name):
    robot = ROBOTS[name]
    chain, rng = robot.chain(), np.random.default_rng(1)
    counts = set()
    for q in rng.uniform(*np.transpose(robot.limits), (200, 6)):
        pose = forward(chain, q)
        found = all_postures(chain, pose)
        assert_all_met(chain, pose, found)
        assert is_among(chain, found, q)
        counts.add(len(found.q))
    assert counts <= {2, 4, 6, 8}
    assert max(counts) == 8


def placed(chain: Chain, rng: np.random.Generator) -> Chain:
    """The same arm on another base with another tool, its zeros elsewhere."""
    fixed = chain.fixed.copy()
    for i in (0, 6):
        away = steps_transform([("Rz", rng.uniform(-3, 3)), ("Rx", rng.uniform(-3, 3)), ("Tx", rng.uniform(-0.5, 0.5)), ("Ry", 1.0)])  # fmt: skip
        fixed[i] = away @ fixed[i] if i == 0 else fixed[i] @ away
    for i in range(1, 7):
        fixed[i] = elementary("Rz", rng.uniform(-3, 3)) @ fixed[i]
    return Chain(fixed, chain.kinds)


def wristed(rng: np.random.Generator) -> Chain:
    """Axes 2 and 3 parallel, all else oblique and offset, and three oblique axes that meet."""
    a1, a2, a3, d2, d3, d4 = rng.uniform(0.1, 0.6, 6)
    oblique = rng.uniform(0.5, 2.6, 4)
    rows = [(0, 0.3, a1, oblique[0]), (0, d2, a2, rng.choice([0.0, np.pi])), (0, d3, a3, oblique[1]), (0, d4, 0, oblique[2]), (0, 0, 0, oblique[3]), (0, 0.1, 0, 0)]  # fmt: skip
    return placed(from_standard(rows, "RRRRRR"), rng)


def three_parallel(rng: np.random.Generator) -> Chain:
    a1, a2, a3, a4, d2, d4, d5 = rng.uniform(0.1, 0.6, 7)
    oblique = rng.uniform(0.5, 2.6, 3)
    flips = rng.choice([0.0, np.pi], 2)
    rows = [(0, 0.3, a1, oblique[0]), (0, d2, a2, flips[0]), (0, 0.05, a3, flips[1]), (0, d4, a4, oblique[1]), (0, d5, 0, oblique[2]), (0, 0.1, 0, 0)]  # fmt: skip
    return placed(from_standard(rows, "RRRRRR"), rng)


@pytest.mark.parametrize("family", [wristed, three_parallel])
@pytest.mark.parametrize("seed", range(50))
def test_so_are_those_of_random_members_of_both_families(family, seed):
    rng = np.random.default_rng(seed)
    chain = family(rng)
    for q in rng.uniform(-np.pi, np.pi, (3, 6)):
        pose = forward(chain, q)
        found = all_postures(chain, pose)
        assert_all_met(chain, pose, found)
        assert is_among(chain, found, q)
        assert len(found.q) <= 8


@pytest.mark.parametrize("name", ["puma560", "ur5"])
def test_what_iterations_find_is_among_them(name):
    robot = ROBOTS[name]
    chain, rng = robot.chain(), np.random.default_rng(2)
    for q in rng.uniform(*np.transpose(robot.limits), (5, 6)):
        pose = forward(chain, q)
        other = inverse_kinematics(chain, pose, rng.uniform(-1, 1, 6), starts=20)
        assert other.converged
        assert is_among(chain, all_postures(chain, pose), other.q)


@pytest.mark.parametrize("name", SOLVED)
def test_limits_leave_out_what_no_full_turn_brings_within_them(name):
    robot = ROBOTS[name]
    chain, rng = robot.chain(), np.random.default_rng(3)
    for q in rng.uniform(*np.transpose(robot.limits), (20, 6)):
        pose = forward(chain, q)
        every, within = all_postures(chain, pose), all_postures(chain, pose, limits=robot.limits)
        assert_all_met(chain, pose, within)
        assert not are_outside(robot.limits, within.q).any()
        assert is_among(chain, within, q)
        assert len(within.q) <= len(every.q)


def test_limits_beyond_half_a_turn_are_met_by_full_turns():
    chain = ROBOTS["ur5"].chain()
    limits = np.tile([np.pi, 3 * np.pi], (6, 1))
    q = np.array([4.0, 5.0, 6.0, 4.5, 7.0, 8.0])
    found = all_postures(chain, forward(chain, q), limits=limits)
    assert not are_outside(limits, found.q).any()
    assert np.abs(found.q - q).max(axis=1).min() < 1e-9


@pytest.mark.parametrize(
    ("name", "q", "joints"),
    [
        ("puma560", (0.1, 0.5, 0.1, 0.8, 0.0, 0.2), (4, 6)),
        ("ur5", (0.3, -1.0, 1.2, 0.4, 0.0, 0.5), (2, 3, 4, 6)),
        ("stanford", (0.3, 0.7, 0.4, 0.2, 0.0, 0.5), (4, 6)),
    ],
)
def test_singular_postures_are_said_in_a_sentence(name, q, joints):
    chain = ROBOTS[name].chain()
    pose = forward(chain, np.array(q))
    found = all_postures(chain, pose)
    assert_all_met(chain, pose, found)
    assert joints in found.singular
    assert f"{' and '.join(f'q{i}' for i in joints)} may move while the tool stands still" in str(
        found
    )


def test_a_regular_pose_and_one_out_of_reach_have_sentences_too():
    chain = ROBOTS["puma560"].chain()
    pose = forward(chain, np.array([0.1, 0.5, 0.1, 0.8, 0.4, 0.2]))
    assert str(all_postures(chain, pose)) == "8 postures bring the tool there."
    pose[0, 3] += 5.0
    assert str(all_postures(chain, pose)) == "No posture brings the tool there."
    assert all_postures(chain, pose).q.shape == (0, 6)


@pytest.mark.parametrize(
    "chain",
    [
        ROBOTS["panda"].chain(),
        ROBOTS["scara"].chain(),
        random_chain("RRRRRR", np.random.default_rng(0)),
    ],
)
def test_other_arms_are_refused_with_the_way_out(chain):
    with pytest.raises(
        ChainError,
        match="axes 2, 3 and 4 parallel and axes 5 and 6 meeting; inverse_kinematics takes any arm",
    ):
        all_postures(chain, np.eye(4))


def test_arguments_of_the_wrong_form_are_refused():
    chain = ROBOTS["ur5"].chain()
    with pytest.raises(ChainError, match="limits takes 6 pairs"):
        all_postures(chain, np.eye(4), limits=[(0, 1)])
    with pytest.raises(ChainError, match="target takes one transform"):
        all_postures(chain, np.eye(3))
