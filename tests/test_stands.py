"""The rates across a curve, and how they change, against differences; margins of postures that are known."""

import numpy as np
import pytest
from kinegrade.solutions.chain import from_standard
from kinegrade.solutions.random_chain import random_chain
from kinegrade.solutions.sections.stands import Plane, Stand, margins, onward, settled, slopes

LINKS = from_standard([[0, 0, 0.5, 0], [0, 0, 0.3, 0], [0, 0, 0.2, 0]], "RRR")
FLAT = Plane(LINKS, ("x", "y"), np.array([-np.inf, -1.0, -1.0]), np.array([np.inf, 1.0, 1.0]))
axes = pytest.mark.parametrize("axes", [("x", "y"), ("r", "z")], ids="".join)


@axes
@pytest.mark.parametrize("kinds", ["RRR", "RPRR", "PPRP"])
def test_rates_and_their_derivatives_are_differences(axes, kinds):
    rng, k = np.random.default_rng(4), len(kinds)
    plane = Plane(random_chain(kinds, rng), axes, np.full(k, -np.inf), np.full(k, np.inf))
    stand = Stand(rng.uniform(-1, 1, (30, k)), rng.uniform(-3, 3, 30), np.zeros((30, k), dtype=int))
    found = slopes(plane, stand)
    normal = np.column_stack([np.cos(stand.bearing), np.sin(stand.bearing)])
    for i, step in enumerate(1e-6 * np.eye(k + 1)):
        ahead, behind = (
            slopes(plane, stand.moved(sign * np.tile(step, (30, 1)))) for sign in (1, -1)
        )
        slope = (ahead.rates - behind.rates) / 2e-6
        np.testing.assert_allclose(found.derivatives[:, :, i], slope, rtol=0, atol=1e-7)
        if i < k:
            rate = (normal * (ahead.at - behind.at)).sum(axis=1) / 2e-6
            np.testing.assert_allclose(found.rates[:, i], rate, rtol=0, atol=1e-7)


def test_postures_settle_where_no_free_joint_has_a_rate_and_steps_keep_them_there():
    rng = np.random.default_rng(5)
    held = np.tile([[0, 0, 0], [0, 0, 1], [0, -1, 1]], (20, 1))
    q = np.where(held < 0, -1.0, np.where(held > 0, 1.0, rng.uniform(-1, 1, held.shape)))
    stand, found = settled(FLAT, Stand(q, rng.uniform(-3, 3, 60), held), 12)
    assert np.count_nonzero(found) > 50
    stand = stand.of(found)
    rates = slopes(FLAT, stand)
    np.testing.assert_allclose(np.where(stand.held == 0, rates.rates, 0.0), 0, atol=1e-9)
    assert (np.abs(stand.q - np.sign(stand.held))[stand.held != 0] < 1e-12).all()
    ahead = onward(rates, stand.held, rng.normal(size=(len(stand.q), 4)))
    np.testing.assert_allclose(np.linalg.norm(ahead, axis=1), 1)
    moved = slopes(FLAT, stand.moved(1e-6 * ahead))
    np.testing.assert_allclose(np.where(stand.held == 0, moved.rates, 0.0), 0, atol=1e-10)


@pytest.mark.parametrize(
    ("q", "bearing", "held", "inside"),
    [
        ((0.0, 0.0, 0.0), 0.0, (0, 0, 0), True),  # stretched
        ((0.0, 0.0, 2.0), 0.0, (0, 0, 0), False),  # beyond a limit
        ((0.0, 0.0, 1.0), 0.0, (0, 0, 1), False),  # the third joint could take the tool on
        ((0.0, 0.0, 1.0), np.pi, (0, 0, 1), False),  # it could not, but the elbow bends that way
        ((0.0, 1.0, 1.0), np.pi, (0, 1, 1), True),  # curled up as far as it can be
        ((0.0, 1.0, 1.0), 0.0, (0, 1, 1), False),
    ],
)
def test_margins_tell_postures_that_the_tool_cannot_pass(q, bearing, held, inside):
    stand = Stand(np.array([q]), np.array([bearing]), np.array([held]))
    at = slopes(FLAT, stand).at[0]
    turned = stand.moved(
        np.array([[0.0, 0.0, 0.0, np.arctan2(at[1], at[0])]])
    )  # along the way to the tool
    assert (margins(FLAT, turned, slopes(FLAT, turned)) >= 0).all() == inside


def test_some_postures_and_more_postures():
    stand = Stand(np.arange(6.0).reshape(3, 2), np.arange(3.0), np.zeros((3, 2), dtype=int))
    again = stand.of(np.array([2])).joined(stand.of(np.array([True, False, True])))
    assert again.bearing.tolist() == [2, 0, 2]
    assert again.q[:, 0].tolist() == [4, 0, 4]
    assert again.held.shape == (3, 2)
