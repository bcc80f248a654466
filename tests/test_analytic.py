"""Angles of rotations and Jacobians of their rates: golden numbers, differences, lost angles."""

import math
from itertools import product
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.analytic import (
    EULER_ZYZ,
    ROLL_PITCH_YAW,
    ROLL_PITCH_YAW_OF_GRIPPERS,
    SINGULAR,
    RepresentationError,
    analytic_jacobian,
    angles_from_rotation,
    angular_velocity_map,
    rotation_from_angles,
)
from kinegrade.solutions.chain import Array, ChainError, elementary, from_standard
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.robots import ROBOTS
from test_golden import GOLDEN, chain_of

LETTERS = ["".join(x) for x in product("xyz", repeat=3) if x[0] != x[1] != x[2]]
SETS = [*LETTERS, *(x.upper() for x in LETTERS)]
STEP = 1e-3
FIELDS = {
    "analytic_rpy_zyx_roll_pitch_yaw": ROLL_PITCH_YAW,
    "analytic_rpy_xyz_rtb": ROLL_PITCH_YAW_OF_GRIPPERS,
    "analytic_euler_zyz": EULER_ZYZ,
}
every_set = pytest.mark.parametrize("axes", SETS)


def wrapped(differences: Array) -> Array:
    return (differences + math.pi) % (2 * math.pi) - math.pi


def some_angles(axes: str, count: int = 30) -> Array:
    """Angles (count, 3) whose middle one is in the set's range, off its ends."""
    rng = np.random.default_rng(2)
    angles = rng.uniform(-3.1, 3.1, (count, 3))
    low = 0.1 if axes[0] == axes[2] else 0.1 - math.pi / 2
    angles[:, 1] = rng.uniform(low, low + (math.pi - 0.2), count)
    return angles


def slope(function: Any, x: Array, direction: Array) -> Array:
    """Derivative of angles or rotations, differences of angles wrapped."""
    at = [function(x + k * STEP * direction) for k in (-2, -1, 1, 2)]
    return (8 * wrapped(at[2] - at[1]) - wrapped(at[3] - at[0])) / (12 * STEP)


def test_there_are_twelve_sets_in_two_readings():
    assert len(LETTERS) == 12
    assert len(SETS) == 24


@pytest.mark.parametrize("name", GOLDEN)
@pytest.mark.parametrize("field", FIELDS)
def test_angles_and_jacobians_agree_with_the_golden_ones_or_are_refused(name: str, field: str):
    chain, axes = chain_of(name), FIELDS[field]
    for case in GOLDEN[name]["cases"]:
        R = forward(chain, case["q"])[:3, :3]
        if case[field] is None:
            with pytest.raises(RepresentationError):
                analytic_jacobian(chain, case["q"], axes)
            continue
        angles = angles_from_rotation(R, axes)
        np.testing.assert_allclose(wrapped(angles - case[field]["angles"]), 0, rtol=0, atol=1e-13)
        expected = np.array(case[field]["J"])
        scale = 1e-13 * max(1.0, float(np.abs(expected).max()))
        np.testing.assert_allclose(
            analytic_jacobian(chain, case["q"], axes), expected, rtol=0, atol=scale
        )


@every_set
def test_the_name_says_the_axes_in_reading_order(axes: str):
    for angles in some_angles(axes, 5):
        turns = [elementary(f"R{x.lower()}", angle) for x, angle in zip(axes, angles, strict=True)]
        a, b, c = turns if axes.isupper() else reversed(turns)
        np.testing.assert_allclose(
            rotation_from_angles(angles, axes), (a @ b @ c)[:3, :3], rtol=0, atol=1e-15
        )


@every_set
def test_angles_come_back_from_their_rotation(axes: str):
    angles = some_angles(axes)
    np.testing.assert_allclose(
        angles_from_rotation(rotation_from_angles(angles, axes), axes), angles, atol=1e-13
    )


@every_set
def test_the_angular_velocity_is_the_axial_vector_of_the_rotation_that_the_rates_make(axes: str):
    for angles in some_angles(axes, 5):
        E, R = angular_velocity_map(angles, axes), rotation_from_angles(angles, axes)
        for column, direction in zip(E.T, np.eye(3), strict=True):
            W = slope(lambda x: rotation_from_angles(x, axes), angles, direction) @ R.T
            np.testing.assert_allclose(column, [W[2, 1], W[0, 2], W[1, 0]], rtol=0, atol=1e-10)


