"""Drawing numbers that make a question well posed: generic angles, plain lengths, rates that matter."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .exercise import ExerciseError

CLEARANCE = 10  # degrees from a multiple of 90, where mistakes such as sin for cos would not show
TRIES = 10_000


def length(rng: np.random.Generator, low: float = 0.4, high: float = 1.2) -> float:
    """A length [m] with two decimals."""
    return round(float(rng.integers(round(100 * low), round(100 * high) + 1)) / 100, 2)


def angles(rng: np.random.Generator, n: int, parallel: Sequence[Sequence[int]] = ()) -> list[float]:
    """`n` joint angles [rad] with three decimals: whole degrees in (-125, 125), all different in size.

    Neither an angle nor the sum over the joints of a group in `parallel` (indices from 0) comes within ten degrees of
    a multiple of 90.
    """

    def clear(degrees: list[int]) -> bool:
        sums = [sum(degrees[i] for i in group) for group in parallel]
        generic = all(CLEARANCE <= angle % 90 <= 90 - CLEARANCE for angle in (*degrees, *sums))
        return generic and len({abs(angle) for angle in degrees}) == n

    degrees = until(lambda: [int(angle) for angle in rng.integers(-125, 126, n)], clear)
    return [round(float(np.radians(angle)), 3) for angle in degrees]


def rates(rng: np.random.Generator, n: int) -> list[float]:
    """`n` joint rates [rad/s] with one decimal, none zero, sizes 0.2 to 1.8."""
    return [
        round(float(size * sign) / 10, 1)
        for size, sign in zip(rng.integers(2, 19, n), rng.choice([-1, 1], n), strict=True)
    ]


def until(draw: Callable[[], Any], accept: Callable[[Any], bool]) -> Any:
    """The first draw that is accepted.

    Raises:
        ExerciseError: ten thousand draws were not.
    """
    for _ in range(TRIES):
        drawn = draw()
        if accept(drawn):
            return drawn
    raise ExerciseError(f"{TRIES} draws in a row were refused; the conditions of this draw leave too little room")
