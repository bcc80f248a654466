"""Rotation vectors: exact at every angle, from nothing to a half turn."""

import math
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import Array, ChainError, elementary
from kinegrade.solutions.rotation import rotation_vector, rotations, vector_rotation

RNG = np.random.default_rng(1)
DIRECTIONS = np.concatenate([np.eye(3), -np.eye(3), RNG.normal(size=(20, 3))])
UNITS = DIRECTIONS / np.linalg.norm(DIRECTIONS, axis=1, keepdims=True)


@pytest.mark.parametrize(
    "angle", [0.0, 1e-300, 1e-12, 1e-7, 1e-3, 1.0, 3.0, math.pi - 1e-3, math.pi - 1e-7]
)
def test_a_vector_comes_back_from_its_rotation(angle: float):
    vectors = angle * UNITS
    np.testing.assert_allclose(
        rotation_vector(vector_rotation(vectors)), vectors, rtol=0, atol=1e-15 + 4e-16 * angle
    )


def test_a_half_turn_gives_one_of_the_two_opposite_vectors():
    found = rotation_vector(vector_rotation(math.pi * UNITS))
    np.testing.assert_allclose(np.abs(np.sum(found * UNITS, axis=-1)), math.pi, rtol=0, atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(found, axis=-1), math.pi, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("axis", "motion"), [(0, "Rx"), (1, "Ry"), (2, "Rz")])
def test_a_vector_along_an_axis_is_an_elementary_rotation(axis: int, motion: str):
    R = elementary(motion, 0.7)[:3, :3]
    np.testing.assert_allclose(vector_rotation(0.7 * np.eye(3)[axis]), R, rtol=0, atol=3e-16)
    np.testing.assert_allclose(rotation_vector(R), 0.7 * np.eye(3)[axis], rtol=0, atol=1e-15)


@pytest.mark.parametrize("shape", [(), (4,), (0,), (2, 3)])
def test_results_have_the_documented_shapes(shape: tuple[int, ...]):
    assert rotation_vector(np.broadcast_to(np.eye(3), (*shape, 3, 3))).shape == (*shape, 3)
    assert vector_rotation(np.ones((*shape, 3))).shape == (*shape, 3, 3)


@pytest.mark.parametrize(
    ("R", "sentence"),
    [
        (np.eye(4), r"turn takes shape \(\.\.\., 3, 3\), got \(4, 4\)"),
        (1.0, r"turn takes shape \(\.\.\., 3, 3\), got \(\)"),
        (np.diag([1, 1, -1]), "turn takes right-handed rotations"),
        (2 * np.eye(3), "turn takes right-handed rotations"),
        (np.full((3, 3), np.nan), "turn takes finite numbers"),
    ],
)
def test_what_is_no_rotation_is_refused_with_a_sentence(R: Any, sentence: str):
    with pytest.raises(ChainError, match=sentence):
        rotations("turn", R)


def test_a_vector_of_another_length_is_refused_with_a_sentence():
    with pytest.raises(ChainError, match=r"vector takes shape \(\.\.\., 3\), got \(2,\)"):
        vector_rotation([1.0, 2.0])


def test_seven_digits_are_enough_for_a_rotation():
    R: Array = vector_rotation([0.3, -0.5, 0.8])
    np.testing.assert_allclose(
        rotation_vector(R.astype(np.float32)), [0.3, -0.5, 0.8], rtol=0, atol=1e-6
    )
