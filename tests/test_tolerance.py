"""Tolerances follow from rounding what a part needs, within a floor and a cap."""

from types import SimpleNamespace

import numpy as np
import pytest
from answers import variant_of
from kinegrade.exercises.exercise import Numbers, Part, TableOf, references
from kinegrade.grader.marking.tolerance import CAP, FLOOR, block_scale, tolerance


def part(answer, solve, **more):
    return Part("t_x", "What is x?", 1, answer, solve, **more)


def allowed_for(asked, given=None, scale=1.0):
    """The tolerance of one part in an exercise of its own."""
    given = given or {}
    exercise = SimpleNamespace(slug="t", scale=lambda _: scale, parts=())
    return tolerance(exercise, asked, {}, given, asked.solve({}, given)).exact


def test_a_part_that_needs_nothing_allows_a_unit_of_the_last_decimal():
    asked = part(Numbers((2,), "m", decimals=3), lambda *_: np.array([1.0, 0.2]))
    np.testing.assert_allclose(allowed_for(asked), 1e-3, rtol=2e-3)


def test_an_ill_conditioned_part_allows_what_rounding_its_needs_moves():
    J = np.array([[1.0, 0.9], [0.9, 1.0]])
    asked = part(
        Numbers((2,), "rad/s", decimals=3),
        lambda _, given: np.linalg.solve(given["t_J"], [1.0, 1.0]),
    )
    plain = part(Numbers((2,), "rad/s", decimals=3), lambda *_: np.linalg.solve(J, [1.0, 1.0]))
    assert (allowed_for(asked, {"t_J": J}) > 1.3 * allowed_for(plain)).all()


def test_the_cap_keeps_zero_from_passing():
    J = np.diag([1e-5, 1.0])
    asked = part(
        Numbers((2,), "rad/s", decimals=1),
        lambda _, given: np.linalg.solve(given["t_J"], [1.0, 1.0]),
    )
    allowed = allowed_for(asked, {"t_J": J})
    assert allowed[0] == pytest.approx(CAP * 1e5)
    assert allowed[1] < CAP * 1e5


def test_the_floor_is_a_billionth_of_the_block():
    asked = part(Numbers((1,), "m", decimals=12), lambda *_: np.array([1.0]))
    np.testing.assert_allclose(allowed_for(asked, scale=50.0), 50 * FLOOR)


def test_an_explicit_tolerance_wins():
    asked = part(Numbers((2, 2)), lambda *_: np.eye(2), tolerance=0.125)
    np.testing.assert_array_equal(allowed_for(asked), np.full((2, 2), 0.125))


def test_a_prismatic_column_is_measured_against_one_not_against_a_length():
    answer = Numbers((6, 2), [["m/rad", "1"]] * 3 + [["1", "1"]] * 3)
    scale = block_scale(answer, np.ones((6, 2)), 0.3)
    np.testing.assert_array_equal(scale, [[0.3, 1]] * 3 + [[1, 1]] * 3)


def test_rates_are_measured_against_the_largest_rate():
    np.testing.assert_array_equal(
        block_scale(Numbers((2,), "rad/s"), np.array([0.1, -7]), 1.0), [7, 7]
    )


def test_a_tolerance_is_for_numbers_only():
    with pytest.raises(TypeError, match="for numbers"):
        allowed_for(part(TableOf((), "R"), lambda *_: None))


def test_every_tolerance_of_every_exercise_is_positive_and_small(exercise):
    v = variant_of(exercise.slug)
    answers = references(exercise, v)
    for asked in exercise.asked:
        if isinstance(asked.answer, Numbers):
            given = {name: answers[name] for name in asked.needs}
            allowed = tolerance(exercise, asked, v, given, answers[asked.variable])
            exact = allowed.exact
            block = block_scale(asked.answer, answers[asked.variable], exercise.scale(v))
            assert (exact > 0).all()
            assert (allowed.least <= exact).all()
            assert (exact <= allowed.most).all()
            assert asked.tolerance or (exact <= CAP * block).all()


def test_a_need_is_rounded_to_its_own_decimals_where_they_are_fewer():
    coarse = part(Numbers((2, 2), decimals=2), lambda *_: np.eye(2))
    fine = Part(
        "t_y",
        "y?",
        1,
        Numbers((2,), decimals=5),
        lambda _, given: given["t_x"] @ [1.0, 1.0],
        needs=("t_x",),
    )
    exercise = SimpleNamespace(slug="t", scale=lambda _: 1.0, parts=(coarse, fine))
    given = {"t_x": np.eye(2)}
    allowed = tolerance(exercise, fine, {}, given, fine.solve({}, given))
    assert (allowed.exact > 0.005).all()


def test_forces_and_moments_are_measured_each_against_the_largest_of_their_kind():
    answer = Numbers((6,), ["N"] * 3 + ["N m"] * 3)
    wrench = np.array([100.0, -250, 0, 2, 0.5, -8])
    np.testing.assert_array_equal(block_scale(answer, wrench, 0.3), [250] * 3 + [8] * 3)


@pytest.mark.parametrize(("off", "solved"), [(0.0, 0), (0.9e-3, 0), (5e-3, 64), (1.0, 0)])
def test_roundings_are_solved_only_where_the_bounds_leave_it_open(off, solved):
    calls = []

    def solve(_, given):
        calls.append(1)
        return given["t_J"] @ [1.0, 1.0]

    asked = part(Numbers((2,), "m", decimals=3), solve)
    exercise = SimpleNamespace(slug="t", scale=lambda _: 1.0, parts=())
    given = {"t_J": 3 * np.eye(2)}
    allowed = tolerance(exercise, asked, {}, given, solve({}, given))
    calls.clear()
    right = allowed.holds(np.full(2, off))
    assert len(calls) == solved
    np.testing.assert_array_equal(right, off <= allowed.exact)
