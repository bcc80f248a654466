"""Screws to chains and back, for every arm and for random ones."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kinegrade.solutions.axes import along
from kinegrade.solutions.chain import Array, Chain, ChainError
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.robots import ROBOTS, Robot
from kinegrade.solutions.rotation import inverse_transform
from kinegrade.solutions.screws import from_screws, screws

every = pytest.mark.parametrize("arm", ROBOTS.values(), ids=list(ROBOTS))
PLANAR = [[0, 0, 0, 0, 0, 1], [0, -1, 0, 0, 0, 1]]


def same_motion(one: Chain, other: Chain, atol: float = 1e-12) -> None:
    q = np.random.default_rng(4).uniform(-2, 2, (8, one.n))
    np.testing.assert_allclose(forward(other, q), forward(one, q), rtol=0, atol=atol)
    np.testing.assert_allclose(jacobian(other, q), jacobian(one, q), rtol=0, atol=atol)


def exponential(screw: Array, q: float) -> Array:
    """exp([S] q) by its power series, knowing nothing of axes."""
    v, (x, y, z) = screw[:3], screw[3:]
    bracket = np.array([[0, -z, y, v[0]], [z, 0, -x, v[1]], [-y, x, 0, v[2]], [0, 0, 0, 0]]) * q
    total, term = np.eye(4), np.eye(4)
    for k in range(1, 30):
        term = term @ bracket / k
        total = total + term
    return total


@every
def test_a_chain_of_a_robots_screws_moves_as_the_robot(arm: Robot):
    chain = arm.chain()
    axes, home = screws(chain)
    assert axes.shape == (arm.n, 6)
    same_motion(chain, from_screws(axes, home, arm.kinds))
    assert from_screws(axes, home).kinds == arm.kinds


@every
def test_a_product_of_exponentials_is_the_forward_kinematics(arm: Robot):
    axes, home = screws(arm.chain())
    q = np.random.default_rng(5).uniform(-1, 1, arm.n)
    T = np.eye(4)
    for screw, value in zip(axes, q, strict=True):
        T = T @ exponential(screw, value)
    np.testing.assert_allclose(T @ home, forward(from_screws(axes, home), q), rtol=0, atol=1e-13)


@settings(max_examples=40, deadline=None)
@given(st.text("RP", min_size=1, max_size=7), st.integers(0, 2**32))
def test_screws_of_random_chains_come_back(pattern: str, seed: int):
    chain = random_chain(pattern, np.random.default_rng(seed))
    axes, home = screws(chain)
    again = from_screws(axes, home, pattern)
    same_motion(chain, again)
    np.testing.assert_allclose(screws(again)[0], axes, rtol=0, atol=1e-13)


def test_the_planar_arms_screws_are_those_of_the_textbook():
    axes, home = screws(ROBOTS["planar_2r"].chain())
    np.testing.assert_array_equal(axes, PLANAR)
    np.testing.assert_array_equal(home[:3, 3], [1.7, 0, 0])


def test_the_first_screw_is_the_first_column_moved_to_the_base_origin():
    chain = ROBOTS["puma560"].chain({"d1": 0.5})
    axes, _ = screws(chain)
    np.testing.assert_array_equal(axes[0], [0, 0, 0, 0, 0, 1])
    np.testing.assert_allclose(
        axes[1], [0.5, 0, 0, 0, -1, 0], rtol=0, atol=1e-15
    )  # p x w at the height 0.5


def test_axes_along_the_coordinates_leave_zeros_and_ones():
    chain = from_screws(*screws(ROBOTS["puma560"].chain()))
    rotations = chain.fixed[:, :3, :3]
    assert set(np.unique(rotations)) <= {-1.0, 0.0, 1.0}


@pytest.mark.parametrize(
    "z",
    [
        (1, 0, 0),
        (0, 1, 0),
        (0, 0, 1),
        (-1, 0, 0),
        (0.6, 0, 0.8),
        (1, 2e-6, 0),
        (1, 0.099, 0),
        (1, 0.11, 0),
    ],
)
def test_a_frame_along_an_axis_is_right_handed(z: tuple[float, ...]):
    unit = np.array(z) / np.linalg.norm(z)
    frame = along(unit, np.array([1.0, 2.0, 3.0]))
    np.testing.assert_allclose(frame[:3, 2], unit, rtol=0, atol=0)
    np.testing.assert_allclose(frame[:3, :3].T @ frame[:3, :3], np.eye(3), rtol=0, atol=1e-15)
    assert np.linalg.det(frame[:3, :3]) == pytest.approx(1)
    np.testing.assert_allclose(frame @ inverse_transform(frame), np.eye(4), rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("axes", "home", "kinds", "sentence"),
    [
        (PLANAR[0], np.eye(4), None, r"screws takes shape \(n, 6\), got \(6,\)"),
        (np.zeros((0, 6)), np.eye(4), None, r"screws takes shape \(n, 6\), got \(0, 6\)"),
        (PLANAR, np.eye(3), None, r"home takes shape \(4, 4\), got \(3, 3\)"),
        (PLANAR, 2 * np.eye(4), None, "fixed\\[2\\] takes the last row"),
        (PLANAR, np.eye(4), "RP", "kinds takes 'RR', as w = 0 in a prismatic screw only, got 'RP'"),
        ([[0, 0, 0, 0, 0, 2]], np.eye(4), None, "screw 1 takes w of length 1, .*, got length 2"),
        (
            [PLANAR[0], [0, 0, 0.5, 0, 0, 0]],
            np.eye(4),
            None,
            "screw 2 takes v of length 1 where w = 0, got length 0.5",
        ),
        (
            [[0, 0, 0, 0, 0, 0]],
            np.eye(4),
            None,
            "screw 1 takes v of length 1 where w = 0, got length 0",
        ),
        (
            [[0, 0, 0.1, 0, 0, 1]],
            np.eye(4),
            None,
            "screw 1 takes v normal to w, as the joint has no pitch, got pitch",
        ),
        ([[0, 0, math.nan, 0, 0, 1]], np.eye(4), None, "screws takes finite numbers"),
        ([[0, 0, 0, 0, 0, 1j]], np.eye(4), None, "screws takes real numbers"),
    ],
)
def test_wrong_screws_are_refused_with_a_sentence(
    axes: Any, home: Any, kinds: str | None, sentence: str
):
    with pytest.raises(ChainError, match=sentence):
        from_screws(axes, home, kinds)
