"""Differential inverse kinematics: it converges where it can, and says honestly where it cannot."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import Array, Chain, ChainError, elementary, from_standard
from kinegrade.solutions.descent import Problem
from kinegrade.solutions.inverse import REASONS, Solution, displacement, inverse_kinematics
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.many_starts import within
from kinegrade.solutions.robots import ROBOTS
from kinegrade.solutions.rotation import vector_rotation
from kinegrade.solutions.velocity import pseudoinverse

PUMA = ROBOTS["puma560"]
PLANAR = ROBOTS["planar_2r"].chain({"l1": 1.0, "l2": 0.7})
robots = pytest.mark.parametrize("name", ROBOTS)


def at(x: float, y: float, z: float = 0.0) -> Array:
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


def planar(x: float, y: float, start: Any, **options: Any) -> Solution:
    return inverse_kinematics(PLANAR, at(x, y), start, rows=(0, 1), **options)


def nearby(name: str, count: int = 12) -> list[tuple[Array, Array]]:
    """Targets within the limits and starts up to a quarter radian or metre away."""
    robot, rng = ROBOTS[name], np.random.default_rng(11)
    low, high = np.array(robot.limits).T
    targets = rng.uniform(low, high, (count, robot.n))
    return list(
        zip(
            targets,
            np.clip(targets + rng.uniform(-0.25, 0.25, targets.shape), low, high),
            strict=True,
        )
    )


@robots
def test_a_pose_nearby_is_met_to_the_last_digits(name: str):
    chain = ROBOTS[name].chain()
    for wanted, start in nearby(name):
        found = inverse_kinematics(chain, forward(chain, wanted), start)
        assert found.converged, found
        assert found.iterations <= 60
        missing = displacement(forward(chain, found.q), forward(chain, wanted))
        assert np.linalg.norm(missing[3:]) <= 1e-9
        assert np.linalg.norm(missing[:3]) <= 1e-8


@robots
def test_the_result_keeps_the_limits_and_reports_what_it_reached(name: str):
    robot = ROBOTS[name]
    chain, limits, rng = robot.chain(), np.array(robot.limits), np.random.default_rng(12)
    for q, start in rng.uniform(limits[:, 0], limits[:, 1], (8, 2, robot.n)):
        target = forward(chain, q)
        found = inverse_kinematics(chain, target, start, limits=limits)
        assert ((limits[:, 0] <= found.q) & (found.q <= limits[:, 1])).all()
        missing = displacement(forward(chain, found.q), target)
        assert found.position_error == pytest.approx(np.linalg.norm(missing[:3]), abs=1e-14)
        assert found.rotation_error == pytest.approx(np.linalg.norm(missing[3:]), abs=1e-14)
        assert found.converged == (found.stopped == "converged")
        assert (
            bool(found.held) == (found.stopped == "joint limits") or found.stopped == "iterations"
        )


def test_a_small_displacement_is_s0_4_13_solved():
    chain, q = PUMA.chain(), np.array([0.1, 0.5, 0.1, 0.8, 0.7, 0.2])
    dq = 1e-6 * np.array([1, -2, 3, 1, -1, 2])
    du = displacement(forward(chain, q), forward(chain, q + dq))
    np.testing.assert_allclose(np.linalg.solve(jacobian(chain, q), du), dq, rtol=0, atol=1e-10)
    found = inverse_kinematics(chain, forward(chain, q + dq), q)
    np.testing.assert_allclose(found.q, q + dq, rtol=0, atol=1e-8)


def test_the_small_rotation_vector_is_the_one_of_s0_4_11():
    a, w = at(1, 2, 3), np.array([0.3, -0.4, 0.5])
    a[:3, :3] = vector_rotation([0.5, 0.2, -0.9])
    b = at(1.5, 2, 2)
    b[:3, :3] = vector_rotation(w) @ a[:3, :3]
    np.testing.assert_allclose(displacement(a, b), [0.5, 0, -1, *w], rtol=0, atol=1e-15)
    assert displacement(np.stack([a, a]), b).shape == (2, 6)
    assert displacement(a, np.stack([b] * 4)).shape == (4, 6)


def test_convergence_is_quadratic_at_a_regular_pose():
    chain, q = PUMA.chain(), np.array([0.1, 0.5, 0.1, 0.8, 0.7, 0.2])
    target = forward(chain, q + 0.05)
    path = [inverse_kinematics(chain, target, q, iterations=k) for k in range(5)]
    errors = [found.position_error + found.rotation_error for found in path]
    assert all(after < 30 * before**2 + 1e-15 for before, after in pairwise(errors))
    assert errors[-1] < 1e-14


def test_s0s_arm_reaches_its_printed_point():
    chain = ROBOTS["three_axis"].chain({"L": 3, "a2": 2, "a3": 2})
    found = inverse_kinematics(
        chain, at(3, 0, 3 + math.sqrt(3)), (0.2, -0.3, 0.2), rows=slice(0, 3)
    )
    assert found.converged
    np.testing.assert_allclose(found.q, [0, -math.pi / 6, math.pi / 6], rtol=0, atol=1e-8)


def test_a_pose_that_is_met_already_costs_nothing():
    q = np.linspace(0.1, 0.6, 6)
    found = inverse_kinematics(PUMA.chain(), forward(PUMA.chain(), q), q)
    assert found.stopped == "converged"
    assert found.iterations == 0
    np.testing.assert_array_equal(found.q, q)


def test_no_step_is_longer_than_asked_and_none_increases_the_error():
    q, target = np.array([0.3, 0.4]), (-1.2, 0.3)
    path = [planar(*target, q, iterations=k, longest_step=0.1) for k in range(25)]
    moves = np.diff([x.q for x in path], axis=0)
    assert np.abs(moves).max() == pytest.approx(0.1)
    assert (np.diff([x.position_error for x in path]) <= 0).all()


@pytest.mark.parametrize(
    ("x", "distance"), [(1.8, 0.1), (100.0, 98.3), (0.2, 0.1), (0.0, 0.3), (1.700001, 1e-6)]
)
def test_a_point_out_of_reach_is_said_to_be_so_and_the_nearest_point_is_found(
    x: float, distance: float
):
    found = planar(x, 0, (0.3, 0.4))
    assert found.stopped == "local minimum"
    assert not found.held
    assert found.position_error == pytest.approx(distance, rel=1e-9)


@pytest.mark.parametrize("x", [1.7, 0.3, 1.7 - 1e-8])
def test_a_point_on_the_rim_of_the_workspace_is_met(x: float):
    assert planar(x, 0, (0.3, 0.4)).converged


@pytest.mark.parametrize(
    ("x", "start"), [(1.2, (0, 0)), (-1.2, (0, 0)), (1.2, (0, math.pi)), (0.5, (math.pi, 0))]
)
def test_an_arm_stretched_along_the_way_to_go_leaves_its_singular_pose(x: float, start: Any):
    J = jacobian(PLANAR, start)[:2]
    np.testing.assert_allclose(J.T @ [1, 0], 0, rtol=0, atol=1e-15)
    assert planar(x, 0, start).converged


@pytest.mark.parametrize("start", [np.zeros(6), np.array([0, math.pi / 2, -math.pi / 2, 0, 0, 0])])
def test_the_puma_leaves_its_singular_named_poses(start: Array):
    chain = PUMA.chain()
    target = forward(chain, start + np.array([0.3, -0.2, 0.25, 0.4, 0.5, -0.3]))
    found = inverse_kinematics(chain, target, start)
    assert found.converged, found
    assert np.abs(found.q - start).max() < 7


def test_a_limit_in_the_way_is_named():
    found = planar(-0.5, 1.2, (0.3, 0.4), limits=[(-0.5, 0.5), (-3, 3)])
    assert found.stopped == "joint limits"
    assert found.held == (1,)
    assert found.q[0] == 0.5
    assert str(found).startswith("Not converged after ")
    assert "no motion within the limits comes closer (joints at a limit: 1); position error" in str(
        found
    )


def test_the_other_joints_make_up_for_one_at_its_limit():
    chain = from_standard([[0, 0, 1, 0]] * 3, "RRR")
    limits = [(-3, 3), (-0.1, 0.1), (-3, 3)]
    found = inverse_kinematics(chain, at(1.2, 1.0), (0.3, 0.05, 0.4), rows=(0, 1), limits=limits)
    assert found.converged
    assert abs(found.q[1]) <= 0.1


def test_they_make_up_for_it_in_the_same_step():
    chain, start = from_standard([[0, 0, 1, 0]] * 3, "RRR"), np.array([0.3, 0.097, 0.9])
    wish = pseudoinverse(jacobian(chain, start)[:2])[
        1
    ]  # the way on which joint 2 would turn the most
    target = at(*forward(chain, start)[:2, 3] + 0.01 * wish / np.linalg.norm(wish))
    errors = [
        inverse_kinematics(
            chain, target, start, rows=(0, 1), limits=[(-3, 3), (-3, 0.1), (-3, 3)], iterations=k
        ).position_error
        for k in (0, 1)
    ]
    assert errors[1] < 0.05 * errors[0]


def test_a_slide_reaches_as_far_as_its_limit():
    chain = from_standard([[0, 0, 0, 0]], "P")
    near = inverse_kinematics(chain, at(0, 0, 0.8), [0.2], limits=[(0, 1)])
    far = inverse_kinematics(chain, at(0, 0, 1.5), [0.2], limits=[(0, 1)])
    assert near.converged
    assert near.q == pytest.approx([0.8], abs=1e-9)
    assert far.stopped == "joint limits"
    assert far.q == pytest.approx([1.0], abs=0)
    assert far.position_error == pytest.approx(0.5)


def test_too_few_iterations_are_said_to_be_so():
    found = planar(-1.2, 0.3, (0.3, 0.4), iterations=3)
    assert found.stopped == "iterations"
    assert found.iterations == 3
    assert "still coming closer" in str(found)


def test_tolerances_finer_than_the_arithmetic_are_said_to_be_so():
    chain = PUMA.chain()
    target = forward(chain, np.linspace(0.1, 0.6, 6))
    found = inverse_kinematics(
        chain,
        target,
        np.zeros(6),
        position_tolerance=1e-30,
        rotation_tolerance=1e-30,
        iterations=500,
    )
    assert found.stopped in ("rounding", "local minimum")
    assert found.position_error < 1e-15


def test_an_arm_with_too_few_joints_comes_as_near_as_it_can():
    found = inverse_kinematics(PLANAR, at(1.2, 0.3, 0.5), (0.3, 0.4))
    assert found.stopped == "local minimum"
    assert found.position_error >= 0.5


@pytest.mark.parametrize("scale", [1e6, 1e-6])
def test_the_unit_of_length_decides_nothing(scale: float):
    chain = PUMA.chain()
    fixed = chain.fixed.copy()
    fixed[:, :3, 3] *= scale
    other = Chain(fixed, chain.kinds)
    q, start = np.array([0.3, 0.7, -0.6, 0.5, 0.9, -0.4]), np.array([0.1, 0.5, -0.3, 0.3, 0.6, 0.0])
    found, twin = (inverse_kinematics(x, forward(x, q), start) for x in (other, chain))
    assert found.converged
    assert found.iterations == twin.iterations
    np.testing.assert_allclose(found.q, twin.q, rtol=0, atol=1e-9)
    assert found.position_error <= 1e-8 * scale


def test_a_half_turn_of_the_hand_is_made():
    chain = from_standard([[0, 0, 0, math.pi / 2], [0, 0, 0, -math.pi / 2], [0, 0, 0, 0]], "RRR")
    start = np.array([0.3, 0.8, 0.4])
    target = elementary("Rx", math.pi) @ forward(chain, start)
    found = inverse_kinematics(chain, target, start)
    assert found.converged, found


def test_a_solution_cannot_be_changed():
    found = planar(1.2, 0.3, (0.3, 0.4))
    with pytest.raises(ValueError, match="read-only"):
        found.q[0] = 0.0


def test_the_start_is_not_changed():
    start = np.array([0.3, 0.4])
    planar(1.2, 0.3, start)
    np.testing.assert_array_equal(start, [0.3, 0.4])


def test_every_reason_has_a_sentence():
    for stopped in REASONS:
        text = str(Solution(np.zeros(2), stopped, 5, 0.1, 0.2, (2,)))
        assert text.startswith("Converged" if stopped == "converged" else "Not converged")
        assert text.endswith("position error 0.1 m, rotation error 0.2 rad.")


MIRROR = np.diag([1.0, 1.0, -1.0, 1.0])


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"target": np.eye(3)}, r"target takes one transform \(4, 4\)"),
        ({"target": np.full((4, 4), np.nan)}, "target takes finite numbers"),
        ({"target": MIRROR}, "target takes right-handed rotations"),
        (
            {"target": 2 * np.eye(4)},
            r"target takes the last row \[0 0 0 1\], got \[0.0, 0.0, 0.0, 2.0\]",
        ),
        ({"start": [0.1]}, r"start takes shape \(\.\.\., 2\), got \(1,\)"),
        ({"start": [[0.1, 0.2]]}, r"start takes shape \(2,\), got \(1, 2\)"),
        ({"start": [0.1, 4.0], "limits": [(-3, 3), (-3, 3)]}, "start takes q2 from -3 to 3, got 4"),
        ({"limits": [(-3, 3)]}, "limits takes 2 pairs of a lowest and a highest value"),
        ({"limits": [(-3, 3), (3, -3)]}, "limits takes 2 pairs of a lowest and a highest value"),
        (
            {"limits": [(-3, 3), (-3, math.nan)]},
            "limits takes 2 pairs of a lowest and a highest value",
        ),
        ({"limits": "wide"}, "limits takes pairs of numbers, got 'wide'"),
        ({"rows": [7]}, "rows takes some of the rows 0 to 5 of a twist"),
        ({"position_tolerance": 0.0}, "position_tolerance takes a finite number above 0, got 0"),
        ({"rotation_tolerance": -1.0}, "rotation_tolerance takes a finite number above 0, got -1"),
        ({"longest_step": math.nan}, "longest_step takes a finite number above 0, got nan"),
        ({"longest_step": "short"}, "longest_step takes a finite number above 0, got 'short'"),
        ({"iterations": -1}, "iterations takes a whole number from 0, got -1"),
        ({"starts": 0}, "starts takes a whole number from 1, got 0"),
        ({"iterations": 2.5}, "iterations takes a whole number from 0, got 2.5"),
    ],
)
def test_wrong_input_is_refused_with_a_sentence(change: dict[str, Any], sentence: str):
    arguments: dict[str, Any] = {"target": at(1, 0.5), "start": [0.1, 0.2], **change}
    with pytest.raises(ChainError, match=sentence):
        inverse_kinematics(PLANAR, **arguments)


def test_a_start_within_rounding_of_its_limits_is_put_on_them():
    limits = [(-1.0, 1.0), (0.5, 2.0)]
    start = np.array([1.0 + 1e-15, 0.5 - 1e-16])
    assert start[0] > 1.0
    found = inverse_kinematics(
        PLANAR, forward(PLANAR, [0.9, 0.6]), start, rows=(0, 1), limits=limits
    )
    assert found.converged
    assert start.flags.writeable


@pytest.mark.parametrize(
    ("reached", "desired", "sentence"),
    [
        (np.eye(3), np.eye(4), r"reached takes shape \(\.\.\., 4, 4\), got \(3, 3\)"),
        (np.eye(4), np.zeros(4), r"desired takes shape \(\.\.\., 4, 4\), got \(4,\)"),
        (
            np.zeros((2, 4, 4)),
            np.zeros((3, 4, 4)),
            r"desired takes a batch that fits \(2,\), got \(3,\)",
        ),
    ],
)
def test_displacements_of_what_are_no_transforms_are_refused_with_a_sentence(
    reached: Any, desired: Any, sentence: str
):
    with pytest.raises(ChainError, match=sentence):
        displacement(reached, desired)


@pytest.mark.parametrize("name", ROBOTS)
def test_from_many_starts_every_pose_within_the_limits_is_met(name: str):
    """UR5, Panda and Puma from one random start: fewer than half."""
    robot = ROBOTS[name]
    chain, limits = robot.chain(), np.array(robot.limits)
    low, high = limits.T
    rng = np.random.default_rng(7)
    for _ in range(40 if name in ("ur5", "panda", "puma560") else 6):
        target = forward(chain, rng.uniform(low, high))
        start = rng.uniform(low, high)
        found = inverse_kinematics(chain, target, start, limits=limits, starts=100)
        assert found.converged, str(found)
        assert ((found.q >= low) & (found.q <= high)).all()
        np.testing.assert_allclose(forward(chain, found.q), target, atol=1e-7)


def test_the_first_of_many_starts_is_the_given_one():
    robot = ROBOTS["puma560"]
    q = np.array([0.3, -0.4, 0.5, 0.6, 0.7, 0.8])
    chain, limits = robot.chain(), robot.limits
    found = inverse_kinematics(chain, forward(chain, q), q + 1e-3, limits=limits, starts=100)
    np.testing.assert_allclose(found.q, q, atol=1e-6)


def test_a_pose_out_of_reach_of_every_start_is_said_to_be_so():
    chain = ROBOTS["planar_2r"].chain()
    target = forward(chain, [0.0, 0.0])
    target[0, 3] += 1.0
    found = inverse_kinematics(chain, target, [0.4, 0.5], rows=[0, 1], starts=40)
    assert not found.converged
    assert found.position_error == pytest.approx(1.0, abs=1e-6)


def test_a_joint_that_passes_its_limit_goes_on_a_full_turn_away():
    chain = ROBOTS["ur5"].chain()
    limits = np.array([[-2 * np.pi, 2 * np.pi]] * 6)
    problem = Problem(chain, np.eye(4), np.arange(6), limits[:, 0], limits[:, 1], 1.0, 1e-9, 1e-9)
    q = np.array([[6.5, -6.5, 0.0, 3.0, -3.0, 6.0]])
    expected = [[6.5 - 2 * np.pi, 2 * np.pi - 6.5, 0.0, 3.0, -3.0, 6.0]]
    np.testing.assert_allclose(within(problem, q), expected)
    narrow = replace(problem, low=np.full(6, -1.0), high=np.full(6, 1.0))
    np.testing.assert_allclose(
        within(narrow, q), [[6.5 - 2 * np.pi, 2 * np.pi - 6.5, 0.0, 1.0, -1.0, 6 - 2 * np.pi]]
    )


def test_an_arm_of_seven_joints_with_offsets_and_a_tool_meets_a_pose_that_one_start_misses():
    """Baxter's left arm, with lengths as its maker gives them; from zeros it ends beside it."""
    rows = [
        [0, 0.2703, 0.069, -np.pi / 2],
        [np.pi / 2, 0, 0, np.pi / 2],
        [0, 0.3644, 0.069, -np.pi / 2],
        [0, 0, 0, np.pi / 2],
        [0, 0.3743, 0.01, -np.pi / 2],
        [0, 0, 0, np.pi / 2],
        [0, 0.2295, 0, 0],
    ]
    degrees = [(-97.5, 97.5), (-123, 60), (-175, 175), (-2.8, 150), (-175.3, 175.3), (-90, 120), (-175.3, 175.3)]  # fmt: skip
    tool = np.eye(4)
    tool[1, 3] = 0.18
    chain = from_standard(rows, "RRRRRRR", tool=tool)
    target = np.eye(4)
    target[:3, :3] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
    target[:3, 3] = 0.1, 0.5, -0.1
    found = inverse_kinematics(chain, target, np.zeros(7), limits=np.radians(degrees), starts=100)
    assert found.converged, str(found)
