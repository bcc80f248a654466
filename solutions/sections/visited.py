"""Which line of a section first came to each place, so that none is followed twice.

A place is a small square cell of the section together with the direction of a line in it.
"""

from itertools import product

import numpy as np

from ..singularity import Values
from .stands import Mask, Whole

CELL = 0.006  # points that near, of curves that run the same way, are of one curve [arm lengths]
SIDE = int(2.4 / CELL)  # cells along the map, which holds all that an arm of length 1 reaches
TURNS = 24  # directions told apart on half a turn
RING = 40  # steps after which a line may come back to itself


def places(at: Values, bearing: Values) -> Whole:
    """Cell and direction (m, 3) of points (m, 2) [arm lengths] with bearings (m,) of normals.

    A normal and its opposite are one direction.
    """
    turn = np.floor(bearing % np.pi * (TURNS / np.pi)).astype(int) % TURNS
    cell = np.floor(at / CELL).astype(int) + SIDE // 2
    return np.column_stack([np.clip(cell, 1, SIDE - 2), turn])


class Visited:
    """The line that first came to each place, and at which step.

    Lines 2 i and 2 i + 1 are the two ways on from one seed.
    """

    def __init__(self) -> None:
        self.line = np.full((SIDE, SIDE, TURNS), -1, dtype=np.int32)
        self.step = np.zeros((SIDE, SIDE, TURNS), dtype=np.int32)

    def enter(self, at: Values, bearing: Values, line: Whole, step: int) -> None:
        """Lines (m,), the lower ones first, come to these places."""
        x, y, turn = places(at, bearing)[::-1].T  # of two at one place the last one written stays
        fresh = self.line[x, y, turn] < 0
        place = x[fresh], y[fresh], turn[fresh]
        self.line[place] = line[::-1][fresh]
        self.step[place] = step

    def met(self, at: Values, bearing: Values, line: Whole, born: Whole, step: int) -> Mask:
        """Whether another line was at or beside these places before, or the same one long ago.

        `born` (m,) are the steps at which the lines began.
        """
        x, y, turn = places(at, bearing).T
        found = np.zeros(len(at), dtype=np.bool_)
        for i, j, k in product((-1, 0, 1), repeat=3):
            place = (x + i, y + j, (turn + k) % TURNS)
            first, then = self.line[place], self.step[place]
            # Along one way, or along the two ways from one seed
            between = np.where(first == line, step - then, step + then - 2 * born)
            another = (first < line) | (step - then > 1)
            same_seed = first >> 1 == line >> 1
            found |= (first >= 0) & np.where(same_seed, between > RING, another)
        return found
