"""Denavit-Hartenberg tables of formulas, and what is no table."""

import math
import pickle
from typing import Any

import numpy as np
import pytest
from kinegrade.solutions.chain import elementary, from_modified, from_standard
from kinegrade.solutions.kinematics import forward
from kinegrade.solutions.table import COLUMNS, Table, TableError, read_table

NAMES = ("a1", "d1", "l3", "q1", "q2", "q3")
VALUES = {"a1": 0.2, "d1": 0.5, "l3": 0.1}
CELLS: Any = [
    ["q1 + pi/2", "d1", "a1", "-pi/2"],
    ["q2", 0, 0, math.pi / 2],
    ["0", "l3 + q3", 0.0, "0"],
]
NUMBERS = [[math.pi / 2, 0.5, 0.2, -math.pi / 2], [0, 0, 0, math.pi / 2], [0, 0.1, 0, 0]]


def test_joint_types_are_read_off_the_place_of_the_joint_variable():
    assert read_table(CELLS, NAMES).kinds == "RRP"
    assert read_table(CELLS, NAMES).joints == ("q1", "q2", "q3")


@pytest.mark.parametrize(
    ("convention", "build"), [("standard", from_standard), ("modified", from_modified)]
)
def test_a_table_gives_the_chain_of_its_numbers(convention: Any, build: Any):
    chain = read_table(CELLS, NAMES, convention).chain(VALUES)
    np.testing.assert_array_equal(chain.fixed, build(NUMBERS, "RRP").fixed)
    assert chain.kinds == "RRP"


def test_the_values_of_joints_are_no_part_of_the_chain():
    table = read_table(CELLS, NAMES)
    np.testing.assert_array_equal(
        table.chain({**VALUES, "q1": 5.0}).fixed, table.chain(VALUES).fixed
    )


def test_standard_frames_are_the_printed_ones_from_the_base_to_the_last():
    table, q = read_table(CELLS, NAMES), np.array([[0.3, -0.4, 0.7], [0.1, 0.2, 0.3]])
    printed = table.frames(VALUES, q)
    assert printed.shape == (2, 4, 4, 4)
    np.testing.assert_array_equal(printed[:, 0], [np.eye(4)] * 2)
    first = elementary("Rz", 0.3 + math.pi / 2) @ elementary("Tz", 0.5) @ elementary("Tx", 0.2)
    np.testing.assert_allclose(
        printed[0, 1], first @ elementary("Rx", -math.pi / 2), rtol=0, atol=1e-15
    )
    np.testing.assert_allclose(printed[:, 3], forward(table.chain(VALUES), q), rtol=0, atol=1e-15)
    assert table.frames(VALUES, q[0]).shape == (4, 4, 4)
    assert table.frames(VALUES, q[:0]).shape == (0, 4, 4, 4)


def test_modified_frames_are_the_printed_ones_from_the_first_to_the_tool():
    table, q, tool = read_table(CELLS, NAMES, "modified"), [0.3, -0.4, 0.7], elementary("Tx", 0.9)
    printed = table.frames(VALUES, q, tool)
    first = (
        elementary("Rx", -math.pi / 2) @ elementary("Tx", 0.2) @ elementary("Rz", 0.3 + math.pi / 2)
    )
    np.testing.assert_allclose(printed[0], first @ elementary("Tz", 0.5), rtol=0, atol=1e-15)
    np.testing.assert_allclose(printed[3], printed[2] @ tool, rtol=0, atol=1e-15)
    np.testing.assert_allclose(
        printed[3], forward(table.chain(VALUES, tool), q), rtol=0, atol=1e-15
    )


@pytest.mark.parametrize(
    "cell", ["q1", "(q1)", "q1 + pi/2", "pi/2 + q1", "q1 - a1/2", "a1 + (q1 - 1) - 2", "+q1"]
)
def test_an_offset_may_stand_on_either_side_of_the_joint_variable(cell: str):
    assert read_table([[cell, 0, "a1", 0]], NAMES).kinds == "R"


