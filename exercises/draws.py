"""Drawing numbers that make a question well posed: generic angles, plain lengths, rates that matter."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..solutions.jacobian import jacobian
from ..solutions.robot import Robot
from ..solutions.singularity import singular_values
from .exercise import ExerciseError

REGULAR = 0.03  # smallest over largest singular value of the task rows, lengths in sizes of the arm
PARALLEL = 1e-9
CLEARANCE = 10  # degrees from a multiple of 90, where mistakes such as sin for cos would not show
TRIES = 10_000


def length(rng: np.random.Generator, low: float = 0.4, high: float = 1.2) -> float:
    """A length [m] with two decimals."""
    return round(float(rng.integers(round(100 * low), round(100 * high) + 1)) / 100, 2)


def angles(rng: np.random.Generator, n: int, parallel: Sequence[Sequence[int]] = ()) -> list[float]:
    """`n` joint angles [rad] with three decimals: whole degrees in (-125, 125), all different in size.

    Neither an angle nor the sum over the joints of a group in `parallel` (indices from 0) comes
    within ten degrees of a multiple of 90.
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
    raise ExerciseError(
        f"{TRIES} draws in a row were refused; the conditions of this draw leave too little room"
    )


def posture(
    robot: Robot,
    rng: np.random.Generator,
    lengths: Sequence[str] | None = None,
    regular: float = REGULAR,
) -> dict[str, Any]:
    """Lengths and q of an arm away from its singular postures, within its limits.

    `lengths` are the robot's parameters that are drawn, by default all; each is between 0.7 and 1.4
    times its default. Neither a joint angle nor a sum over joints with parallel axes comes near a
    right angle.

    Raises:
        ExerciseError: there is too little room within the limits.
    """
    names = [*robot.parameters] if lengths is None else [*lengths]
    sizes = {name: _near(rng, robot.parameters[name]) for name in names}
    chain = robot.chain(sizes)
    unit = np.where(np.arange(6) < 3, sum(map(abs, robot.values(sizes).values())) or 1.0, 1.0)[
        :, None
    ]
    turning = [i for i, kind in enumerate(robot.kinds) if kind == "R"]
    turns = [[turning.index(joint) for joint in group] for group in parallel_groups(robot)]

    def drawn() -> list[float]:
        found = iter(angles(rng, len(turning), turns))
        kinds = zip(robot.kinds, robot.limits, strict=True)
        return [next(found) if kind == "R" else length(rng, *limits) for kind, limits in kinds]

    def is_regular(q: list[float]) -> bool:
        if robot.outside(q):
            return False
        values = singular_values((jacobian(chain, q) / unit)[list(robot.task_rows)])
        return bool(values[-1] >= regular * values[0])

    return {**sizes, "q": until(drawn, is_regular)}


def parallel_groups(robot: Robot) -> list[tuple[int, ...]]:
    """Runs of two or more revolute joints (from 0) whose axes are parallel whatever the posture."""
    postures = np.random.default_rng(0).uniform(0.2, 1.3, (3, robot.n))
    axes = np.swapaxes(robot.frames(None, postures)[:, :-1, :3, 2], 0, 1)  # (n, 3 postures, 3)
    runs: list[list[int]] = []
    for joint in (i for i, kind in enumerate(robot.kinds) if kind == "R"):
        aside = np.cross(axes[joint], axes[runs[-1][-1]]) if runs else np.ones(1)
        if np.abs(aside).max() < PARALLEL:
            runs[-1].append(joint)
        else:
            runs.append([joint])
    return [
        tuple(run[start : end + 1])
        for run in runs
        for start in range(len(run))
        for end in range(start + 1, len(run))
    ]


def _near(rng: np.random.Generator, default: float) -> float:
    """A length [m] with two decimals, or three where it is short."""
    decimals = 2 if abs(default) >= 0.2 else 3
    return round(float(rng.uniform(0.7, 1.4) * default), decimals)
