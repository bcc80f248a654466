"""Wrong tables are refused, and one wrong cell is named by row and column, whatever stands in it."""

from itertools import product

import numpy as np
import pytest
from kinegrade.exercises.answers import TableOf
from kinegrade.grader.kinds.one_cell import poses, single_cells
from kinegrade.grader.kinds.repairs import repairs
from kinegrade.grader.kinds.same_arm import describes_same_arm
from kinegrade.solutions.equivalence import Given
from kinegrade.solutions.table import COLUMNS, read_table

THETA, D, A, ALPHA = range(4)
ARMS = {  # no two cells of an arm can stand for each other
    "RRP": [[0.3, 0.5, 0.2, -1.5708], [0.4, 0.3, 0.25, 1.5708], [0.2, 0.6, 0.1, 0.4]],
    "RRRR": [
        [0.3, 0.5, 0.4, 1.5708],
        [-0.5, 0.2, 0.6, 0.7],
        [1.2, -0.3, 0.35, -1.1],
        [0.4, 0.25, 0.3, 0.6],
    ],
}
CHANGES = {
    "has the wrong sign": ((THETA, D, A, ALPHA), np.negative),
    "is a quarter turn off": ((THETA, ALPHA), lambda x: x + np.pi / 2),
    "is half a turn off": ((THETA, ALPHA), lambda x: x + np.pi),
    "is in degrees; radians are asked": ((THETA, ALPHA), np.degrees),
    "lacks an offset": ((THETA,), lambda _: 0.0),
    "is missing": ((D, A), lambda _: 0.0),
    "is another angle": ((ALPHA,), lambda x: x + 0.43),
    "is another length": ((D, A), lambda x: x + 0.17),
    "is in millimetres; metres are asked": ((D, A), lambda x: 1000 * x),
}
CASES = [(words, column) for words, (columns, _) in CHANGES.items() for column in columns]


def table(rows, kinds, convention):
    cells = []
    for i, (row, kind) in enumerate(zip(np.asarray(rows).tolist(), kinds, strict=True), 1):
        typed = [repr(number) for number in row]
        place = THETA if kind == "R" else D
        typed[place] = f"q{i} + ({typed[place]})"
        cells.append(typed)
    return read_table(cells, [f"q{i}" for i in range(1, len(kinds) + 1)], convention)


def said(kinds, convention, rows, **given):
    answer = TableOf((), kinds, convention, 3, Given(**given))
    reference, own = table(ARMS[kinds], kinds, convention), table(rows, kinds, convention)
    assert not describes_same_arm(answer, {}, reference, own)
    return [named.sentence for named in repairs(answer, {}, reference, own)]


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("kinds", ARMS)
@pytest.mark.parametrize(("words", "column"), CASES)
def test_a_wrong_cell_is_named_by_its_place_and_nothing_else_is(words, column, kinds, convention):
    _, change = CHANGES[words]
    for i in range(len(kinds)):
        rows = np.array(ARMS[kinds])
        rows[i, column] = change(rows[i, column])
        found = said(kinds, convention, rows)
        assert len(found) == 1
        assert found[0].startswith(f"Row {i + 1}: {COLUMNS[column]} ")
        # at a quarter turn, the sign and half a turn are one mistake
        if abs(ARMS[kinds][i][column]) < 1.5:
            assert found == [f"Row {i + 1}: {COLUMNS[column]} {words}."]


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize(("column", "by"), [(ALPHA, 0.43), (A, 0.17)])
@pytest.mark.parametrize("free", [{"senses": False}, {"base": False, "tool": False, "zero": False}])
def test_where_frames_are_free_the_place_is_among_those_named(free, column, by, convention):
    i = 1  # between two axes, in either convention
    rows = np.array(ARMS["RRRR"])
    rows[i, column] += by
    assert any(
        f"Row {i + 1}: {COLUMNS[column]} " in one for one in said("RRRR", convention, rows, **free)
    )


def hand(rows, kinds, q):
    """The pose of the last frame of a standard table, multiplied by the book."""
    T = np.eye(4)
    for row, kind, joint in zip(rows, kinds, q, strict=True):
        theta, d, a, alpha = row
        theta, d = (theta + joint, d) if kind == "R" else (theta, d + joint)
        ct, st, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
        link = [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d]]
        T = T @ np.array([*link, [0, 0, 0, 1]])
    return T


@pytest.mark.parametrize("kinds", ARMS)
def test_what_forward_kinematics_tells_apart_is_refused(kinds):
    rng = np.random.default_rng(5)
    answer = TableOf((), kinds)
    reference = table(ARMS[kinds], kinds, "standard")
    Q = rng.uniform(-2, 2, (3, len(kinds)))
    refused = 0
    for _ in range(60):
        rows = np.array(ARMS[kinds])
        for _ in range(rng.integers(1, 3)):
            rows[rng.integers(len(kinds)), rng.integers(4)] += rng.choice([-1, 1]) * rng.uniform(
                0.1, 2
            )
        off = max(np.abs(hand(rows, kinds, q) - hand(ARMS[kinds], kinds, q)).max() for q in Q)
        assert off > 0.02
        refused += not describes_same_arm(answer, {}, reference, table(rows, kinds, "standard"))
    assert refused == 60


@pytest.mark.parametrize(("kinds", "convention"), [*product(ARMS, ["standard", "modified"])])
def test_a_cell_tells_what_it_would_have_to_hold(kinds, convention):
    rows = np.array(ARMS[kinds])
    q = np.random.default_rng(0).uniform(-2, 2, (3, len(kinds)))
    wanted = poses(rows, kinds, convention, q)
    for i, column in product(range(len(kinds)), range(4)):
        edited = rows.copy()
        edited[i, column] += 0.3
        cells = single_cells(edited, kinds, convention, q, wanted, 1e-6)
        found = {(row, cell): value for row, cell, value in cells}
        assert found[i, column] == pytest.approx(rows[i, column])
        assert len(found) == 1


def test_forward_kinematics_of_the_quick_test_is_that_of_the_book():
    rows, q = np.array(ARMS["RRP"]), np.array([[0.3, -0.8, 0.4]])
    np.testing.assert_allclose(poses(rows, "RRP", "standard", q)[0], hand(rows, "RRP", q[0]))
