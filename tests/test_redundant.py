"""Checks about a planar arm of three joints that prescribes two rows."""

import numpy as np
import pytest
from kinegrade.exercises.calculations.redundant import (
    gives_twist,
    judged_least,
    judged_null,
    judged_pseudoinverse,
)
from kinegrade.solutions.jacobian import jacobian
from kinegrade.solutions.robots import ROBOTS

J = jacobian(ROBOTS["planar_3r"].chain(), [0.3, 0.7, -1.1])[:2]
XI = np.array([0.4, -0.3])
PINV = np.linalg.pinv(J)
STILL = np.linalg.svd(J)[2][-1]


def test_the_pseudoinverse_is_right_and_another_right_inverse_is_named():
    assert np.all(judged_pseudoinverse(J, np.round(PINV, 4)).right)
    other = np.vstack([np.linalg.inv(J[:, :2]), np.zeros(2)])
    found = judged_pseudoinverse(J, other)
    assert not np.any(found.right)
    assert (found.share, "right inverse" in found.finding) == (1 / 3, True)
    assert judged_pseudoinverse(J, J.T).right is None


def test_rates_that_give_the_twist_and_are_not_the_shortest_earn_half():
    least = np.round(PINV @ XI, 4)
    assert gives_twist(J, XI, least)
    assert judged_least(J, XI, least).share is None
    assert judged_least(J, XI, least + 0.2 * STILL).share == 0.5
    assert judged_least(J, XI, least + 0.2).share is None


@pytest.mark.parametrize("factor", [1, -0.3, 50.0])
def test_any_multiple_of_the_still_rates_is_right(factor):
    assert np.all(judged_null(J, np.round(factor * STILL, 4)).right)
    assert not np.any(judged_null(J, factor * (STILL + 0.1 * PINV[:, 0])).right)


def test_the_part_that_moves_the_tool_is_named():
    found = judged_null(J, (PINV @ J)[0])
    assert not np.any(found.right)
    assert "keeps the part" in found.finding
    assert judged_null(J, np.zeros(3)).finding == ""
