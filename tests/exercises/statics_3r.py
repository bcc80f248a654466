"""Static torques of a planar 3R arm (after Modern Robotics, exercises 5.2 and 5.3 c)."""

from kinegrade.exercises import questions as ask
from kinegrade.exercises.draws import posture
from kinegrade.exercises.part import exercise
from kinegrade.solutions.robots import ROBOTS

ARM = ROBOTS["planar_3r"]


def draw(rng):
    load = rng.integers((4, 4, 2), (13, 13, 6)) * rng.choice([-1, 1], 3)
    return posture(ARM, rng) | {"F_tool": [float(x) for x in load]}


EXERCISE = exercise(
    "statics_3r",
    title="Torques that hold a force",
    source="MR 5.2",
    robot=ARM,
    draw=draw,
    units={"F_tool": ["N", "N", "N m"]},
    symbols={"F_tool": r"\mathbf F^{tool}"},
    parts=[
        ask.jacobian(rows="task", points=3),
        ask.wrench_in_base_axes(rows="task"),
        ask.torques(rows="task", wrench="F"),
    ],
)
