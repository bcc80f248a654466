"""Two students with the same numbers are found in a class, whoever is marked first."""

import numpy as np
from answers import EXERCISES, variant_of
from kinegrade.exercises.exercise import references
from kinegrade.grader.marking.sharing import sharing

EXERCISE = EXERCISES["puma_velocities"]
J = "puma_velocities_J"


def handed(seed):
    answers = references(EXERCISE, variant_of("puma_velocities", seed))
    return {part.variable: np.asarray(answers[part.variable]).tolist() for part in EXERCISE.asked}


def test_personal_answers_are_nobody_elses():
    assert sharing(EXERCISE.asked, {f"s{seed}": handed(seed) for seed in range(6)}) == {}


def test_a_copied_matrix_is_found_on_both_sides_and_only_that():
    one, two, three = handed(0), handed(1), handed(2)
    two[J] = (np.array(one[J]) + 1e-3).tolist()
    found = sharing(EXERCISE.asked, {"ada": one, "ben": two, "cyd": three})
    assert found == {"ada": {"ben": {J: two[J]}}, "ben": {"ada": {J: one[J]}}}


def test_what_is_missing_or_of_another_shape_is_shared_by_nobody():
    one = {J: handed(0)[J]}
    found = sharing(EXERCISE.asked, {"ada": one, "ben": {J: None}, "cyd": {J: [[1.0]]}, "dan": {}})
    assert found == {}


def test_numbers_that_many_have_tell_nothing():
    ones = {J: np.ones((6, 6)).tolist()}
    assert sharing(EXERCISE.asked, {"ada": ones, "ben": ones}) == {}
