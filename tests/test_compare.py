"""What is right entry by entry, what carries marks, and what a wrong entry costs."""

import numpy as np
import pytest
from answers import EXERCISES, variant_of
from courses import exercise_of
from kinegrade.exercises.exercise import Formulas, Numbers, Part
from kinegrade.grader.marking.answer_key import AnswerKey
from kinegrade.grader.marking.compare import compare, fraction
from kinegrade.solutions.table import read_table

T, F = True, False


def mask(*rows):
    return np.array(rows, dtype=bool)


@pytest.mark.parametrize(
    ("right", "earning", "credit", "share"),
    [
        (mask([T, T], [T, T]), mask([T, T], [T, T]), "entry", 1),
        (mask([T, F], [T, T]), mask([T, T], [T, T]), "entry", 3 / 4),
        (mask([T, F], [T, T]), mask([T, T], [T, T]), "column", 1 / 2),
        (mask([T, F], [T, T]), mask([T, T], [T, T]), "all", 0),
        (mask(*[[T, T]] * 5, [T, F]), mask(*[[T, T]] * 6), "block", 1 / 2),
        (np.array(T), np.array(T), "entry", 1),
        (np.array(F), np.array(T), "entry", 0),
        (
            mask([T, T], [T, F]),
            mask([T, T], [F, F]),
            "entry",
            1 / 2,
        ),  # a wrong constant voids its column
        (
            mask([F, T], [F, T]),
            mask([F, T], [F, T]),
            "entry",
            1 / 2,
        ),  # a constant column costs its share
        (mask([F, F], [F, F]), mask([F, T], [F, T]), "entry", 0),
        (mask([T, F, T]).ravel(), mask([T, T, F]).ravel(), "entry", 1 / 2),
        (mask([T, T, F]).ravel(), mask([T, T, F]).ravel(), "entry", 0),  # a vector is one column
        (
            mask([[T, F], [T, T]], [[T, T], [T, T]]),
            mask([[T, T], [T, T]], [[T, T], [T, T]]),
            "entry",
            7 / 8,
        ),
        (
            mask([[T, T], [T, F]], [[T, T], [T, T]]),
            mask([[T, T], [F, F]], [[T, T], [F, F]]),
            "entry",
            3 / 4,
        ),
    ],
)
def test_points_go_to_earning_entries_of_sound_columns(right, earning, credit, share):
    assert fraction(right, earning, credit) == pytest.approx(share)


def earning(answer, solve, draw=lambda rng: {"x": float(rng.uniform(0.1, 0.9))}):
    exercise = exercise_of(Part("t_x", "x?", 1, answer, solve), draw=draw)
    return AnswerKey(exercise, {"x": 0.5}).earning(exercise.parts[0])


def test_structural_zeros_and_ones_carry_no_marks():
    found = earning(Numbers((2, 2)), lambda v, _: [[0, v["x"]], [2 * v["x"], -1]])
    np.testing.assert_array_equal(found, [[F, T], [F, F]])  # the third is 1 for this variant


def test_an_answer_of_constants_only_is_marked_in_full():
    assert earning(Numbers((2, 2)), lambda *_: np.eye(2)).all()


def test_formulas_without_a_name_carry_no_marks():
    assert earning(Formulas((2,), ("q1",)), lambda *_: ["0", "sin(q1)"]).tolist() == [F, T]


def cells_right(cells, seed=0):
    exercise = EXERCISES["rrt"]
    v = variant_of("rrt", seed)
    key = AnswerKey(exercise, v)
    reference = key.reference["rrt_dh"]
    names = {name for row in reference.rows for cell in row for name in cell.names}
    own = [[str(cell) for cell in row] for row in reference.rows]
    for (i, j), cell in cells.items():
        own[i][j] = cell.format(own[i][j])
    return compare(
        key, exercise.parts[0], key.wanted(exercise.parts[0]), read_table(own, names)
    ).right


@pytest.mark.parametrize("seed", range(4))
def test_table_cells_are_equal_when_their_values_are(seed):
    assert cells_right(
        {(0, 0): "q1 + 2*pi", (1, 0): "q2 - 0", (2, 3): "sin(pi)", (0, 3): "{0} - 2*pi"}, seed
    ).all()
    assert cells_right({(0, 3): "2*({0})/2", (1, 1): "({0})^1"}, seed).all()


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        ((0, 0), "q1 + 0.1"),
        ((0, 1), "d1 + 0.01"),
        ((0, 3), "-({0})"),
        ((1, 2), "0.1"),
        ((2, 1), "q3 + 1"),
    ],
)
def test_a_wrong_table_cell_is_the_only_wrong_one(cell, text):
    right = cells_right({cell: text})
    assert np.argwhere(~right).tolist() == [list(cell)]
