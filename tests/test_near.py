"""Close rows are found without looking at all, and the same as by looking at all."""

import numpy as np
import pytest
from kinegrade.grader.marking.near import Near

WITHIN = 2e-3


@pytest.mark.parametrize("columns", [1, 6, 36])
@pytest.mark.parametrize("seed", range(5))
def test_what_is_found_is_what_a_look_at_all_rows_finds(columns, seed):
    rng = np.random.Generator(np.random.PCG64(seed))
    rows = rng.normal(size=(60, columns))
    rows[30:] = rows[:30] + rng.uniform(-1.02 * WITHIN, 1.02 * WITHIN, (30, columns))
    near = Near(rows, WITHIN)
    found = 0
    for row in rows:
        close = np.flatnonzero((np.abs(rows - row) <= WITHIN).all(axis=1)).tolist()
        assert near.to(row) == close
        found += len(close)
    assert found > 60


def test_rows_at_the_end_of_all_floats_are_close_to_themselves_only():
    rows = np.array([[1e308, -1e308], [-1e308, 1e308], [0.0, 0.0]])
    assert [Near(rows, WITHIN).to(row) for row in rows] == [[0], [1], [2]]


def test_equal_rows_come_in_their_order():
    assert Near(np.ones((5, 3)), WITHIN).to(np.ones(3)) == [0, 1, 2, 3, 4]
