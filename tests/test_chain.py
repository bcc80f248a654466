"""Chains: the normal form, its validation, and the tables and frames it is made from."""

import copy
import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import (
    MOTIONS,
    Array,
    Chain,
    ChainError,
    elementary,
    from_frames,
    from_modified,
    from_standard,
    steps_transform,
)
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward, frames, multiplied
from kinegrade.solutions.robots import ROBOTS, Robot

HALF = math.pi / 2
ROWS = [[0.0, 0.4, 0.1, HALF], [0.3, 0.0, 0.5, 0.0], [0.0, 0.2, 0.0, -HALF]]


def plain(chain: Chain, q: Any) -> Array:
    """C0 E1 C1 ... En Cn, multiplied out."""
    T = chain.fixed[0]
    for kind, value, C in zip(chain.kinds, q, chain.fixed[1:], strict=True):
        T = T @ elementary("Rz" if kind == "R" else "Tz", value) @ C
    return T


@pytest.mark.parametrize("build", [from_standard, from_modified])
@pytest.mark.parametrize("kinds", ["RRR", "RPR", "PPP"])
def test_forward_kinematics_is_the_product_of_the_links(build: Callable[..., Chain], kinds: str):
    chain = build(ROWS, kinds, base=elementary("Rx", 0.3), tool=elementary("Tx", 0.2))
    q = np.array([0.3, -0.7, 1.1])
    np.testing.assert_allclose(forward(chain, q), plain(chain, q), rtol=0, atol=1e-15)
    np.testing.assert_allclose(forward(chain, [q, q])[1], plain(chain, q), rtol=0, atol=2e-15)
    np.testing.assert_allclose(multiplied(chain, q), plain(chain, q), rtol=0, atol=1e-15)
    np.testing.assert_allclose(multiplied(chain, [q, q])[1], plain(chain, q), rtol=0, atol=1e-15)


def test_a_standard_row_is_rz_tz_tx_rx():
    chain = from_standard([[0.3, 0.4, 0.5, 0.6]], "R")
    expected = steps_transform([("Rz", 0.3 + 0.2), ("Tz", 0.4), ("Tx", 0.5), ("Rx", 0.6)])
    np.testing.assert_allclose(forward(chain, [0.2]), expected, rtol=0, atol=1e-15)


def test_a_modified_row_is_rx_tx_rz_tz():
    chain = from_modified([[0.3, 0.4, 0.5, 0.6]], "P")
    expected = steps_transform([("Rx", 0.6), ("Tx", 0.5), ("Rz", 0.3), ("Tz", 0.4 + 0.2)])
    np.testing.assert_allclose(forward(chain, [0.2]), expected, rtol=0, atol=1e-15)


def test_hand_placed_frames_are_those_before_the_joints():
    placements = [elementary("Tz", 3.0), elementary("Rx", HALF)]
    chain = from_frames(placements, "RR", tool=elementary("Tx", 2.0))
    reached = frames(chain, [0.0, 0.0])
    np.testing.assert_array_equal(reached[0], placements[0])
    np.testing.assert_array_equal(reached[1], placements[0] @ placements[1])
    np.testing.assert_array_equal(reached[2], placements[0] @ placements[1] @ elementary("Tx", 2.0))


def test_entries_close_to_zero_and_one_are_snapped():
    chain = from_standard([[HALF, 0.0, 100.0, -HALF]], "P")
    assert set(chain.fixed.ravel()) <= {0.0, 1.0, -1.0, 100.0}
    assert not np.signbit(chain.fixed[chain.fixed == 0]).any()


def test_entries_that_are_merely_small_are_kept():
    fixed = np.array([np.eye(4), elementary("Tx", 1e-9)])
    assert Chain(fixed, "R").fixed[1, 0, 3] == 1e-9


@pytest.mark.parametrize("scale", [1e-20, 1e-6, 1.0, 1e6, 1e20])
def test_lengths_are_snapped_as_shares_of_the_longest(scale: float):
    fixed = np.array(
        [
            elementary("Tx", 0.3),
            elementary("Ty", 3e-15),
            elementary("Tz", 1.5e-15) @ elementary("Tx", 2),
        ]
    )
    fixed[:, :3, 3] *= scale
    kept = Chain(fixed, "RR").fixed[:, :3, 3]
    np.testing.assert_array_equal(kept[:2], fixed[:2, :3, 3])
    assert kept[2].tolist() == [2 * scale, 0.0, 0.0]


@pytest.mark.parametrize("scale", [1e-6, 1e6])
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=lambda robot: robot.name)
def test_an_arm_of_any_size_has_the_same_jacobian_in_its_own_lengths(robot: Robot, scale: float):
    slides = np.array([kind == "P" for kind in robot.kinds])
    q = np.random.default_rng(8).uniform(-1, 1, (20, robot.n))
    other = robot.chain({name: scale * value for name, value in robot.parameters.items()})
    unit = np.where(np.arange(6)[:, None] < 3, np.where(slides, 1.0, scale), 1.0)
    for frame in ("base", "tool"):
        J = jacobian(robot.chain(), q, frame)
        there = np.where(slides, scale * q, q)
        np.testing.assert_allclose(jacobian(other, there, frame) / unit, J, rtol=0, atol=1e-14)
        np.testing.assert_allclose(
            jacobian(other, there[0], frame) / unit, J[0], rtol=0, atol=1e-14
        )
    assert [x.size for x in map(np.flatnonzero, other.fixed)] == [
        x.size for x in map(np.flatnonzero, robot.chain().fixed)
    ]


def test_the_constants_are_read_only_and_a_copy():
    fixed = np.array([np.eye(4), np.eye(4)])
    chain = Chain(fixed, "R")
    fixed[0, 0, 3] = 5.0
    assert chain.fixed[0, 0, 3] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        chain.fixed[0, 0, 3] = 1.0


