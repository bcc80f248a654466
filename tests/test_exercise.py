"""The contract refuses what could not be collected, marked or printed, with a sentence."""

import numpy as np
import pytest
from kinegrade.exercises.exercise import (
    Configurations,
    Exercise,
    ExerciseError,
    Numbers,
    Part,
    references,
)


def part(
    variable="t_x", prompt="What is x?", points=1, answer=None, solve=lambda *_: np.ones(2), **more
):
    return Part(variable, prompt, points, answer or Numbers((2,), "m"), solve, **more)


def exercise(*parts):
    return Exercise("t", "Title", "S0", lambda _: {}, parts, lambda _: "", {}, lambda _: 1.0)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ([part("x")], "starts with t_"),
        ([part("t x")], "Python name"),
        ([part(), part()], "two parts are called t_x"),
        ([part(needs=("t_y",))], "needs t_y, which is not an earlier part"),
        ([part(points=0)], "positive points"),
        ([part(prompt="")], "takes a prompt"),
        (
            [part(answer=Numbers((2,), "Nm"))],
            "exercise t: units of t_x: unknown unit 'Nm'; the nearest is 'N m'",
        ),
        (
            [part(answer=Numbers((2,), ["m", "radian"]))],
            "unknown unit 'radian'; the nearest is 'rad'",
        ),
        (
            [part(answer=Numbers((2,), ["m"] * 3))],
            "exercise t: units of t_x take the shape of its entries, (2,)",
        ),
        (
            [part(answer=Configurations(2, ["rad", "mtr"]), check=lambda *_: None)],
            "unknown unit 'mtr'; the nearest is 'm",
        ),
    ],
)
def test_a_broken_exercise_is_refused_when_it_is_made(parts, words):
    with pytest.raises(ExerciseError) as caught:
        exercise(*parts)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("value", "words"),
    [(np.ones(3), "got shape (3,)"), ([1, np.nan], "NaN"), (np.ones((2, 1)), "got shape (2, 1)")],
)
def test_a_reference_of_another_shape_or_not_finite_is_refused(value, words):
    with pytest.raises(ExerciseError) as caught:
        references(exercise(part(solve=lambda *_: value)), {})
    assert "t_x" in str(caught.value)
    assert words in str(caught.value)


def test_an_intermediate_is_given_on_but_not_asked():
    hidden = part("t_T", asked=False, points=0, prompt="")
    made = exercise(hidden, part(solve=lambda _, given: 2 * given["t_T"], needs=("t_T",)))
    assert [asked.variable for asked in made.asked] == ["t_x"]
    assert made.points == 1
    assert references(made, {})["t_x"].tolist() == [2, 2]


def test_a_part_is_given_only_what_it_needs():
    seen = []
    first = part("t_a")
    second = part("t_b", solve=lambda _, given: seen.append(sorted(given)) or np.ones(2))
    references(exercise(first, second), {})
    assert seen == [[]]


def test_units_broadcast_to_the_shape():
    units = Numbers((6, 3), [["m/rad", "m/rad", "1"]] * 3 + [["1"] * 3] * 3).unit_of_entries()
    assert units.shape == (6, 3)
    assert units[0].tolist() == ["m/rad", "m/rad", "1"]
    assert Numbers((2, 2), "m").unit_of_entries().tolist() == [["m", "m"], ["m", "m"]]


@pytest.mark.parametrize(
    "units", [{"L": "metre"}, {"q": ["rad", "rads"]}, {"J": [["m/rad", "m/rads"]]}, {"L": 1}]
)
def test_a_drawn_number_with_an_unknown_unit_is_refused(units):
    name = next(iter(units))
    with pytest.raises(
        ExerciseError,
        match=f"exercise t: units of {name}: (unknown unit .* the nearest is|a unit takes)",
    ):
        Exercise("t", "Title", "S0", lambda _: {}, (), lambda _: "", units, lambda _: 1.0)


def test_another_order_of_rows_is_refused():
    with pytest.raises(
        ExerciseError,
        match="rows takes 'linear, angular' or 'angular, linear', got 'angular first'",
    ):
        Exercise(
            "t",
            "Title",
            "S0",
            lambda _: {},
            (),
            lambda _: "",
            {},
            lambda _: 1.0,
            rows="angular first",
        )
