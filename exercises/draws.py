"""Numbers that make a question well posed: generic angles, plain lengths, rates that matter."""

from collections.abc import Callable, Sequence
from itertools import combinations
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
    """`n` joint angles [rad] with three decimals: whole degrees in (-125, 125).

    They are all different in size. Neither an angle nor the sum over the joints of a group in
    `parallel` (indices from 0) comes within ten degrees of a multiple of 90.
    """

    def drawn() -> list[int]:
        return rng.integers(-125, 126, n).tolist()

    def accepted(degrees: list[int]) -> bool:
        return _are_generic(degrees, parallel)

    degrees = until(drawn, accepted)
    return [round(float(np.radians(angle)), 3) for angle in degrees]


def _are_generic(degrees: Sequence[int], parallel: Sequence[Sequence[int]]) -> bool:
    """Whether angles are of different size, and they and sums of them are no right angles."""
    sizes = {abs(angle) for angle in degrees}
    if len(sizes) < len(degrees) or not all(map(_is_clear, degrees)):
        return False
    for group in parallel:
        together = sum(degrees[i] for i in group)
        if not _is_clear(together):
            return False
    return True


def _is_clear(angle: int) -> bool:
    """Whether an angle [deg] keeps away from multiples of 90."""
    return CLEARANCE <= angle % 90 <= 90 - CLEARANCE


def rates(rng: np.random.Generator, n: int) -> list[float]:
    """`n` joint rates [rad/s] with one decimal, none zero, sizes 0.2 to 1.8."""
    tenths = rng.integers(2, 19, n) * rng.choice([-1, 1], n)
    return [round(float(rate) / 10, 1) for rate in tenths]


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
    names = robot.parameters if lengths is None else lengths
    sizes = {name: _near(rng, robot.parameters[name]) for name in names}
    chain = robot.chain(sizes)

    # linear rows in sizes of the arm, so that they compare with angular ones at any scale
    arm_size = sum(map(abs, robot.values(sizes).values())) or 1.0
    units = np.array([3 * [arm_size] + 3 * [1.0]]).T

    turning = [i for i, kind in enumerate(robot.kinds) if kind == "R"]
    # only revolute joints draw an angle, so the places of angles are not those of joints
    groups = [[*map(turning.index, group)] for group in parallel_groups(robot)]

    def drawn() -> list[float]:
        return _configuration(robot, rng, groups)

    def is_regular(q: list[float]) -> bool:
        if robot.outside(q):
            return False
        block = (jacobian(chain, q) / units)[list(robot.task_rows)]
        values = singular_values(block)
        return bool(values[-1] >= regular * values[0])

    return {**sizes, "q": until(drawn, is_regular)}


def _configuration(
    robot: Robot, rng: np.random.Generator, groups: Sequence[Sequence[int]]
) -> list[float]:
    """Generic angles, and strokes within their limits; `groups` are those of `angles`."""
    turns = iter(angles(rng, robot.kinds.count("R"), groups))
    q: list[float] = []
    for kind, limits in zip(robot.kinds, robot.limits, strict=True):
        if kind == "R":
            q.append(next(turns))
        else:
            q.append(length(rng, *limits))
    return q


def parallel_groups(robot: Robot) -> list[tuple[int, ...]]:
    """Runs of two or more revolute joints (from 0) whose axes are parallel whatever the posture."""
    postures = np.random.default_rng(0).uniform(0.2, 1.3, (3, robot.n))
    axes = np.swapaxes(robot.frames(None, postures)[:, :-1, :3, 2], 0, 1)  # (n, 3 postures, 3)

    runs: list[list[int]] = []  # each as long as it gets
    for joint, kind in enumerate(robot.kinds):
        if kind != "R":
            continue
        if runs and np.abs(np.cross(axes[joint], axes[runs[-1][-1]])).max() < PARALLEL:
            runs[-1].append(joint)
        else:
            runs.append([joint])

    groups: list[tuple[int, ...]] = []
    for run in runs:
        for first, last in combinations(range(len(run)), 2):
            groups.append(tuple(run[first : last + 1]))
    return groups


def _near(rng: np.random.Generator, default: float) -> float:
    """A length [m] with two decimals, or three where it is short."""
    decimals = 2 if abs(default) >= 0.2 else 3
    return round(float(rng.uniform(0.7, 1.4) * default), decimals)
