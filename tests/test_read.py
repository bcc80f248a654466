"""Answers are read by kind: shape first, then finite, and every refusal says what would be right."""

import numpy as np
import pytest
from answers import raw, variant_of
from kinegrade.exercises.answers import Configurations, Formulas
from kinegrade.exercises.exercise import Numbers, TableOf
from kinegrade.grader.collecting.wire import Raw
from kinegrade.grader.kinds.markers import read
from kinegrade.grader.reading.unreadable import Unreadable

V = {"d1": 0.5, "a1": 0.3, "q": [0.4, 0.6, 0.7]}
TABLE = TableOf(("d1", "a1", "d2"), "RRP")
RIGHT = [["q1", "d1", "a1", "-pi/2"], ["q2", 0, 0, "pi/2"], [0, "q3", 0, 0]]


@pytest.mark.parametrize(
    ("asked", "given", "words"),
    [
        ((6, 3), np.ones((1, 1)), "takes shape (6, 3), got (1, 1)"),
        ((6, 3), np.ones((3, 6)), "rows and columns look exchanged"),
        ((6, 3), np.ones((3, 3)), "three each"),
        ((6, 3), 1.0, "takes shape (6, 3), got ()"),
        ((6,), np.ones(5), "takes shape (6,), got (5,)"),
        ((2, 2), [[1, np.nan], [1, 1]], "row 1, column 2"),
        ((2, 2), [[1, 1], [np.inf, 1]], "row 2, column 1"),
        ((1, 2, 2), [[[1, 1], [1, np.nan]]], "matrix 1, row 2, column 2"),
    ],
)
def test_numbers_of_the_wrong_shape_or_not_finite_are_refused(asked, given, words):
    with pytest.raises(Unreadable) as caught:
        read(Numbers(asked), raw(np.array(given)), V)
    assert words in str(caught.value)


@pytest.mark.parametrize("shape", [(6,), (6, 1), (1, 6)])
def test_a_vector_may_stand_as_row_or_column(shape):
    assert read(Numbers((6,)), raw(np.arange(6.0).reshape(shape)), V).tolist() == list(range(6))


def test_complex_numbers_are_refused():
    with pytest.raises(Unreadable, match="real numbers"):
        read(Numbers((2,)), Raw("num", np.array([1, 2 + 1j])), V)


@pytest.mark.parametrize("shape", [(6, 3, 1), (1, 6, 3), (6, 1, 3), (1, 6, 3, 1), (2, 3, 3)])
def test_brackets_that_change_nothing_may_stand_around_entries(shape):
    given = np.arange(18.0).reshape(shape)
    np.testing.assert_array_equal(
        read(Numbers((6, 3)), raw(given), V), np.arange(18.0).reshape(6, 3)
    )


@pytest.mark.parametrize("shape", [(3, 6, 1), (3, 2, 3, 1), (18,), (3, 1, 6)])
def test_other_brackets_are_another_shape(shape):
    with pytest.raises(Unreadable, match="takes shape"):
        read(Numbers((6, 3)), raw(np.zeros(shape)), V)


@pytest.mark.parametrize(
    "answer", [Numbers((2,)), Configurations(1, decimals=3, most=4), Formulas((2,), ("q1",))]
)
def test_imaginary_parts_that_rounding_left_are_none(answer):
    found = read(answer, Raw("num", np.array([1 + 1e-17j, -2e3 - 1e-13j])), V)
    numbers = found.at({}) if isinstance(answer, Formulas) else found.ravel()
    np.testing.assert_array_equal(numbers, [1, -2000])
    with pytest.raises(Unreadable, match="takes real numbers, got complex ones"):
        read(answer, Raw("num", np.array([1 + 1e-9j, 2])), V)


