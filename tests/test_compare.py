"""What is right entry by entry, what carries marks, and what a wrong entry costs."""

import numpy as np
import pytest
from answers import EXERCISES, variant_of
from kinegrade.exercises.exercise import Numbers, Part, references
from kinegrade.grader.compare import earning_entries, fraction, right_entries, varying_entries
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
        (mask([T, T], [T, F]), mask([T, T], [F, F]), "entry", 1 / 2),  # a wrong constant voids its column
        (mask([F, T], [F, T]), mask([F, T], [F, T]), "entry", 1 / 2),  # a constant column costs its share
        (mask([F, F], [F, F]), mask([F, T], [F, T]), "entry", 0),
        (mask([T, F, T]).ravel(), mask([T, T, F]).ravel(), "entry", 1 / 2),
        (mask([T, T, F]).ravel(), mask([T, T, F]).ravel(), "entry", 0),  # a vector is one column
        (mask([[T, F], [T, T]], [[T, T], [T, T]]), mask([[T, T], [T, T]], [[T, T], [T, T]]), "entry", 7 / 8),
        (mask([[T, T], [T, F]], [[T, T], [T, T]]), mask([[T, T], [F, F]], [[T, T], [F, F]]), "entry", 3 / 4),
    ],
)
def test_points_go_to_earning_entries_of_sound_columns(right, earning, credit, share):
    assert fraction(right, earning, credit) == pytest.approx(share)


def test_structural_zeros_and_ones_carry_no_marks():
    reference = np.array([[0.0, 0.5], [1.0, -1.0]])
    asked = Part("t_x", "x?", 1, Numbers((2, 2)), lambda *_: reference)
    varies = np.array([[True, True], [False, True]])
    np.testing.assert_array_equal(earning_entries(asked, reference, varies, {}), [[F, T], [F, F]])


def test_an_answer_of_constants_only_is_marked_in_full():
    reference = np.eye(2)
    asked = Part("t_x", "x?", 1, Numbers((2, 2)), lambda *_: reference)
    assert earning_entries(asked, reference, np.zeros((2, 2), dtype=bool), {}).all()


def test_entries_that_differ_between_students_vary():
    asked = Part("t_x", "x?", 1, Numbers((2,)), lambda *_: None)
    assert varying_entries([np.array([1.0, 2.0]), np.array([1.0, 2.5])], asked, [{}, {}]).tolist() == [False, True]


def cells_right(cells, seed=0):
    exercise = EXERCISES["rrt"]
    v = variant_of("rrt", seed)
    reference = references(exercise, v)["rrt_dh"]
    names = {name for row in reference.rows for cell in row for name in cell.names}
    own = [[str(cell) for cell in row] for row in reference.rows]
    for (i, j), cell in cells.items():
        own[i][j] = cell.format(own[i][j])
    return right_entries(exercise, exercise.parts[0], v, {}, reference, read_table(own, names))


@pytest.mark.parametrize("seed", range(4))
def test_table_cells_are_equal_when_their_values_are(seed):
    assert cells_right({(0, 0): "q1 + 2*pi", (1, 0): "q2 - 0", (2, 3): "sin(pi)", (0, 3): "{0} - 2*pi"}, seed).all()
    assert cells_right({(0, 3): "2*({0})/2", (1, 1): "({0})^1"}, seed).all()


@pytest.mark.parametrize(
    ("cell", "text"),
    [((0, 0), "q1 + 0.1"), ((0, 1), "d1 + 0.01"), ((0, 3), "-({0})"), ((1, 2), "0.1"), ((2, 1), "q3 + 1")],
)
def test_a_wrong_table_cell_is_the_only_wrong_one(cell, text):
    right = cells_right({cell: text})
    assert np.argwhere(~right).tolist() == [list(cell)]
