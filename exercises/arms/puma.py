"""The Puma 560 as the sheets of S3 5 show it."""

import numpy as np

from ...solutions.robots import ROBOTS
from ...solutions.singularity import sigma_min
from ..arm import Arm, arm_of
from ..contract.printed_table import printed_table, table_rows
from ..drawing import Drawing
from ..draws import angles, until

PUMA = ROBOTS["puma560"]
REACH = PUMA.parameters["a2"] + PUMA.parameters["d4"]  # [m]
TABLE = f"""The Puma 560 has six revolute joints. Its table in the **standard** Denavit–Hartenberg
convention (metres):

{printed_table(table_rows(PUMA, PUMA.parameters))}"""


def drawn(arm: Arm) -> Drawing:
    """The arm at the student's q."""
    return arm.drawing(
        "Puma 560 at your q, with frame 0 and the tool frame.",
        "Puma 560 arm with six revolute joints, drawn at your q.",
        arrows=False,
    )


REGULAR = 0.1  # smallest singular value of J in a posture: rates stay moderate, rounding harmless
NEAR = (0.02, 0.06)  # the same where the wrist is nearly straight
LARGE = 3.0  # the largest rate there is at least [rad/s]
CLEAR = 0.1  # of the elbow from the straight line between shoulder and wrist centre [m]
NEAR_SINGULAR = "near wrist-singular"
FAMILIES = {
    "generic": "",
    "elbow up": (
        "In your posture the elbow lies above the straight line from the shoulder to the wrist "
        "centre."
    ),
    "elbow down": (
        "In your posture the elbow lies below the straight line from the shoulder to the wrist "
        "centre."
    ),
    NEAR_SINGULAR: (
        "Your posture is close to a wrist singularity, $q_5 = 0$: "
        "in (c) large joint rates are right."
    ),
}


def posture(rng: np.random.Generator, family: str, speed: float) -> list[float]:
    """A posture q (6,) of a family.

    Near the wrist's singular one, a speed [m/s] along base x takes large rates.
    """

    def belongs(q: list[float]) -> bool:
        return _belongs(arm_of(PUMA, {"q": q}), family, speed)

    return until(lambda: _drawn(rng, family), belongs)


def _drawn(rng: np.random.Generator, family: str) -> list[float]:
    q = angles(rng, 6, [(1, 2)])
    if family == NEAR_SINGULAR:
        q[4] = round(float(rng.choice([-1, 1]) * rng.uniform(0.08, 0.18)), 3)
    return q


def _belongs(arm: Arm, family: str, speed: float) -> bool:
    if family == NEAR_SINGULAR:
        return _is_near_singular(arm, speed)
    if sigma_min(arm.J) < REGULAR:
        return False
    if family == "elbow up":
        return elbow_height(arm) >= CLEAR
    if family == "elbow down":
        return elbow_height(arm) <= -CLEAR
    return True


def _is_near_singular(arm: Arm, speed: float) -> bool:
    """Whether the wrist is nearly straight, and the arm block regular."""
    largest_rate = np.abs(np.linalg.solve(arm.J, speed * np.eye(6)[0])).max()
    is_near = NEAR[0] <= sigma_min(arm.J) <= NEAR[1]
    is_regular = sigma_min(arm.J[:3, :3]) >= REGULAR
    return bool(is_regular and is_near and largest_rate >= LARGE)


def elbow_height(arm: Arm) -> float:
    """How far the elbow lies above the line from shoulder to wrist centre [m].

    Measured in the plane normal to axis 2, since the links lie beside each other along it.
    """
    shoulder, elbow, wrist = arm.frames[[1, 2, 4], :3, 3]
    axis = arm.axes[:, 1]
    onto_plane = np.eye(3) - np.outer(axis, axis)

    link = onto_plane @ (elbow - shoulder)
    line = onto_plane @ (wrist - shoulder)
    off_the_line = link - line * (link @ line) / (line @ line)
    return float(off_the_line[2])