def test_a_stack_may_be_nested_text():
    stack = np.arange(8.0).reshape(2, 2, 2)
    text = [[[f"{x}/2 m" for x in row] for row in rows] for rows in (2 * stack).tolist()]
    np.testing.assert_array_equal(read(Numbers((2, 2, 2), "m"), raw(text), V), stack)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (Raw("missing"), "not answered"),
        (Raw("error", "cell 4 stopped with NameError: q"), "cell 4 stopped"),
        (Raw("text", "x"), "got text: x"),
        (Raw("text", [["a" * 500]]), "takes shape (2, 2), got (1, 1)"),
        (Raw("text", [["1", "2"], ["3", "a" * 500]]), "row 2, column 2: a name takes up to 400"),
    ],
)
def test_other_values_are_refused_with_what_they_are(given, words):
    with pytest.raises(Unreadable) as caught:
        read(Numbers((2, 2)), given, V)
    assert words in str(caught.value)
    assert len(str(caught.value).splitlines()[0]) < 160


def test_a_table_is_read_from_text_and_from_numbers():
    typed = read(TABLE, raw([[str(cell) for cell in row] for row in RIGHT]), V)
    numbers = read(
        TABLE,
        raw(np.array([[0.4, 0.5, 0.3, -np.pi / 2], [0.6, 0, 0, np.pi / 2], [0, 0.7, 0, 0]])),
        V,
    )
    mixed = read(
        TABLE,
        raw([["0.4", "d1", "0.3", "-pi/2"], ["q2", "0", "0", "1.5707963"], ["0", "0.7", "0", "0"]]),
        V,
    )
    lengths = {"d1": 0.5, "a1": 0.3}
    for table in (typed, numbers, mixed):
        assert table.kinds == "RRP"
        np.testing.assert_allclose(
            table.frames(lengths, V["q"]), typed.frames(lengths, V["q"]), atol=1e-6
        )


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        (RIGHT[:2], "takes 3 rows"),
        ([row[:3] for row in RIGHT], "rows of [3, 3, 3] cells"),
        ("q1", "takes 3 rows of theta, d, a, alpha, got rows of [1] cells"),
        ("[[q1, d1, a1, 0], [q2, 0, 0, 0]]", "got rows of [4, 4] cells"),
        (
            [["q1", "d1", "a1", "-pi/2"], ["pi/2", "0", "0", "pi/2"], ["0", "q3", "0", "0"]],
            "row 2: q2 takes a place",
        ),
        ([["q1", "d7", "a1", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]], "d7"),
        ([["q1", "d2", "a1", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]], "d2"),
        ([["2*q1", "d1", "a1", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]], "factor 1"),
        ([["q1 +", "d1", "a1", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]], "row 1, theta"),
        (
            [["__import__('os')", "d1", "a1", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]],
            "row 1, theta",
        ),
        ([["q1", "9**9**9", "a1", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]], "row 1, d"),
    ],
)
def test_a_broken_table_names_the_place(cells, words):
    if isinstance(cells, list):
        cells = [[str(cell) for cell in row] for row in cells]
    with pytest.raises(Unreadable) as caught:
        read(TABLE, raw(cells), V)
    assert words in str(caught.value)


def test_numbers_that_are_no_table_are_refused():
    with pytest.raises(Unreadable, match="table of shape"):
        read(TABLE, raw(np.zeros((2, 4))), variant_of("rrt"))


@pytest.mark.parametrize(
    "cell", [repr(0.4 + 1e-16), "0.39999999999999997", repr(0.4 + np.pi / 2), repr(0.4 - np.pi)]
)
def test_a_number_in_theta_is_the_own_q_or_a_quarter_turn_from_it(cell):
    table = read(
        TABLE, raw([[cell, "d1", "a1", "0"], ["q2", "0", "0", "6.1e-17"], ["0", "q3", "0", "0"]]), V
    )
    assert table.kinds == "RRP"


def test_a_neighbours_number_in_theta_is_refused():
    with pytest.raises(Unreadable, match=r"row 1, theta: takes q1, or your value of it, got 0\.53"):
        read(
            TABLE, raw([["0.53", "d1", "a1", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]]), V
        )


