"""Pieces of curves in a plane, put together where they meet end to end."""

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]


def chained(
    pieces: list[Values], kinds: list[bool], along: float, beside: float
) -> list[list[int]]:
    """Rows of pieces (m, 2) of one kind that run on into each other: the ends 2 i or 2 i + 1 where each is entered.

    Ends meet if they are at most `along` apart, `beside` across their way, and look at each other. A ring comes back
    to the end it started from, and has it twice.
    """
    if not pieces:
        return []
    partner = _partners(pieces, kinds, along, beside)
    used, rows = set[int](), list[list[int]]()
    for start in [end for end in range(2 * len(pieces)) if end not in partner] + list(
        range(2 * len(pieces))
    ):
        row, end = list[int](), start
        while end // 2 not in used:
            used.add(end // 2)
            row.append(end)
            end = partner.get(end ^ 1, end)
        if row:
            rows.append(row + [start] * (partner.get(row[-1] ^ 1) == start))
    return rows


def _partners(
    pieces: list[Values], kinds: list[bool], along: float, beside: float
) -> dict[int, int]:
    """Each end that meets another, with that other: the nearest first."""
    ends = np.array([piece[i] for piece in pieces for i in (0, -1)])
    ways = ends - np.array([piece[i] for piece in pieces for i in (1, -2)])  # outwards
    ways /= np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-300)
    of = np.repeat(kinds, 2)
    gaps = ends - ends[:, None]
    size, off = (
        np.linalg.norm(gaps, axis=-1),
        gaps[..., 0] * ways[:, None, 1] - gaps[..., 1] * ways[:, None, 0],
    )
    fits = (size < along) & (np.abs(off) < beside) & (ways @ ways.T < -0.5) & (of == of[:, None])
    first, second = np.nonzero(np.triu(fits, 1))
    partner = dict[int, int]()
    for k in np.argsort(size[first, second], kind="stable"):
        a, b = int(first[k]), int(second[k])
        if a not in partner and b not in partner:
            partner[a], partner[b] = b, a
    return partner
