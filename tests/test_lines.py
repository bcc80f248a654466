"""Pieces of curves that are put together end to end, and those that are not."""

import numpy as np
import pytest
from kinegrade.solutions.sections.lines import chained

TURN = np.linspace(0, 2 * np.pi, 101)
CIRCLE = np.column_stack([np.cos(TURN), np.sin(TURN)])
STRAIGHT = np.column_stack([np.linspace(0, 1, 11), np.zeros(11)])


def lengths(pieces, kinds=None):
    return sorted(len(row) for row in chained(pieces, kinds or [True] * len(pieces), 0.15, 0.01))


def test_nothing_is_no_line():
    assert chained([], [], 1.0, 1.0) == []


@pytest.mark.parametrize("order", [(1, 1), (1, -1), (-1, 1), (-1, -1)])
def test_two_halves_become_one_line_however_they_run(order):
    first, second = (
        piece[::way] for piece, way in zip((STRAIGHT[:6], STRAIGHT[6:]), order, strict=True)
    )
    (row,) = chained([first, second], [True, True], 0.15, 0.01)
    line = np.concatenate([(first, second)[end // 2][:: -1 if end % 2 else 1] for end in row])
    assert np.abs(np.diff(line[:, 0])) == pytest.approx(0.1)


def test_thirds_of_a_circle_become_a_ring_that_names_its_first_end_twice():
    (row,) = chained([CIRCLE[:34], CIRCLE[66:], CIRCLE[33:67]], [True] * 3, 0.15, 0.01)
    assert len(row) == 4
    assert row[0] == row[-1]


def test_a_closed_piece_is_a_ring_by_itself():
    assert chained([CIRCLE], [False], 0.15, 0.01) == [[0, 0]]


@pytest.mark.parametrize(
    ("other", "kinds"),
    [
        (np.add(STRAIGHT, [1.3, 0.0]), [True, True]),  # too far on
        (np.add(STRAIGHT, [1.0, 0.05]), [True, True]),  # beside
        (np.add(STRAIGHT[:, ::-1], [1.0, 0.0]), [True, True]),  # around a corner
        (np.add(STRAIGHT, [1.1, 0.0]), [True, False]),  # of another kind
    ],
)
def test_what_does_not_run_on_stays_apart(other, kinds):
    assert lengths([STRAIGHT, other], kinds) == [1, 1]