@pytest.mark.parametrize("cell", ["d1/(d1 - d1)", "sqrt(-d1)"])
def test_a_cell_without_a_value_is_refused(cell):
    with pytest.raises(Unreadable, match="row 1, a"):
        read(TABLE, raw([["q1", "d1", cell, "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]]), V)


def test_a_complex_table_is_refused():
    with pytest.raises(Unreadable, match="takes real numbers, got complex ones"):
        read(TABLE, Raw("num", np.full((3, 4), 1j)), V)


@pytest.mark.parametrize(
    "text",
    [
        "[q1 d1 a1 -pi/2; q2 0 0 pi/2; 0 q3 0 0]",
        "[q1, d1, a1, -90°; q2, 0, 0, 90 deg; 0, q3, 0, 0]",
        "rrt_dh = [[theta_1, d1, a1, -pi/2], [q2, 0, 0, pi/2], [0, q3, 0, 0]]",
        "[[q1, rrt_d1, a1, -1.5707963], [q2, 0, 0, np.pi/2], [6e-17, q3(t), 0, 0]]",
    ],
)
def test_a_table_may_be_one_text(text):
    table, right = (read(TABLE, raw(typed), V) for typed in (text, RIGHT))
    numbers = [each.numbers({**V, "q1": 0.1, "q2": 0.2, "q3": 0.3}) for each in (table, right)]
    np.testing.assert_allclose(*numbers, atol=1e-6)


def test_a_table_may_have_degrees_with_their_sign():
    cells = [["q1 + 90°", "d1", "a1", "-90 deg"], ["q2", "0", "0", "90º"], ["0", "q3", "0", "0"]]
    numbers = read(TABLE, raw(cells), V).numbers({**V, "q1": 0, "q2": 0, "q3": 0})
    np.testing.assert_allclose(numbers[:, [0, 3]] * 2 / np.pi, [[1, -1], [0, 1], [0, 0]])


@pytest.mark.parametrize(
    ("row", "cells", "words"),
    [
        (3, ["q3", "0", "0", "0"], "row 3, theta: joint 3 slides, so q3 belongs in d"),
        (3, ["theta_3", "0.7", "0", "0"], "row 3, theta: joint 3 slides, so q3 belongs in d"),
        (3, ["0", "0", "q3", "0"], "row 3, a: joint 3 slides, so q3 belongs in d"),
        (1, ["0", "q1", "a1", "0"], "row 1, d: joint 1 turns, so q1 belongs in theta"),
    ],
)
def test_a_joint_variable_in_another_column_is_sent_to_its_own(row, cells, words):
    table = [[str(cell) for cell in row] for row in RIGHT]
    table[row - 1] = cells
    with pytest.raises(Unreadable) as caught:
        read(TABLE, raw(table), V)
    assert str(caught.value) == words


def test_a_table_of_numbers_may_have_brackets_around_its_cells():
    numbers = np.array([[0.4, 0.5, 0.3, 0], [0.6, 0, 0, 0], [0, 0.7, 0, 0]])
    assert read(TABLE, raw(numbers[..., None]), V) == read(TABLE, Raw("num", numbers + 1e-17j), V)


def test_a_sentence_about_a_table_stays_short():
    with pytest.raises(Unreadable) as caught:
        read(TABLE, raw([["a"]] * 60), V)
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize(
    ("cell", "plain"),
    [
        ("np.pi/2", "pi/2"),
        ("rrt_d1", "d1"),
        ("d_1", "d1"),
        ("-math.pi/2", "-pi/2"),
        ("2*rrt_a1 - d_1", "2*a1 - d1"),
    ],
)
def test_a_cell_may_be_written_as_in_the_notebook(cell, plain):
    typed = read(
        TABLE, raw([["theta_1", cell, "0", "0"], ["th2", "0", "0", "0"], ["0", "q3", "0", "0"]]), V
    )
    meant = read(
        TABLE, raw([["q1", plain, "0", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]]), V
    )
    assert typed.rows == meant.rows


def test_an_unknown_name_in_a_table_is_shown_with_a_caret():
    with pytest.raises(Unreadable) as caught:
        read(TABLE, raw([["q1", "d7", "0", "0"], ["q2", "0", "0", "0"], ["0", "q3", "0", "0"]]), V)
    first, typed, caret = str(caught.value).splitlines()
    assert first == "row 1, d: unknown name 'd7'; did you mean d1?"
    assert (typed, caret) == ("d7", "^")


def test_a_stack_may_be_handed_in_as_one_tall_matrix():
    tall = np.arange(48.0).reshape(12, 4)
    np.testing.assert_array_equal(read(Numbers((3, 4, 4)), raw(tall), V), tall.reshape(3, 4, 4))
