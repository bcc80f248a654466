"""What is told without the key: readable, shape, and whether answers fit each other."""

import numpy as np
import pytest
from answers import EXERCISES, raws, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.own_work import remarks
from kinegrade.grader.wire import Raw


def told(slug, changes, *, consistency=True, seed=0):
    exercise, v = EXERCISES[slug], variant_of(slug, seed)
    answers = references(exercise, v) | changes
    return {remark.part: remark for remark in remarks(exercise, v, raws(answers), consistency=consistency)}


def test_a_right_sheet_fits_itself(exercise):
    v = variant_of(exercise.slug)
    found = list(remarks(exercise, v, raws(references(exercise, v)), consistency=True))
    assert [remark.part for remark in found] == [part.variable for part in exercise.asked]
    assert all(remark.ok for remark in found)


def test_a_jacobian_that_does_not_follow_from_the_own_transforms_is_told():
    found = told("rrt", {"rrt_J": np.ones((6, 3))})
    assert not found["rrt_J"].ok
    assert "does not follow from your own rrt_T" in found["rrt_J"].text


def test_a_wrong_but_consistent_sheet_is_not_given_away():
    exercise = EXERCISES["three_axis"]
    theirs = references(exercise, variant_of("three_axis", 9))
    assert all(remark.ok for remark in told("three_axis", theirs).values())


def test_an_exam_tells_shape_and_nothing_more():
    found = told("rrt", {"rrt_J": np.ones((6, 3)), "rrt_T": np.ones((4, 4))}, consistency=False)
    assert (found["rrt_J"].ok, found["rrt_J"].text) == (True, "can be read")
    assert not found["rrt_T"].ok
    assert "takes shape (3, 4, 4)" in found["rrt_T"].text


@pytest.mark.parametrize("consistency", [True, False])
def test_what_cannot_be_read_says_why(consistency):
    found = told("rrt", {"rrt_dh": Raw("missing"), "rrt_J": np.full((6, 3), np.nan)}, consistency=consistency)
    assert found["rrt_dh"].text == "not answered"
    assert "NaN" in found["rrt_J"].text


def test_own_answers_from_which_nothing_follows_are_no_failure():
    found = told("puma_velocities", {"puma_velocities_J": np.zeros((6, 6))})
    assert "nothing follows" in found["puma_velocities_qdot"].text
