"""What a singular posture loses, for blocks of any shape and for twists in and out of reach."""

import numpy as np
import pytest
from kinegrade.exercises.calculations.lost import (
    STILL,
    judged_lost,
    left_over,
    lost_direction,
    still_rates,
    weakest,
)
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS

PUMA = ROBOTS["puma560"].chain()
STRAIGHT_WRIST = jacobian(PUMA, [0.4, 0.5, 0.3, 0.7, 0.0, -0.6])
W = STRAIGHT_WRIST[3:, 3:]
FLAT = np.array([[1.0, 0.0], [0.0, 2.0], [0.0, 0.0]])  # m > n: base z is lost, no rates are still


def test_the_weakest_block_is_the_wrist_of_a_straight_wrist():
    assert weakest((STRAIGHT_WRIST[:3, :3], W)) is W


@pytest.mark.parametrize("block", [W, np.round(W, 4), STRAIGHT_WRIST])
def test_no_rates_reach_the_lost_direction_and_still_rates_move_nothing(block):
    u, n = lost_direction(block), still_rates(block)
    assert np.linalg.norm(u) == pytest.approx(1)
    assert u[np.abs(u).argmax()] > 0
    np.testing.assert_allclose(u @ block, 0, atol=1e-4)
    np.testing.assert_allclose(block @ n, 0, atol=1e-4)


def test_a_block_with_more_rows_than_columns_loses_a_direction_and_is_judged():
    np.testing.assert_allclose(lost_direction(FLAT), [0, 0, 1])
    assert judged_lost(FLAT, np.array([0, 0, -3.0])).right is True
    assert judged_lost(FLAT, np.array([0, 1.0, 0])).right is False


def test_what_is_left_over_of_a_twist_is_its_part_out_of_reach():
    u = lost_direction(STRAIGHT_WRIST)
    reached = STRAIGHT_WRIST @ [0.3, -0.2, 0.5, 0.1, 0.7, -0.4]
    np.testing.assert_allclose(left_over(STRAIGHT_WRIST, reached), 0, atol=1e-12)
    np.testing.assert_allclose(left_over(STRAIGHT_WRIST, reached + 0.4 * u), -0.4 * u, atol=1e-12)
    np.testing.assert_allclose(left_over(np.eye(6), np.arange(6.0)), 0)


@pytest.mark.parametrize("factor", [1, -1, 40.0])
def test_a_lost_direction_has_no_sign_and_no_length_and_still_rates_are_named(factor):
    assert judged_lost(W, factor * lost_direction(W)).right is True
    still = judged_lost(W, factor * still_rates(W))
    assert (still.right, still.finding) == (False, STILL)
    other = judged_lost(W, lost_direction(W) + 0.1 * W[:, 0])
    assert (other.right, other.finding) == (False, "")
