"""The displacement parts of three_axis, against numpy written out from the sheet."""

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from kinegrade.exercises.catalogue.three_axis import draw
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.mark import mark

EXERCISE = EXERCISES["three_axis"]
SEEDS = range(8)


def tool_point(v, q):
    """Axis 1 vertical; a2 rises from the shoulder at q2 = 0, a3 is level at q2 = q3 = 0."""
    q1, q2, q3 = q
    radius = -v["a2"] * np.sin(q2) + v["a3"] * np.cos(q2 + q3)
    height = v["L"] + v["a2"] * np.cos(q2) + v["a3"] * np.sin(q2 + q3)
    return np.array([radius * np.cos(q1), radius * np.sin(q1), height])


def verdicts_of(v, own):
    return {
        verdict.part: verdict for verdict in mark(EXERCISE, v, raws(references(EXERCISE, v) | own))
    }


@pytest.mark.parametrize("seed", SEEDS)
def test_displacement_rotation_and_error_are_those_of_the_sheet(seed):
    v = variant_of("three_axis", seed)
    got, q, h = references(EXERCISE, v), np.array(v["q"]), 1e-6
    A = np.array(
        [(tool_point(v, q + h * e) - tool_point(v, q - h * e)) / (2 * h) for e in np.eye(3)]
    ).T
    dq = np.linalg.solve(A, v["dp"])
    np.testing.assert_allclose(got["three_axis_dq"], dq, atol=1e-8)
    turned = dq[1] + dq[2]
    dw = [np.sin(q[0]) * turned, -np.cos(q[0]) * turned, dq[0]]
    np.testing.assert_allclose(got["three_axis_dw"], dw, atol=1e-8)
    missed = tool_point(v, q + dq) - tool_point(v, q) - v["dp"]
    np.testing.assert_allclose(got["three_axis_error"], missed, atol=1e-8)


def test_the_error_is_of_second_order():
    v = variant_of("three_axis")
    whole = references(EXERCISE, v)["three_axis_error"]
    tenth = references(EXERCISE, v | {"dp": [x / 10 for x in v["dp"]]})["three_axis_error"]
    assert np.linalg.norm(whole) / np.linalg.norm(tenth) == pytest.approx(100, rel=0.1)


@pytest.mark.parametrize("seed", range(60))
def test_the_wish_is_small_and_its_error_large_enough_to_be_asked(seed):
    v = draw(np.random.default_rng(seed))
    error = np.abs(references(EXERCISE, v)["three_axis_error"])
    assert 0.026 <= np.linalg.norm(v["dp"]) <= 0.036
    assert error.min() >= 2e-5
    assert np.linalg.norm(error) <= 0.004


def test_an_error_from_a_rounded_dq_is_right_from_that_dq():
    v = variant_of("three_axis", 2)
    dq = np.round(references(EXERCISE, v)["three_axis_dq"], 6)
    q = np.array(v["q"])
    error = tool_point(v, q + dq) - tool_point(v, q) - v["dp"]
    found = verdicts_of(v, {"three_axis_dq": dq, "three_axis_error": error})
    assert (found["three_axis_dq"].status, found["three_axis_error"].status) == (
        "correct",
        "correct",
    )


def test_rotation_and_error_follow_from_a_displacement_with_a_named_mistake():
    v = variant_of("three_axis")
    given = references(EXERCISE, v)
    dq = given["three_axis_A"].T @ np.array(v["dp"])
    q = np.array(v["q"])
    own = {
        "three_axis_dq": dq,
        "three_axis_dw": given["three_axis_B"] @ dq,
        "three_axis_error": tool_point(v, q + dq) - tool_point(v, q) - v["dp"],
    }
    found = verdicts_of(v, own)
    assert [found[name].points for name in own] == [1, 1, 2]


def test_a_sheet_that_was_drawn_before_has_answers_too():
    v = {name: x for name, x in variant_of("three_axis").items() if name != "dp"}
    assert np.isfinite(references(EXERCISE, v)["three_axis_error"]).all()
