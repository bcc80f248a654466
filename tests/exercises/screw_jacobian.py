"""Space and body Jacobian of a SCARA by screws (after Modern Robotics 5.1), with the book's order of rows."""

import numpy as np
from kinegrade.exercises import questions as ask
from kinegrade.exercises.answers import Numbers
from kinegrade.exercises.draws import posture
from kinegrade.exercises.part import exercise, part
from kinegrade.solutions.robots import ROBOTS

ARM = ROBOTS["scara"]


@part(2, Numbers((6, 6), "1"))
def Ad(T):
    r"""The adjoint $[\mathrm{Ad}_{T_{sb}}]$ for twists $(\boldsymbol\omega, \mathbf v)$

    - It turns body twists into space twists.

    $\mathbf R$ in both diagonal blocks, $[\mathbf p]\,\mathbf R$ below on the left:
    $$[\mathrm{Ad}_{T_{sb}}] = <Ad>$$
    """
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[R, np.zeros((3, 3))], [np.cross(p, R, axisb=0, axisc=0), R]])


EXERCISE = exercise(
    "screw_jacobian",
    title="Space and body Jacobian",
    source="MR 5.1",
    robot=ARM,
    draw=lambda rng: posture(ARM, rng),
    rows="angular, linear",
    parts=[
        ask.pose(),
        ask.jacobian(point="origin", name="J_s"),
        Ad,
        ask.jacobian(frame="tool", name="J_b"),
    ],
)
