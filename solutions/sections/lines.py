"""Pieces of curves in a plane, put together where they meet end to end.

Piece i has two ends: 2 i is where it begins, 2 i + 1 where it stops; the other end of one is
`end ^ 1`, and its piece `end // 2`.
"""

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


def chained(
    pieces: list[Values], kinds: list[bool], along: float, beside: float
) -> list[list[int]]:
    """Rows of pieces (m, 2) of one kind that run on into each other, by the end each is entered at.

    Ends meet if they are at most `along` apart, `beside` across their way, and look at each other.
    A ring comes back to the end it started from, and has it twice.
    """
    if not pieces:
        return []
    partner = _partners(pieces, kinds, along, beside)
    ends = range(2 * len(pieces))
    open_ends = [end for end in ends if end not in partner]
    used = set[int]()
    rows = list[list[int]]()
    # Open lines first, from where they begin; what is left over are rings.
    for start in (*open_ends, *ends):
        row = _row(start, partner, used)
        if not row:
            continue
        if partner.get(row[-1] ^ 1) == start:
            row.append(start)
        rows.append(row)
    return rows


def _row(start: int, partner: dict[int, int], used: set[int]) -> list[int]:
    """The ends at which unused pieces are entered, from one on; the pieces are used then."""
    row = list[int]()
    end = start
    while end // 2 not in used:
        used.add(end // 2)
        row.append(end)
        end = partner.get(end ^ 1, end)
    return row


def _partners(
    pieces: list[Values], kinds: list[bool], along: float, beside: float
) -> dict[int, int]:
    """Each end that meets another, with that other: the nearest first."""
    ends = np.concatenate([piece[[0, -1]] for piece in pieces])
    inner = np.concatenate([piece[[1, -2]] for piece in pieces])
    ways = ends - inner  # outwards
    ways /= np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-300)
    kind = np.repeat(kinds, 2)

    gaps = ends - ends[:, None]
    size = np.linalg.norm(gaps, axis=-1)
    off = gaps[..., 0] * ways[:, None, 1] - gaps[..., 1] * ways[:, None, 0]
    facing = ways @ ways.T < -0.5
    fits = (size < along) & (np.abs(off) < beside) & facing & (kind == kind[:, None])
    first, second = np.nonzero(np.triu(fits, 1))

    partner = dict[int, int]()
    for k in np.argsort(size[first, second], kind="stable"):
        a, b = int(first[k]), int(second[k])
        if a not in partner and b not in partner:
            partner[a], partner[b] = b, a
    return partner
