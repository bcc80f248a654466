"""Whoever computes nothing earns next to nothing: every way to guess is tried on draws of every exercise."""

import numpy as np
import pytest
from answers import EXERCISES, part_of, right_raws, variant_of
from courses import exercise_of
from kinegrade.course.proof.guesses import guesses_for
from kinegrade.course.proof.guessing import MOST, overpaid, pay_of_guesses
from kinegrade.exercises.answers import (
    Choice,
    Conditions,
    Formulas,
    Function,
    Manual,
    Numbers,
    TableOf,
)
from kinegrade.exercises.exercise import Part, references
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import marker_of
from kinegrade.grader.marking.guesses import ALONE, counted
from kinegrade.grader.marking.mark import mark
from kinegrade.grader.marking.verdict import not_graded


@pytest.mark.slow
def test_no_way_of_guessing_pays(exercise):
    best = pay_of_guesses(exercise)[0]
    assert best.sum <= MOST * exercise.points, best
    assert list(overpaid(exercise)) == []


def names(slug):
    learned = [(v, references(EXERCISES[slug], v)) for v in (variant_of(slug, s) for s in range(3))]
    return {guess.name: guess for guess in guesses_for(EXERCISES[slug], learned)}


@pytest.mark.parametrize(
    ("slug", "part", "guess", "raw"),
    [
        ("rrt", "rrt_singular", "q3 = 0", ["q3 = 0"]),
        ("frames", "frames_which", "c in every choice", "c"),
        ("inverse_velocities", "inverse_velocities_ranks", "zeros", [0.0, 0.0, 0.0]),
    ],
)
def test_a_guess_is_what_its_name_says(slug, part, guess, raw):
    answer = names(slug)[guess].answer(part_of(EXERCISES[slug], part), variant_of(slug))
    assert answer is not None
    value = answer.value.tolist() if hasattr(answer.value, "tolist") else answer.value
    assert value == raw


def test_lengths_stand_in_a_table_by_their_letters():
    v = {"d1": 0.5, "a1": 0.2, "l3": 0.3}
    raw = names("rrt")["lengths by their letters, alpha pi/2, -pi/2"].answer(
        part_of(EXERCISES["rrt"], "rrt_dh"), v
    )
    assert raw is not None
    assert raw.value == [
        ["q1", "d1", "a1", "pi/2"],
        ["q2", "0", "0", "-pi/2"],
        ["0", "l3 + q3", "0", "0"],
    ]


def test_a_printed_matrix_is_handed_in_wherever_it_fits():
    exercise, v = EXERCISES["find_the_mistake"], variant_of("find_the_mistake")
    raw = names("find_the_mistake")["the printed W"].answer(
        part_of(exercise, "find_the_mistake_J"), v
    )
    assert raw is not None
    np.testing.assert_array_equal(raw.value, v["W"])


GUESSABLE = {Choice: "not at all", Conditions: "not at all", TableOf: "not at all"}


def test_what_counts_alone_goes_by_the_kind(exercise):
    for part in exercise.asked:
        counts = GUESSABLE.get(type(part.answer), "in full")
        if isinstance(part.answer, Numbers) and part.answer.decimals == 0:
            counts = "not at all"
        assert marker_of(part.answer).alone(part.answer) == counts


def test_right_answers_lose_nothing(exercise):
    v = variant_of(exercise.slug)
    verdicts = mark(exercise, v, right_raws(exercise, v))
    assert counted(exercise, verdicts) == verdicts


def test_guessable_answers_alone_earn_nothing_and_say_why(exercise):
    v = variant_of(exercise.slug)
    raws = right_raws(exercise, v)
    for part in exercise.asked:
        if marker_of(part.answer).alone(part.answer) == "in full":
            raws[part.variable] = Raw("missing")
    parts = {part.variable: part for part in exercise.asked}
    for verdict in counted(exercise, mark(exercise, v, raws)):
        answer = parts[verdict.part].answer
        if isinstance(answer, Manual | Function) or raws[verdict.part].kind == "missing":
            continue
        assert verdict.points == 0
        assert verdict.findings[-1].text == ALONE


def test_formulas_count_alone_and_open_nothing_else():
    exercise, v = EXERCISES["rrt"], variant_of("rrt")
    right = right_raws(exercise, v)
    letters = {
        part.variable: right[part.variable]
        for part in exercise.asked
        if isinstance(part.answer, Formulas | Conditions)
    }
    parts = {part.variable: part for part in exercise.asked}
    for verdict in counted(exercise, mark(exercise, v, letters)):
        if isinstance(parts[verdict.part].answer, Formulas):
            assert verdict.points == verdict.out_of
        else:
            assert verdict.points == 0


def test_a_table_counts_beside_own_numbers_alone():
    exercise, v = EXERCISES["rrt"], variant_of("rrt")
    right = right_raws(exercise, v)
    (table, *_) = counted(exercise, mark(exercise, v, {"rrt_dh": right["rrt_dh"]}))
    assert (table.points, table.findings[-1].text) == (0, ALONE)
    two = {name: right[name] for name in ("rrt_dh", "rrt_T")}
    (table, *_) = counted(exercise, mark(exercise, v, two))
    assert table.points == table.out_of


def test_a_fifth_of_the_computed_points_makes_a_letter_count():
    parts = (
        Part(
            "t_n", "n", 4, Numbers((4,), "m"), lambda v, _: v["x"] * np.array([1.2, 0.7, 0.4, 0.3])
        ),
        Part("t_c", "c", 1, Choice(("x", "y")), lambda *_: "b"),
    )
    exercise, v = exercise_of(*parts), {"x": 0.5}
    right = right_raws(exercise, v)["t_n"].value
    for hits, points in ((0, 0.0), (1, 1.0), (4, 1.0)):
        own = np.where(np.arange(4) < hits, right, 9.0)
        raws = {"t_n": Raw("num", own), "t_c": Raw("text", "b")}
        assert counted(exercise, mark(exercise, v, raws))[1].points == points


def test_what_is_not_graded_yet_takes_nothing_from_a_letter():
    exercise, v = EXERCISES["frames"], variant_of("frames")
    verdicts = [
        not_graded(verdict.part, verdict.out_of, "wait")
        if verdict.part != "frames_which"
        else verdict
        for verdict in mark(exercise, v, right_raws(exercise, v))
    ]
    assert counted(exercise, verdicts) == verdicts


def test_nothing_follows_from_one_number_in_all_entries():
    exercise = exercise_of(
        Part("t_p", "p", 2, Numbers((2,), "m"), lambda v, _: v["x"] * np.array([1.1, 0.7])),
        Part(
            "t_J",
            "J",
            3,
            Numbers((2,), "m"),
            lambda _, given: given["t_p"][::-1] * [-1, 1],
            needs=("t_p",),
        ),
    )
    raws = {"t_p": Raw("num", np.full(2, 0.2)), "t_J": Raw("num", np.array([-0.2, 0.2]))}
    assert [verdict.points for verdict in mark(exercise, {"x": 0.5}, raws)] == [0, 0]


def test_nothing_follows_from_made_up_transforms_that_partly_follow():
    """The table is half right, and so the zeros and ones of transforms of another arm follow from it."""
    exercise, v = EXERCISES["rrt"], variant_of("rrt", 3)
    other = variant_of("rrt", 8)
    raws = right_raws(exercise, other)
    verdicts = {verdict.part: verdict for verdict in mark(exercise, v, raws)}
    assert verdicts["rrt_T"].points < verdicts["rrt_T"].out_of / 2
    assert verdicts["rrt_J"].points < 0.2 * verdicts["rrt_J"].out_of