@every_set
def test_the_determinant_of_the_map_is_the_cosine_or_the_sine_of_the_middle_angle(axes: str):
    angles = some_angles(axes)
    size = np.abs((np.sin if axes[0] == axes[2] else np.cos)(angles[:, 1]))
    np.testing.assert_allclose(
        np.abs(np.linalg.det(angular_velocity_map(angles, axes))), size, rtol=0, atol=1e-14
    )


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("axes", ["xyz", "zyx", "YZX", "ZYZ", "XZX"])
def test_the_analytic_jacobian_agrees_with_finite_differences(name: str, axes: str):
    robot, rng, tested = ROBOTS[name], np.random.default_rng(3), 0
    chain, (low, high) = robot.chain(), np.array(robot.limits).T
    for q in rng.uniform(low, high, (8, robot.n)):
        try:
            angles = angles_from_rotation(forward(chain, q)[:3, :3], axes)
        except RepresentationError:
            continue
        size = abs((math.sin if axes[0] == axes[2] else math.cos)(angles[1]))
        if size < 0.1:
            continue  # differences of a thousandth are too coarse there
        tested += 1
        of_angles = [
            slope(lambda x: angles_from_rotation(forward(chain, x)[:3, :3], axes), q, d)
            for d in np.eye(robot.n)
        ]
        J = analytic_jacobian(chain, q, axes)
        np.testing.assert_allclose(J[3:], np.transpose(of_angles), rtol=0, atol=1e-10 / size**5)
        np.testing.assert_array_equal(J[:3], jacobian(chain, q)[:3])
    assert tested or name.startswith(("planar", "scara", "rrt_scara", "rpp"))


@every_set
def test_the_outer_angles_are_refused_below_the_stated_bound_and_good_above_it(axes: str):
    start = 0.0 if axes[0] == axes[2] else math.pi / 2
    near = rotation_from_angles([0.4, start - 0.9 * SINGULAR, -0.7], axes)
    far = rotation_from_angles([0.4, start - 1.1 * SINGULAR * (1 if start else -1), -0.7], axes)
    with pytest.raises(
        RepresentationError, match=f"{axes} angles take a middle angle whose .* is at least 1e-06"
    ):
        angles_from_rotation(near, axes)
    np.testing.assert_allclose(
        angles_from_rotation(far, axes)[[0, 2]], [0.4, -0.7], rtol=0, atol=1e-9
    )


def test_the_refusal_says_which_rotation_of_a_batch_it_is():
    R = rotation_from_angles(
        [[[0.1, 0.2, 0.3], [0.1, 0.2, 0.3]], [[0.1, 0.2, 0.3], [0.1, math.pi / 2, 0.3]]]
    )
    with pytest.raises(
        RepresentationError,
        match=r"cosine is at least 1e-06, got .* at index \(1, 1\).*sum or diff",
    ):
        angles_from_rotation(R)


def test_a_pose_without_angles_need_not_be_singular():
    chain = from_standard([[0, 0, 0, math.pi / 2], [0, 0, 0, -math.pi / 2], [0, 0, 0, 0]], "RRR")
    q = [0.3, math.pi / 2, 0.0]
    assert np.linalg.matrix_rank(jacobian(chain, q)) == 3
    analytic_jacobian(chain, q, "ZYZ")
    with pytest.raises(RepresentationError):
        analytic_jacobian(chain, q, "xyz")


@pytest.mark.parametrize("shape", [(), (4,), (0,), (2, 3)])
@pytest.mark.parametrize("axes", ["xyz", "ZYZ"])
def test_results_have_the_documented_shapes(shape: tuple[int, ...], axes: str):
    angles = np.full((*shape, 3), 0.3)
    R = rotation_from_angles(angles, axes)
    assert R.shape == angular_velocity_map(angles, axes).shape == (*shape, 3, 3)
    assert angles_from_rotation(R, axes).shape == (*shape, 3)
    chain = ROBOTS["puma560"].chain()
    assert analytic_jacobian(chain, np.full((*shape, 6), 0.3), axes).shape == (*shape, 6, 6)


@pytest.mark.parametrize("axes", ["xxy", "xyw", "xY", "", "xy", "xYz", "zzz", "wxyz"])
def test_a_set_of_angles_that_does_not_exist_is_refused_with_a_sentence(axes: str):
    with pytest.raises(
        ChainError,
        match=r"axes takes three letters such as 'xyz' \(fixed\) or 'ZYZ' \(moving\), got",
    ):
        rotation_from_angles([0.1, 0.2, 0.3], axes)


def test_wrong_angles_are_refused_with_a_sentence():
    with pytest.raises(ChainError, match=r"angles takes shape \(\.\.\., 3\), got \(2,\)"):
        rotation_from_angles([0.1, 0.2])
    with pytest.raises(ChainError, match="rotation takes right-handed rotations"):
        angles_from_rotation(2 * np.eye(3))