@pytest.mark.parametrize(
    "duplicate",
    [copy.deepcopy, lambda chain: pickle.loads(pickle.dumps(chain))],  # noqa: S301 - our own
)
def test_a_chain_travels_between_processes_after_it_was_used(duplicate: Callable[[Chain], Chain]):
    chain = from_standard(ROWS, "RPR")
    J = jacobian(chain, [0.1, 0.2, 0.3])
    twin = duplicate(chain)
    assert not twin.fixed.flags.writeable
    np.testing.assert_array_equal(jacobian(twin, [0.1, 0.2, 0.3]), J)


def test_chains_are_compared_by_identity():
    chain = from_standard(ROWS, "RRR")
    assert hash(chain) == hash(chain)
    assert chain != from_standard(ROWS, "RRR")


@pytest.mark.parametrize("motion", MOTIONS)
def test_elementary_motions_have_the_shape_of_their_amounts(motion: str):
    assert elementary(motion, 0.2).shape == (4, 4)
    assert elementary(motion, np.zeros((5, 3))).shape == (5, 3, 4, 4)
    np.testing.assert_allclose(
        elementary(motion, 0.2) @ elementary(motion, -0.2), np.eye(4), atol=1e-16
    )


def test_rotations_are_right_handed():
    for axis, (i, j) in {"x": (1, 2), "y": (2, 0), "z": (0, 1)}.items():
        np.testing.assert_array_equal(elementary(f"R{axis}", HALF)[:3, i], np.eye(3)[j])


LEFT = np.diag([1.0, 1.0, -1.0, 1.0])
SHEARED = np.eye(4) + np.diag([0.1, 0, 0], 1)
PROJECTIVE = np.eye(4) + np.diag([0, 0, 0.1], -1)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (
            lambda: Chain(np.eye(4)[None], ""),
            r"kinds takes one letter R or P for each joint, got ''",
        ),
        (
            lambda: Chain(np.array([np.eye(4)] * 3), "RX"),
            r"kinds takes one letter R or P for each joint, got 'RX'",
        ),
        (
            lambda: Chain(np.array([np.eye(4)] * 3), "R"),
            r"fixed takes shape \(2, 4, 4\).*got \(3, 4, 4\)",
        ),
        (
            lambda: Chain(np.array([np.eye(4), LEFT]), "R"),
            r"fixed\[1\] takes a right-handed rotation",
        ),
        (
            lambda: Chain(np.array([SHEARED, np.eye(4)]), "R"),
            r"fixed\[0\] takes a right-handed rotation",
        ),
        (lambda: Chain(np.array([np.eye(4), PROJECTIVE]), "R"), r"fixed\[1\] takes the last row"),
        (
            lambda: from_standard([[0, 0, 0, math.nan]], "R"),
            "rows takes finite numbers, got NaN or infinity",
        ),
        (
            lambda: from_standard([[0, 0, 0]], "R"),
            r"rows takes shape \(1, 4\) for kinds 'R', got \(1, 3\)",
        ),
        (lambda: from_standard([], ""), r"rows takes shape"),
        (lambda: from_modified([[0, 0, 0, "a"]], "R"), "rows takes real numbers"),
        (
            lambda: from_modified(ROWS, "RRR", tool=np.eye(3)),
            r"tool takes shape \(4, 4\), got \(3, 3\)",
        ),
        (
            lambda: from_frames([np.eye(4)], "RR"),
            r"placements takes shape \(2, 4, 4\), got \(1, 4, 4\)",
        ),
        (lambda: elementary("Rw", 1.0), "motion takes one of Rx, Ry, Rz, Tx, Ty, Tz, got 'Rw'"),
    ],
)
def test_what_is_no_chain_is_refused_with_a_sentence(make: Callable[[], object], sentence: str):
    with pytest.raises(ChainError, match=sentence):
        make()


@pytest.mark.parametrize(
    ("q", "sentence"),
    [
        ([1.0, 2.0], r"q takes shape \(\.\.\., 3\), got \(2,\)"),
        (1.0, r"q takes shape \(\.\.\., 3\), got \(\)"),
        ([], r"q takes shape \(\.\.\., 3\), got \(0,\)"),
        ([0.0, math.nan, 0.0], "q takes finite numbers, got NaN or infinity"),
        ([0.0, math.inf, 0.0], "q takes finite numbers, got NaN or infinity"),
        (["0", "1", "2"], "q takes real numbers, got values of type str"),
        ([True, False, True], "q takes real numbers, got values of type bool"),
        ([0j, 0j, 0j], "q takes real numbers, got values of type complex128"),
        (None, "q takes real numbers, got values of type object"),
        ([[0.0, 1.0, 2.0], [0.0]], "q takes rows of equal length"),
    ],
)
def test_a_wrong_configuration_is_refused_with_a_sentence(q: Any, sentence: str):
    chain = from_standard(ROWS, "RRR")
    for function in (forward, frames, multiplied, jacobian):
        with pytest.raises(ChainError, match=sentence):
            function(chain, q)


@pytest.mark.parametrize("shape", [(), (4,), (0,), (2, 3), (2, 0)])
def test_results_have_the_documented_shapes(shape: tuple[int, ...]):
    chain, q = from_standard(ROWS, "RRP"), np.zeros((*shape, 3), dtype=int)
    for result, tail in (
        (forward(chain, q), (4, 4)),
        (frames(chain, q), (4, 4, 4)),
        (jacobian(chain, q), (6, 3)),
    ):
        assert result.shape == (*shape, *tail)
        assert result.dtype == np.float64
        assert result.flags.c_contiguous