@pytest.mark.parametrize(
    "cell",
    [
        "2*q1",
        "-q1",
        "pi/2 - q1",
        "q1*a1/a1",
        "q1 + q1",
        "q1 + q1*0",
        "sin(q1)",
        "q1^2",
        "q1/1",
        "2*(q1 + 1)",
    ],
)
def test_a_joint_variable_with_another_factor_is_refused(cell: str):
    with pytest.raises(TableError, match=r"row 1, theta: q1 stands alone with factor 1") as caught:
        read_table([[cell, 0, "a1", 0]], NAMES)
    assert (caught.value.row, caught.value.column) == (1, "theta")


@pytest.mark.parametrize(
    ("cells", "row", "column", "sentence"),
    [
        (
            [["q1", 0, 0, 0], ["0", "0", "a1", "0"]],
            2,
            "",
            "q2 takes a place in theta .* or d .*, got no joint variable",
        ),
        ([["q1", "q1", 0, 0]], 1, "", "q1 takes a place in theta .* or d .*, got both"),
        ([["q2", 0, 0, 0]], 1, "theta", "this row takes q1 only, got q2"),
        (
            [["q1", 0, 0, "q1"]],
            1,
            "alpha",
            r"q1 takes a place in theta \(revolute\) or d \(prismatic\)",
        ),
        ([["q1", 0, "q1 + a1", 0]], 1, "a", r"q1 takes a place in theta"),
        (
            [["q1", 0, "q1 + a7", 0]],
            1,
            "a",
            r"unknown name 'a7'; did you mean a1\?\nq1 \+ a7\n {5}\^",
        ),
        ([["q1", 0, "0,4", 0]], 1, "a", "a decimal number takes a point"),
        ([["q1", 0, float("nan"), 0]], 1, "a", "unknown name 'nan'"),
        ([["q1", 0, None, 0]], 1, "a", "a cell takes a formula or a number, got NoneType"),
        (
            [["q1", 0, 0, 0], ["q2", 0, 0]],
            2,
            "",
            "a row takes four cells theta, d, a, alpha, got 3",
        ),
        (["q1", "q2"], 1, "", "a row takes four cells theta, d, a, alpha, got 'q1'"),
        ([], 0, "", "a table takes one row for each joint, got none"),
    ],
)
def test_what_is_no_table_is_refused_with_the_cell_named(
    cells: Any, row: int, column: str, sentence: str
):
    with pytest.raises(TableError, match=sentence) as caught:
        read_table(cells, NAMES)
    assert (caught.value.row, caught.value.column) == (row, column)
    twin = pickle.loads(pickle.dumps(caught.value))  # noqa: S301  our own bytes
    assert (str(twin), twin.row, twin.column) == (str(caught.value), row, column)


def test_numbers_from_somebodys_cosine_of_90_degrees_are_read_as_zero():
    table = read_table([["q1", 6.1e-17, 1.0, -6.1e-17]], NAMES)
    np.testing.assert_array_equal(table.numbers({"q1": 0.0}), [[0, 0, 1, 0]])


def test_an_unknown_convention_is_refused():
    wrong: Any = "craig"
    with pytest.raises(TableError, match="convention takes 'standard' or 'modified', got 'craig'"):
        Table(read_table(CELLS, NAMES).rows, wrong)


def test_missing_and_impossible_values_are_refused_with_the_cell_named():
    table = read_table([["q1", 0, "1/a1", 0]], NAMES)
    with pytest.raises(TableError, match="row 1, a: values takes a1"):
        table.chain({})
    with pytest.raises(TableError, match="row 1, a: 1/a1 has no finite value"):
        table.chain({"a1": 0.0})


def test_numbers_take_the_shape_of_the_joint_values():
    table = read_table(CELLS, NAMES)
    numbers = table.numbers({**VALUES, "q1": np.zeros((5, 1)), "q2": 0.0, "q3": np.ones(4)})
    assert numbers.shape == (5, 4, 3, 4)
    np.testing.assert_allclose(
        numbers[2, 1], np.add(NUMBERS, [[0] * 4, [0] * 4, [0, 1, 0, 0]]), atol=1e-15
    )
    assert len(COLUMNS) == numbers.shape[-1]
