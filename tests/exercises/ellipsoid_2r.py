"""Manipulability of a planar 2R arm (after MIT 6.4210, exercise 3.6)."""

import numpy as np
from kinegrade.exercises import questions as ask
from kinegrade.exercises.answers import Choice, Configurations, Manual
from kinegrade.exercises.arm import arm_of
from kinegrade.exercises.draws import posture, until
from kinegrade.exercises.part import exercise, part
from kinegrade.exercises.properties import is_guessable, listed_right
from kinegrade.solutions.ellipsoids import velocity_ellipsoid
from kinegrade.solutions.robots import ROBOTS

ARM = ROBOTS["planar_2r"]


def is_telling(v):
    return not is_guessable(velocity_ellipsoid(arm_of(ARM, v).J[:2]).axes[:, 0])


@part(1, Configurations(1), check=lambda best, value: listed_right(value, best, 2e-3))
def best():
    r"""All $q_2$ in $(-\pi, \pi]$ at which $w$ is largest"""
    return [[np.pi / 2], [-np.pi / 2]]


@part(
    1,
    Choice(
        ("a circle", "a line segment across the arm", "a line segment along the arm", "a point")
    ),
)
def collapse():
    """What becomes of the ellipse at $q_2 = 0$"""
    return "b"


@part(2, Manual(((2, "axes of the right lengths, turned by 90 degrees"),), on_paper=True))
def sketch():
    """Sketch the ellipse at the hand and beside it the force ellipse"""
    return "Same axes; half axes 1/s1 and 1/s2."


EXERCISE = exercise(
    "ellipsoid_2r",
    title="Manipulability of a planar arm",
    source="MIT 6.4210, 3.6",
    robot=ARM,
    draw=lambda rng: until(lambda: posture(ARM, rng, regular=0.1), is_telling),
    parts=[
        *(
            ask.jacobian(rows="task", points=2),
            ask.manipulability_formula(),
            ask.ellipsoid(rows="task"),
        ),
        *(ask.ellipsoid_axis(rows="task"), best, collapse, sketch),
    ],
)
